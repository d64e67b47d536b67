//! The one value that a whole text says of a mode, for where the mode is lost.

use ncc_ir::source::Span;

/// The one value that a whole text says of a fact, for where the fact is lost.
#[derive(Clone, Copy, Debug)]
pub(crate) struct OnlyValue<T> {
    value: Option<T>,
    mixed: bool,
    /// The first place that relied on there being one value.
    relied: Option<Span>,
}

impl<T> Default for OnlyValue<T> {
    fn default() -> OnlyValue<T> {
        OnlyValue { value: None, mixed: false, relied: None }
    }
}

impl<T: Copy + PartialEq> OnlyValue<T> {
    /// The text says it; gives a place that relied on another value.
    pub(crate) fn see(&mut self, value: T) -> Option<Span> {
        if *self.value.get_or_insert(value) == value {
            return None;
        }
        self.mixed = true;
        self.relied.take()
    }

    /// Blocks may run under this value, or under one that the text does not say; gives what [`Self::see`] does.
    pub(crate) fn see_or_open(&mut self, value: Option<T>) -> Option<Span> {
        self.mixed |= value.is_none();
        self.see(value?)
    }

    /// The value, if there is only one; `otherwise` if the text has said none.
    pub(crate) fn rely(&mut self, otherwise: Option<T>, at: Span) -> Option<T> {
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
