//! A block as its text shows it: words with exact numbers, before any meaning.
//!
//! The grammar (`block.lalrpop`) and the recogniser of plain blocks (`plain`) both fill a
//! [`Block`], whose memory is used again. Not here: what the words mean.

use lalrpop_util::{ParseError, lalrpop_mod};
use ncc_ir::diag::Fault;
use ncc_ir::source::Span;

use super::token::{Refusal, Signs, Token, Tokens};

lalrpop_mod!(
    #[allow(clippy::all, clippy::pedantic, missing_docs, unreachable_pub, unused)]
    grammar,
    "/word/block.rs"
);

/// An unsigned decimal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Digits {
    /// All the digits.
    pub(crate) mantissa: i64,
    /// Digits after the point.
    pub(crate) scale: u8,
    /// Whether a point was written.
    pub(crate) point: bool,
}

impl Digits {
    /// Digits with at most one point among them; `None` for more than 18 digits that count.
    pub(crate) fn parse(text: &[u8]) -> Option<Digits> {
        let mut digits = Digits { mantissa: 0, scale: 0, point: false };
        for &byte in text {
            if byte == b'.' {
                digits.point = true;
                continue;
            }
            digits.mantissa = digits.mantissa.checked_mul(10)?.checked_add(i64::from(byte - b'0'))?;
            digits.scale += u8::from(digits.point);
            if digits.mantissa > MOST || digits.scale > 18 {
                return None;
            }
        }
        Some(digits)
    }
}

/// Eighteen nines.
pub(super) const MOST: i64 = 999_999_999_999_999_999;

/// What follows a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Value {
    /// Nothing.
    None,
    /// A number, with its sign in the mantissa.
    Number(Digits),
}

/// A word: a letter and what follows it. Its span is in the source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Word {
    /// A capital, `:`, or a small letter where it stands behind a comma.
    pub(crate) letter: u8,
    pub(crate) value: Value,
    pub(crate) span: Span,
}

/// A block.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Block {
    /// Its words in the order of the text.
    pub(crate) words: Vec<Word>,
    /// Its skip level; 0 for none.
    pub(crate) skip: u8,
    /// Index of the first word after a skip mark that stands amid the words.
    pub(crate) tail: Option<usize>,
    /// Texts of its comments.
    pub(crate) comments: Vec<Span>,
    /// All of it, without the line's end.
    pub(crate) span: Span,
    /// Names of programs, in their brackets.
    pub(crate) names: Vec<Span>,
    /// What is refused already by its form.
    pub(crate) faults: Vec<(Fault, Span)>,
    /// Comments as the lexer leaves them.
    aside: Vec<(usize, usize)>,
}

impl Block {
    /// Whether there is nothing in it.
    pub(super) fn is_empty(&self) -> bool {
        self.words.is_empty()
            && self.skip == 0
            && self.comments.is_empty()
            && self.names.is_empty()
            && self.faults.is_empty()
    }

    pub(super) fn clear(&mut self) {
        self.words.clear();
        self.skip = 0;
        self.tail = None;
        self.comments.clear();
        self.names.clear();
        self.faults.clear();
    }
}

/// What the grammar's actions write to.
pub(crate) struct Sink<'s> {
    block: &'s mut Block,
    line: &'s [u8],
    base: u32,
    /// Letter of the block number.
    number: u8,
}

/// What a word's value is to the grammar.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Read {
    Number(Digits, bool),
    /// A variable or an expression.
    Computed,
    /// A program's name.
    Name,
}

