//! Shifts, rotations, scales, mirrors and tilted planes, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Shifts, rotations, scales, mirrors and tilted planes that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum FramesLack {
        /// A frame.
        Frame,
        /// A shift.
        Shift,
        /// A rotation.
        Rotation,
        /// A rotation by an increment.
        RotationByIncrement,
        /// Scale factors.
        Scale,
        /// A mirror.
        Mirror,
        /// A local shift.
        LocalShift,
        /// A tilted plane.
        TiltedPlane,
        /// A tilted plane by turns about these axes.
        TiltAxes,
        /// A tilted plane by computed angles.
        TiltByComputedAngles,
        /// A tilted plane after an end of one that may be none.
        TiltAfterUnknownEnd,
        /// The end of a tilted plane.
        TiltEnd,
        /// The tool's axis swivelled to a tilted plane.
        AxisOntoTilt,
        /// The tool's axis turned apart from its plane.
        AxisApartFromTilt,
        /// How the tool's axis is turned.
        AxisTurning,
        /// Coordinates of the present point.
        PresentPoint,
        /// An origin shift activated again.
        ShiftResumed,
        /// An origin shift suspended.
        ShiftSuspended,
        /// Clearing this frame.
        Clear,
        /// A shift, rotation, scale or mirror in addition to a chain of frames.
        BesideChain,
        /// A cycle in a frame that turns, mirrors or scales its drilling axis.
        DrillingAxisTurned,
        /// A frame that moves the drilling axis of the cycle active.
        DrillingAxisMoved,
        /// The end of an origin shift in a turned or scaled frame.
        ShiftEndInTurnedFrame,
        /// The end of an origin shift while a cycle is active.
        ShiftEndInCycle,
        /// The end of an origin shift along Z before a length offset is activated.
        ShiftEndBeforeLength,
        /// This frame beside coordinates of the present point.
        BesidePresentPoint,
        /// Another form of frame while a cycle is active.
        OtherFormInCycle,
        /// A thread in a turned or scaled frame.
        Thread,
        /// Probing in a frame that ncc works into coordinates.
        Probing,
        /// A rapid move by a detour in a frame that ncc works into coordinates.
        Detour,
        /// A point in polar coordinates in a frame that ncc works into coordinates.
        PolarPoint,
        /// A frame where the program does not go straight on.
        NotStraightOn,
        /// Cutter compensation in a frame that does not leave arcs.
        CompensationWithoutArcs,
        /// A work offset set by the position under a frame.
        OffsetByPosition,
        /// A computed word in a frame.
        ComputedWord,
        /// Something that the target does not do in a turned, scaled or mirrored frame.
        UnderTurnedFrame {
            /// What it is.
            what: OutsideFrame,
        },
        /// A frame in a block with block skip.
        InSkippedBlock,
        /// A length offset that waits in a turned frame.
        LengthInTurnedFrame,
        /// An arc as the first move of another rotation.
        ArcFirstInRotation,
        /// An arc in a frame that does not leave it an arc.
        ArcNoLonger,
        /// An incremental word after a change of frame.
        IncrementAfterChange,
        /// Rotation of a work offset.
        OffsetRotation,
        /// A computed work offset, where work offsets go by name.
        ComputedWorkOffset,
        /// Work offset {offset}.
        WorkOffset {
            /// The number of the work offset; 1 is the first.
            offset: u16,
        },
    }

    /// Something that a target does not do while a rotation, a scale or a mirror is active.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum OutsideFrame {
        /// Another work offset.
        WorkOffset,
        /// A reference point return.
        ReferencePoint,
        /// A move in machine coordinates.
        MachineCoordinates,
        /// A value for the control's tables.
        TableValue,
    }
}
