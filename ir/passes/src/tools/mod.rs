//! Tools: their change, their length, their edges, and the way they stand.
//!
//! ```text
//! USE_TOOL_LENGTH_OFFSET(2)               tool-edge     USE_TOOL_EDGE(1), for a target whose lengths are edges
//! SELECT_TOOL(2) & CHANGE_TOOL()          tool-change   the spindle started again after it, where the target stops it
//! ```
//!
//! Not here: what a change does besides its name: the dictionary says it, and `modes::side_effects` writes it.

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
