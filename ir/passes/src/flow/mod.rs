//! Calls, jumps, loops and repetitions.

pub mod control_forms;
pub mod expand_calls;
pub mod expand_repeats;
pub mod flatten;
pub mod given_back;
pub mod number_names;
pub mod passed_labels;
pub(crate) mod repeat_ends;
pub mod skip_levels;
pub mod specialise_procedures;
