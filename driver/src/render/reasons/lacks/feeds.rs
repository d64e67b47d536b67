//! The words of reasons: feeds and dwells.

use ncc_ir::lack::FeedsLack as L;

pub(super) fn text(lack: &L) -> &'static str {
    match lack {
        L::Feed => "a feed",
        L::FeedUnit => "a feed in this unit",
        L::TooSmall => "a feed so small that the digits make it 0",
        L::PerMinute => "feed per minute",
        L::PerRevolution => "feed per revolution",
        L::InverseTime => "inverse-time feed",
        L::UnderSurfaceSpeed => "this feed under a constant surface speed",
        L::ModeUnderUnknownSpeed => "what a feed counts where it is not known what a speed does",
        L::Dwell => "a dwell",
        L::RotaryMaybeRapid => "a feed of linear and rotary axes together that may be a rapid",
        L::RotaryUnitsUnknown => "a feed of linear and rotary axes together in units that are not known",
        L::RotaryStartUnknown => {
            "a feed of linear and rotary axes together from a place that is not known here"
        }
        L::RotarySourceDiameter => "a feed of rotary axes that counts a diameter set on the source's machine",
        L::RotaryTargetDiameter => "a feed of rotary axes that counts a diameter set on the target's machine",
        L::RotaryNotPerMinute => "a feed of linear and rotary axes together that does not count minutes",
        L::RotaryUnknown => "a feed of linear and rotary axes together that is not known here",
        L::TimeDigits => "a feed by time of a move this long: F has too few digits",
        L::ArcTimeStartUnknown => "an arc with a feed by time from a place that is not known here",
        L::ArcTimeTurns => "an arc of several turns with a feed by time",
        L::ArcTimeOtherBlock => "an arc with a feed by time in another block",
        L::ArcTimeComputed => "a computed feed by time on an arc",
        L::EndedByModeCode => "a feed that is not known here and holds behind a code of what it counts",
        L::EndedByUnits => "a feed that is not known here and holds after a change of units",
    }
}
