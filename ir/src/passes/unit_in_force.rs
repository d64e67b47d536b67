//! Values of the control that count in a stated unit, in a program that has no other in force: they count in the one in
//! force, as on controls that know no other.

use crate::canon::Units;
use crate::expr::{Expr, Node, Var};
use crate::kinds::flow;
use crate::program::{Op, Program, Stmt};
use crate::system::System;
use crate::units::Said;

use super::variables::expressions;

/// Says them so.
pub fn run(program: &mut Program) {
    let Some(unit) = only(program) else { return };
    for procedure in &mut program.procedures {
        expressions(&mut procedure.body, &mut |_, value| plain(value, unit));
    }
}

/// The unit that is in force wherever something is asked of the control; `None` if there are several, or some may be
/// asked before any is said.
fn only(program: &Program) -> Option<Units> {
    let main = &program.procedures.first()?.body;
    let head = main.iter().take_while(|stmt| !matches!(stmt.op, flow!()));
    let first = head.into_iter().find_map(|stmt| match stmt.op {
        Op::UseLengthUnits(unit) => Some(unit),
        _ => None,
    });
    let unit = program.assumed.units.or(first)?;
    let same = Said::by(program).only() == Some(unit);
    // Before the first word of units nothing is asked that is not asked behind it, too: a unit that was taken for
    // granted is that of the whole head.
    let early = program.assumed.units.is_none()
        && main.iter().take_while(|stmt| !matches!(stmt.op, Op::UseLengthUnits(_))).any(asks);
    (same && !early).then_some(unit)
}

fn asks(stmt: &Stmt) -> bool {
    let mut found = false;
    expressions(&mut [stmt.clone()], &mut |_, value| {
        found |= value.has(&|node| matches!(node, Node::Var(Var::System(_))));
    });
    found
}

fn plain(value: &mut Expr, in_force: Units) {
    if let Expr::Node(node) = value
        && let Node::Var(Var::System(system)) = &mut **node
    {
        match system {
            System::WorkOffset { unit, .. }
            | System::OriginShift { unit, .. }
            | System::TableOffset { unit, .. }
            | System::TableDiameter { unit }
                if *unit == Some(in_force) =>
            {
                *unit = None;
            }
            _ => {}
        }
    }
    value.parts_mut().for_each(|part| plain(part, in_force));
}
