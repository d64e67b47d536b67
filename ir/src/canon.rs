//! The vocabulary of the canonical machining functions: axes, planes and modes.
//!
//! Names follow NIST (Proctor, Kramer & Michaloski 1997; Kramer & Proctor 1998) where it has one.

/// Number of axes that a program can name.
pub const AXES: usize = 6;

/// Whether two points are equal. A fast comparison: `==` on arrays calls the library.
#[inline]
pub fn same_point(a: &[i64; AXES], b: &[i64; AXES]) -> bool {
    (0..AXES).fold(0, |differing, axis| differing | (a[axis] ^ b[axis])) == 0
}

/// An axis. X Y Z are linear, A B C are rotary.
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
    /// All axes, in the order of arguments.
    pub const ALL: [Axis; AXES] = [Axis::X, Axis::Y, Axis::Z, Axis::A, Axis::B, Axis::C];

    /// Its address letter.
    pub const fn letter(self) -> u8 {
        b"XYZABC"[self as usize]
    }

    /// Whether it is rotary (its coordinate is in degrees).
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

/// The plane of arcs and of hole positions; its normal is the drilling axis.
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
    /// From program zero (G90).
    Absolute,
    /// From the present position (G91).
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

/// The unit of a feed word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum FeedMode {
    /// Feed per minute (G94).
    PerMinute,
    /// Feed per revolution (G95).
    PerRevolution,
    /// Inverse time (G93): 1 divided by the minutes of the move.
    InverseTime,
}

/// Path modes. From [`PathMode::Continuous`] on the control rounds corners;
/// a parameter of the control decides by how much, unless the mode says it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PathMode {
    /// Exact stop at the end of every feed move.
    ExactStop,
    /// Passes through every end point, without a stop.
    ExactPath,
    /// Rounds corners by a parameter of the control.
    Continuous,
    /// Leaves the programmed path by at most a stated length.
    Tolerance,
    /// Starts to round at a stated distance before a corner.
    Distance,
    /// Rounds within the tolerances of the axes.
    AxisTolerances,
    /// Rounds within tolerances, inside the blocks.
    WithinBlocks,
    /// Rounds so that the axes move as fast as they can.
    Dynamics,
    /// As [`PathMode::AxisTolerances`], also between tangential moves.
    Tangential,
    /// As [`PathMode::Continuous`], with a lower feed at inner corners of a compensated contour.
    SlowCorners,
    /// As [`PathMode::Continuous`], without feed hold and feed override.
    Tapping,
}

impl PathMode {
    /// All modes with their names in text.
    pub const ALL: [(PathMode, &'static str); 11] = [
        (PathMode::ExactStop, "exact-stop"),
        (PathMode::ExactPath, "exact-path"),
        (PathMode::Continuous, "continuous"),
        (PathMode::Tolerance, "tolerance"),
        (PathMode::Distance, "distance"),
        (PathMode::AxisTolerances, "axis-tolerances"),
        (PathMode::WithinBlocks, "within-blocks"),
        (PathMode::Dynamics, "dynamics"),
        (PathMode::Tangential, "tangential"),
        (PathMode::SlowCorners, "slow-corners"),
        (PathMode::Tapping, "tapping"),
    ];

    /// Its name in text.
    pub const fn name(self) -> &'static str {
        PathMode::ALL[self as usize].1
    }

    /// The mode of a name.
    pub fn named(name: &str) -> Option<PathMode> {
        PathMode::ALL.iter().find(|(_, n)| *n == name).map(|(mode, _)| *mode)
    }

    /// Whether it rounds in a way of its own, unlike [`PathMode::Continuous`].
    pub const fn is_rounding(self) -> bool {
        !matches!(self, PathMode::ExactStop | PathMode::ExactPath | PathMode::Continuous)
    }

    /// The mode that remains if the target lacks this way of rounding.
    pub const fn plain(self) -> PathMode {
        if self.is_rounding() { PathMode::Continuous } else { self }
    }
}

/// The unit of a spindle speed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum SpindleMode {
    /// Revolutions per minute (G97).
    #[default]
    Turns,
    /// Constant surface speed (G96): metres a minute (feet a minute in inches) at the distance of X from
    /// program zero.
    Surface,
}

