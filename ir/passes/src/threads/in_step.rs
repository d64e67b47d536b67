//! `threads`: spindle-synchronised moves, as the target says them.
//!
//! Controls cut a thread as the spindle turns, at a lead that is stated; some turn the spindle
//! themselves, after it has been oriented, some go in and out again in one block; some say the
//! lead with the feed word. What a target has no such move for is refused: a thread never becomes a plain
//! feed. Along one axis all of them mean the same by a lead; along several they do not.
//!
//! In and out in one block is a rigid tapping cycle where the target has that instead. Not here: tapping cycles, which `expand-cycles` writes out as such moves.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::{CYCLE, THREAD};
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, at, rebuild};
use crate::target::Target;
use crate::threads::taps::{self, Said};
use ncc_ir::canon::{AXES, Axis, Fact, ReturnLevel, Spindle, Turn};
use ncc_ir::caps::Threads;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::lack::ThreadsLack;
use ncc_ir::program::cycle::{Approach, Cycle, CycleKind, Tap};
use ncc_ir::program::kinds::{
    conduct, drilling, flow, frames, machine, miscellaneous, modes, moves, polar, variables,
};
use ncc_ir::program::{Move, Op, Pitch, Program, Stmt, Synchronised};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// A pass.
pub(crate) const AS_CYCLES: Pass = Pass {
    name: "threads-as-cycles",
    about: "writes threads as cycles where the target has them",
    alone: None,
    step: Step::at(
        Moment::Wording,
        |l, p| p.needs(THREAD) && p.stmts.iter().any(|stmt| is_cycle(stmt, &l.target)),
        |l, p| {
            as_cycles(p.stmts, &mut p.start.clone(), &l.target);
            p.needs |= l.lacks & CYCLE;
        },
    ),
    program: &[],
    parametric: None,
};

/// A pass.
pub(crate) const PASS: Pass = Pass {
    name: "threads",
    about: "writes threads in the target's form",
    alone: Some(run),
    step: Step::to_the_end(
        Moment::Wording,
        |l, p| p.needs(CYCLE | THREAD) && l.lacks & THREAD != 0,
        |l, p| {
            let state = l.states.state_mut::<ThreadsState>();
            let is_thread = |stmt: &Stmt| matches!(stmt.op, Op::SynchronisedFeed(_));
            if !state.is_busy() && !p.stmts.iter().any(is_thread) {
                // Nothing is changed, and nothing of it hangs on where the tool is.
                for stmt in p.stmts.iter() {
                    state.said.note(stmt);
                    state.note(stmt);
                }
                return;
            }
            convert_threads(p.stmts, &mut p.start.clone(), state, &l.target, p.diags)
        },
        |l, stmts, diags| l.states.state_mut::<ThreadsState>().finish(stmts, diags),
    ),
    program: &[],
    parametric: None,
};

/// The way out that belongs to a thread which is written with its way back.
#[derive(Clone, Debug)]
struct WayOut {
    to: [Option<Nanos>; AXES],
    pitch: Pitch,
    turn: Turn,
    /// The block of the way in, and its block-skip level: in a block with block skip both halves are of that block.
    block: (Span, Option<u8>),
}

/// What the pass remembers from piece to piece of a body.
#[derive(Clone, Debug, Default)]
pub(crate) struct ThreadsState {
    /// Feed and speed active.
    pub(crate) said: Said,
    /// What is written already, and has to come next.
    way_out: Option<WayOut>,
    /// The feed that a lead has taken the place of.
    owed: Option<Num>,
    /// Whether a lead has taken the place of a feed that is not known.
    lost: bool,
    /// Whether the spindle was oriented, and held since.
    held: bool,
}

impl ThreadsState {
    /// Whether something is to come yet.
    pub(crate) fn is_busy(&self) -> bool {
        self.way_out.is_some() || self.owed.is_some() || self.lost
    }

