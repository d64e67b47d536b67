//! What a target does at once where other controls wait, and what it takes away where they keep it: a length
//! that counts as soon as it is read, so that the tool stands at another Z; a motion that is over with the
//! cycle after it. And what every control leaves open: a level from where the tool stood before the first Z,
//! by which length it is measured.
//!
//! It changes nothing. What depends on either is refused where the source says it.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::AT_ONCE;
use crate::support::walk::Walk;
use crate::target::Target;
use ncc_ir::canon::{Axis, Distance, Fact, ReturnLevel};
use ncc_ir::caps::Caps;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::{HolesLack, LengthsLack};
use ncc_ir::program::kinds::{conduct, miscellaneous, modes, variables};
use ncc_ir::program::{Data, DataMode, Op, Point, Stmt};
use ncc_ir::source::Span;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "at-once",
    about: "has what the target does later done where it is said",
    alone: None,
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(AT_ONCE),
        |l, p| {
            check_effects(
                p.stmts,
                &mut p.start.clone(),
                l.states.state_mut::<ImmediateEffectsState>(),
                &l.target,
                p.diags,
            )
        },
    ),
    program: &[],
    parametric: None,
};

/// What is remembered from piece to piece of a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct ImmediateEffectsState {
    /// Another length is active, and no absolute Z has been named since.
    length: bool,
    /// The target's first blocks say no length, and no absolute Z has been named since.
    start: bool,
    /// A cycle is over, and no motion has been stated since.
    motion: bool,
}

impl ImmediateEffectsState {
    /// The start of a main program: without a length, where the target's first blocks say so.
    pub(crate) fn new(caps: &Caps) -> ImmediateEffectsState {
        let start = caps.tools.starts_without_length;
        ImmediateEffectsState { length: start && caps.tools.length_at_once, start, motion: false }
    }

    /// Whether further statements must be looked at.
    pub(crate) fn is_busy(&self) -> bool {
        self.length || self.start || self.motion
    }

    /// The end of a subprogram, which returns if nothing else is stated.
    pub(crate) fn end_of_sub(&mut self, body: &[Stmt], diags: &mut Vec<Diagnostic>) {
        let ends = |s: &&Stmt| matches!(s.op, Op::ProgramEnd | Op::BeginAgain) && s.skip.is_none();
        if let Some(last) = body.last().filter(|s| self.length && !ends(s)) {
            self.refuse_length(last.span, diags);
        }
    }

    fn refuse_length(&mut self, span: Span, diags: &mut Vec<Diagnostic>) {
        self.length = false;
        diags.push(Diagnostic::new(Fault::lacks(LengthsLack::ToolOffsetBeforeZ), span));
    }
}

/// Looks at one piece of a body.
pub(crate) fn check_effects(
    stmts: &[Stmt],
    walk: &mut Walk,
    state: &mut ImmediateEffectsState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    for stmt in stmts {
        walk.enter(stmt.skip);
        over_one(&stmt.op, stmt, walk, state, target, diags);
        walk.step(stmt);
    }
}

