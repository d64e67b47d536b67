//! `approach`: the way to the first hole if the tool does not stand at the retract plane.
//!
//! Controls differ: some go to the plane first, others over the hole first, others the one from below
//! and the other from above. Where the target's approach is not the program's, the first leg becomes a
//! rapid move, after which both approaches are one. What cannot be mended so is left to
//! `expand-cycles`.

use crate::holes::sayable::{level, sayable};
use crate::pass::{Moment, Pass, Step};
use crate::support::needs::CYCLE;
use crate::support::walk::each_body;
use crate::support::walk::{Walk, has_holes};
use crate::support::write::{at, only, traverse};
use crate::target::Target;
use ncc_ir::canon::ReturnLevel;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Nanos;
use ncc_ir::lack::HolesLack;
use ncc_ir::program::cycle::{Approach, Cycle};
use ncc_ir::program::kinds::{flow, moves};
use ncc_ir::program::{Op, Point, Program, Stmt};
use ncc_ir::track::{ActiveCycle, Tracker};

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "approach",
    about: "writes the first leg to a hole out where the target would go another way",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(CYCLE),
        |l, p| convert_approach(p.stmts, &mut p.start.clone(), &l.target, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// Whether the cycle's way to every hole is surely this one, from the levels where the tool is.
pub(crate) fn is_one_way(walk: &Walk, in_force: &ActiveCycle, way: Approach) -> bool {
    let cycle = &in_force.cycle;
    if length_decides(walk, cycle.approach, way) {
        return false;
    }
    if cycle.approach == way {
        return true;
    }
    let Some(plane) = walk.at.plane(cycle.plane) else { return false };
    let Some(retract) = in_force.retract else { return false };
    let returns = cycle.return_level.known().or(walk.at.modes.return_level);
    let leg = |way: Approach, level: Nanos| {
        if cycle.approach != Approach::ClearFirst && way != Approach::ClearFirst {
            // The others look at the level alone.
            return Some(way.leg(level, level, retract, level));
        }
        let out = match returns {
            _ if cycle.return_plane.is_some() => in_force.return_plane,
            Some(ReturnLevel::Retract) => Some(retract),
            Some(ReturnLevel::Initial) => in_force.initial.map(|initial| way.initial(initial, retract)),
            None => None,
        };
        Some(way.leg(level, in_force.initial?, retract, out?))
    };
    let one = |level: Option<Nanos>| {
        level.is_some_and(|level| {
            let legs = [leg(cycle.approach, level), leg(way, level)];
            legs[0].is_some() && legs[0] == legs[1]
        })
    };
    if cycle.return_plane.is_some() {
        return one(walk.at.position[plane.axes().2 as usize]) && one(in_force.return_plane);
    }
    one(walk.at.position[plane.axes().2 as usize])
        && (returns == Some(ReturnLevel::Retract)
            || one(in_force.initial)
                && in_force
                    .initial
                    .is_some_and(|i| cycle.approach.initial(i, retract) == way.initial(i, retract)))
}

/// Whether the target alone chooses the way to the first hole by the tool's height, and a length waits for Z, which then
/// decides too.
pub(crate) fn length_decides(walk: &Walk, own: Approach, way: Approach) -> bool {
    let by_height = |way| matches!(way, Approach::RaiseFirst | Approach::ClearFirst);
    walk.waiting && by_height(way) && !by_height(own)
}

/// Writes out first legs that the target would make in another order.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| convert_approach(body, walk, target, diags));
}

/// The same for one body.
pub(crate) fn convert_approach(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    let Some(way) = target.caps.holes.approach else { return };
    let mut i = 0;
    let in_force = walk.at.cycle.as_ref();
    let mut other_way = in_force.is_some_and(|in_force| in_force.cycle.approach != way);
    let by_height = matches!(way, Approach::RaiseFirst | Approach::ClearFirst);
    // Whether a length was activated under a cycle, so that the way to its next hole depends on it.
    let mut another_length = false;
    while i < body.len() {
        walk.enter(body[i].skip);
        let chained = walk.at.cycle.is_some();
        // What the tool stands above it may not stand above any more.
        if (chained || walk.at.cycle_in_doubt)
            && other_way
            && matches!(
                body[i].op,
                Op::SetFrame(_)
                    | Op::SetSlot(_)
                    | Op::SetPosition(_)
                    | Op::UseOriginShift(_)
                    | Op::ClearFrame(_)
                    | Op::SetOriginOffsets(_)
            )
        {
            diags.push(Diagnostic::new(Fault::lacks(HolesLack::ZeroUnderApproach), body[i].span));
        }
        another_length = chained && by_height && other_way && (another_length || body[i].op.calls_length());
        if another_length
            && walk.waiting
            && matches!(body[i].op, Op::Position(_) | Op::Hole(_) | Op::Pattern(_))
        {
            diags.push(Diagnostic::new(Fault::lacks(HolesLack::LengthAtHole), body[i].span));
        }
        if let Op::StartCycle(cycle) = &body[i].op {
            another_length = false;
            other_way = cycle.approach != way || other_way && body[i].skip.is_some();
        }
        walk.step(&body[i]);
        if let Op::StartCycle(cycle) = &body[i].op
            && cycle.approach != way
            && let Some(leg) = first_leg(body, i, cycle, chained, walk, target)
        {
            let (rapid, hole, cycle) = leg;
            body[i].op = Op::StartCycle(Box::new(cycle));
            if let Some((at, to)) = hole
                && let Op::Hole(m) = &mut body[at].op
            {
                m.to = to;
            }
            if let Some(to) = rapid {
                let mut before = Stmt::new(body[i].span, traverse(to));
                before.skip = body[i].skip;
                if body[i].joined {
                    body[i].joined = false;
                }
                // The walk has passed this place: the rapid is part of what the cycle does first.
                body.insert(i, before);
                i += 1;
            }
        }
        i += 1;
    }
}

