//! Packed moves that a run has come to, unpacked some at a time.
//!
//! Not here: where they are executed once for two runs (the verification).

use ncc_ir::program::Stmt;
use ncc_ir::program::packed::PackedLines;
use ncc_ir::program::packing::Unpack;
use ncc_ir::source::Span;

/// So many are unpacked at once: few enough that they stay in the second-level cache.
const AT_ONCE: usize = 512;

/// Those that are unpacked, and how many of them are executed.
#[derive(Clone, Debug, Default)]
pub(crate) struct LinesAhead<'p> {
    rest: Option<Unpack<'p>>,
    now: Vec<Stmt>,
    done: usize,
}

impl<'p> LinesAhead<'p> {
    /// Some of those that come next; none is the end.
    #[inline]
    pub(crate) fn of(&mut self, lines: &'p PackedLines) -> &[Stmt] {
        if self.done == self.now.len() {
            let rest = self.rest.get_or_insert_with(|| lines.unpack());
            self.now.clear();
            self.done = 0;
            self.now.extend(rest.by_ref().take(AT_ONCE));
        }
        &self.now[self.done..]
    }

    /// The same, as they are unpacked.
    pub(crate) fn unpacked(&self) -> &[Stmt] {
        &self.now[self.done..]
    }

    /// So many more are executed.
    pub(crate) fn pass(&mut self, many: usize) {
        self.done += many;
    }

    /// The next one, which is executed then.
    #[inline]
    pub(crate) fn take(&mut self) -> Option<&Stmt> {
        let next = self.now.get(self.done);
        self.done += usize::from(next.is_some());
        next
    }

    /// All of them are executed.
    pub(crate) fn leave(&mut self) {
        *self = LinesAhead { now: std::mem::take(&mut self.now), ..LinesAhead::default() };
        self.now.clear();
    }

    /// The place of the one that was executed last.
    pub(crate) fn last(&self) -> Option<Span> {
        let last = self.done.checked_sub(1).and_then(|at| self.now.get(at));
        last.map(|stmt| stmt.span)
    }
}
