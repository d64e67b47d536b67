//! Lowering of messages and alarms.
//!
//! A message may have values in it: whole numbers as they are, real ones with up to ten digits after the point, as the
//! manual has it, of which nine are kept; zeros at their end are not written. A value that begins it has `<<` before it,
//! which makes a text of one value (Job planning, string operations, conversion to STRING).
//!
//! Refused: alarms of ranges that do not end the program, or of which that is not known.

use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::program::{Alarm, Op, Piece, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::TextUnsupported;

use super::lower::Lower;
use super::text::tree::{Binary, Called, Expr as Tree, Unary};
use super::values::typed::Kind;
use crate::batch::Batch;
use crate::common::Source;

/// Digits of a real number in a message.
const DIGITS: u8 = 9;

impl Lower {
    /// `MSG("text"<<R1)`, and `MSG()` which clears it.
    pub(super) fn message(&mut self, called: &Called, src: Source, out: &mut Batch) {
        let text = match called.arguments.as_deref() {
            None | Some([] | [None]) => return self.push(called.span, Op::Message("".into()), out),
            Some([Some(text)]) => text,
            Some(_) => {
                return self.not_supported("MSG", TextUnsupported::BlendedMessage, called.span, out);
            }
        };
        let mut pieces = Vec::new();
        if self.pieces(text, &mut pieces, src, out).is_none() {
            return;
        }
        let op = match &mut pieces[..] {
            [] => Op::Message("".into()),
            [Piece::Text(text)] => Op::Message(text.trim_end().into()),
            _ => {
                out.whole = true;
                // Blanks at the end of a text show nothing.
                if let Some(Piece::Text(text)) = pieces.last_mut() {
                    *text = text.trim_end().into();
                }
                pieces.retain(|piece| !matches!(piece, Piece::Text(text) if text.is_empty()));
                Op::MessageOf(pieces.into())
            }
        };
        self.push(called.span, op, out);
    }

    /// The pieces of a text that is put together; `None` is one that is refused (reported).
    fn pieces(&mut self, tree: &Tree, into: &mut Vec<Piece>, src: Source, out: &mut Batch) -> Option<()> {
        if let Some(text) = self.known_text(tree, src) {
            match into.last_mut() {
                Some(Piece::Text(before)) => *before = format!("{before}{text}").into(),
                _ => into.push(Piece::Text(text)),
            }
            return Some(());
        }
        match tree {
            Tree::Binary(Binary::Join, operands) => {
                self.pieces(&operands.0, into, src, out)?;
                self.pieces(&operands.1, into, src, out)
            }
            Tree::Unary(Unary::Show, operand, _) => self.pieces(operand, into, src, out),
            Tree::Place(place) if self.text_variable(place, src).is_some() => {
                let what = TextUnsupported::UnknownText;
                self.not_supported(&src.text(place.span), what, place.span, out);
                None
            }
            _ => {
                let typed = self.formula(tree, src, out)?;
                let digits = match typed.kind {
                    Kind::Real => DIGITS,
                    Kind::Int => 0,
                    Kind::Bool | Kind::Text => {
                        let span = tree.span();
                        self.not_supported(&src.text(span), TextUnsupported::TruthValue, span, out);
                        return None;
                    }
                };
                into.push(Piece::Value { value: typed.expr, digits, short: true, places: 0 });
                Some(())
            }
        }
    }

    /// `SETAL(65000)`: an alarm of the user's.
    pub(super) fn alarm(&mut self, called: &Called, src: Source, out: &mut Batch) {
        let at = called.span;
        let arguments = called.arguments.as_deref().unwrap_or_default();
        let (number, text) = match arguments {
            [Some(Tree::Number(digits, _))] if !digits.point => (digits.mantissa, None),
            [Some(Tree::Number(digits, _)), Some(text)] if !digits.point => (digits.mantissa, Some(text)),
            // As the dictionary has it of all others.
            _ => return self.refuse_word("SETAL", at, out),
        };
        let text: Option<Text> = match text {
            None => Some("".into()),
            Some(text) => self.known_text(text, src),
        };
        let Some(text) = text else {
            return self.not_supported("SETAL", TextUnsupported::JoinedText, at, out);
        };
        match number {
            60_000..=69_999 => {}
            _ => return self.fault(Fault::OutOfRange { word: src.text(at).into() }, at, out),
        }
        if !matches!(number, 61_000..=61_999 | 65_000..=66_999) {
            let what = TextUnsupported::AlarmEnd;
            return self.not_supported("SETAL", what, at, out);
        }
        self.ends_program(at, out);
        out.whole = true;
        let number = Some(Expr::int(number));
        self.push(at, Op::Alarm(Box::new(Alarm { number, text })), out);
    }

    /// That an alarm ends the program is assumed, by the range of its number.
    fn ends_program(&mut self, at: Span, out: &mut Batch) {
        if self.first_time("SETAL") {
            out.report(Fault::AssumedFact { fact: ControlFact::AlarmsEnd }, at);
        }
    }
}
