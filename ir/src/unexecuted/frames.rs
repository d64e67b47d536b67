//! Frames, tilted planes and tool centre point control that ncc does not execute.

use crate::reason::reasons;

reasons! {
    /// Frames, tilted planes and tool centre point control that ncc does not execute.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum FrameUnexecuted {
        /// A work offset set by the position under a frame.
        OffsetByPosition,
        /// A frame that depends on where the axes stand in a turned work offset.
        TurnedOffsetPosition,
        /// Coordinates of the present point in a frame that turns or scales.
        PresentPointTurned,
        /// Coordinates of the present point in a frame of a turned offset.
        PresentPointOffset,
        /// An origin shift of which an earlier program has numbers.
        EarlierShift,
        /// An incremental word after a frame that turns.
        IncrementAfterTurn,
        /// Tool centre point control in a tilted plane.
        TipInTilt,
        /// Tool centre point control under a frame.
        TipUnderFrame,
        /// A tilted plane under tool centre point control.
        TiltUnderTip,
        /// A tilted plane under a frame.
        TiltUnderFrame,
        /// A tilted plane in another one.
        TiltInTilt,
        /// The end of a tilted plane under another frame.
        TiltEndUnderFrame,
        /// The tool's axis turned without a tilted plane.
        AxisWithoutTilt,
        /// The tool's axis turned under a cycle or a compensated contour.
        AxisInCycle,
        /// Another frame or work offset under tool centre point control.
        FrameUnderTip,
        /// Another frame or work offset in a tilted plane.
        FrameInTilt,
        /// An arc under tool centre point control.
        ArcUnderTip,
        /// A cycle under tool centre point control.
        CycleUnderTip,
        /// A thread under tool centre point control.
        ThreadUnderTip,
        /// Cutter compensation under tool centre point control.
        CompensationUnderTip,
        /// A reference point under tool centre point control.
        MachinePointUnderTip,
        /// Probing under tool centre point control.
        ProbingUnderTip,
        /// A rapid move by a detour under tool centre point control.
        DetourUnderTip,
        /// A tool change under tool centre point control.
        ToolChangeUnderTip,
        /// Other units under tool centre point control.
        UnitsUnderTip,
    }
}
