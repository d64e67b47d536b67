//! `expand-turns`: an arc of several turns becomes whole turns and a rest.
//!
//! The way along the third axis is shared out in proportion to the angle.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::ARC;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{rebuild, rounded, unit_of};
use crate::target::Target;
use ncc_ir::canon::{Axis, Turn};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::num::Nanos;
use ncc_ir::geometry;
use ncc_ir::geometry::offset_path::{Leg, Spot};
use ncc_ir::lack::ArcsLack;
use ncc_ir::program::cycle::absolute;
use ncc_ir::program::{Arc, Centre, CentreFrom, Op, Point, Program, Stmt, Turns};
use ncc_ir::syntax::Ranged;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "expand-turns",
    about: "splits arcs of several turns into single turns",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |l, p| p.needs(ARC) && !l.target.caps.arcs.turns,
        |l, p| expand_turns(p.stmts, &mut p.start.clone(), &l.target, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// Most turns of one arc; more is a slip of the pen.
const MOST_TURNS: u32 = 10_000;

/// Splits the arcs.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| expand_turns(body, walk, target, diags));
}

/// The same for one body.
pub(crate) fn expand_turns(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    rebuild(body, |stmt, made| {
        walk.enter(stmt.skip);
        let arcs = match &stmt.op {
            Op::ArcFeed(arc) if !arc.turns.is_none() => Some(split(arc, walk, target)),
            _ => None,
        };
        walk.step(&stmt);
        match arcs {
            None => made.push(stmt),
            Some(Ok(arcs)) => {
                diags.push(Diagnostic::new(Fault::BlockSplit, stmt.span));
                let first = stmt.joined;
                made.replace(
                    stmt,
                    arcs.into_iter()
                        .enumerate()
                        .map(|(k, arc)| (first && k == 0, Op::ArcFeed(Box::new(arc)))),
                );
            }
            Some(Err(fault)) => {
                diags.push(Diagnostic::new(fault, stmt.span));
                made.push(stmt);
            }
        }
    });
}

/// The leg of a path about a centre.
///
/// # Errors
/// As of [`Turns::count`].
pub(crate) fn leg(arc: &Arc, centre: Spot) -> Result<Leg, Fault> {
    Ok(Leg::Arc { centre, ccw: arc.turn == Turn::Counterclockwise, turns: arc.turns.count()? })
}

fn split(arc: &Arc, walk: &Walk, target: &Target) -> Result<Vec<Arc>, Fault> {
    let turns = arc.turns.count()?;
    if turns > MOST_TURNS {
        return Err(Fault::OutOfRange { word: Ranged::Turns });
    }
    let plane = walk.at.plane(arc.plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
    let (first, second, normal) = plane.axes();
    let words = [first, second, normal];
    if Axis::ALL.into_iter().any(|a| !words.contains(&a) && arc.to.get(a).is_some()) {
        return Err(Fault::lacks(ArcsLack::TurnsWithRotaryAxis));
    }
    // A whole turn has no radius that says it.
    let mut by_centre = arc.clone();
    crate::arcs::convert_arcs::centre_of(&mut by_centre, walk, target)?;
    let arc = &by_centre;
    let mut turn = arc.clone();
    turn.turns = Turns::NONE;
    turn.to = Point::default();
    // A whole circle leaves the axes where they are, so that every turn has the same centre words.
    if let Centre::Point { words, from: CentreFrom::Zero } = &mut turn.centre {
        for axis in [first, second] {
            if words[axis as usize].is_none() {
                let nanos = walk.at.position[axis as usize];
                let nanos = nanos.ok_or(Fault::PositionUnknown { axis: axis.letter() as char })?;
                words[axis as usize] = Some(crate::support::write::exact(nanos, walk.unit()).into());
            }
        }
    }
    let mut rest = arc.clone();
    rest.turns = Turns::NONE;
    let mut arcs = vec![turn; turns as usize];
    if arc.to.get(normal).is_some() {
        if walk.waiting {
            // The length takes effect on the way, by so much more or less of it.
            return Err(Fault::lacks(ArcsLack::TurnsWithLength));
        }
        let levels = levels((arc, turns), walk, [first, second, normal])?;
        let unit = unit_of(normal, walk.unit());
        for (arc, level) in arcs.iter_mut().zip(levels) {
            arc.to.set(normal, absolute(rounded(level, target.decimals_in(unit), unit)));
        }
        // The end is stated from zero: an increment would count from a rounded level.
        if let Some(end) = walk.at.target(&arc.to)[normal as usize] {
            let same = rest
                .to
                .get(normal)
                .is_some_and(|w| crate::support::write::is_absolute(w, walk.at.modes.distance));
            if !same {
                rest.to.set(normal, crate::support::write::at(end, normal, walk.unit()));
            }
        }
    }
    let whole = |axis: Axis| {
        let now = walk.at.position[axis as usize];
        arc.to.get(axis).is_none_or(|w| now.is_some() && walk.at.resolve(w, now) == now)
    };
    if whole(first) && whole(second) {
        // The rest is a whole turn as well, which needs its centre.
        rest.centre = arcs.first().map_or_else(|| arc.centre.clone(), |a| a.centre.clone());
    }
    arcs.push(rest);
    Ok(arcs)
}

/// Levels of the third axis after each whole turn.
fn levels((arc, turns): (&Arc, u32), walk: &Walk, axes: [Axis; 3]) -> Result<Vec<Nanos>, Fault> {
    let [first, second, normal] = axes;
    let to = walk.at.target(&arc.to);
    let known = |axis: Axis, at: &[Option<Nanos>; 6]| {
        at[axis as usize].ok_or(Fault::PositionUnknown { axis: axis.letter() as char })
    };
    let here = &walk.at.position;
    let start = [known(first, here)?, known(second, here)?];
    let end = [known(first, &to)?, known(second, &to)?];
    let (low, high) = (known(normal, here)?, known(normal, &to)?);
    let centre = walk.at.centre(arc).ok_or(Fault::PositionUnknown { axis: first.letter() as char })?;
    let total = geometry::sweep_degrees(start, end, centre, arc.turn, turns).abs();
    let way = (high - low) as f64;
    Ok((1..=turns).map(|k| low + (way * 360.0 * f64::from(k) / total).round() as Nanos).collect())
}
