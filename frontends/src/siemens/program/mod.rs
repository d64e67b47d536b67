//! The flow of a program: structures, labels, jumps, calls and their parameters.
//!
//! ```text
//! WHILE R1<5                 a loop
//! POCKET(10,R2)              a call with two arguments
//! ```
//!
//! Not here: expressions (`values`).

pub(super) mod calls;
pub(super) mod flow;
pub(super) mod handed;
pub(super) mod labels;
pub(super) mod open_structures;
pub(super) mod parameters;
pub(super) mod repeated_blocks;
