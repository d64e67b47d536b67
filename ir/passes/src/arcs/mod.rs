//! Arcs, corners, polar points, and the contour beside which the tool goes.
//!
//! ```text
//! ARC_FEED(XY, clockwise, X 10mm, radius 10mm)    arcs-by-centre    … centre(start, I 10mm, J 0mm))
//! ROUND_CORNER(3mm) & STRAIGHT_FEED(X 20mm)       expand-corners    a line, an arc of 3 mm, the next line
//! ```
//!
//! Not here: how long an arc is, and where its centre lies: `ncc_ir::geometry`.

pub mod arc_form;
pub(crate) mod arc_radii;
pub mod centres_from_start;
pub(crate) mod compensated_modes;
pub mod convert_arcs;
pub mod cutter_radius;
pub mod expand_compensation;
pub(crate) mod expand_corners;
pub mod expand_turns;
pub(crate) mod polar_places;
pub mod polar_words;
pub(crate) mod still_blocks;
