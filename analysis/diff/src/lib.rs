//! ncc-diff: differences of two executed programs, as data.
//!
//! Each event becomes a [`record`] of 64 bytes. After an insertion or a deletion, [`resync`] and
//! [`align`] bring the two streams of records together again; a shift of a whole tail is one
//! [`change`]. Streams are consumed as they come: nothing is kept while they agree.
//!
//! ```text
//! a: G1 X10.  G1 X20.
//! b: G1 X10.  G1 X15.  G1 X20.      one change: the move to X15 is in b alone
//! ```
//!
//! Not here: executing programs, files, words for people, any dialect's name.

pub mod align;
pub mod change;
pub mod measure;
pub mod record;
pub mod resync;
pub mod tape;

#[cfg(test)]
mod judge;
