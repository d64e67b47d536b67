//! Lines of tables: how they are executed.
//!
//! Not here: how a line is taken (`feed`).

use ncc_ir::program::rows::Rows;

use super::Run;

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
