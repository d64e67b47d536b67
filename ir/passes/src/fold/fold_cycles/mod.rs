//! `fold-cycles`: folds holes in long-hand blocks into cycles. The inverse of `expand-cycles`.
//!
//! A hole has this order of moves: a rapid to its position at the initial level, a rapid down to
//! the R plane, a cut along the drilling axis, and the retract: a rapid, with a dwell before it,
//! in pecks with a retract or a short lift between them, or a cut. Holes of
//! one cycle are a run, whatever the layout of their blocks: unchanged words,
//! moves without motion, a feed at each hole, once, or at rapid moves.
//!
//! A run of plain holes is folded from two holes on: one plunge needs three blocks anyway. A hole
//! with pecks, a dwell, or a cut out is folded alone too, because no other move looks like it.
//!
//! ncc folds only what the target has, and only if the machine does the same: it executes the moves
//! and the cycle side by side. Not folded: moves to the position and down in one block, two moves
//! where the cycle makes one, pecks that follow no single rule (so that no part of such a hole
//! becomes a cycle), blocks with block skip, unknown positions, and any statement between
//! the holes that is no comment, feed, or active mode: it ends the run. Comments and the block numbers
//! of the holes are kept.

mod acts;
pub(crate) mod feed;
mod hole;

use crate::holes::sayable::sayable;
use crate::pass::Pass;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, cut, only, traverse};
use crate::target::Target;
use acts::Acts;
use hole::{Hole, Reading, Unread};
use ncc_exec::world::World;
use ncc_exec::{Event, Exec};
use ncc_ir::canon::{AXES, Fact, Modes, Plane, ReturnLevel};
use ncc_ir::caps::ReturnsTo;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::{Approach, Cycle, CycleKind};
use ncc_ir::program::kinds::{flow, moves};
use ncc_ir::program::{Move, Op, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass =
    Pass::named("fold-cycles", "turns holes written long-hand into canned cycles", Some(run));

/// Fewest plain holes of a cycle.
const FEWEST_HOLES: usize = 2;

/// Folds holes into cycles of the target.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| fold_holes(body, walk, target, diags));
}

/// The same for one body.
pub(crate) fn fold_holes(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    if target.caps.holes.cycles.is_empty() || target.caps.flat {
        return;
    }
    let input = std::mem::take(body);
    let mut made = Rebuild::new(input.len());
    let mut rest = &input[..];
    let mut feed = None;
    // Statements that pass unchanged: they belong to a hole of no cycle.
    let mut passed_by = 0;
    while let Some(stmt) = rest.first() {
        walk.enter(stmt.skip);
        let taken = match passed_by {
            0 => match Run::read(rest, walk, feed) {
                Ok(run) => run.fold(rest, walk, feed, target, &mut made, diags),
                Err(others) => {
                    passed_by = others;
                    0
                }
            },
            _ => 0,
        };
        let ready = taken.max(1);
        for stmt in &rest[..ready] {
            walk.step(stmt);
            feed = feed::after(stmt, feed);
            if taken == 0 {
                made.push(stmt.clone());
            }
        }
        passed_by = passed_by.saturating_sub(ready);
        rest = &rest[ready..];
    }
    *body = made.out;
}

/// Consecutive holes of one cycle.
struct Run {
    plane: Plane,
    /// Each with the number of statements up to its end.
    holes: Vec<(Hole, usize)>,
    /// The feed after each.
    feeds: Vec<Option<Num>>,
}

impl Run {
    /// Reads the run that starts here.
    ///
    /// # Errors
    /// The number of statements of a hole that no cycle makes.
    fn read(rest: &[Stmt], walk: &Walk, feed: Option<Num>) -> Result<Run, usize> {
        let begins = match &rest[0].op {
            Op::StraightTraverse(_) | Op::StraightFeed(_) | Op::SetFeedRate(_) => rest[0].skip.is_none(),
            _ => false,
        };
        let Some(plane) = walk.at.modes.plane.filter(|_| begins && !walk.waiting && walk.at.cycle.is_none())
        else {
            return Err(0);
        };
        if walk.at.cycle_in_doubt || walk.at.compensated || walk.at.tilted {
            return Err(0);
        }
        let acts = Acts::new(rest, walk.at.clone(), feed, plane);
        let long = Run::first_run(acts.clone(), plane, Reading::LONG);
        // A rapid after a bored hole may belong to the next hole.
        let bored = |run: &Run| matches!(run.holes[0].0.kind, CycleKind::Bore { .. });
        if long.as_ref().is_ok_and(|run| !bored(run)) {
            return long;
        }
        let short = Run::first_run(acts, plane, Reading::SHORT);
        match (long, short) {
            (Ok(long), Ok(short)) if short.holes.len() > long.holes.len() => Ok(short),
            (Ok(long), _) => Ok(long),
            (Err(others), _) => Err(others),
        }
    }

