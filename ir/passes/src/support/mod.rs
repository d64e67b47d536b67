//! What passes share: walking a body, known facts, needs, writing.
//!
//! ```text
//! Walk         where the tool is, and what is active, statement by statement
//! needs        which statements need which pass: a bit for each
//! States       what each pass remembers from piece to piece
//! ```
//!
//! Not here: anything that changes a program by itself.

pub mod mode_analysis;
pub(crate) mod needs;
pub(crate) mod settle;
pub(crate) mod shared_map;
pub(crate) mod states;
pub(crate) mod walk;
pub(crate) mod write;
