//! Calls of which the number, or the repeat count, is computed: `M98 P#101 L#102`.
//!
//! Read again, the number is one of a program of the text; so these must be all of them, which the verification tells.

use ncc_ir::computed::computed_call::ComputedCall;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::lack::FlowLack;
use ncc_ir::program::Stmt;
use ncc_ir::source::Span;

use crate::common::Sink;
use crate::common::block::{Need, Part, Rank};
use crate::common::fault::cannot;
use crate::common::formula::rounding;
use crate::word::Writer;

impl Writer {
    /// Such a call as the control says it.
    pub(in crate::word) fn computed_call(
        &mut self,
        call: &ComputedCall,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let words = self.words.codes.call.ok_or_else(|| cannot(FlowLack::SubprogramCall))?;
        self.flow(stmt, sink)?;
        let number = match (call.number, call.name) {
            (Some(number), _) => self.whole_value(number, stmt.span, sink)?,
            (None, Some(name)) => {
                let least =
                    if self.dialect.program.padded_calls { self.dialect.program.number_digits } else { 0 };
                format!("{:0least$}", self.program_number(name)?)
            }
            (None, None) => return Err(cannot(FlowLack::CallOfNoProgram)),
        };
        let mut need = Need::new(Rank::Alone).code(Some(words.code)).letter(words.number);
        let times = match (call.times, words.count) {
            (None, _) => None,
            (Some(times), Some(letter)) => Some((letter, self.whole_value(times, stmt.span, sink)?)),
            (Some(_), None) => return Err(cannot(FlowLack::CallSeveralTimes)),
        };
        if let Some((letter, _)) = &times {
            need = need.letter(*letter);
        }
        self.words.admit(&need, sink)?;
        self.words.block.code(Part::Tail, &words.code);
        self.words.block.digits(Part::Tail, words.number, &number);
        if let Some((letter, times)) = times {
            self.words.block.digits(Part::Tail, letter, &times);
        }
        self.forget();
        Ok(())
    }

    /// A value that its address takes as the nearest whole number.
    fn whole_value(&mut self, value: &Expr, span: Span, sink: &mut Sink) -> Result<String, Fault> {
        match rounding(value) {
            (Some(0), inner) => self.words.behind(inner, Some(0), span, sink),
            _ => self.words.behind(value, None, span, sink),
        }
    }
}
