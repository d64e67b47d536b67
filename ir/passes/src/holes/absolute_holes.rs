//! `absolute-holes`: planes and positions of cycles are written from program zero.
//!
//! For targets whose cycles are only known in absolute mode; and where the distance mode of a hole's
//! block would measure the planes of its cycle in another way than they are.

use crate::holes::sayable::level;
use crate::pass::{Moment, Pass, Step};
use crate::support::needs::CYCLE;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{at, is_absolute};
use crate::target::Target;
use ncc_ir::canon::{Axis, Distance, Fact, Plane};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::lack::HolesLack;
use ncc_ir::program::cycle::{First, Pattern};
use ncc_ir::program::{Coord, Move, Op, Program, Stmt};
use ncc_ir::track::Tracker;

/// A pass.
pub(crate) const PASS: Pass = Pass {
    name: "absolute-holes",
    about: "measures planes and positions of cycles from program zero",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |l, p| p.needs(CYCLE) && !l.target.caps.holes.incremental,
        |_, p| state_positions(p.stmts, &mut p.start.clone(), p.diags),
    ),
    program: &[],
    parametric: None,
};

/// A pass.
pub(crate) const ALIKE: Pass = Pass {
    name: "holes-alike",
    about: "measures the planes of a cycle and its positions in one way",
    alone: None,
    step: Step::at(
        Moment::Wording,
        |l, p| p.needs(CYCLE) && l.target.caps.holes.incremental && l.target.caps.holes.measured_anew,
        |_, p| alike(p.stmts, &mut p.start.clone(), p.diags),
    ),
    program: &[],
    parametric: None,
};

/// Makes them absolute.
pub fn run(program: &mut Program, _: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| state_positions(body, walk, diags));
}

/// The same for one body.
pub(crate) fn state_positions(body: &mut [Stmt], walk: &mut Walk, diags: &mut Vec<Diagnostic>) {
    for stmt in body {
        walk.enter(stmt.skip);
        let before = has_other_words(&stmt.op, walk.at.modes.distance).then(|| walk.clone());
        walk.step(stmt);
        let made = match (&mut stmt.op, &before) {
            (Op::StartCycle(_), _) => start_absolute(&mut stmt.op, walk),
            (Op::Hole(m), Some(before)) => absolute_point(m, before),
            (Op::Pattern(pattern), Some(before)) => {
                match before.at.cycle.as_ref().and_then(|c| before.at.plane(c.cycle.plane)) {
                    Some(plane) => pattern_absolute(pattern, plane, before),
                    None if words_of(pattern).next().is_none() => Ok(()),
                    None => Err(Fault::EntryFactNeeded { fact: ModeName::Plane }),
                }
            }
            _ => Ok(()),
        };
        if let Err(fault) = made {
            diags.push(Diagnostic::new(fault, stmt.span));
        }
    }
}

/// Whether places of holes may have words that do not count from program zero.
fn has_other_words(op: &Op, in_force: Option<Distance>) -> bool {
    match op {
        Op::Hole(m) => m.to.axes.iter().flatten().any(|word| !is_absolute(word, in_force)),
        Op::Pattern(_) => true,
        _ => false,
    }
}

/// Whether a hole's words are measured otherwise than the planes of the active cycle.
fn is_placed_otherwise(op: &Op, walk: &Walk) -> bool {
    let (Op::Hole(m), Some(in_force)) = (op, &walk.at.cycle) else { return false };
    let measured = |word: &Coord| word.distance.known().or(walk.at.modes.distance);
    let of_cycle = measured(&in_force.cycle.retract);
    m.to.axes.iter().flatten().any(|word| measured(word) != of_cycle)
}

/// Makes the words of a cycle alike that a target measures alike: the planes, and those of each hole.
pub(crate) fn alike(body: &mut [Stmt], walk: &mut Walk, diags: &mut Vec<Diagnostic>) {
    for stmt in body {
        walk.enter(stmt.skip);
        let distance = walk.at.modes.distance;
        let before = is_placed_otherwise(&stmt.op, walk).then(|| walk.clone());
        walk.step(stmt);
        let zero = |word: &Coord| is_absolute(word, distance);
        let made = match (&mut stmt.op, &walk.at.cycle) {
            (Op::StartCycle(cycle), _) if zero(&cycle.retract) == zero(&cycle.depth) => Ok(()),
            (Op::StartCycle(_), _) => start_absolute(&mut stmt.op, walk),
            (Op::Hole(m), Some(in_force)) => {
                match (in_force.cycle.retract.distance.known().or(distance), &before) {
                    (_, None) => Ok(()),
                    (Some(Distance::Absolute), Some(before)) => absolute_point(m, before),
                    (Some(Distance::Incremental), Some(before)) => incremental_point(m, before),
                    (None, Some(_)) => Err(Fault::lacks(HolesLack::PlacedUnlikePlanes)),
                }
            }
            (_, _) => Ok(()),
        };
        if let Err(fault) = made {
            diags.push(Diagnostic::new(fault, stmt.span));
        }
    }
}

