//! What passes know of the target.
//!
//! ```text
//! caps: no cycles | decimals: 3 | peck_clearance: 1 mm
//! ```
//!
//! Not here: what a control can say (`ncc_ir::caps`).

use std::collections::{BTreeMap, BTreeSet};

use ncc_exec::world::Sideways;
use ncc_ir::behaviour::Behaviours;
use ncc_ir::caps::Caps;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::geometry::arc_feed::ArcFeed;
use ncc_ir::geometry::offset_path::Rules;
use ncc_ir::program::Text;

/// Most statements that a program may grow to by being written out.
pub(crate) const MOST_STATEMENTS: usize = 4_000_000;

/// What passes know of the target.
#[derive(Clone, Debug, Default)]
pub struct Target {
    /// What it can say.
    pub caps: Caps,
    /// Digits after the point, in mm or degrees, to which computed positions are rounded (0 to 8);
    /// in inches it is one more.
    pub decimals: u8,
    /// Clearance of a peck cycle whose own control has it as a parameter: taken for granted where
    /// the cycle is written out.
    pub peck_clearance: Option<Num>,
    /// Lift of a chip-breaking cycle whose own control has it as a parameter, likewise.
    pub break_lift: Option<Num>,
    /// The source control's direction in which a tool is shifted off the wall of a bore.
    pub bore_shift: Option<Sideways>,
    /// The angle at which the source control stops the spindle where nothing else is said, degrees.
    pub orientation: Option<Num>,
    /// The entry of its length table that has the length of edge 1 of a tool, where that is not the
    /// entry with the tool's number.
    pub edge_entries: BTreeMap<u32, u32>,
    /// The entry that another edge of a tool has, by tool and edge.
    pub further_edges: BTreeMap<(u32, u32), u32>,
    /// Numbers of programs that the machine has already: no subprogram is given one of them.
    pub program_numbers: BTreeSet<u32>,
    /// Whether the source is the program of another kind of control.
    pub other_control: bool,
    /// Whether plain rounding of corners is bounded on the source's control.
    pub corners_bounded: bool,
    /// Side effects of codes on the source's control.
    pub source: Behaviours,
    /// Variables, by their names in lower case, that have a value before the program begins.
    pub given: BTreeMap<Text, f64>,
    /// How compensation is worked out, where that is asked for.
    pub compensating: Compensating,
    /// Most steps and blocks of a program that `flatten` executes, where it is only tried; `None` is as many as a
    /// program may grow to.
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

/// How compensation is worked out.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Compensating {
    /// What controls do each in a way of their own.
    pub rules: Rules,
    /// Whether the source's control is known to follow them.
    pub known: bool,
    /// Radii of tools by their entries, as far as a profile states them, in nanos of a millimetre.
    pub radii: BTreeMap<u32, Nanos>,
    /// Whether the statements that switch it on and off stay, and every block is one: for a list of calls.
    pub listing: bool,
    /// What F counts on arcs where the program states nothing, as the source's control has it.
    pub arc_feed: ArcFeed,
    /// Digits of F behind the point in the target.
    pub feed_decimals: u8,
}
