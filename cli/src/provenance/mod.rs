//! `ncc why`: which lines of the source a line of a translated program comes from.
//!
//! `read` reads one line of a map, or `find` makes the map again, and `why` tells about the line. Not here: how a map is
//! made (`ncc_driver::provenance`).
//!
//! ```text
//! ncc why part.mpf:12    line 12 comes from line 7 of part.nc: `G81 …`
//! ```

pub mod args;
mod find;
mod read;
pub mod why;
