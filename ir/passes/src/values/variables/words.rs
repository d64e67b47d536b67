//! What the target's words and functions do by themselves: a rounding that ends below its least increment is taken away, a
//! rounding up that it lacks is stated by another.

use std::cell::Cell;

use crate::values::variables::{each_value, expressions};
use ncc_ir::canon::Distance;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::decimals::Decimals;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::units::Said;
use ncc_ir::expr::{Binary, Expr, Function, Node, Target};
use ncc_ir::program::arguments;
use ncc_ir::program::{Centre, Coord, Op, Point, Program, Stmt, Type};
use ncc_ir::source::Span;

/// A literal that is rounded, as its whole number.
pub(super) fn round_literal(expr: &mut Expr) {
    expr.parts_mut().for_each(round_literal);
    if let Expr::Node(node) = expr
        && let Node::Call(Function::Round, arguments) = &**node
        && let [Expr::Num(n)] = &arguments[..]
    {
        *expr = Expr::int(n.rounded(0).mantissa);
    }
}

/// Rounding away from zero becomes rounding up, which is the same of what is not negative: execution tells whether
/// it is.
pub(super) fn up(program: &mut Program, diags: &mut Vec<Diagnostic>) {
    fn round_up(expr: &mut Expr, found: &mut bool) {
        if let Expr::Node(node) = expr
            && let Node::Call(function @ Function::RoundUp, _) = &mut **node
        {
            *function = Function::Ceiling;
            *found = true;
        }
        expr.parts_mut().for_each(|part| round_up(part, found));
    }
    let mut at = None;
    let every = &mut |stmt: &Stmt, expr: &mut Expr| {
        let mut found = false;
        round_up(expr, &mut found);
        if found && at.is_none() {
            at = Some(stmt.span);
        }
    };
    program.procedures.iter_mut().for_each(|procedure| expressions(&mut procedure.body, every));
    if let Some(at) = at {
        diags.push(Diagnostic::new(Fault::AssumedFact { fact: ControlFact::RoundedUp }, at));
    }
}

/// Takes away what only says that a word rounds. A length from zero is no further off than half the target's least increment;
/// what adds up, or counts, or has finer digits there, is rounded as the program says.
pub(super) fn unrounded(body: &mut [Stmt], decimals: u8) {
    for stmt in body {
        if let Op::Control(control) = &mut stmt.op {
            control.bodies_mut().for_each(|body| unrounded(body, decimals));
            continue;
        }
        each_value(&mut stmt.op, &mut |value, from_zero| {
            match rounded(value) {
                Some(_) => value.parts_mut().for_each(in_whole_steps),
                None => return in_whole_steps(value),
            }
            let Some((inner, digits)) = rounded(value) else { return };
            if from_zero && digits >= decimals {
                *value = inner;
            } else if digits > 0 {
                *value = in_steps(inner, digits);
            }
        });
    }
}

/// Rounding to some digits within an expression, by rounding to whole numbers; what names a variable is whole anyway.
fn in_whole_steps(e: &mut Expr) {
    if matches!(e, Expr::Node(node) if matches!(**node, Node::Element(_))) {
        return;
    }
    e.parts_mut().for_each(in_whole_steps);
    if let Some((inner, digits @ 1..)) = rounded(e) {
        *e = in_steps(inner, digits);
    }
}

/// A value rounded to some digits, as so many steps of the last of them.
fn in_steps(value: Expr, digits: u8) -> Expr {
    let by = || Expr::Num(Num::int(10i64.pow(u32::from(digits.min(9))), Unit::One));
    let up = Expr::binary(Binary::Multiply, value, by());
    let whole = Expr::Node(Box::new(Node::Call(Function::Round, vec![up])));
    Expr::binary(Binary::Divide, whole, by())
}

/// What is rounded to some digits, and to how many.
pub(crate) fn rounded(value: &Expr) -> Option<(Expr, u8)> {
    let Expr::Node(node) = value else { return None };
    match &**node {
        Node::Call(Function::RoundTo, arguments) => match &arguments[..] {
            [inner, to] => Some((inner.clone(), u8::try_from(to.literal()?.whole_number()?).ok()?)),
            _ => None,
        },
        _ => None,
    }
}