    /// The run whose first hole is read like this.
    fn first_run(mut acts: Acts<'_>, plane: Plane, reading: Reading) -> Result<Run, usize> {
        let mut run = Run { plane, holes: Vec::new(), feeds: Vec::new() };
        loop {
            let mut next = acts.clone();
            let read = match run.holes.first() {
                None => hole::read(&mut next, plane, reading),
                Some((first, _)) => further(&mut next, plane, first, reading),
            };
            match read {
                Ok(hole) => {
                    run.holes.push((hole, next.read));
                    run.feeds.push(next.feed);
                    acts = next;
                }
                Err(Unread::NoCycle) if run.holes.is_empty() => return Err(next.read),
                Err(Unread::NoCycle | Unread::NotHere) => break,
            }
        }
        if run.holes.is_empty() { Err(0) } else { Ok(run) }
    }

    /// Replaces the moves by the cycle; returns the number of replaced statements.
    fn fold(
        self,
        rest: &[Stmt],
        walk: &Walk,
        feed: Option<Num>,
        target: &Target,
        made: &mut Rebuild,
        diags: &mut Vec<Diagnostic>,
    ) -> usize {
        let (first, _) = &self.holes[0];
        if self.holes.len() < FEWEST_HOLES && first.is_plain() {
            return 0;
        }
        let Some(cycle) = self.cycle(target) else { return 0 };
        let mut nothing = Vec::new();
        if !sayable(walk, &cycle, target, rest[0].span, &mut nothing) || !nothing.is_empty() {
            return 0;
        }
        let end = self.holes[self.holes.len() - 1].1;
        let own = self.stmts(&rest[..end], cycle.clone());
        if !is_same(walk, feed, &rest[..end], &own.out) {
            return 0;
        }
        let kind = cycle.kind.name().into();
        let holes = u32::try_from(self.holes.len()).unwrap_or(u32::MAX);
        diags.push(Diagnostic::new(Fault::CycleFolded { kind, holes }, rest[0].span));
        let span = rest[end - 1].span;
        for stmt in own.out {
            made.push(stmt);
        }
        self.afterwards(&cycle, &rest[end..], span, made);
        end
    }

    /// The cycle, in the target's form.
    fn cycle(&self, target: &Target) -> Option<Cycle> {
        let (first, _) = &self.holes[0];
        let (out, retract) = (first.out.1, first.retract.1);
        let level = match out {
            _ if out == retract => Some(ReturnLevel::Retract),
            _ if out == first.from => Some(ReturnLevel::Initial),
            _ => None,
        };
        if out < retract || level.is_none() && target.caps.holes.returns == ReturnsTo::Level {
            return None;
        }
        let states_plane = level.is_none() || target.caps.holes.returns == ReturnsTo::Plane;
        let said = self.holes.iter().any(|(hole, _)| hole.feed_said);
        Some(Cycle {
            kind: first.kind.clone(),
            plane: Fact::Known(self.plane),
            retract: first.retract.0.clone(),
            depth: first.depth.0.clone(),
            return_level: Fact::from(level.filter(|_| !states_plane)),
            reference: None,
            return_plane: states_plane.then(|| first.out.0.clone()),
            approach: target.caps.holes.approach.unwrap_or(Approach::PlaneFirst),
            feed: first.feed.filter(|_| said).map(Into::into),
        })
    }

    /// The statements of the cycle and its holes, with the kept comments.
    fn stmts(&self, moves: &[Stmt], cycle: Cycle) -> Rebuild {
        let mut made = Rebuild::new(2 * self.holes.len() + 2);
        let mut cycle = Some(cycle);
        let mut from = 0;
        for (hole, to) in &self.holes {
            let mut ops = Vec::new();
            if let Some(cycle) = cycle.take() {
                ops.push((false, Op::StartCycle(Box::new(cycle))));
            }
            ops.push((false, Op::Hole(Move { to: hole.to.clone(), said: false })));
            one(&moves[from..*to], ops, &mut made);
            from = *to;
        }
        made.push(Stmt::new(moves[moves.len() - 1].span, Op::EndCycle));
        made
    }

    /// Modes that the moves leave active and the cycle does not: the feed, and the motion mode where a later
    /// statement may depend on it.
    fn afterwards(&self, cycle: &Cycle, rest: &[Stmt], span: Span, made: &mut Rebuild) {
        let (last, _) = &self.holes[self.holes.len() - 1];
        let feed = self.feeds[self.feeds.len() - 1];
        let kept = match &cycle.kind {
            CycleKind::Bore { feed_out: Some(_), .. } => None,
            _ => last.feed,
        };
        if let Some(feed) = feed.filter(|feed| kept != Some(*feed) && feed::counts(rest)) {
            made.push(Stmt::new(span, Op::SetFeedRate(feed.into())));
        }
        if inherits_motion(rest) {
            let to = only(self.plane.axes().2, last.out.0.clone());
            made.push(Stmt::new(span, if last.left_by_cut { cut(to) } else { traverse(to) }));
        }
    }
}

