//! Lines of tables: who takes them by many, and how they are executed.
//!
//! Not here: how a line is taken (`feed`).

use std::ops::ControlFlow;

use ncc_ir::program::Stmt;
use ncc_ir::program::rows::Rows;

use super::{Control, Made, Reading, Run};

/// Takes what a program makes.
pub trait Takes {
    /// The start, a statement, or the end; it may break off.
    fn made(&mut self, made: Made) -> ControlFlow<()>;

    /// Executes lines behind the one whose statement has made what was taken last, where they make as much, and takes that:
    /// so many from the first one on. Those behind them are executed as statements.
    fn lines(&mut self, lines: Rows, controls: &mut [Control]) -> usize;
}

/// Takes what statements make.
pub(super) struct OfStatements<'t>(pub(super) &'t mut dyn FnMut(Made) -> ControlFlow<()>);

impl Takes for OfStatements<'_> {
    fn made(&mut self, made: Made) -> ControlFlow<()> {
        (self.0)(made)
    }

    fn lines(&mut self, _: Rows, _: &mut [Control]) -> usize {
        0
    }
}

impl Reading {
    /// All of it as statements.
    pub fn statements(mut self) -> Vec<Stmt> {
        let mut stmts = Vec::new();
        Rows::of(&self.table).unpack(&mut stmts);
        stmts.append(&mut self.stmts);
        stmts
    }
}

impl Run<'_> {
    /// Lines, which no level of block skip leaves out and which have nothing else of what is noted: the first of those that
    /// go on in one way as statements, and the others as they are taken.
    pub(super) fn lines(&mut self, mut lines: Rows) {
        self.course.blocks += lines.len() as u64;
        if self.errors > 0 || lines.is_empty() {
            return;
        }
        self.assume();
        let mut stmts = Vec::new();
        while !(lines.is_empty() || self.broken_off || self.controls.is_empty()) {
            let (first, behind) = lines.split(1);
            stmts.clear();
            first.unpack(&mut stmts);
            self.each_statement(&stmts);
            if self.errors > 0 {
                return;
            }
            let taken = if self.broken_off { 0 } else { self.take.lines(behind, &mut self.controls) };
            lines = behind.split(taken).1;
        }
    }
}
