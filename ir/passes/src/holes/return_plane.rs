//! `return-plane`: where a cycle leaves the tool, by a stated plane or by a level.
//!
//! A control with levels goes to the retract plane, or to where the tool stood when the cycle was
//! activated. A plane that is neither of them is reached by writing the first hole out: after it the
//! tool stands at the plane, and the cycle that is activated then returns to there. A stated plane
//! below the retract plane is not made: controls that state planes refuse it. What cannot be mended
//! so is left to `expand-cycles`.

use crate::holes::expand_cycles;
use crate::holes::expand_patterns;
use crate::holes::sayable::{level, sayable};
use crate::pass::{Moment, Pass, Step};
use crate::support::needs::CYCLE;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{at, rebuild};
use crate::target::Target;
use ncc_ir::canon::{Distance, Fact, ReturnLevel};
use ncc_ir::caps::ReturnsTo;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::cycle::Cycle;
use ncc_ir::program::kinds::{flow, moves};
use ncc_ir::program::{Coord, Move, Op, Point, Program, Stmt};
use ncc_ir::track::{ActiveCycle, Tracker};

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "return-plane",
    about: "states the return of cycles by planes or by levels",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(CYCLE),
        |l, p| convert_return_plane(p.stmts, &mut p.start.clone(), &l.target, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// Puts one in the other's place, as the target has it.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| convert_return_plane(body, walk, target, diags));
}

/// The same for one piece of a body.
pub(crate) fn convert_return_plane(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    // Holes of a cycle that was activated before stay as they are.
    if !body.iter().any(|stmt| matches!(stmt.op, Op::StartCycle(_))) {
        return;
    }
    match target.caps.holes.returns {
        ReturnsTo::Plane => by_planes(body, walk),
        ReturnsTo::Level => by_levels(body, walk, target, diags),
        ReturnsTo::Either => {}
    }
}

/// States the planes of cycles that return to a level.
fn by_planes(body: &mut [Stmt], walk: &mut Walk) {
    for i in 0..body.len() {
        walk.step(&body[i]);
        let Op::StartCycle(cycle) = &body[i].op else { continue };
        if cycle.return_plane.is_some() {
            continue;
        }
        let in_force = walk.at.modes.return_level.filter(|_| keeps_level(&body[i + 1..]));
        let returns = cycle.return_level.known().or(in_force);
        let plane = returns.and_then(|l| plane_of(walk, cycle, l));
        if let (Some(plane), Op::StartCycle(cycle)) = (plane, &mut body[i].op) {
            cycle.return_plane = Some(plane);
            if returns == Some(ReturnLevel::Retract) {
                cycle.kind.end_feed_at_retract();
            }
        }
    }
}

/// Whether the cycle that has just been activated surely ends before the return level is another.
fn keeps_level(after: &[Stmt]) -> bool {
    let ends = |s: &&Stmt| {
        matches!(s.op, Op::EndCycle | Op::ProgramEnd | Op::BeginAgain | moves!()) && s.skip.is_none()
    };
    let changes = |s: &&Stmt| matches!(s.op, Op::SetReturnLevel(_) | flow!());
    let end = after.iter().position(|s| ends(&s));
    let change = after.iter().position(|s| changes(&s));
    end.is_some_and(|end| change.is_none_or(|change| end < change))
}

fn plane_of(walk: &Walk, cycle: &Cycle, to: ReturnLevel) -> Option<Coord> {
    let in_force = walk.at.cycle.as_ref()?;
    let normal = walk.at.plane(cycle.plane)?.axes().2;
    match to {
        ReturnLevel::Retract => level(walk, &cycle.retract, in_force.retract, normal).ok(),
        ReturnLevel::Initial if walk.waiting => None,
        ReturnLevel::Initial => {
            let initial = in_force.initial.filter(|i| in_force.retract.is_some_and(|r| *i >= r))?;
            Some(at(initial, normal, walk.unit()))
        }
    }
}

/// What becomes of a cycle that states a plane.
enum Level {
    /// It is one of the target's levels.
    Is(ReturnLevel),
    /// It becomes the initial level after the first hole.
    BehindFirst(Box<Split>),
    /// Neither.
    No,
}

/// A cycle of which the first hole is expanded.
struct Split {
    /// Place of the statement that makes it.
    hole: usize,
    /// Its moves.
    moves: Vec<(bool, Op)>,
    /// The cycle for the other holes.
    cycle: Cycle,
    /// Other holes of the same statement.
    others: Vec<Point>,
}

