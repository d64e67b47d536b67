//! Cycles and patterns of holes, in the form that the target has, or as their moves.

pub mod absolute_holes;
pub mod approach;
pub mod computed_holes;
pub mod convert_circles;
pub mod expand_cycles;
pub mod expand_patterns;
pub mod feed_with_cycle;
pub(crate) mod pattern_forms;
mod pecks;
pub mod planes_checked;
pub mod return_plane;
pub(crate) mod spindle_holes;
pub mod state_clearance;
