//! Signs that speak for or against a dialect: `messages/guess` has their words.

use crate::render::messages::message::{Message, Part};
use crate::render::text::visible;

/// A sign in a text for or against a dialect.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Sign {
    TextForm,
    OtherForm,
    CanonicalCalls,
    NoCall,
    Mark,
    MarkAfter,
    NoMark,
    NoSkip,
    FlowWords,
    NamedVariable,
    NoVariable,
    Foreign(char),
    Letters,
    WordsAfter(String),
    CentreWords,
    NumberedMain(char),
    NoNumber(char),
    LetterIsZero,
    WithoutNumber(char),
    InBlock(String),
    UnknownCode(String),
    OtherMachine(String),
    UnitCode(String),
    Code(String),
    NoAddress(char),
    LengthWord(String),
    ProgramNumber(char),
    Digits(String, usize),
    Comment(String),
    CommentText,
    Header,
    OwnWord(String),
    ForeignWord(String),
    SetsValue(String),
}

/// An entry about the dialect of a text.
pub(super) fn guessed(form: &'static str) -> Message {
    Message::part(Part::Guess, form)
}

impl Sign {
    /// In words.
    pub(super) fn words(&self) -> String {
        let message = match self {
            Sign::TextForm => guessed("text-form"),
            Sign::OtherForm => guessed("other-form"),
            Sign::CanonicalCalls => guessed("canonical-calls"),
            Sign::NoCall => guessed("no-call"),
            Sign::Mark => guessed("mark"),
            Sign::MarkAfter => guessed("mark-after"),
            Sign::NoMark => guessed("no-mark"),
            Sign::NoSkip => guessed("no-skip"),
            Sign::FlowWords => guessed("flow-words"),
            Sign::NamedVariable => guessed("named-variable"),
            Sign::NoVariable => guessed("no-variable"),
            Sign::Foreign(sign) => guessed("foreign").text("sign", visible(*sign).to_string()),
            Sign::Letters => guessed("letters"),
            Sign::WordsAfter(word) => guessed("words-after").text("word", word),
            Sign::CentreWords => guessed("centre-words"),
            Sign::NumberedMain(letter) => guessed("numbered-main").text("letter", *letter),
            Sign::NoNumber(letter) => guessed("no-number").text("letter", *letter),
            Sign::LetterIsZero => guessed("letter-is-zero"),
            Sign::WithoutNumber(letter) => guessed("without-number").text("letter", *letter),
            Sign::InBlock(word) => guessed("in-block").text("word", word),
            Sign::UnknownCode(word) => guessed("unknown-code").text("word", word),
            Sign::OtherMachine(word) => guessed("other-machine").text("word", word),
            Sign::UnitCode(word) => guessed("unit-code").text("word", word),
            Sign::Code(word) => guessed("code").text("word", word),
            Sign::NoAddress(letter) => guessed("no-address").text("letter", *letter),
            Sign::LengthWord(word) => guessed("length-word").text("word", word),
            Sign::ProgramNumber(letter) => guessed("program-number").text("letter", *letter),
            Sign::Digits(word, digits) => {
                guessed("digits").text("word", word).text("digits", digits.to_string())
            }
            Sign::Comment(sign) => guessed("comment").text("sign", sign),
            Sign::CommentText => guessed("comment-text"),
            Sign::Header => guessed("header"),
            Sign::OwnWord(word) => guessed("own-word").text("word", word),
            Sign::ForeignWord(word) => guessed("foreign-word").text("word", word),
            Sign::SetsValue(word) => guessed("sets-value").text("word", word),
        };
        message.headline()
    }
}
