//! Calls, jumps, loops and repetitions.
//!
//! ```text
//! REPEAT_BLOCKS("A", times 2)    expand-repeats    the blocks after label A, twice more
//! CALL("8000")                   expand-calls      the body of subprogram 8000, in its place
//! ```
//!
//! Not here: what is computed on the way (`values`).

pub mod control_forms;
pub mod expand_calls;
pub mod expand_repeats;
pub mod flatten;
pub(crate) mod known_modes;
pub mod number_names;
pub(crate) mod repeat_ends;
pub mod restored_modes;
pub mod skip_levels;
pub mod specialise_procedures;
pub mod unused_labels;
