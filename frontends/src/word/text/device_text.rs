//! Text for a device as a block writes it: `DPRNT[X#1[53]]`.
//!
//! Not here: what it does (`macros::output`).

use ncc_ir::expr::{Expr, Node};
use ncc_ir::program::{Output, Piece};

use crate::common::words::Digits;
use crate::word::macros::formula::{Formula, Index};

/// How long such a statement is, that begins a text.
pub(in crate::word) fn length(text: &[u8]) -> Option<usize> {
    let word = text.get(..5)?.to_ascii_uppercase();
    match &*word {
        b"POPEN" | b"PCLOS" => Some(5),
        b"DPRNT" => {
            let mut depth = 0_u32;
            let end = text.iter().skip(5).position(|byte| {
                depth += u32::from(*byte == b'[');
                depth = depth.saturating_sub(u32::from(*byte == b']'));
                depth == 0 && !byte.is_ascii_whitespace()
            })?;
            (text[5 + end] == b']').then_some(5 + end + 1)
        }
        _ => None,
    }
}

/// What such a statement says, if that is known.
pub(in crate::word) fn read(text: &[u8]) -> Option<Output> {
    match &*text.get(..5)?.to_ascii_uppercase() {
        b"POPEN" => Some(Output::Open),
        b"PCLOS" => Some(Output::Close),
        b"DPRNT" => {
            let inner = text[5..].trim_ascii().strip_prefix(b"[")?.strip_suffix(b"]")?;
            line(inner).map(|pieces| Output::Line(pieces.into()))
        }
        _ => None,
    }
}

/// As [`read`]; a line of another form is none (`None` within), and is left out.
pub(in crate::word) fn taken(text: &[u8]) -> Option<Option<Output>> {
    let writes = text.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"DPRNT"));
    let read = read(text);
    (writes || read.is_some()).then_some(read)
}

pub(in crate::word) fn line(mut text: &[u8]) -> Option<Vec<Piece>> {
    let (mut pieces, mut plain) = (Vec::new(), String::new());
    while let Some((&byte, rest)) = text.split_first() {
        text = rest;
        match byte {
            b'#' => {
                let digits = text.iter().take_while(|byte| byte.is_ascii_digit()).count();
                let value = Formula::variable(Index::Number(Digits::parse(&text[..digits])?))?.expr;
                let is_variable = matches!(&value, Expr::Node(node) if matches!(**node, Node::Var(_)));
                let [b'[', places @ b'0'..=b'9', digits @ b'0'..=b'9', b']', rest @ ..] = &text[digits..]
                else {
                    return None;
                };
                text = rest;
                let (places, digits) = (places - b'0', digits - b'0');
                if !is_variable || places + digits == 0 {
                    return None;
                }
                if !plain.is_empty() {
                    pieces.push(Piece::Text(std::mem::take(&mut plain).into()));
                }
                pieces.push(Piece::Value { value, digits, short: false, places });
            }
            b'*' => plain.push(' '),
            b'A'..=b'Z' | b'0'..=b'9' | b'+' | b'-' | b'/' => plain.push(char::from(byte)),
            b'a'..=b'z' => plain.push(char::from(byte.to_ascii_uppercase())),
            // A blank between words of a block says nothing.
            b' ' => {}
            _ => return None,
        }
    }
    if !plain.is_empty() {
        pieces.push(Piece::Text(plain.into()));
    }
    Some(pieces)
}
