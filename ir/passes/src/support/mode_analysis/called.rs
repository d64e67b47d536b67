//! The cycle that is active at a hole.

use ncc_ir::canon::Modes;

/// Where the active cycle at a hole is activated, what holds there, and what holds at the hole.
#[derive(Clone, Copy, Debug)]
pub(super) struct Called {
    pub(super) at: u32,
    pub(super) with: Modes,
    pub(super) modes: Modes,
}
