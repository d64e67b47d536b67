//! `fold-patterns`: positions of holes become circles, grids, lines and lists again.
//!
//! A stretch of holes that stand one after another under one cycle is looked through for the longest
//! patterns that the target supports. A pattern is taken only if its every hole, computed by
//! the same rule that executes it, is within half the least increment that the program writes
//! of each coordinate; zeros at the end are often left out, so that this is at most half of a
//! thousandth of a millimetre (of a tenth of a thousandth of an inch), or of what the target writes
//! if that is coarser. So 15.588 is a point of the circle of radius 18. The order of the holes stays.
//!
//! Parameters are the simplest decimals with which that holds. Three or four holes are nearly always
//! on some circle or other; such a circle, and a line or grid at an angle, is taken only if it takes
//! no more digits to write than its holes. What is in no pattern stays, or becomes a list where the
//! target supports one that takes as many holes, from three on.
//!
//! Where a target's patterns begin where the tool is, a traverse to the first hole is written
//! before the cycle: the same move that the cycle would make.
//!
//! Not looked through: holes that may be skipped, under a cycle in doubt, with a remark of their own
//! (but the first), with words outside the plane, at places that are not known.

mod choose;
mod circle;
mod decimal;
mod rows;

use crate::pass::Pass;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, at, is_absolute, traverse};
use crate::target::Target;
use choose::{Found, Stretch};
use ncc_ir::canon::{Axis, Plane, ReturnLevel};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, Unit};
use ncc_ir::program::cycle::Pattern;
use ncc_ir::program::{Op, Point, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass =
    Pass::named("fold-patterns", "turns positions of holes into circles, grids, lines and lists", Some(run));

/// Positions are taken to be written to at least so many digits after the point in mm, and one more in
/// inches: a program leaves zeros at the end out.
pub const LEAST_DIGITS: u8 = 3;

/// Holes of a stretch; a longer one is folded in pieces, so that the work does not grow beyond
/// measure.
const MOST_HOLES: usize = 4096;

/// Folds what the target can say.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| fold_positions(body, walk, target, diags));
}

/// The same for one body.
pub(crate) fn fold_positions(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    let caps = &target.caps;
    let none =
        !caps.holes.circles && caps.holes.grid_upto == 0 && !caps.holes.lines && caps.holes.list_upto == 0;
    if none || caps.flat {
        return;
    }
    let input = std::mem::take(body);
    let mut made = Rebuild::new(input.len());
    // Where the tool stands in what has been made: off by less than half a unit after a pattern.
    let mut now = walk.clone();
    let mut rest = &input[..];
    while let Some((stmt, others)) = rest.split_first() {
        walk.enter(stmt.skip);
        let holes = stretch(rest, walk);
        now.enter(stmt.skip);
        if holes.len() < 3 {
            walk.step(stmt);
            now.step(stmt);
            made.push(stmt.clone());
            rest = others;
            continue;
        }
        let (stmts, others) = rest.split_at(holes.len());
        let stretch = Stretch::new(holes, walk, target, only_holes_since(&made));
        fold(stmts, &stretch, &mut now, &mut made, diags);
        stmts.iter().for_each(|stmt| walk.step(stmt));
        rest = others;
    }
    *body = made.out;
}

/// A hole of a stretch.
#[derive(Clone, Copy, Debug)]
struct Hole {
    /// Its place in the plane.
    at: [Nanos; 2],
    /// Digits after the point of its words; 0 where it has none.
    digits: [u8; 2],
}

/// A hole's place in the unit of the program, and half the least increment of each word.
#[derive(Clone, Copy, Debug)]
struct Spot {
    at: [f64; 2],
    half: [f64; 2],
}

impl Spot {
    /// Whether that is the same place, as far as it is written.
    fn is_at(&self, place: [f64; 2]) -> bool {
        (0..2).all(|i| (place[i] - self.at[i]).abs() <= self.half[i] + 1e-9)
    }

    /// The greater half unit.
    fn coarse(&self) -> f64 {
        self.half[0].max(self.half[1])
    }
}

/// The plane of the active cycle.
fn plane(walk: &Walk) -> Option<Plane> {
    if walk.at.cycle_in_doubt {
        return None;
    }
    walk.at.plane(walk.at.cycle.as_ref()?.cycle.plane)
}

