//! Cutter compensation that ncc does not execute.

use crate::reason::reasons;

reasons! {
    /// Cutter compensation that ncc does not execute.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum CompensationUnexecuted {
        /// A program that begins again under cutter compensation.
        BeginsAgain,
        /// Cutter compensation switched on twice.
        OnTwice,
        /// Cutter compensation in a plane that is tilted.
        TiltedPlane,
        /// Cutter compensation of another side or radius without G40.
        OtherSide,
        /// Compensation by a radius of no entry.
        NoEntry,
        /// An arc as the first move of cutter compensation.
        ArcLeadIn,
        /// An arc as the move that leaves cutter compensation.
        ArcLeadOut,
        /// A cycle under cutter compensation.
        Cycle,
        /// Another plane under cutter compensation.
        Plane,
        /// An arc in another plane than that of cutter compensation.
        ArcOtherPlane,
        /// Other units under cutter compensation.
        Units,
        /// Another work offset under cutter compensation.
        WorkOffset,
        /// Another frame under cutter compensation.
        Frame,
        /// Tool centre point control under cutter compensation.
        TipControl,
        /// The tool's axis turned under cutter compensation.
        AxisTurned,
        /// A reference point under cutter compensation.
        MachinePoint,
        /// Probing under cutter compensation.
        Probing,
        /// A rapid move by a detour under cutter compensation.
        Detour,
        /// A thread under cutter compensation.
        Thread,
        /// A tool change under cutter compensation.
        ToolChange,
        /// Another length under cutter compensation.
        Length,
        /// Another edge under cutter compensation.
        Edge,
        /// Another radius under cutter compensation.
        Radius,
        /// Storing where the axes stand under cutter compensation.
        PositionStored,
        /// Another tool under cutter compensation.
        Tool,
        /// A tool measured under cutter compensation.
        ToolMeasured,
        /// A tilted plane under cutter compensation.
        Tilt,
    }
}
