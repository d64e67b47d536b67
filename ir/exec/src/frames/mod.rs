//! Converts program coordinates to machine coordinates: frame slots, their chain, tilted planes.
//!
//! ```text
//! SET_ORIGIN_OFFSETS(1), SET_FRAME(rotate, XY, 90deg), X 10mm    →    Y 10 mm from work offset 1
//! ```
//!
//! Not here: the codes of each control for a frame.

pub(crate) mod chain;
pub(crate) mod frame;
pub(crate) mod slots;
pub(crate) mod tilt;
