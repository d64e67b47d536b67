//! ncc-passes: rewriting a program so that a target can say it, with the machine doing the same.
//!
//! A pass is a plain function on a program, listed in [`PASSES`] and runnable alone. Which ones a
//! target needs follows from its capabilities; [`Legaliser`] picks them and runs them on a program
//! that streams through in pieces. A pass never names a dialect, and never changes what the machine
//! does: what it cannot mend it refuses.
//!
//! ```text
//! --print-after all    shows the program behind each pass that changed it
//! ```
//!
//! Not here: reading, writing, executing.

pub mod arcs;
pub mod flow;
pub mod fold;
pub mod frames;
pub mod holes;
mod legalise;
pub mod modes;
pub mod parametric;
pub mod pass;
pub mod support;
pub mod threads;
pub mod tools;
pub mod values;
pub mod watch;

pub use arcs::expand_compensation::Compensating;
pub use frames::machine_moves::retract;
pub use legalise::Legaliser;
pub use legalise::messages::{leave_out_output, leave_out_values, output_elsewhere};
pub use pass::Pass;

use std::collections::{BTreeMap, BTreeSet};

use ncc_exec::world::Sideways;
use ncc_ir::behaviour::Behaviours;
use ncc_ir::caps::Caps;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::{Program, Stmt, Text};
use ncc_ir::track::Tracker;
use support::walk::Walk;

/// Most statements that a program may grow to by being written out.
const MOST_STATEMENTS: usize = 4_000_000;

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
    fn decimals_in(&self, unit: Unit) -> u8 {
        match unit {
            Unit::Inch => self.decimals.saturating_add(1),
            Unit::One | Unit::Mm | Unit::Entry | Unit::Degree | Unit::Second => self.decimals,
        }
    }
}

/// All passes, in the order in which they are run. Each is a constant in its own file. The legaliser, programs that compute
/// and `--pass` walk this table. Passes without functions here are run by the driver, which tells their names.
pub const PASSES: &[Pass] = &[
    // Only when asked for: behind it there is nothing that computes or decides.
    flow::flatten::PASS,
    // Of a program that is kept whole.
    flow::unused_labels::PASS,
    // What the user states, only the driver knows.
    Pass::named(
        "values-at-start",
        "sets variables to what the user states that they hold at the start",
        None,
    ),
    modes::side_effects::PASS,
    legalise::messages::OUTPUT,
    values::alarm_numbers::TEXTS,
    values::alarm_numbers::NUMBERS,
    tools::machine_numbers::TOOL_NAMES,
    legalise::messages::VALUES,
    parametric::CODES_PUT_BACK,
    parametric::CODES,
    flow::expand_repeats::COMPUTED,
    frames::machine_cuts::PASS,
    holes::cycle_plane_check::PASS,
    holes::computed_holes::PASS,
    values::exact_comparisons::PASS,
    values::message_values::PASS,
    flow::control_forms::PASS,
    values::arithmetic::PASS,
    parametric::KNOWN_FACTS,
    arcs::centres_from_start::PASS,
    frames::spindle_points::PASS,
    values::unit_in_force::PASS,
    parametric::DEPTH,
    values::variables::PASS,
    tools::machine_numbers::PASS,
    flow::specialise_procedures::PASS,
    flow::expand_calls::PASS,
    flow::number_names::PASS,
    frames::computed_frames::PASS,
    // As a piece comes.
    frames::rotary_turns::PASS,
    tools::length_axis::PASS,
    frames::offset_here::PASS,
    tools::z_after_change::PASS,
    frames::frame_increments::PASS,
    tools::tool_change::PASS,
    modes::feed_unit::AGAIN,
    modes::feed_time::PASS,
    // What says where things are. Points by radius and angle come before everything that looks at coordinates.
    flow::expand_repeats::PASS,
    arcs::polar_words::PASS,
    frames::work_offset::PASS,
    modes::path_control::PASS,
    frames::rotary_ways::PASS,
    flow::skip_levels::PASS,
    arcs::expand_corners::PASS,
    frames::expand_frames::PASS,
    // A shift that the program has set itself is over by now.
    frames::origin_shift::PASS,
    frames::machine_moves::PASS,
    // All else. Every pass walks from the beginning of the piece: what it walks over does what the piece does.
    arcs::convert_arcs::FINE,
    arcs::arc_form::PASS,
    modes::feed_unit::PASS,
    modes::one_distance::PASS,
    tools::tool_edge::PASS,
    tools::length_by_hand::PASS,
    // Behind the lengths, which say what is in force.
    tools::tool_axis::PASS,
    arcs::cutter_radius::PASS,
    arcs::still_blocks::PASS,
    legalise::refuse::PASS,
    threads::in_step::AS_CYCLES,
    threads::tapped_holes::PASS,
    holes::state_clearance::PASS,
    threads::taps::PASS,
    // Before the patterns: a first hole may come out of one.
    holes::return_plane::PASS,
    // Before the cycles, so that a kept cycle gets its positions.
    holes::expand_patterns::PASS,
    // Before the cycles: what it mends need not be expanded.
    holes::approach::PASS,
    holes::expand_cycles::PASS,
    holes::absolute_holes::PASS,
    holes::absolute_holes::ALIKE,
    // Behind the cycles, which may have been written out with stops of the spindle, and as threads.
    tools::spindle_angle::PASS,
    threads::in_step::PASS,
    holes::expand_patterns::REFORM,
    arcs::expand_turns::PASS,
    // An expanded cycle may have left an offset that was in its block to take up elsewhere.
    tools::offset_with_z::PASS,
    modes::one_move::PASS,
    // Afterwards every move names every axis.
    modes::flatten_facts::PASS,
    // What is left as it is now is what is written.
    modes::immediate_effects::PASS,
    arcs::compensated_modes::PASS,
    // Only when asked for: the contour is gone.
    arcs::expand_compensation::PASS,
    // Only when asked for: another way to write the same.
    modes::convert_units::MILLIMETRES,
    modes::convert_units::INCHES,
    arcs::convert_arcs::BY_CENTRE,
    arcs::convert_arcs::BY_RADIUS,
    holes::convert_circles::POLAR,
    holes::convert_circles::CARTESIAN,
    modes::convert_distance::ABSOLUTE,
    modes::convert_distance::INCREMENTAL,
    // The other way: long-hand text gets its structure back.
    fold::fold_cycles::PASS,
    // After the cycles, which give the holes.
    holes::feed_with_cycle::PASS,
    fold::fold_patterns::PASS,
    modes::drop_redundant::PASS,
];

/// Names of the passes that fold: moves into cycles, positions into patterns.
pub const FOLDS: &[&str] = &["fold-cycles", "feed-with-cycle", "fold-patterns"];

/// Names of the passes that a list of events goes through: it names every axis in every line.
pub const FOLDS_OF_EVENTS: &[&str] = &["fold-cycles", "feed-with-cycle", "fold-patterns", "drop-redundant"];

/// Runs a pass over each procedure; what holds before a subprogram is not known.
fn each_body(program: &mut Program, entry: &Tracker, mut over: impl FnMut(&mut Vec<Stmt>, &mut Walk)) {
    for (at, procedure) in program.procedures.iter_mut().enumerate() {
        let mut walk = Walk::new(if at == 0 { entry.clone() } else { Tracker::unknown() });
        over(&mut procedure.body, &mut walk);
    }
}