/// Advice to the control. It changes neither the path nor the programmed feed.
/// The values of each kind are in [`AdviceKind::values`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum AdviceKind {
    /// Look-ahead.
    LookAhead,
    /// High-speed machining of many short lines.
    ContourControl,
    /// The same with a processor of its own.
    HighPrecision,
    /// Feed-forward: the drives get the speed in advance.
    FeedForward,
    /// Acceleration of the axes.
    Acceleration,
    /// Compressor: many short lines become a curve within tolerances.
    Compressor,
    /// The active set of limits for speed and acceleration.
    Dynamics,
    /// The window of an exact stop.
    ExactStopWindow,
    /// Whether tool orientations refer to the workpiece or to the machine.
    Orientation,
    /// Monitoring of the programmed working area limits.
    WorkingArea,
    /// Monitoring of the stored stroke limits.
    StrokeCheck,
    /// The machining stage and its tolerance.
    PathTolerance,
    /// Where the feed of a compensated contour counts.
    CompensatedFeed,
    /// Feed override on or off (NIST `ENABLE_FEED_OVERRIDE`).
    FeedOverride,
    /// Spindle override on or off (NIST `ENABLE_SPEED_OVERRIDE`).
    SpeedOverride,
    /// Feed hold by a switch of the machine.
    FeedStop,
    /// Smoothness of corners, and its length: a level of the control.
    Smoothness,
    /// How many blocks the control reads ahead.
    ReadAhead,
    /// Chip conveyor and the like.
    ChipConveyor,
    /// The door of the working area.
    Door,
    /// Whether the screen is updated while the program runs.
    Screen,
}

impl AdviceKind {
    /// All kinds with their names in text.
    pub const ALL: [(AdviceKind, &'static str); 21] = [
        (AdviceKind::LookAhead, "look-ahead"),
        (AdviceKind::ContourControl, "contour-control"),
        (AdviceKind::HighPrecision, "high-precision"),
        (AdviceKind::FeedForward, "feed-forward"),
        (AdviceKind::Acceleration, "acceleration"),
        (AdviceKind::Compressor, "compressor"),
        (AdviceKind::Dynamics, "dynamics"),
        (AdviceKind::ExactStopWindow, "exact-stop-window"),
        (AdviceKind::Orientation, "orientation"),
        (AdviceKind::WorkingArea, "working-area"),
        (AdviceKind::StrokeCheck, "stroke-check"),
        (AdviceKind::PathTolerance, "path-tolerance"),
        (AdviceKind::CompensatedFeed, "compensated-feed"),
        (AdviceKind::FeedOverride, "feed-override"),
        (AdviceKind::SpeedOverride, "speed-override"),
        (AdviceKind::FeedStop, "feed-stop"),
        (AdviceKind::Smoothness, "smoothness"),
        (AdviceKind::ReadAhead, "read-ahead"),
        (AdviceKind::ChipConveyor, "chip-conveyor"),
        (AdviceKind::Door, "door"),
        (AdviceKind::Screen, "screen"),
    ];

    /// Its name in text.
    pub const fn name(self) -> &'static str {
        AdviceKind::ALL[self as usize].1
    }

    /// The kind of a name.
    pub fn named(name: &str) -> Option<AdviceKind> {
        AdviceKind::ALL.iter().find(|(_, n)| *n == name).map(|(kind, _)| *kind)
    }

    /// Its values by name; at most seven.
    pub const fn values(self) -> &'static [&'static str] {
        match self {
            AdviceKind::LookAhead
            | AdviceKind::ContourControl
            | AdviceKind::HighPrecision
            | AdviceKind::FeedForward
            | AdviceKind::WorkingArea
            | AdviceKind::StrokeCheck
            | AdviceKind::FeedOverride
            | AdviceKind::SpeedOverride
            | AdviceKind::FeedStop
            | AdviceKind::Screen => &["off", "on"],
            AdviceKind::Acceleration => &["stepped", "soft", "reduced"],
            AdviceKind::Compressor => &["off", "lines", "curves", "cad", "surface"],
            AdviceKind::Dynamics => {
                &["normal", "positioning", "roughing", "semi-finishing", "finishing", "precision"]
            }
            AdviceKind::ExactStopWindow => &["fine", "coarse", "set-point"],
            AdviceKind::Orientation => &["workpiece", "machine"],
            AdviceKind::PathTolerance => &["off", "roughing", "semi-finishing", "finishing"],
            AdviceKind::CompensatedFeed => &["contour", "centre", "inside"],
            AdviceKind::Smoothness => &["as-set", "rough", "medium", "fine"],
            AdviceKind::ReadAhead => &["unlimited", "limited"],
            AdviceKind::ChipConveyor => &["stopped", "forward", "back"],
            AdviceKind::Door => &["closed", "open"],
        }
    }

    /// The value of a name.
    pub fn value(self, name: &str) -> Option<u8> {
        self.values().iter().position(|n| *n == name).map(|at| at as u8)
    }

    /// Whether it has a length.
    pub const fn has_amount(self) -> bool {
        matches!(self, AdviceKind::PathTolerance | AdviceKind::Smoothness)
    }

    /// Its value for a code without a word: a switch is on, and a number that
    /// limits something means no limit.
    pub const fn alone(self) -> Option<u8> {
        match self {
            AdviceKind::FeedOverride | AdviceKind::SpeedOverride | AdviceKind::FeedStop => Some(1),
            AdviceKind::ReadAhead | AdviceKind::Smoothness => Some(0),
            _ => None,
        }
    }

    /// Its index among the values of all kinds, in bits; three for each kind.
    pub const fn bits(self) -> u32 {
        self as u32 * 3
    }
}

