//! `state-clearance`: what one control leaves to a parameter of a cycle, another states.
//!
//! The parameter's value is assumed and reported. Where it is not known the cycle stays as it
//! is, for another pass to refuse. It is stated in the unit of length active.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::CYCLE;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::rounded;
use crate::target::Target;
use ncc_ir::canon::Units;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::{Clearance, CycleKind};
use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "state-clearance",
    about: "states what one control leaves to a parameter of a cycle",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(CYCLE),
        |l, p| state_clearance(p.stmts, p.start.clone(), &l.target, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// States them.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| state_clearance(body, walk.clone(), target, diags));
}

/// The same for one body.
pub(crate) fn state_clearance(
    body: &mut [Stmt],
    mut walk: Walk,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    for stmt in body {
        walk.enter(stmt.skip);
        walk.step(stmt);
        let Op::StartCycle(cycle) = &mut stmt.op else { continue };
        let kind = cycle.kind.name();
        let states = target.caps.holes.cycles.iter().any(|c| c.kind == kind && c.clearance && !c.parameter);
        if !states {
            continue;
        }
        let (clearance, value, is_peck) = match &mut cycle.kind {
            CycleKind::DrillPeck { clearance, .. } => (clearance, target.peck_clearance, true),
            CycleKind::DrillBreak { lift, .. } => (lift, target.break_lift, false),
            CycleKind::Drill
            | CycleKind::DrillDwell { .. }
            | CycleKind::Bore { .. }
            | CycleKind::Tap(_)
            | CycleKind::FineBore(_)
            | CycleKind::BoreStop(_) => continue,
        };
        if let (Clearance::Parameter, Some(value)) = (&clearance, value) {
            *clearance = Clearance::Stated(in_unit(value, walk.at.modes.units, target).into());
            diags.push(Diagnostic::new(reported(is_peck, value), stmt.span));
        }
    }
}

/// A value in millimetres as it is stated where this unit is active.
fn in_unit(value: Num, units: Option<Units>, target: &Target) -> Num {
    match (units, value.nanos(false)) {
        (Some(Units::Inch), Some(nanos)) => rounded(nanos, target.decimals_in(Unit::Inch), Unit::Inch),
        _ => value,
    }
}

/// What is reported of a parameter that was assumed.
fn reported(is_peck: bool, value: Num) -> Fault {
    let length = (value.nanos(false).unwrap_or(0) as f64 / 1e9).to_string().into();
    let fact = match is_peck {
        true => ControlFact::PeckClearance { length },
        false => ControlFact::BreakLift { length },
    };
    Fault::AssumedFact { fact }
}
