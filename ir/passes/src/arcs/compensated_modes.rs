//! Codes that the target refuses while cutter radius compensation is on.
//!
//! A path mode, a return level or a work offset that is active already is left out. `G41 D1 G64` becomes two blocks
//! where the target would take G64 after G41. Anything else is refused at its block: it cannot be moved without another
//! cut.
//!
//! Not here: what every control refuses there, and what the source's does, which are execution's.

use crate::pass::{Moment, Pass, Step};
use crate::support::mode_analysis::Known;
use crate::support::write::{Rebuild, rebuild};
use ncc_ir::canon::ReturnLevel;
use ncc_ir::compensated::Refused;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Op, PathControl, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "compensated-modes",
    about: "refuses what the target does not take while cutter radius compensation is on",
    alone: None,
    step: Some(Step {
        moment: Moment::Departure,
        needed: |l, p| {
            l.states.ask(|own: &CompensatedModesState| {
                own.refused.any() && (l.entries.is_some() || own.concerns(p.stmts))
            })
        },
        run: |l, p| {
            let entries = l.entries.clone();
            convert_compensated_modes(
                p.stmts,
                l.states.state_mut::<CompensatedModesState>(),
                entries.as_deref(),
                p.diags,
            );
        },
        otherwise: |l, p| {
            let own = l.states.state_mut::<CompensatedModesState>();
            if own.refused.any() {
                own.note(p.stmts);
            }
        },
        first: None,
        finish: |_, _, _| {},
    }),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece.
#[derive(Clone, Debug, Default)]
pub(crate) struct CompensatedModesState {
    /// Whether compensation is on, or may be.
    pub(crate) on: bool,
    /// The switch for skipped blocks that alone decides about that: the level of the blocks that start it.
    level_on: Option<u8>,
    /// What the target refuses there, and the source does not.
    pub(crate) refused: Refused,
    /// The active path mode, return level and work offset, where they are known.
    path: Option<PathControl>,
    level: Option<ReturnLevel>,
    work: Option<u16>,
    /// Whether the block at hand has a code that acts after those of compensation, or has switched it off.
    acts_behind: bool,
    stopped: bool,
}

impl CompensatedModesState {
    /// Where control comes from elsewhere, and this holds.
    pub(crate) fn enter(&mut self, at: &Tracker, path: Option<&PathControl>) {
        (self.on, self.level_on) = (at.compensated, None);
        self.path = path.cloned();
        (self.level, self.work) = (at.modes.return_level, at.modes.work_offset);
    }

    /// A path mode that is known to be active.
    pub(crate) fn path(&self) -> Option<&PathControl> {
        self.path.as_ref()
    }

    /// Whether a statement states what is active already; notes what it states.
    fn states_again(&mut self, stmt: &Stmt) -> bool {
        let sure = stmt.skip.is_none();
        fn set<T: PartialEq + Clone>(known: &mut Option<T>, value: &T, sure: bool) -> bool {
            let same = known.as_ref() == Some(value);
            *known = if sure || same { Some(value.clone()) } else { None };
            same
        }
        match &stmt.op {
            Op::SetMotionControlMode(control) => set(&mut self.path, control, sure),
            Op::SetReturnLevel(level) => set(&mut self.level, level, sure),
            Op::SetOriginOffsets(offset) => set(&mut self.work, offset, sure),
            Op::ExactStop => {
                self.path = None;
                false
            }
            flow!() => {
                (self.path, self.level, self.work) = (None, None, None);
                false
            }
            _ => false,
        }
    }

    /// Whether statements may concern it.
    pub(crate) fn concerns(&self, stmts: &[Stmt]) -> bool {
        self.on || stmts.iter().any(|stmt| matches!(stmt.op, Op::StartCutterRadiusCompensation { .. }))
    }

    /// Follows statements that do not concern it.
    pub(crate) fn note(&mut self, stmts: &[Stmt]) {
        for stmt in stmts {
            self.states_again(stmt);
        }
    }
}

/// Brings statements into a form that the target takes.
///
/// `entries` is what holds after each call and label.
pub(crate) fn convert_compensated_modes(
    stmts: &mut Vec<Stmt>,
    state: &mut CompensatedModesState,
    entries: Option<&Known>,
    diags: &mut Vec<Diagnostic>,
) {
    let (refused, mut after_flow) = (state.refused, false);
    rebuild(stmts, |mut stmt, made: &mut Rebuild| {
        if !stmt.joined {
            (state.acts_behind, state.stopped) = (false, false);
        }
        if std::mem::replace(&mut after_flow, matches!(stmt.op, flow!()))
            && let Some((known, at)) = entries.and_then(|known| Some((known, known.before(&stmt)?)))
        {
            state.enter(at, known.path_before(&stmt));
        }
        match &stmt.op {
            Op::StartCutterRadiusCompensation { .. } => {
                if state.acts_behind {
                    (stmt.joined, state.acts_behind) = (false, false);
                }
                state.level_on = stmt.skip.filter(|own| !state.on || state.level_on == Some(*own));
                state.on = true;
                return made.push(stmt);
            }
            Op::StopCutterRadiusCompensation => {
                // In a block that may be skipped it may stay on, but where the same switch has skipped its start.
                state.on &= stmt.skip.is_some() && state.level_on != stmt.skip;
                state.stopped = true;
                return made.push(stmt);
            }
            _ => {}
        }
        let again = state.states_again(&stmt);
        let Some(kind) = refused.kind(&stmt.op) else { return made.push(stmt) };
        if state.on {
            if again {
                return made.leave_out(stmt);
            }
            diags.push(Diagnostic::new(Fault::CompensatedThere { kind }, stmt.span));
        } else if !refused.acts_before(kind) {
            state.acts_behind = true;
        } else if state.stopped {
            (stmt.joined, state.stopped) = (false, false);
        }
        made.push(stmt);
    });
}
