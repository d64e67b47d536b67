//! What is wrong with a profile, typed, with its place in the file. The words are the command
//! line's.

use std::ops::Range;

use crate::takes::Takes;

/// A fault of a profile.
#[derive(Clone, Debug, PartialEq)]
pub struct ProfileError {
    /// What it is.
    pub wrong: Wrong,
    /// Where, in bytes of the file.
    pub span: Range<usize>,
    /// Another place that belongs to it.
    pub related: Option<Range<usize>>,
}

impl ProfileError {
    /// A fault at one place.
    pub fn new(wrong: Wrong, span: Range<usize>) -> ProfileError {
        ProfileError { wrong, span, related: None }
    }
}

/// A thing that a profile has once.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the fields are its number or its name, as the file has them")]
pub enum Twice {
    Axis { letter: String },
    Tool { number: u32 },
    ToolName { name: String },
    Pocket { number: u32 },
    LengthEntry { number: u32 },
    Edge { tool: u32, edge: u32 },
    WorkOffset { number: u32 },
    WorkOffsetName { name: String },
    Program { number: u32 },
    ProgramName { name: String },
    Code { code: String },
}

/// A thing that needs a key.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needs {
    /// An axis needs its letter.
    Axis,
    /// A tool needs its number.
    Tool,
    /// An edge needs its tool, its number and its entry.
    Edge,
    /// A work offset needs its number.
    WorkOffset,
    /// A program needs its number.
    Program,
    /// New block numbers need the first number and the step.
    NewNumbers,
}

/// A thing that a dialect lacks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lacks {
    /// A length table: the tools have edges.
    LengthTable,
    /// Block numbers.
    BlockNumbers,
    /// Comments.
    Comments,
    /// Program numbers.
    ProgramNumbers,
}

/// Why no file can match a pattern.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum PatternFault {
    /// It is empty.
    Empty,
    /// It separates folders by a backslash.
    Backslash,
    /// It leaves the folder of the project file.
    Outside,
    /// The list has no pattern.
    NoneInList,
    /// It is not of the form of a pattern.
    Unread {
        /// The words of the pattern's reader.
        reader: String,
    },
}

/// What is wrong.
#[derive(Clone, Debug, PartialEq)]
pub enum Wrong {
    /// Not the form of a profile: not TOML, a key that there is not.
    Form {
        /// What the reader of the form says.
        message: String,
    },
    /// A value of a kind that its key does not take: a text for a number.
    Kind {
        /// The value, as the file has it.
        found: String,
        /// The values that the key takes.
        takes: Takes,
    },
    /// No dialect of that name.
    UnknownDialect {
        /// The name.
        name: String,
    },
    /// The dictionary has no such option.
    UnknownOption {
        /// The option.
        option: String,
        /// Those that it has.
        has: Vec<String>,
    },
    /// The option takes other values.
    OptionValue {
        /// The option.
        option: String,
        /// The value.
        value: String,
        /// What it takes; empty if any number.
        takes: Vec<String>,
    },
    /// The dictionary has no such row, and there is no such reading of it.
    UnknownRow {
        /// The row.
        row: String,
    },
    /// An axis, a tool, a work offset, a program or a code twice, or the name of one.
    Twice {
        /// What stands twice.
        what: Twice,
    },
    /// The lower end of a travel is not below the upper one.
    UpsideDown,
    /// A value that its key does not take.
    Takes {
        /// The key.
        key: &'static str,
        /// What it takes.
        takes: Takes,
    },
    /// A key without which the table says nothing.
    Missing {
        /// The key.
        key: &'static str,
        /// The entry that needs the key.
        needs: Needs,
    },
    /// An M code that the dialect has.
    CodeKnown {
        /// The code.
        code: String,
        /// What it means there, or the name by which it is refused.
        means: String,
    },
    /// Two codes for one function: which of them would be written?
    NotOneToOne {
        /// The function.
        function: String,
    },
    /// More digits than the control has.
    TooFine {
        /// The key.
        key: &'static str,
        /// How many it has.
        most: u8,
    },
    /// A choice for emitted programs that the dialect has no form for.
    NoForm {
        /// The key.
        key: &'static str,
        /// What the dialect does not have.
        lacks: Lacks,
    },
    /// A source that no fact names, though one names a source that is nearly the same and is not in the list.
    UnusedSource {
        /// The tag in the list.
        tag: String,
        /// The name in the fact.
        nearest: String,
    },
    /// A project file names a machine that is neither shipped nor a file.
    NoMachine {
        /// The name.
        name: String,
        /// The shipped machines.
        has: Vec<String>,
        /// Whether it is the name of a dialect.
        is_dialect: bool,
    },
    /// A pattern of a project file that no file can match.
    Pattern {
        /// Why not.
        why: PatternFault,
    },
    /// Two rows of a project file match one program.
    TwoRows {
        /// The program, from the folder of the project file.
        program: String,
    },
    /// A pattern of a project file that no file below its folder matches: a warning.
    NoFile {
        /// The pattern.
        pattern: String,
    },
    /// A project file without rows.
    NoRows,
    /// A folder that a project file names and that there is not.
    NoFolder {
        /// The folder, as the file names it.
        name: String,
    },
    /// A text of a project file that states no body.
    NoBody {
        /// The text.
        text: String,
        /// Whether it has the form of one, but a range is none.
        is_range: bool,
    },
}

impl Wrong {
    /// The number of its stable code: 701 is `NC0701`.
    pub const fn code(&self) -> u16 {
        match self {
            Wrong::Form { .. } | Wrong::Kind { .. } => 701,
            Wrong::UnknownDialect { .. } => 702,
            Wrong::UnknownOption { .. } => 703,
            Wrong::OptionValue { .. } => 704,
            Wrong::UnknownRow { .. } => 705,
            Wrong::Twice { .. } => 706,
            Wrong::UpsideDown => 707,
            Wrong::Takes { .. } => 708,
            Wrong::Missing { .. } => 709,
            Wrong::CodeKnown { .. } => 710,
            Wrong::NotOneToOne { .. } => 711,
            Wrong::TooFine { .. } => 712,
            Wrong::NoForm { .. } => 713,
            Wrong::NoMachine { .. } => 714,
            Wrong::Pattern { .. } => 715,
            Wrong::TwoRows { .. } => 716,
            Wrong::NoFile { .. } => 717,
            Wrong::NoRows => 718,
            Wrong::NoFolder { .. } => 719,
            Wrong::UnusedSource { .. } => 720,
            Wrong::NoBody { .. } => 721,
        }
    }

    /// Every code of a profile.
    pub const CODES: &'static [u16] = &[701, 702, 703, 704, 705, 706, 707, 708, 709, 710, 711, 712, 713, 720];

    /// Every code of a project file that is none of a profile.
    pub const PROJECT_CODES: &'static [u16] = &[714, 715, 716, 717, 718, 719, 721];
}
