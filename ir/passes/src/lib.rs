//! ncc-passes: rewriting a program so that a target can say it, with the machine doing the same.
//!
//! A pass is a plain function on a program, listed in [`PASSES`] and runnable alone. Which ones a
//! target needs follows from its capabilities; [`Legaliser`] picks them and runs them on a program
//! that streams through in pieces. A pass never names a dialect, and never changes what the machine
//! does: what it cannot mend it refuses.

pub mod arcs;
pub mod flow;
pub mod fold;
pub mod frames;
pub mod holes;
mod legalise;
pub mod modes;
pub mod support;
pub mod threads;
pub mod tools;
pub mod values;
pub mod watch;

pub use arcs::expand_compensation::Compensating;
pub use frames::machine_moves::retract;
pub use legalise::Legaliser;
pub use legalise::messages::{leave_out_output, leave_out_values, output_elsewhere};

use std::collections::{BTreeMap, BTreeSet};

use ncc_exec::world::Sideways;
use ncc_ir::behaviour::Behaviours;
use ncc_ir::caps::Caps;
use ncc_ir::diag::Diagnostic;
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

/// A pass.
#[derive(Clone, Copy, Debug)]
pub struct Pass {
    /// Its name.
    pub name: &'static str,
    /// What it does, in a line.
    pub about: &'static str,
    /// Runs it alone. The tracker says what holds before the main procedure.
    pub run: fn(&mut Program, &Target, &Tracker, &mut Vec<Diagnostic>),
}

