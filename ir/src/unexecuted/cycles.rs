//! Canned cycles and holes that ncc does not execute.

use crate::reason::reasons;

reasons! {
    /// Canned cycles and holes that ncc does not execute.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum CycleUnexecuted {
        /// A program that begins again while a cycle is active.
        BeginsAgainInCycle,
        /// A tool change while a cycle is active.
        ToolChangeInCycle,
        /// A return to a reference point while a cycle is active.
        ReturnInCycle,
        /// A rapid move by a detour while a cycle is active.
        DetourInCycle,
        /// A move of the machine, or a probing one, while a cycle is active.
        MachineMoveInCycle,
        /// Data input while a cycle is active.
        DataInCycle,
        /// Cutter compensation while a cycle is active.
        CompensationInCycle,
        /// Tool centre point control while a cycle is active.
        TipInCycle,
        /// A tilted plane while a cycle is active.
        TiltInCycle,
        /// The end of a tilted plane while a cycle is active.
        TiltEndInCycle,
        /// A pattern of holes that includes a change of frame.
        PatternInFrameChange,
        /// A cycle along another axis than the one active.
        OtherAxis,
        /// A first hole on the path to which a length is activated.
        LengthAtFirstHole,
        /// A return to the initial level of another work offset.
        LevelOfOtherOffset,
        /// A hole by the initial level of another length.
        LevelOfOtherLength,
    }
}
