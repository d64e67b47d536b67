//! Canned cycles in neutral geometry.
//!
//! A cycle is called up by a statement, then made at each following hole position until it is
//! ended. `passes::expand_cycles` is the definition of its moves.

use crate::canon::{Axis, Distance, Fact, Plane, ReturnLevel};
use crate::expr::Expr;
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
    /// What the tool does first if it stands below the retract plane.
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
        /// How far above the last depth the rapid back ends.
        clearance: Clearance,
        /// Seconds at the bottom, if any.
        dwell: Option<Expr>,
    },
    /// Feed to the bottom, feed out to the retract plane.
    Bore {
        /// Seconds at the bottom, if any.
        dwell: Option<Expr>,
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

/// The way to the first hole if the tool stands below the retract plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Approach {
    /// In the plane first, at the present level (Fanuc).
    PlaneFirst,
    /// Up to the retract plane first (NIST RS274/NGC).
    RaiseFirst,
}

/// Names used by the text form and by dictionaries.
impl CycleKind {
    /// A short name: `drill`, `drill-dwell`, `drill-peck`, `bore`.
    pub const fn name(&self) -> &'static str {
        match self {
            CycleKind::Drill => "drill",
            CycleKind::DrillDwell { .. } => "drill-dwell",
            CycleKind::DrillPeck { .. } => "drill-peck",
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
        first: [Coord; 2],
        /// Angle from one hole to the next, degrees; negative is clockwise.
        step: Expr,
        /// Number of holes, the first included.
        count: u32,
    },
    /// Rows of holes from where the tool stands, which is the first hole.
    Grid {
        /// Axis of a row and pitch along it, signed.
        columns: Row,
        /// Axis from row to row and pitch along it, signed.
        rows: Row,
        /// Whether every second row runs backwards.
        serpentine: bool,
    },
}

/// One direction of a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Along which axis.
    pub axis: Axis,
    /// Distance from hole to hole.
    pub pitch: Expr,
    /// Number of holes.
    pub count: u32,
}

/// A coordinate from program zero.
pub fn absolute(value: impl Into<Expr>) -> Coord {
    Coord { value: value.into(), distance: Fact::Known(Distance::Absolute) }
}
