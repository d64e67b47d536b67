//! Lowering of moves: lines, arcs, threads, probing, and what changes the path of a move.
//!
//! ```text
//! G2 X10. Y5. I3. J0.        an arc with its centre
//! G28 Z0.                    a rapid move to the reference point, past Z0
//! ```
//!
//! Not here: canned cycles.

pub(super) mod compensation;
pub(super) mod corner;
pub(super) mod detour;
pub(super) mod machine;
pub(super) mod motion;
pub(super) mod motion_without_move;
pub(super) mod polar;
pub(super) mod probe;
pub(super) mod thread;
pub(super) mod tilt;
