//! What ncc does not translate: variables, values, expressions and texts.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: variables, values, expressions and texts.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ValueUnsupported {
        /// Ncc does not know this system variable.
        Control,
        /// Ncc does not know this system variable.
        ControlOwn,
        /// The program sets a system variable.
        ControlSet,
        /// The program sets a system variable.
        ControlOwnSet,
        /// The program does not define this variable.
        Undefined,
        /// Ncc does not know this function.
        UnknownFunction,
        /// This control has no such function.
        Function,
        /// Ncc does not know this word.
        Call,
        /// A position of the control in inches.
        InInches,
        /// A text in place of a number.
        Text,
        /// An axis in place of a number.
        Address,
        /// The number of indices does not fit the array.
        Indices,
        /// An R parameter without its number.
        RWithoutNumber,
        /// An index is missing.
        IndexLeftOut,
        /// Ncc does not know this form of a value.
        Form,
        /// This code changes: the active cycle was computed from it.
        SetInCycle,
        /// This code changes: the modal call passes it.
        SetInModal,
        /// Several values for one variable.
        SeveralForOne,
        /// Several values, but this is no array.
        SeveralForNoArray,
        /// Several values from a computed element on.
        SeveralComputed,
        /// This code without its value.
        RepWithoutValue,
        /// A computed number of elements.
        RepComputed,
        /// A computed feed in mm or in inch?
        FeedUnit,
        /// A word reads a variable that this block sets.
        ReadsOwn,
        /// A definition for all programs.
        ForAllPrograms,
        /// An attribute of a variable.
        VariableAttribute,
        /// This code in a block with block skip.
        DefSkipped,
        /// This code after other blocks.
        DefLate,
        /// A variable of type CHAR.
        Character,
        /// A variable of type AXIS.
        AxisVariable,
        /// A variable of type FRAME.
        FrameVariable,
        /// A variable cannot have this name.
        VariableName,
        /// This code is a word of the language.
        ReservedName,
        /// This variable is defined twice.
        DefinedTwice,
        /// This code is a word of the language.
        ReservedLabel,
        /// An array of more than three dimensions.
        Dimensions,
        /// An array of texts.
        TextArray,
        /// Ncc does not know this form of a value.
        FirstValueForm,
        /// More than 64 levels of brackets.
        TooDeep,
        /// A character in place of a number.
        CharacterValue,
        /// Joined texts in place of a number.
        TextsJoined,
        /// Chained frames.
        FramesChained,
        /// Wrong number of arguments.
        FunctionArguments,
        /// A name in place of a number.
        Name,
        /// A text joined from parts.
        TextJoined,
        /// This text changes after blocks that use it.
        TextChanged,
        /// The text is too long for its variable.
        TextLong,
        /// The texts differ only in capital letters.
        TextCase,
        /// Ncc does not know these texts.
        TextsUnknown,
        /// The remainder of a fraction.
        Remainder,
        /// An assignment between a cycle and its first hole.
        CycleUnset,
        /// An assignment and a message in one block.
        SettingWithMessage,
        /// Assignments in one block that read each other.
        SettingsCircular,
        /// An assignment of a system value beside words that read it.
        SettingOfControl,
        /// The program sets a result.
        SetResult,
        /// The program sets a parameter of LinuxCNC.
        SetControl,
        /// A system value in a block that changes it.
        ControlLate,
        /// A named local parameter in an M99 program.
        LocalInNumbered,
        /// This code is a value of the machine's configuration.
        MachineValue,
    }
}
