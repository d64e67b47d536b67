//! Where emitted text comes from: `translate --map`, `translate --annotate` and `ncc why`.
//!
//! While a translation streams by, `trace` joins what the writer tells of its lines (which
//! places of the source they were written from) with what the verification found (which pair of events
//! stands in which line), and keeps a few numbers for each line in an anonymous file. [`map`] makes the
//! document of them, once the output is whole; `read` reads one line of such a document back; [`why`]
//! tells about one line. `annotate` puts the source beside the text before it is verified.
//!
//! Nothing here changes what a program does, and nothing is guessed: a line of which the source does not
//! say anything has no place in it.

pub(crate) mod annotate;
pub mod args;
mod find;
pub mod map;
mod read;
mod rows;
mod spool;
mod state;
mod text;
pub mod trace;
pub mod why;
