//! A text as other crates look at it without its meaning: where its program can go, its words, and its pieces.
//!
//! Not here: the lexers that find them.

use ncc_ir::source::Span;

/// A piece of a text, as far as it says where a program can go.
#[derive(Clone, Debug, PartialEq)]
pub enum Flow {
    /// A program or subprogram begins: numbers and labels are its own.
    Program,
    /// A block.
    Block {
        /// Its number or label, as jumps name it: `N40`, `AGAIN`.
        label: Option<String>,
        /// All of it.
        at: Span,
        /// Whether it says anything that is executed.
        says: bool,
        /// Whether it is part of a structure (a loop, an alternative) that may lead to it by itself.
        frames: bool,
    },
    /// A jump, in the block that was given last.
    Jump {
        /// Target of the jump; `None` is computed.
        to: Option<String>,
        /// Its place.
        at: Span,
        /// Whether it is always made.
        always: bool,
        /// Whether the control goes on where there is no such block.
        quiet: bool,
    },
}

/// A word of a text, as its dictionary may have a row for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Word<'t> {
    /// A letter with a number, in tenths where it has them: `G43`, `G5.1`, `X10.`.
    Numbered {
        /// The letter, a capital.
        letter: u8,
        /// Ten times the number, if that is a whole number; `None` for what no code has.
        tenths: Option<u32>,
    },
    /// A letter with another value, or none.
    Letter(u8),
    /// A word of several letters, as written.
    Name(&'t [u8]),
}

/// What a piece is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PieceKind {
    /// The letter that begins a word of the block: `X` of `X10.`, `N` of `N40`.
    Address,
    /// A letter anywhere else: in an expression, or an argument.
    Letter,
    /// An unsigned number.
    Number,
    /// A word of the language: `IF`, `GOTO`, `AND`, `SIN`.
    Key,
    /// Any other word of several letters.
    Name,
    /// An operator, a bracket, a comma; one or two characters.
    Sign,
    /// The mark of a block with block skip, with its level if that is part of the mark.
    Skip,
    /// What is to stay byte for byte: a string, a name in angle brackets, output of text.
    Kept,
    /// A comment with the signs that open and close it.
    Comment,
    /// A sign that ends a block before the line does.
    End,
}

/// A piece of a line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// What it is.
    pub kind: PieceKind,
    /// Its first byte in the line.
    pub start: usize,
    /// The byte after it.
    pub end: usize,
    /// Open brackets around it.
    pub depth: u32,
}

impl Piece {
    /// Its text.
    pub fn text<'l>(&self, line: &'l [u8]) -> &'l [u8] {
        line.get(self.start..self.end).unwrap_or_default()
    }
}

/// What a line is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineIs {
    /// One or more blocks, or nothing: it is all in the pieces.
    Blocks,
    /// It frames the program or a unit: `%`, `%_N_NAME_MPF`. To be kept.
    Frame,
    /// It does not belong to the program: after its closing mark, or in a unit that is none.
    Outside,
    /// The lexer cannot take it apart.
    Unread,
}
