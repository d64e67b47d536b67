//! From a line to the tree of its block, by the grammar (`block.lalrpop`).
//!
//! Not here: what well-formed blocks mean.

use super::token::{Refusal, Token, Tokens};
use super::tree::Block;
use super::unit;
use super::unit::{Kind, Line};
use lalrpop_util::ParseError;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::source::Span;
use ncc_ir::syntax::{Expected, Found};

lalrpop_util::lalrpop_mod!(
    #[allow(clippy::all, clippy::pedantic, missing_docs, unreachable_pub, unused)]
    grammar,
    "/siemens/text/block.rs"
);

/// The faults of form of a whole text: lines that are neither blocks nor frames of units. Units that
/// are no programs are passed over. What well-formed blocks mean is not looked at.
pub fn form(text: &[u8]) -> Vec<Diagnostic> {
    let mut faults = Vec::new();
    let (mut at, mut kind) = (0, Kind::Main);
    for line in text.split_inclusive(|b| *b == b'\n') {
        let base = at;
        at += line.len() as u32;
        let line = line.strip_suffix(b"\n").unwrap_or(line);
        let line = line.strip_suffix(b"\r").unwrap_or(line);
        let fault = match unit::line(line, base) {
            Ok(Line::Header(header)) => {
                kind = header.kind;
                None
            }
            Ok(Line::Path(_) | Line::Mark) => None,
            Ok(Line::Block) if kind == Kind::Other => None,
            Ok(Line::Block) => parse(line, base).err(),
            Err(fault) => Some(fault),
        };
        faults.extend(fault.map(|(fault, span)| Diagnostic::new(fault, span)));
    }
    faults
}

/// Parses a line without its end; `base` is the place of its first byte in the source.
pub(crate) fn parse(line: &[u8], base: u32) -> Result<Block, (Fault, Span)> {
    let mut tokens = Tokens::new(line, base);
    let mut ends: Option<Span> = None;
    let seen = tokens.by_ref().inspect(|token| {
        if let Ok((l, _, r)) = token {
            ends = Some(Span::new(ends.map_or(*l, |e| e.start), *r));
        }
    });
    let parsed = grammar::BlockParser::new().parse(seen);
    let comment = tokens.comment;
    let end = comment.map_or(base + line.len() as u32, |c| c.start.saturating_sub(1));
    match parsed {
        Ok(block) => Ok(Block { comment, span: ends.unwrap_or(Span::new(end, end)), ..block }),
        Err(error) => Err(explain(error, line, base, ends)),
    }
}

fn explain(
    error: ParseError<u32, Token, Refusal>,
    line: &[u8],
    base: u32,
    ends: Option<Span>,
) -> (Fault, Span) {
    let syntax = |span: Span, expected: &[String]| {
        let at = |place: u32| (place - base) as usize;
        let found = match line.get(at(span.start)..at(span.end)) {
            Some(text) if !text.is_empty() => Found::Text(String::from_utf8_lossy(text).into()),
            _ => Found::EndOfBlock,
        };
        (Fault::Syntax { found, expected: wanted(expected) }, span)
    };
    match error {
        ParseError::User { error } => (error.fault, error.span),
        ParseError::InvalidToken { location } => syntax(Span::new(location, location), &[]),
        ParseError::UnrecognizedEof { expected, .. } => {
            let end = ends.map_or(base, |e| e.end);
            syntax(Span::new(end, end), &expected)
        }
        ParseError::UnrecognizedToken { token: (l, _, r), expected } => syntax(Span::new(l, r), &expected),
        ParseError::ExtraToken { token: (l, _, r) } => syntax(Span::new(l, r), &[]),
    }
}

/// What could have stood there, in the trade's words.
fn wanted(expected: &[String]) -> Expected {
    let has = |name: &str| expected.iter().any(|e| e.trim_matches('"') == name);
    let sign = |text: &str| Expected::from(text);
    let forms = [
        ("skip", Expected::Block),
        ("call", Expected::Statement),
        (")", sign(")")),
        ("]", sign("]")),
        ("to", sign("TO")),
        ("of", sign("OF")),
        ("not", Expected::Expression),
        ("system", Expected::Word),
        ("goto", Expected::Jump),
        ("type", Expected::Type),
        ("number", Expected::Number),
        ("name", Expected::Name),
        ("letter", sign("P")),
        ("=", sign("=")),
        ("as", sign("AS")),
        ("*", Expected::OperatorOrEnd),
        ("(", sign("(")),
    ];
    forms.into_iter().find(|(name, _)| has(name)).map_or(Expected::EndOfBlock, |(_, form)| form)
}
