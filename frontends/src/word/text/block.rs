//! A block as its text shows it: words with exact numbers, before any meaning.
//!
//! The grammar (`block.lalrpop`) and the recogniser of plain blocks (`plain`) both fill a
//! [`Block`], whose memory is used again. Not here: what the words mean.

use lalrpop_util::{ParseError, lalrpop_mod};
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Expr, Node, Unary};
use ncc_ir::source::Span;
use ncc_ir::syntax::{Expected, Found};
use ncc_ir::unsupported::{CodeUnsupported, FlowUnsupported, TextUnsupported, Unsupported};

use super::device_text;
use super::token::{FlowWord, Refusal, Signs, Token, Tokens};
use crate::common::words::{Digits, Value, Word};
use crate::word::macros::formula;
use crate::word::macros::formula::{Formula, Index, Piece, Statement};
use crate::word::o_code::o_formula::constant;
use crate::word::o_code::statements::{Decision, Setting};

lalrpop_mod!(
    #[allow(clippy::all, clippy::pedantic, missing_docs, unreachable_pub, unused)]
    grammar,
    "/word/text/block.rs"
);

lalrpop_mod!(
    #[allow(clippy::all, clippy::pedantic, missing_docs, unreachable_pub, unused)]
    o_grammar,
    "/word/o_code/o_block.rs"
);

/// A block.
#[derive(Debug, Default)]
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
    /// What words have that are computed.
    pub(crate) exprs: Vec<Expr>,
    /// Its statement of the macro language.
    pub(crate) statement: Option<Statement>,
    /// Parameters that it sets, of a control with O words.
    pub(crate) settings: Vec<Setting>,
    /// What it decides, of such a control.
    pub(crate) decision: Option<Box<Decision>>,
    /// The name of the program that begins with it.
    pub(crate) title: Option<Span>,
    /// What is refused already by its form.
    pub(crate) faults: Vec<(Fault, Span)>,
    /// Comments as the lexer leaves them.
    aside: Vec<(usize, usize)>,
}

impl Block {
    /// Whether there is nothing in it.
    pub(in crate::word) fn is_empty(&self) -> bool {
        self.words.is_empty()
            && self.skip == 0
            && self.comments.is_empty()
            && self.names.is_empty()
            && self.faults.is_empty()
            && self.statement.is_none()
            && self.settings.is_empty()
            && self.decision.is_none()
            && self.title.is_none()
    }

    /// Whether it says nothing to the control but comments and names.
    pub(in crate::word) fn is_comment(&self) -> bool {
        self.words.is_empty()
            && self.skip == 0
            && self.faults.is_empty()
            && self.statement.is_none()
            && self.settings.is_empty()
            && self.decision.is_none()
    }

    /// The block where the switch is stated: on, nothing is left of what is under block skip but comments; off, all of it.
    pub(in crate::word) fn with_switch(&mut self, on: bool) {
        self.skip = 0;
        let tail = self.tail.take();
        if !on {
            return;
        }
        self.words.truncate(tail.unwrap_or(0));
        if tail.is_none() {
            self.names.clear();
            self.statement = None;
            self.settings.clear();
            self.decision = None;
        }
    }

