//! A translation of each axis that may not be known.

use crate::canon::AXES;
use crate::expr::num::Nanos;

/// By how much each axis is shifted, as far as it is known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Shifted {
    by: [Nanos; AXES],
    lost: [bool; AXES],
}

impl Shifted {
    /// Nothing is known.
    pub const LOST: Shifted = Shifted { by: [0; AXES], lost: [true; AXES] };

    /// By how much an axis is shifted.
    pub(super) fn at(&self, axis: usize) -> Option<Nanos> {
        (!self.lost[axis]).then_some(self.by[axis])
    }

    /// Another shift of an axis; how much more it is, if both are known.
    pub(super) fn to(&mut self, axis: usize, to: Option<Nanos>) -> Option<Nanos> {
        let more = to.zip(self.at(axis)).and_then(|(to, from)| to.checked_sub(from));
        (self.by[axis], self.lost[axis]) = (to.unwrap_or_default(), to.is_none());
        more
    }

    /// What is known on both of two ways.
    pub(super) fn join(&mut self, other: &Shifted) {
        for axis in 0..AXES {
            self.lost[axis] |= other.lost[axis] || self.by[axis] != other.by[axis];
        }
    }
}
