//! What reading a piece of text gives: statements, subprograms and diagnostics.
//!
//! Not here: the readers, which fill it.

use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Num;
use ncc_ir::program::line_table::{LineTable, Row, StatedFeed};
use ncc_ir::program::{Op, Procedure, ProgramName, Stmt};
use ncc_ir::source::Span;

use crate::common::fast_lower::FastLower;

/// What reading a piece of text gave. The vectors are drained by the caller between pieces and
/// their memory is used again.
#[derive(Debug, Default)]
pub struct Batch {
    /// Lines of the main procedure before its further statements, where they were asked for as a table
    /// ([`Reader::read_to_table`](crate::Reader::read_to_table)).
    pub table: LineTable,
    /// Whether they are.
    pub(crate) tabled: bool,
    /// Further statements of the main procedure.
    pub stmts: Vec<Stmt>,
    /// The last block of the main procedure that was read with the pieces before, whose statements may be taken out.
    pub(crate) last: Option<Span>,
    /// Subprograms that are complete.
    pub procedures: Vec<Procedure>,
    /// The program's own name, as far as read.
    pub name: ProgramName,
    /// Every fact that the program has relied on so far without having said it, with the value
    /// assumed; grows, and is not to be drained.
    pub assumed: Modes,
    /// Set with the first call, label, jump or loop: from there on the program must be kept whole.
    pub whole: bool,
    /// What was found.
    pub diagnostics: Vec<Diagnostic>,
    /// Numbers without a point that count increments; only after [`Reader::watch`](crate::Reader::watch).
    pub bare: Vec<BareNumber>,
    /// Whether a length has been met that is written with a point and is not zero; only after
    /// [`Reader::watch`](crate::Reader::watch), and of dialects where the point matters.
    pub pointed: bool,
    /// Whether the text has been found to be a subprogram without its main program.
    pub subprogram: bool,
    /// What the main procedure says of itself, where that is more than its name: a subprogram that is read alone has
    /// parameters, which are given their values from elsewhere. Its body is empty.
    pub heading: Option<Box<Procedure>>,
}

impl Batch {
    /// The main procedure with these statements, and what it says of itself.
    pub fn main(&mut self, body: Vec<Stmt>) -> Procedure {
        let heading = self.heading.take().map(|heading| *heading).unwrap_or_default();
        Procedure { body, ..heading }
    }

    /// Remembers the last block of a piece, before its statements are taken out.
    pub(crate) fn keep_last(&mut self) {
        let stmt = self.stmts.last().map(|stmt| stmt.span);
        self.last = stmt.or_else(|| self.table.rows().last().map(Row::span)).or(self.last);
    }

    /// Where further statements go: into the subprogram that is being read, else into the main procedure. Whoever looks
    /// there finds all of them as statements.
    #[inline]
    pub(crate) fn body<'o>(&'o mut self, sub: &'o mut Option<Procedure>) -> &'o mut Vec<Stmt> {
        match sub {
            Some(procedure) => &mut procedure.body,
            None => {
                self.unpack_table();
                &mut self.stmts
            }
        }
    }

    /// Makes statements of the table's rows.
    #[inline]
    pub fn unpack_table(&mut self) {
        if !self.table.is_empty() {
            self.unpack_rows();
        }
    }

    #[cold]
    fn unpack_rows(&mut self) {
        let mut behind = std::mem::take(&mut self.stmts);
        self.table.unpack(&mut self.stmts);
        self.table.clear();
        self.stmts.append(&mut behind);
    }

    /// Whether a line can go into the table, since nothing but lines has been read.
    #[inline(always)]
    fn takes_rows(&self, sub: &Option<Procedure>) -> bool {
        self.tabled && self.stmts.is_empty() && sub.is_none() && !self.whole
    }

    /// Takes a plain line that `read` makes of an empty row; gives what it gives, or does nothing where that is `None`.
    #[inline(always)]
    pub(crate) fn plain_line<T>(
        &mut self,
        sub: &mut Option<Procedure>,
        fast: &FastLower,
        read: impl FnOnce(&mut Row, &mut Option<StatedFeed>) -> Option<T>,
    ) -> Option<T> {
        if self.takes_rows(sub) && self.table.takes(fast.unit, fast.distance) {
            return self.table.push_by(fast.unit, read);
        }
        let (mut row, mut feed) = (Row::default(), None);
        let done = read(&mut row, &mut feed)?;
        row.unpack(fast.unit, fast.distance, feed.as_ref(), self.body(sub));
        Some(done)
    }

    /// Takes a usual block, of which `push` makes the statements.
    pub(crate) fn usual_block(&mut self, sub: &mut Option<Procedure>, push: impl FnOnce(&mut Vec<Stmt>)) {
        if !self.takes_rows(sub) {
            return push(self.body(sub));
        }
        push(&mut self.stmts);
        if self.table.push_block(&self.stmts) {
            self.stmts.clear();
        }
    }
}

/// A number that stands without a decimal point where the dialect's rule makes that another value.
#[derive(Clone, Debug, PartialEq)]
pub struct BareNumber {
    /// Its word.
    pub span: Span,
    /// The value by the dialect's rule.
    pub read: Num,
    /// What the same digits are with a point after them.
    pub with_point: Num,
    /// Whether it is a feed.
    pub feed: bool,
}

/// The name of the [`NoEffect`](ncc_ir::program::Op::NoEffect) that stands where a block was refused, after
/// [`Reader::watch`](crate::Reader::watch).
pub const REFUSED: &str = "";

/// A statement for a block that was refused.
pub(crate) fn refused(span: Span) -> Stmt {
    Stmt::new(span, Op::NoEffect(REFUSED.into()))
}

impl Batch {
    /// Reports something at a place.
    pub(crate) fn report(&mut self, fault: Fault, span: Span) {
        self.diagnostics.push(Diagnostic::new(fault, span));
    }

    /// Whether the last thing reported is an error of a word of this block.
    pub(crate) fn refused_within(&self, block: Span) -> bool {
        self.diagnostics.last().is_some_and(|last| {
            last.fault.gravity() == ncc_ir::diag::Gravity::Error
                && block.start <= last.span.start
                && last.span.end <= block.end
        })
    }
}
