//! Comments that show text with values of parameters in it, and that end a program with an alarm (LinuxCNC 2.9,
//! gcode/overview.html, comment parameters).

use ncc_ir::diag::Fault;
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Expr, Node, Var};
use ncc_ir::program::{Op, Piece};
use ncc_ir::source::Span;

use crate::batch::Batch;
use crate::common::text::decode;
use crate::word::lower::Lower;

/// Digits after the point where nothing is stated, and after `%f`.
const DIGITS: u8 = 6;
const FLOAT_DIGITS: u8 = 4;

impl Lower {
    /// A message with values in it. `at` is its comment.
    pub(in crate::word) fn operator_text(&mut self, text: &[u8], at: Span, out: &mut Batch) {
        let (mut pieces, mut plain): (Vec<Piece>, Vec<u8>) = (Vec::new(), Vec::new());
        let (mut rest, mut digits) = (text, DIGITS);
        while let Some(&byte) = rest.first() {
            if let Some((said, len)) = format_of(rest) {
                (digits, rest) = (said, &rest[len..]);
                continue;
            }
            let Some((name, len)) = parameter(rest) else {
                plain.push(byte);
                rest = &rest[1..];
                continue;
            };
            rest = &rest[len..];
            if !plain.is_empty() {
                pieces.push(Piece::Text(untrimmed_text(&std::mem::take(&mut plain))));
            }
            let mut value = Expr::Node(Box::new(Node::Var(Var::System(System::Other(name.into())))));
            self.parameters(&mut value, at, out);
            pieces.push(Piece::Value { value, digits, short: false, places: 0 });
        }
        let end = decode(&plain);
        if !end.is_empty() {
            pieces.push(Piece::Text(end));
        }
        out.whole = true;
        self.push(at, Op::MessageOf(pieces.into()), out);
    }

    /// An alarm with this text.
    pub(in crate::word) fn alarm(&mut self, text: &[u8], at: Span, out: &mut Batch) {
        let mut plain = Vec::new();
        let mut rest = text;
        while let Some(&byte) = rest.first() {
            if let Some((_, len)) = format_of(rest) {
                rest = &rest[len..];
            } else if let Some((_, len)) = parameter(rest) {
                plain.extend_from_slice(b"...");
                rest = &rest[len..];
            } else {
                plain.push(byte);
                rest = &rest[1..];
            }
        }
        if text.contains(&b'#') {
            out.report(Fault::AlarmValues, at);
        }
        let alarm = ncc_ir::program::Alarm { number: None, text: decode(&plain) };
        self.push(at, Op::Alarm(Box::new(alarm)), out);
    }
}

/// Text within a message: blanks at its end count.
fn untrimmed_text(bytes: &[u8]) -> ncc_ir::program::Text {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.into(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect::<String>().into(),
    }
}

/// How values are written from here on, and how long the word is that says so.
fn format_of(text: &[u8]) -> Option<(u8, usize)> {
    match text {
        [b'%', b'd', ..] => Some((0, 2)),
        [b'%', b'f', ..] => Some((FLOAT_DIGITS, 2)),
        [b'%', b'l', b'f', ..] => Some((DIGITS, 3)),
        [b'%', b'.', digit @ b'0'..=b'9', b'f', ..] => Some((digit - b'0', 4)),
        _ => None,
    }
}

/// A parameter in a text, and how long it is: `#31`, `#<name>`.
fn parameter(text: &[u8]) -> Option<(String, usize)> {
    let rest = text.strip_prefix(b"#")?;
    if rest.first() == Some(&b'<') {
        let len = memchr::memchr(b'>', rest)?;
        let name: String = rest[..=len]
            .iter()
            .filter(|b| !b.is_ascii_whitespace())
            .map(|b| char::from(b.to_ascii_lowercase()))
            .collect();
        return Some((format!("#{name}"), len + 2));
    }
    let len = rest.iter().take_while(|b| b.is_ascii_digit()).count();
    (1..=9).contains(&len).then(|| (String::from_utf8_lossy(&text[..=len]).into_owned(), len + 1))
}
