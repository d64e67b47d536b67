//! A stream of records, of which a window is kept.

use ncc_exec::Kind;
use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;

use crate::record::{Batch, Record, Style};

/// A stream of records.
pub struct Tape<'t> {
    next: Box<dyn FnMut() -> Option<Batch> + 't>,
    records: Vec<Record>,
    /// Records that are behind.
    from: usize,
    pub(crate) over: bool,
    /// With what records are done.
    pub styles: Vec<Style>,
    /// Messages, functions and other events of which a record has the place in this list.
    pub kept: Vec<Kind>,
    /// Positions of the axes before the next record, machine coordinates. The value of an axis that has not moved yet means nothing.
    pub(crate) position: [Nanos; AXES],
}

impl<'t> Tape<'t> {
    /// A stream that comes in pieces; `None` is its end.
    pub fn new(next: Box<dyn FnMut() -> Option<Batch> + 't>) -> Tape<'t> {
        Tape {
            next,
            records: Vec::new(),
            from: 0,
            over: false,
            styles: Vec::new(),
            kept: Vec::new(),
            position: [0; AXES],
        }
    }

    /// Reads on until `wanted` records are at hand, or the stream ends; gives how many there are.
    pub(crate) fn fill(&mut self, wanted: usize) -> usize {
        while self.records.len() - self.from < wanted && !self.over {
            match (self.next)() {
                Some(batch) => {
                    if self.from > 0 {
                        self.records.drain(..self.from);
                        self.from = 0;
                    }
                    self.records.extend(batch.records);
                    self.styles.extend(batch.styles);
                    self.kept.extend(batch.kept);
                }
                None => self.over = true,
            }
        }
        self.records.len() - self.from
    }

    pub(crate) fn window(&self) -> &[Record] {
        &self.records[self.from..]
    }

    pub(crate) fn advance(&mut self, by: usize) {
        if let Some(last) = by.checked_sub(1).and_then(|last| self.window().get(last)).copied() {
            self.position = self.place(&last);
        }
        self.from += by;
    }

    /// Where a record's tool stands after it.
    pub fn place(&self, record: &Record) -> [Nanos; AXES] {
        match self.styles.get(record.style as usize) {
            Some(style) => record.place(style),
            None => [0; AXES],
        }
    }
}
