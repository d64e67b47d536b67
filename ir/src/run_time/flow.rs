//! Loops, branches, jumps and calls that a target cannot compute when the program runs.

use crate::reason::reasons;

reasons! {
    /// Loops, branches, jumps and calls that a target cannot compute when the program runs.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum RunTimeFlow {
        /// A loop.
        Loop,
        /// A loop that is left.
        LoopLeft,
        /// A loop of this kind that is left.
        LoopLeftKind,
        /// A skipped iteration of a loop.
        LoopNextTurn,
        /// A loop that is repeated a number of times.
        LoopTimes,
        /// A loop that is repeated a computed number of times.
        LoopComputedTimes,
        /// A loop that counts.
        LoopCounts,
        /// A loop that counts otherwise than by ones.
        LoopCountsOtherwise,
        /// A loop of another kind.
        LoopOtherKind,
        /// A loop with its test at the end.
        LoopTestedAfter,
        /// A loop within so many others.
        LoopDepth,
        /// A loop under block skip.
        LoopSkipped,
        /// A loop that has no end.
        LoopEndless,
        /// A loop without a condition.
        LoopWithoutCondition,
        /// A repeated loop beside a loop with skipped iterations and a test at its end.
        LoopBesideLeft,
        /// A structure within {most} others.
        StructureDepth {
            /// The most that the target takes.
            most: u8,
        },
        /// A branch.
        Decision,
        /// A branch for more than one statement.
        DecisionStatements,
        /// A branch for another statement.
        DecisionStatement,
        /// A branch under block skip.
        DecisionSkipped,
        /// A jump.
        Jump,
        /// A jump to a block whose number is computed.
        ComputedJump,
        /// A subprogram with parameters.
        Subprogram,
        /// A call with arguments.
        CallArguments,
        /// A call with variables of its own.
        CallOwnVariables,
        /// A call with variables of its own with a repeat count.
        CallOwnAgain,
        /// A call with variables of its own within so many others.
        CallOwnDepth,
        /// A call with more arguments than the program has parameters.
        CallMoreArguments,
        /// A call with other arguments than its program has parameters.
        CallOtherArguments,
        /// A call with a repeat count, with values that the called program may change.
        CallChangesValues,
        /// A call of a program that has variables of its own elsewhere.
        CallOfOwnElsewhere,
        /// An argument that is no local variable.
        ArgumentNotLocal,
        /// An argument that is no variable of the call.
        ArgumentNotOfCall,
        /// Arguments of which the variables have no letters.
        ArgumentLetters,
        /// A rounding in an argument.
        ArgumentRounded,
        /// An argument that `--args` leaves empty.
        ArgumentEmpty {
            /// The name.
            name: Box<str>,
        },
        /// An argument without a letter, by the number of its variable.
        ArgumentLetter {
            /// The number.
            number: u32,
        },
        /// A parameter that all programs see.
        ParameterCommon,
        /// An array of the caller's as a parameter.
        ParameterArray,
        /// A parameter that is the caller's own variable, and is given none of its type.
        ParameterOtherType,
        /// A return out of a loop that is repeated a number of times.
        ReturnOutOfLoop,
        /// The setting of a result elsewhere than with the return.
        ResultElsewhere,
    }
}
