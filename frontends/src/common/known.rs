//! What is known of a modal fact.

use ncc_ir::canon::Fact;

/// What is known of a modal fact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) enum Know<T> {
    /// The program has not said it.
    #[default]
    Unsaid,
    /// The program has said it.
    Said(T),
    /// The program relies on it and never said it: assumed.
    Taken(T),
    /// Said on some way to here, or by somebody else.
    Lost,
    /// The program has not said it up to a place that is a jump target: the first time here it is as the
    /// program began, and any other time perhaps not.
    Open,
    /// A subprogram has not said it: it is as its caller leaves it.
    Callers,
}

impl<T: Copy> Know<T> {
    /// The fact, without taking anything for granted.
    pub(crate) fn fact(self) -> Fact<T> {
        match self {
            Know::Said(value) | Know::Taken(value) => Fact::Known(value),
            Know::Unsaid | Know::Lost | Know::Open | Know::Callers => Fact::Entry,
        }
    }

    /// Whether what relies on it relies on how the program begins.
    pub(crate) fn unsaid(self) -> bool {
        matches!(self, Know::Unsaid | Know::Open)
    }

    /// Takes a value for granted.
    pub(crate) fn take(&mut self, value: T) {
        *self = if matches!(self, Know::Open) { Know::Lost } else { Know::Taken(value) };
    }

    pub(crate) fn value(self) -> Option<T> {
        self.fact().known()
    }
}

impl<T> Know<T> {
    /// A refused block may have said it: it is not reported as missing.
    pub(crate) fn forgive(&mut self) {
        if matches!(self, Know::Unsaid) {
            *self = Know::Lost;
        }
    }

    /// What is known where control may come from elsewhere.
    pub(crate) fn lost(self) -> Know<T> {
        match self {
            Know::Unsaid | Know::Open => Know::Open,
            Know::Callers => Know::Callers,
            Know::Said(_) | Know::Taken(_) | Know::Lost => Know::Lost,
        }
    }
}

impl<T: PartialEq> Know<T> {
    /// What is known after a block that may have been skipped; `before` is what was before it.
    pub(crate) fn join(&mut self, before: Know<T>) {
        // What was assumed in the block holds without it as well.
        let taken = matches!((&before, &self), (Know::Unsaid, Know::Taken(_)));
        if *self != before && !taken {
            *self = Know::Lost;
        }
    }
}