/// Tool position in the plane.
fn here(walk: &Walk) -> Option<[Nanos; 2]> {
    let (first, second, _) = plane(walk)?.axes();
    Some([walk.at.position[first as usize]?, walk.at.position[second as usize]?])
}

/// The holes that stand one after another from here.
fn stretch(stmts: &[Stmt], walk: &Walk) -> Vec<Hole> {
    let mut holes = Vec::new();
    if !matches!(stmts[0].op, Op::Hole(_)) {
        return holes;
    }
    let Some(plane) = plane(walk) else { return holes };
    let (first, second, _) = plane.axes();
    let mut inner = walk.at.clone();
    for (k, stmt) in stmts.iter().enumerate().take(MOST_HOLES) {
        let Op::Hole(m) = &stmt.op else { break };
        let other = |axis: Axis| axis != first && axis != second && m.to.get(axis).is_some();
        // A remark stays where it is, so its hole begins a stretch of its own.
        let own = k > 0 && (stmt.joined || stmt.comment.is_some());
        if stmt.skip.is_some() || own || Axis::ALL.into_iter().any(other) {
            break;
        }
        let to = inner.target(&m.to);
        let (Some(x), Some(y)) = (to[first as usize], to[second as usize]) else { break };
        let scale = |axis| m.to.get(axis).and_then(|word| word.value.literal()).map(|n| n.trimmed().scale);
        let last = holes.last().map_or([0, 0], |hole: &Hole| hole.digits);
        let digits = [scale(first).unwrap_or(last[0]), scale(second).unwrap_or(last[1])];
        holes.push(Hole { at: [x, y], digits });
        inner.apply(&stmt.op);
    }
    holes
}

/// Passes a stretch of holes on, folded.
fn fold(
    stmts: &[Stmt],
    stretch: &Stretch<'_>,
    now: &mut Walk,
    made: &mut Rebuild,
    diags: &mut Vec<Diagnostic>,
) {
    let mut next = 0;
    for (at, found) in plan(stmts, stretch, now) {
        for stmt in &stmts[next..at] {
            now.step(stmt);
            made.push(stmt.clone());
        }
        next = at + found.count;
        put(&stmts[at], &found, stretch, at, now, made, diags);
        pass(now, &found.pattern, stretch, at);
    }
    for stmt in &stmts[next..] {
        now.step(stmt);
        made.push(stmt.clone());
    }
}

/// Which patterns begin at which holes.
fn plan(stmts: &[Stmt], stretch: &Stretch<'_>, now: &Walk) -> Vec<(usize, Found)> {
    let mut plan = Vec::new();
    let mut now = now.clone();
    let mut at = 0;
    while at < stmts.len() {
        let found = stretch.best(at, &now).filter(|found| {
            // A longer one that begins among the next holes is not broken up.
            let mut inner = now.clone();
            (1..found.count.min(3)).all(|ahead| {
                inner.step(&stmts[at + ahead - 1]);
                let later = stretch.best(at + ahead, &inner);
                later.is_none_or(|later| later.count <= found.count + ahead)
            })
        });
        match found {
            Some(found) => {
                pass(&mut now, &found.pattern, stretch, at);
                let count = found.count;
                plan.push((at, found));
                at += count;
            }
            None => {
                now.step(&stmts[at]);
                at += 1;
            }
        }
    }
    with_lists(plan, stretch, &now)
}

/// Makes a pattern that begins with that hole.
fn pass(now: &mut Walk, pattern: &Pattern, stretch: &Stretch<'_>, at: usize) {
    if choose::begins_here(pattern) && !stretch.begins(pattern, at, now) {
        stand(now, stretch.holes[at].at);
    }
    now.at.apply(&Op::Pattern(Box::new(pattern.clone())));
}

/// Puts the tool there.
fn stand(now: &mut Walk, at: [Nanos; 2]) {
    if let Some((first, second, _)) = plane(now).map(Plane::axes) {
        now.at.position[first as usize] = Some(at[0]);
        now.at.position[second as usize] = Some(at[1]);
    }
}