/// Says that lengths are rounded, where the target's words do that by themselves and the source's do not: those from
/// zero are no further off than half the target's least increment. `increments` are the digits in mm, or degrees, and in
/// inches. What adds up is the same where it has no more digits than that; where it may have more, that the roundings
/// give nothing is assumed and reported: execution tells whether it is so. Of frames and of values
/// for tables only those are, which have no more digits: what they move is rounded once more. Speeds and what counts must be whole anyway. Lengths stay as they
/// are where a program goes from one unit to the other.
pub(super) fn rounds(program: &mut Program, increments: [u8; 2], diags: &mut Vec<Diagnostic>) {
    let mut decimals = Decimals::from_program(program);
    let whole = whole_arguments(program);
    for (at, procedure) in program.procedures.iter_mut().enumerate() {
        decimals.within(at);
        each_op(&mut procedure.body, &mut |stmt| {
            if let Op::SetSpindleSpeed(value) | Op::LimitSpindleSpeed(value) = &mut stmt.op
                && (decimals.is_whole(value) || at == 0 && whole.contains(value))
            {
                round(value, 0);
            }
        });
    }
    let Some(inch) = inches(program) else { return };
    let digits = [increments[usize::from(inch)], increments[0]];
    let incremental = program.procedures.iter().any(|procedure| says_incremental(&procedure.body));
    let mut adds_up = None;
    for (at, procedure) in program.procedures.iter_mut().enumerate() {
        decimals.within(at);
        round_in(&mut procedure.body, digits, incremental, &decimals, &mut adds_up);
    }
    if let Some(at) = adds_up {
        diags.push(Diagnostic::new(Fault::AssumedFact { fact: ControlFact::RoundedIncrements }, at));
    }
}

/// Parameters of the main program that are whole numbers and stay what they are: whoever calls it gives such.
fn whole_arguments(program: &mut Program) -> Vec<Expr> {
    let Some(main) = program.procedures.first_mut() else { return Vec::new() };
    let own = main.parameters.iter().zip(&main.kinds).filter(|(_, kind)| **kind == Type::Int);
    let mut whole: Vec<Expr> = own.map(|(var, _)| Expr::Node(Box::new(Node::Var(var.clone())))).collect();
    each_op(&mut main.body, &mut |stmt| {
        if let Op::Assign(Target::Var(var), _) = &stmt.op {
            whole.retain(|own| !matches!(own, Expr::Node(node) if **node == Node::Var(var.clone())));
        }
    });
    whole
}

/// Whether all lengths of a program are in inches; `None` where it goes from one unit to the other.
pub(crate) fn inches(program: &Program) -> Option<bool> {
    let said = Said::by(program);
    (!(said.mm && said.inch)).then_some(said.inch)
}

/// The digits that a target has for lengths.
#[derive(Clone, Copy, Debug, Default)]
pub struct Fineness {
    /// Of what is written, in mm and in inches.
    pub written: [u8; 2],
    /// Of what is computed, in mm and in inches; none where its words do not round.
    pub computed: Option<[u8; 2]>,
}

/// Rounds what moves the tool as the target does, each word by itself. Whether anything is.
pub(crate) fn as_rounded(program: &mut Program, fineness: Fineness) -> bool {
    let Some(inch) = inches(program) else { return false };
    let of = |digits: [u8; 2]| [digits[usize::from(inch)], digits[0]];
    let (written, computed) = (of(fineness.written), fineness.computed.map(of));
    let mut any = false;
    let mut over = |stmt: &mut Stmt| {
        let (Op::StraightTraverse(to) | Op::StraightFeed(to) | Op::Position(to) | Op::Hole(to)) =
            &mut stmt.op
        else {
            return;
        };
        for (axis, word) in to.to.axes.iter_mut().enumerate() {
            let Some(word) = word else { continue };
            let turns = usize::from(axis > 2);
            match (&mut word.value, computed) {
                (Expr::Num(n), _) if n.trimmed().scale > written[turns] => {
                    *n = n.rounded(written[turns]);
                    any = true;
                }
                (value @ Expr::Node(_), Some(digits)) if rounded(value).is_none() => {
                    round(value, digits[turns]);
                    any = true;
                }
                _ => {}
            }
        }
    };
    program.procedures.iter_mut().for_each(|procedure| each_op(&mut procedure.body, &mut over));
    any
}

