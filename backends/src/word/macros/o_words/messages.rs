//! Messages, alarms and remarks in a text with O words.

use ncc_ir::diag::Fault;
use ncc_ir::lack::OperatorLack;
use ncc_ir::program::{Alarm, Piece};
use ncc_ir::run_time::RunTimeWord;
use ncc_ir::source::Span;

use crate::common::Sink;
use crate::common::fault::{cannot, cannot_compute};
use crate::word::Writer;

/// Digits of values in a message where nothing is stated, and of `%f`.
const DIGITS: u8 = 6;
const FLOAT_DIGITS: u8 = 4;

impl Writer {
    /// A message with values in it: variables, and how many digits of them are shown.
    pub(crate) fn o_message(&mut self, pieces: &[Piece], span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let rules = &self.dialect.comment;
        let word = rules.shown.first().ok_or_else(|| cannot(OperatorLack::MessageValues))?;
        let mut text = format!("{}{word}", rules.open);
        let mut digits_said = DIGITS;
        for piece in pieces {
            match piece {
                Piece::Text(plain) => {
                    let signs = [&rules.open[..], &rules.close];
                    let acts = acts(plain) || formats(plain);
                    if acts || signs.iter().any(|sign| plain.contains(sign)) || !plain.chars().all(shows) {
                        return Err(cannot(OperatorLack::MessageCharacters));
                    }
                    text.push_str(plain);
                }
                Piece::Value { value, digits, short, places: _ } => {
                    if *short && *digits > 0 {
                        return Err(cannot(OperatorLack::MessageValueZeros));
                    }
                    if *digits != digits_said {
                        digits_said = *digits;
                        text.push_str(&match *digits {
                            0 => "%d".to_owned(),
                            FLOAT_DIGITS => "%f".to_owned(),
                            DIGITS => "%lf".to_owned(),
                            digits => format!("%.{digits}f"),
                        });
                    }
                    let value = self.words.behind(value, None, span, sink)?;
                    if !value.starts_with('#') || value.starts_with("#[") || value.starts_with("##") {
                        return Err(cannot(OperatorLack::MessageValueNoVariable));
                    }
                    text.push_str(&value);
                }
            }
        }
        text.push_str(&self.dialect.comment.close);
        self.o_remark(&text, sink)
    }

    /// An alarm, which ends the program.
    pub(crate) fn o_alarm(&mut self, alarm: &Alarm, sink: &mut Sink) -> Result<(), Fault> {
        let rules = &self.dialect.comment;
        if rules.alarm.is_empty() {
            return Err(cannot(OperatorLack::Alarm));
        }
        if alarm.number.is_some() {
            // As straight blocks it can be no better.
            let what = RunTimeWord::AlarmNumber;
            return Err(if self.computes() {
                cannot_compute(what)
            } else {
                cannot(OperatorLack::AlarmWithNumber)
            });
        }
        let text = &alarm.text;
        let signs = [&rules.open[..], &rules.close];
        // The reader has no values in alarms, whatever stands after the sign.
        if text.contains('#') || signs.iter().any(|sign| text.contains(sign)) || !text.chars().all(shows) {
            return Err(cannot(OperatorLack::AlarmCharacters));
        }
        let text = format!("{}{}{text}{}", rules.open, rules.alarm, rules.close);
        self.o_remark(&text, sink)
    }

    /// A comment that does something, in a line of its own.
    fn o_remark(&mut self, text: &str, sink: &mut Sink) -> Result<(), Fault> {
        self.no_result()?;
        if !self.words.block.is_empty() || !self.words.block.comment.is_empty() {
            self.words.flush(false, sink);
            self.words.split = true;
        }
        self.words.block.comment.extend_from_slice(text.as_bytes());
        self.words.flush(false, sink);
        Ok(())
    }
}

fn shows(c: char) -> bool {
    !c.is_control()
}

/// Whether a text has what would be the value of a variable.
fn acts(text: &str) -> bool {
    text.split('#').skip(1).any(|rest| rest.starts_with(|c: char| c == '<' || c.is_ascii_digit()))
}

/// Whether a text has what says how values are shown.
fn formats(text: &str) -> bool {
    let rest = text.split('%').skip(1);
    rest.into_iter().any(|rest| rest.starts_with(['d', 'f', '.']) || rest.starts_with("lf"))
}
