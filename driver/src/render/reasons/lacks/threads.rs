//! The words of reasons: tapping cycles and spindle-synchronised moves.

use std::borrow::Cow;

use ncc_ir::lack::{TapValue, ThreadsLack as L};

pub(super) fn text(lack: &L) -> Cow<'static, str> {
    Cow::Borrowed(match lack {
        L::RigidTapping => "rigid tapping",
        L::PitchDigits => "a pitch with so many digits",
        L::ComputedPitch => "a computed pitch",
        L::PitchUnitUnknown => "a pitch of which the unit is not known",
        L::RigidSpeedUnknown => "a rigid tap whose speed is not known",
        L::TapUnknown { value } => {
            return format!("a tapping cycle of which {} is not known", tap_value(*value)).into();
        }
        L::DwellAtOneEnd => "a tapping cycle that dwells at one end of the thread alone",
        L::DwellAfterReversal => "a rigid tap that dwells when the spindle has turned round",
        L::SkippedTap => "a tapping cycle in a block that can be skipped",
        L::SkippedTapEnd => "the end of a tapping cycle that can be skipped",
        L::BoringReversal => "a spindle that turns another way while a boring cycle is in force",
        L::SwitchedSpindle => "a spindle that is switched while a tapping cycle is in force",
        L::FeedReplaced => "a tap's feed in the place of one that only the run knows",
        L::FeedOrSpeedChanges => "a feed or a speed that changes while a tapping cycle is in force",
        L::BeforeReturn => "a rigid thread with something else before its way back",
        L::FeedAfterUnknown => "a feed behind a thread that is not known",
        L::SkippedFeedAfter => "a feed behind a thread, in a block that can be skipped",
        L::NoReturn => "a rigid thread without its way back",
        L::AxisCount => "a thread along several axes, or round one",
        L::Chuck => "a thread with a compensating chuck",
        L::ChuckForm => "a thread with a compensating chuck in this form",
        L::NotOriented => "a rigid thread whose spindle has not been stopped at an angle before it",
        L::LeftDifferently => "a rigid thread that is not left as it was entered",
        L::SpindleStopped => "a thread and back with a spindle that stands",
        L::OutAndBack => "a thread and back in one",
        L::Synchronised => "a move in step with the spindle",
        L::SynchronisedForm => "a move in step with the spindle in this form",
        L::TurnedByControl => "a thread for which the control turns the spindle",
        L::ComputedLead => "a computed lead",
        L::LeadDigits => "a lead with so many digits",
        L::LeadForm => "a thread whose lead is said in this way",
        L::MachineCoordinates => "a thread in machine coordinates",
        L::SpindleDirection => "tapping without the spindle turning so",
    })
}

fn tap_value(value: TapValue) -> &'static str {
    match value {
        TapValue::Pitch => "the pitch",
        TapValue::Feed => "the feed",
        TapValue::Speed => "the speed",
    }
}
