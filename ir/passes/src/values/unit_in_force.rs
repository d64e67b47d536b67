//! Values of the control that count in a stated unit, in a program that has no other active: they count in the active one,
//! as on controls that know no other; and the other way about, for a target that knows them in a stated unit alone.

use ncc_ir::canon::Units;
use ncc_ir::computed::computes::Computes;
use ncc_ir::expr::system::System;
use ncc_ir::expr::units::Said;
use ncc_ir::expr::{Expr, Node, Var};
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Op, Program, Stmt};

use crate::pass::Pass;
use crate::values::variables::expressions;

/// This pass.
pub(crate) const PASS: Pass = Pass::parametric(
    "unit-in-force",
    "states values that count in the active unit",
    |own, _| own.others,
    |program, own, _| run(program, own.target),
);

/// Says them so.
pub fn run(program: &mut Program, target: &Computes) {
    let Some(unit) = only(program) else { return };
    for procedure in &mut program.procedures {
        expressions(&mut procedure.body, &mut |_, value| said(value, unit, target));
    }
}

/// The unit that is active wherever something is asked of the control; `None` if there are several, or some may be
/// asked before any is stated.
fn only(program: &Program) -> Option<Units> {
    let main = &program.procedures.first()?.body;
    let head = main.iter().take_while(|stmt| !matches!(stmt.op, flow!()));
    let first = head.into_iter().find_map(|stmt| match stmt.op {
        Op::UseLengthUnits(unit) => Some(unit),
        _ => None,
    });
    let unit = program.assumed.units.or(first)?;
    let same = Said::by(program).only() == Some(unit);
    // Before the first word of units nothing is asked that is not asked after it, too: a unit that was assumed
    // is that of the whole head.
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

fn said(value: &mut Expr, in_force: Units, target: &Computes) {
    if let Expr::Node(node) = value
        && let Node::Var(Var::System(system)) = &mut **node
    {
        let mut other = system.clone();
        if let System::WorkOffset { unit, .. }
        | System::OriginShift { unit, .. }
        | System::TableOffset { unit, .. }
        | System::TableDiameter { unit } = &mut other
        {
            let stated = unit.is_some();
            *unit = match *unit {
                None => Some(in_force),
                Some(own) if own == in_force => None,
                Some(own) => Some(own),
            };
            if stated || !target.system.contains(system) && target.system.contains(&other) {
                *system = other;
            }
        }
    }
    value.parts_mut().for_each(|part| said(part, in_force, target));
}
