//! Calls of which the program, or the repeat count, is computed when the program runs: branches for one number, each with the
//! call of the program that has it, and an alarm after them; around them a loop of so many turns, at least one.
//!
//! Not here: which programs are asked about (the front-end's), and how a control writes such a call.

pub use super::alarm_texts::NO_SUCH_PROGRAM;
use crate::expr::{Binary, Expr, Node};
use crate::program::{Alarm, Call, Control, Op, Stmt, Text};
use crate::source::Span;

/// Such a call.
#[derive(Clone, Copy, Debug)]
pub struct ComputedCall<'c> {
    /// The number of the program, where it is computed.
    pub number: Option<&'c Expr>,
    /// The program, where it is stated.
    pub name: Option<&'c Text>,
    /// Repeat count, where that is computed.
    pub times: Option<&'c Expr>,
}

fn alarm(span: Span) -> Vec<Stmt> {
    vec![Stmt::new(span, Op::Alarm(Box::new(Alarm { number: None, text: NO_SUCH_PROGRAM.into() })))]
}

fn is_alarm(body: &[Stmt]) -> bool {
    let [Stmt { op: Op::Alarm(alarm), .. }] = body else { return false };
    alarm.number.is_none() && *alarm.text == *NO_SUCH_PROGRAM
}

fn compared(operator: Binary, a: &Expr, b: i64) -> Expr {
    Expr::Node(Box::new(Node::Binary(operator, a.clone(), Expr::int(b))))
}

/// A call of the program whose number an expression is worth, which is whole.
pub fn of_number<'n>(
    number: &Expr,
    names: impl DoubleEndedIterator<Item = &'n (i64, Text)>,
    shared: bool,
    span: Span,
) -> Op {
    let last = names.rev().fold(alarm(span), |otherwise, (own, name)| {
        let call = Call { name: name.clone(), times: 1, arguments: Vec::new(), shared };
        let then = vec![Stmt::new(span, Op::Call(Box::new(call)))];
        let condition = compared(Binary::Equal, number, *own);
        vec![Stmt::new(span, Op::Control(Box::new(Control::If { condition, then, otherwise })))]
    });
    last.into_iter().next().map_or(Op::Blank, |stmt| stmt.op)
}

/// A call that is made as often as an expression is worth, which is whole; less than once is an alarm.
pub fn so_often(call: Op, times: &Expr, span: Span) -> Op {
    let repeat = Control::Repeat { times: times.clone(), body: vec![Stmt::new(span, call)] };
    let then = vec![Stmt::new(span, Op::Control(Box::new(repeat)))];
    let condition = compared(Binary::GreaterOrEqual, times, 1);
    Op::Control(Box::new(Control::If { condition, then, otherwise: alarm(span) }))
}

fn about(condition: &Expr, wanted: Binary) -> Option<(&Expr, i64)> {
    let Expr::Node(node) = condition else { return None };
    let Node::Binary(operator, a, Expr::Num(number)) = &**node else { return None };
    (*operator == wanted && number.scale == 0).then_some((a, number.mantissa))
}

/// Such a call, if a statement is one.
pub fn computed_call(control: &Control) -> Option<ComputedCall<'_>> {
    let Control::If { condition, then, otherwise } = control else { return None };
    if let Some((times, 1)) = about(condition, Binary::GreaterOrEqual) {
        let [Stmt { op: Op::Control(repeat), .. }] = &then[..] else { return None };
        let Control::Repeat { times: own, body } = &**repeat else { return None };
        let [Stmt { op: Op::Call(call), .. }] = &body[..] else { return None };
        let plain = own == times && call.times == 1 && call.arguments.is_empty() && is_alarm(otherwise);
        return plain.then_some(ComputedCall { number: None, name: Some(&call.name), times: Some(times) });
    }
    let (number, _) = about(condition, Binary::Equal)?;
    let mut decision = (condition, then, otherwise);
    loop {
        let (own, value) = about(decision.0, Binary::Equal)?;
        let [Stmt { op: Op::Call(call), .. }] = &decision.1[..] else { return None };
        let named = call.name.parse() == Ok(value) && call.times == 1 && call.arguments.is_empty();
        if own != number || !named {
            return None;
        }
        if is_alarm(decision.2) {
            return Some(ComputedCall { number: Some(number), name: None, times: None });
        }
        let [Stmt { op: Op::Control(next), .. }] = &decision.2[..] else { return None };
        let Control::If { condition, then, otherwise } = &**next else { return None };
        decision = (condition, then, otherwise);
    }
}
