//! Emits words whose value is an expression: `X[#1+2.]` on Fanuc, `X=R1+2` on Sinumerik.
//!
//! It also reports the assumptions that an expression needs, such as the range of an arc tangent.
//! Not here: the spelling of operators and functions (`common::formula`).

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
    /// The rules for spelling an expression. `digits` is the rounding of its word; `None` if nothing rounds it.
    ///
    /// # Errors
    /// The dialect has no operators.
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

    /// Refuses a condition used as a value. Macro B allows conditions only in branches and loops.
    fn no_condition(&self, e: &Expr) -> Result<(), Fault> {
        match self.dialect.program.macro_b && e.has(&decides) {
            true => Err(cannot_compute(RunTimeValue::ConditionAsValue)),
            false => Ok(()),
        }
    }

    /// Reports the assumptions about the machine that an expression needs: angle range, system variables.
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

    /// Text of the right side of an assignment, without outer brackets.
    pub(crate) fn expression(&mut self, e: &Expr, span: Span, sink: &mut Sink) -> Result<String, Fault> {
        self.no_condition(e)?;
        self.rely_on(e, span, sink);
        let mut out = String::new();
        self.spelling(None)?.expr(e, LOOSEST, true, 0, &mut out)?;
        Ok(out)
    }

    /// Text of a condition, in brackets.
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

    /// Text after an address: `#1`, `-#1`, `[#1+2.]`, or `=R1+2` where the dialect has a sign before it.
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

    /// The value of a word that an expression gives.
    ///
    /// # Errors
    /// The control rounds to other digits than the program, or it cannot compute the expression.
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
                // The digits fit one unit only, so that unit must be active.
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

/// Turns a number joined with conditions into a comparison: the 1 of `[#1 EQ 0] XOR 1` becomes `1 EQ 1`.
///
/// # Errors
/// One side of a comparison is itself a condition.
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

/// The argument of [`Function::Given`], which marks a value that must not be empty; else `e` itself.
fn given(e: &Expr) -> &Expr {
    match e {
        Expr::Node(node) => match &**node {
            Node::Call(Function::Given, arguments) => arguments.first().unwrap_or(e),
            _ => e,
        },
        Expr::Num(_) => e,
    }
}
