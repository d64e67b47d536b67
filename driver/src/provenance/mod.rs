//! Where emitted text comes from: the record of a translation, and the map that is made of it.
//!
//! While a translation streams by, [`trace`] joins what the writer tells of its lines (which places of the source they
//! were written from) with what the verification found (which pair of events stands in which line), and keeps a few
//! numbers for each line in a [`spool`]. [`map`] makes the document of them, once the output is whole; [`state`] tells
//! what is active at a line. [`annotate`] puts the source beside the text before it is verified.
//!
//! Nothing here changes what a program does, and nothing is guessed: a line of which the source does not say anything
//! has no place in it.
//!
//! ```text
//! line 12 of the output    trace    bytes 87 to 103 of the source, events 40 to 42
//! ```

pub mod annotate;
pub mod map;
pub mod pairs;
pub mod rows;
mod shapes;
pub mod spool;
pub mod state;
pub mod text;
pub mod trace;
