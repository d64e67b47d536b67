//! Canned cycles in neutral geometry.
//!
//! A cycle is activated by a statement, then made at each following hole position until it is
//! ended. `passes::expand_cycles` is the definition of its moves.

use crate::canon::{Axis, Distance, Fact, Plane, ReturnLevel, Spindle, Turn, Units};
use crate::expr::num::{Nanos, Num, Unit};
use crate::expr::{Binary, Expr, Function, Node};
use crate::program::moves::{Coord, Pitch, Point};

/// A hole-making cycle, complete: a back-end needs no earlier block to write it.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// How the hole is made.
    pub kind: CycleKind,
    /// Plane of the hole positions; the drilling axis is its normal.
    pub plane: Fact<Plane>,
    /// The retract plane R: absolute, or incremental from the initial level.
    pub retract: Coord,
    /// The reference plane over which the retract plane was said to lie, if the cycle states it apart. The moves are
    /// the retract plane's; a target that states both planes gives it back.
    pub reference: Option<Coord>,
    /// The bottom of the hole: absolute, or incremental from the retract plane.
    pub depth: Coord,
    /// Where the tool goes after each hole.
    pub return_level: Fact<ReturnLevel>,
    /// The plane to which it goes after each hole, absolute, if the cycle states one; then
    /// `return_level` does not count.
    pub return_plane: Option<Coord>,
    /// The tool's way to each hole.
    pub approach: Approach,
    /// Feed into the hole, if the cycle's own block says it. It is re-stated at every hole.
    pub feed: Option<Expr>,
}

impl Cycle {
    /// Whether its holes are made at the feed that the program has active.
    pub fn relies_on_feed(&self) -> bool {
        let stated = matches!(&self.kind, CycleKind::Tap(tap) if matches!(tap.pitch, Pitch::Stated(_)));
        self.feed.is_none() && !stated
    }

    /// Whether a position's words are measured as the cycle's own planes are.
    pub fn measured_as(&self, to: &Point) -> bool {
        let planes = [&self.retract, &self.depth].map(|c| c.distance);
        to.axes.iter().flatten().all(|word| planes.iter().all(|p| *p == word.distance))
    }
}

/// How a hole is made.
#[derive(Clone, Debug, PartialEq)]
pub enum CycleKind {
    /// Feed to the bottom, rapid out.
    Drill,
    /// Feed to the bottom, dwell (seconds), rapid out.
    DrillDwell {
        /// Seconds at the bottom.
        dwell: Expr,
    },
    /// Feed by pecks; after each, rapid to the retract plane and back to the clearance above the
    /// last depth.
    DrillPeck {
        /// Depth of a peck, positive.
        peck: Expr,
        /// Depth of the first peck below the retract plane, where it is another.
        first: Option<Expr>,
        /// How much less each further peck is than the one before it, from the first one on; then `peck` is
        /// the least.
        less: Option<Expr>,
        /// How far above the last depth the rapid back ends.
        clearance: Clearance,
        /// Seconds after every peck but the last, if any.
        pause: Option<Expr>,
        /// Seconds at the retract plane after every peck but the last, if any.
        settle: Option<Expr>,
        /// Seconds at the bottom, if any.
        dwell: Option<Expr>,
    },
    /// Feed by pecks; after each but the last, up a little to break the chip.
    DrillBreak {
        /// Depth of a peck, positive.
        peck: Expr,
        /// Depth of the first peck below the retract plane, where it is another.
        first: Option<Expr>,
        /// How much less each further peck is than the one before it, from the first one on; then `peck` is
        /// the least.
        less: Option<Expr>,
        /// How far up.
        lift: Clearance,
        /// Whether the lift is at feed; else it is rapid.
        lift_at_feed: bool,
        /// Seconds after every peck but the last, if any.
        pause: Option<Expr>,
        /// Seconds at the bottom, if any.
        dwell: Option<Expr>,
    },
    /// Feed to the bottom, feed out.
    Bore {
        /// Seconds at the bottom, if any.
        dwell: Option<Expr>,
        /// Feed on the way out, where it is another. Which feed is active after the cycle is then
        /// not known.
        feed_out: Option<Expr>,
        /// Whether the feed goes on to where the tool is left; else from the retract plane it is rapid.
        to_level: bool,
    },
    /// Cut a thread with a tap: in at the pitch, dwell, out with the spindle turned round.
    ///
    /// Without a chuck the control turns the spindle itself: it is stopped on the way to the hole and out
    /// of it, whatever the program has said before.
    Tap(Box<Tap>),
    /// Feed to the bottom, dwell, stop the spindle in an orientation, shift the tool off the wall, rapid
    /// out, shift back.
    FineBore(Box<FineBore>),
    /// Feed to the bottom, dwell, stop the spindle, rapid out.
    BoreStop(BoreStop),
}