    /// Takes note of statements that need nothing.
    #[inline]
    pub(crate) fn note(&mut self, stmt: &Stmt) {
        match &stmt.op {
            miscellaneous!() => match &stmt.op {
                Op::OrientSpindle(_) => self.held = stmt.skip.is_none(),
                Op::StartSpindleClockwise | Op::StartSpindleCounterclockwise | Op::StopSpindleTurning => {
                    self.held = false
                }
                _ => {}
            },
            Op::ChangeTool | Op::StartCycle(_) | flow!() => self.held = false,
            Op::SelectTool(_)
            | Op::SelectToolByName(_)
            | Op::UseToolLengthOffset(_)
            | Op::UseToolLength(_)
            | Op::UseToolEdge { .. }
            | Op::SetFeedRate(_)
            | Op::Position(_)
            | Op::Hole(_)
            | Op::Pattern(_)
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::BeginAgain
            | variables!()
            | machine!()
            | frames!()
            | conduct!()
            | modes!()
            | moves!()
            | polar!() => {}
        }
    }
}

/// Says them as the target does.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        let mut state = ThreadsState::default();
        convert_threads(body, walk, &mut state, target, diags);
        state.finish(body, diags);
    });
}

/// The same for one piece of a body.
pub(crate) fn convert_threads(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut ThreadsState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    rebuild(body, |mut stmt, made| {
        walk.enter(stmt.skip);
        let span = stmt.span;
        let before = walk.at.position;
        let (speed_of, remark) = (state.said, matches!(stmt.op, Op::Comment(_) | Op::Blank));
        state.said.note(&stmt);
        state.note(&stmt);
        let Op::SynchronisedFeed(m) = &mut stmt.op else {
            if !remark {
                if state.way_out.take().is_some() {
                    diags.push(Diagnostic::new(Fault::lacks(ThreadsLack::BeforeReturn), span));
                }
                if let Err(fault) = give_back(state, &mut stmt, made) {
                    diags.push(Diagnostic::new(fault, span));
                }
            }
            walk.step(&stmt);
            made.push(stmt);
            return;
        };
        let (original, threads) = (m.clone(), target.caps.moves.threads);
        let way_out = state.way_out.take();
        let ops = if threads.any {
            Ok(vec![stmt.op.clone()])
        } else {
            said(m, way_out, state, (walk, &before, (span, stmt.skip)), speed_of, threads)
        };
        if threads.by_feed && original.turn.is_none() && !original.chuck {
            state.owed = speed_of.feed;
            state.lost = state.owed.is_none();
        }
        walk.step(&stmt);
        match ops {
            Ok(ops) => {
                for op in ops {
                    let joined = stmt.joined;
                    let mut one = Stmt::new(span, op);
                    (one.skip, one.number, one.joined) = (stmt.skip, stmt.number.take(), joined);
                    one.comment = stmt.comment.take();
                    stmt.joined = false;
                    made.push(one);
                }
            }
            Err(fault) => {
                diags.push(Diagnostic::new(fault, span));
                made.push(stmt);
            }
        }
    });
}

/// Whether a statement goes in and out of a thread, and the target has a cycle for it and no such move.
pub(crate) fn is_cycle(stmt: &Stmt, target: &Target) -> bool {
    let caps = &target.caps;
    let says = caps.moves.threads.any || caps.moves.threads.back;
    let thread = matches!(&stmt.op, Op::SynchronisedFeed(m) if m.back && m.turn.is_none() && !m.chuck);
    thread && !says && caps.holes.cycles.iter().any(|cap| cap.kind == "tap-rigid")
}

