//! What the target's words and functions do by themselves: a rounding that ends below its last digit is taken away, a
//! remainder and a rounding up that it has no words for are said by others.

use super::{each_value, expressions};
use crate::arguments;
use crate::canon::{Distance, Units};
use crate::decimals::Decimals;
use crate::diag::{Diagnostic, Fault};
use crate::expr::{Binary, Expr, Function, Node};
use crate::num::{Num, Unit};
use crate::program::{Centre, Coord, Op, Point, Program, Stmt};
use crate::types::Types;

/// A literal that is rounded, as the whole number that it comes to.
pub(super) fn whole(expr: &mut Expr) {
    expr.parts_mut().for_each(whole);
    if let Expr::Node(node) = expr
        && let Node::Call(Function::Round, arguments) = &**node
        && let [Expr::Num(n)] = &arguments[..]
    {
        *expr = Expr::int(n.rounded(0).mantissa);
    }
}

/// A remainder as what it is: what is divided, less the divisor as often as it goes into it; where there are types,
/// one of whole numbers stays.
pub(super) fn remainder(expr: &mut Expr, types: Option<&Types>) {
    let both_whole = match expr {
        Expr::Node(node) => match (&**node, types) {
            (Node::Binary(_, a, b), Some(types)) => types.are_whole(a) && types.are_whole(b),
            _ => false,
        },
        Expr::Num(_) => false,
    };
    expr.parts_mut().for_each(|part| remainder(part, types));
    if let Expr::Node(node) = expr
        && let Node::Binary(Binary::Modulo, a, b) = &**node
        && !both_whole
    {
        let of =
            |operator, a: &Expr, b: &Expr| Expr::Node(Box::new(Node::Binary(operator, a.clone(), b.clone())));
        let quotient = of(Binary::Divide, a, b);
        let often = Expr::Node(Box::new(Node::Call(Function::Truncate, vec![quotient])));
        *expr = of(Binary::Subtract, a, &of(Binary::Multiply, &often, b));
    }
}

/// Rounding away from zero becomes rounding up, which is the same of what is not negative: execution tells whether
/// it is.
pub(super) fn up(program: &mut Program, diags: &mut Vec<Diagnostic>) {
    fn over(expr: &mut Expr, found: &mut bool) {
        if let Expr::Node(node) = expr
            && let Node::Call(function @ Function::RoundUp, _) = &mut **node
        {
            *function = Function::Ceiling;
            *found = true;
        }
        expr.parts_mut().for_each(|part| over(part, found));
    }
    let mut at = None;
    let every = &mut |stmt: &Stmt, expr: &mut Expr| {
        let mut found = false;
        over(expr, &mut found);
        if found && at.is_none() {
            at = Some(stmt.span);
        }
    };
    program.procedures.iter_mut().for_each(|procedure| expressions(&mut procedure.body, every));
    if let Some(at) = at {
        let parameter = "what is rounded up".into();
        let value = "never negative, as in this program".into();
        diags.push(Diagnostic::new(Fault::AssumedParameter { parameter, value }, at));
    }
}

/// Takes away what only says that a word rounds. A length from zero is no further off than half of the target's last
/// digit; what adds up, or counts, or has finer digits there, is rounded as the program says.
pub(super) fn unrounded(body: &mut [Stmt], decimals: u8) {
    for stmt in body {
        if let Op::Control(control) = &mut stmt.op {
            control.bodies_mut().for_each(|body| unrounded(body, decimals));
            continue;
        }
        each_value(&mut stmt.op, &mut |value, from_zero| {
            let Some((inner, digits)) = rounded(value) else { return };
            if from_zero && digits >= decimals {
                *value = inner;
            } else if digits > 0 {
                let by = || Expr::Num(Num::int(10i64.pow(u32::from(digits.min(9))), Unit::One));
                let up = Expr::Node(Box::new(Node::Binary(Binary::Multiply, inner, by())));
                let whole = Expr::Node(Box::new(Node::Call(Function::Round, vec![up])));
                *value = Expr::Node(Box::new(Node::Binary(Binary::Divide, whole, by())));
            }
        });
    }
}

