//! What ncc does not translate: modes that a subprogram saves and restores.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: modes that a subprogram saves and restores.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum SaveUnsupported {
        /// Ncc does not know the modes of this program.
        Unknown,
        /// The subprogram changes another frame than TRANS or ROT.
        OtherFrame,
        /// The subprogram changes a setting of the control.
        Advice,
        /// The subprogram changes the unit of length.
        Units,
        /// The subprogram changes the feed mode.
        FeedMode,
        /// The subprogram changes the speed mode.
        SpeedMode,
        /// The subprogram changes cutter compensation.
        Compensation,
        /// The subprogram changes the work offset and its value.
        OffsetChanged,
        /// Ncc does not know the plane at this call.
        Plane,
        /// G90 or G91 at this call?
        Distance,
        /// Ncc does not know the work offset at this call.
        Offset,
        /// Caller and subprogram have a frame each.
        CallersFrame,
        /// Exact stop or path blending at this call?
        Path,
        /// Another motion than G0 or G1 at this call.
        Motion,
        /// A call with a repeat count.
        Repeated,
    }
}