/// All passes, in the order in which they are run.
pub const PASSES: &[Pass] = &[
    // Only when asked for: behind it there is nothing that computes or decides.
    Pass {
        name: "flatten",
        about: "executes what computes and decides, and writes straight blocks",
        run: flow::flatten::run,
    },
    // Before the calls are written out: what callers disagree about may be all that is missing.
    Pass {
        name: "specialise-procedures",
        about: "gives subprograms what their callers have in force, a copy for each that differs",
        run: flow::specialise_procedures::run,
    },
    Pass {
        name: "expand-calls",
        about: "writes subprograms out where they are called",
        run: flow::expand_calls::run,
    },
    Pass {
        name: "number-names",
        about: "gives subprograms numbers where the target calls by number",
        run: flow::number_names::run,
    },
    Pass { name: "expand-repeats", about: "writes counted repetitions out", run: flow::expand_repeats::run },
    Pass {
        name: "work-offset",
        about: "lets the target's only work offset stand for the program's only one",
        run: frames::work_offset::run,
    },
    Pass {
        name: "origin-shift",
        about: "takes a target that cannot cancel a shift of the origin to start without one",
        run: frames::origin_shift::run,
    },
    Pass {
        name: "skip-levels",
        about: "makes block-skip levels that the target cannot tell apart one",
        run: flow::skip_levels::run,
    },
    Pass {
        name: "path-control",
        about: "says how corners are taken, and advice to the control, in the target's words",
        run: modes::path_control::run,
    },
    Pass {
        name: "rotary-ways",
        about: "says by plain words which way round rotary axes go",
        run: frames::rotary_ways::run,
    },
    Pass {
        name: "feed-unit",
        about: "writes feeds in the unit of length in force",
        run: modes::feed_unit::run,
    },
    Pass {
        name: "feed-time",
        about: "says by their time moves whose feed the target counts otherwise",
        run: modes::feed_time::run,
    },
    Pass {
        name: "one-distance",
        about: "measures the words of a block in one way",
        run: modes::one_distance::run,
    },
    Pass {
        name: "state-clearance",
        about: "states what one control leaves to a parameter of a cycle",
        run: holes::state_clearance::run,
    },
    Pass {
        name: "tool-edge",
        about: "names tool lengths by edges of the tool or by entries of a table",
        run: tools::tool_edge::run,
    },
    // Behind the lengths, which say what is in force.
    Pass {
        name: "tool-axis",
        about: "says control of the tool's tip and tilted planes in the target's form",
        run: tools::tool_axis::run,
    },
    Pass {
        name: "cutter-radius",
        about: "names the radius of cutter radius compensation as the target does",
        run: arcs::cutter_radius::run,
    },
    // Before everything that looks at coordinates.
    Pass {
        name: "polar-words",
        about: "says points by radius and angle in the target's form, or by coordinates",
        run: arcs::polar_words::run,
    },
    Pass {
        name: "expand-corners",
        about: "writes rounded and chamfered corners as arcs and lines",
        run: arcs::expand_corners::run,
    },
    Pass {
        name: "expand-frames",
        about: "works chains of frames into the coordinates",
        run: frames::expand_frames::run,
    },
    Pass { name: "taps", about: "says pitches of threads in the target's form", run: threads::taps::run },
    // Before the patterns: a first hole may come out of one.
    Pass {
        name: "return-plane",
        about: "says where cycles leave the tool by planes or by levels",
        run: holes::return_plane::run,
    },
    // Before the cycles, so that a kept cycle gets its positions.
    Pass {
        name: "expand-patterns",
        about: "says patterns of holes in the target's form, or as positions",
        run: holes::expand_patterns::run,
    },
    // Before the cycles: what it mends need not be expanded.
    Pass {
        name: "approach",
        about: "writes the first leg to a hole out where the target would go another way",
        run: holes::approach::run,
    },
    Pass {
        name: "expand-cycles",
        about: "turns canned cycles into their moves",
        run: holes::expand_cycles::run,
    },
    // Behind the cycles, which may have been written out with stops of the spindle.
    Pass {
        name: "spindle-angle",
        about: "states the angle at which the spindle stops where the target needs it",
        run: tools::spindle_angle::run,
    },
    // Behind the cycles, which may have been written out as threads.
    Pass { name: "threads", about: "says threads in the target's form", run: threads::in_step::run },
    Pass {
        name: "absolute-holes",
        about: "measures planes and positions of cycles from program zero",
        run: holes::absolute_holes::run,
    },
    // Before the turns, which belong to arcs with a centre.
    Pass {
        name: "arc-form",
        about: "writes arcs by angle, through a point or tangent by their centre",
        run: arcs::arc_form::run,
    },
    Pass {
        name: "expand-turns",
        about: "splits arcs of several turns into single turns",
        run: arcs::expand_turns::run,
    },
    // After the cycles, whose moves along Z can take an offset up.
    Pass {
        name: "machine-moves",
        about: "moves in machine coordinates and to points of the machine in the target's form",
        run: frames::machine_moves::run,
    },
    Pass {
        name: "offset-with-z",
        about: "moves a tool-length offset into the block that takes it up",
        run: tools::offset_with_z::run,
    },
    Pass {
        name: "one-move",
        about: "puts an exact stop of one move, and its feed by time, into the block of the move",
        run: modes::one_move::run,
    },
    // Last: afterwards every move names every axis.
    Pass {
        name: "flatten-facts",
        about: "gives every move all its axes, from program zero",
        run: modes::flatten_facts::run,
    },
    // Only when asked for: the contour is gone.
    Pass {
        name: "expand-compensation",
        about: "writes the path of the tool's centre for cutter radius compensation",
        run: arcs::expand_compensation::run,
    },
    // Only when asked for: another way to write the same.
    Pass {
        name: "millimetres",
        about: "writes lengths and feeds in millimetres",
        run: modes::convert_units::millimetres,
    },
    Pass { name: "inches", about: "writes lengths and feeds in inches", run: modes::convert_units::inches },
    Pass {
        name: "arcs-by-centre",
        about: "gives arcs by radius their centre",
        run: arcs::convert_arcs::by_centre,
    },
    Pass {
        name: "arcs-by-radius",
        about: "gives arcs their radius instead of the centre, where it says the same",
        run: arcs::convert_arcs::by_radius,
    },
    Pass {
        name: "polar-circles",
        about: "gives the first hole of a circle by radius and angle",
        run: holes::convert_circles::polar,
    },
    Pass {
        name: "cartesian-circles",
        about: "gives the first hole of a circle by its position",
        run: holes::convert_circles::cartesian,
    },
    Pass {
        name: "absolute",
        about: "measures words of moves from program zero",
        run: modes::convert_distance::absolute,
    },
    Pass {
        name: "incremental",
        about: "measures words of moves from where the axes stand",
        run: modes::convert_distance::incremental,
    },
    // The other way: long-hand text gets its structure back.
    Pass {
        name: "fold-cycles",
        about: "turns holes written long-hand into canned cycles",
        run: fold::fold_cycles::run,
    },
    // After the cycles, which give the holes.
    Pass {
        name: "feed-with-cycle",
        about: "lets a cycle say the feed that stands right before it",
        run: holes::feed_with_cycle::run,
    },
    Pass {
        name: "fold-patterns",
        about: "turns positions of holes into circles, grids, lines and lists",
        run: fold::fold_patterns::run,
    },
    Pass {
        name: "drop-redundant",
        about: "leaves out statements that change nothing",
        run: modes::drop_redundant::run,
    },
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
