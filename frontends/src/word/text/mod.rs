//! The text of a program: tokens, blocks of words, the frame of a program and of its subprograms.
//! `jumps`, `pieces` and `words` serve those who look at a text alone.
//!
//! ```text
//! N10 G1 X[#1+5] (rough)     words N10, G1 and X with an expression; a comment
//! ```
//!
//! Not here: the meaning of words.

pub(super) mod block;
pub(super) mod device_text;
pub(in crate::word) mod fast_computed;
pub(super) mod frame;
pub(crate) mod jumps;
pub(crate) mod pieces;
pub(super) mod token;
pub(crate) mod words;
