//! A program that computes, legalised with what the target computes with: forms of control, functions, known modes, and
//! variables.
//!
//! ```text
//! IF [#1 EQ 2] GOTO 10    a target with structures: IF … ENDIF; one with other functions: their forms there
//! ```
//!
//! The steps are rows of the table of passes, in its order. Not here: blocks between two statements of control, which the
//! legaliser brings within the target's capabilities.

use ncc_ir::diag::Diagnostic;
use ncc_ir::program::Program;

pub use crate::pass::Parametric;
use crate::table::PASSES;
use crate::watch::ran_whole;

impl Parametric<'_> {
    /// Says a program so.
    pub fn say(&mut self, program: &mut Program, found: &mut Vec<Diagnostic>) {
        for pass in PASSES {
            let Some(step) = pass.parametric.filter(|step| (step.needed)(self, program)) else { continue };
            (step.run)(program, self, found);
            ran_whole(pass.name, program);
        }
    }
}
