//! ncc-review: what two programs do, held side by side.
//!
//! Events of execution become [`record`]s of 64 bytes; two streams of them are aligned ([`align`],
//! [`resync`]) after insertions and under a shift of a whole tail; what is not the same is told as
//! typed [`change`]s, and [`sum`]med up. Streams are consumed as they come: while they agree, nothing
//! is kept.
//!
//! Not here: executing programs, files, words for people, any dialect's name.

pub mod align;
pub mod measure;
pub mod record;