fn by_levels(body: &mut Vec<Stmt>, walk: &mut Walk, target: &Target, diags: &mut Vec<Diagnostic>) {
    let input = body.clone();
    let mut i = 0;
    let mut split: Option<Box<Split>> = None;
    rebuild(body, |mut stmt, made| {
        let here = i;
        i += 1;
        walk.enter(stmt.skip);
        if let Some(first) = split.take_if(|s| s.hole == here) {
            let Split { mut moves, cycle, others, .. } = *first;
            diags.push(Diagnostic::new(Fault::CycleExpanded { kind: cycle.kind.name().into() }, stmt.span));
            if !others.is_empty() {
                let holes = others.len() as u32 + 1;
                diags.push(Diagnostic::new(Fault::PatternExpanded { holes }, stmt.span));
            }
            moves.push((false, Op::StartCycle(Box::new(cycle))));
            moves.extend(others.into_iter().map(|to| (false, Op::Hole(Move { to, said: false }))));
            for (_, op) in &moves {
                walk.step(&Stmt::new(stmt.span, op.clone()));
            }
            return made.replace(stmt, moves);
        }
        let chained = walk.at.cycle.is_some();
        let found = match &stmt.op {
            Op::StartCycle(cycle) if cycle.return_plane.is_some() => {
                let mut inner = walk.clone();
                inner.step(&stmt);
                level_of(&input, here, cycle, &inner, target)
            }
            _ => Level::No,
        };
        match (found, &mut stmt.op) {
            (Level::BehindFirst(found), _) => {
                split = Some(found);
                if !chained {
                    return made.leave_out(stmt);
                }
                stmt.op = Op::EndCycle;
            }
            (Level::Is(level), Op::StartCycle(cycle)) => {
                cycle.return_level = Fact::Known(level);
                cycle.return_plane = None;
            }
            (Level::Is(_) | Level::No, _) => {}
        }
        walk.step(&stmt);
        made.push(stmt);
    });
}

/// The walk stands after the call.
fn level_of(body: &[Stmt], i: usize, cycle: &Cycle, walk: &Walk, target: &Target) -> Level {
    let Some(in_force) = &walk.at.cycle else { return Level::No };
    let Some(plane) = &cycle.return_plane else { return Level::No };
    let says = |level| {
        let cycle = Cycle { return_plane: None, return_level: Fact::Known(level), ..cycle.clone() };
        let mut nothing = Vec::new();
        sayable(walk, &cycle, target, body[i].span, &mut nothing) && nothing.is_empty()
    };
    let absolute = plane.distance == Fact::Known(Distance::Absolute);
    let same = |other: Option<Nanos>| other.is_some() && in_force.return_plane == other;
    if (same(in_force.retract) || absolute && *plane == cycle.retract) && says(ReturnLevel::Retract) {
        return Level::Is(ReturnLevel::Retract);
    }
    if !says(ReturnLevel::Initial) {
        return Level::No;
    }
    let not_below = in_force.initial.zip(in_force.retract).is_some_and(|(initial, r)| initial >= r);
    // By which length a level is measured that is found before another one takes effect, is left open.
    if same(in_force.initial) && not_below && !walk.waiting && !changes_level(&body[i + 1..]) {
        return Level::Is(ReturnLevel::Initial);
    }
    match behind_first(body, i, in_force, walk, target) {
        Some(split) => Level::BehindFirst(Box::new(split)),
        None => Level::No,
    }
}