/// Says that times are rounded, where the target's words do that by themselves, to so many digits: no wait is further off
/// than half of the last. What another control's word rounds to milliseconds is the same, divided first.
pub(super) fn waits(program: &mut Program, digits: u8) {
    let over = |stmt: &mut Stmt| {
        let Op::Dwell(value) = &mut stmt.op else { return };
        if let Expr::Node(node) = &mut *value
            && let Node::Binary(Binary::Divide, a, by) = &mut **node
            && digits == 3
            && *by == Expr::int(1000)
            && let Some((inner, 0)) = rounded(a)
        {
            *a = inner;
        }
        round(value, digits);
    };
    program.procedures.iter_mut().for_each(|procedure| each_op(&mut procedure.body, &mut |stmt| over(stmt)));
}

/// Shows every statement of a body and of the bodies in it.
fn each_op(body: &mut [Stmt], seen: &mut dyn FnMut(&mut Stmt)) {
    for stmt in body {
        if let Op::Control(control) = &mut stmt.op {
            control.bodies_mut().for_each(|body| each_op(body, seen));
        }
        seen(stmt);
    }
}

/// Says that a computed value is rounded, if nothing says so yet.
pub(crate) fn round(value: &mut Expr, digits: u8) {
    if matches!(value, Expr::Node(_)) && rounded(value).is_none() {
        let own = std::mem::replace(value, Expr::int(0));
        *value = Expr::Node(Box::new(Node::Call(Function::RoundTo, vec![own, Expr::int(digits.into())])));
    }
}

/// Whether a body says that words are incremental.
fn says_incremental(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::SetDistanceMode(distance) => *distance == Distance::Incremental,
        Op::Control(control) => control.bodies().any(|body| says_incremental(body)),
        _ => false,
    })
}

fn round_in(
    body: &mut [Stmt],
    digits: [u8; 2],
    incremental: bool,
    decimals: &Decimals,
    adds_up: &mut Option<Span>,
) {
    // What the active word is, nothing in the program makes incremental.
    let from_zero = |word: &Coord| match word.distance.known() {
        Some(distance) => distance == Distance::Absolute,
        None => !incremental,
    };
    let fine = |word: &Coord, digits: u8| decimals.digits(&word.value).is_none_or(|own| own > digits);
    let further = Cell::new(false);
    let point = |to: &mut Point| {
        for (axis, word) in to.axes.iter_mut().enumerate() {
            let Some(word) = word else { continue };
            let digits = digits[usize::from(axis > 2)];
            if matches!(word.value, Expr::Node(_)) && rounded(&word.value).is_none() {
                further.set(further.get() || !from_zero(word) && fine(word, digits));
                round(&mut word.value, digits);
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
                let planes = [&mut cycle.retract, &mut cycle.depth].into_iter();
                for plane in planes.chain(&mut cycle.reference).chain(&mut cycle.return_plane) {
                    if !from_zero(plane) && fine(plane, digits[0]) {
                        continue;
                    }
                    round(&mut plane.value, digits[0]);
                }
            }
            op @ (Op::SetFrame(_) | Op::SetSlot(_) | Op::SetPosition(_) | Op::SetData(_)) => {
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
                let bodies = control.bodies_mut();
                bodies.for_each(|body| round_in(body, digits, incremental, decimals, adds_up));
            }
            _ => {}
        }
        if further.take() && adds_up.is_none() {
            *adds_up = Some(stmt.span);
        }
    }
}