impl Sink<'_> {
    fn span(&self, start: usize, end: usize) -> Span {
        Span::new(self.base + start as u32, self.base + end as u32)
    }

    fn text(&self, start: usize, end: usize) -> Box<str> {
        String::from_utf8_lossy(&self.line[start..end]).into()
    }

    fn fault(&mut self, fault: Fault, start: usize, end: usize) {
        let span = self.span(start, end);
        self.block.faults.push((fault, span));
    }

    pub(crate) fn word(&mut self, start: usize, end: usize, letter: u8, read: Option<Read>) {
        let value = match read {
            None => Value::None,
            Some(Read::Number(digits, negative)) => {
                let mantissa = if negative { -digits.mantissa } else { digits.mantissa };
                Value::Number(Digits { mantissa, ..digits })
            }
            Some(Read::Computed) => return self.macro_language(start, end),
            Some(Read::Name) => {
                let code = self.text(start, end);
                return self.fault(
                    Fault::NotSupported { code, name: "program with a name".into() },
                    start,
                    end,
                );
            }
        };
        let span = self.span(start, end);
        self.block.words.push(Word { letter, value, span });
    }

    /// A program's name.
    pub(crate) fn name(&mut self, start: usize, end: usize) {
        let span = self.span(start, end);
        self.block.names.push(span);
    }

    /// A word behind a comma: its letter is kept as a small one.
    pub(crate) fn comma_word(&mut self, start: usize, end: usize, letter: u8, read: Read) {
        self.word(start, end, letter.to_ascii_lowercase(), Some(read));
    }

    /// A part of the macro language: refused by name, the whole piece as its text.
    pub(crate) fn macro_language(&mut self, start: usize, end: usize) {
        let what = self.text(start, end);
        self.fault(Fault::MacroLanguage { what }, start, end);
    }

    pub(crate) fn skip(&mut self, start: usize, end: usize, level: Option<Digits>) {
        let level = match level {
            None => Some(1),
            Some(d) => u8::try_from(d.mantissa).ok().filter(|&l| (1..=9).contains(&l) && !d.point),
        };
        let Some(level) = level else {
            let word = self.text(start, end);
            return self.fault(Fault::OutOfRange { word }, start, end);
        };
        if self.block.skip != 0 {
            let code = self.text(start, end);
            let name = "second skip level in a block".into();
            return self.fault(Fault::NotSupported { code, name }, start, end);
        }
        self.block.skip = level;
        if self.block.words.iter().any(|w| w.letter != self.number) {
            self.block.tail = Some(self.block.words.len());
        }
    }
}

/// Parses the block that begins at `from` of `line` (a line without its end) into `block`, which
/// must be clear. Gives where the next block of the line begins, if there is one; a block that is
/// none leaves a fault in it and ends with its line.
pub(super) fn parse(line: &[u8], from: usize, base: u32, signs: Signs, block: &mut Block) -> Option<usize> {
    let mut comments = std::mem::take(&mut block.aside);
    comments.clear();
    let mut tokens = Tokens::new(line, from, signs, &mut comments);
    let mut sink = Sink { block, line, base, number: signs.number };
    let result = grammar::BlockParser::new().parse(&mut sink, tokens.by_ref());
    let next = tokens.next_block();
    if let Err(error) = result {
        let (fault, start, end) = refusal(error, line);
        sink.fault(fault, start, end);
    }
    let end = next.unwrap_or(line.len());
    block
        .comments
        .extend(comments.iter().map(|&(start, end)| Span::new(base + start as u32, base + end as u32)));
    block.aside = comments;
    block.span = Span::new(base + from as u32, base + end as u32);
    next
}

fn refusal(error: ParseError<usize, Token, Refusal>, line: &[u8]) -> (Fault, usize, usize) {
    let syntax = |start: usize, end: usize, expected: &[String]| {
        let found = match line.get(start..end) {
            Some(text) if start < end => String::from_utf8_lossy(text).into(),
            _ => "end of block".into(),
        };
        (Fault::Syntax { found, expected: wanted(expected).into() }, start, end)
    };
    match error {
        ParseError::User { error } => (error.fault, error.start, error.end),
        ParseError::InvalidToken { location } => syntax(location, location, &[]),
        ParseError::UnrecognizedEof { location, expected } => syntax(location, location, &expected),
        ParseError::UnrecognizedToken { token: (start, _, end), expected } => syntax(start, end, &expected),
        ParseError::ExtraToken { token: (start, _, end) } => syntax(start, end, &[]),
    }
}

/// What could have stood there, in the trade's words.
fn wanted(expected: &[String]) -> &'static str {
    let has = |name: &str| expected.iter().any(|e| e.trim_matches('"') == name);
    match (has("letter"), has("number"), has("[")) {
        (true, true, _) => "a word or a number",
        (true, false, _) => "a word",
        (false, true, _) => "a number",
        (false, false, true) => "[",
        (false, false, false) if has("]") => "]",
        (false, false, false) if has("=") => "=",
        (false, false, false) => "the end of the block",
    }
}
