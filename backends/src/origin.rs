//! Where emitted lines come from: for every line the places of the source that it was written from.
//!
//! Recorded only where somebody asks for it, block by block: what a block of the source has written is
//! its own; what it has left to be written later (the call of a cycle before its first hole, settings
//! that the safe start gathers) goes with the lines that come next. Lines are counted by their ends, so
//! that nothing depends on how their characters are encoded.
//!
//! Not here: what the lines mean, and what is done with the record.

use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;

/// Most places that wait for lines; of more, neighbours are reported as one.
const MOST_CARRIED: usize = 256;

/// Lines that follow one another and come from the same places.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Origin {
    /// How many lines.
    pub lines: u32,
    /// The places, in the order of the text; the last one is the block that was being written. Empty for
    /// what the source does not say: frames, a safe start of facts assumed.
    pub spans: Vec<Span>,
}

/// The record while it is made.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trace {
    /// The block that is being written: places of its statements, those that touch as one.
    current: Vec<Span>,
    /// Whether what it leaves unwritten has an effect later.
    lasting: bool,
    /// Blocks that have written nothing yet.
    carried: Vec<Span>,
    /// Bytes of the text of which the lines are counted.
    counted: usize,
    /// Bytes of the text that waits after a safe start of which the lines are counted.
    held_counted: usize,
    /// Lines that wait there.
    held: Vec<Origin>,
    /// Lines of the text.
    found: Vec<Origin>,
}

impl Trace {
    /// More is added to a text of this length.
    pub(crate) fn begin(&mut self, len: usize) {
        self.counted = len;
    }

    /// The record since this was last asked.
    pub(crate) fn take(&mut self) -> Vec<Origin> {
        std::mem::take(&mut self.found)
    }

    /// A block of the source begins; gives the one that it stands in.
    pub(crate) fn enter(&mut self, block: &[Stmt]) -> Vec<Span> {
        let outer = std::mem::take(&mut self.current);
        let silent = |s: &Stmt| matches!(s.op, Op::Comment(_) | Op::Blank | Op::NoEffect(_));
        self.lasting = !block.iter().all(silent);
        for stmt in block {
            self.join(stmt.span);
        }
        outer
    }

    /// Back in the block that others stand in.
    pub(crate) fn leave(&mut self, outer: Vec<Span>) {
        self.current = outer;
    }

    /// A further statement of the block.
    pub(crate) fn join(&mut self, span: Span) {
        if span.start >= span.end {
            return;
        }
        match self.current.iter_mut().find(|own| own.start <= span.end && span.start <= own.end) {
            Some(own) => *own = own.to(span),
            None => self.current.push(span),
        }
    }

    /// The block is written, to the text or to what is held back.
    pub(crate) fn wrote(&mut self, out: &[u8], held: &[u8]) {
        let before = (self.found.len(), self.held.len());
        self.held_so_far(held);
        self.so_far(out);
        if before == (self.found.len(), self.held.len()) && self.lasting {
            for span in std::mem::take(&mut self.current) {
                self.carry(span);
            }
        }
        self.current.clear();
    }

    /// Lines that the block has written so far.
    pub(crate) fn so_far(&mut self, out: &[u8]) {
        let lines = ends(out, &mut self.counted);
        if lines > 0 {
            let mut spans = std::mem::take(&mut self.carried);
            spans.retain(|span| !self.current.contains(span));
            spans.extend_from_slice(&self.current);
            self.found.push(Origin { lines, spans });
        }
    }

    /// Lines that the block has written so far to what is held back.
    pub(crate) fn held_so_far(&mut self, held: &[u8]) {
        let lines = ends(held, &mut self.held_counted);
        if lines > 0 {
            self.held.push(Origin { lines, spans: self.current.clone() });
        }
    }

    /// The safe start is written, and what was held back is about to follow.
    pub(crate) fn started(&mut self, out: &[u8], held: &[u8]) {
        let lines = ends(out, &mut self.counted);
        if lines > 0 {
            let spans = std::mem::take(&mut self.carried);
            self.found.push(Origin { lines, spans });
        }
        self.held_so_far(held);
        self.found.append(&mut self.held);
        self.counted += held.len();
        self.held_counted = 0;
    }

    /// Lines that no block has written: frames.
    pub(crate) fn frame(&mut self, out: &[u8]) {
        let lines = ends(out, &mut self.counted);
        if lines > 0 {
            self.found.push(Origin { lines, spans: Vec::new() });
        }
    }

    fn carry(&mut self, span: Span) {
        let full = self.carried.len() >= MOST_CARRIED;
        match self.carried.last_mut() {
            Some(last) if *last == span => {}
            Some(last) if full => *last = last.to(span),
            Some(_) | None => self.carried.push(span),
        }
    }
}

/// Line ends of a text from a place on, which is moved after them.
fn ends(text: &[u8], from: &mut usize) -> u32 {
    let fresh = text.get(*from..).unwrap_or_default();
    *from = text.len();
    fresh.iter().filter(|byte| **byte == b'\n').count() as u32
}
