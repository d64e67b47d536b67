//! The values that a key of a profile or a project file takes.
//!
//! ```text
//! decimals = "three"    Takes::Whole    this is not a value of decimals: it takes a whole number
//! ```
//!
//! The words are in `driver/messages/machine`. Not here: which key takes what (`schema`, `project`).

/// The values that a key takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Takes {
    /// One of these words.
    OneOf(&'static [&'static str]),
    /// Any text.
    Text,
    /// Any number.
    Number,
    /// A number, or a word in quotes: the value of an option.
    NumberOrWord,
    /// A value, nothing, or a table with the value and its source.
    Fact,
    /// A whole number from 0.
    Whole,
    /// A whole number from 1.
    WholeAboveZero,
    /// A whole number, both ends included.
    WholeBetween {
        /// The least.
        least: u32,
        /// The greatest.
        most: u32,
    },
    /// A number from 0.
    FromZero,
    /// A number greater than 0.
    AboveZero,
    /// A number, both ends included.
    Between {
        /// The least.
        least: i64,
        /// The greatest.
        most: i64,
    },
    /// Two numbers, the lower one first.
    LowAndHigh,
    /// The name of a program: letters, digits and underlines.
    ProgramName,
    /// The name of a machine function: small letters, digits and hyphens.
    FunctionName,
    /// `M` and a number.
    MCode,
    /// Texts of one line each.
    Lines,
    /// Letters and digits.
    Extension,
    /// A text, or several.
    Texts,
    /// A pattern of file names, or several.
    Patterns,
    /// A machine: its file, its name, or its profile in place.
    Machine,
    /// A folder.
    Folder,
    /// A folder, or several.
    Folders,
    /// A body: by coordinates, or a file of triangles.
    Body,
    /// A body, or several.
    Bodies,
}

impl Takes {
    /// Names by which readers of values say what they expect: those of `serde`, and those of this crate.
    const EXPECTED: &[(&str, Takes)] = &[
        ("f64", Takes::Number),
        ("u32", Takes::Whole),
        ("a boolean", Takes::OneOf(&["true", "false"])),
        ("a string", Takes::Text),
        ("a sequence", Takes::Lines),
        ("an array", Takes::LowAndHigh),
        ("texts", Takes::Texts),
        ("machine", Takes::Machine),
        ("fact", Takes::Fact),
        ("number-or-word", Takes::NumberOrWord),
    ];

    /// The name by which a reader of values says that it expects this.
    pub(crate) fn expected(self) -> &'static str {
        Takes::EXPECTED.iter().find(|(_, takes)| *takes == self).map_or("", |(name, _)| name)
    }

    /// The values that a reader expects, by its message: `invalid type: string "soon", expected f64`.
    pub(crate) fn of_message(message: &str) -> Option<Takes> {
        let of_kind =
            message.strip_prefix("invalid type: ").or_else(|| message.strip_prefix("invalid value: "))?;
        let (_, expected) = of_kind.rsplit_once(", expected ")?;
        let is_expected = |name: &str| {
            expected.strip_prefix(name).is_some_and(|rest| rest.is_empty() || rest.starts_with(' '))
        };
        Takes::EXPECTED.iter().find(|(name, _)| is_expected(name)).map(|(_, takes)| *takes)
    }
}
