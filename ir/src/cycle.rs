//! Canned cycles in neutral geometry.
//!
//! A cycle is called up by a statement, then made at each following hole position until it is
//! ended. `passes::expand_cycles` is the definition of its moves.

use crate::canon::{Axis, Distance, Fact, Plane, ReturnLevel};
use crate::expr::Expr;
use crate::num::Nanos;
use crate::program::{Coord, Point};

/// A hole-making cycle, complete: a back-end needs no earlier block to write it.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// How the hole is made.
    pub kind: CycleKind,
    /// Plane of the hole positions; the drilling axis is its normal.
    pub plane: Fact<Plane>,
    /// The retract plane R: absolute, or incremental from the initial level.
    pub retract: Coord,
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
        /// How far up.
        lift: Clearance,
        /// Whether the lift is at feed; else it is rapid.
        lift_at_feed: bool,
        /// Seconds after every peck but the last, if any.
        pause: Option<Expr>,
        /// Seconds at the bottom, if any.
        dwell: Option<Expr>,
    },
    /// Feed to the bottom, feed out to the retract plane.
    Bore {
        /// Seconds at the bottom, if any.
        dwell: Option<Expr>,
        /// Feed on the way out, where it is another. Which feed is in force after the cycle is then
        /// not known.
        feed_out: Option<Expr>,
    },
}

/// A distance that some controls have as a word and others as a machine parameter.
#[derive(Clone, Debug, PartialEq)]
pub enum Clearance {
    /// Said by the program, or taken for granted by the translation.
    Stated(Expr),
    /// The control's own parameter; its value belongs to the world.
    Parameter,
}

/// The way to a hole, from where the tool stands to the retract plane over it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Approach {
    /// In the plane first, at the present level (Fanuc).
    PlaneFirst,
    /// From below, up to the retract plane first; from above, in the plane first (NIST RS274/NGC).
    RaiseFirst,
    /// To the retract plane first, from below and from above, then in the plane.
    RetractFirst,
}

impl Approach {
    /// All of them.
    pub const ALL: [Approach; 3] = [Approach::PlaneFirst, Approach::RaiseFirst, Approach::RetractFirst];

    /// Whether a tool that stands at a level goes to the retract plane before it goes aside.
    pub const fn retracts(self, level: Nanos, retract: Nanos) -> bool {
        match self {
            Approach::PlaneFirst => false,
            Approach::RaiseFirst => level < retract,
            Approach::RetractFirst => level != retract,
        }
    }
}

/// Names used by the text form and by dictionaries.
impl CycleKind {
    /// A short name: `drill`, `drill-dwell`, `drill-peck`, `drill-break`, `bore`.
    pub const fn name(&self) -> &'static str {
        match self {
            CycleKind::Drill => "drill",
            CycleKind::DrillDwell { .. } => "drill-dwell",
            CycleKind::DrillPeck { .. } => "drill-peck",
            CycleKind::DrillBreak { .. } => "drill-break",
            CycleKind::Bore { .. } => "bore",
        }
    }
}

/// A pattern of hole positions, made with the cycle in force.
#[derive(Clone, Debug, PartialEq)]
pub enum Pattern {
    /// Holes on a circle, counter-clockwise for a positive step.
    Circle {
        /// Centre in the plane; `None` is where the tool stands.
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
        /// Where it begins; `None` is where the tool stands.
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
        /// The first hole; `None` is where the tool stands.
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