/// Writes threads with their way back as rigid tapping cycles, where the target has no such move. What
/// cannot be written so is left, and refused later.
pub(crate) fn as_cycles(body: &mut Vec<Stmt>, walk: &mut Walk, target: &Target) {
    rebuild(body, |mut stmt, made| {
        walk.enter(stmt.skip);
        let cycle =
            if is_cycle(&stmt, target) && stmt.skip.is_none() { cycle_of(&stmt, walk, target) } else { None };
        let Some(cycle) = cycle else {
            walk.step(&stmt);
            made.push(stmt);
            return;
        };
        let (span, comment) = (stmt.span, stmt.comment.take());
        for op in [Op::StartCycle(Box::new(cycle)), Op::Hole(Move::default()), Op::EndCycle] {
            let hole = matches!(op, Op::Hole(_));
            let mut one = Stmt::new(span, op);
            (one.number, one.joined) = (stmt.number.take(), hole || stmt.joined);
            stmt.joined = false;
            walk.step(&one);
            made.push(one);
        }
        if let (Some(comment), Some(last)) = (comment, made.out.last_mut()) {
            last.comment = Some(comment);
        }
    });
}

/// The cycle that makes the same moves from where the tool is.
fn cycle_of(stmt: &Stmt, walk: &Walk, target: &Target) -> Option<Cycle> {
    let Op::SynchronisedFeed(m) = &stmt.op else { return None };
    let plane = walk.at.modes.plane?;
    let normal = plane.axes().2;
    let only = Axis::ALL.into_iter().all(|axis| (axis == normal) == m.to.get(axis).is_some());
    let start = walk.at.position[normal as usize]?;
    let end = walk.at.resolve(m.to.get(normal)?, Some(start))?;
    let (turn, after) = match walk.at.spindle? {
        Spindle::Clockwise => (Turn::Clockwise, Spindle::Clockwise),
        Spindle::Counterclockwise => (Turn::Counterclockwise, Spindle::Counterclockwise),
        Spindle::Stopped => return None,
    };
    if !only || end >= start {
        return None;
    }
    let pitch = m.pitch.clone();
    let tap =
        Tap { turn, pitch, chuck: false, dwell: None, back: None, settle: None, after, to_level: false };
    Some(Cycle {
        kind: CycleKind::Tap(Box::new(tap)),
        plane: Fact::Known(plane),
        retract: at(start, normal, walk.unit()),
        depth: at(end, normal, walk.unit()),
        return_level: Fact::Known(ReturnLevel::Retract),
        return_plane: None,
        reference: None,
        approach: target.caps.holes.approach.unwrap_or(Approach::PlaneFirst),
        feed: None,
    })
}

/// Says again the feed that a lead has taken the place of, in the block that needs it.
fn give_back(state: &mut ThreadsState, stmt: &mut Stmt, made: &mut Rebuild) -> Result<(), Fault> {
    let Some(feed) = state.owed else {
        let says = |op: &Op| match op {
            Op::SetFeedRate(_) | Op::SetFeedMode(_) | Op::ProgramEnd | Op::BeginAgain => true,
            Op::StartCycle(cycle) => cycle.feed.is_some(),
            _ => false,
        };
        let cuts = matches!(
            stmt.op.unwrapped(),
            Op::StraightFeed(_)
                | Op::ArcFeed(_)
                | Op::ArcForm(_)
                | Op::Position(_)
                | Op::Hole(_)
                | Op::Pattern(_)
        );
        if state.lost && cuts {
            state.lost = false;
            return cannot(ThreadsLack::FeedAfterUnknown);
        }
        state.lost &= !says(&stmt.op) || stmt.skip.is_some();
        return Ok(());
    };
    match stmt.op.unwrapped() {
        Op::SetFeedRate(_) | Op::SetFeedMode(_) | Op::ProgramEnd | Op::BeginAgain if stmt.skip.is_none() => {
            state.owed = None
        }
        Op::StartCycle(cycle) if cycle.feed.is_some() && stmt.skip.is_none() => state.owed = None,
        Op::StraightFeed(_)
        | Op::ArcFeed(_)
        | Op::ArcForm(_)
        | Op::Position(_)
        | drilling!()
        | Op::SetFeedRate(_)
        | flow!() => {
            if stmt.skip.is_some() {
                return cannot(ThreadsLack::SkippedFeedAfter);
            }
            state.owed = None;
            let mut one = Stmt::new(stmt.span, Op::SetFeedRate(Expr::Num(feed)));
            (one.number, one.joined) = (stmt.number.take(), stmt.joined);
            stmt.joined = !matches!(stmt.op, flow!());
            made.push(one);
        }
        _ => {}
    }
    Ok(())
}

