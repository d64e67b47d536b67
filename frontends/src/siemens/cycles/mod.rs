//! Lowering of cycles and hole patterns that are called with arguments.
//!
//! ```text
//! MCALL CYCLE81(10,0,2,-5)   a cycle becomes active
//! HOLES1(0,0,0,10,20,5)      five holes in a row
//! ```
//!
//! Not here: the moves of a hole; the executor and passes have those.

pub(super) mod computed_cycles;
pub(super) mod drilling;
pub(super) mod patterns;
pub(super) mod threads;
