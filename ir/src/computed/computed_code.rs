//! Codes of which the number is computed when the program runs, such as a mode that a macro restores: branches for one
//! variable, each with the mode of one code, and an alarm after them.
//!
//! Not here: which codes are asked about (the front-end's), and how a control writes such a code.

pub use super::alarm_texts::NO_SUCH_CODE;
use crate::expr::num::Num;
use crate::expr::{Binary, Expr, Node, compared};
use crate::program::{Alarm, Control, Op, Stmt};
use crate::source::Span;

/// Such a code.
#[derive(Clone, Debug)]
pub struct ComputedCode<'c> {
    /// Its number.
    pub number: &'c Expr,
    /// The numbers that it may have, and what each does.
    pub codes: Vec<(i64, &'c Op)>,
}

/// A statement that does what the code of the number says that an expression is worth.
pub fn of_number(number: &Expr, codes: Vec<(i64, Op)>, span: Span) -> Op {
    let alarm = Op::Alarm(Box::new(Alarm { number: None, text: NO_SUCH_CODE.into() }));
    codes.into_iter().rev().fold(alarm, |otherwise, (own, op)| {
        let condition = Expr::Node(Box::new(Node::Binary(Binary::Equal, number.clone(), Expr::int(own))));
        let (then, otherwise) = (vec![Stmt::new(span, op)], vec![Stmt::new(span, otherwise)]);
        Op::Control(Box::new(Control::If { condition, then, otherwise }))
    })
}

/// Takes the alarms of such codes away, but of those that stay one statement.
pub fn without_alarms(body: &mut [Stmt], stays: &dyn Fn(&Control) -> bool) {
    for stmt in body {
        let Op::Control(control) = &mut stmt.op else { continue };
        if computed_code(control).is_none() {
            control.bodies_mut().for_each(|body| without_alarms(body, stays));
        } else if stays(control) {
        } else if let Op::Control(control) = std::mem::replace(&mut stmt.op, Op::Blank) {
            stmt.op = without_alarm(*control);
        }
    }
}

/// The same without the alarm: where no number before the last code's is the value, that one is.
fn without_alarm(control: Control) -> Op {
    let Control::If { condition, mut then, otherwise } = control else {
        return Op::Control(Box::new(control));
    };
    let otherwise: Vec<Stmt> = otherwise
        .into_iter()
        .map(|stmt| match stmt.op {
            Op::Control(next) => Stmt { op: without_alarm(*next), ..stmt },
            _ => stmt,
        })
        .collect();
    match (&otherwise[..], then.pop()) {
        ([behind], Some(mode)) if is_last(&behind.op) => mode.op,
        (_, mode) => {
            then.extend(mode);
            Op::Control(Box::new(Control::If { condition, then, otherwise }))
        }
    }
}

/// Whether a branch is the last of such a code: no value reaches what is after it.
pub fn is_last(op: &Op) -> bool {
    matches!(op, Op::Alarm(alarm) if alarm.number.is_none() && *alarm.text == *NO_SUCH_CODE)
}

/// Such a code, if a statement is one.
pub fn computed_code(control: &Control) -> Option<ComputedCode<'_>> {
    let mut found: Option<ComputedCode<'_>> = None;
    let mut next = control;
    loop {
        let Control::If { condition, then, otherwise } = next else { return None };
        let (number, own) = equal(condition)?;
        let ([mode], [behind]) = (&then[..], &otherwise[..]) else { return None };
        let found = found.get_or_insert_with(|| ComputedCode { number, codes: Vec::new() });
        if found.number != number || own.scale != 0 {
            return None;
        }
        found.codes.push((own.mantissa, &mode.op));
        match &behind.op {
            Op::Control(control) => next = control,
            op if is_last(op) => break,
            _ => return None,
        }
    }
    found
}

/// What a condition compares with a number, as whole numbers are the same: to the least bit, or within a tolerance.
fn equal(condition: &Expr) -> Option<(&Expr, Num)> {
    let Expr::Node(condition) = condition else { return None };
    let Node::Binary(operator, a, Expr::Num(limit)) = &**condition else { return None };
    match (operator, compared(*operator, a, *limit)) {
        (Binary::Equal, _) => Some((a, *limit)),
        (_, Some((Binary::Equal, number, Expr::Num(own)))) => Some((number, *own)),
        _ => None,
    }
}
