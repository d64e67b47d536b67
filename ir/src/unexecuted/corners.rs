//! Rounded and chamfered corners that ncc does not execute.

use crate::reason::reasons;

reasons! {
    /// Rounded and chamfered corners that ncc does not execute.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum CornerUnexecuted {
        /// Two corners after one move.
        TwoAfterMove,
        /// Something other than settings between the moves of a corner.
        NotSettings,
        /// A move in machine coordinates at a corner.
        MachineMove,
        /// A probing move at a corner.
        Probing,
        /// A rapid move by a detour at a corner.
        Detour,
        /// A corner of a contour whose tool centre path ncc computes.
        OnContour,
        /// A corner with the tool's axis turned.
        AxisTurned,
        /// A tangent arc after a corner.
        TangentArc,
        /// An arc of several turns at a corner.
        SeveralTurns,
        /// A corner beside a full circle.
        FullCircle,
        /// A corner in a frame that does not leave it one.
        Frame,
        /// A corner beside a rapid.
        Rapid,
        /// A corner beside another move than a line or an arc at feed.
        OtherMove,
        /// A corner between moves whose feed is their time.
        FeedByTime,
        /// A corner between moves of different feeds.
        DifferentFeeds,
        /// A corner between moves with different path modes.
        DifferentPath,
        /// A corner in a frame that scales.
        Scaled,
        /// A corner of less than a degree.
        Slight,
        /// A chamfer beside an arc.
        ChamferAtArc,
    }

    /// Corners that no control makes.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum NoCorner {
        /// A corner of no size.
        NoSize,
        /// Another plane at the corner.
        PlaneChanges,
        /// A move without motion at the corner.
        NoMotion,
        /// A move at the corner that leaves the plane.
        LeavesPlane,
        /// The second move returns along the first.
        TurnsBack,
        /// The corner is larger than its moves.
        TooLarge,
        /// No move follows in the plane.
        NoNextMove,
    }
}
