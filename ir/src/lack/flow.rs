//! Program flow and calls, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Program flow and calls that a target lacks.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum FlowLack {
        /// Control of the program's flow.
        Control,
        /// A jump.
        Jump,
        /// A label.
        Label,
        /// A call.
        Call,
        /// A subprogram call.
        SubprogramCall,
        /// A call of a program that is not in the text.
        ThisCall,
        /// A call of no program.
        CallOfNoProgram,
        /// A call that is with repeat count 0.
        CallNoTimes,
        /// A call with a repeat count.
        CallSeveralTimes,
        /// A call under block skip.
        CallSkipped,
        /// A computed call, where programs go by name.
        ComputedCall,
        /// A return.
        Return,
        /// A return from a subprogram.
        ReturnFromSubprogram,
        /// A return under block skip, expanded.
        ReturnSkipped,
        /// The return of a subprogram without its main program.
        ReturnWithoutMain,
        /// A subprogram with jumps, expanded.
        SubprogramJumps,
        /// Calls that are too long to be expanded.
        CallsTooLong,
        /// A subprogram.
        Subprogram,
        /// A subprogram with parameters.
        SubprogramParameters,
        /// A subprogram without a name.
        SubprogramUnnamed,
        /// A subprogram by this name.
        SubprogramName {
            /// The name.
            name: Box<str>,
        },
        /// Programs after one that does not end.
        ProgramsAfterOpenEnd,
        /// A program that begins again.
        ProgramBeginsAgain,
        /// The program's end.
        ProgramEnd,
        /// The program's end in a subprogram.
        ProgramEndInSubprogram,
        /// A program stop.
        ProgramStop,
        /// An optional stop.
        OptionalStop,
        /// A repetition of blocks.
        Repetition,
        /// A repetition of these blocks.
        RepetitionOfThese,
        /// A computed repetition.
        RepetitionComputed,
        /// A repetition with an unknown repeat count.
        RepetitionUnknown,
        /// A repetition with jumps, expanded.
        RepetitionJumps,
        /// Repetitions nested so deep.
        RepetitionDepth,
        /// A repetition that is too long to be expanded.
        RepetitionTooLong,
        /// Repeated blocks that begin or end within a cycle's own block.
        RepetitionInCycleBlock,
        /// A loop that is left.
        LoopLeft,
        /// A block with block skip.
        SkippedBlock,
        /// Blocks under block skip together.
        SkippedTogether,
        /// A tenth block-skip switch.
        TenthSkipSwitch,
        /// A block under two block-skip levels.
        TwoSkipLevels,
        /// A block with block skip on a switch of its own.
        OwnSkipSwitch,
        /// A block with block skip and decides what is executed, expanded.
        SkippedDecision,
        /// More blocks than a program may grow to.
        TooManyBlocks,
    }
}
