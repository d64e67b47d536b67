//! Ranks: what a user has to do about each thing that a translation reports.
//!
//! `units = mm` changes the whole cut; that a comment has other letters changes nothing. A report lists the first one
//! first. Every fault that does not refuse a program has its rank here, in one exhaustive match: a new fault does not
//! compile until it has one. Not here: the order within a rank, and the words.

use crate::control_fact::ControlFact;
use crate::diag::{Fault, ModeName};

/// What a user has to do, the worst first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Rank {
    /// Answer a question, if its two values make two different cuts of the program; else nothing.
    Dangerous,
    /// Look at the machine, or at its parameters.
    Check,
    /// Nothing on a machine that is set as usual.
    Usual,
    /// Nothing: the cut is the same.
    NoEffect,
}

impl Rank {
    /// All ranks, the worst first.
    pub const ALL: [Rank; 4] = [Rank::Dangerous, Rank::Check, Rank::Usual, Rank::NoEffect];

    /// Its name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Rank::Dangerous => "dangerous",
            Rank::Check => "check-at-the-machine",
            Rank::Usual => "usual-default",
            Rank::NoEffect => "no-effect-on-the-cut",
        }
    }
}

/// The rank of a mode that is assumed at the start.
const fn of_mode(mode: ModeName) -> Rank {
    match mode {
        ModeName::Units => Rank::Dangerous,
        ModeName::Motion
        | ModeName::Distance
        | ModeName::Plane
        | ModeName::FeedMode
        | ModeName::ReturnLevel
        | ModeName::WorkOffset
        | ModeName::LengthOffset
        | ModeName::OriginShift => Rank::Usual,
    }
}

