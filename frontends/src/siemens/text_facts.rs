//! What a text has said so far, wherever: facts that hold for all of it.
//!
//! Not here: what holds at the block that is read (`siemens_state`).

use ncc_ir::source::Span;

/// What the text has said of surface speeds.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Surfaces {
    /// Whether any was in force so far.
    pub(super) met: bool,
    /// Whether a code of the feed stood where it is not known what a speed counts, before the first one.
    pub(super) doubted: bool,
}

/// The one value that a whole text says of a fact, for where the fact is lost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Only<T> {
    pub(super) value: Option<T>,
    pub(super) mixed: bool,
    /// The first place that relied on there being one value.
    pub(super) relied: Option<Span>,
}

impl<T> Default for Only<T> {
    fn default() -> Only<T> {
        Only { value: None, mixed: false, relied: None }
    }
}

impl<T: Copy + PartialEq> Only<T> {
    /// The text says it; gives a place that relied on another value.
    pub(super) fn see(&mut self, value: T) -> Option<Span> {
        if *self.value.get_or_insert(value) == value {
            return None;
        }
        self.mixed = true;
        self.relied.take()
    }

    /// Blocks may run under a value that the text does not say.
    pub(super) fn open(&mut self) {
        self.mixed = true;
    }

    /// The value, if there is only one; `otherwise` if the text has said none.
    pub(super) fn rely(&mut self, otherwise: Option<T>, at: Span) -> Option<T> {
        if self.mixed {
            return None;
        }
        let value = self.value.or(otherwise)?;
        // A later one that differs is found by it.
        self.value = Some(value);
        self.relied.get_or_insert(at);
        Some(value)
    }
}
