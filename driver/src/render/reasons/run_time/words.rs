//! The words of reasons: blocks, messages, frames and cycles with run-time values.

use std::borrow::Cow;

use ncc_ir::run_time::{ComputedFrame, RunTimeWord as R};

pub(super) fn text(reason: &R) -> Cow<'static, str> {
    Cow::Borrowed(match reason {
        R::MessageValues => "a message with values in it",
        R::MessageDigits => "a value with these digits in a message",
        R::DeviceOutput => "output to a device",
        R::Alarm => "an alarm",
        R::AlarmNumber => "an alarm with a number",
        R::AlarmWithoutNumber => "an alarm without a number",
        R::AlarmRange => "an alarm whose number is not among 61000 to 61999 and 65000 to 66999",
        R::ComputedCode => "a code whose number is a variable's",
        R::TablePlace => "a place of the control's tables by its number",
        R::TablePlaceValues => "these values for a place of the control's tables by its number",
        R::BlockLength { most } => return format!("a block of more than {most} characters").into(),
        R::CycleAssignment => "an assignment between a cycle with variables and its first hole",
        R::CycleSourceAssigned => "an assignment to what the cycle in force was computed from",
        R::PositionUnknown { axis } => {
            return format!("a cycle or a move that depends on where {axis} stands").into();
        }
        R::ModeUnknown => "a block that depends on a mode that is not the same each time",
        R::DistanceWord => "a word with a distance mode of its own, where others rely on the one in force",
        R::OtherFrames => "other frames than those before it, where a program computes",
        R::FrameIncremental => "a frame where words may be incremental",
        R::Frame { why } => {
            return format!("a frame {}, where a program computes", computed_frame(*why)).into();
        }
        R::RotationFirstMove => {
            "a rotation, behind which the first move does not name both axes of its plane"
        }
        R::RotationNotStraightOn => "a rotation, behind which the program does not go straight on to a move",
        R::FrameExpanded => "a frame that is worked into coordinates, where a program computes",
        R::BlocksRewritten => "blocks that have to be rewritten for it, where a program computes",
    })
}

fn computed_frame(why: ComputedFrame) -> &'static str {
    match why {
        ComputedFrame::Skipped => "that can be skipped",
        ComputedFrame::OtherForm => "in another form than the target has",
        ComputedFrame::PlaneUnknown => "in a plane that is not known",
        ComputedFrame::Added => "that adds to another one",
        ComputedFrame::BesideUnknownShift => "beside a shift that is not known there",
        ComputedFrame::BesideUnknownRotation => "beside a rotation that is not known there",
        ComputedFrame::AxisKept => "that leaves an axis as it is",
        ComputedFrame::RotatedFurther => "that is turned further",
        ComputedFrame::AboutTool => "about the place where the tool stands",
    }
}