impl Fault {
    /// Its rank; `None` of an error, which refuses the program.
    pub const fn rank(&self) -> Option<Rank> {
        Some(match self {
            // What two readings may cut in two ways: `questions` decides.
            Fault::AssumedBareNumber { .. }
            | Fault::AssumedControl { .. }
            | Fault::AssumedToolChange { .. }
            | Fault::AssumedReturn { .. }
            | Fault::AssumedCycle { .. } => Rank::Dangerous,

            // Facts of the machine, its tables or its builder, and those that a fork of the verification shows to matter.
            Fault::AssumedEdge { .. }
            | Fault::AssumedRadius { .. }
            | Fault::AssumedOffsetWithZ
            | Fault::AssumedWorkOffset { .. }
            | Fault::AssumedFact { fact: ControlFact::OriginWorkOffset { .. } }
            | Fault::AssumedNoEffect { .. }
            | Fault::AssumedRow { .. }
            | Fault::AssumedPath { .. }
            | Fault::AssumedContourEnds
            | Fault::AssumedContourPath
            | Fault::AssumedTip
            | Fault::AssumedTilt
            | Fault::AssumedFunction { .. }
            | Fault::StartedAgain { .. }
            | Fault::OpenBehaviour { .. }
            | Fault::CallDepth { .. }
            | Fault::MovedAtChange
            | Fault::LengthByHand { .. }
            | Fault::FeedOnArcs { .. }
            | Fault::PathAtStart { .. }
            | Fault::NextRunShifted { .. }
            | Fault::NextRunTurned
            | Fault::NextRunVariables { .. }
            | Fault::RoundsFreely
            | Fault::AssumedMilling { .. }
            | Fault::FeedAtUnits { .. }
            | Fault::OptionalStopDiffers
            | Fault::PathRelaxed { .. }
            // A loss that was allowed.
            | Fault::SkipLevelLost { .. }
            | Fault::MessageDropped
            // Warnings.
            | Fault::NoProgramEnd
            | Fault::TextAfterEnd
            | Fault::TextBeforeStart { .. }
            | Fault::LabelTwice { .. }
            | Fault::ComparedLast { .. }
            | Fault::SkipSettingsSampled { .. }
            | Fault::VariableGiven { .. }
            | Fault::BranchUncovered { .. }
            | Fault::OutputNotTaken { .. }
            | Fault::FactNotTried { .. }
            | Fault::ValueNotRead { .. }
            | Fault::NotCalled { .. }
            | Fault::ArgumentNeeded { .. }
            | Fault::CodeLeftOut { .. }
            | Fault::ToolNumbered { .. }
            | Fault::EdgeNumbered { .. }
            | Fault::CutStanding => Rank::Check,

            Fault::AssumedMode { fact, .. } => of_mode(*fact),
            Fault::AssumedOption { .. }
            | Fault::AssumedFact { .. }
            | Fault::AssumedHoleOrder { .. } => Rank::Usual,

            Fault::CommentReformatted
            | Fault::MessageAsComment
            | Fault::ArcReformatted
            | Fault::Rounded { .. }
            | Fault::PatternExpanded { .. }
            | Fault::CycleExpanded { .. }
            | Fault::CallExpanded { .. }
            | Fault::NumbersLeftOut { .. }
            | Fault::NameAsComment
            | Fault::BlockSplit
            | Fault::RepeatExpanded { .. }
            | Fault::FramesExpanded
            | Fault::CycleFolded { .. }
            | Fault::PatternFolded { .. }
            | Fault::NameChanged { .. }
            | Fault::AdviceLeftOut { .. }
            | Fault::OutputDropped
            | Fault::WorkOffsetLeftOut { .. }
            | Fault::Flattened { .. }
            | Fault::VariablesRenamed { .. }
            | Fault::AlarmsRenumbered { .. }
            | Fault::SideEffectWritten { .. }
            | Fault::FeedByTime
            | Fault::ValuesInFull { .. }
            | Fault::AlarmValues
            | Fault::MacroCloned { .. }
            | Fault::MachineCutExpanded { .. }
            | Fault::MachineCutFolded { .. }
            | Fault::PeckShortened
            | Fault::PolarExpanded
            | Fault::CompensationExpanded { .. }
            | Fault::CornerExpanded => Rank::NoEffect,

            Fault::UnexpectedCharacter { .. }
            | Fault::BadNumber { .. }
            | Fault::UnclosedComment
            | Fault::BlockTooLong { .. }
            | Fault::NotText
            | Fault::WordWithoutNumber { .. }
            | Fault::LetterOForZero
            | Fault::EmptyProgram
            | Fault::Syntax { .. }
            | Fault::OpeningMarkMissing { .. }
            | Fault::UnknownCode { .. }
            | Fault::NotSupported { .. }
            | Fault::FunctionNotRun { .. }
            | Fault::FunctionFailed { .. }
            | Fault::CodesExclude { .. }
            | Fault::WordUnused { .. }
            | Fault::WordMissing { .. }
            | Fault::WordTwice { .. }
            | Fault::TooManyCodes { .. }
            | Fault::PointNotAllowed { .. }
            | Fault::OutOfRange { .. }
            | Fault::NoMotionMode
            | Fault::ArcWithoutCentre
            | Fault::ArcCentreAndRadius
            | Fault::ArcEndOffCircle { .. }
            | Fault::ArcRadiusTooSmall
            | Fault::ArcRadiusNoWay
            | Fault::NoArc
            | Fault::NoCorner { .. }
            | Fault::PositionUnknown { .. }
            | Fault::CallUnknown { .. }
            | Fault::LabelUnknown { .. }
            | Fault::CallRecursive { .. }
            | Fault::CallsTooDeep { .. }
            | Fault::CallsDeeper { .. }
            | Fault::ProgramTwice { .. }
            | Fault::MacroLanguage { .. }
            | Fault::NoToolSelected
            | Fault::NoFeed
            | Fault::NoSpeed
            | Fault::SpindleForCycle { .. }
            | Fault::NoValue { .. }
            | Fault::VariableUnset { .. }
            | Fault::BeginsOtherwise { .. }
            | Fault::Computes { .. }
            | Fault::NoCycle
            | Fault::CycleUpsideDown
            | Fault::EntryFactNeeded { .. }
            | Fault::NotExecuted { .. }
            | Fault::NoEnd { .. }
            | Fault::Interrupted { .. }
            | Fault::Endless
            | Fault::RadiusUnknown { .. }
            | Fault::ContourUnreachable { .. }
            | Fault::TargetLacks { .. }
            | Fault::SecondWorkOffset { .. }
            | Fault::NoFileOfTool { .. }
            | Fault::ModeNotSet { .. }
            | Fault::ArcVanishes
            | Fault::DoneByTarget { .. }
            | Fault::MustBeStated { .. }
            | Fault::RefusedCompensated { .. }
            | Fault::ArcRadiiDiffer { .. }
            | Fault::RotaryTurnOpen { .. }
            | Fault::CompensatedThere { .. }
            | Fault::TargetRange { .. }
            | Fault::ProfileDenies { .. }
            | Fault::NotInMap { .. }
            | Fault::NotTheSame { .. }
            | Fault::NotReadBack { .. } => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diag::Gravity;

    /// An error has no rank, and whatever is no error has one.
    #[test]
    fn ranks_follow_gravity() {
        let some = [
            Fault::NotText,
            Fault::NoProgramEnd,
            Fault::AssumedTip,
            Fault::BlockSplit,
            Fault::OutputDropped,
            Fault::AssumedMode { fact: ModeName::Units, value: "mm".into() },
            Fault::AssumedMode { fact: ModeName::Plane, value: "XY".into() },
        ];
        for fault in some {
            assert_eq!(fault.rank().is_none(), fault.gravity() == Gravity::Error, "{fault:?}");
        }
    }
}
