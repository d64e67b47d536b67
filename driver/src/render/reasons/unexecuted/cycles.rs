//! The words of reasons: canned cycles and holes.

use ncc_ir::unexecuted::CycleUnexecuted as R;

pub(super) fn text(reason: &R) -> &'static str {
    match reason {
        R::BeginsAgainInCycle => "a program that begins again while a cycle is in force",
        R::ToolChangeInCycle => "a tool change while a cycle is in force",
        R::ReturnInCycle => "a return to a point of the machine while a cycle is in force",
        R::DetourInCycle => "a rapid move by a detour while a cycle is in force",
        R::MachineMoveInCycle => "a move of the machine, or a probing one, while a cycle is in force",
        R::DataInCycle => "data input while a cycle is in force",
        R::CompensationInCycle => "cutter radius compensation while a cycle is in force",
        R::TipInCycle => "tool centre point control while a cycle is in force",
        R::TiltInCycle => "a tilted plane while a cycle is in force",
        R::TiltEndInCycle => "the end of a tilted plane while a cycle is in force",
        R::PatternInFrameChange => "a pattern of holes that includes a change of frame",
        R::OtherAxis => "a cycle along another axis than the one in force",
        R::LengthAtFirstHole => "a first hole on whose way a length is taken up",
        R::LevelOfOtherOffset => "a return to the initial level of another work offset",
        R::LevelOfOtherLength => "a hole by the initial level of another length",
    }
}