/// What is rounded to some digits, and to how many.
fn rounded(value: &Expr) -> Option<(Expr, u8)> {
    let Expr::Node(node) = value else { return None };
    match &**node {
        Node::Call(Function::RoundTo, arguments) => match &arguments[..] {
            [inner, to] => Some((inner.clone(), u8::try_from(to.literal()?.whole()?).ok()?)),
            _ => None,
        },
        _ => None,
    }
}

/// Says that lengths from zero are rounded, where the target's words do that by themselves and the source's do not:
/// they are no further off than half of the target's last digit. `increments` are the digits in mm, or degrees, and in
/// inches. Of frames only those are, which have no more digits than that: what they move is rounded once more. What adds
/// up, or counts, stays as it is, and so do all where a program goes from one unit to the other.
pub(super) fn rounds(program: &mut Program, increments: [u8; 2]) {
    let mut said = (false, false, false);
    for procedure in &program.procedures {
        modes(&procedure.body, &mut said);
    }
    let (mm, inch, incremental) = said;
    let inch = inch || program.assumed.units == Some(Units::Inch);
    if mm && inch {
        return;
    }
    let digits = [increments[usize::from(inch)], increments[0]];
    let mut decimals = Decimals::of(program);
    for (at, procedure) in program.procedures.iter_mut().enumerate() {
        decimals.within(at);
        round_in(&mut procedure.body, digits, incremental, &decimals);
    }
}

/// Whether a body says mm, inches, and incremental words.
fn modes(body: &[Stmt], said: &mut (bool, bool, bool)) {
    for stmt in body {
        match &stmt.op {
            Op::UseLengthUnits(Units::Mm) => said.0 = true,
            Op::UseLengthUnits(Units::Inch) => said.1 = true,
            Op::SetDistanceMode(Distance::Incremental) => said.2 = true,
            Op::Control(control) => control.bodies().for_each(|body| modes(body, said)),
            _ => {}
        }
    }
}

fn round_in(body: &mut [Stmt], digits: [u8; 2], incremental: bool, decimals: &Decimals) {
    let round = |value: &mut Expr, digits: u8| {
        if matches!(value, Expr::Node(_)) && rounded(value).is_none() {
            let own = std::mem::replace(value, Expr::int(0));
            *value = Expr::Node(Box::new(Node::Call(Function::RoundTo, vec![own, Expr::int(digits.into())])));
        }
    };
    // What the word in force is, nothing in the program makes incremental.
    let from_zero = |word: &Coord| match word.distance.known() {
        Some(distance) => distance == Distance::Absolute,
        None => !incremental,
    };
    let point = |to: &mut Point| {
        for (axis, word) in to.axes.iter_mut().enumerate() {
            if let Some(word) = word.as_mut().filter(|word| from_zero(word)) {
                round(&mut word.value, digits[usize::from(axis > 2)]);
            }
        }
    };
    for stmt in body {
        match &mut stmt.op {
            Op::StraightTraverse(to) | Op::StraightFeed(to) | Op::Position(to) | Op::Hole(to) => {
                point(&mut to.to)
            }
            Op::ArcFeed(arc) => {
                point(&mut arc.to);
                match &mut arc.centre {
                    Centre::Point { words, .. } => {
                        words.iter_mut().flatten().for_each(|word| round(word, digits[0]));
                    }
                    Centre::Radius(radius) => round(radius, digits[0]),
                }
            }
            Op::StartCycle(cycle) => {
                let planes = [Some(&mut cycle.retract), Some(&mut cycle.depth), cycle.return_plane.as_mut()];
                for plane in planes.into_iter().flatten().filter(|plane| from_zero(plane)) {
                    round(&mut plane.value, digits[0]);
                }
            }
            op @ (Op::SetFrame(_) | Op::SetSlot(_) | Op::SetPosition(_)) => {
                let all = arguments::each(op, &mut |argument, unit| {
                    let digits = digits[usize::from(unit == Unit::Degree)];
                    if let Some(value) = argument.expr()
                        && decimals.digits(value).is_some_and(|own| own <= digits)
                    {
                        let mut value = value.clone();
                        round(&mut value, digits);
                        argument.set(value);
                    }
                    Ok::<(), std::convert::Infallible>(())
                });
                all.unwrap_or_else(|never| match never {});
            }
            Op::Control(control) => {
                control.bodies_mut().for_each(|body| round_in(body, digits, incremental, decimals));
            }
            _ => {}
        }
    }
}
