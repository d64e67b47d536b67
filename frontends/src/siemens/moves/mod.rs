//! Lowering of moves: lines, arcs, threads, corners, points by radius and angle.
//!
//! ```text
//! G2 X10 Y5 CR=8             an arc by its radius
//! G33 Z-20 K1.5              a thread
//! ```
//!
//! Not here: cycles.

pub(super) mod corner;
pub(super) mod motion;
pub(super) mod motion_without_move;
pub(super) mod polar;
pub(super) mod synchronised;
pub(super) mod tilt;