/// The return level of a canned cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ReturnLevel {
    /// The initial level: position along the drilling axis before the cycle (G98).
    Initial,
    /// The R plane (G99).
    Retract,
}

/// Direction of an arc, seen from the positive end of the plane's normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // The names are the meaning.
pub enum Turn {
    Clockwise,
    Counterclockwise,
}

/// Direction of a rotary move to its angle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum RotaryWay {
    /// The shortest path: at most half a turn.
    Shortest,
    /// Towards greater angles, below a turn.
    Positive,
    /// Towards smaller angles, below a turn.
    Negative,
}

impl RotaryWay {
    /// All ways with their names in text.
    pub const ALL: [(RotaryWay, &'static str); 3] = [
        (RotaryWay::Shortest, "shortest"),
        (RotaryWay::Positive, "positive"),
        (RotaryWay::Negative, "negative"),
    ];

    /// Its name in text.
    pub const fn name(self) -> &'static str {
        RotaryWay::ALL[self as usize].1
    }

    /// The way of a name.
    pub fn named(name: &str) -> Option<RotaryWay> {
        RotaryWay::ALL.iter().find(|(_, n)| *n == name).map(|(way, _)| *way)
    }

    /// The turn from one angle to another, in nanos of a degree; `None` where both directions are equally
    /// short.
    pub fn turn(self, from: i64, to: i64) -> Option<i64> {
        const WHOLE: i64 = 360_000_000_000;
        let ahead = to.wrapping_sub(from).rem_euclid(WHOLE);
        match self {
            RotaryWay::Shortest if ahead == WHOLE / 2 => None,
            RotaryWay::Shortest if ahead > WHOLE / 2 => Some(ahead - WHOLE),
            RotaryWay::Shortest | RotaryWay::Positive => Some(ahead),
            RotaryWay::Negative if ahead == 0 => Some(0),
            RotaryWay::Negative => Some(ahead - WHOLE),
        }
    }

    /// Whether the direction is that of a plain word.
    pub fn is_direct(self, from: i64, to: i64) -> bool {
        self.turn(from, to) == Some(to.wrapping_sub(from))
    }
}

/// The shape of a corner between two moves, and the meaning of its length.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CornerShape {
    /// An arc tangent to both moves, of this radius.
    Round,
    /// A line from this distance before the corner to this distance after it.
    Leg,
    /// A line of this length, symmetric about the corner.
    Length,
}

impl CornerShape {
    /// All of them.
    pub const ALL: [CornerShape; 3] = [CornerShape::Round, CornerShape::Leg, CornerShape::Length];
}

/// The side of the programmed contour on which the tool moves, seen in the direction of the path.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // The names are the meaning.
pub enum Side {
    Left,
    Right,
}

impl Side {
    /// Its name in text.
    pub const fn name(self) -> &'static str {
        match self {
            Side::Left => "left",
            Side::Right => "right",
        }
    }

    /// The opposite side.
    pub const fn other(self) -> Side {
        match self {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        }
    }
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

/// The motion mode: what axis words without a motion code do.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Motion {
    /// A rapid move (G00).
    Traverse,
    /// A feed move (G01).
    Feed,
    /// Arc.
    Arc(Turn),
    /// A hole of the active cycle.
    Cycle,
}

/// A modal value on which a statement depends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Fact<T> {
    /// The program has set it, on every path to this statement.
    Known(T),
    /// The value that is active at run time: the caller's, or the power-on value.
    Entry,
}

impl<T> Fact<T> {
    /// The value, or `in_force` if the program has not set it.
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
/// has stated so far, and what a translation assumed.
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
    /// Work offset active: 1 is the first (G54 on a Fanuc).
    pub work_offset: Option<u16>,
    /// Entry of the tool-length table active; 0 is none.
    pub length_offset: Option<u32>,
    /// Whether there is no G92 shift (`true`), or one may be left over.
    pub no_origin_shift: Option<bool>,
}

impl Modes {
    /// Those of these facts that are not known by the others.
    pub fn without(self, other: &Modes) -> Modes {
        fn keep<T>(own: Option<T>, other: Option<T>) -> Option<T> {
            if other.is_some() { None } else { own }
        }
        Modes {
            motion: keep(self.motion, other.motion),
            distance: keep(self.distance, other.distance),
            units: keep(self.units, other.units),
            plane: keep(self.plane, other.plane),
            feed_mode: keep(self.feed_mode, other.feed_mode),
            return_level: keep(self.return_level, other.return_level),
            work_offset: keep(self.work_offset, other.work_offset),
            length_offset: keep(self.length_offset, other.length_offset),
            no_origin_shift: keep(self.no_origin_shift, other.no_origin_shift),
        }
    }

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