/// Depth of the peck after one of a depth, where each is less than the one before by `less`, and none less than
/// `peck`.
pub fn next_peck(before: Nanos, peck: Nanos, less: Option<Nanos>) -> Nanos {
    less.map_or(peck, |less| before.saturating_sub(less).max(peck))
}

/// What tapping needs to know.
#[derive(Clone, Debug, PartialEq)]
pub struct Tap {
    /// Sense in which the spindle turns on the way in: clockwise makes a right-hand thread.
    pub turn: Turn,
    /// The thread's pitch.
    pub pitch: Pitch,
    /// Whether a compensating chuck makes good what feed and spindle are apart, and the spindle turns
    /// already; else the axis goes synchronised with it.
    pub chuck: bool,
    /// Seconds at the bottom, if any.
    pub dwell: Option<Expr>,
    /// Seconds at the bottom when the spindle has turned round, if any.
    pub back: Option<Expr>,
    /// Seconds where the way out of the thread ends, if any.
    pub settle: Option<Expr>,
    /// What the spindle does after the hole.
    pub after: Spindle,
    /// Whether the way out in step goes on to where the tool is left; else from the retract plane it is
    /// rapid.
    pub to_level: bool,
}

/// What fine boring needs to know.
#[derive(Clone, Debug, PartialEq)]
pub struct FineBore {
    /// Sense in which the spindle turns for it, if the cycle says it; else as it does.
    pub turn: Option<Turn>,
    /// Seconds at the bottom, if any.
    pub dwell: Option<Expr>,
    /// Orientation of the spindle in degrees; `None` is the machine's own.
    pub angle: Option<Expr>,
    /// How the tool goes off the wall.
    pub shift: Shift,
    /// What the spindle does after the hole; `None` is what it did before.
    pub after: Option<Spindle>,
}

/// What boring with a stopped spindle needs to know.
#[derive(Clone, Debug, PartialEq)]
pub struct BoreStop {
    /// Sense in which the spindle turns for it, if the cycle says it; else as it does.
    pub turn: Option<Turn>,
    /// Seconds at the bottom, if any.
    pub dwell: Option<Expr>,
    /// Whether the program stops too, until the operator starts it.
    pub stop: bool,
    /// What the spindle does after the hole; `None` is what it did before.
    pub after: Option<Spindle>,
}

/// How a tool goes off the wall of a bore.
#[derive(Clone, Debug, PartialEq)]
pub enum Shift {
    /// By so much along X, Y and Z.
    Stated([Option<Expr>; 3]),
    /// By so much, in the direction that a parameter of the control says.
    Parameter(Expr),
}

/// A distance that some controls have as a word and others as a machine parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Clearance {
    /// Said by the program, or assumed by the translation.
    Stated(Expr),
    /// The control's own parameter; its value belongs to the world.
    Parameter,
    /// Of pecks alone: no rapid back. Each peck goes out to where the tool is left after the hole, and from there down
    /// at feed.
    FromReturn,
}

/// A clearance that grows with the hole: a fiftieth of its depth, but no less than 0.6 mm and no more than 7 mm. The
/// depth is in the active unit.
pub fn clearance_by_depth(hole: &Expr, units: Units) -> Expr {
    let length = |tenths: i64| {
        let mm = Num { mantissa: tenths, scale: 1, unit: Unit::One, point: true }.trimmed();
        let inch = Num { mantissa: 254, scale: 1, unit: Unit::One, point: true };
        match units {
            Units::Mm => Expr::Num(mm),
            Units::Inch => Expr::binary(Binary::Divide, Expr::Num(mm), Expr::Num(inch)),
        }
    };
    let of = |function, a, b| Expr::Node(Box::new(Node::Call(function, vec![a, b])));
    let part = Expr::binary(Binary::Divide, hole.operand(), Expr::int(50));
    of(Function::Min, of(Function::Max, length(6), part), length(70))
}

