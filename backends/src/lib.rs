//! ncc-backends: from statements of the neutral program to the text of a dialect.
//!
//! A back-end writes what it is given, block by block, with the words of the dictionary. It never
//! interprets: what its dialect cannot say has been expanded by passes before, and what still
//! cannot be said is a diagnostic at the statement's place.
//!
//! Not here: reading, passes, verification, file access, printing.

pub mod canon;
pub mod ir;
pub mod siemens;
pub mod word;

mod writer;
pub use writer::Writer;

use ncc_ir::program::ProgramName;

/// How a program is laid out.
#[derive(Clone, Debug, Default)]
pub struct Layout {
    /// Block numbers.
    pub numbering: Numbering,
    /// Windows line ends.
    pub crlf: bool,
}

/// Block numbers of an emitted program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Numbering {
    /// None.
    #[default]
    Off,
    /// Those of the source.
    Keep,
    /// A first number and a step.
    Every {
        /// The first number.
        first: u32,
        /// The step.
        step: u32,
    },
}

/// What the head of an emitted program tells the operator.
#[derive(Clone, Debug, Default)]
pub struct Head {
    /// The program's name, or one made from the file's.
    pub name: ProgramName,
    /// Lines of comment: source and hash, verified or not, assumptions. Empty for no comment.
    pub lines: Vec<String>,
}