/// A further hole of a run.
fn further(acts: &mut Acts<'_>, plane: Plane, first: &Hole, reading: Reading) -> Result<Hole, Unread> {
    let start = acts.clone();
    let whole = hole::read(acts, plane, reading);
    if whole.as_ref().is_ok_and(|hole| first.is_like(hole)) {
        return whole;
    }
    // The next moves in the same place may be the first hole of another cycle, unless this one is it.
    if let Ok(whole) = &whole
        && hole::read(&mut acts.clone(), plane, reading).is_ok_and(|next| whole.is_like(&next))
    {
        return Err(Unread::NotHere);
    }
    *acts = start;
    let short = hole::read(acts, plane, Reading::like(first))?;
    if first.is_like(&short) { Ok(short) } else { Err(Unread::NotHere) }
}

/// Replaces a hole's moves. It keeps the number and comment of the block with its first
/// move; other comments come before or after it, as they are before or after the cut.
fn one(moves: &[Stmt], ops: Vec<(bool, Op)>, made: &mut Rebuild) {
    let is_move = |stmt: &Stmt| matches!(stmt.op, Op::StraightTraverse(_) | Op::StraightFeed(_));
    let cut = moves.iter().position(|stmt| matches!(stmt.op, Op::StraightFeed(_))).unwrap_or(0);
    let Some(first) = moves.iter().position(is_move) else { return };
    let begin = moves[..first].iter().rposition(|stmt| !stmt.joined).filter(|_| moves[first].joined);
    let begin = begin.unwrap_or(first);
    let end = first + 1 + moves[first + 1..].iter().take_while(|stmt| stmt.joined).count();
    let mut hole = moves[first].clone();
    hole.number = moves[begin].number;
    hole.joined = moves[begin].joined;
    hole.comment = moves[begin..end].iter().find_map(|stmt| stmt.comment.clone());
    let remark = |at: usize, stmt: &Stmt| -> Option<Stmt> {
        let text = match (&stmt.op, &stmt.comment) {
            (Op::Comment(text), _) => text.clone(),
            (_, Some(text)) if !(begin..end).contains(&at) => (**text).clone(),
            _ => return None,
        };
        let mut alone = Stmt::new(stmt.span, Op::Comment(text));
        alone.number = stmt.number.filter(|_| matches!(stmt.op, Op::Comment(_)));
        Some(alone)
    };
    let mut hole = Some((hole, ops));
    for (at, stmt) in moves.iter().enumerate() {
        if at > cut
            && let Some((stmt, ops)) = hole.take()
        {
            made.replace(stmt, ops);
        }
        remark(at, stmt).into_iter().for_each(|stmt| made.push(stmt));
    }
    if let Some((stmt, ops)) = hole {
        made.replace(stmt, ops);
    }
}

/// Whether the next statement may depend on the active motion mode.
fn inherits_motion(rest: &[Stmt]) -> bool {
    for stmt in rest {
        match stmt.op.unwrapped() {
            Op::Position(_) | flow!() => return true,
            Op::StartCycle(_) | Op::ProgramEnd | Op::BeginAgain | moves!() if stmt.skip.is_none() => {
                return false;
            }
            _ => {}
        }
    }
    // The end of a subprogram, or of a text that continues.
    false
}

/// Whether the machine does the same: executes both from the current position.
fn is_same(walk: &Walk, feed: Option<Num>, moves: &[Stmt], cycle: &[Stmt]) -> bool {
    let mut world = World::generate(1, &Modes::default());
    world.power_on.work_offset = Some(1);
    let mut start = Exec::new(&world, 0);
    start.assume(&walk.at.modes);
    let known: [Option<i64>; AXES] = walk.at.position;
    start.stand_at(&known.map(|at| Some(at.unwrap_or(0))));
    // The program never sets an unknown feed.
    let odd = Num { mantissa: 7_654_321, scale: 4, point: true, unit: Unit::Mm };
    let feed = Stmt::new(Span::default(), Op::SetFeedRate(feed.unwrap_or(odd).into()));
    let events = |stmts: &[Stmt]| -> Option<Vec<Event>> {
        let (mut exec, mut out) = (start.clone(), Vec::new());
        exec.step(&feed, &mut out).ok()?;
        for stmt in stmts {
            exec.step(stmt, &mut out).ok()?;
        }
        Some(out)
    };
    let (Some(a), Some(b)) = (events(moves), events(cycle)) else { return false };
    let alike = |(a, b): (&Event, &Event)| {
        a.kind == b.kind && a.end == b.end && a.rate == b.rate && a.state == b.state && a.inch == b.inch
    };
    a.len() == b.len() && a.iter().zip(&b).all(alike)
}
