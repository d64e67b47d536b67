//! ncc-diff: what two programs do, held side by side.
//!
//! Events of execution become [`record`]s of 64 bytes; two streams of them are brought together again
//! after insertions, and under a shift of a whole tail ([`resync`], [`align`]); what is not the same is
//! told as typed [`change`]s. Streams are consumed as they come: while they agree, nothing is kept.
//!
//! Not here: executing programs, files, words for people, any dialect's name.

pub mod align;
pub mod change;
pub mod measure;
pub mod record;
pub mod resync;

#[cfg(test)]
mod judge;
