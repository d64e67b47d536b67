//! The comments that LinuxCNC's interpreter writes between its calls, letter for letter.
//!
//! ```text
//! G90    COMMENT("interpreter: distance mode changed to absolute")
//! ```

use ncc_ir::canon::{Distance, FeedMode, ReturnLevel, Side};

/// G40.
pub(super) const COMPENSATION_OFF: &str = "cutter radius compensation off";

/// A work offset that is active already.
pub(super) const SAME_OFFSET: &str = "continuing to use same coordinate system";

/// G10 L2.
pub(super) const OFFSET_SET: &str = "setting coordinate system origin";

/// G90, G91.
pub(super) fn distance(distance: Distance) -> &'static str {
    match distance {
        Distance::Absolute => "distance mode changed to absolute",
        Distance::Incremental => "distance mode changed to incremental",
    }
}

/// G98, G99.
pub(super) fn return_level(level: ReturnLevel) -> &'static str {
    match level {
        ReturnLevel::Initial => "retract mode set to old_z",
        ReturnLevel::Retract => "retract mode set to r_plane",
    }
}

/// G41, G42.
pub(super) fn compensation(side: Side) -> &'static str {
    match side {
        Side::Left => "cutter radius compensation on left",
        Side::Right => "cutter radius compensation on right",
    }
}

/// G93 to G95.
pub(super) fn feed_mode(mode: FeedMode) -> &'static str {
    match mode {
        FeedMode::PerMinute => "feed mode set to units per minute",
        FeedMode::PerRevolution => "feed mode set to units per revolution",
        FeedMode::InverseTime => "feed mode set to inverse time",
    }
}
