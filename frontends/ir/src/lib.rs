//! Parser of one line of the `ir` text, the text form of the neutral program.
//!
//! ```text
//! STRAIGHT_FEED(X 10.mm) & HOLE()    Line::Stmts with two statements
//! while local:i < 3 {                Line::Stmts whose statement opens a body
//! ```
//!
//! LALRPOP makes 3 MB of Rust of this grammar. In a crate of their own these tables are compiled once, and only when the text
//! form changes. Not here: how lines nest, and all that a reader keeps from line to line.

mod lexer;
mod line;
mod quoted;
mod scan;
mod word;

use lalrpop_util::ParseError;
use logos::Logos;
use ncc_ir::diag::Fault;
use ncc_ir::syntax::{Expected, Found};

use lexer::Token;
pub use line::Line;
use line::Refusal;
pub use quoted::unquote;
use word::LexFault;

lalrpop_util::lalrpop_mod!(
    #[allow(clippy::all, clippy::pedantic, missing_docs, unreachable_pub, unused, private_interfaces)]
    grammar,
    "/grammar.rs"
);

/// Most words on a line: an expression is at most that deep.
const WORDS: usize = 1000;

/// Parses one line without its line end. The spans of its statements count from its first byte.
///
/// # Errors
///
/// The fault, and the span of its text in the line.
pub fn parse(text: &str) -> Result<Line, (Fault, usize, usize)> {
    let words = Token::lexer(text).spanned().enumerate().map(|(count, (token, place))| match token {
        _ if count >= WORDS => Err(Refusal::TooLong),
        Ok(token) => Ok((place.start, token, place.end)),
        Err(fault) => Err(Refusal::Word(place.start, place.end, fault)),
    });
    grammar::LineParser::new().parse(words).map_err(|e| explain(e, text))
}

/// The fault of a line that could not be parsed, with its place in the line.
fn explain(error: ParseError<usize, Token, Refusal>, text: &str) -> (Fault, usize, usize) {
    match error {
        ParseError::UnrecognizedToken { token: (l, Token::UnknownName, r), .. }
        | ParseError::ExtraToken { token: (l, Token::UnknownName, r) } => {
            (Fault::UnknownCode { code: text[l..r].into() }, l, r)
        }
        ParseError::UnrecognizedToken { token: (l, _, r), expected } => {
            (Fault::Syntax { found: text[l..r].into(), expected: list(&expected) }, l, r)
        }
        ParseError::ExtraToken { token: (l, _, r) } => {
            (Fault::Syntax { found: text[l..r].into(), expected: Expected::EndOfLine }, l, r)
        }
        ParseError::UnrecognizedEof { expected, .. } => {
            let end = text.trim_end().len();
            (Fault::Syntax { found: Found::EndOfLine, expected: list(&expected) }, end, end)
        }
        ParseError::InvalidToken { location } => word(text, location, location, LexFault::Character),
        ParseError::User { error: Refusal::Word(l, r, fault) } => word(text, l, r, fault),
        ParseError::User { error: Refusal::Meaning(l, r, fault) } => (fault, l, r),
        ParseError::User { error: Refusal::TooLong } => {
            let expected = Expected::Words { most: WORDS };
            (Fault::Syntax { found: Found::ManyWords, expected }, 0, text.len())
        }
    }
}

/// The fault of a stretch of text that is no word.
fn word(text: &str, l: usize, r: usize, fault: LexFault) -> (Fault, usize, usize) {
    match fault {
        LexFault::Number => (Fault::BadNumber { text: text[l..r].into() }, l, r),
        LexFault::Escape => {
            (Fault::Syntax { found: text[l..r].into(), expected: Expected::PlainEscapes }, l, r)
        }
        LexFault::Character => match text[l..].chars().next() {
            Some('"') => (Fault::UnclosedComment, l, text.len()),
            Some(found) => (Fault::UnexpectedCharacter { found }, l, l + found.len_utf8()),
            None => (Fault::NotText, l, r),
        },
    }
}

/// Expected words as the text of a message; a long list is cut.
fn list(expected: &[String]) -> Expected {
    const SHOWN: usize = 6;
    let mut text = String::new();
    for (place, name) in expected.iter().take(SHOWN).enumerate() {
        let name = name.trim_matches('"');
        let quote = if name.contains(' ') { "" } else { "`" };
        let comma = if place > 0 { ", " } else { "" };
        text.extend([comma, quote, name, quote]);
    }
    if expected.len() > SHOWN {
        text.push_str(", …");
    }
    Expected::Text(text.into())
}
