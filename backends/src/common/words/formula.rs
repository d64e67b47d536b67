//! Words of a block whose value is an expression.

use ncc_dialects::{ANGLE_RANGE, MACHINE_UNITS, SystemRow};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Binary, Expr, Function, Node, Unary, Var};
use ncc_ir::run_time::RunTimeValue;
use ncc_ir::source::Span;

use super::Words;
use crate::common::Sink;
use crate::common::codes::Letter;
use crate::common::fault::cannot_compute;
use crate::common::formula::comparisons::decides;
use crate::common::formula::{LOOSEST, Spelling, arcs, rounding};
use crate::common::number::WordValue;

impl Words {
    /// How expressions are spelt, in a word that rounds to digits or elsewhere.
    pub(crate) fn spelling(&self, digits: Option<u8>) -> Result<Spelling<'_>, Fault> {
        if self.dialect.formula.operators.is_empty() {
            return Err(cannot_compute(RunTimeValue::Computed));
        }
        Ok(Spelling {
            rules: &self.dialect.formula,
            own: &self.own_values,
            system: &self.dialect.system,
            settings: &self.settings,
            machine: self.settings.get(MACHINE_UNITS),
            blanks: self.dialect.block.blanks,
            turn: self.settings.get(ANGLE_RANGE) == "turn",
            digits,
            names: &self.variables,
        })
    }

    /// A condition is a branch's alone, where loops and branches have no words of their own for blocks.
    fn no_condition(&self, e: &Expr) -> Result<(), Fault> {
        match self.dialect.program.macro_b && e.has(&decides) {
            true => Err(cannot_compute(RunTimeValue::ConditionAsValue)),
            false => Ok(()),
        }
    }

    /// Reports what an expression assumes of the machine.
    pub(crate) fn rely_on(&mut self, e: &Expr, span: Span, sink: &mut Sink) {
        if arcs(e) {
            self.rely(ANGLE_RANGE, span, sink);
        }
        let dialect = self.dialect;
        if !e.has(&|part| matches!(part, Node::Var(Var::System(_)))) {
            return;
        }
        let reported = |row: &&SystemRow| !row.option.is_empty() || !row.assumes.is_empty();
        for row in dialect.system.iter().filter(reported) {
            if !row.counts(&self.settings) {
                continue;
            }
            let asks = |part: &Node| match part {
                Node::Var(Var::System(system)) => row.says().any(|(says, _)| says == *system),
                _ => false,
            };
            if !e.has(&asks) {
                continue;
            }
            if !row.option.is_empty() {
                self.rely(&row.option, span, sink);
            }
            if !row.assumes.is_empty() && !self.told_options.contains(&&*row.assumes) {
                self.told_options.push(&row.assumes);
                let assumption = ControlFact::SystemVariable { fact: row.assumes.as_str().into() };
                sink.report(Fault::AssumedFact { fact: assumption }, span);
            }
        }
    }

    /// An expression as what is assigned.
    pub(crate) fn expression(&mut self, e: &Expr, span: Span, sink: &mut Sink) -> Result<String, Fault> {
        self.no_condition(e)?;
        self.rely_on(e, span, sink);
        let mut out = String::new();
        self.spelling(None)?.expr(e, LOOSEST, true, 0, &mut out)?;
        Ok(out)
    }

    /// A condition, in its brackets.
    pub(crate) fn condition(&mut self, e: &Expr, span: Span, sink: &mut Sink) -> Result<String, Fault> {
        self.rely_on(e, span, sink);
        let mut out = String::new();
        let mut e = e.clone();
        if self.dialect.program.macro_b {
            compared(&mut e)?;
        }
        self.spelling(None)?.bracketed(&e, 0, &mut out)?;
        Ok(out)
    }

    /// Writes the computed value of a letter: a variable with its sign, or an expression in brackets.
    pub(crate) fn behind(
        &mut self,
        e: &Expr,
        digits: Option<u8>,
        span: Span,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        self.no_condition(e)?;
        self.rely_on(e, span, sink);
        let spelling = self.spelling(digits)?;
        let mut out = String::new();
        if !spelling.rules.behind.is_empty() {
            out.push_str(&spelling.rules.behind);
            spelling.expr(e, LOOSEST, true, 0, &mut out)?;
            return Ok(out);
        }
        let e = match e {
            Expr::Node(node) => match &**node {
                Node::Unary(Unary::Negate, a) => {
                    out.push('-');
                    a
                }
                _ => e,
            },
            Expr::Num(_) => e,
        };
        let e = given(e);
        match e {
            Expr::Node(node) if matches!(**node, Node::Var(_) | Node::Element(_) | Node::Vacant) => {
                spelling.expr(e, 0, true, 0, &mut out)?;
            }
            e => spelling.bracketed(e, 0, &mut out)?,
        }
        Ok(out)
    }

    /// The value of a word that is computed.
    ///
    /// # Errors
    /// The control rounds it to other digits than the program says, or cannot compute it.
    pub(crate) fn computed(
        &mut self,
        letter: &Letter,
        value: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<WordValue, Fault> {
        let value = if letter.format.counts { self.spelling(None)?.without_rounding(value) } else { value };
        let (said, inner) = rounding(value);
        let rounds = letter.format.rounds.filter(|_| self.dialect.formula.rounds);
        let digits = match (said, rounds) {
            (None, None) => None,
            (Some(said), Some([mm, inch])) if mm == inch && said == mm => Some(said),
            (Some(said), Some([mm, inch])) if mm != inch && (said == mm || said == inch) => {
                // The active units say which of the two is meant.
                let unit = if said == mm { Unit::Mm } else { Unit::Inch };
                self.check_unit(Num::int(1, unit), span)?;
                Some(said)
            }
            (Some(_), None) if !self.dialect.formula.rounds => {
                let text = self.behind(value, None, span, sink)?;
                return Ok(self.block.formula(text));
            }
            (Some(_), _) => {
                return Err(cannot_compute(RunTimeValue::OtherDigits));
            }
            (None, Some(_)) => {
                return Err(cannot_compute(RunTimeValue::NotRounded));
            }
        };
        let text = self.behind(inner, digits, span, sink)?;
        Ok(self.block.formula(text))
    }
}

/// A number among conditions that are joined, `[#1 EQ 0] XOR 1`, as one that holds or does not.
///
/// # Errors
/// A side of a comparison is a condition.
fn compared(e: &mut Expr) -> Result<(), Fault> {
    let Expr::Node(node) = e else { return Ok(()) };
    if let Node::Binary(Binary::And | Binary::Or | Binary::Xor, a, b) = &mut **node {
        for part in [a, b] {
            if let Expr::Num(n) = part {
                let holds = i64::from(n.mantissa != 0);
                *part = Expr::Node(Box::new(Node::Binary(Binary::Equal, Expr::int(holds), Expr::int(1))));
            }
            compared(part)?;
        }
        return Ok(());
    }
    if let Node::Unary(Unary::Not, a) = &mut **node {
        return compared(a);
    }
    match e.parts().any(|part| part.has(&decides)) {
        true => Err(cannot_compute(RunTimeValue::ConditionAsValue)),
        false => Ok(()),
    }
}

/// What must have a value, as that value.
fn given(e: &Expr) -> &Expr {
    match e {
        Expr::Node(node) => match &**node {
            Node::Call(Function::Given, arguments) => arguments.first().unwrap_or(e),
            _ => e,
        },
        Expr::Num(_) => e,
    }
}
