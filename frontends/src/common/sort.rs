//! The order in which the codes of one block take effect.

use ncc_dialects::Meaning;

pub(crate) const RANK_WORDS: u8 = 10;
pub(crate) const RANK_MOTION: u8 = 20;
pub(crate) const RANK_AFTER: u8 = 30;

/// When a code's function happens within its block.
pub(crate) fn rank(meaning: Meaning) -> u8 {
    match meaning {
        Meaning::NoEffect | Meaning::LeftOut => 0,
        Meaning::UseLengthUnits(_) => 1,
        Meaning::SelectPlane(_) => 2,
        Meaning::SetDistanceMode(_) => 3,
        Meaning::SetFeedMode(_) => 4,
        Meaning::SetOriginOffsets(_) => 5,
        // After the plane that it is in.
        Meaning::PolarWords(_) | Meaning::SetPole(_) => 9,
        Meaning::ClearFrame(_) | Meaning::UseOriginShift(_) => 6,
        Meaning::SetReturnLevel(_) | Meaning::SetCentreMode(_) => 7,
        Meaning::StopCutterRadiusCompensation => 8,
        Meaning::SetMotionControlMode(_) | Meaning::Advise(..) | Meaning::Overrides(_) => 9,
        Meaning::SetSpindleMode(_) | Meaning::LimitSpindleSpeed => 9,
        Meaning::SetShift(_)
        | Meaning::SetPosition
        | Meaning::SetRotation
        | Meaning::SetScale
        | Meaning::SetMirror
        | Meaning::SetTilt
        | Meaning::ClearMirror => 9,
        // Feed, speed and tool words.
        Meaning::ChangeTool => RANK_WORDS,
        Meaning::StartSpindleClockwise | Meaning::StartSpindleCounterclockwise => 11,
        Meaning::FloodOn | Meaning::MistOn => 12,
        Meaning::Dwell | Meaning::MachineFunction(_) => 13,
        Meaning::RigidTapping => 13,
        Meaning::UseToolLengthOffset | Meaning::CancelToolLengthOffset => 14,
        Meaning::UseToolCentrePoint(_) | Meaning::UseToolLength { .. } => 14,
        Meaning::OrientToolAxis => 15,
        Meaning::SetData | Meaning::StorePosition(_) => 15,
        Meaning::SetToolNumber => RANK_WORDS,
        Meaning::OrientSpindle => 16,
        Meaning::StartCutterRadiusCompensation(_) | Meaning::StartCompensationByDiameter(_) => 18,
        Meaning::ExactStop => 17,
        Meaning::EndCycle => RANK_MOTION,
        Meaning::UseMachineCoordinates { .. }
        | Meaning::GoToReference { .. }
        | Meaning::StraightProbe(_)
        | Meaning::Detour(_)
        | Meaning::StraightTraverse
        | Meaning::StraightFeed
        | Meaning::SynchronisedFeed(_)
        | Meaning::ArcFeed(_) => 21,
        Meaning::StartCycle | Meaning::Pattern => 22,
        Meaning::StopSpindleTurning => RANK_AFTER,
        Meaning::CoolantOff => 31,
        Meaning::ProgramStop | Meaning::OptionalProgramStop => 32,
        Meaning::ProgramEnd | Meaning::BeginAgain => 33,
        Meaning::Call
        | Meaning::CallMacro
        | Meaning::CallMacroAtMoves
        | Meaning::CallMacroAtBlocks
        | Meaning::Return => 34,
        // Before the moves that it is no more for.
        Meaning::EndCallsAtMoves => 15,
    }
}
