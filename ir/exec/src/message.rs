//! Texts for the operator, and the values in them; alarms.
//!
//! Not here: computing what is in an expression (`run`).

use super::{Event, Exec, Kind, Written};
use crate::run::term::real;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::value::Value;
use ncc_ir::expr::{Expr, Node};
use ncc_ir::program::{Op, Output, Piece, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::ValueUnexecuted;

/// A value as it stands in a text.
fn write(value: Value, digits: u8, short: bool, places: u8, out: &mut String) {
    let Value::Number(n) = value else { return };
    let number = format!("{n:.*}", usize::from(digits.min(9)));
    let number = match short && number.contains('.') {
        true => number.trim_end_matches('0').trim_end_matches('.'),
        false => &number,
    };
    // Nothing left of a negative number has no sign.
    let nothing = number.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
    let number = if nothing { number.trim_start_matches('-') } else { number };
    let whole = number.find('.').unwrap_or(number.len());
    let blanks = usize::from(places).saturating_sub(whole);
    out.extend(std::iter::repeat_n(' ', blanks));
    out.push_str(number);
}

/// The text of a statement that has values in it.
pub(super) fn pieces(op: &Op) -> Option<&[Piece]> {
    match op {
        Op::MessageOf(pieces) => Some(pieces),
        Op::Output(output) => match &**output {
            Output::Line(pieces) => Some(pieces),
            Output::Open | Output::Close => None,
        },
        _ => None,
    }
}

impl Shown {
    /// Whether a statement is a text for a device, and nobody has it: what its values are does not matter.
    pub(super) fn leaves_out(&self, op: &Op) -> bool {
        self.no_output && matches!(op, Op::Output(_))
    }
}

/// The same statement with its text as it is.
pub(super) fn said(op: &Op, text: Text) -> Op {
    match op {
        Op::Output(_) => Op::Output(Box::new(Output::Line([Piece::Text(text)].into()))),
        _ => Op::Message(text),
    }
}

/// What becomes of messages.
#[derive(Clone, Debug, Default)]
pub(super) struct Shown {
    /// Whether they make no events, but for those of program stops.
    muted: bool,
    stops_speak: bool,
    /// The message of the statement at hand, and of the one before it, if it makes none but for a program stop; with
    /// their levels of block skip.
    unspoken: Option<Box<(Text, Span, Option<u8>)>>,
    before: Option<Box<(Text, Span, Option<u8>)>>,
    /// With how many digits values stand that have none too many.
    in_full: Option<u8>,
    /// Whether what is written to devices makes no events.
    no_output: bool,
}

impl Shown {
    /// Another statement.
    pub(super) fn goes_on(&mut self) {
        if self.muted {
            self.before = self.unspoken.take();
        }
    }

    /// What a program stop shows, and where that stands.
    pub(super) fn at_stop(&mut self, skip: Option<u8>) -> Option<(Text, Span)> {
        let before = self.before.take().filter(|before| before.2 == skip)?;
        Some((before.0, before.1))
    }

    /// A value as it stands in a text.
    fn write(&self, value: Value, digits: u8, short: bool, places: u8, out: &mut String) {
        match self.in_full.filter(|_| short && digits > 0) {
            Some(digits) => write(value, digits, false, places, out),
            None => write(value, digits, short, places, out),
        }
    }

    /// A text with its values, which are given one after the other.
    pub(super) fn with_values<E>(
        &self,
        pieces: &[Piece],
        next: &mut dyn FnMut(&Expr) -> Result<Value, E>,
    ) -> Result<Text, E> {
        let mut text = String::new();
        for piece in pieces {
            match piece {
                Piece::Text(piece) => text.push_str(piece),
                Piece::Value { value, digits, short, places } => {
                    self.write(next(value)?, *digits, *short, *places, &mut text);
                }
            }
        }
        Ok(text.into())
    }

    /// A text all of whose values are written; `None` if one is still to be computed.
    fn text(&self, pieces: &[Piece]) -> Option<Text> {
        let literal = |value: &Expr| match value {
            Expr::Num(n) => Ok(Value::Number(real(*n))),
            Expr::Node(node) if matches!(**node, Node::Vacant) => Ok(Value::Vacant),
            Expr::Node(_) => Err(()),
        };
        self.with_values(pieces, &mut { literal }).ok()
    }
}

impl Exec {
    /// Writes values in texts that have no zeros at their end with so many digits, as the control does that it is
    /// compared with.
    pub fn values_in_full(&mut self, digits: u8) {
        self.shown.in_full = Some(digits);
    }

    /// Makes no events of what is written to devices: for a comparison with a control that has none.
    pub fn without_output(&mut self) {
        self.shown.no_output = true;
    }

    /// Makes no events of messages: for a comparison with a control that cannot show them, but for those of a
    /// program stop, in its block or the one before it, if it can show these.
    pub fn mute(&mut self, but_stops: bool) {
        self.shown.muted = true;
        self.shown.stops_speak = but_stops;
    }

    pub(super) fn message(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let span = stmt.span;
        match &stmt.op {
            Op::Message(text) if self.shown.muted && self.shown.stops_speak => {
                let own = || Box::new((text.clone(), span, stmt.skip));
                self.shown.unspoken = (!text.is_empty()).then(own);
            }
            Op::Message(_) | Op::MessageOf(_) if self.shown.muted => {}
            Op::Message(text) => self.emit(Kind::Message(text.clone()), span, out)?,
            Op::MessageOf(pieces) => {
                let Some(text) = self.shown.text(pieces) else {
                    return self.fault(Fault::not_executed(ValueUnexecuted::MessageValue), span);
                };
                self.emit(Kind::Message(text), span, out)?;
            }
            Op::Output(_) if self.shown.no_output => {}
            Op::Output(output) => {
                let written = match &**output {
                    Output::Open => Written::Opened,
                    Output::Close => Written::Closed,
                    Output::Line(pieces) => match self.shown.text(pieces) {
                        Some(text) => Written::Line(text),
                        None => {
                            return self.fault(Fault::not_executed(ValueUnexecuted::WrittenValue), span);
                        }
                    },
                };
                self.emit(Kind::Output(written), span, out)?;
            }
            Op::Alarm(alarm) => {
                let number = alarm.number.as_ref().map(|number| self.value(number, span)).transpose()?;
                self.emit(Kind::Alarm(number, alarm.text.clone()), span, out)?;
                self.ended = true;
            }
            _ => {}
        }
        Ok(())
    }
}
