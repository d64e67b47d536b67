//! Threads: taps, and spindle-synchronised moves.
//!
//! ```text
//! START_CYCLE(tap-rigid(clockwise, pitch 1.25mm), …)    taps       by the feed and speed active: F500 at S400
//! SYNCHRONISED_FEED(Z -12mm, pitch 1mm), and back    threads    a tapping cycle, where the target has no such move
//! ```
//!
//! Not here: threads on a lathe.

pub mod in_step;
pub(crate) mod tapped_holes;
pub mod taps;
