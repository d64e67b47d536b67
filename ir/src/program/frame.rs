//! Between a program's coordinates and its work offset: the slots of the coordinate chain, and the steps
//! of the chain of frames.
//!
//! Not here: what they amount to (`exec`).

use super::Coord;
use crate::canon::{AXES, Axis, Fact, Plane};
use crate::expr::Expr;

/// A named slot of the coordinate chain, from the machine towards the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FrameSlot {
    /// A temporary re-definition of program zero.
    Shift,
    /// A local shift.
    Local,
    /// Rotation in the plane.
    Rotation,
    /// Scale factors.
    Scale,
    /// Mirror about a point or line.
    Mirror,
    /// Polar words.
    Polar,
    /// Tilted working plane.
    Tilt,
    /// Frames chained freely, last one innermost.
    Chain,
}

impl FrameSlot {
    /// All slots.
    pub const ALL: [FrameSlot; 8] = [
        FrameSlot::Shift,
        FrameSlot::Local,
        FrameSlot::Rotation,
        FrameSlot::Scale,
        FrameSlot::Mirror,
        FrameSlot::Polar,
        FrameSlot::Tilt,
        FrameSlot::Chain,
    ];
}

/// What a slot of the coordinate chain is given. From the machine towards the program:
/// work offset, [`FrameSlot::Shift`], [`FrameSlot::Local`], rotation, scale, mirror, chain. The centre
/// of a rotation is scaled and mirrored like any point, and an odd number of mirrors in its plane turns
/// its sense round.
#[derive(Clone, Debug, PartialEq)]
pub enum Slot {
    /// `SET_SHIFT`: each axis named has this shift from here on, the others keep theirs.
    Shift {
        /// Whether it is that of the origin ([`FrameSlot::Shift`]); else the local one.
        origin: bool,
        /// The shifts, of which zero is none.
        axes: Box<[Option<Expr>; AXES]>,
    },
    /// `SET_ROTATION`
    Rotation {
        /// Its plane.
        plane: Fact<Plane>,
        /// From program zero along X, Y and Z, of which the two of the plane count; one that is missing
        /// is where the tool is.
        centre: Box<[Option<Expr>; 3]>,
        /// Degrees, counter-clockwise positive; an increment is added to the active angle.
        angle: Coord,
    },
    /// `SET_SCALE`
    Scale {
        /// From program zero along X, Y and Z; one that is missing is where the tool is.
        centre: Box<[Option<Expr>; 3]>,
        /// Factors along X, Y and Z, more than zero; one that is missing is 1.
        factors: Box<[Option<Expr>; 3]>,
    },
    /// `SET_MIRROR`: each axis named is mirrored at this place from here on.
    Mirror(Box<[Option<Expr>; 3]>),
    /// `CLEAR_MIRROR`: the axes named are mirrored no more.
    NoMirror([bool; 3]),
    /// `SET_TILT`: points are those of a plane that is turned in space.
    Tilt(Box<Tilt>),
}

/// A tilted working plane. From the machine towards the program it lies directly inside the shifts; no
/// other slot is filled with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Tilt {
    /// Its zero, in the coordinates that are active without it; one that is missing is 0.
    pub origin: [Option<Expr>; 3],
    /// The axes about which it is turned, one after the other: each is the one that the turns before have
    /// made of it.
    pub about: [Axis; 3],
    /// By how many degrees, counter-clockwise positive.
    pub angles: [Expr; 3],
}

/// Which of the two ways of turning the tool into an orientation, as the machine's maker has numbered them
/// by the sense of one of the rotary axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // The names are the meaning.
pub enum Toward {
    Minus,
    Plus,
}

impl Toward {
    /// Its name in text.
    pub const fn name(self) -> &'static str {
        match self {
            Toward::Minus => "minus",
            Toward::Plus => "plus",
        }
    }
}

impl Slot {
    /// The upper-case name in text of a statement that sets it.
    pub const fn name(&self) -> &'static str {
        match self {
            Slot::Shift { .. } => "SET_SHIFT",
            Slot::Rotation { .. } => "SET_ROTATION",
            Slot::Scale { .. } => "SET_SCALE",
            Slot::Mirror(_) => "SET_MIRROR",
            Slot::NoMirror(_) => "CLEAR_MIRROR",
            Slot::Tilt(_) => "SET_TILT",
        }
    }
}

/// A step of the chain of frames: what it does to the coordinates that follow.
#[derive(Clone, Debug, PartialEq)]
pub struct Frame {
    /// Whether it is appended as the innermost step; else it replaces the chain.
    pub added: bool,
    /// What it does.
    pub step: FrameStep,
}

/// What a step of the chain of frames does.
#[derive(Clone, Debug, PartialEq)]
pub enum FrameStep {
    /// Moves the origin.
    Translate(Box<[Option<Expr>; AXES]>),
    /// Turns in the plane, degrees, counter-clockwise positive.
    Rotate {
        /// The plane.
        plane: Fact<Plane>,
        /// The angle.
        angle: Expr,
    },
    /// Factors along X, Y and Z.
    Scale(Box<[Option<Expr>; 3]>),
    /// Turns the axis round: X, Y, Z.
    Mirror([bool; 3]),
}
