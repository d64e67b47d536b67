//! What ncc does not translate: codes, words and the form of a block.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: codes, words and the form of a block.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum CodeUnsupported {
        /// The dictionary names the code, and gives no meaning.
        Named {
            /// The name.
            name: Box<str>,
        },
        /// The number of this code is computed.
        Computed,
        /// This code reads a variable that the program sets.
        Variable,
        /// This code and a code of the same modal group in one block.
        VariableInGroup,
        /// This code reads a variable while a canned cycle may be active.
        VariableInCycle,
        /// Ncc does not know this value.
        OtherUse,
        /// This code in a block that a switch skips.
        Skipped,
        /// A word with an index.
        Index,
        /// This code names a spindle by its number.
        SpindleByNumber,
        /// This code names the tool of one spindle.
        ToolOfSpindle,
        /// This code is an auxiliary function of the machine.
        AuxiliaryFunction,
        /// This code names an axis by its number.
        AxisByNumber,
        /// The control does not wait for this function.
        QuickFunction,
        /// A coded position of the machine.
        CodedPosition,
        /// This code has arguments that ncc does not know.
        Arguments,
        /// This code in a block with axis words.
        AxisWords,
        /// This code in a block with axis words.
        AdviceWithAxis,
        /// A dwell and other functions in one block.
        DwellBesideOthers,
        /// A dwell in revolutions of the spindle.
        DwellInTurns,
        /// A tolerance of the orientation.
        Tolerance,
        /// This kind of smoothing is coded in another way.
        ToleranceCoding,
        /// This code without the tolerance.
        ToleranceWithoutValue,
        /// A tolerance for merged moves, but none for corners.
        CornerTolerance,
        /// Path blending without its distance.
        RoundingDistance,
        /// The value of this word is computed.
        ComputedWord,
        /// A direction in a word that is no rotary axis.
        WayOfOtherWord,
        /// AC or IC in a word that is no coordinate.
        DistanceOfOtherWord,
        /// Direction and a computed angle.
        ComputedTurn,
        /// A synchronised action.
        SynchronisedAction,
        /// A macro of the language.
        Macro,
        /// This code changes a definition of the control.
        DefinedAnew,
        /// This block skip level does not exist here.
        SkipLevel,
        /// A second block skip level in one block.
        SecondSkipLevel,
        /// Block skip in the middle of a block.
        SkipAmidWords,
        /// This control has no switch for block skip.
        NoSkipSwitch,
        /// Limits of the stored stroke check.
        StrokeLimits,
        /// An argument without a decimal point.
        IncrementUnit,
        /// The number of this code may be anything.
        AnyNumber,
    }
}