    pub(in crate::word) fn clear(&mut self) {
        self.words.clear();
        self.skip = 0;
        self.tail = None;
        self.comments.clear();
        self.names.clear();
        self.exprs.clear();
        self.statement = None;
        self.settings.clear();
        self.decision = None;
        self.title = None;
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
    /// Whether the macro language is read.
    computes: bool,
    /// Whether that of O words is.
    o_words: bool,
    /// What is refused within a word or a statement.
    refused: Vec<(usize, usize)>,
    /// Statements and parts of them, and where they stand.
    pieces: Vec<Piece>,
    stand: (usize, usize),
}

/// What a word's value is to the grammar.
#[derive(Clone, Debug)]
pub(crate) enum Read {
    Number(Digits, bool),
    /// A variable or an expression, and whether a minus stands before it.
    Computed(Formula, bool),
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
            Some(Read::Computed(formula, false)) if self.whole_number(letter, &formula).is_some() => {
                let mantissa = self.whole_number(letter, &formula).unwrap_or(0);
                Value::Number(Digits { mantissa, scale: 0, point: false })
            }
            Some(Read::Computed(formula, negative)) => match self.computed(start, end, formula, negative) {
                Some(value) => value,
                None => return,
            },
            Some(Read::Name) => {
                let code = self.text(start, end);
                return self.fault(
                    Fault::NotSupported { code, what: TextUnsupported::ProgramName.into() },
                    start,
                    end,
                );
            }
        };
        let span = self.span(start, end);
        self.block.words.push(Word { letter, value, span });
    }

    /// The whole number that an expression is worth which nothing changes, of a letter that is no coordinate.
    fn whole_number(&self, letter: u8, formula: &Formula) -> Option<i64> {
        let counts = self.o_words && self.refused.is_empty() && !b"XYZABCIJKRFSQ".contains(&letter);
        let worth = constant(&formula.expr).filter(|_| counts)?;
        (worth == worth.trunc() && (0.0..1e9).contains(&worth)).then_some(worth as i64)
    }

    /// A program's name.
    pub(crate) fn name(&mut self, start: usize, end: usize) {
        let span = self.span(start, end);
        self.block.names.push(span);
    }

    /// A word after a comma: its letter is kept as a small one.
    pub(crate) fn comma_word(&mut self, start: usize, end: usize, letter: u8, read: Read) {
        self.word(start, end, letter.to_ascii_lowercase(), Some(read));
    }

    /// A word's value; `None` is refused.
    fn computed(&mut self, start: usize, end: usize, formula: Formula, negative: bool) -> Option<Value> {
        if formula.condition {
            self.refused.push((start, end));
        }
        let place = u16::try_from(self.block.exprs.len()).ok()?;
        if self.settle(start, end) {
            return None;
        }
        self.block.exprs.push(match negative {
            true => Expr::Node(Box::new(Node::Unary(Unary::Negate, formula.expr))),
            false => formula.expr,
        });
        Some(Value::Computed(place))
    }

    /// An expression; one that has no meaning, or none that is known, is refused with what it is part of.
    pub(crate) fn made(&mut self, start: usize, end: usize, formula: Option<Formula>) -> Formula {
        formula.unwrap_or_else(|| {
            self.refused.push((start, end));
            Formula::nothing()
        })
    }

    /// A statement, or a part of one; `None` is refused.
    pub(crate) fn piece(&mut self, start: usize, end: usize, piece: Option<Piece>) {
        if piece.is_none() {
            self.refused.push((start, end));
        }
        if self.pieces.is_empty() {
            self.stand.0 = start;
        }
        self.stand.1 = end;
        self.settle(start, end);
        self.pieces.push(piece.unwrap_or(Piece::Refused));
    }

    /// Text for a device; other words of the kind are refused.
    pub(crate) fn output(&mut self, start: usize, end: usize) {
        self.piece(start, end, device_text::taken(&self.line[start..end]).map(Piece::Output));
    }

    /// A condition, and what depends on it.
    pub(crate) fn condition(&mut self, start: usize, end: usize, of: Formula, piece: fn(Expr) -> Piece) {
        let found = (of.condition || !self.refused.is_empty()).then(|| piece(of.expr));
        self.piece(start, end, found);
    }

    /// An assignment; what is no variable, or nothing, takes no value.
    pub(crate) fn assign(&mut self, start: usize, end: usize, to: Index, value: Formula) {
        let to = Formula::target(to).filter(|_| !value.condition);
        self.piece(start, end, to.map(|to| Piece::Assign(to, value.expr)));
    }

    /// What stands within the brackets of a name: blanks and the size of letters say nothing.
    pub(crate) fn spelled(&self, start: usize, end: usize) -> Box<str> {
        let inner = &self.line[start + 1..end - 1];
        let letters = inner.iter().filter(|b| !b.is_ascii_whitespace()).map(u8::to_ascii_lowercase);
        letters.map(char::from).collect::<String>().into()
    }

    /// The value of a parameter.
    pub(crate) fn parameter(&mut self, start: usize, end: usize, of: Index) -> Formula {
        self.made(start, end, Formula::parameter(of))
    }

    /// A setting of a parameter.
    pub(crate) fn setting(&mut self, start: usize, end: usize, to: Index, value: Formula) {
        let to = self.parameter(start, end, to);
        if !self.settle(start, end) {
            let span = self.span(start, end);
            self.block.settings.push(Setting { to: to.expr, value: value.expr, span });
        }
    }

    /// The number or name of a program.
    pub(crate) fn program(&mut self, start: usize, end: usize, of: Index) {
        let span = self.span(start, end);
        match of {
            Index::Number(digits) => {
                self.block.words.push(Word { letter: b'O', value: Value::Number(digits), span });
            }
            Index::Name(_) => self.block.title = Some(span),
            Index::Computed(_) => self.macro_language(start, end),
        }
    }

    /// A block that decides.
    pub(crate) fn flow(&mut self, start: usize, end: usize, label: Index, word: FlowWord, of: Vec<Formula>) {
        if self.settle(start, end) {
            return;
        }
        if self.block.decision.is_some() {
            return self.macro_language(start, end);
        }
        let values = of.into_iter().map(|formula| formula.expr).collect();
        self.block.decision = Some(Box::new(Decision { label, word, values }));
    }

    /// Reports what is refused of a word or a statement; `true` if anything is.
    fn settle(&mut self, start: usize, end: usize) -> bool {
        if !self.computes {
            self.refused.clear();
            self.macro_language(start, end);
            return true;
        }
        let mut refused = std::mem::take(&mut self.refused);
        // What is refused because of its part is reported with the part.
        let parts = refused.clone();
        refused.retain(|whole| {
            !parts.iter().any(|part| part != whole && part.0 >= whole.0 && part.1 <= whole.1)
        });
        refused.dedup();
        for (start, end) in &refused {
            self.macro_language(*start, *end);
        }
        !refused.is_empty()
    }

    /// Makes a statement of the pieces. Beside it, nothing stands in its block but the block's number.
    fn finish(&mut self) {
        let (start, end) = self.stand;
        let pieces = std::mem::take(&mut self.pieces);
        if pieces.is_empty() || !self.computes {
            return;
        }
        let refused = pieces.iter().any(|piece| matches!(piece, Piece::Refused));
        let beside = self.block.words.iter().any(|word| word.letter != self.number);
        self.block.statement = formula::statement(pieces);
        if beside || self.block.statement.is_none() && !refused {
            self.macro_language(start, end);
        }
    }

    /// A part of the macro language: refused, the whole piece as its text.
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
            return self.fault(Fault::OutOfRange { word: word.into() }, start, end);
        };
        if self.block.skip != 0 {
            let code = self.text(start, end);
            let what = CodeUnsupported::SecondSkipLevel.into();
            return self.fault(Fault::NotSupported { code, what }, start, end);
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
pub(in crate::word) fn parse(
    line: &[u8],
    from: usize,
    base: u32,
    signs: Signs,
    block: &mut Block,
) -> Option<usize> {
    let mut comments = std::mem::take(&mut block.aside);
    comments.clear();
    let mut tokens = Tokens::new(line, from, signs, &mut comments);
    let mut sink = Sink {
        block,
        line,
        base,
        number: signs.number,
        computes: signs.computes,
        o_words: signs.o_words,
        refused: Vec::new(),
        pieces: Vec::new(),
        stand: (0, 0),
    };
    let result = match signs.o_words {
        true => o_grammar::BlockParser::new().parse(&mut sink, tokens.by_ref()),
        false => grammar::BlockParser::new().parse(&mut sink, tokens.by_ref()),
    };
    let next = tokens.next_block();
    match result {
        Ok(()) => sink.finish(),
        Err(error) => {
            let (fault, start, end) = refusal(error, line);
            if is_misspelt(&fault) {
                // The label begins no program.
                sink.block.words.retain(|word| word.letter == signs.number);
            }
            sink.fault(fault, start, end);
        }
    }
    let end = next.unwrap_or(line.len());
    block
        .comments
        .extend(comments.iter().map(|&(start, end)| Span::new(base + start as u32, base + end as u32)));
    block.aside = comments;
    block.span = Span::new(base + from as u32, base + end as u32);
    next
}

/// Whether a block has a misspelt O word: it may have opened or closed a structure.
pub(in crate::word) fn is_misspelt(fault: &Fault) -> bool {
    let what = match fault {
        Fault::NotSupported { what: Unsupported::Flow(what), .. } => what,
        _ => return false,
    };
    matches!(what, FlowUnsupported::OWord | FlowUnsupported::OWordNear { .. })
}

fn refusal(error: ParseError<usize, Token, Refusal>, line: &[u8]) -> (Fault, usize, usize) {
    let syntax = |start: usize, end: usize, expected: &[String]| {
        let found = match line.get(start..end) {
            Some(text) if start < end => Found::Text(String::from_utf8_lossy(text).into()),
            _ => Found::EndOfBlock,
        };
        (Fault::Syntax { found, expected: wanted(expected) }, start, end)
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
fn wanted(expected: &[String]) -> Expected {
    let has = |name: &str| expected.iter().any(|e| e.trim_matches('"') == name);
    match (has("letter"), has("number"), has("[")) {
        (true, true, _) => Expected::WordOrNumber,
        (true, false, _) => Expected::Word,
        (false, true, _) => Expected::Number,
        (false, false, true) => "[".into(),
        (false, false, false) if has("]") => "]".into(),
        (false, false, false) if has("=") => "=".into(),
        (false, false, false) => Expected::EndOfBlock,
    }
}
