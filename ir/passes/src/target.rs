//! The target, as far as passes need it.
//!
//! ```text
//! caps: no cycles | decimals: 3 | peck_clearance: 1 mm
//! ```
//!
//! Not here: capabilities (`ncc_ir::caps`).

use std::collections::{BTreeMap, BTreeSet};

use ncc_exec::world::Sideways;
use ncc_ir::behaviour::Behaviours;
use ncc_ir::caps::Caps;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::geometry::arc_feed::ArcFeed;
use ncc_ir::geometry::offset_path::Rules;
use ncc_ir::program::Text;

/// Most statements of a program after expansion.
pub(crate) const MOST_STATEMENTS: usize = 4_000_000;

/// The target, as far as passes need it.
#[derive(Clone, Debug, Default)]
pub struct Target {
    /// Its capabilities.
    pub caps: Caps,
    /// Digits after the point, in mm or degrees, to which computed positions are rounded (0 to 8);
    /// one more in inches.
    pub decimals: u8,
    /// Peck clearance of a control that has it as a parameter: assumed where
    /// the cycle is expanded.
    pub peck_clearance: Option<Num>,
    /// Chip-breaking lift of a control that has it as a parameter, likewise.
    pub break_lift: Option<Num>,
    /// Direction in which the source's control shifts the tool off the wall of a bore.
    pub bore_shift: Option<Sideways>,
    /// The angle at which the source's control stops the spindle by default, degrees.
    pub orientation: Option<Num>,
    /// The length entry of edge 1 of a tool, if it is not the
    /// entry with the tool's number.
    pub edge_entries: BTreeMap<u32, u32>,
    /// The length entry of another edge, by tool and edge.
    pub further_edges: BTreeMap<(u32, u32), u32>,
    /// Program numbers in use on the machine: no subprogram gets one of them.
    pub program_numbers: BTreeSet<u32>,
    /// Whether source and target are different controls.
    pub other_control: bool,
    /// Whether the source's control limits the rounding of corners.
    pub corners_bounded: bool,
    /// Side effects of codes on the source's control.
    pub source: Behaviours,
    /// Variables with a value before the program starts, by their names in lower case.
    pub given: BTreeMap<Text, f64>,
    /// How to compute tool centre paths, if the user asks for them.
    pub compensating: Compensating,
    /// Most steps and blocks that `flatten` executes in a trial; `None` is the limit of
    /// a program.
    pub tried_upto: Option<u32>,
}

impl Target {
    /// Digits after the point of a computed length in a unit.
    pub(crate) fn decimals_in(&self, unit: Unit) -> u8 {
        match unit {
            Unit::Inch => self.decimals.saturating_add(1),
            Unit::One | Unit::Mm | Unit::Entry | Unit::Degree | Unit::Second => self.decimals,
        }
    }
}

/// How to compute tool centre paths.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Compensating {
    /// The source's rule for what controls do differently.
    pub rules: Rules,
    /// Whether the source's control is known to follow this rule.
    pub known: bool,
    /// Tool radii by entry, as far as a profile states them, in nanos of a millimetre.
    pub radii: BTreeMap<u32, Nanos>,
    /// Whether the start and end of compensation stay, and every block is one statement: for a list of calls.
    pub listing: bool,
    /// What F counts on arcs by default on the source's control.
    pub arc_feed: ArcFeed,
    /// Digits of F after the point on the target.
    pub feed_decimals: u8,
}
