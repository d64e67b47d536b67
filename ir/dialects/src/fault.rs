//! Why a dictionary cannot be used, and where in its text.
//!
//! Typed and without wording for people beyond one line: the command line renders the place.

use std::fmt;
use std::ops::Range;

/// A text that dictionaries are read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Text {
    /// One of the files that were given, by its place among them.
    File(usize),
    /// The data file of a built-in dialect, by its place among [`crate::builtins`].
    BuiltIn(usize),
}

/// A place in the text of a dictionary.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The text.
    pub text: Text,
    /// Its bytes.
    pub span: Range<usize>,
}

/// Why a dictionary cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DialectError {
    /// What is wrong.
    pub fault: DialectFault,
    /// The offending row or value; `None` if it has no place of its own.
    pub place: Option<Place>,
    /// Where the dictionary names its base, if the place lies in the base's own text.
    pub inherited_by: Option<Place>,
}

/// What is wrong with a dictionary.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DialectFault {
    /// Not TOML, or a field that is not of the form that the schema says.
    Form(String),
    /// A field that a dictionary must state itself.
    Missing {
        /// The field.
        field: &'static str,
    },
    /// A name that is no name on the command line.
    BadId {
        /// The name.
        id: String,
    },
    /// A built-in dialect is not redefined.
    BuiltInId {
        /// Its name.
        id: String,
    },
    /// Two files define one name.
    IdTwice {
        /// The name.
        id: String,
    },
    /// There is no dialect of the base's name.
    NoBase {
        /// The base's name.
        base: String,
    },
    /// A dictionary that builds on itself.
    BaseCycle {
        /// The names, each the base of the one before.
        chain: Vec<String>,
    },
    /// A dialect cannot be of another family than its base.
    OtherFamily,
    /// A row without the field by which rows of its table are told apart.
    NoKey {
        /// The table: `code`.
        table: String,
        /// The field: `code`.
        key: &'static str,
    },
    /// Two rows of one key in one file.
    RowTwice {
        /// The row.
        row: String,
    },
    /// `remove` or `replace` where the base has nothing of the kind.
    NothingThere {
        /// The row or table.
        row: String,
        /// The word.
        word: &'static str,
    },
    /// A row without the fields of a new row, so that it must be one of the base; and the base has none of that name.
    NotInBase {
        /// The row.
        row: Box<str>,
        /// Names of the base's rows of this table.
        among: Box<[String]>,
    },
    /// A cycle of a kind that there is not.
    NoCycleKind {
        /// The cycle's code.
        row: Box<str>,
        /// Its kind.
        kind: Box<str>,
    },
    /// A row that no reader comes to.
    Unreadable {
        /// Code, name or letter of the row.
        row: String,
        /// Why.
        why: Unreadable,
    },
    /// A row that contradicts another, or names what is not there.
    Row {
        /// Code, name or letter of the row.
        row: String,
        /// What is wrong.
        wrong: &'static str,
    },
}

/// Why no reader comes to a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unreadable {
    /// A code is G or M with a number.
    Code,
    /// Its number has one digit after the point at most, and four before it.
    Number,
    /// An address is one of A to Z.
    Letter,
    /// The letter is read as the beginning of a code, a block number or a program number.
    Taken,
    /// An axis is one of X, Y, Z, A, B and C.
    Axis,
    /// A word of a code, cycle or pattern has a letter that no row of `[[address]]` has.
    Word(char),
    /// Words of several letters are read in dialects of the family `sinumerik` only.
    Name,
}

impl DialectFault {
    /// The fault at a place.
    pub(crate) fn at(self, place: Option<Place>) -> DialectError {
        DialectError { fault: self, place, inherited_by: None }
    }
}

impl fmt::Display for DialectFault {
    /// In one line.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            DialectFault::Form(message) => f.write_str(message),
            DialectFault::Missing { field } => write!(f, "a dictionary states its own `{field}`"),
            DialectFault::BadId { id } => {
                write!(f, "`{id}` is no name of a dialect: letters, digits, `_` and `-`, a letter first")
            }
            DialectFault::BuiltInId { id } => write!(f, "{id} is built in and cannot be redefined"),
            DialectFault::IdTwice { id } => write!(f, "two files define {id}"),
            DialectFault::NoBase { base } => write!(f, "there is no dialect `{base}` to build on"),
            DialectFault::BaseCycle { chain } => {
                write!(f, "a dictionary cannot build on itself: {}", chain.join(", on "))
            }
            DialectFault::OtherFamily => f.write_str("a dialect has the family of its base"),
            DialectFault::NoKey { table, key } => write!(f, "a row of [[{table}]] needs `{key}`"),
            DialectFault::RowTwice { row } => write!(f, "row {row}: stands twice"),
            DialectFault::NothingThere { row, word } => {
                write!(f, "{row}: `{word}`, and the base has nothing of that name")
            }
            // Users have words of the messages about these.
            DialectFault::NotInBase { row, .. } => f.write_str(row),
            DialectFault::NoCycleKind { row, kind } => write!(f, "{row}: {kind}"),
            DialectFault::Unreadable { row, why } => write!(f, "{row}: {why:?}"),
            DialectFault::Row { row, wrong } => write!(f, "row {row}: {wrong}"),
        }
    }
}

impl fmt::Display for DialectError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.fault.fmt(f)
    }
}

impl std::error::Error for DialectError {}
