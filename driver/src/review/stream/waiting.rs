//! The two sides of a comparison: pieces that are read, and their parts that are not executed yet.
//!
//! ```text
//! statements of a piece: first statements | rows of a table | the other statements
//! ```

use ncc_ir::canon::Modes;
use ncc_ir::program::Stmt;
use ncc_ir::program::line_table::LineTable;
use ncc_ir::program::rows::Rows;

/// Lines of tables that become statements at once where both sides have lines that do not pass.
const FEW: usize = 32;

/// Statements of a program that streams, in their order, not executed.
pub struct Reading {
    /// Lines of a piece before its statements.
    pub table: LineTable,
    /// The statements of a piece.
    pub stmts: Vec<Stmt>,
    /// Facts assumed so far.
    pub assumed: Modes,
}

/// The part of a side's piece that is not executed yet: first statements, then rows of a table, then the other statements.
#[derive(Default)]
pub struct Waiting {
    stmts: Vec<Stmt>,
    at: usize,
    table: LineTable,
    /// Rows of it that are behind.
    passed: usize,
    behind: Vec<Stmt>,
    /// Whether there was a piece.
    stood: bool,
    /// Whether there are no more.
    pub over: bool,
}

impl Waiting {
    /// The next piece, of which nothing was executed; whether there was one before it.
    pub fn take(&mut self, Reading { table, stmts, .. }: Reading) -> bool {
        (self.table, self.passed, self.behind) = (table, 0, stmts);
        std::mem::replace(&mut self.stood, true)
    }

    /// Whether nothing is left of the piece.
    pub fn is_empty(&mut self) -> bool {
        let none_left = |side: &Waiting| side.rest().is_empty() && side.rows().is_empty();
        if none_left(self) {
            (self.stmts, self.at) = (std::mem::take(&mut self.behind), 0);
        }
        none_left(self)
    }

    /// Statements that come next.
    pub fn rest(&self) -> &[Stmt] {
        self.stmts.get(self.at..).unwrap_or_default()
    }

    /// Rows of the table that come next, where no statements do.
    pub fn rows(&self) -> Rows<'_> {
        let passed = if self.rest().is_empty() { self.passed } else { self.table.rows().len() };
        Rows::of(&self.table).split(passed).1
    }

    /// So many of these statements are executed.
    pub fn pass(&mut self, many: usize) {
        self.at += many;
    }

    /// So many of these rows are.
    pub fn pass_rows(&mut self, many: usize) {
        self.passed += many;
    }

    /// Makes statements of rows that come next on one of the sides, as many as are held against statements of the other.
    pub fn unpack(sides: &mut [Waiting; 2]) {
        let many = sides.each_ref().map(|side| side.rest().len());
        for (side, there) in sides.iter_mut().zip([many[1], many[0]]) {
            side.unpack_rows(if there == 0 { FEW } else { there });
        }
    }

    fn unpack_rows(&mut self, many: usize) {
        if !self.rest().is_empty() {
            return;
        }
        let mut stmts = std::mem::take(&mut self.stmts);
        stmts.clear();
        Rows::of(&self.table).split(self.passed).1.split(many).0.unpack(&mut stmts);
        (self.stmts, self.at) = (stmts, 0);
        self.passed += many;
    }
}