impl ThreadsState {
    /// The end of the body.
    pub(crate) fn finish(&mut self, body: &[Stmt], diags: &mut Vec<Diagnostic>) {
        if self.way_out.take().is_some() {
            let span = body.last().map(|stmt| stmt.span).unwrap_or_default();
            diags.push(Diagnostic::new(Fault::lacks(ThreadsLack::NoReturn), span));
        }
        (self.owed, self.lost) = (None, false);
    }
}

fn cannot<T>(lack: ThreadsLack) -> Result<T, Fault> {
    Err(Fault::lacks(lack))
}

/// One move in the target's words.
fn said(
    m: &mut Synchronised,
    way_out: Option<WayOut>,
    state: &mut ThreadsState,
    (walk, before, block): (&Walk, &[Option<Nanos>; AXES], (Span, Option<u8>)),
    speed: Said,
    threads: Threads,
) -> Result<Vec<Op>, Fault> {
    let words: Vec<Axis> = Axis::ALL.into_iter().filter(|axis| m.to.get(*axis).is_some()).collect();
    let along = match words[..] {
        [axis] if !axis.is_rotary() => axis,
        _ => return cannot(ThreadsLack::AxisCount),
    };
    if m.chuck {
        return match (&m.pitch, m.turn, threads.chuck) {
            (Pitch::Feed, None, true) if !m.back => Ok(vec![thread_op(m)]),
            (_, _, false) => cannot(ThreadsLack::Chuck),
            _ => cannot(ThreadsLack::ChuckForm),
        };
    }
    if let Pitch::Feed = m.pitch {
        m.pitch = Pitch::Stated(taps::pitch_of(speed.feed, speed.speed, walk)?.into());
    }
    match (m.turn, m.back) {
        (None, false) if threads.plain => Ok(vec![thread_op(m)]),
        (None, true) if threads.back => Ok(vec![thread_op(m)]),
        (Some(_), false) if threads.turned && state.held => Ok(vec![thread_op(m)]),
        (Some(_), false) if threads.turned => cannot(ThreadsLack::NotOriented),
        (Some(turn), false) if threads.back => {
            let Some(out) = way_out else {
                // The way in: the way out, which has to come next, is stated with it.
                if before[along as usize].is_none() {
                    return Err(Fault::PositionUnknown { axis: along.letter() as char });
                }
                state.way_out =
                    Some(WayOut { to: *before, pitch: m.pitch.clone(), turn: turn.back(), block });
                let start = match turn {
                    Turn::Clockwise => Op::StartSpindleClockwise,
                    Turn::Counterclockwise => Op::StartSpindleCounterclockwise,
                };
                let thread = Synchronised { turn: None, back: true, ..m.clone() };
                return Ok(vec![start, Op::SynchronisedFeed(Box::new(thread)), Op::StopSpindleTurning]);
            };
            let to = m.to.get(along).and_then(|word| walk.at.resolve(word, before[along as usize]));
            let same = to.is_some() && to == out.to[along as usize];
            let as_entered = out.block == block || (out.block.1, block.1) == (None, None);
            if !same || !as_entered || out.turn != turn || out.pitch != m.pitch {
                return cannot(ThreadsLack::LeftDifferently);
            }
            Ok(Vec::new())
        }
        (None, true) if walk.at.spindle == Some(Spindle::Stopped) => cannot(ThreadsLack::SpindleStopped),
        (None, true) => cannot(ThreadsLack::OutAndBack),
        (None, false) => cannot(ThreadsLack::Synchronised),
        (Some(_), _) => cannot(ThreadsLack::TurnedByControl),
    }
}

fn thread_op(m: &Synchronised) -> Op {
    Op::SynchronisedFeed(Box::new(m.clone()))
}
