//! Arcs, corners, polar points, and the contour beside which the tool goes.

pub mod arc_form;
pub(crate) mod arc_radii;
pub mod centres_from_start;
pub(crate) mod compensated_modes;
pub mod convert_arcs;
pub mod cutter_radius;
pub mod expand_compensation;
pub(crate) mod expand_corners;
pub mod expand_turns;
pub mod polar_words;
pub(crate) mod still_blocks;
