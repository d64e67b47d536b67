//! ncc-frontends: from the text of a dialect to statements of the neutral program.
//!
//! Reading never fails: it gives statements and diagnostics, and goes on at the next block. Text
//! comes in pieces of whole lines, so that memory does not grow with the program.
//!
//! Not here: file access, formatting, printing, anything of back-ends.

pub mod canon;
pub mod ir;

use ncc_ir::canon::Modes;
use ncc_ir::diag::Diagnostic;
use ncc_ir::program::{Procedure, ProgramName, Stmt};

/// What reading a piece of text gave. The vectors are drained by the caller between pieces and
/// their memory is used again.
#[derive(Debug, Default)]
pub struct Batch {
    /// Further statements of the main procedure.
    pub stmts: Vec<Stmt>,
    /// Subprograms that are complete.
    pub procedures: Vec<Procedure>,
    /// The program's own name, as far as read.
    pub name: ProgramName,
    /// Every fact that the program has relied on so far without having said it, with the value
    /// taken for granted; grows, and is not to be drained.
    pub assumed: Modes,
    /// Set with the first call, label, jump or loop: from there on the program must be kept whole.
    pub whole: bool,
    /// What was found.
    pub diagnostics: Vec<Diagnostic>,
}
