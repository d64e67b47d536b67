//! Why a dictionary cannot be used, and where in its text.
//!
//! Typed and without words: the driver has them (`messages/dictionary`), and the command line shows the place.

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
    /// `base` is not a text.
    BaseNoText,
    /// The default of an option is none of its values.
    NoDefaultValue {
        /// The default.
        name: Box<str>,
        /// The values.
        among: Box<[String]>,
    },
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
    /// A row without the field by which rows of its table are distinguished.
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
    /// A row that no reader reaches.
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
        wrong: RowFault,
    },
}

/// Why no reader reaches a row.
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

/// An enum of faults without data, and the list of them.
macro_rules! row_faults {
    ($( $(#[$doc:meta])* $name:ident, )*) => {
        /// The fault of a row that contradicts another, or names something absent.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum RowFault {
            $( $(#[$doc])* $name, )*
        }

        impl RowFault {
            /// All of them.
            pub const ALL: &'static [RowFault] = &[ $( RowFault::$name, )* ];
        }
    };
}

row_faults! {
    /// Its name is no behaviour, or its value is none of it.
    NoBehaviour,
    /// Its `others` are no values of the behaviour.
    OtherValues,
    /// A variant under an option that there is not.
    NoOption,
    /// A variant under a value that its option has not.
    NoOptionValue,
    /// A variant under its option's default.
    DefaultValue,
    /// `upto` in a row of no work offsets.
    SeveralCodes,
    /// A code with both, or neither.
    MeansOrRefuse,
    /// `feed_mode` beside another meaning than that of a spindle speed.
    FeedModeAlone,
    /// `turns` without a tilted plane, or the other way round.
    TurnsAxis,
    /// `count` without a word of work offsets.
    CountAlone,
    /// A code that starts a cycle that no row describes.
    NoCycleRow,
    /// A code that makes a pattern that no row describes.
    NoPatternRow,
    /// A code that sets values of no table.
    NoDataRow,
    /// `blocks` with other signs than letters.
    BlockLetters,
    /// No source.
    NoSource,
    /// A default that is no number, of an option without values.
    NoNumberDefault,
    /// `hand` without tapping, or the other way round.
    HandOfTap,
    /// `shift` without fine boring, or the other way round.
    ShiftOfBore,
    /// `shrinking` without `peck`.
    ShrinkingAlone,
    /// `dwell_by` beside `dwell`, or of no option.
    DwellBy,
    /// Twice in a table.
    Twice,
    /// A cycle that no code starts.
    CycleNotStarted,
    /// A pattern that no code makes.
    PatternNotStarted,
    /// A table whose name is no code with a word.
    NoCodeWithWord,
    /// A table that no code sets.
    TableNotSet,
    /// `values` without tools, or the other way round.
    ValuesOfTools,
    /// A table of nothing.
    NoEntries,
    /// A name with other signs than capitals, digits and `_`.
    NoCapitals,
    /// A name with several uses, or none.
    OneUse,
    /// `role` without `quantity`, or the other way round.
    RoleQuantity,
    /// `arguments` of a name with an effect.
    ArgumentsEffect,
    /// A parameter of a call without a use.
    ParameterUse,
    /// Two parameters of one role.
    RoleTwice,
    /// No code.
    NoCode,
    /// A code of another letter than G and M.
    NeitherGNorM,
    /// No letter.
    NoLetter,
    /// A function of a user's program in a dialect whose words are no letters with numbers.
    FunctionOfWords,
    /// A function of a user's program whose code has a row.
    FunctionOfCode,
    /// A function without a program.
    NoCommand,
    /// A time limit or a number of blocks out of range.
    FunctionLimits,
}

impl DialectFault {
    /// The fault at a place.
    pub(crate) fn at(self, place: Option<Place>) -> DialectError {
        DialectError { fault: self, place, inherited_by: None }
    }
}

impl fmt::Display for DialectError {
    /// For a developer; users get words of the messages.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.fault)
    }
}

impl std::error::Error for DialectError {}
