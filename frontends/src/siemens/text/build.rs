//! What the grammar's actions build, and the refusals that its tables cannot see.
//!
//! Not here: the grammar, and the meaning of what is built.

use lalrpop_util::ParseError;
use ncc_ir::diag::Fault;
use ncc_ir::source::Span;
use ncc_ir::syntax::{Expected, Found};

use super::token::{Refusal, Token};
use super::tree::*;
use crate::common::words::{Digits, Value as Number, Word};

type Parsed<T> = Result<T, ParseError<u32, Token, Refusal>>;

fn refuse<T>(fault: Fault, span: Span) -> Parsed<T> {
    Err(ParseError::User { error: Refusal { fault, span } })
}

fn syntax<T>(found: impl Into<Found>, expected: impl Into<Expected>, span: Span) -> Parsed<T> {
    refuse(Fault::Syntax { found: found.into(), expected: expected.into() }, span)
}

/// A letter with a constant.
pub(crate) fn word(letter: u8, digits: Digits, negative: bool, l: u32, r: u32) -> Item {
    let mantissa = if negative { -digits.mantissa } else { digits.mantissa };
    let value = Number::Number(Digits { mantissa, ..digits });
    Item::Word(Word { letter, value, span: Span::new(l, r) })
}

/// A whole number without a point.
pub(crate) fn whole_number(digits: Digits, l: u32, r: u32) -> Parsed<u32> {
    let span = Span::new(l, r);
    if digits.point {
        return refuse(Fault::PointNotAllowed { word: spelt(digits) }, span);
    }
    match u32::try_from(digits.mantissa) {
        Ok(whole) => Ok(whole),
        Err(_) => refuse(Fault::OutOfRange { word: spelt(digits).into() }, span),
    }
}

/// The digits of a number that is refused.
fn spelt(digits: Digits) -> Box<str> {
    let scale = usize::from(digits.scale);
    let text = format!("{:0width$}", digits.mantissa, width = scale + 1);
    let (whole, part) = text.split_at(text.len() - scale);
    format!("{whole}{}{part}", if digits.point { "." } else { "" }).into()
}

pub(crate) fn block_number(digits: Digits, main: bool, l: u32, r: u32) -> Parsed<BlockNumber> {
    Ok(BlockNumber { value: whole_number(digits, l, r)?, main, span: Span::new(l, r) })
}

pub(crate) fn place(
    address: Address,
    extension: Option<u32>,
    index: Vec<Option<Expr>>,
    l: u32,
    r: u32,
) -> Place {
    Place { address, extension, index, span: Span::new(l, r) }
}

/// Places between commas; nothing at all is no place.
pub(crate) fn list(places: Vec<Option<Expr>>) -> Vec<Option<Expr>> {
    match *places {
        [None] => Vec::new(),
        _ => places,
    }
}

/// A label or a constant by its name.
pub(crate) fn named(name: Span) -> Expr {
    Expr::Place(place(Address::Name(name), None, Vec::new(), name.start, name.end))
}

/// A sign directly before a number belongs to it.
pub(crate) fn negate(operand: Expr, l: u32, r: u32) -> Expr {
    let span = Span::new(l, r);
    match operand {
        Expr::Number(digits, _) => Expr::Number(Digits { mantissa: -digits.mantissa, ..digits }, span),
        other => Expr::Unary(Unary::Negate, Box::new(other), span),
    }
}

pub(crate) fn binary(operator: Binary, a: Expr, b: Expr) -> Expr {
    Expr::Binary(operator, Box::new((a, b)))
}

/// The count of a repetition, `P=3`.
pub(crate) fn count(letter: u8, count: Expr, l: u32, r: u32) -> Parsed<Expr> {
    match letter {
        b'P' => Ok(count),
        _ => syntax(char::from(letter).to_string().as_str(), "P", Span::new(l, r)),
    }
}

pub(crate) fn conditional(condition: Expr, jump: Jump, l: u32) -> Jump {
    Jump { condition: Some(condition), span: Span::new(l, jump.span.end), ..jump }
}

/// A call by a text; it cannot hand over arguments.
pub(crate) fn call(file: Expr, section: Option<(Target, Target)>) -> Parsed<Statement> {
    match file {
        Expr::Call { name, span, .. } => syntax("(", Expected::EndOfBlock, Span::new(name.end, span.end)),
        file => Ok(Statement::Call { file: Some(file), section }),
    }
}

pub(crate) fn call_by_path(path: Span, arguments: Option<Vec<Option<Expr>>>) -> Parsed<Statement> {
    match path.start == path.end {
        true => syntax(Found::EndOfBlock, Expected::Path, path),
        false => Ok(Statement::CallByPath { path, arguments: arguments.unwrap_or_default() }),
    }
}
