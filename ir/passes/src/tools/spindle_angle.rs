//! `spindle-angle`: oriented spindle stop, on the target's machine.
//!
//! Where the zero of the angle is, is a matter of each machine: that it is in one place on both is assumed and reported.
//! Where the target has no stop at an angle of its own, the angle must be stated: that of the
//! source's control, if its profile says it.

use crate::pass::{Moment, Pass, Step};
use crate::target::Target;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::lack::SpindleLack;
use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "spindle-angle",
    about: "states the angle at which the spindle stops where the target needs it",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |_, _| true,
        |l, p| stop_at_angle(p.stmts, l.states.state_mut::<SpindleAngleState>(), &l.target, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// What has been reported.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SpindleAngleState {
    zero: bool,
    own: bool,
}

/// States angles where they need to be stated.
pub(crate) fn run(program: &mut Program, target: &Target, _: &Tracker, diags: &mut Vec<Diagnostic>) {
    let mut state = SpindleAngleState::default();
    for procedure in &mut program.procedures {
        stop_at_angle(&mut procedure.body, &mut state, target, diags);
    }
}

/// The same for one piece of a body.
pub(crate) fn stop_at_angle(
    stmts: &mut [Stmt],
    state: &mut SpindleAngleState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    for stmt in stmts {
        let Op::OrientSpindle(angle) = &mut stmt.op else { continue };
        if angle.is_none() && !target.caps.moves.own_stop {
            let Some(own) = target.orientation else {
                diags.push(Diagnostic::new(Fault::lacks(SpindleLack::OwnAngle), stmt.span));
                continue;
            };
            *angle = Some(Expr::Num(own));
            if !std::mem::replace(&mut state.own, true) {
                let degrees = own.nanos(false).unwrap_or(0) as f64 / 1e9;
                let assumption = ControlFact::Orientation { degrees: degrees.to_string().into() };
                diags.push(Diagnostic::new(Fault::AssumedFact { fact: assumption }, stmt.span));
            }
        }
        if angle.is_some() && target.other_control && !std::mem::replace(&mut state.zero, true) {
            let assumption = ControlFact::SpindleZero;
            diags.push(Diagnostic::new(Fault::AssumedFact { fact: assumption }, stmt.span));
        }
    }
}
