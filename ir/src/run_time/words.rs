//! Blocks, messages, frames and cycles with run-time values that a target cannot compute when the program runs.

use crate::reason::reasons;

reasons! {
    /// Blocks, messages, frames and cycles with run-time values that a target cannot compute when the program runs.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum RunTimeWord {
        /// A message with values in it.
        MessageValues,
        /// A value with these digits in a message.
        MessageDigits,
        /// Output to a device.
        DeviceOutput,
        /// An alarm.
        Alarm,
        /// An alarm with a number.
        AlarmNumber,
        /// An alarm without a number.
        AlarmWithoutNumber,
        /// An alarm whose number is not among 61000 to 61999 and 65000 to 66999.
        AlarmRange,
        /// A code whose number is a variable's.
        ComputedCode,
        /// A place of the control's tables by its number.
        TablePlace,
        /// These values for a place of the control's tables by its number.
        TablePlaceValues,
        /// A block of more than {most} characters.
        BlockLength {
            /// The most that the target takes.
            most: u32,
        },
        /// An assignment between a cycle with variables and its first hole.
        CycleAssignment,
        /// An assignment to what the cycle active was computed from.
        CycleSourceAssigned,
        /// A cycle or a move that depends on an unknown position of this axis.
        PositionUnknown {
            /// The letter of the axis.
            axis: char,
        },
        /// A block that depends on a mode that is not the same each time.
        ModeUnknown,
        /// A word with a distance mode of its own, where others rely on the one active.
        DistanceWord,
        /// Other frames than those before it, where a program computes.
        OtherFrames,
        /// A frame where words may be incremental.
        FrameIncremental,
        /// A frame in a program that computes.
        Frame {
            /// The reason.
            why: ComputedFrame,
        },
        /// A rotation, after which the first move does not name both axes of its plane.
        RotationFirstMove,
        /// A rotation, after which the program does not go straight on to a move.
        RotationNotStraightOn,
        /// A frame that ncc works into coordinatesto coordinates, where a program computes.
        FrameExpanded,
        /// Blocks that have to be rewritten for it, where a program computes.
        BlocksRewritten,
    }

    /// Why a frame of a program that computes has no form in the target.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ComputedFrame {
        /// It is under block skip.
        Skipped,
        /// The target has another form.
        OtherForm,
        /// Its plane is not known.
        PlaneUnknown,
        /// It adds to another frame.
        Added,
        /// An unknown shift is active beside it.
        BesideUnknownShift,
        /// An unknown rotation is active beside it.
        BesideUnknownRotation,
        /// It leaves an axis as it is.
        AxisKept,
        /// It is rotated further.
        RotatedFurther,
        /// It rotates about the position of the tool.
        AboutTool,
    }
}