/// The planes of a cycle that is activated, from program zero.
fn start_absolute(op: &mut Op, walk: &Walk) -> Result<(), Fault> {
    let Op::StartCycle(cycle) = op else { return Ok(()) };
    let (Some(in_force), Some(plane)) = (&walk.at.cycle, walk.at.plane(cycle.plane)) else {
        return Err(Fault::EntryFactNeeded { fact: ModeName::Plane });
    };
    let normal = plane.axes().2;
    let retract = level(walk, &cycle.retract, in_force.retract, normal)?;
    let depth = level(walk, &cycle.depth, in_force.depth, normal)?;
    let back = cycle.return_plane.as_ref();
    let back = back.map(|p| level(walk, p, in_force.return_plane, normal)).transpose()?;
    (cycle.retract, cycle.depth, cycle.return_plane) = (retract, depth, back);
    Ok(())
}

/// The words of a hole, from program zero.
fn absolute_point(m: &mut Move, before: &Walk) -> Result<(), Fault> {
    Axis::ALL.into_iter().zip(&mut m.to.axes).try_for_each(|(axis, word)| match word {
        Some(coord) => make_absolute(coord, axis, before),
        None => Ok(()),
    })
}

/// The words of a hole, from where the tool is.
fn incremental_point(m: &mut Move, before: &Walk) -> Result<(), Fault> {
    Axis::ALL.into_iter().zip(&mut m.to.axes).try_for_each(|(axis, word)| {
        let Some(coord) = word.as_mut().filter(|coord| is_absolute(coord, before.at.modes.distance)) else {
            return Ok(());
        };
        let from = before.at.position[axis as usize];
        let way = from.zip(before.at.resolve(coord, from)).and_then(|(from, to)| to.checked_sub(from));
        let way = way.ok_or(Fault::PositionUnknown { axis: axis.letter() as char })?;
        *coord = Coord { distance: Fact::Known(Distance::Incremental), ..at(way, axis, before.unit()) };
        Ok(())
    })
}

/// Words that say where a pattern is, in pairs.
fn words_of(pattern: &mut Pattern) -> impl Iterator<Item = &mut [Coord; 2]> {
    let pairs: [Option<&mut [Coord; 2]>; 2] = match pattern {
        Pattern::Circle { centre, first: First::At(first), .. } => [centre.as_mut(), Some(first)],
        Pattern::Circle { centre: start, first: First::Polar { .. }, .. }
        | Pattern::Line { start, .. }
        | Pattern::Grid { start, .. } => [start.as_mut(), None],
        Pattern::List(_) => [None, None],
    };
    pairs.into_iter().flatten()
}

/// Writes the words of a pattern from program zero, for the walk that stands before it.
///
/// # Errors
/// A place that must be known and is not; the words up to there are written.
pub(crate) fn pattern_absolute(pattern: &mut Pattern, plane: Plane, before: &Walk) -> Result<(), Fault> {
    let (first, second, _) = plane.axes();
    for pair in words_of(pattern) {
        make_absolute(&mut pair[0], first, before)?;
        make_absolute(&mut pair[1], second, before)?;
    }
    if let Pattern::List(points) = pattern {
        let mut at = before.clone();
        for point in points {
            for axis in [first, second] {
                if let Some(word) = &mut point.axes[axis as usize] {
                    make_absolute(word, axis, &at)?;
                }
            }
            at.at.position = at.at.target(point);
        }
    }
    Ok(())
}

fn make_absolute(coord: &mut Coord, axis: Axis, before: &Walk) -> Result<(), Fault> {
    if is_absolute(coord, before.at.modes.distance) {
        return Ok(());
    }
    let nanos = before.at.resolve(coord, before.at.position[axis as usize]);
    let nanos = nanos.ok_or(Fault::PositionUnknown { axis: axis.letter() as char })?;
    *coord = at(nanos, axis, before.unit());
    Ok(())
}
