//! What is active: units, distances, feeds, path control, and what codes do besides their name.
//!
//! ```text
//! STRAIGHT_FEED(X inc 1mm), in a block of absolute words    one-distance    STRAIGHT_FEED(X 11mm)
//! PROGRAM_STOP(), on a control that stops the spindle       side-effects    STOP_SPINDLE() before it
//! ```
//!
//! Not here: frames and lengths of tools, which say where a position is (`frames`, `tools`).

pub mod convert_distance;
pub mod convert_units;
pub mod drop_redundant;
pub mod feed_time;
pub mod feed_unit;
pub(crate) mod fine_digits;
pub mod flatten_facts;
pub(crate) mod immediate_effects;
pub mod one_distance;
pub mod one_move;
pub(crate) mod path_control;
pub mod side_effects;
pub mod word_distance;
