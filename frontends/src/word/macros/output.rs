//! Text for the device that the control has for it: `POPEN`, `DPRNT[X#1[53]*Y#2[53]]`, `PCLOS` (96-8000 Rev AC,
//! macros, formatted output; NCT 2000M, page 193; 8520-GUM, chapter 20: a letter of A to Z, a digit or one of `+ - / *`
//! stands for itself, but `*` for a blank; behind a variable, in brackets, how many places its value has before the
//! point and behind it, which is rounded).
//!
//! Not here: `BPRNT`, which writes values as bits (refused by name).

use ncc_dialects::Statement as Says;
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Expr, Node};
use ncc_ir::program::{Op, Output, Piece};
use ncc_ir::source::Span;

use super::formula::Formula;
use crate::Batch;
use crate::common::Source;
use crate::common::words::Digits;
use crate::word::lower::Lower;
use crate::word::o_code::parameters::Index;

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

fn line(mut text: &[u8]) -> Option<Vec<Piece>> {
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

impl Lower {
    /// Text for a device, with its values.
    pub(in crate::word) fn output(
        &mut self,
        output: Option<&Output>,
        span: Span,
        src: Source,
        out: &mut Batch,
    ) {
        let Some(mut output) = output.cloned() else { return self.leave_output_out(span, src, out) };
        let rules = &self.settings.dialect.formula;
        let (known, most) = (rules.statements.contains(&Says::Output), rules.output_digits);
        let mut fits = known;
        let before = (out.diagnostics.len(), self.now.failed);
        if let Output::Line(pieces) = &mut output {
            for piece in pieces {
                if let Piece::Value { value, digits, places, .. } = piece {
                    fits &= *digits + *places <= most;
                    *value = self.value(value, span, out);
                }
            }
        }
        if known && self.now.failed && !before.1 {
            // A value of the control that has no meaning here: of the text alone, which does not matter to the cut.
            out.diagnostics.truncate(before.0);
            self.now.failed = before.1;
            return self.leave_output_out(span, src, out);
        }
        if !fits {
            let name =
                if known { "value of more digits than the control writes" } else { "text for a device" };
            let fault = Fault::NotSupported { code: src.text(span), name: name.into() };
            return self.fault(fault, span, out);
        }
        // What is in force may be asked.
        self.leave_motion(None, out);
        self.push(span, Op::Output(Box::new(output)), out);
    }

    /// Text for a device that no target is given: a comment of its words stays.
    fn leave_output_out(&mut self, span: Span, src: Source, out: &mut Batch) {
        let known = self.settings.dialect.formula.statements.contains(&Says::Output);
        if !known {
            let fault = Fault::NotSupported { code: src.text(span), name: "text for a device".into() };
            return self.fault(fault, span, out);
        }
        out.report(Fault::OutputDropped, span);
        let plain = |sign: char| if "()[]".contains(sign) { ' ' } else { sign };
        let all = src.bytes(span);
        let begins = all.iter().position(|b| b.eq_ignore_ascii_case(&b'D')).unwrap_or(0);
        let own = &all[begins..begins + length(&all[begins..]).unwrap_or(all.len() - begins)];
        let text: String = String::from_utf8_lossy(own).chars().map(plain).collect();
        self.push(span, Op::Comment(text.trim().into()), out);
    }
}
