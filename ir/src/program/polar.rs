//! Points of the plane by radius and angle about a pole.
//!
//! Not here: where they are (`polar`).

use super::{Coord, Op};
use crate::canon::{Fact, Plane};
use crate::expr::Expr;

/// From where a pole is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PoleFrom {
    /// Program zero.
    Zero,
    /// Tool position.
    Here,
    /// The pole before.
    Pole,
}

/// How far a pole is from there.
#[derive(Clone, Debug, PartialEq)]
pub enum PoleWords {
    /// Along X, Y and Z, of which the two of the plane count; one that is missing is 0.
    Along(Box<[Option<Expr>; 3]>),
    /// By radius and angle.
    Polar {
        /// Length, not negative.
        radius: Expr,
        /// Degrees from the first axis of the plane, counter-clockwise positive.
        angle: Expr,
    },
}

/// `SET_POLE`: about which point the polar words that follow are; radius and angle of the words
/// before are forgotten. Before the first one it is program zero.
#[derive(Clone, Debug, PartialEq)]
pub struct SetPole {
    /// The plane.
    pub plane: Fact<Plane>,
    /// From where it is measured.
    pub from: PoleFrom,
    /// Its words.
    pub at: PoleWords,
}

/// `POLAR`: a move to a point of the plane by radius and angle about the active pole, or along a line by
/// its angle.
#[derive(Clone, Debug, PartialEq)]
pub struct Polar {
    /// The plane.
    pub plane: Fact<Plane>,
    /// Length from the pole, not negative; an increment is added to the last one. Without, the last
    /// one counts.
    pub radius: Option<Coord>,
    /// Degrees from the first axis of the plane, counter-clockwise positive; likewise.
    pub angle: Option<Coord>,
    /// Whether the point lies on the line that leaves where the tool is at `angle`, there where the one
    /// word of the plane in the move says; the pole has nothing to do with it.
    pub along: bool,
    /// The move: a line, an arc, a hole or a position. Its point has no words of the plane, but for a line
    /// by its angle.
    pub op: Op,
}
