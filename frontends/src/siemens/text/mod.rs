//! The text of a program: tokens, the syntax tree of a block, lines that frame units.
//! `jumps`, `pieces` and `words` serve those who look at a text alone.
//!
//! ```text
//! N10 G1 X=R1+5 F200 ; rough     items N10, G1, X with an expression, F200; a comment
//! ```
//!
//! Not here: the meaning of words.

pub(super) mod build;
pub(super) mod fast_computed;
pub(crate) mod jumps;
pub(super) mod letters;
pub(super) mod parse;
pub(crate) mod pieces;
pub(super) mod token;
pub(super) mod tree;
pub(super) mod unit;
pub(crate) mod words;
