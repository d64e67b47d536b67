//! Codes that set one fact.

use ncc_dialects::Meaning;
use ncc_ir::program::{Advice, Op, PathControl};

/// The statement of a code that sets a fact and has no words of its own; `None` of any other.
pub(crate) fn setting(meaning: Meaning) -> Option<Op> {
    Some(match meaning {
        Meaning::UseLengthUnits(units) => Op::UseLengthUnits(units),
        Meaning::SelectPlane(plane) => Op::SelectPlane(plane),
        Meaning::SetDistanceMode(distance) => Op::SetDistanceMode(distance),
        Meaning::SetFeedMode(mode) => Op::SetFeedMode(mode),
        Meaning::SetOriginOffsets(offset) => Op::SetOriginOffsets(offset),
        Meaning::ClearFrame(slot) => Op::ClearFrame(slot),
        Meaning::UseOriginShift(on) => Op::UseOriginShift(on),
        Meaning::SetReturnLevel(level) => Op::SetReturnLevel(level),
        Meaning::SetSpindleMode(mode) => Op::SetSpindleMode(mode),
        Meaning::SetMotionControlMode(mode) => Op::SetMotionControlMode(Box::new(PathControl::plain(mode))),
        Meaning::Advise(kind, Some(value)) => Op::Advise(Box::new(Advice { kind, value, amount: None })),
        Meaning::StopCutterRadiusCompensation => Op::StopCutterRadiusCompensation,
        _ => return None,
    })
}
