//! The vocabulary of the canonical machining functions: axes, planes and modes.
//!
//! Names follow NIST (Proctor, Kramer & Michaloski 1997; Kramer & Proctor 1998) where it has one.

/// Number of axes that a program can name.
pub const AXES: usize = 6;

/// Whether two points are the same. As fast as can be: `==` on arrays calls the library.
#[inline]
pub fn same_point(a: &[i64; AXES], b: &[i64; AXES]) -> bool {
    a.iter().zip(b).fold(0, |differing, (a, b)| differing | (a ^ b)) == 0
}

/// An axis. X Y Z are linear, A B C turn about them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs)] // The names are the meaning.
pub enum Axis {
    X,
    Y,
    Z,
    A,
    B,
    C,
}

impl Axis {
    /// All axes, in the order in which functions take them.
    pub const ALL: [Axis; AXES] = [Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::B, Axis::C];

    /// Its address letter.
    pub const fn letter(self) -> u8 {
        b"XYZABC"[self as usize]
    }

    /// Whether it turns (its coordinate is in degrees).
    pub const fn is_rotary(self) -> bool {
        matches!(self, Axis::A | Axis::B | Axis::C)
    }

    /// The axis of an address letter.
    pub const fn from_letter(letter: u8) -> Option<Axis> {
        Some(match letter {
            b'X' => Axis::X,
            b'Y' => Axis::Y,
            b'Z' => Axis::Z,
            b'A' => Axis::A,
            b'B' => Axis::B,
            b'C' => Axis::C,
            _ => return None,
        })
    }
}

/// The plane of arcs and the two axes of hole positions; its normal is the drilling axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Plane {
    /// X then Y, normal Z.
    Xy,
    /// Z then X, normal Y: a turn that looks counter-clockwise from +Y goes from Z to X.
    Zx,
    /// Y then Z, normal X.
    Yz,
}

impl Plane {
    /// First and second axis, then the normal; right-handed.
    pub const fn axes(self) -> (Axis, Axis, Axis) {
        match self {
            Plane::Xy => (Axis::X, Axis::Y, Axis::Z),
            Plane::Zx => (Axis::Z, Axis::X, Axis::Y),
            Plane::Yz => (Axis::Y, Axis::Z, Axis::X),
        }
    }
}

/// How a coordinate is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Distance {
    /// From program zero.
    Absolute,
    /// From where the axis stands.
    Incremental,
}

/// Units of length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Units {
    /// Millimetres.
    Mm,
    /// Inches.
    Inch,
}

/// What a feed word counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FeedMode {
    /// Length a minute.
    PerMinute,
    /// Length a turn of the spindle.
    PerRevolution,
    /// One over the minutes that the move takes.
    InverseTime,
}

/// Where a canned cycle leaves the tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ReturnLevel {
    /// The drilling axis' position when the cycle was called up.
    Initial,
    /// The retract plane R.
    Retract,
}

/// Sense of an arc, seen from the positive end of the plane's normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // The names are the meaning.
pub enum Turn {
    Clockwise,
    Counterclockwise,
}

/// State of the spindle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // The names are the meaning.
pub enum Spindle {
    #[default]
    Stopped,
    Clockwise,
    Counterclockwise,
}

/// What axis words without a motion code do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Motion {
    /// Rapid.
    Traverse,
    /// Straight line at feed.
    Feed,
    /// Arc.
    Arc(Turn),
    /// A hole of the cycle in force.
    Cycle,
}

/// A modal fact that a statement depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fact<T> {
    /// The program has said it before, whichever way it came here.
    Known(T),
    /// Whatever is in force when the statement runs: the caller's, or the control's at power-on.
    Entry,
}

impl<T> Fact<T> {
    /// The value, or `in_force` where the program has not said it.
    pub fn or(self, in_force: T) -> T {
        match self {
            Fact::Known(value) => value,
            Fact::Entry => in_force,
        }
    }

    /// The value, if the program has said it.
    pub fn known(self) -> Option<T> {
        match self {
            Fact::Known(value) => Some(value),
            Fact::Entry => None,
        }
    }
}

impl<T> From<Option<T>> for Fact<T> {
    fn from(value: Option<T>) -> Fact<T> {
        value.map_or(Fact::Entry, Fact::Known)
    }
}

/// Modal facts: `None` means not known. One type for what a control has at power-on, what a program
/// has said so far, and what a translation took for granted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Modes {
    /// What bare axis words do.
    pub motion: Option<Motion>,
    /// Absolute or incremental.
    pub distance: Option<Distance>,
    /// Units of length words and of the feed.
    pub units: Option<Units>,
    /// Plane of arcs and of hole positions.
    pub plane: Option<Plane>,
    /// What a feed word counts.
    pub feed_mode: Option<FeedMode>,
    /// Where a canned cycle leaves the tool.
    pub return_level: Option<ReturnLevel>,
    /// Work offset in force: 1 is the first (G54 on a Fanuc).
    pub work_offset: Option<u16>,
    /// Entry of the tool-length table in force; 0 is none.
    pub length_offset: Option<u32>,
    /// Whether there is no temporary shift of the origin (`true`), or one may be left over.
    pub no_origin_shift: Option<bool>,
}

impl Modes {
    /// These facts; where one is not known, the other's.
    pub fn or(self, other: Modes) -> Modes {
        Modes {
            motion: self.motion.or(other.motion),
            distance: self.distance.or(other.distance),
            units: self.units.or(other.units),
            plane: self.plane.or(other.plane),
            feed_mode: self.feed_mode.or(other.feed_mode),
            return_level: self.return_level.or(other.return_level),
            work_offset: self.work_offset.or(other.work_offset),
            length_offset: self.length_offset.or(other.length_offset),
            no_origin_shift: self.no_origin_shift.or(other.no_origin_shift),
        }
    }
}

impl Turn {
    /// The spindle turning in this sense.
    pub const fn spindle(self) -> Spindle {
        match self {
            Turn::Clockwise => Spindle::Clockwise,
            Turn::Counterclockwise => Spindle::Counterclockwise,
        }
    }

    /// The other sense.
    pub const fn back(self) -> Turn {
        match self {
            Turn::Clockwise => Turn::Counterclockwise,
            Turn::Counterclockwise => Turn::Clockwise,
        }
    }
}
