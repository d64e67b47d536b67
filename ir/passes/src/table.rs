//! The table of passes.
//!
//! ```text
//! ncc passes    its names and lines, in this order
//! ```
//!
//! Not here: what a pass does, and what makes it needed (each pass has a file).

use crate::pass::Pass;

/// All passes, in the order in which they are run. Each is a constant in its own file. The legaliser, programs that compute
/// and `--pass` walk this table. Passes without functions here are run by the driver, which tells their names.
pub const PASSES: &[Pass] = &[
    // Only when asked for: after it there is nothing that computes or decides.
    crate::flow::flatten::PASS,
    // Of a program that is kept whole.
    crate::flow::unused_labels::PASS,
    // What the user states, only the driver knows.
    Pass::named(
        "values-at-start",
        "sets variables to what the user states that they hold at the start",
        None,
    ),
    crate::modes::side_effects::PASS,
    crate::legalise::messages::OUTPUT,
    crate::values::alarm_numbers::TEXTS,
    crate::values::alarm_numbers::NUMBERS,
    crate::tools::machine_numbers::TOOL_NAMES,
    crate::legalise::messages::VALUES,
    crate::flow::known_modes::CODES_PUT_BACK,
    crate::flow::known_modes::CODES,
    crate::flow::expand_repeats::COMPUTED,
    crate::frames::machine_cuts::PASS,
    crate::holes::cycle_plane_check::PASS,
    crate::holes::computed_holes::PASS,
    crate::values::exact_comparisons::PASS,
    crate::values::message_values::PASS,
    crate::flow::control_forms::PASS,
    crate::values::arithmetic::PASS,
    crate::flow::known_modes::KNOWN_FACTS,
    crate::arcs::centres_from_start::PASS,
    crate::frames::spindle_points::PASS,
    crate::values::unit_in_force::PASS,
    crate::flow::known_modes::DEPTH,
    crate::values::variables::PASS,
    crate::tools::machine_numbers::PASS,
    crate::flow::specialise_procedures::PASS,
    crate::flow::expand_calls::PASS,
    crate::flow::number_names::PASS,
    crate::frames::computed_frames::PASS,
    // As a piece comes.
    crate::frames::rotary_turns::PASS,
    crate::tools::length_axis::PASS,
    crate::frames::offset_here::PASS,
    crate::tools::z_after_change::PASS,
    crate::frames::frame_increments::PASS,
    crate::tools::tool_change::PASS,
    crate::modes::feed_unit::AGAIN,
    crate::modes::feed_time::PASS,
    // What says where things are. Points by radius and angle come before everything that looks at coordinates.
    crate::flow::expand_repeats::PASS,
    crate::arcs::polar_words::PASS,
    crate::frames::work_offset::PASS,
    crate::modes::path_control::PASS,
    crate::frames::rotary_ways::PASS,
    crate::flow::skip_levels::PASS,
    crate::arcs::expand_corners::PASS,
    crate::frames::expand_frames::PASS,
    // A shift that the program has set itself is over by now.
    crate::frames::origin_shift::PASS,
    crate::frames::machine_moves::PASS,
    // All else. Every pass walks from the beginning of the piece: what it walks over does what the piece does.
    crate::arcs::convert_arcs::FINE,
    crate::arcs::arc_form::PASS,
    crate::modes::feed_unit::PASS,
    crate::modes::one_distance::PASS,
    crate::tools::tool_edge::PASS,
    crate::tools::length_by_hand::PASS,
    // After the lengths, which say what is active.
    crate::tools::tool_axis::PASS,
    crate::arcs::cutter_radius::PASS,
    crate::arcs::still_blocks::PASS,
    crate::legalise::refuse::PASS,
    crate::threads::in_step::AS_CYCLES,
    crate::threads::tapped_holes::PASS,
    crate::holes::state_clearance::PASS,
    crate::threads::taps::PASS,
    // Before the patterns: a first hole may come out of one.
    crate::holes::return_plane::PASS,
    // Before the cycles, so that a kept cycle gets its positions.
    crate::holes::expand_patterns::PASS,
    // Before the cycles: what it mends need not be expanded.
    crate::holes::approach::PASS,
    crate::holes::expand_cycles::PASS,
    crate::holes::absolute_holes::PASS,
    crate::holes::absolute_holes::ALIKE,
    // After the cycles, which may have been written out with stops of the spindle, and as threads.
    crate::tools::spindle_angle::PASS,
    crate::threads::in_step::PASS,
    crate::holes::expand_patterns::REFORM,
    crate::arcs::expand_turns::PASS,
    // An expanded cycle may have left an offset that was in its block to apply elsewhere.
    crate::tools::offset_with_z::PASS,
    crate::modes::one_move::PASS,
    // Afterwards every move names every axis.
    crate::modes::flatten_facts::PASS,
    // What is left as it is now is what is written.
    crate::modes::immediate_effects::PASS,
    crate::arcs::compensated_modes::PASS,
    // Only when asked for: the contour is gone.
    crate::arcs::expand_compensation::PASS,
    // Only when asked for: another way to write the same.
    crate::modes::convert_units::MILLIMETRES,
    crate::modes::convert_units::INCHES,
    crate::arcs::convert_arcs::BY_CENTRE,
    crate::arcs::convert_arcs::BY_RADIUS,
    crate::holes::convert_circles::POLAR,
    crate::holes::convert_circles::CARTESIAN,
    crate::modes::convert_distance::ABSOLUTE,
    crate::modes::convert_distance::INCREMENTAL,
    // The other way: long-hand text gets its structure back.
    crate::fold::fold_cycles::PASS,
    // After the cycles, which give the holes.
    crate::holes::feed_with_cycle::PASS,
    crate::fold::fold_patterns::PASS,
    crate::modes::drop_redundant::PASS,
];

/// Names of the passes that fold: moves into cycles, positions into patterns.
pub const FOLDS: &[&str] = &["fold-cycles", "feed-with-cycle", "fold-patterns"];

/// Names of the passes that a list of events goes through: it names every axis in every line.
pub const FOLDS_OF_EVENTS: &[&str] = &["fold-cycles", "feed-with-cycle", "fold-patterns", "drop-redundant"];
