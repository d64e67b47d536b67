//! Threads: taps, and moves in step with the spindle.

pub mod in_step;
pub(crate) mod tapped_holes;
pub mod taps;
