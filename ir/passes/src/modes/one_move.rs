//! `one-move`: what is stated for one move stands in that move's block.
//!
//! An exact stop of one move, the corner after one, and the feed of a move that is given by its time, hold
//! for the move that comes next. A control whose programs are blocks takes them from the block of the move alone: in a
//! block of their own they say nothing, or are an error.
//!
//! It does not follow a program where that branches, repeats or calls: what waits there stays in a block
//! of its own, before it.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::MOVE;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::Rebuild;
use crate::target::Target;
use ncc_ir::canon::FeedMode;
use ncc_ir::diag::Diagnostic;
use ncc_ir::program::kinds::{flow, frames, machine, miscellaneous, moves, tooling, variables};
use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "one-move",
    about: "puts an exact stop of one move, and its inverse-time feed, into the block of the move",
    alone: Some(run),
    step: Step::to_the_end(
        Moment::Wording,
        |_, p| p.needs(MOVE),
        |l, p| split_moves(p.stmts, l.states.state_mut::<OneMoveState>()),
        |l, stmts, _| l.states.state_mut::<OneMoveState>().flush(stmts),
    ),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece of a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct OneMoveState {
    /// The feed is the time of a move.
    by_time: bool,
    /// What waits for its move: a stop, a corner, then a feed.
    held: [Option<Stmt>; 3],
}

impl OneMoveState {
    /// Whether the feed of a move may have to wait for it, or anything does.
    pub(crate) fn is_busy(&self) -> bool {
        self.by_time || self.held.iter().any(Option::is_some)
    }

    /// Whether something waits, or of these statements something would: most programs have every word of
    /// a move in its block.
    pub(crate) fn concerns(&self, stmts: &[Stmt]) -> bool {
        let mut by_time = self.by_time;
        self.held.iter().any(Option::is_some)
            || stmts.iter().enumerate().any(|(at, stmt)| {
                if let Op::SetFeedMode(mode) = &stmt.op {
                    by_time = *mode == FeedMode::InverseTime;
                }
                let waits = matches!(stmt.op, Op::ExactStop | Op::TurnRotaryAxes(_) | Op::Corner { .. })
                    || by_time && matches!(stmt.op, Op::SetFeedRate(_));
                let block = stmts[at + 1..].iter().take_while(|s| s.joined);
                waits && !block.into_iter().any(|s| matches!(s.op, Op::Position(_) | moves!()))
            })
    }

    /// Follows statements that have nothing to be brought together.
    pub(crate) fn note(&mut self, stmts: &[Stmt]) {
        for stmt in stmts {
            if let Op::SetFeedMode(mode) = &stmt.op {
                self.by_time = *mode == FeedMode::InverseTime;
            }
        }
    }

    /// What still waits stands last.
    pub(crate) fn flush(&mut self, body: &mut Vec<Stmt>) {
        body.extend(self.held.iter_mut().filter_map(Option::take).map(apart));
    }
}

/// A statement in a block of its own.
fn apart(mut stmt: Stmt) -> Stmt {
    stmt.joined = false;
    stmt.comment = None;
    stmt.number = None;
    stmt
}

/// Brings them together.
pub(crate) fn run(program: &mut Program, _: &Target, entry: &Tracker, _: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk: &mut Walk| {
        let by_time = walk.at.modes.feed_mode == Some(FeedMode::InverseTime);
        let mut state = OneMoveState { by_time, ..OneMoveState::default() };
        split_moves(body, &mut state);
        state.flush(body);
    });
}

/// The same for one piece of a body.
pub(crate) fn split_moves(body: &mut Vec<Stmt>, state: &mut OneMoveState) {
    let input = std::mem::take(body);
    let mut made = Rebuild::new(input.len());
    for stmt in input {
        let place = match stmt.op.unwrapped() {
            Op::SetFeedMode(mode) => {
                state.by_time = *mode == FeedMode::InverseTime;
                // A feed for which no move has come counts in the mode it was stated in.
                if let Some(feed) = state.held[2].take() {
                    made.push(apart(feed));
                }
                made.push(stmt);
                continue;
            }
            Op::ExactStop | Op::TurnRotaryAxes(_) => 0,
            Op::Corner { .. } => 1,
            Op::SetFeedRate(_) if state.by_time => 2,
            Op::StraightFeed(_)
            | Op::ArcFeed(_)
            | Op::ArcForm(_)
            | Op::SynchronisedFeed(_)
            | Op::Polar(_)
            | Op::Position(_) => {
                take_up(stmt, state, 3, &mut made);
                continue;
            }
            // A rapid needs no feed.
            Op::StraightTraverse(_) | Op::Hole(_) | Op::Pattern(_) => {
                take_up(stmt, state, 2, &mut made);
                continue;
            }
            flow!() | Op::ProgramEnd | Op::BeginAgain => {
                take_up(stmt, state, 3, &mut made);
                continue;
            }
            Op::SetFeedRate(_)
            | Op::SetMotionControlMode(_)
            | Op::Advise(_)
            | Op::UseLengthUnits(_)
            | Op::SetDistanceMode(_)
            | Op::SelectPlane(_)
            | Op::SetPole(_)
            | Op::SetReturnLevel(_)
            | Op::StartCycle(_)
            | Op::EndCycle
            | variables!()
            | miscellaneous!()
            | tooling!()
            | frames!()
            | machine!() => {
                made.push(stmt);
                continue;
            }
        };
        state.held[place] = Some(Stmt { comment: None, ..stmt.clone() });
        made.leave_out(stmt);
    }
    *body = made.out;
}

/// Puts what waits, with the feed or without, into the block of the statement that takes it up.
fn take_up(mut stmt: Stmt, state: &mut OneMoveState, most: usize, made: &mut Rebuild) {
    let leads_away = matches!(stmt.op, flow!() | Op::ProgramEnd | Op::BeginAgain);
    for held in &mut state.held[..most] {
        let Some(mut held) = held.take() else { continue };
        // A block that may be skipped alone takes nothing up that is not skipped with it.
        if leads_away || held.skip != stmt.skip {
            made.push(apart(held));
            continue;
        }
        held.joined = stmt.joined;
        held.number = stmt.number.take();
        stmt.joined = true;
        made.push(held);
    }
    made.push(stmt);
}
