//! The words of reasons: canned cycles and holes.

use std::borrow::Cow;

use ncc_ir::lack::HolesLack as L;

pub(super) fn text(lack: &L) -> Cow<'static, str> {
    Cow::Borrowed(match lack {
        L::CycleInSkippedBlock => "a cycle called up in a block that can be skipped",
        L::SkippedAfterCycleWithoutHole => "a skippable cycle behind one without a hole",
        L::SkippedCallOnly => "a cycle whose call can be skipped and its holes cannot",
        L::CycleUnknown => "a cycle that is not known",
        L::HoleOfUnknownCycle => "a hole of a cycle that is not known",
        L::HolesOfUnknownCycle => "holes of a cycle that is not known",
        L::RotaryAxis => "a rotary axis in a canned cycle",
        L::IncrementalHoleHere => "a hole where the tool stands, in incremental coordinates",
        L::PositionUnitUnknown => "a position in a unit that is not known",
        L::CycleEnd => "the end of a cycle",
        L::CycleWithoutHole => "a cycle that is called up without a hole",
        L::AlongDrillingAxis => "a hole position along the drilling axis",
        L::NotAlongZ => "a cycle along another axis than Z",
        L::StatedShift => "fine boring with a stated shift",
        L::ShiftDirection => "fine boring whose direction of shift is a parameter of the control",
        L::ComputedShift => "a computed shift",
        L::PeckKindsWithoutCycleEnd => {
            "pecks that decrease, and pecks of one depth, without the end of a cycle between"
        }
        L::PecksDiffer => "pecks of different depths",
        L::OtherReturnLevel => "a cycle that returns to the other level",
        L::CallersReturnLevel => "a cycle whose return level is the caller's",
        L::ReturnLevelUnknown => "a cycle whose return level is not known",
        L::ReturnLevel => "the return level of cycles",
        L::ClearanceIsParameter => "the clearance of a peck, which is a parameter of the machine",
        L::ParameterClearance => "the clearance of a peck as a parameter of the machine",
        L::Cycle { kind } => return format!("the cycle {kind}").into(),
        L::Kind { kind } => kind,
        L::CycleForm { kind } => return format!("the cycle {kind} in this form").into(),
        L::CycleArgument { cycle } => return format!("this of {cycle}").into(),
        L::ModalCall => "a cycle for the blocks that follow",
        L::DecreasingPecks => "pecks that decrease",
        L::RapidLift => "a chip-breaking cycle that lifts in rapid",
        L::BoringFeedUnknown => "a boring cycle whose feed is not known",
        L::BelowRetractPlane => "a cycle that returns to below its retract plane",
        L::FirstPeckUnknown => "a first peck that is not known",
        L::ShortFirstPeck => "a first peck that is shorter than the others",
        L::DwellAfterPecks => "a dwell after every peck but the last",
        L::ComputedClearance => "a clearance of pecks that is computed",
        L::NoClearance => "a peck without clearance",
        L::FeedDownPecks => "pecks that go down at feed all the way",
        L::HolePlaneUnknown => "a hole in a plane that is not known",
        L::PlaneOfHolesUnknown => "holes in a plane that is not known",
        L::PlacedUnlikePlanes => "a hole placed otherwise than the planes of its cycle",
        L::ZeroUnderApproach => "another zero under a cycle that goes another way to its holes",
        L::LengthAtHole => "a hole on whose way a length is taken up",
        L::BoringFeedOut => {
            "boring with another feed on the way out, under a feed that the cycle does not state"
        }
        L::SpindleAfterUnknown => "a cycle after which the spindle turns as before, which is not known",
        L::PeckClearanceParameter => "peck drilling whose clearance is a parameter of the control",
        L::ChipBreakLiftParameter => "chip-breaking drilling whose lift is a parameter of the control",
        L::LeftActive => "a cycle that a subprogram leaves in force",
        L::EndsCallersCycle => "a subprogram that ends a cycle of its caller",
        L::LeftForUnknownCaller => "a cycle that is left in force for a caller that is not in the text",
        L::ActiveOverToolChange => "a canned cycle that stays active over a tool change",
        L::ToolChangeInCycle => "a tool change while a canned cycle is active",
        L::LevelBeforeZ => "a level for holes from where the tool stands before any absolute Z",
        L::CallersMotionAfterCycle => "axis words that move as the caller does, behind the end of a cycle",
        L::OpenMotionAfterCycle => "axis words whose motion is left open, behind a cycle",
        L::ExactStopInCycle => "an exact stop in a block of a cycle",
        L::PlanesUnknown => "a cycle whose planes are not known",
        L::Peck => "this peck",
    })
}
