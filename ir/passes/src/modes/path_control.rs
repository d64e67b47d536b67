//! `path-control`: legalises path modes (exact stop, path blending) and advice to the control.
//!
//! ```text
//! G64 P0.02 (LinuxCNC)     G64                           a target without a tolerance: plain blending
//! G09 G01 X10.             G61, G01 X10., G64            a target without an exact stop of one move
//! ```
//!
//! An exact path becomes an exact stop. An exact stop of one move needs a known mode before it. The pass leaves out a mode
//! that is always active on the target, and reports it. It leaves out advice that the target lacks, and reports each kind
//! once. Not here: a mode that the target lacks otherwise; its writer refuses it.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::PATH;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, rebuild};
use crate::target::Target;
use ncc_ir::canon::{AdviceKind, PathMode};
use ncc_ir::caps::Caps;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::ModesLack;
use ncc_ir::program::arguments;
use ncc_ir::program::kinds::{flow, moves};
use ncc_ir::program::{Op, PathControl, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "path-control",
    about: "replaces path modes and advice to the control by those of the target",
    alone: Some(run),
    step: Step::at(
        Moment::Placing,
        |_, p| p.needs(PATH),
        |l, p| convert_path_control(p.stmts, l.states.state_mut::<PathControlState>(), &l.target, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// The state of the pass between two pieces of a program.
#[derive(Clone, Debug, Default)]
pub(crate) struct PathControlState {
    /// The last mode that the program has set.
    said: Option<PathControl>,
    /// The mode to restore after the next move, and whether that move has passed.
    again: Option<(PathControl, bool)>,
    /// Reported kinds of advice, then modes: a bit each.
    reported: u64,
}

impl PathControlState {
    /// Whether a mode must be restored.
    pub(crate) fn is_busy(&self) -> bool {
        self.again.is_some()
    }

    /// Forgets the active mode: at the start of a procedure it is not known.
    pub(crate) fn start_over(&mut self) {
        (self.said, self.again) = (None, None);
    }

    fn first_time(&mut self, bit: u32) -> bool {
        let fresh = self.reported >> bit & 1 == 0;
        self.reported |= 1 << bit;
        fresh
    }
}

/// Legalises the modes and advice of a whole program.
pub(crate) fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    let mut state = PathControlState::default();
    each_body(program, entry, |body, _| {
        state.start_over();
        convert_path_control(body, &mut state, target, diags);
    });
}

/// The same for one piece of a body.
pub(crate) fn convert_path_control(
    body: &mut Vec<Stmt>,
    state: &mut PathControlState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    let caps = &target.caps;
    rebuild(body, |stmt: Stmt, made: &mut Rebuild| {
        if !stmt.joined
            && let Some((control, _)) = state.again.take_if(|(_, moved)| *moved)
        {
            let op = Op::SetMotionControlMode(Box::new(control));
            made.push(Stmt { skip: stmt.skip, ..Stmt::new(stmt.span, op) });
        }
        match &stmt.op {
            Op::SetMotionControlMode(control) => {
                let control = legal_path_mode(control, caps, stmt.span, state, diags);
                state.again = None;
                state.said = stmt.skip.is_none().then(|| control.clone());
                let freely = control.mode == PathMode::Continuous && caps.modes.rounds_freely;
                if freely && target.corners_bounded && state.first_time(34) {
                    diags.push(Diagnostic::new(Fault::RoundsFreely, stmt.span));
                }
                if caps.modes.only_path == Some(control.mode) && !caps.says_path(control.mode) {
                    if state.first_time(32) {
                        let path = control.mode.name().into();
                        diags.push(Diagnostic::new(Fault::AssumedPath { path }, stmt.span));
                    }
                    return made.leave_out(stmt);
                }
                made.push(Stmt { op: Op::SetMotionControlMode(Box::new(control)), ..stmt });
            }
            Op::ExactStop if !caps.moves.exact_stop && caps.says_path(PathMode::ExactStop) => {
                match &state.said {
                    // What is computed may be something else after it.
                    Some(control)
                        if !arguments::computed(&Op::SetMotionControlMode(Box::new(control.clone()))) =>
                    {
                        if control.mode != PathMode::ExactStop {
                            state.again = Some((control.clone(), false));
                        }
                        let stop = PathControl::plain(PathMode::ExactStop);
                        made.push(Stmt { op: Op::SetMotionControlMode(Box::new(stop)), ..stmt });
                    }
                    _ => {
                        diags.push(Diagnostic::new(Fault::lacks(ModesLack::ExactStopModeUnknown), stmt.span));
                        made.leave_out(stmt);
                    }
                }
            }
            Op::Advise(advice) if !caps.advises(advice.kind, advice.value) => {
                // What F counts on arcs is compared where one is cut.
                if advice.kind != AdviceKind::CompensatedFeed && state.first_time(advice.kind as u32) {
                    let kind = advice.kind.name().into();
                    diags.push(Diagnostic::new(Fault::AdviceLeftOut { kind }, stmt.span));
                }
                made.leave_out(stmt);
            }
            flow!() => {
                state.said = None;
                made.push(stmt);
            }
            moves!() | Op::Position(_) => {
                if let Some((_, moved)) = &mut state.again {
                    *moved = true;
                }
                made.push(stmt);
            }
            _ => made.push(stmt),
        }
    });
}

/// The nearest mode that the target has; reports what is lost.
fn legal_path_mode(
    control: &PathControl,
    caps: &Caps,
    at: Span,
    state: &mut PathControlState,
    diags: &mut Vec<Diagnostic>,
) -> PathControl {
    let mut own = control.clone();
    if !caps.says_path(own.mode) {
        let plain = match own.mode.plain() {
            PathMode::ExactPath if !caps.says_path(PathMode::ExactPath) => PathMode::ExactStop,
            mode => mode,
        };
        own = PathControl::plain(plain);
    }
    if own.rapids.is_some() && !caps.modes.path_in_rapids {
        own.rapids = None;
    }
    if let Some(merged) = own.merged.take_if(|_| !caps.modes.path_merges)
        && own.within.as_ref() != Some(&merged)
        && state.first_time(33)
    {
        diags.push(Diagnostic::new(Fault::AdviceLeftOut { kind: "moves-made-one".into() }, at));
    }
    if (own.mode, &own.within, &own.rapids) != (control.mode, &control.within, &control.rapids)
        && state.first_time(40 + control.mode as u32)
    {
        let (from, to) = (control.mode.name().into(), own.mode.name().into());
        diags.push(Diagnostic::new(Fault::PathRelaxed { from, to }, at));
    }
    own
}
