//! Axes that a change of frame waits for.

use ncc_ir::canon::{AXES, Distance};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::Coord;

use super::LINEAR;

/// Axes without a word since a change, and how words may be measured.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Pending {
    /// Where the program had put each before it, if that is known.
    pub(super) axes: [Option<Option<Nanos>>; AXES],
    /// Whether words without a distance of their own may be absolute, and whether they may be incremental.
    pub(super) measured: [bool; 2],
    /// Axes of the planes in which rotations may be active.
    pub(super) rotated: [bool; AXES],
}

impl Pending {
    pub(super) fn any(&self) -> bool {
        self.axes != [None; AXES]
    }

    /// Which axes, and nothing of where they were.
    pub(super) fn bits(&self) -> Pending {
        Pending { axes: self.axes.map(|axis| axis.map(|_| None)), ..self.clone() }
    }

    /// Whatever may be.
    pub(super) const ANYTHING: Pending =
        Pending { axes: [Some(None); AXES], measured: [true; 2], rotated: LINEAR };

    /// Notes how words without a distance of their own are measured; `None` is not known.
    pub(super) fn measure(&mut self, distance: Option<Distance>, maybe: bool) {
        let now = match distance {
            Some(Distance::Absolute) => [true, false],
            Some(Distance::Incremental) => [false, true],
            None => [true; 2],
        };
        let before = self.measured;
        self.measured = std::array::from_fn(|way| now[way] || maybe && before[way]);
    }

    /// Whether a word is incremental on every path. Where that is not the same on all, it stays as it is, and execution
    /// judges it.
    pub(super) fn is_relative(&self, word: &Coord) -> bool {
        match word.distance.known() {
            Some(distance) => distance == Distance::Incremental,
            None => self.measured == [false, true],
        }
    }

    /// Whether a word may be incremental.
    pub(super) fn may_be_relative(&self, word: &Coord) -> bool {
        match word.distance.known() {
            Some(distance) => distance == Distance::Incremental,
            None => self.measured[1],
        }
    }
}
