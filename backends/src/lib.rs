//! ncc-backends: from statements of the neutral program to the text of a dialect.
//!
//! A back-end writes what it is given, block by block, with the words of the dictionary. It never
//! interprets: what its dialect cannot say has been expanded by passes before, and what still
//! cannot be stated is a diagnostic at the statement's place.
//!
//! ```text
//! STRAIGHT_FEED(X 10.5mm) & SET_FEED_RATE(100mm)    `G1 X10.5 F100.`
//! ```
//!
//! Not here: reading, passes, verification, file access, printing.

pub mod canon;
mod characters;
mod common;
pub mod ir;
mod origin;
pub mod siemens;
pub mod word;

mod writer;
pub use origin::Origin;
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

/// A shop's choices for the form of emitted programs, besides those that are rows of a dictionary.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Form {
    /// Characters of the text.
    pub characters: Characters,
    /// Blocks of a tool change.
    pub tool_change: ToolChange,
}

/// Characters of an emitted program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Characters {
    /// All, as UTF-8.
    #[default]
    All,
    /// ASCII; letters of other alphabets are transliterated.
    Ascii,
    /// ISO 8859-1; what it does not have is transliterated.
    Latin1,
}

/// Blocks of a tool change.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ToolChange {
    /// As in the source.
    #[default]
    Kept,
    /// Selection and change in one block, where the change follows directly.
    OneBlock,
    /// The change in a block of its own.
    TwoBlocks,
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
