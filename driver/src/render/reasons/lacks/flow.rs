//! The words of reasons: program flow and calls.

use std::borrow::Cow;

use ncc_ir::lack::FlowLack as L;

pub(super) fn text(lack: &L) -> Cow<'static, str> {
    Cow::Borrowed(match lack {
        L::Control => "control of the program's flow",
        L::Jump => "a jump",
        L::Label => "a label",
        L::Call => "a call",
        L::SubprogramCall => "a subprogram call",
        L::ThisCall => "this call",
        L::CallOfNoProgram => "a call of no program",
        L::CallNoTimes => "a call that is made no times",
        L::CallSeveralTimes => "a call that is made several times",
        L::CallSkipped => "a call that can be skipped",
        L::ComputedCall => "a computed call, where programs go by name",
        L::Return => "a return",
        L::ReturnFromSubprogram => "a return from a subprogram",
        L::ReturnSkipped => "a return that can be skipped, written out",
        L::ReturnWithoutMain => "the return of a subprogram without its main program",
        L::SubprogramJumps => "a subprogram with jumps, written out",
        L::CallsTooLong => "calls that are too long to be written out",
        L::Subprogram => "a subprogram",
        L::SubprogramParameters => "a subprogram with parameters",
        L::SubprogramUnnamed => "a subprogram without a name",
        L::SubprogramName { name } => return format!("a subprogram called {name}").into(),
        L::ProgramsAfterOpenEnd => "programs behind one that does not end",
        L::ProgramBeginsAgain => "a program that begins again",
        L::ProgramEnd => "the program's end",
        L::ProgramEndInSubprogram => "the program's end in a subprogram",
        L::ProgramStop => "a program stop",
        L::OptionalStop => "an optional stop",
        L::Repetition => "a repetition of blocks",
        L::RepetitionOfThese => "a repetition of these blocks",
        L::RepetitionComputed => "a computed repetition",
        L::RepetitionUnknown => "a repetition that is not made a known number of times",
        L::RepetitionJumps => "a repetition with jumps, written out",
        L::RepetitionDepth => "repetitions nested so deep",
        L::RepetitionTooLong => "a repetition that is too long to be written out",
        L::RepetitionInCycleBlock => "repeated blocks that begin or end within a cycle's own block",
        L::LoopLeft => "a loop that is left",
        L::SkippedBlock => "a block that can be skipped",
        L::SkippedTogether => "blocks that can be skipped together",
        L::TenthSkipSwitch => "a tenth block-skip switch",
        L::TwoSkipLevels => "a block under two block-skip levels",
        L::OwnSkipSwitch => "a block that can be skipped on a switch of its own",
        L::SkippedDecision => "a block that can be skipped and decides what is executed, written out",
        L::TooManyBlocks => "more blocks than a program may grow to",
    })
}
