//! Canned cycles and holes, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Canned cycles and holes that a target lacks.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum HolesLack {
        /// A cycle called in a block with block skip.
        CycleInSkippedBlock,
        /// A skippable cycle after one without a hole.
        SkippedAfterCycleWithoutHole,
        /// A cycle whose call is under block skip and its holes cannot.
        SkippedCallOnly,
        /// A cycle that is not known.
        CycleUnknown,
        /// A hole of a cycle that is not known.
        HoleOfUnknownCycle,
        /// Holes of a cycle that is not known.
        HolesOfUnknownCycle,
        /// A rotary axis in a canned cycle.
        RotaryAxis,
        /// A hole where the tool is, in incremental coordinates.
        IncrementalHoleHere,
        /// A position in a unit that is not known.
        PositionUnitUnknown,
        /// The end of a cycle.
        CycleEnd,
        /// A cycle that is called without a hole.
        CycleWithoutHole,
        /// A hole position along the drilling axis.
        AlongDrillingAxis,
        /// A cycle along another axis than Z.
        NotAlongZ,
        /// Fine boring with a stated shift.
        StatedShift,
        /// Fine boring for which the direction of shift is a parameter of the control.
        ShiftDirection,
        /// A computed shift.
        ComputedShift,
        /// Pecks that decrease, and pecks of one depth, without the end of a cycle between.
        PeckKindsWithoutCycleEnd,
        /// Pecks of different depths.
        PecksDiffer,
        /// A cycle that returns to the other level.
        OtherReturnLevel,
        /// A cycle whose return level is the caller's.
        CallersReturnLevel,
        /// A cycle whose return level is not known.
        ReturnLevelUnknown,
        /// The return level of cycles.
        ReturnLevel,
        /// The clearance of a peck, which is a parameter of the machine.
        ClearanceIsParameter,
        /// The clearance of a peck as a parameter of the machine.
        ParameterClearance,
        /// A canned cycle of this kind, by its name in the text of ncc's own language.
        Cycle {
            /// The name of the kind.
            kind: &'static str,
        },
        /// A canned cycle that is listed by its moves alone, by the name of its kind.
        Kind {
            /// The name of the kind.
            kind: &'static str,
        },
        /// A canned cycle of this kind with these words.
        CycleForm {
            /// The name of the kind.
            kind: &'static str,
        },
        /// An argument of the target's cycle, by the name of the cycle.
        CycleArgument {
            /// The name of the cycle.
            cycle: Box<str>,
        },
        /// A cycle for the blocks that follow.
        ModalCall,
        /// Pecks that decrease.
        DecreasingPecks,
        /// A chip-breaking cycle that lifts in rapid.
        RapidLift,
        /// A boring cycle whose feed is not known.
        BoringFeedUnknown,
        /// A cycle that returns to below its retract plane.
        BelowRetractPlane,
        /// A first peck that is not known.
        FirstPeckUnknown,
        /// A first peck that is shorter than the others.
        ShortFirstPeck,
        /// A dwell after every peck but the last.
        DwellAfterPecks,
        /// A clearance of pecks that is computed.
        ComputedClearance,
        /// A peck without clearance.
        NoClearance,
        /// Pecks that go down at feed all the way.
        FeedDownPecks,
        /// A hole in a plane that is not known.
        HolePlaneUnknown,
        /// Holes in a plane that is not known.
        PlaneOfHolesUnknown,
        /// A hole placed otherwise than the planes of its cycle.
        PlacedUnlikePlanes,
        /// Another zero under a cycle that approaches its holes differently.
        ZeroUnderApproach,
        /// A hole on the path to which a length is activated.
        LengthAtHole,
        /// Boring with another feed for the retract, where the cycle does not state its feed.
        BoringFeedOut,
        /// A cycle after which the spindle turns as before, which is not known.
        SpindleAfterUnknown,
        /// Peck drilling whose clearance is a parameter of the control.
        PeckClearanceParameter,
        /// Chip-breaking drilling whose lift is a parameter of the control.
        ChipBreakLiftParameter,
        /// A cycle that a subprogram leaves active.
        LeftActive,
        /// A subprogram that ends a cycle of its caller.
        EndsCallersCycle,
        /// A cycle that is left active for a caller that is not in the text.
        LeftForUnknownCaller,
        /// A canned cycle that stays active over a tool change.
        ActiveOverToolChange,
        /// A tool change while a canned cycle is active.
        ToolChangeInCycle,
        /// A level for holes from where the tool is before any absolute Z.
        LevelBeforeZ,
        /// Axis words that move as the caller does, after the end of a cycle.
        CallersMotionAfterCycle,
        /// Axis words whose motion is left open, after a cycle.
        OpenMotionAfterCycle,
        /// An exact stop in a block of a cycle.
        ExactStopInCycle,
        /// A cycle whose planes are not known.
        PlanesUnknown,
        /// A peck whose depth is not known, or not positive.
        Peck,
    }
}
