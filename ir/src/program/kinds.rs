//! Kinds of statements: patterns for those that most passes answer for alike.
//!
//! Each macro stands for a list of [`Op`](crate::program::Op) in a pattern, so that a `match` stays
//! without a catch-all and the compiler still counts: a new `Op` fails to compile in every pass until
//! somebody puts it into a kind, whose promise it must keep, or answers for it there.
//!
//! Not here: what a pass makes of a kind. One that only some passes treat alike is no kind.

/// Beside the way: moves for which others stand ([`Op::Lines`](crate::program::Op::Lines)), remarks and messages, text for devices, spindle, coolant, functions of the machine, pauses, on which side of the
/// contour the tool goes. Without axis words, lengths or a feed; what the words of the moves that
/// follow mean, where the axes stand and which tool is meant stay as they are.
#[macro_export]
macro_rules! miscellaneous {
    () => {
        $crate::program::Op::Comment(_)
            | $crate::program::Op::Message(_)
            | $crate::program::Op::MessageOf(_)
            | $crate::program::Op::Output(_)
            | $crate::program::Op::Alarm(_)
            | $crate::program::Op::NoEffect(_)
            | $crate::program::Op::Blank
            | $crate::program::Op::Lines(_)
            | $crate::program::Op::StartCutterRadiusCompensation { .. }
            | $crate::program::Op::StopCutterRadiusCompensation
            | $crate::program::Op::SetSpindleSpeed(_)
            | $crate::program::Op::SetSpindleMode(_)
            | $crate::program::Op::LimitSpindleSpeed(_)
            | $crate::program::Op::StartSpindleClockwise
            | $crate::program::Op::StartSpindleCounterclockwise
            | $crate::program::Op::StopSpindleTurning
            | $crate::program::Op::OrientSpindle(_)
            | $crate::program::Op::MachineFunction(_)
            | $crate::program::Op::FloodOn
            | $crate::program::Op::MistOn
            | $crate::program::Op::CoolantOff
            | $crate::program::Op::Dwell(_)
            | $crate::program::Op::ProgramStop
            | $crate::program::Op::OptionalProgramStop
    };
}

/// How the control conducts its moves: corners, the direction in which axes turn, and advice; what is put into the corner after the next
/// one. What the words of the moves that follow
/// mean, where the axes stand and which tool is meant stay as they are. Lengths may belong to it.
#[macro_export]
macro_rules! conduct {
    () => {
        $crate::program::Op::SetMotionControlMode(_)
            | $crate::program::Op::ExactStop
            | $crate::program::Op::TurnRotaryAxes(_)
            | $crate::program::Op::Corner { .. }
            | $crate::program::Op::Advise(_)
    };
}

/// What the numbers that follow mean, where cycles leave the tool: no axis moves.
#[macro_export]
macro_rules! modes {
    () => {
        $crate::program::Op::UseLengthUnits(_)
            | $crate::program::Op::SetDistanceMode(_)
            | $crate::program::Op::SelectPlane(_)
            | $crate::program::Op::SetFeedMode(_)
            | $crate::program::Op::SetReturnLevel(_)
    };
}

/// Tools and their lengths: nothing moves until an axis is commanded.
#[macro_export]
macro_rules! tooling {
    () => {
        $crate::program::Op::SelectTool(_)
            | $crate::program::Op::SelectToolByName(_)
            | $crate::program::Op::ChangeTool
            | $crate::program::Op::UseToolLengthOffset(_)
            | $crate::program::Op::UseToolLength(_)
            | $crate::program::Op::UseToolEdge { .. }
    };
}

/// From where, and turned how, the coordinates that follow are counted; how far the next move goes.
#[macro_export]
macro_rules! frames {
    () => {
        $crate::program::Op::SetOriginOffsets(_)
            | $crate::program::Op::ClearFrame(_)
            | $crate::program::Op::SetFrame(_)
            | $crate::program::Op::SetSlot(_)
            | $crate::program::Op::SetPosition(_)
            | $crate::program::Op::UseOriginShift(_)
            | $crate::program::Op::UseToolCentrePoint(_)
            | $crate::program::Op::UseMachineCoordinates { .. }
            | $crate::program::Op::Probe(_)
            | $crate::program::Op::Detour(_)
    };
}

/// Moves to where the machine alone knows, after which the program does not know where these axes
/// stand, and values put into the control's tables. What bare axis words do, the feed and the cycle
/// stay as they are.
#[macro_export]
macro_rules! machine {
    () => {
        $crate::program::Op::GoToReference(_)
            | $crate::program::Op::OrientToolAxis(_)
            | $crate::program::Op::SetData(_)
    };
}

/// Moves that say themselves which they are: they end a cycle.
#[macro_export]
macro_rules! moves {
    () => {
        $crate::program::Op::StraightTraverse(_)
            | $crate::program::Op::StraightFeed(_)
            | $crate::program::Op::SynchronisedFeed(_)
            | $crate::program::Op::ArcFeed(_)
            | $crate::program::Op::ArcForm(_)
    };
}

/// A cycle is activated, executed where its statement stands, or at the places of a pattern. After a
/// pattern or a hole the tool stands where the cycle left it, which is not in their words alone.
#[macro_export]
macro_rules! drilling {
    () => {
        $crate::program::Op::StartCycle(_) | $crate::program::Op::Hole(_) | $crate::program::Op::Pattern(_)
    };
}

/// Where control flow leaves the straight line: nothing that was known before need hold
/// after it.
#[macro_export]
macro_rules! flow {
    () => {
        $crate::program::Op::Call(_)
            | $crate::program::Op::Return
            | $crate::program::Op::RepeatBlocks(_)
            | $crate::program::Op::Control(_)
            | $crate::program::Op::Goto(_)
            | $crate::program::Op::Label(_)
            | $crate::program::Op::Leave
            | $crate::program::Op::NextTurn
    };
}

/// Variables: no more than what expressions are worth changes.
#[macro_export]
macro_rules! variables {
    () => {
        $crate::program::Op::Assign(..) | $crate::program::Op::Declare(_)
    };
}

/// Points by radius and angle, and the pole that they are about. A polar move does what its own
/// operation does, to a point that is not in its words.
#[macro_export]
macro_rules! polar {
    () => {
        $crate::program::Op::SetPole(_) | $crate::program::Op::Polar(_)
    };
}
pub use {conduct, drilling, flow, frames, machine, miscellaneous, modes, moves, polar, tooling, variables};