/// The way to a hole, from where the tool is to the retract plane over it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Approach {
    /// In the plane first, at the present level (Fanuc).
    PlaneFirst,
    /// From below, up to the retract plane first; from above, in the plane first (NIST RS274/NGC).
    RaiseFirst,
    /// To the retract plane first, from below and from above, then in the plane.
    RetractFirst,
    /// As [`Approach::RaiseFirst`] to the first of a series of holes; from a hole that was left no higher
    /// than the next one's retract plane, straight to the return level above that one (LinuxCNC).
    ClearFirst,
}

/// How the way to a hole begins.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Leg {
    /// To the retract plane where the tool is, then in the plane.
    Level,
    /// In the plane, at the level where the tool is.
    Aside,
    /// Straight to the return level above the hole.
    Slant,
}

impl Approach {
    /// All of them.
    pub const ALL: [Approach; 4] =
        [Approach::PlaneFirst, Approach::RaiseFirst, Approach::RetractFirst, Approach::ClearFirst];

    /// Whether a tool that stands at a level goes to the retract plane before it goes aside to the first
    /// hole of a series.
    pub const fn retracts(self, level: Nanos, retract: Nanos) -> bool {
        match self {
            Approach::PlaneFirst => false,
            Approach::RaiseFirst | Approach::ClearFirst => level < retract,
            Approach::RetractFirst => level != retract,
        }
    }

    /// How the way to a hole begins for a tool that stands at a level. `initial` is where it stood before
    /// the series, `out` where it goes after the hole.
    pub const fn leg(self, level: Nanos, initial: Nanos, retract: Nanos, out: Nanos) -> Leg {
        match self {
            Approach::ClearFirst if initial < retract && level != retract => Leg::Level,
            Approach::ClearFirst if level <= retract && level < out => Leg::Slant,
            Approach::ClearFirst => Leg::Aside,
            _ if self.retracts(level, retract) => Leg::Level,
            Approach::PlaneFirst | Approach::RaiseFirst | Approach::RetractFirst => Leg::Aside,
        }
    }

    /// The level to which a tool returns that shall go to its initial level: a control that goes up to
    /// the retract plane first does not go below it again (NIST RS274/NGC, 3.5.20).
    pub fn initial(self, initial: Nanos, retract: Nanos) -> Nanos {
        match self {
            Approach::RaiseFirst | Approach::ClearFirst => initial.max(retract),
            Approach::PlaneFirst | Approach::RetractFirst => initial,
        }
    }
}

/// Names used by the text form and by dictionaries.
impl CycleKind {
    /// A short name: `drill`, `drill-dwell`, `drill-peck`, `drill-break`, `bore`, `tap`, `tap-rigid`,
    /// `bore-fine`, `bore-stop`.
    pub fn name(&self) -> &'static str {
        match self {
            CycleKind::Drill => "drill",
            CycleKind::DrillDwell { .. } => "drill-dwell",
            CycleKind::DrillPeck { .. } => "drill-peck",
            CycleKind::DrillBreak { .. } => "drill-break",
            CycleKind::Bore { .. } => "bore",
            CycleKind::Tap(tap) if tap.chuck => "tap",
            CycleKind::Tap(_) => "tap-rigid",
            CycleKind::FineBore(_) => "bore-fine",
            CycleKind::BoreStop(_) => "bore-stop",
        }
    }
}

impl CycleKind {
    /// Whether it starts, stops or turns the spindle.
    pub fn drives_spindle(&self) -> bool {
        matches!(self, CycleKind::Tap(_) | CycleKind::FineBore(_) | CycleKind::BoreStop(_))
    }

    /// A feed out that ends at the retract plane; it is the same where the tool is left there.
    pub fn end_feed_at_retract(&mut self) {
        match self {
            CycleKind::Bore { to_level, .. } => *to_level = false,
            CycleKind::Tap(tap) => tap.to_level = false,
            CycleKind::Drill
            | CycleKind::DrillDwell { .. }
            | CycleKind::DrillPeck { .. }
            | CycleKind::DrillBreak { .. }
            | CycleKind::FineBore(_)
            | CycleKind::BoreStop(_) => {}
        }
    }

