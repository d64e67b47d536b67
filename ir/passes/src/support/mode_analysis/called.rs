//! The cycle that is in force at a hole.

use ncc_ir::canon::Modes;

/// Where the cycle in force at a hole is called up, what holds there, and what holds at the hole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Called {
    pub(super) at: u32,
    pub(super) with: Modes,
    pub(super) modes: Modes,
}