/// What is in no pattern as lists.
fn with_lists(patterns: Vec<(usize, Found)>, stretch: &Stretch<'_>, now: &Walk) -> Vec<(usize, Found)> {
    let mut plan = Vec::with_capacity(patterns.len());
    let mut next = 0;
    for (at, found) in patterns {
        plan.extend(stretch.list(next..at, now).map(|list| (next, list)));
        next = at + found.count;
        plan.push((at, found));
    }
    plan.extend(stretch.list(next..stretch.holes.len(), now).map(|list| (next, list)));
    plan
}

/// Puts a pattern in the place of its holes, of which this is the first.
fn put(
    stmt: &Stmt,
    found: &Found,
    stretch: &Stretch<'_>,
    at: usize,
    now: &Walk,
    made: &mut Rebuild,
    diags: &mut Vec<Diagnostic>,
) {
    let holes = u32::try_from(found.count).unwrap_or(u32::MAX);
    let pattern = name(&found.pattern).into();
    let (digits, inch) = (stretch.digits, stretch.unit == Unit::Inch);
    let fault = Fault::PatternFolded { pattern, holes, digits, inch };
    diags.push(Diagnostic::new(fault, stmt.span));
    let mut ops = Vec::new();
    if choose::begins_here(&found.pattern) && !stretch.begins(&found.pattern, at, now) {
        lead_in(stretch.holes[at].at, now, made, &mut ops);
    }
    ops.push((false, Op::Pattern(Box::new(found.pattern.clone()))));
    made.replace(stmt.clone(), ops);
}

/// Whether a traverse to the first hole may stand before the cycle, which is then activated there:
/// the cycle must give the same planes, and go to the first hole at the same level.
fn may_lead_in(walk: &Walk) -> bool {
    let (Some(plane), Some(in_force)) = (plane(walk), &walk.at.cycle) else { return false };
    let level = walk.at.position[plane.axes().2 as usize];
    let cycle = &in_force.cycle;
    let absolute = |word| is_absolute(word, walk.at.modes.distance);
    let initial = cycle.return_level.known().or(walk.at.modes.return_level) != Some(ReturnLevel::Retract);
    let own = cycle.return_plane.as_ref().map_or(!initial, absolute);
    let same = level == in_force.initial || own && absolute(&cycle.retract);
    level.is_some() && level >= in_force.retract && in_force.retract.is_some() && same
}

/// Writes the traverse to the first hole, and calls the cycle up after it.
fn lead_in(first_at: [Nanos; 2], walk: &Walk, made: &mut Rebuild, ops: &mut Vec<(bool, Op)>) {
    let (first, second, _) = plane(walk).unwrap_or(Plane::Xy).axes();
    let mut to = Point::default();
    for (axis, nanos) in [first, second].into_iter().zip(first_at) {
        to.set(axis, at(nanos, axis, walk.unit()));
    }
    let called = made.out.iter().rposition(|stmt| matches!(stmt.op, Op::StartCycle(_)));
    let Some(called) = called else { return ops.push((false, traverse(to))) };
    if called + 1 == made.out.len() && made.out[called].skip.is_none() {
        // It has just been activated: the traverse goes before it, in its own block.
        let start = &mut made.out[called];
        let mut aside = Stmt::new(start.span, traverse(to));
        (aside.number, aside.joined) = (start.number.take(), start.joined);
        start.joined = false;
        made.out.insert(called, aside);
        return;
    }
    let start = made.out[called].op.clone();
    ops.extend([(false, traverse(to)), (false, start)]);
}

/// Whether nothing but holes and remarks has come since the cycle was activated, so that it can be
/// activated again.
fn only_holes_since(made: &Rebuild) -> bool {
    let since = made.out.iter().rev().take_while(|stmt| !matches!(stmt.op, Op::StartCycle(_)));
    let holes = |op: &Op| matches!(op, Op::Hole(_) | Op::Pattern(_) | Op::Comment(_) | Op::Blank);
    since.clone().count() < made.out.len() && since.clone().all(|stmt| stmt.skip.is_none() && holes(&stmt.op))
}

/// A pattern's name in reports.
fn name(pattern: &Pattern) -> &'static str {
    match pattern {
        Pattern::Circle { .. } => "circle",
        Pattern::Line { .. } => "line",
        Pattern::Grid { .. } => "grid",
        Pattern::List(_) => "list",
    }
}
