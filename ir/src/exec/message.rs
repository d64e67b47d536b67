//! Texts for the operator, and the values in them; alarms.
//!
//! Not here: computing what is in an expression (`run`).

use super::term::real;
use super::{Event, Exec, Kind};
use crate::diag::{Diagnostic, Fault};
use crate::expr::{Expr, Node};
use crate::program::{Op, Piece, Stmt, Text};
use crate::value::Value;

/// A value as it stands in a text.
pub(super) fn write(value: Value, digits: u8, short: bool, out: &mut String) {
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

/// A text all of whose values are written; `None` if one is still to be computed.
fn text(pieces: &[Piece]) -> Option<Text> {
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
                write(value, *digits, *short, &mut out);
            }
        }
    }
    Some(out.into())
}

impl Exec {
    /// Makes no events of messages: for a comparison with a control that cannot show them, but for those of a
    /// program stop, in its block or the one before it, if it can show these.
    pub fn mute(&mut self, but_stops: bool) {
        self.muted = true;
        self.stops_speak = but_stops;
    }

    pub(super) fn message(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let span = stmt.span;
        match &stmt.op {
            Op::Message(text) if self.muted && self.stops_speak => {
                let own = || Box::new((text.clone(), span, stmt.skip));
                self.unspoken = (!text.is_empty()).then(own);
            }
            Op::Message(_) | Op::MessageOf(_) if self.muted => {}
            Op::Message(text) => self.emit(Kind::Message(text.clone()), span, out)?,
            Op::MessageOf(pieces) => {
                let Some(text) = text(pieces) else {
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
