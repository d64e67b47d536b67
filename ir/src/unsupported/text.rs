//! What ncc does not translate: messages, comments, and the form of a program.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: messages, comments, and the form of a program.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum TextUnsupported {
        /// A message with a second argument.
        BlendedMessage,
        /// Ncc does not know this text.
        UnknownText,
        /// A truth value in a text.
        TruthValue,
        /// A text joined from parts.
        JoinedText,
        /// Does this alarm end the program?
        AlarmEnd,
        /// A message that shows the value of a parameter.
        ParameterInMessage,
        /// The control executes this comment.
        ActiveComment,
        /// A second comment in a block with a message.
        SecondComment,
        /// This text does not go to a file.
        DeviceText,
        /// More digits than the control writes.
        TooManyDigits,
        /// A program with a name.
        ProgramName,
        /// This code is no program.
        NoProgram,
        /// A second main program in one file.
        SecondMain,
        /// Only a call by path finds this subprogram.
        ByPathOnly,
        /// Another version of the text form.
        Version,
        /// The program before this code has no end.
        GoesOn,
        /// The program ends with cutter compensation active.
        EndUnderCompensation,
    }
}
