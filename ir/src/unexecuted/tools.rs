//! Tools and their tables that ncc does not execute.

use crate::reason::reasons;

reasons! {
    /// Tools and their tables that ncc does not execute.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ToolUnexecuted {
        /// A tool length that moves its axis under an arc or a cycle.
        LengthUnderArc,
        /// A tool length that moves its axis in a cycle, a contour or a tilted plane.
        LengthInCycle,
        /// An incremental move along Z that activates a length.
        IncrementTakesLength,
        /// Another offset of the tool along X or Y in a cycle, a contour or a tilted plane.
        OffsetInCycle,
        /// Another radius for the current tool.
        RadiusInUse,
        /// Another length for the current tool.
        LengthInUse,
        /// A tool measured in a frame that turns or scales, or beside a contour.
        MeasuredInFrame,
    }
}
