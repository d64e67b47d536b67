//! Tools: their change, their length, their edges, and the way they stand.

pub(crate) mod length_axis;
pub(crate) mod length_by_hand;
pub(crate) mod length_moves;
pub mod machine_numbers;
pub mod offset_with_z;
pub(crate) mod spindle_angle;
pub mod tool_axis;
pub(crate) mod tool_change;
pub mod tool_edge;
pub(crate) mod tool_words;
pub(crate) mod z_after_change;
