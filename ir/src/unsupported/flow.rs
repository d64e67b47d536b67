//! What ncc does not translate: jumps, loops, branches and O words.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: jumps, loops, branches and O words.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum FlowUnsupported {
        /// A jump to a computed label.
        Computed,
        /// A jump far back.
        FarBack,
        /// A jump to a block with another modal cycle.
        OtherModal,
        /// This code without its end.
        Unclosed,
        /// This code in a block with block skip.
        HeadSkipped,
        /// More than `most` nested structures.
        TooDeep {
            /// The largest number that is allowed.
            most: usize,
        },
        /// The counter is no plain variable.
        Counter,
        /// A branch changes the modal cycle or rounding.
        BranchModal,
        /// A loop or branch changes the modal cycle or rounding.
        LoopModal,
        /// This code without an IF.
        ElseAlone,
        /// This code does not close `open`.
        EndWithin {
            /// The word that begins the innermost structure.
            open: Box<str>,
        },
        /// This code closes nothing.
        EndOfNothing,
        /// This code in a block with block skip.
        EndSkipped,
        /// The end value may change in the loop.
        EndValue,
        /// A loop in another with the same number.
        LoopTwice,
        /// This loop number is not allowed.
        LoopNumber,
        /// A jump in a long program.
        LongText,
        /// This code without its `DO`.
        EndOfNoLoop,
        /// This code closes another loop than `own`.
        EndOfOther {
            /// The number of the innermost loop.
            own: u32,
        },
        /// The loop has block skip at its start or end.
        LoopSkipped,
        /// This code without its `END`.
        LoopUnclosed,
        /// The label is computed.
        LabelComputed,
        /// Other words in the block.
        OWords,
        /// This code in a block with block skip.
        OSkipped,
        /// Too many values in brackets.
        OValues,
        /// This code without its value.
        OValue,
        /// This code without its `if`.
        OElse,
        /// This code closes nothing.
        OEnd,
        /// This code without its end.
        OUnclosed,
        /// A word after a label that is none of the O words.
        OWord,
        /// The same, which is nearly one of them.
        OWordNear {
            /// The one that it is nearly.
            nearest: Box<str>,
        },
        /// This label occurs twice.
        OLabelTwice,
        /// This code after a `continue` of the same `do` loop.
        BreakAfterContinue,
        /// This code in another loop.
        BreakOuter,
        /// This code in a `repeat`.
        BreakRepeat,
        /// This code is in no loop with this label.
        BreakNoLoop,
        /// `do` in a file where `break` leaves a `while`.
        DoAfterBreak,
        /// `repeat` in a file with `continue` in a `do`.
        RepeatAfterContinue,
        /// This code in another subprogram.
        SubInSub,
        /// This code in a loop or a branch.
        SubInLoop,
        /// The program runs into this subprogram.
        SubRunInto,
        /// This code closes no subprogram.
        SubEnd,
        /// A subprogram calls itself in a `repeat`.
        SubRecursive,
        /// This code outside a subprogram.
        ReturnNoSub,
        /// This code in a `repeat`.
        ReturnRepeat,
        /// A return without a value in a long program.
        ReturnValue,
        /// This code in another structure.
        EndWithinElse,
    }
}
