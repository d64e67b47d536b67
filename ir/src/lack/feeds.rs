//! Feeds and dwells, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Feeds and dwells that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum FeedsLack {
        /// A feed.
        Feed,
        /// A feed in this unit.
        FeedUnit,
        /// A feed so small that the digits make it 0.
        TooSmall,
        /// Feed per minute.
        PerMinute,
        /// Feed per revolution.
        PerRevolution,
        /// Inverse-time feed.
        InverseTime,
        /// This feed under a constant surface speed.
        UnderSurfaceSpeed,
        /// A feed mode where the spindle speed mode is not known.
        ModeUnderUnknownSpeed,
        /// A dwell.
        Dwell,
        /// A feed of linear and rotary axes together that may be a rapid.
        RotaryMaybeRapid,
        /// A feed of linear and rotary axes together in units that are not known.
        RotaryUnitsUnknown,
        /// A feed of linear and rotary axes together from a place that is not known here.
        RotaryStartUnknown,
        /// A feed of rotary axes that counts a diameter set on the source's machine.
        RotarySourceDiameter,
        /// A feed of rotary axes that counts a diameter set on the target's machine.
        RotaryTargetDiameter,
        /// A feed of linear and rotary axes together that does not count minutes.
        RotaryNotPerMinute,
        /// A feed of linear and rotary axes together that is not known here.
        RotaryUnknown,
        /// An inverse-time feed of a move this long: F has too few digits.
        TimeDigits,
        /// An arc with an inverse-time feed from a place that is not known here.
        ArcTimeStartUnknown,
        /// An arc of several turns with an inverse-time feed.
        ArcTimeTurns,
        /// An arc with an inverse-time feed in another block.
        ArcTimeOtherBlock,
        /// A computed inverse-time feed on an arc.
        ArcTimeComputed,
        /// A feed that is not known here and holds after a code of what it counts.
        EndedByModeCode,
        /// A feed that is not known here and holds after a change of units.
        EndedByUnits,
    }
}
