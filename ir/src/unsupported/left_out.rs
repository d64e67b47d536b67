//! Text of a program that a translation leaves out because the user, or the control, gives it no effect.

use crate::reason::reasons;

reasons! {
    /// The text that is left out.
    #[derive(Clone, Debug, PartialEq, Eq)]
    #[allow(missing_docs, reason = "the fields are texts of the program")]
    pub enum LeftOut {
        /// A code without an effect on the cut.
        Code { code: Box<str>, },
        /// A rate of rapid moves, which is the machine's.
        RapidRate { code: Box<str>, },
        /// A code that the control reads as another.
        ReadAs { code: Box<str>, other: Box<str>, },
        /// A code of machine coordinates without an axis word.
        WithoutAxis { code: Box<str>, },
        /// A code without the word that it needs.
        WithoutLetter { code: Box<str>, letter: char, },
        /// A call of a program.
        Call { name: Box<str>, },
        /// The dwell of a cycle.
        Dwell { code: Box<str>, },
        /// An assignment to a variable.
        Assignment { name: Box<str>, },
    }
}

impl LeftOut {
    /// A code without an effect on the cut.
    pub fn code(code: &str) -> LeftOut {
        LeftOut::Code { code: code.into() }
    }
}
