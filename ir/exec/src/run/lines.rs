//! Packed moves of a run, unpacked some at a time, with the values of their computed words. No move
//! assigns a variable, so that all of them read the same values.
//!
//! Not here: execution once for two runs (the verification).

use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::value::{self, Value};
use ncc_ir::expr::{Expr, Unary};
use ncc_ir::program::packed::PackedLines;
use ncc_ir::program::packing::Unpack;
use ncc_ir::program::shapes::WordRole;
use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::ValueUnexecuted;

use crate::run::term::{Names, Term, Variables, Why, literal, real};

/// Moves that are unpacked at once: few enough for the second-level cache.
const AT_ONCE: usize = 512;

/// The unpacked moves, and how many of them are executed.
#[derive(Clone, Debug, Default)]
pub(crate) struct LinesAhead<'p> {
    rest: Option<Unpack<'p>>,
    now: Vec<Stmt>,
    done: usize,
    /// Why the next move has no value.
    fault: Option<Box<Diagnostic>>,
}

/// The values of the words of a run's packed moves.
#[derive(Clone, Copy)]
pub(crate) struct Worth<'a> {
    pub(crate) shapes: &'a [(Term, WordRole)],
    pub(crate) names: &'a Names,
    pub(crate) variables: &'a Variables,
    /// Whether feeds are inverse times.
    pub(crate) per_time: bool,
}

impl Worth<'_> {
    /// A word of a shape with these numbers.
    fn word(self, shape: usize, numbers: &[Num]) -> Result<Option<Expr>, Fault> {
        let Some((term, role)) = self.shapes.get(shape) else { return Ok(None) };
        let value = self.value(term, &mut numbers.iter()).map_err(|why| self.names.fault(why))?;
        let unit = match role {
            WordRole::Feed if matches!(value, Value::Number(feed) if feed <= 0.0) => {
                return Err(Fault::not_executed(ValueUnexecuted::NotPositive));
            }
            WordRole::Feed if self.per_time => Unit::One,
            WordRole::Axis | WordRole::Feed => Unit::Entry,
        };
        Ok(literal(value, unit)?.map(Expr::Num))
    }

    /// As [`Variables::value`], with these numbers.
    fn value(self, term: &Term, numbers: &mut std::slice::Iter<Num>) -> Result<Value, Why> {
        Ok(match term {
            Term::Number(own) => Value::Number(numbers.next().map_or(*own, |num| real(*num))),
            Term::Read(place) => self.variables.read(*place)?,
            Term::Unary(f, a) => match (f, self.value(a, numbers)?) {
                (Unary::Negate, Value::Vacant) => Value::Vacant,
                (f, value) => Value::Number(value::unary(*f, value.number())),
            },
            Term::Binary(f, both) => {
                let [a, b] = &**both;
                let (a, b) = (self.value(a, numbers)?.number(), self.value(b, numbers)?.number());
                Value::Number(value::binary(*f, a, b).map_err(Why::Wrong)?)
            }
            Term::OfTwo(f, both) => match (self.value(&both[0], numbers)?, &both[1]) {
                (Value::Vacant, _) => Value::Vacant,
                (Value::Number(n), Term::Number(digits)) => {
                    Value::Number(value::function(*f, n, *digits).map_err(Why::Wrong)?)
                }
                _ => return Err(Why::Measured),
            },
            // No shape has it.
            Term::Vacant
            | Term::System(_)
            | Term::Measured
            | Term::Of(..)
            | Term::OfThree(..)
            | Term::Element(_)
            | Term::Given(_)
            | Term::Miscounted => return Err(Why::Measured),
        })
    }
}

impl<'p> LinesAhead<'p> {
    /// Some of the next moves; empty at the end, or before a move without a value.
    #[inline]
    pub(crate) fn of(&mut self, lines: &'p PackedLines, worth: Worth) -> &[Stmt] {
        if self.done == self.now.len() && self.fault.is_none() {
            self.unpack(lines, worth);
        }
        &self.now[self.done..]
    }

    fn unpack(&mut self, lines: &'p PackedLines, worth: Worth) {
        let rest = self.rest.get_or_insert_with(|| lines.unpack());
        self.now.clear();
        self.done = 0;
        while self.now.len() < AT_ONCE {
            match rest.next_by(&mut |shape, numbers| worth.word(shape, numbers)) {
                // A feed without a value says nothing.
                Ok(Some(Stmt { op: Op::Blank, .. })) => {}
                Ok(Some(stmt)) => self.now.push(stmt),
                Ok(None) => break,
                Err((span, fault)) => {
                    self.fault = Some(Box::new(Diagnostic::new(fault, span)));
                    break;
                }
            }
        }
    }

    /// Why the next move has no value, if it has none.
    pub(crate) fn fault(&self) -> Option<&Diagnostic> {
        self.fault.as_deref().filter(|_| self.done == self.now.len())
    }

    /// The same, as they are unpacked.
    pub(crate) fn unpacked(&self) -> &[Stmt] {
        &self.now[self.done..]
    }

    /// Counts moves as executed.
    pub(crate) fn pass(&mut self, many: usize) {
        self.done += many;
    }

    /// The next move, counted as executed.
    #[inline]
    pub(crate) fn take(&mut self) -> Option<&Stmt> {
        let next = self.now.get(self.done);
        self.done += usize::from(next.is_some());
        next
    }

    /// Counts all of them as executed.
    pub(crate) fn leave(&mut self) {
        *self = LinesAhead { now: std::mem::take(&mut self.now), ..LinesAhead::default() };
        self.now.clear();
    }

    /// The place of the last executed move.
    pub(crate) fn last(&self) -> Option<Span> {
        let last = self.done.checked_sub(1).and_then(|at| self.now.get(at));
        last.map(|stmt| stmt.span)
    }
}
