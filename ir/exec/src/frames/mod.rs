//! Between the program's coordinates and the machine's: slots, their chain, tilted planes.
//!
//! ```text
//! SET_ORIGIN_OFFSETS(1), SET_FRAME(rotate, XY, 90deg), X 10mm    Y 10 mm from the place of work offset 1, in machine coordinates
//! ```
//!
//! Not here: which words a control has for a frame.

pub(crate) mod chain;
pub(crate) mod frame;
pub(crate) mod slots;
pub(crate) mod tilt;
