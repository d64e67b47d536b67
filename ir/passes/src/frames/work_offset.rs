//! `work-offset`: a control that has one work offset stands for the only one that a program uses.
//!
//! A second one is refused, and so is one that the target cannot name, but for one in which nothing moves
//! before the next one or the end: that is left out.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::WORK;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, rebuild};
use crate::target::Target;
use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::FramesLack;
use ncc_ir::program::kinds::{
    conduct, drilling, flow, machine, miscellaneous, modes, polar, tooling, variables,
};
use ncc_ir::program::{Data, Op, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "work-offset",
    about: "lets the target's only work offset stand for the program's only one",
    alone: Some(run),
    step: Step::at(
        Moment::Placing,
        |_, p| p.needs(WORK),
        |l, p| {
            select_work_offset(
                p.stmts,
                l.states.state_mut::<WorkOffsetState>(),
                p.assumed,
                &l.target,
                p.diags,
            )
        },
    ),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece of a program.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct WorkOffsetState {
    /// The work offset that the target's own one stands for.
    pub(crate) only: Option<u16>,
    reported: bool,
    /// The active work offset, if the target cannot name it and nothing has moved in it, and where the
    /// program says it.
    idle: Option<(u16, Span)>,
    /// The next straight move is in machine coordinates.
    raw: bool,
}

impl WorkOffsetState {
    /// Whether it must be shown what follows.
    pub(crate) fn is_busy(&self) -> bool {
        self.idle.is_some()
    }

    /// Ends a work offset in which nothing has moved.
    fn leave(&mut self, diags: &mut Vec<Diagnostic>) {
        if let Some((offset, span)) = self.idle.take() {
            diags.push(Diagnostic::new(Fault::WorkOffsetLeftOut { offset }, span));
        }
    }

    /// Refuses the active work offset where something depends on it.
    fn refuse_if_used(&mut self, op: &Op, diags: &mut Vec<Diagnostic>) {
        if let Some((offset, span)) = self.idle.filter(|_| uses(op, &mut self.raw)) {
            self.idle = None;
            diags.push(cannot_name(offset, span));
        }
    }
}

/// Whether something depends on the active work offset. `raw` is whether the straight move that follows
/// is in machine coordinates.
fn uses(op: &Op, raw: &mut bool) -> bool {
    match op {
        Op::UseMachineCoordinates { .. } => {
            *raw = true;
            false
        }
        Op::StraightTraverse(_) | Op::StraightFeed(_) => !std::mem::take(raw),
        miscellaneous!()
        | conduct!()
        | modes!()
        | tooling!()
        | Op::SetOriginOffsets(_)
        | Op::Probe(_)
        | Op::Detour(_)
        | Op::ClearFrame(_)
        | Op::SetFeedRate(_)
        | Op::EndCycle
        | Op::ProgramEnd
        | Op::BeginAgain => false,
        Op::UseToolCentrePoint(_)
        | Op::SetFrame(_)
        | Op::SetSlot(_)
        | Op::SetPosition(_)
        | Op::UseOriginShift(_)
        | Op::SynchronisedFeed(_)
        | Op::ArcFeed(_)
        | Op::ArcForm(_)
        | Op::Position(_)
        | drilling!()
        | variables!()
        | machine!()
        | polar!()
        | flow!() => true,
    }
}

fn cannot_name(offset: u16, span: Span) -> Diagnostic {
    Diagnostic::new(Fault::lacks(FramesLack::WorkOffset { offset }), span)
}

/// Takes the work offsets out, or refuses them.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    let mut state = WorkOffsetState::default();
    let assumed = entry.modes;
    each_body(program, entry, |body, _| select_work_offset(body, &mut state, &assumed, target, diags));
}

/// The same for one piece of a body.
pub(crate) fn select_work_offset(
    body: &mut Vec<Stmt>,
    state: &mut WorkOffsetState,
    assumed: &Modes,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    state.only = state.only.or(assumed.work_offset);
    let names = target.caps.frames.work_offsets;
    rebuild(body, |stmt: Stmt, made: &mut Rebuild| {
        state.refuse_if_used(&stmt.op, diags);
        if matches!(stmt.op, Op::SetOriginOffsets(_) | Op::ProgramEnd | Op::BeginAgain) && stmt.skip.is_none()
        {
            state.leave(diags);
        }
        let Op::SetOriginOffsets(number) = stmt.op else { return made.push(stmt) };
        if names > 0 {
            if (number > 0 || target.caps.frames.work_offsets_off) && number <= names {
                return made.push(stmt);
            }
            if stmt.skip.is_some() {
                diags.push(cannot_name(number, stmt.span));
            } else {
                state.idle = Some((number, stmt.span));
            }
            return made.leave_out(stmt);
        }
        match state.only {
            Some(first) if first != number => {
                diags.push(Diagnostic::new(Fault::SecondWorkOffset { first, second: number }, stmt.span));
            }
            _ if !state.reported => {
                diags.push(Diagnostic::new(Fault::AssumedWorkOffset { offset: number }, stmt.span));
                state.reported = true;
                state.only = Some(number);
            }
            _ => {}
        }
        made.leave_out(stmt);
    });
}

/// Takes out that a work offset is not turned, for a target whose offsets never are. Where that is all it says,
/// the turn that the offset may have had is left to be refused.
pub(crate) fn leave_straight(op: &mut Op) {
    let Op::SetData(data) = op else { return };
    if let Data::Offset { turn, words, .. } = &mut **data
        && words.iter().any(Option::is_some)
    {
        turn.take_if(|turn| turn.literal().is_some_and(|n| n.is_zero()));
    }
}