/// Writes the first hole of the cycle activated at `i` out, if others follow.
fn behind_first(
    body: &[Stmt],
    i: usize,
    in_force: &ActiveCycle,
    walk: &Walk,
    target: &Target,
) -> Option<Split> {
    let cycle = &in_force.cycle;
    let normal = walk.at.plane(cycle.plane)?.axes().2;
    let mut new = cycle.clone();
    new.retract = level(walk, &cycle.retract, in_force.retract, normal).ok()?;
    new.depth = level(walk, &cycle.depth, in_force.depth, normal).ok()?;
    (new.reference, new.return_plane) = (None, None);
    new.return_level = Fact::Known(ReturnLevel::Initial);
    in_force.return_plane?;
    if !level_is_free(&body[i + 1..]) || changes_level(&body[i + 1..]) {
        return None;
    }
    let hole = first_hole(body, i, cycle.feed.is_some())?;
    let mut inner = walk.clone();
    body[i + 1..hole].iter().for_each(|s| inner.step(s));
    let (first, others) = match &body[hole].op {
        Op::Hole(m) => (m.to.clone(), Vec::new()),
        Op::Pattern(pattern) => {
            let holes = expand_patterns::holes(&inner, pattern, target.decimals_in(inner.unit())).ok()?;
            // What comes next may count from where the last hole is: it must not be a rounded one.
            let (mut exact, mut rounded) = (inner.clone(), inner.clone());
            exact.step(&body[hole]);
            for to in &holes {
                let op = Op::Hole(Move { to: to.clone(), said: false });
                rounded.step(&Stmt::new(body[hole].span, op));
            }
            if exact.at.position != rounded.at.position {
                return None;
            }
            let mut holes = holes.into_iter();
            (holes.next()?, holes.collect())
        }
        _ => return None,
    };
    if others.is_empty() && !makes_more(&body[hole + 1..]) {
        return None;
    }
    let mut moves = Vec::new();
    expand_cycles::hole(&inner, in_force, &first, cycle.feed.as_ref(), target, &mut moves).ok()?;
    Some(Split { hole, moves, cycle: new, others })
}

/// The statement that makes the first hole of the cycle activated at `i`, if nothing stands between
/// that could change what it does.
fn first_hole(body: &[Stmt], i: usize, states_feed: bool) -> Option<usize> {
    if body[i].skip.is_some() {
        return None;
    }
    for (k, stmt) in body.iter().enumerate().skip(i + 1) {
        match stmt.op.unwrapped() {
            _ if stmt.skip.is_some() => return None,
            Op::Hole(_) | Op::Pattern(_) => return Some(k),
            Op::Comment(_) | Op::Blank | Op::NoEffect(_) | Op::SelectTool(_) | Op::Message(_) => {}
            Op::SetFeedRate(_) if !states_feed => {}
            _ => return None,
        }
    }
    None
}

/// Whether the active cycle may make a hole in what follows.
fn makes_more(body: &[Stmt]) -> bool {
    let makes = |s: &&Stmt| {
        matches!(
            s.op.unwrapped(),
            Op::Hole(_) | Op::Pattern(_) | Op::Position(_) | Op::Call(_) | Op::Label(_)
        )
    };
    let over = |s: &&Stmt| (ends(s) || matches!(s.op, Op::StartCycle(_))) && s.skip.is_none();
    body.iter().find(|s| makes(s) || over(s)).is_none_or(|s| makes(&s))
}

/// Whether a statement ends the active cycle.
fn ends(stmt: &Stmt) -> bool {
    matches!(stmt.op.unwrapped(), Op::EndCycle | Op::ProgramEnd | Op::BeginAgain | moves!())
}

/// Whether another length or work offset comes before the cycle that has just been activated surely ends: by which
/// of them a level is measured that was found before, no source tells.
fn changes_level(after: &[Stmt]) -> bool {
    let over = |s: &&Stmt| ends(s) && s.skip.is_none();
    let other = |s: &&Stmt| {
        matches!(s.op, Op::UseToolLengthOffset(_) | Op::UseToolEdge { .. } | Op::SetOriginOffsets(_))
    };
    after.iter().find(|s| other(s) || over(s)).is_some_and(|s| other(&s))
}

/// Whether no further cycle, activated before this one is ended, counts from the level at which the
/// tool stood when the first was activated; and the end is in sight.
fn level_is_free(body: &[Stmt]) -> bool {
    for stmt in body {
        match &stmt.op {
            Op::StartCycle(cycle) => {
                let retract = cycle.return_level == Fact::Known(ReturnLevel::Retract);
                let returns = retract || cycle.return_plane.is_some();
                if !returns || cycle.retract.distance != Fact::Known(Distance::Absolute) {
                    return false;
                }
            }
            flow!() => return false,
            _ if ends(stmt) && stmt.skip.is_none() => return true,
            _ => {}
        }
    }
    false
}

/// Whether a cycle that the target cannot say becomes sayable by this pass, with nothing known but
/// what the program says; for a branch before the passes run.
pub(crate) fn converts_all(body: &[Stmt], walk: &Walk, target: &Target) -> bool {
    let (mut trial, mut diags) = (body.to_vec(), Vec::new());
    convert_return_plane(&mut trial, &mut walk.clone(), target, &mut diags);
    let mut state = expand_cycles::ExpandCyclesState::default();
    expand_cycles::expand_cycles(&mut trial, &mut walk.clone(), &mut state, target, &mut diags);
    diags.is_empty()
}