fn over_one(
    op: &Op,
    stmt: &Stmt,
    walk: &Walk,
    state: &mut ImmediateEffectsState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    match op {
        Op::UseToolLengthOffset(_) | Op::UseToolLength(_) | Op::UseToolEdge { .. } => {
            state.length = target.caps.tools.length_at_once
        }
        Op::StraightTraverse(m) | Op::StraightFeed(m) => goes(&m.to, stmt, walk, state, diags),
        Op::SynchronisedFeed(m) => goes(&m.to, stmt, walk, state, diags),
        Op::ArcFeed(arc) => goes(&arc.to, stmt, walk, state, diags),
        Op::ArcForm(arc) => goes(&arc.to, stmt, walk, state, diags),
        Op::GoToReference(reference) => names(&reference.via, stmt, walk, state, diags),
        Op::Polar(polar) => over_one(&polar.op, stmt, walk, state, target, diags),
        Op::Position(m) => {
            if std::mem::take(&mut state.motion) {
                diags.push(Diagnostic::new(Fault::lacks(HolesLack::CallersMotionAfterCycle), stmt.span));
            }
            names(&m.to, stmt, walk, state, diags);
        }
        Op::Hole(_) | Op::Pattern(_) if state.length => state.refuse_length(stmt.span, diags),
        Op::Hole(_) | Op::Pattern(_) => state.motion = false,
        Op::StartCycle(cycle) => {
            state.motion = false;
            let from_level =
                cycle.retract.distance.known().or(walk.at.modes.distance) != Some(Distance::Absolute);
            let back_to_level = cycle.return_plane.is_none()
                && cycle.return_level.known().or(walk.at.modes.return_level) != Some(ReturnLevel::Retract);
            if state.start && (from_level || back_to_level) {
                state.start = false;
                diags.push(Diagnostic::new(Fault::lacks(HolesLack::LevelBeforeZ), stmt.span));
            }
        }
        // A block that may be skipped leaves it open whether the motion is over.
        Op::EndCycle => state.motion = target.caps.holes.end_motion && stmt.skip.is_none(),
        Op::SetPosition(axes) if state.length && axes[Axis::Z as usize].is_some() => {
            state.refuse_length(stmt.span, diags);
        }
        Op::SetData(data) => {
            if let Data::Offset { mode: DataMode::Here, words, .. } = &**data
                && words[Axis::Z as usize].is_some()
            {
                if state.length {
                    state.refuse_length(stmt.span, diags);
                } else if state.start {
                    state.start = false;
                    diags.push(Diagnostic::new(Fault::lacks(LengthsLack::ZeroBeforeZ), stmt.span));
                }
            }
        }
        Op::Call(_) | Op::Return => {
            if state.length {
                state.refuse_length(stmt.span, diags);
            }
            state.motion = false;
        }
        Op::RepeatBlocks(_) | Op::Control(_) | Op::Goto(_) | Op::Label(_) | Op::Leave | Op::NextTurn => {
            state.motion = false
        }
        Op::SetPosition(_)
        | Op::SelectTool(_)
        | Op::SelectToolByName(_)
        | Op::ChangeTool
        | Op::SetOriginOffsets(_)
        | Op::ClearFrame(_)
        | Op::UseOriginShift(_)
        | Op::SetFrame(_)
        | Op::SetSlot(_)
        | Op::UseToolCentrePoint(_)
        | Op::Probe(_)
        | Op::Detour(_)
        | Op::UseMachineCoordinates { .. }
        | Op::OrientToolAxis(_)
        | Op::SetPole(_)
        | Op::SetFeedRate(_)
        | Op::ProgramEnd
        | Op::BeginAgain
        | variables!()
        | miscellaneous!()
        | conduct!()
        | modes!() => {}
    }
}

/// A move that says itself which it is.
fn goes(
    to: &Point,
    stmt: &Stmt,
    walk: &Walk,
    state: &mut ImmediateEffectsState,
    diags: &mut Vec<Diagnostic>,
) {
    state.motion = false;
    let first = to.get(Axis::Z).filter(|_| state.start && stmt.skip.is_none());
    if first.is_some_and(|word| word.distance == Fact::Known(Distance::Incremental)) {
        // The target's first blocks say nothing of a length then: it is assumed on both sides.
        (state.length, state.start) = (false, false);
    }
    names(to, stmt, walk, state, diags);
}

/// Axis words: an absolute Z settles where the tool is, and another one depends on it.
fn names(
    to: &Point,
    stmt: &Stmt,
    walk: &Walk,
    state: &mut ImmediateEffectsState,
    diags: &mut Vec<Diagnostic>,
) {
    let Some(word) = to.get(Axis::Z).filter(|_| state.length || state.start) else { return };
    match word.distance.known().or(walk.at.modes.distance) {
        // With the switch on, it is not said.
        Some(Distance::Absolute) => {
            state.length &= stmt.skip.is_some();
            state.start &= stmt.skip.is_some();
        }
        Some(Distance::Incremental) | None if state.length => state.refuse_length(stmt.span, diags),
        Some(Distance::Incremental) | None => {}
    }
}
