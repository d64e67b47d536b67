//! Holes that one word of a block makes one after the other: `K4`, `L4`.
//!
//! Not here: the call of the cycle, and the words of a hole.

use ncc_dialects::REPEAT_WORD;
use ncc_ir::canon::{Distance, Fact};
use ncc_ir::diag::Fault;
use ncc_ir::program::{Move, Op, Stmt};

use super::Writer;
use crate::common::Sink;
use crate::common::block::Part;

impl Writer {
    /// The letter of repetitions, where the dictionary alone says it.
    fn repeat_letter(&self) -> Option<u8> {
        let open = self.dialect.option.iter().any(|row| row.name == REPEAT_WORD);
        let letter =
            self.words.settings.repeat_word().filter(|_| !open || self.words.settings.is_chosen(REPEAT_WORD));
        letter.filter(|_| self.dialect.cycles.hole_on_definition).map(|letter| letter as u8)
    }

    /// So many blocks after a block of the source make its hole again, each by the same increments: one word of the
    /// source made them.
    pub(super) fn equal_holes(&self, stmts: &[Stmt], at: usize, end: usize) -> usize {
        let Some(Stmt { op: Op::Hole(to), span, skip, comment: None, .. }) = stmts[at..end].last() else {
            return 0;
        };
        let mut words = to.to.axes.iter().flatten();
        if to.to.is_empty() || words.any(|word| word.distance != Fact::Known(Distance::Incremental)) {
            return 0;
        }
        let equal = stmts[end..].iter().take_while(|stmt| {
            let same = matches!(&stmt.op, Op::Hole(again) if again.to == to.to);
            same && stmt.span == *span
                && stmt.skip == *skip
                && !stmt.joined
                && stmt.number.is_none()
                && stmt.comment.is_none()
        });
        let joined = |count: usize| stmts.get(end + count).is_some_and(|stmt| stmt.joined);
        let count = equal.count();
        let count = count - usize::from(count > 0 && joined(count));
        if self.repeat_letter().is_some() { count } else { 0 }
    }

    /// A hole, and those that its block makes again.
    pub(super) fn holes(&mut self, to: &Move, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        let repeats = std::mem::take(&mut self.repeats);
        self.hole(to, stmt, sink)?;
        if let Some(letter) = self.repeat_letter().filter(|_| repeats > 0) {
            self.words.block.digits(Part::Tail, letter, &(repeats + 1).to_string());
        }
        Ok(())
    }
}
