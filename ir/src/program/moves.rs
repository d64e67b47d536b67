//! Where a move goes: words of axes, points, pitches of threads, and how corners are taken.

use crate::canon::{AXES, Axis, Distance, Fact, PathMode, Turn};
use crate::expr::Expr;

/// A coordinate word.
#[derive(Clone, Debug, PartialEq)]
pub struct Coord {
    /// Its value.
    pub value: Expr,
    /// From where it is measured.
    pub distance: Fact<Distance>,
}

/// The axis words of a move; an axis without a word stays where it is.
#[derive(Debug, Default, PartialEq)]
pub struct Point {
    /// One place per axis, in the order of [`Axis::ALL`].
    pub axes: [Option<Coord>; AXES],
}

/// Most points name one or two axes of the six: only those are copied.
impl Clone for Point {
    #[inline]
    fn clone(&self) -> Point {
        let mut copy = Point::default();
        for (to, from) in copy.axes.iter_mut().zip(&self.axes) {
            if let Some(word) = from {
                *to = Some(word.clone());
            }
        }
        copy
    }
}

impl Point {
    /// The word of an axis.
    #[inline]
    pub fn get(&self, axis: Axis) -> Option<&Coord> {
        self.axes[axis as usize].as_ref()
    }

    /// Sets the word of an axis.
    pub fn set(&mut self, axis: Axis, coord: Coord) {
        self.axes[axis as usize] = Some(coord);
    }

    /// Whether no axis has a word.
    pub fn is_empty(&self) -> bool {
        self.axes.iter().all(Option::is_none)
    }
}

/// A straight move, or hole position.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Move {
    /// End point, in program coordinates.
    pub to: Point,
    /// Whether the block itself says the motion code. A back-end that inherits it need not.
    pub said: bool,
}

/// A straight spindle-synchronised move, as threads are cut.
#[derive(Clone, Debug, PartialEq)]
pub struct Synchronised {
    /// End point, in program coordinates.
    pub to: Point,
    /// How far the axis goes in a turn.
    pub pitch: Pitch,
    /// Whether feed and spindle each go on their own, and a compensating chuck makes good what they
    /// are apart.
    pub chuck: bool,
    /// The sense in which the control turns the spindle for this move, to hold it after; without, it
    /// turns as it does.
    pub turn: Option<Turn>,
    /// Whether it comes back to where it began, the spindle turned round for the way back and turning as
    /// before after it.
    pub back: bool,
}

/// How far an axis goes in one turn of the spindle.
#[derive(Clone, Debug, PartialEq)]
pub enum Pitch {
    /// So far, positive.
    Stated(Expr),
    /// As feed and speed active say.
    Feed,
}

/// How corners are taken from here on.
#[derive(Clone, Debug, PartialEq)]
pub struct PathControl {
    /// The mode.
    pub mode: PathMode,
    /// How far from a corner, or from the path, where the mode says that.
    pub within: Option<Expr>,
    /// The same for rapids, where it is another one.
    pub rapids: Option<Expr>,
    /// How far from their common line straight moves at one feed may lie that the control makes one, where it
    /// is another length than `within`; 0 is not at all.
    pub merged: Option<Expr>,
}

impl PathControl {
    /// A mode without lengths of its own.
    pub fn plain(mode: PathMode) -> PathControl {
        PathControl { mode, within: None, rapids: None, merged: None }
    }
}
