//! Settings: statements that move nothing and stay active, and the codes that other statements need
//! before them.

use ncc_ir::canon::{Distance, FeedMode, Plane, ReturnLevel, SpindleMode, Units};
use ncc_ir::expr::num::Num;
use ncc_ir::program::{FrameSlot, Op};

use super::codes::Code;

/// A setting: a statement that moves nothing and stays active.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Setting {
    Units(Units),
    Distance(Distance),
    Plane(Plane),
    FeedMode(FeedMode),
    Level(ReturnLevel),
    Origin(u16),
    NoShift,
    NoCompensation,
    NoLength,
    NoCycle,
    /// The speed counts turns a minute.
    Turns,
}

impl Setting {
    /// The setting that a statement is; cycle ends and cancelled length offsets count too.
    pub(crate) fn from_op(op: &Op) -> Option<Setting> {
        Some(match op {
            Op::UseLengthUnits(u) => Setting::Units(*u),
            Op::SetDistanceMode(d) => Setting::Distance(*d),
            Op::SelectPlane(p) => Setting::Plane(*p),
            Op::SetFeedMode(f) => Setting::FeedMode(*f),
            Op::SetReturnLevel(l) => Setting::Level(*l),
            Op::SetOriginOffsets(n) => Setting::Origin(*n),
            Op::ClearFrame(FrameSlot::Shift) => Setting::NoShift,
            Op::StopCutterRadiusCompensation => Setting::NoCompensation,
            Op::UseToolLengthOffset(e) if e.literal().is_some_and(Num::is_zero) => Setting::NoLength,
            Op::EndCycle => Setting::NoCycle,
            Op::SetSpindleMode(SpindleMode::Turns) => Setting::Turns,
            Op::ClearFrame(_)
            | Op::UseToolLengthOffset(_)
            | Op::UseToolLength(_)
            | Op::Comment(_)
            | Op::NoEffect(_)
            | Op::Blank
            | Op::Lines(_)
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
            | Op::StartCutterRadiusCompensation { .. }
            | Op::UseToolEdge { .. }
            | Op::ArcForm(_)
            | Op::SynchronisedFeed(_)
            | Op::RepeatBlocks(_)
            | Op::SetPole(_)
            | Op::Polar(_)
            | Op::SetMotionControlMode(_)
            | Op::ExactStop
            | Op::TurnRotaryAxes(_)
            | Op::Corner { .. }
            | Op::Advise(_)
            | Op::SetFeedRate(_)
            | Op::SetSpindleSpeed(_)
            | Op::SetSpindleMode(_)
            | Op::LimitSpindleSpeed(_)
            | Op::OrientSpindle(_)
            | Op::SelectTool(_)
            | Op::SelectToolByName(_)
            | Op::ChangeTool
            | Op::StartSpindleClockwise
            | Op::StartSpindleCounterclockwise
            | Op::StopSpindleTurning
            | Op::MachineFunction(_)
            | Op::FloodOn
            | Op::MistOn
            | Op::CoolantOff
            | Op::Dwell(_)
            | Op::StraightTraverse(_)
            | Op::StraightFeed(_)
            | Op::ArcFeed(_)
            | Op::Position(_)
            | Op::StartCycle(_)
            | Op::Hole(_)
            | Op::Pattern(_)
            | Op::ProgramStop
            | Op::OptionalProgramStop
            | Op::ProgramEnd
            | Op::BeginAgain
            | Op::Message(_)
            | Op::Call(_)
            | Op::Return
            | Op::MessageOf(_)
            | Op::Output(_)
            | Op::Alarm(_)
            | Op::Assign(..)
            | Op::Declare(_)
            | Op::Leave
            | Op::NextTurn
            | Op::Control(_)
            | Op::Goto(_)
            | Op::Label(_) => return None,
        })
    }
}

/// Codes that have to be put in before a statement can mean what it means.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Inserted {
    pub(crate) distance: Option<Code>,
    pub(crate) plane: Option<Code>,
}
