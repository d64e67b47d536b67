//! What ncc does not translate: calls, returns and what they give.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: calls, returns and what they give.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum CallUnsupported {
        /// A call with arguments, where calls are expanded.
        Arguments,
        /// A call beside other words.
        BesideWords,
        /// Ncc does not know which program this calls.
        UnknownText,
        /// A call by path.
        ByPath,
        /// This file name is no program name.
        FileName,
        /// Ncc does not know this modal call.
        Modal,
        /// `MCALL `code`: a hole pattern after each move.
        ModalPattern,
        /// A word beside the modal call.
        ModalWord,
        /// A modal call with a value that can change.
        ModalShared,
        /// A modal call in a block with block skip.
        ModalSkipped,
        /// A modal call while the caller's cycle may be active.
        ModalInCycle,
        /// A call while a modal call is active.
        WhileModal,
        /// A call under a cycle with G1, G2 or G3 active.
        UnderCycleMotion,
        /// A call of this subprogram under another cycle than before.
        UnderOtherCycle,
        /// This subprogram starts or cancels a cycle of its caller.
        CycleLeft,
        /// A hole position that may be at feed.
        FirstPosition,
        /// Repeated blocks with other active modes than at first.
        RepeatDiffers,
        /// Ncc does not know this attribute.
        Attribute,
        /// A jump to the start of a subprogram.
        StartOfSub,
        /// An array as a parameter without VAR.
        ArrayByValue,
        /// A text as a parameter.
        TextParameter,
        /// VAR or a default value, without the main program.
        SubAlone,
        /// A VAR parameter with a default value.
        DefaultOfReference,
        /// This default value is no number.
        DefaultForm,
        /// A computed index of the caller's array.
        ArrayIndexComputed,
        /// More arguments than parameters.
        MoreArguments,
        /// An array for a parameter that is no array.
        ArrayToOne,
        /// A variable by reference in a modal call.
        VarInModal,
        /// One variable for two parameters.
        VarTwice,
        /// This argument is no variable of the right type.
        VarType,
        /// This argument is no array of the right type and size.
        VarArray,
        /// This code in a subprogram that calls itself.
        VarRecursive,
        /// The subprogram also uses this R parameter.
        VarUsed,
        /// A call with a repeat count and a VAR parameter.
        VarRepeated,
        /// A macro call with a repeat count.
        MacroTimes,
        /// This code in the main program: it would run again without end.
        MainReturn,
        /// This code in a subprogram: the main program would begin again.
        BeginAgainInSub,
        /// This code in a subprogram of O words.
        NumberedInOSub,
        /// A computed program number with a repeat count.
        ComputedTimes,
        /// This code calls blocks of a subprogram.
        BlocksInSub,
        /// A computed block number.
        BlocksComputed,
        /// This code in a program with computed jumps.
        BlocksBesideJumps,
        /// This block is not in the program.
        BlocksMissing,
        /// Several blocks have this number.
        BlocksTwice,
        /// The program also runs into this block.
        BlocksRunInto,
        /// The called blocks do not end with a return.
        BlocksNoReturn,
        /// The program also jumps into these blocks.
        BlocksJumpedInto,
        /// This code with a block: the subprogram has other returns too.
        ReturnSeveral,
        /// This code with a block: the call has a repeat count.
        ReturnAgain,
        /// This code with a block: some calls have a computed number.
        ReturnComputed,
        /// This code with a block: the caller is not in this file.
        ReturnElsewhere,
        /// A modal macro call in another.
        ModalInModal,
        /// A modal macro call in a block with block skip.
        ModalMacroSkipped,
        /// A modal call with a common variable.
        ModalArgument,
        /// This code is active: this statement is no argument.
        ArgumentStatement,
        /// Its end is beside other words.
        ArgumentEnd,
        /// `word` while this code reads words as arguments.
        ArgumentWord {
            /// The word in the block.
            word: Box<str>,
        },
        /// This code in a block with block skip.
        ModalEndSkipped,
        /// This code in a block that moves.
        ModalEndMoves,
        /// A cycle, corner or machine move while this code is active.
        ModalOther,
        /// A call or return while this code is active.
        ModalFlow,
        /// An assignment while this code has variables as arguments.
        ModalAssignment,
        /// A jump over the start or the end of this code.
        ModalJump,
        /// This code starts or ends in a loop.
        ModalLoop,
        /// A repetition in repeated blocks.
        RepeatInRepeat,
        /// A repetition in a subprogram.
        RepeatInSub,
        /// Repeated blocks with other active modes than at first.
        RepeatModes,
        /// Two blocks have this number.
        RepeatNumberTwice,
        /// This code calls `name`, which is another kind of program.
        KindOfProgram {
            /// The name.
            name: Box<str>,
        },
        /// This code calls `name`, which is another kind of program.
        KindOfNumbered {
            /// The name.
            name: Box<str>,
        },
    }
}
