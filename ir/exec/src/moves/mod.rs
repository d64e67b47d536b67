//! Moves: lines, arcs, corners, the contour beside which the tool goes, cycles, and how long each takes.
//!
//! ```text
//! HOLE(X 10mm) under drill-peck    rapid, feed, rapid, feed …: one event each
//! ARC_FEED(…) with a feed          one event with its centre, normal and sweep
//! ```
//!
//! Not here: when a move happens: `ncc_time` has the clock.

pub(crate) mod arcs;
pub(crate) mod carried;
pub(crate) mod centre_path;
pub(crate) mod compensation;
pub(crate) mod corner;
pub(crate) mod emit;
pub(crate) mod fine;
pub(crate) mod holes;
pub(crate) mod lines;
pub(crate) mod pace;
pub(crate) mod polar;
pub(crate) mod rotary;
#[cfg(test)]
pub(crate) mod sketch;
pub(crate) mod speed;
pub(crate) mod standing;
pub(crate) mod thread;
