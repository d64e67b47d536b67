//! Lowering of canned cycles and hole patterns.
//!
//! ```text
//! G81 X10. Z-5. R2. F100.    a cycle becomes active, with a hole at X10.
//! X20.                       a further hole
//! ```
//!
//! Not here: the moves of a hole; the executor and passes have those.

pub(super) mod cycle;
mod dwells;
mod kind;
mod levels;
pub(super) mod no_cycle;
pub(super) mod pattern;
