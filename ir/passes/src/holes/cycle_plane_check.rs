//! `planes_checked`: whether a cycle's computed planes lie one above the other is left to the cycle itself, for a target
//! whose cycles end the program by the same alarm.
//!
//! The check stands before the cycle's call, as the source's own control makes it. It is taken away where it asks for
//! just what the target's cycle will; one that asks for more stays.

use crate::pass::Pass;
use ncc_ir::expr::num::Num;
use ncc_ir::expr::{Binary, Expr, Node};
use ncc_ir::program::cycle::{Cycle, CycleKind};
use ncc_ir::program::{Control, Coord, Op, Program, Stmt};

/// This pass.
pub(crate) const PASS: Pass = Pass::parametric(
    "planes-checked",
    "checks the planes of computed cycles in the program, as the source's control does",
    |own, _| own.target.planes_alarm.is_some(),
    |program, own, _| {
        if let Some(alarm) = own.target.planes_alarm {
            run(program, alarm, own.digits.decimals);
        }
    },
);

/// Takes checks away that the target's cycles make. `alarm` is theirs; `decimals` are the digits with which it states
/// how far one plane is above the other.
pub fn run(program: &mut Program, alarm: i64, decimals: u8) {
    for procedure in &mut program.procedures {
        drop_plane_checks(&mut procedure.body, alarm, decimals);
    }
}

fn drop_plane_checks(body: &mut Vec<Stmt>, alarm: i64, decimals: u8) {
    for stmt in body.iter_mut() {
        if let Op::Control(control) = &mut stmt.op {
            control.bodies_mut().for_each(|body| drop_plane_checks(body, alarm, decimals));
        }
    }
    let mut at = 0;
    while at + 1 < body.len() {
        if is_made_by(&body[at], &body[at + 1..], alarm, decimals) {
            let check = body.remove(at);
            let call = &mut body[at];
            (call.joined, call.number) = (check.joined, call.number.or(check.number));
        }
        at += 1;
    }
}

/// Whether a statement is the check of the cycle that is activated after it in its block.
fn is_made_by(check: &Stmt, rest: &[Stmt], alarm: i64, decimals: u8) -> bool {
    let Op::Control(control) = &check.op else { return false };
    let Control::If { condition, then, otherwise } = &**control else { return false };
    let [Stmt { op: Op::Alarm(given), .. }] = &then[..] else { return false };
    let number = given.number.as_ref().and_then(Expr::literal).and_then(Num::whole_number);
    let mut of_block = rest.iter().take_while(|stmt| stmt.joined && stmt.skip == check.skip);
    // A rigid tap's speed is stated before its call.
    let call = of_block.find(|stmt| !matches!(stmt.op, Op::SetSpindleSpeed(_)));
    let Some(Stmt { op: Op::StartCycle(cycle), .. }) = call else { return false };
    number == Some(alarm)
        && otherwise.is_empty()
        && check.comment.is_none()
        && asks(cycle, condition, decimals)
}

/// Whether a condition is that of a cycle's planes: the return plane below the reference plane or this below the
/// depth; of pecks besides the first one below the depth, or none.
fn asks(cycle: &Cycle, condition: &Expr, decimals: u8) -> bool {
    let Some(back) = &cycle.return_plane else { return false };
    let apart = cycle.reference.as_ref().is_none_or(|plane| sum_of(&cycle.retract, plane, decimals));
    let reference = cycle.reference.as_ref().unwrap_or(&cycle.retract).value.operand();
    let [back, depth] = [back, &cycle.depth].map(|plane| plane.value.operand());
    let binary = |op, a: &Expr, b: &Expr| Expr::binary(op, a.clone(), b.clone());
    let less = |a: &Expr, b: &Expr| binary(Binary::Less, a, b);
    let planes = binary(Binary::Or, &less(&back, &reference), &less(&reference, &depth));
    let asked = match &cycle.kind {
        CycleKind::DrillPeck { peck, .. } | CycleKind::DrillBreak { peck, .. } => {
            let Some(first) = first_depth(condition) else { return false };
            // The peck is stated by the depth of the first one, or that by the peck.
            let peck = peck.operand();
            let by = |a: &Expr, b: &Expr| same(&reference.minus(a), b);
            if !by(first, &peck) && !by(&peck, first) {
                return false;
            }
            let none = binary(Binary::LessOrEqual, &reference, first);
            binary(Binary::Or, &binary(Binary::Or, &planes, &less(first, &depth)), &none)
        }
        _ => planes,
    };
    apart && asked == *condition
}

/// The depth of the first peck, which the last part of a check compares.
fn first_depth(condition: &Expr) -> Option<&Expr> {
    let Expr::Node(node) = condition else { return None };
    let Node::Binary(Binary::Or, _, Expr::Node(last)) = &**node else { return None };
    match &**last {
        Node::Binary(Binary::LessOrEqual, _, first) => Some(first),
        _ => None,
    }
}

/// Whether a plane is stated as another one and a number, which the target can state.
fn sum_of(plane: &Coord, reference: &Coord, decimals: u8) -> bool {
    let few = |num: Num| num.trimmed().scale <= decimals;
    match (&plane.value, &reference.value) {
        (Expr::Num(a), Expr::Num(b)) => few(*a) && few(*b),
        (Expr::Node(node), reference) => matches!(
            &**node,
            Node::Binary(Binary::Add, of, Expr::Num(by)) if few(*by) && *of == reference.operand()
        ),
        (Expr::Num(_), Expr::Node(_)) => false,
    }
}

/// Whether two values are said alike; of a number its value counts.
fn same(a: &Expr, b: &Expr) -> bool {
    let digits = |num: Num| (num.trimmed().mantissa, num.trimmed().scale);
    match (a.literal(), b.literal()) {
        (Some(a), Some(b)) => digits(a) == digits(b),
        _ => a == b,
    }
}
