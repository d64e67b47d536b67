//! Between the program's coordinates and the machine's: slots, their chain, tilted planes.

pub(crate) mod frame;
pub(crate) mod slots;
pub(crate) mod tilt;
