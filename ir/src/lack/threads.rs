//! Tapping cycles and spindle-synchronised moves, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Tapping cycles and spindle-synchronised moves that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ThreadsLack {
        /// Rigid tapping.
        RigidTapping,
        /// A pitch with so many digits.
        PitchDigits,
        /// A computed pitch.
        ComputedPitch,
        /// A pitch of which the unit is not known.
        PitchUnitUnknown,
        /// A rigid tap whose speed is not known.
        RigidSpeedUnknown,
        /// A tapping cycle with a value that is not known.
        TapUnknown {
            /// The value.
            value: TapValue,
        },
        /// A tapping cycle that dwells at one end of the thread alone.
        DwellAtOneEnd,
        /// A rigid tap that dwells when the spindle has turned round.
        DwellAfterReversal,
        /// A tapping cycle in a block with block skip.
        SkippedTap,
        /// The end of a tapping cycle under block skip.
        SkippedTapEnd,
        /// A spindle that reverses while a boring cycle is active.
        BoringReversal,
        /// A spindle that is switched while a tapping cycle is active.
        SwitchedSpindle,
        /// A feed of a tap that replaces a run-time feed.
        FeedReplaced,
        /// A feed or a speed that changes while a tapping cycle is active.
        FeedOrSpeedChanges,
        /// A rigid thread with something else before its return.
        BeforeReturn,
        /// A feed after a thread that is not known.
        FeedAfterUnknown,
        /// A feed after a thread, in a block with block skip.
        SkippedFeedAfter,
        /// A rigid thread without its return.
        NoReturn,
        /// A thread along several axes, or round one.
        AxisCount,
        /// A thread with a compensating chuck.
        Chuck,
        /// A thread with a compensating chuck in this form.
        ChuckForm,
        /// A rigid thread whose spindle has not been oriented before it.
        NotOriented,
        /// A rigid thread that is not left as it was entered.
        LeftDifferently,
        /// A thread and back with a spindle that is stopped.
        SpindleStopped,
        /// A thread and back in one.
        OutAndBack,
        /// A spindle-synchronised move.
        Synchronised,
        /// A spindle-synchronised move in this form.
        SynchronisedForm,
        /// A thread for which the control turns the spindle.
        TurnedByControl,
        /// A computed lead.
        ComputedLead,
        /// A lead with so many digits.
        LeadDigits,
        /// A thread whose lead is stated in this way.
        LeadForm,
        /// A thread in machine coordinates.
        MachineCoordinates,
        /// Tapping without the spindle turning so.
        SpindleDirection,
    }

    /// A value of a tapping cycle.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum TapValue {
        /// The pitch of the thread.
        Pitch,
        /// The feed.
        Feed,
        /// The spindle speed.
        Speed,
    }
}