    /// The clearance or lift that the control would take from a parameter, as another cycle of the kind states it.
    pub fn state_clearance(&mut self, stated: &CycleKind) {
        match (self, stated) {
            (CycleKind::DrillPeck { clearance: own, .. }, CycleKind::DrillPeck { clearance: other, .. })
            | (CycleKind::DrillBreak { lift: own, .. }, CycleKind::DrillBreak { lift: other, .. })
                if *own == Clearance::Parameter =>
            {
                own.clone_from(other);
            }
            _ => {}
        }
    }

    /// Whether its feed out goes on to where the tool is left.
    pub fn feeds_to_level(&self) -> bool {
        match self {
            CycleKind::Bore { to_level, .. } => *to_level,
            CycleKind::Tap(tap) => tap.to_level,
            CycleKind::Drill
            | CycleKind::DrillDwell { .. }
            | CycleKind::DrillPeck { .. }
            | CycleKind::DrillBreak { .. }
            | CycleKind::FineBore(_)
            | CycleKind::BoreStop(_) => false,
        }
    }

    /// Calls something for each length that tapping and the boring cycles with a stop say: pitches and
    /// shifts.
    pub fn each_length<E>(&mut self, mut each: impl FnMut(&mut Expr) -> Result<(), E>) -> Result<(), E> {
        match self {
            CycleKind::Tap(tap) => match &mut tap.pitch {
                Pitch::Stated(pitch) => each(pitch),
                Pitch::Feed => Ok(()),
            },
            CycleKind::FineBore(bore) => match &mut bore.shift {
                Shift::Stated(words) => words.iter_mut().flatten().try_for_each(each),
                Shift::Parameter(amount) => each(amount),
            },
            CycleKind::Drill
            | CycleKind::DrillDwell { .. }
            | CycleKind::DrillPeck { .. }
            | CycleKind::DrillBreak { .. }
            | CycleKind::Bore { .. }
            | CycleKind::BoreStop(_) => Ok(()),
        }
    }
}

/// A pattern of hole positions, made with the active cycle.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// Holes on a circle, counter-clockwise for a positive step.
    Circle {
        /// Centre in the plane; `None` is where the tool is.
        centre: Option<[Coord; 2]>,
        /// Position of the first hole.
        first: First,
        /// Angle from one hole to the next, degrees; negative is clockwise.
        step: Expr,
        /// Number of holes, the first included.
        count: u32,
    },
    /// Holes on a straight line.
    Line {
        /// Where it begins; `None` is where the tool is.
        start: Option<[Coord; 2]>,
        /// Its direction in the plane, degrees from the first axis, counter-clockwise.
        angle: Expr,
        /// Distance of the first hole from the beginning.
        offset: Expr,
        /// Distance from hole to hole.
        pitch: Expr,
        /// Number of holes.
        count: u32,
    },
    /// Holes at positions one after another.
    List(Vec<Point>),
    /// Rows of holes.
    Grid {
        /// The first hole; `None` is where the tool is.
        start: Option<[Coord; 2]>,
        /// Direction of a row and pitch along it, signed.
        columns: Row,
        /// Direction from row to row and pitch along it, signed.
        rows: Row,
        /// Whether every second row runs backwards.
        serpentine: bool,
    },
}

/// Where the first hole of a circle is.
#[derive(Clone, Debug, PartialEq)]
pub enum First {
    /// At a position.
    At([Coord; 2]),
    /// At a radius and an angle in degrees from the plane's first axis, counter-clockwise.
    Polar {
        /// The radius.
        radius: Expr,
        /// The angle.
        angle: Expr,
    },
}

/// A direction in the plane.
#[derive(Clone, Debug, PartialEq)]
pub enum Along {
    /// An axis.
    Axis(Axis),
    /// Degrees from the plane's first axis, counter-clockwise.
    Angle(Expr),
}

/// One direction of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Along what.
    pub along: Along,
    /// Distance from hole to hole.
    pub pitch: Expr,
    /// Number of holes.
    pub count: u32,
}

/// A coordinate from program zero.
pub fn absolute(value: impl Into<Expr>) -> Coord {
    Coord { value: value.into(), distance: Fact::Known(Distance::Absolute) }
}