/// A rapid to be made before, the first hole with other words, the cycle in the target's way.
type Leg = (Option<Point>, Option<(usize, Point)>, Cycle);

fn first_leg(
    body: &[Stmt],
    i: usize,
    cycle: &Cycle,
    chained: bool,
    walk: &Walk,
    target: &Target,
) -> Option<Leg> {
    let in_force = walk.at.cycle.as_ref()?;
    let way = target.caps.holes.approach?;
    if length_decides(walk, cycle.approach, way) {
        return None;
    }
    let mut other = cycle.clone();
    other.approach = way;
    if is_one_way(walk, in_force, way) {
        return Some((None, None, other));
    }
    // A rapid would end the cycle that is active, and change a level to return to.
    let returns = cycle.return_level.known().or(walk.at.modes.return_level);
    // A stated plane is one and the same wherever the tool stood; the next hole is made from there.
    let one = in_force
        .return_plane
        .zip(in_force.retract)
        .is_some_and(|(plane, r)| cycle.approach.retracts(plane, r) == way.retracts(plane, r));
    let stays = match cycle.return_plane {
        None => returns == Some(ReturnLevel::Retract),
        Some(_) => one,
    };
    if chained || !stays {
        return None;
    }
    let mut nothing = Vec::new();
    if !sayable(walk, cycle, target, body[i].span, &mut nothing) || !nothing.is_empty() {
        return None;
    }
    let normal = walk.at.plane(cycle.plane)?.axes().2;
    let now = walk.at.position[normal as usize]?;
    let retract = level(walk, &cycle.retract, in_force.retract, normal).ok()?;
    let depth = level(walk, &cycle.depth, in_force.depth, normal).ok()?;
    // After the rapid both ways must be one: at the retract plane they are.
    let first = cycle.approach.retracts(now, in_force.retract?);
    if other.retract != retract {
        (other.retract, other.reference) = (retract.clone(), None);
    }
    // A cycle without a hole makes no move.
    let (at_hole, to) = first_hole(body, i)?;
    match first {
        // The rapid changes the level to return to, which a further cycle would inherit.
        true if is_last(body, i) => Some((Some(only(normal, retract)), None, other)),
        true => None,
        false => {
            other.depth = depth;
            let mut words = to?.clone();
            words.axes[normal as usize] = None;
            for (axis, word) in ncc_ir::canon::Axis::ALL.into_iter().zip(&mut words.axes) {
                if let Some(coord) = word {
                    let from = walk.at.position[axis as usize];
                    let nanos = walk.at.resolve(coord, from)?;
                    if coord.distance.known() != Some(ncc_ir::canon::Distance::Absolute) {
                        *coord = at(nanos, axis, walk.unit());
                    }
                }
            }
            Some((Some(words.clone()), Some((at_hole, words)), other))
        }
    }
}

/// The first hole of the cycle activated at `i`, if nothing stands between that could change the way
/// to it and it is skipped with the call or not at all. Of a pattern no position is given.
fn first_hole(body: &[Stmt], i: usize) -> Option<(usize, Option<&Point>)> {
    for (k, stmt) in body.iter().enumerate().skip(i + 1) {
        match &stmt.op {
            Op::Hole(m) if stmt.skip == body[i].skip => return Some((k, Some(&m.to))),
            Op::Pattern(pattern) if stmt.skip == body[i].skip && has_holes(pattern) => {
                return Some((k, None));
            }
            Op::Comment(_) | Op::Blank | Op::NoEffect(_) | Op::SetFeedRate(_) | Op::SelectTool(_) => {}
            // Anything else could be part of what the rapid is made with.
            _ => return None,
        }
    }
    None
}

/// Whether the cycle activated at `i` surely ends before another is activated.
fn is_last(body: &[Stmt], i: usize) -> bool {
    for stmt in &body[i + 1..] {
        match stmt.op.unwrapped() {
            Op::EndCycle | Op::ProgramEnd | Op::BeginAgain | moves!() if stmt.skip.is_none() => return true,
            Op::StartCycle(_) | Op::Position(_) | flow!() => return false,
            _ => {}
        }
    }
    false
}
