//! Calls of other programs, by number or by name.

use ncc_ir::diag::Fault;
use ncc_ir::lack::FlowLack;
use ncc_ir::program::{Call, Stmt};
use ncc_ir::run_time::RunTimeFlow;

use super::super::Writer;
use super::super::macros::modal_call::AtMoves;
use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::CallCode;
use crate::common::fault::{cannot, cannot_compute};

impl Writer {
    pub(super) fn call(&mut self, call: &Call, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        if self.calls_with_variables(call) {
            if self.at_moves == AtMoves::Within {
                // The control makes it by itself.
                self.words.flush(false, sink);
                self.forget();
                return Ok(());
            }
            return self.macro_call(call, stmt, sink);
        }
        if self.is_o_sub(&call.name) {
            return Err(cannot_compute(RunTimeFlow::CallOfOwnElsewhere));
        }
        let words = self.words.codes.call.ok_or_else(|| cannot(FlowLack::SubprogramCall))?;
        self.call_up_now(stmt, sink)?;
        if self.has_name(&call.name) {
            return self.call_by_name(call, &words, sink);
        }
        let number = self.program_number(&call.name)?;
        let packed = self.dialect.program.packed_call_digits as usize;
        let least = if self.dialect.program.padded_calls { self.dialect.program.number_digits } else { 0 };
        let padded = format!("{number:0least$}");
        let out_of_range = || Fault::TargetRange { word: call.times.to_string().into() };
        let mut need = Need::new(Rank::Call).code(Some(words.code)).letter(words.number);
        let (digits, count) = match (call.times, packed, words.count) {
            (0, ..) => return Err(cannot(FlowLack::CallNoTimes)),
            (1, ..) => (padded, None),
            (2..=9999, 1.., _) => (format!("{}{number:0>packed$}", call.times), None),
            (2..=9999, 0, Some(letter)) => (padded, Some(letter)),
            _ => return Err(out_of_range()),
        };
        if let Some(letter) = count {
            need = need.letter(letter);
        }
        self.words.admit(&need, sink)?;
        self.words.block.code(Part::Tail, &words.code);
        self.words.block.digits(Part::Tail, words.number, &digits);
        if let Some(letter) = count {
            self.words.block.digits(Part::Tail, letter, &call.times.to_string());
        }
        // The subprogram may change everything.
        self.forget();
        Ok(())
    }

    /// A call of a subprogram by its name.
    fn call_by_name(&mut self, call: &Call, words: &CallCode, sink: &mut Sink) -> Result<(), Fault> {
        let need = Need::new(Rank::Call).code(Some(words.code));
        let count = match (call.times, words.count) {
            (0, _) => return Err(cannot(FlowLack::CallNoTimes)),
            (1, _) => None,
            (2..=9999, Some(letter)) => Some(letter),
            _ => return Err(Fault::TargetRange { word: call.times.to_string().into() }),
        };
        self.words.admit(&count.iter().fold(need, |need, letter| need.letter(*letter)), sink)?;
        self.words.block.code(Part::Tail, &words.code);
        self.words.block.text(Part::Tail, &format!("<{}>", call.name));
        if let Some(letter) = count {
            self.words.block.digits(Part::Tail, letter, &call.times.to_string());
        }
        self.forget();
        Ok(())
    }

    /// Whether a subprogram is written by its name: one that the control can read, and no number.
    pub(crate) fn has_name(&self, name: &str) -> bool {
        let fits = |b: u8| b.is_ascii_alphanumeric() || b"+-_.".contains(&b);
        let number = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
        let read_as_number = number(name) || name.strip_prefix('O').is_some_and(number);
        self.words.settings.writes_names()
            && (1..=32).contains(&name.len())
            && name.bytes().all(fits)
            && !read_as_number
    }

    /// The number of a subprogram, as its name says it.
    pub(crate) fn program_number(&self, name: &str) -> Result<u32, Fault> {
        let digits = self.dialect.program.number_digits.clamp(1, 8) as u32;
        let number = name.parse::<u32>().ok().filter(|n| (1..10u32.pow(digits)).contains(n));
        number.ok_or_else(|| cannot(FlowLack::SubprogramName { name: name.into() }))
    }
}
