//! Opening a block, letting words into it, and closing it: with its number, its skip mark and its end.

use ncc_ir::canon::{AXES, Axis};
use ncc_ir::diag::Fault;
use ncc_ir::lack::{FlowLack, LengthsLack, WordsLack};
use ncc_ir::program::{Op, Stmt};
use ncc_ir::run_time::RunTimeWord;
use ncc_ir::source::Span;

use super::Words;
use crate::common::Sink;
use crate::common::active_modes::ActiveModes;
use crate::common::block::Need;
use crate::common::fault::{cannot, cannot_compute};

impl Words {
    /// Begins a block of the source.
    pub(crate) fn open_block(&mut self, first: &Stmt) {
        self.settle();
        self.split = false;
        self.block.forget_formulas();
        self.block.number = first.number;
    }

    /// Ends a block of the source.
    pub(crate) fn close_block(&mut self, stmts: &[Stmt], sink: &mut Sink) {
        self.flush(false, sink);
        if let (true, Some(first)) = (self.split, stmts.first()) {
            let span = stmts.iter().fold(first.span, |span, s| span.to(s.span));
            sink.report(Fault::BlockSplit, span);
        }
    }

    /// Begins a statement, and gives what was active before.
    ///
    /// # Errors
    /// Its block cannot be marked to be skipped.
    pub(crate) fn open(&mut self, stmt: &Stmt, sink: &mut Sink) -> Result<ActiveModes, Fault> {
        if stmt.skip != self.block.skip && !self.block.is_empty() {
            self.flush(false, sink);
        }
        self.block.skip = stmt.skip;
        self.block.at = stmt.span;
        if self.forgotten {
            self.stand(stmt);
        }
        let silent = matches!(stmt.op, Op::Comment(_) | Op::Blank | Op::NoEffect(_));
        if stmt.skip.is_some() && !silent && self.skip_mark(stmt.skip).is_none() {
            return Err(Fault::lacks(FlowLack::OwnSkipSwitch));
        }
        Ok(self.active)
    }

    /// Ends a statement: tells its fault, writes its comment, and follows it.
    pub(crate) fn close(
        &mut self,
        stmt: &Stmt,
        before: Option<ActiveModes>,
        written: Result<(), Fault>,
        sink: &mut Sink,
    ) {
        let before = before.unwrap_or(self.active);
        if let Err(fault) = written {
            sink.report(fault, stmt.span);
        }
        self.tell_unsure(stmt.span, sink);
        if let Some(comment) = &stmt.comment {
            self.comment(comment, stmt.span, sink);
        }
        let length = self.tracker.modes.length_offset;
        self.tracker.step(stmt);
        if stmt.op.calls_length() && (length.is_none() || self.tracker.modes.length_offset != length) {
            // From which of the two lengths Z counts is not known before the next Z word.
            self.tracker.position[Axis::Z as usize] = None;
        }
        if stmt.skip.is_some() {
            self.active.join(&before);
            self.lost = true;
            self.residue = [0; AXES];
            self.residual = false;
        }
    }

    /// Makes room for a statement: in the block at hand, or else in a new one.
    pub(crate) fn admit(&mut self, need: &Need, sink: &mut Sink) -> Result<(), Fault> {
        if !self.block.possible(need) {
            return Err(Fault::lacks(WordsLack::CodesInOneBlock));
        }
        if !self.block.fits(need) {
            let feed = self.block.feed_can_wait(need).then(|| self.block.take_feed());
            if !self.block.is_empty() {
                self.flush(false, sink);
                self.split = true;
            }
            if let Some(feed) = feed {
                self.block.put_feed(feed);
            }
        }
        self.block.take(need);
        Ok(())
    }

    /// Ends the block; `even_empty` writes the line of an empty one.
    pub(crate) fn flush(&mut self, even_empty: bool, sink: &mut Sink) {
        let empty = self.block.is_empty();
        if empty && self.block.comment.is_empty() && !even_empty {
            if !self.block.after.is_empty() {
                let to = self.preamble.as_mut().map_or(&mut *sink.out, |p| &mut p.held);
                to.append(&mut self.block.after);
            }
            return;
        }
        if let Some(span) = self.offset_waits.take()
            && !self.block.has(Axis::Z.letter())
        {
            sink.report(cannot(LengthsLack::OffsetWithoutZ), span);
        }
        self.surface_with_speed(sink);
        let number = self.numbers.of_line(empty, self.block.number);
        let mark = self.skip_mark(self.block.skip);
        let to = self.preamble.as_mut().map_or(&mut *sink.out, |p| &mut p.held);
        let start = to.len();
        if let Some((mark, level)) = mark {
            to.extend_from_slice(mark.as_bytes());
            if let Some(level) = level {
                to.push(b'0' + level);
                if self.dialect.block.blanks {
                    to.push(b' ');
                }
            }
        }
        if let (Some(number), Some(letter)) = (number, self.dialect.block.number) {
            to.push(letter as u8);
            to.extend_from_slice(number.to_string().as_bytes());
        }
        let bare = to.len() - start + self.block.bare_length();
        self.block.write(to, number.is_some());
        let length = to.len() - start;
        to.extend_from_slice(self.eol);
        to.append(&mut self.block.after);
        self.check_length(length, self.block.at, sink);
        let most = self.dialect.block.longest_bare;
        if most > 0 && bare > most as usize {
            sink.report(cannot(WordsLack::BlockLength { most }), self.block.at);
        }
    }

    /// Refuses a line of more characters than a block may have.
    pub(crate) fn check_length(&self, length: usize, at: Span, sink: &mut Sink) {
        let most = self.dialect.block.longest;
        if most > 0 && length > most as usize {
            sink.report(cannot_compute(RunTimeWord::BlockLength { most }), at);
        }
    }

    /// The mark of a skip level, and its digit if it needs one; `None` if there is no such mark.
    pub(crate) fn skip_mark(&self, level: Option<u8>) -> Option<(&'static str, Option<u8>)> {
        let rules = &self.dialect.block;
        let level = level?;
        match (rules.skip.as_str(), level) {
            ("", _) => None,
            _ if rules.skip_levels == 0 => None,
            (mark, 1) => Some((mark, None)),
            (mark, 2..=9) if level <= rules.skip_levels => Some((mark, Some(level))),
            // On a control whose plain mark is `/0`, `/1` is one more level: the tenth.
            (mark, 10) if level <= rules.skip_levels => Some((mark, Some(1))),
            _ => None,
        }
    }
}
