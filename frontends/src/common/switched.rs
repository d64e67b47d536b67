//! What a text has switched on.

use super::known::Know;

/// What a text has stated so far of something that can be on, wherever it was stated.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Met {
    /// Whether it was switched on.
    on: bool,
    /// Whether an end was taken for none, because it was never switched on before.
    taken_for_none: bool,
}

impl Met {
    /// Whether an end counts: it is on, or may be.
    pub(crate) fn ends(&mut self, now: Know<bool>) -> bool {
        match now {
            Know::Said(on) | Know::Taken(on) => on,
            Know::Unsaid => false,
            Know::Lost | Know::Open | Know::Callers => {
                self.taken_for_none |= !self.on;
                self.on
            }
        }
    }

    /// It is switched on; `false` if an end before was taken for none that may have been one.
    pub(crate) fn starts(&mut self) -> bool {
        self.on = true;
        !self.taken_for_none
    }
}
