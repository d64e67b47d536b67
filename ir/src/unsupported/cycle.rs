//! What ncc does not translate: canned cycles, their arguments, dwells and hole patterns.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: canned cycles, their arguments, dwells and hole patterns.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum CycleUnsupported {
        /// Argument `parameter` is computed.
        ComputedArgument {
            /// The parameter, by its name in the manual.
            parameter: Box<str>,
        },
        /// An argument that the dictionary refuses, with its words.
        RefusedArgument {
            /// The parameter, by its name in the manual.
            parameter: Box<str>,
            /// The name.
            name: Box<str>,
        },
        /// `first` and `second` disagree.
        TwoDepths {
            /// The first argument.
            first: Box<str>,
            /// The second argument.
            second: Box<str>,
        },
        /// `first` and `second`, one of them computed.
        TwoComputedDepths {
            /// The first argument.
            first: Box<str>,
            /// The second argument.
            second: Box<str>,
        },
        /// `parameter` with computed depths.
        LeastPeckComputed {
            /// The parameter, by its name in the manual.
            parameter: Box<str>,
        },
        /// `parameter` is above the first peck.
        LeastPeckAbove {
            /// The parameter, by its name in the manual.
            parameter: Box<str>,
        },
        /// Ncc does not know this value of `parameter`.
        DisplayMode {
            /// The parameter, by its name in the manual.
            parameter: Box<str>,
        },
        /// `parameter` names another plane than the active one.
        ArgumentPlane {
            /// The parameter, by its name in the manual.
            parameter: Box<str>,
        },
        /// `parameter` does not fit the depths.
        DepthMode {
            /// The parameter, by its name in the manual.
            parameter: Box<str>,
        },
        /// `parameter` is computed and may be 0.
        StepComputed {
            /// The parameter, by its name in the manual.
            parameter: Box<str>,
        },
        /// Ncc does not know this value of `parameter`.
        PatternOrder {
            /// The parameter, by its name in the manual.
            parameter: Box<str>,
        },
        /// Block skip may keep the modal call active.
        CallEndSkipped,
        /// This code while another cycle is active.
        InModalCycle,
        /// A modal tap with a speed but without a hole.
        IdleTap,
        /// A hole pattern for a modal subprogram call.
        PatternOfSubprogram,
        /// Some positions are incremental.
        PointsNotAbsolute,
        /// An empty position before this one.
        PointsGap,
        /// The size and the pitch of the thread.
        SizeAndPitch,
        /// Another speed out of the thread.
        SpeedOut,
        /// The spindle reverses by itself.
        SpindleByItself,
        /// The feed and the pitch of a thread.
        FeedAndPitch,
        /// Ncc does not know the active plane.
        UnknownPlane,
        /// This code without a decimal point.
        FeedPerTurnPoint,
        /// A canned cycle and a dwell in one block.
        WithDwell,
        /// This code under scaling, or with its axis mirrored.
        UnderScale,
        /// The cycle drills along another axis.
        OtherAxis,
        /// A canned cycle with G91 active.
        Increments,
        /// Peck tapping.
        PeckTapping,
        /// Pecks in a cycle that has none.
        PecksHere,
        /// An exact stop in a block of a canned cycle.
        ExactStop,
        /// A rotary axis in a canned cycle.
        RotaryAxis,
        /// A retract after several pecks.
        RetractAfterPecks,
        /// Decreasing pecks and equal pecks.
        TwoPecks,
        /// A dwell of an earlier cycle may still count.
        DwellOfBefore,
        /// Does `letter` set a dwell?
        DwellByOption {
            /// The letter of the word.
            letter: char,
            /// The option that decides.
            option: Box<str>,
        },
        /// A hole pattern with G91 active.
        PatternIncrements,
        /// This code at a hole position of the caller's cycle.
        HoleAlongAxis,
    }
}
