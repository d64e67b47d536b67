//! The interpreter's order of a block: what comes before what, and what does not wait for the next move.

use ncc_ir::program::Op;

/// Place of a function in the interpreter's order of a block.
pub(super) fn rank(op: &Op) -> u8 {
    match op {
        Op::Message(_) | Op::Comment(_) | Op::Blank | Op::Lines(_) | Op::NoEffect(_) => 0,
        Op::SetSpindleMode(_) | Op::LimitSpindleSpeed(_) => 1,
        Op::SetFeedMode(_) => 2,
        Op::SetFeedRate(_) => 3,
        Op::SetSpindleSpeed(_) => 4,
        Op::SelectTool(_) | Op::SelectToolByName(_) => 5,
        Op::ChangeTool => 6,
        Op::StartSpindleClockwise
        | Op::StartSpindleCounterclockwise
        | Op::StopSpindleTurning
        | Op::OrientSpindle(_) => 7,
        Op::FloodOn | Op::MistOn | Op::CoolantOff => 8,
        Op::MachineFunction(_) | Op::Advise(_) => 9,
        Op::Dwell(_) => 10,
        Op::SelectPlane(_) => 11,
        Op::UseLengthUnits(_) => 12,
        Op::StartCutterRadiusCompensation { .. } | Op::StopCutterRadiusCompensation => 13,
        Op::UseToolLengthOffset(_) | Op::UseToolLength(_) | Op::UseToolEdge { .. } => 14,
        Op::SetOriginOffsets(_) => 15,
        Op::SetMotionControlMode(_) => 16,
        Op::SetDistanceMode(_) => 17,
        Op::SetReturnLevel(_) => 18,
        Op::ClearFrame(_)
        | Op::SetFrame(_)
        | Op::SetSlot(_)
        | Op::SetPosition(_)
        | Op::UseOriginShift(_)
        | Op::UseToolCentrePoint(_)
        | Op::OrientToolAxis(_)
        | Op::UseMachineCoordinates { .. }
        | Op::Probe(_)
        | Op::Detour(_)
        | Op::GoToReference(_)
        | Op::SetData(_)
        | Op::SetPole(_)
        | Op::Corner { .. }
        | Op::TurnRotaryAxes(_)
        | Op::ExactStop => 19,
        Op::EndCycle => 20,
        Op::StraightTraverse(_)
        | Op::StraightFeed(_)
        | Op::SynchronisedFeed(_)
        | Op::ArcFeed(_)
        | Op::ArcForm(_)
        | Op::Position(_)
        | Op::StartCycle(_)
        | Op::Hole(_)
        | Op::Polar(_)
        | Op::Pattern(_) => 21,
        Op::ProgramStop
        | Op::OptionalProgramStop
        | Op::ProgramEnd
        | Op::BeginAgain
        | Op::Call(_)
        | Op::Return
        | Op::RepeatBlocks(_)
        | Op::MessageOf(_)
        | Op::Output(_)
        | Op::Alarm(_)
        | Op::Assign(..)
        | Op::Declare(_)
        | Op::Leave
        | Op::NextTurn
        | Op::Control(_)
        | Op::Goto(_)
        | Op::Label(_) => 22,
    }
}

/// Calls that do not wait after a move whose end is not settled.
pub(super) fn overtakes(op: &Op) -> bool {
    matches!(
        op,
        Op::Message(_)
            | Op::SelectTool(_)
            | Op::SetMotionControlMode(_)
            | Op::ProgramStop
            | Op::OptionalProgramStop
            | Op::UseLengthUnits(_)
            | Op::SelectPlane(_)
    )
}
