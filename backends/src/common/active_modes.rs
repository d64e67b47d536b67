//! What is active in the text that has been written, as far as the text itself says it.

use ncc_ir::canon::{Distance, FeedMode, Motion, Plane, ReturnLevel, SpindleMode, Units};
use ncc_ir::expr::num::Num;

/// Modes of the written text. `None` is not known: at the start, after a call, where ways meet.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct ActiveModes {
    pub motion: Option<Motion>,
    pub distance: Option<Distance>,
    pub units: Option<Units>,
    pub plane: Option<Plane>,
    pub feed_mode: Option<FeedMode>,
    pub spindle_mode: Option<SpindleMode>,
    /// The limit of the spindle that the program has active.
    pub limit: Option<Num>,
    pub level: Option<ReturnLevel>,
    /// The feed, if it was stated in the units and the feed mode that are active.
    pub feed: Option<Num>,
    /// Whether the distance mode was put in by this writer, so that statements which take what the
    /// source has active cannot be written.
    pub our_distance: bool,
    /// The same for the plane.
    pub our_plane: bool,
    /// The same for the return level; one of ours is stated again with every call of a cycle.
    pub our_level: bool,
}

impl ActiveModes {
    /// What holds if the block between `before` and now may have been skipped.
    pub(crate) fn join(&mut self, before: &ActiveModes) {
        fn both<T: PartialEq>(a: &mut Option<T>, b: &Option<T>) {
            if a != b {
                *a = None;
            }
        }
        both(&mut self.motion, &before.motion);
        both(&mut self.distance, &before.distance);
        both(&mut self.units, &before.units);
        both(&mut self.plane, &before.plane);
        both(&mut self.feed_mode, &before.feed_mode);
        both(&mut self.spindle_mode, &before.spindle_mode);
        both(&mut self.limit, &before.limit);
        both(&mut self.level, &before.level);
        both(&mut self.feed, &before.feed);
        self.our_distance |= before.our_distance;
        self.our_plane |= before.our_plane;
        self.our_level |= before.our_level;
    }
}
