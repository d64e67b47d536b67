//! Text that is not of its form: the text that stands in a place, and the text that belongs there.
//!
//! ```text
//! X1 2    found `2`, expected Expected::Word    `2` is not expected here: expected a word
//! ```
//!
//! Not here: the words (`driver/messages`).

/// The text that stands in a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Found {
    /// Text of the program.
    Text(Box<str>),
    /// Nothing: the line ends.
    EndOfLine,
    /// Nothing: the block ends.
    EndOfBlock,
    /// Nothing: the text ends.
    EndOfText,
    /// A line of another kind.
    Line,
    /// More words than a line may have.
    ManyWords,
}

impl From<&str> for Found {
    fn from(text: &str) -> Found {
        Found::Text(text.into())
    }
}

/// The text that belongs in a place.
#[derive(Clone, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names are the meaning")]
pub enum Expected {
    /// Words and signs of the form itself.
    Text(Box<str>),
    Word,
    WordOrNumber,
    Number,
    /// A number or `_`.
    NumberOrNothing,
    WholeNumber,
    QuotedText,
    /// A text whose backslashes are those of the form.
    PlainEscapes,
    Name,
    /// One of these.
    OneOf(Box<str>),
    Path,
    Type,
    Jump,
    Expression,
    Statement,
    Block,
    OperatorOrEnd,
    EndOfBlock,
    EndOfLine,
    /// `{` at the end of the line.
    BodyAtEnd,
    /// `}` before the statement.
    EndOfBody,
    /// `}` without further text.
    EndOfBodyAlone,
    /// A line has so many words at most.
    Words {
        most: usize,
    },
    /// Bodies are in so many others at most.
    Bodies {
        most: usize,
    },
    PointOfPlane,
    RotaryAxis,
    StraightMove,
}

impl From<&str> for Expected {
    fn from(text: &str) -> Expected {
        Expected::Text(text.into())
    }
}

/// A value that is out of its range.
#[derive(Clone, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names are the meaning")]
pub enum Ranged {
    /// A word of the program.
    Word(Box<str>),
    /// A value of a block, whose word is not known.
    Unnamed,
    /// A value beyond all that a word can hold; rounded towards zero, in the unit of the word.
    TooLarge {
        about: i64,
    },
    Turns,
    Holes,
    PeckDepth,
    LengthSum,
    /// An angle within one turn.
    TurnAngle,
    HighestSpeed,
    PointNumber,
    StoredPosition,
    SkipLevel,
}

impl From<&str> for Ranged {
    fn from(word: &str) -> Ranged {
        Ranged::Word(word.into())
    }
}

impl From<String> for Ranged {
    fn from(word: String) -> Ranged {
        Ranged::Word(word.into())
    }
}

impl From<Box<str>> for Ranged {
    fn from(word: Box<str>) -> Ranged {
        Ranged::Word(word)
    }
}
