//! A subprogram that stands alone: it goes back to a program that is not there. What it takes for granted is what that
//! one has in force, so that the output states none of it, and is read with the same.

use ncc_dialects::Dialect;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::valid::returns_alone;
use ncc_machines::reading::Told;

use super::{FLATTEN, Line};

impl Line<'_> {
    /// Prepares for such a program; `true` where the target cannot say it (reported).
    pub(super) fn is_refused_alone(&mut self, source: &Program) -> bool {
        let Some(at) = returns_alone(source) else { return false };
        let to = self.job.to.dialect;
        let named = to.program.macros && has_parameters(source);
        // Where files are known by their names, one that was not has none that its callers would look for.
        let files = |dialect: &Dialect| dialect.program.sub_extension.is_some();
        let ends = to.program.macro_b || files(to) && files(self.job.from.dialect);
        // What has been written already has stated modes, which would be the caller's from there on.
        if !ends && !named && !to.can.everything || self.written > 0 {
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

    /// One that is executed to be written as straight blocks has values for its parameters, and is a program by itself.
    pub(super) fn by_itself(&self, mut source: Program) -> Program {
        let flat = self.job.passes.first().is_some_and(|pass| pass.name == FLATTEN);
        if flat && has_parameters(&source) {
            source.procedures.first_mut().into_iter().for_each(|main| end(&mut main.body));
        }
        source
    }
}

fn has_parameters(source: &Program) -> bool {
    source.procedures.first().is_some_and(|main| !main.parameters.is_empty())
}

/// Ends a program where it goes back.
fn end(body: &mut [Stmt]) {
    for stmt in body {
        match &mut stmt.op {
            Op::Return => stmt.op = Op::ProgramEnd,
            Op::Control(control) => control.bodies_mut().for_each(|body| end(body)),
            _ => {}
        }
    }
}
