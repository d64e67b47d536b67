//! Texts for the operator, and the values in them; alarms.
//!
//! Not here: computing what is in an expression (`run`).

use super::term::real;
use super::{Event, Exec, Kind};
use crate::diag::{Diagnostic, Fault};
use crate::expr::{Expr, Node};
use crate::program::{Op, Piece, Stmt, Text};
use crate::source::Span;
use crate::value::Value;

/// A value as it stands in a text.
fn write(value: Value, digits: u8, short: bool, out: &mut String) {
    let Value::Number(n) = value else { return };
    let number = format!("{n:.*}", usize::from(digits.min(9)));
    let number = match short && number.contains('.') {
        true => number.trim_end_matches('0').trim_end_matches('.'),
        false => &number,
    };
    // Nothing left of a negative number has no sign.
    let nothing = number.bytes().all(|b| matches!(b, b'-' | b'0' | b'.'));
    out.push_str(if nothing { number.trim_start_matches('-') } else { number });
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
    pub(super) fn write(&self, value: Value, digits: u8, short: bool, out: &mut String) {
        match self.in_full.filter(|_| short && digits > 0) {
            Some(digits) => write(value, digits, false, out),
            None => write(value, digits, short, out),
        }
    }

    /// A text all of whose values are written; `None` if one is still to be computed.
    fn text(&self, pieces: &[Piece]) -> Option<Text> {
        let mut out = String::new();
        for piece in pieces {
            match piece {
                Piece::Text(text) => out.push_str(text),
                Piece::Value { value, digits, short } => {
                    let value = match value {
                        Expr::Num(n) => Value::Number(real(*n)),
                        Expr::Node(node) => match **node {
                            Node::Vacant => Value::Vacant,
                            _ => return None,
                        },
                    };
                    self.write(value, *digits, *short, &mut out);
                }
            }
        }
        Some(out.into())
    }
}

impl Exec {
    /// Writes values in texts that have no zeros at their end with so many digits, as the control does that it is
    /// compared with.
    pub fn values_in_full(&mut self, digits: u8) {
        self.shown.in_full = Some(digits);
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
                    let what = "a value in a message".into();
                    return self.fault(Fault::NotExecuted { what }, span);
                };
                self.emit(Kind::Message(text), span, out)?;
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
