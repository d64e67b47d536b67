//! Two programs held side by side: what each does, executed in the same worlds.
//!
//! [`stream`] executes a program whole in given worlds, [`feed`] makes records of what it does; [`diff`] and [`verify`]
//! compare two of them. Not here: what a difference is (`ncc_diff`).
//!
//! ```text
//! two programs, worlds    stream    two streams of events    diff    what differs
//! ```

pub mod diff;
pub mod feed;
pub mod stream;
pub mod verify;
pub mod words;
