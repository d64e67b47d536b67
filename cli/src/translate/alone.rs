//! A subprogram that stands alone: it goes back to a program that is not there. What it takes for granted is what that
//! one has in force, so that the output states none of it, and is read with the same.

use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::Program;
use ncc_ir::valid::returns_alone;
use ncc_machines::reading::Told;

use super::Line;

impl Line<'_> {
    /// Prepares for such a program; `true` where the target cannot say it (reported).
    pub(super) fn is_refused_alone(&mut self, source: &Program) -> bool {
        let Some(at) = returns_alone(source) else { return false };
        let to = self.job.to.dialect;
        // What has been written already has stated modes, which would be the caller's from there on.
        let named =
            to.program.macros && source.procedures.first().is_some_and(|main| !main.parameters.is_empty());
        if !to.program.macro_b && !named && !to.can.everything || self.written > 0 {
            let what = "the return of a subprogram without its main program".into();
            self.take(vec![Diagnostic::new(Fault::CannotSay { what }, at)], Told::Writer);
            return true;
        }
        if let Some(verifier) = &mut self.verifier {
            verifier.read_as_called();
        }
        self.writer.stands_alone(&self.renumbering.modes(&source.assumed));
        false
    }
}
