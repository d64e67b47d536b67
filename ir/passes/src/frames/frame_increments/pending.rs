//! Axes without a word since the last change of frame, and the distance modes that may be active.
//!
//! After `TRANS X100`, X and all other axes are pending. The next X word clears X.
//! The pass rewrites or refuses an incremental word of a pending axis.
//!
//! Not here: the changes that make an axis pending, and the rewriting (`frame_increments`).

use ncc_ir::canon::{AXES, Distance};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::Coord;

use super::LINEAR;

/// Pending axes at one point of the program, and the distance modes that may be active there.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Pending {
    /// Per axis: `None` is not pending. `Some` is pending, with the position before the change, in nanos, if the
    /// pass knows it.
    pub(super) axes: [Option<Option<Nanos>>; AXES],
    /// Distance modes that may be active: `[absolute, incremental]`.
    pub(super) measured: [bool; 2],
    /// Axes of the planes that a rotation may turn.
    pub(super) rotated: [bool; AXES],
}

impl Pending {
    pub(super) fn any(&self) -> bool {
        self.axes != [None; AXES]
    }

    /// The same pending axes without their positions before the change.
    pub(super) fn bits(&self) -> Pending {
        Pending { axes: self.axes.map(|axis| axis.map(|_| None)), ..self.clone() }
    }

    /// The least that the pass can know: every axis pending, both distance modes possible.
    pub(super) const ANYTHING: Pending =
        Pending { axes: [Some(None); AXES], measured: [true; 2], rotated: LINEAR };

    /// Notes the active distance mode; `None` allows both. With `maybe`, the modes noted before stay possible
    /// (a block with block skip).
    pub(super) fn measure(&mut self, distance: Option<Distance>, maybe: bool) {
        let now = match distance {
            Some(Distance::Absolute) => [true, false],
            Some(Distance::Incremental) => [false, true],
            None => [true; 2],
        };
        let before = self.measured;
        self.measured = std::array::from_fn(|way| now[way] || maybe && before[way]);
    }

    /// Whether a word is incremental on every path. If paths differ, the pass keeps the word, and verification
    /// judges it.
    pub(super) fn is_relative(&self, word: &Coord) -> bool {
        match word.distance.known() {
            Some(distance) => distance == Distance::Incremental,
            None => self.measured == [false, true],
        }
    }

    /// Whether a word is incremental on at least one path.
    pub(super) fn may_be_relative(&self, word: &Coord) -> bool {
        match word.distance.known() {
            Some(distance) => distance == Distance::Incremental,
            None => self.measured[1],
        }
    }
}
