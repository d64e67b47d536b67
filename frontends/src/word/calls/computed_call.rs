//! Subprogram calls with a computed number or repeat count (16i-PB, custom macro: a variable may replace the value of
//! any address but `O` and `N`). They become a branch for each program of the text, and an alarm for other numbers.
//!
//! They are lowered at the end of the text, because the programs follow. A number with the repeat count in
//! front matches none of them.

use ncc_dialects::Quantity;
use ncc_ir::computed::computed_call::{of_number, so_often};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::program::{Call, Op, Stmt, Text};
use ncc_ir::unsupported::CallUnsupported;

use crate::batch::Batch;
use crate::common::Source;
use crate::common::words::{Value, Word};
use crate::word::block_words::{Code, Words};
use crate::word::lower::Lower;
use crate::word::macros::computes::{COMPUTED, Computes};

impl Lower {
    /// A call with a computed number or repeat count.
    pub(in crate::word) fn computed_call(
        &mut self,
        code: &Code,
        program: &Word,
        count: Option<&Word>,
        words: &Words,
        src: Source,
        out: &mut Batch,
    ) {
        let span = code.span.to(count.map_or(program.span, |count| count.span));
        if self.within_modal(span, out) {
            return;
        }
        let (name, arguments): (Text, Vec<Expr>) = match program.value {
            Value::Computed(_) => match self.amount(program, Quantity::Integer, words, src, out) {
                Some(number) => (COMPUTED.into(), vec![number]),
                None => return,
            },
            Value::Number(_) | Value::None => match self.read_whole(program, src, out) {
                Some(number @ 1..) => (number.to_string().into(), Vec::new()),
                Some(0) => {
                    return self.fault(
                        Fault::OutOfRange { word: src.text(program.span).into() },
                        program.span,
                        out,
                    );
                }
                None => return,
            },
        };
        let times = match count {
            None => None,
            Some(word) => match self.amount(word, Quantity::Integer, words, src, out) {
                Some(times) => Some(times),
                None => return,
            },
        };
        if *name == *COMPUTED && times.is_some() {
            // The called program may change the variable of its number.
            let what = CallUnsupported::ComputedTimes.into();
            return self.fault(Fault::NotSupported { code: code.row.code.as_str().into(), what }, span, out);
        }
        out.whole = true;
        self.computes.calls_of |= *name == *COMPUTED;
        self.leave_motion(None, out);
        let call = Op::Call(Box::new(Call { name, times: 1, arguments, shared: self.shares() }));
        let op = match times {
            None => call,
            Some(times) => so_often(call, &times, span),
        };
        self.push(span, op, out);
        self.lose_state(out);
    }
}

impl Computes {
    /// At the end of the text, computed calls become branches over its programs.
    pub(in crate::word) fn join_calls(&self, out: &mut Batch) {
        if !self.calls_of {
            return;
        }
        let names = out.procedures.iter().map(|procedure| procedure.name.clone());
        let names: Vec<(i64, Text)> = names.filter_map(|name| Some((name.parse().ok()?, name))).collect();
        join(&mut out.stmts, &names, "");
        for procedure in &mut out.procedures {
            let own = procedure.name.clone();
            join(&mut procedure.body, &names, &own);
        }
    }
}

/// A program never calls itself in this way: the call would not end.
fn join(body: &mut [Stmt], names: &[(i64, Text)], own: &str) {
    for stmt in body {
        match &mut stmt.op {
            Op::Control(control) => control.bodies_mut().for_each(|body| join(body, names, own)),
            Op::Call(call) if *call.name == *COMPUTED => {
                let Some(number) = call.arguments.pop() else { continue };
                let names = names.iter().filter(|(_, name)| **name != *own);
                stmt.op = of_number(&number, names, call.shared, stmt.span);
            }
            _ => {}
        }
    }
}
