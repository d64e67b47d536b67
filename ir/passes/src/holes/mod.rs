//! Cycles and patterns of holes, in the form that the target has, or as their moves.
//!
//! ```text
//! START_CYCLE(drill-peck …), HOLE(X 10mm)    expand-cycles      rapids and feeds, stroke by stroke
//! CIRCLE_PATTERN(… count 12)                 expand-patterns    twelve HOLEs
//! ```
//!
//! Not here: cycles that drive the spindle by a pitch (`threads`), and folding (`fold`).

pub mod absolute_holes;
pub mod approach;
pub mod computed_holes;
pub mod convert_circles;
pub mod cycle_plane_check;
pub mod expand_cycles;
pub mod expand_patterns;
pub mod feed_with_cycle;
pub(crate) mod pattern_forms;
mod pecks;
pub mod return_plane;
pub(crate) mod sayable;
mod series;
pub(crate) mod spindle_holes;
pub mod state_clearance;
