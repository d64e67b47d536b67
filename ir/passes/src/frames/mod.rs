//! Frames, work offsets, machine coordinates, and rotary axes.
//!
//! ```text
//! SET_FRAME(rotate, XY, 30deg)        expand-frames    positions that are turned by 30 degrees
//! SET_ORIGIN_OFFSETS(1)           work-offset      nothing, for a target that has one work offset alone
//! ```
//!
//! Not here: where a frame puts a position: `ncc_exec::frames` executes it.

pub mod computed_frames;
pub mod expand_frames;
pub(crate) mod frame_forms;
pub mod frame_increments;
pub mod machine_cuts;
pub mod machine_moves;
pub(crate) mod offset_here;
pub mod origin_shift;
pub mod rotary_turns;
pub(crate) mod rotary_ways;
pub mod spindle_points;
pub mod work_offset;
