//! `arcs-by-centre` and `arcs-by-radius`: every arc is given in one way.
//!
//! A radius is written where it says the same arc to within the target's digits: not for whole
//! circles and turns, and not near half a turn, where a digit of the radius moves the centre far.
//! Such arcs keep their centre.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::ARC;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{EXACT, rounded, unit_of};
use crate::target::Target;
use ncc_ir::canon::{Axis, Units};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, POW10, Unit};
use ncc_ir::geometry;
use ncc_ir::program::{Arc, Centre, CentreFrom, Op, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const BY_CENTRE: Pass =
    Pass::named("arcs-by-centre", "gives arcs by radius their centre", Some(by_centre));

/// This pass.
pub(crate) const BY_RADIUS: Pass = Pass::named(
    "arcs-by-radius",
    "gives arcs their radius instead of the centre, where it says the same",
    Some(by_radius),
);

/// This pass.
pub(crate) const FINE: Pass = Pass {
    name: "fine-arcs",
    about: "refuses arcs that the target's digits do not resolve",
    alone: None,
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(ARC),
        |l, p| too_fine(p.stmts, &mut p.start.clone(), &l.target, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// By centre, from the start of the arc.
pub fn by_centre(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_arc(program, entry, diags, |arc, walk| centre_of(arc, walk, target));
}

pub(crate) fn centre_of(arc: &mut Arc, walk: &Walk, target: &Target) -> Result<(), Fault> {
    if matches!(arc.centre, Centre::Point { .. }) {
        return Ok(());
    }
    let Some((first, second, start, centre)) = round(arc, &walk.at) else {
        return Err(unknown(arc, &walk.at));
    };
    let mut words: [Option<Expr>; 3] = [None, None, None];
    let length = length_unit(arc, walk);
    for (i, axis) in [first, second].into_iter().enumerate() {
        let unit = unit_of(axis, length);
        let word = rounded(centre[i].wrapping_sub(start[i]), target.decimals_in(unit), unit);
        words[axis as usize] = Some(word.into());
    }
    arc.centre = Centre::Point { words, from: CentreFrom::Start };
    Ok(())
}

/// Unit of length in which an arc is written. Where the active unit is not known, the words of the arc may still state
/// theirs: the blocks of a subprogram that is cloned for its callers do.
fn length_unit(arc: &Arc, walk: &Walk) -> Unit {
    let inch = |value: &Expr| value.literal().is_some_and(|n| n.unit == Unit::Inch && !n.is_zero());
    let radius = match &arc.centre {
        Centre::Radius(radius) => Some(radius),
        Centre::Point { .. } => None,
    };
    let mut words = arc.to.axes.iter().flatten().map(|word| &word.value).chain(radius);
    match walk.at.modes.units {
        None if words.any(inch) => Unit::Inch,
        _ => walk.unit(),
    }
}

/// Whether an arc by radius may have more digits than a target that writes so many in mm.
pub(crate) fn may_be_too_fine(op: &Op, decimals: u8) -> bool {
    let Op::ArcFeed(arc) = op else { return false };
    let finer = |value: &Expr| value.literal().is_some_and(|n| n.trimmed().scale > decimals);
    let Centre::Radius(radius) = &arc.centre else { return false };
    finer(radius) || arc.to.axes.iter().flatten().any(|word| finer(&word.value))
}

/// Gives arcs by radius their centre where the target rounds the radius or the end: their centre would move further
/// than that, the more the nearer they are to half a turn.
pub(crate) fn too_fine(stmts: &mut [Stmt], walk: &mut Walk, target: &Target, diags: &mut Vec<Diagnostic>) {
    for stmt in stmts {
        walk.enter(stmt.skip);
        // The writer rounds a centre's word together with the start that it is measured from.
        let exact = Target { decimals: EXACT, ..Target::default() };
        if let Op::ArcFeed(arc) = &stmt.op
            && may_be_too_fine(&stmt.op, target.decimals_in(length_unit(arc, walk)))
            && let Op::ArcFeed(arc) = &mut stmt.op
            && centre_of(arc, walk, &exact).is_ok()
        {
            diags.push(Diagnostic::new(Fault::ArcReformatted, stmt.span));
        }
        walk.step(stmt);
    }
}

/// By radius, where that says the same.
pub fn by_radius(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_arc(program, entry, diags, |arc, walk| {
        if matches!(arc.centre, Centre::Radius(_)) || !arc.turns.is_none() {
            return Ok(());
        }
        let Some((first, second, start, centre)) = round(arc, &walk.at) else {
            return Err(unknown(arc, &walk.at));
        };
        let end = walk.at.target(&arc.to);
        let (Some(x), Some(y)) = (end[first as usize], end[second as usize]) else {
            return Err(unknown(arc, &walk.at));
        };
        let end = [x, y];
        let radius = ((start[0] - centre[0]) as f64).hypot((start[1] - centre[1]) as f64).round() as Nanos;
        let long = geometry::sweep_degrees(start, end, centre, arc.turn, 0).abs() > 180.0;
        let unit = length_unit(arc, walk);
        let decimals = target.decimals_in(unit);
        let word = rounded(if long { -radius } else { radius }, decimals, unit);
        let Some(said) = word.nanos(false) else { return Ok(()) };
        let half = match unit {
            Unit::Inch => POW10[9 - decimals.min(9) as usize] * 127 / 10,
            Unit::One | Unit::Mm | Unit::Entry | Unit::Degree | Unit::Second => {
                POW10[9 - decimals.min(9) as usize] / 2
            }
        };
        if let Ok(again) = geometry::centre_by_radius(start, end, said, arc.turn, 0)
            && start != end
            && again.iter().zip(centre).all(|(a, b)| a.abs_diff(b) <= half as u64)
        {
            arc.centre = Centre::Radius(word.into());
        }
        Ok(())
    });
}

/// Axes of the plane, start and centre, as far as they are known.
fn round(arc: &Arc, at: &Tracker) -> Option<(Axis, Axis, [Nanos; 2], [Nanos; 2])> {
    let (first, second, _) = at.plane(arc.plane)?.axes();
    let start = [at.position[first as usize]?, at.position[second as usize]?];
    Some((first, second, start, at.centre(arc)?))
}

fn unknown(arc: &Arc, at: &Tracker) -> Fault {
    let Some(plane) = at.plane(arc.plane) else {
        return Fault::EntryFactNeeded { fact: ncc_ir::diag::ModeName::Plane };
    };
    let (first, second, _) = plane.axes();
    let axis = [first, second].into_iter().find(|a| at.position[*a as usize].is_none());
    match (axis, at.modes.units) {
        (Some(axis), _) => Fault::PositionUnknown { axis: axis.letter() as char },
        (None, None::<Units>) => Fault::EntryFactNeeded { fact: ncc_ir::diag::ModeName::Units },
        (None, Some(_)) => Fault::ArcRadiusTooSmall,
    }
}

fn each_arc(
    program: &mut Program,
    entry: &Tracker,
    diags: &mut Vec<Diagnostic>,
    mut each: impl FnMut(&mut Arc, &Walk) -> Result<(), Fault>,
) {
    each_body(program, entry, |body, walk| {
        for stmt in body {
            walk.enter(stmt.skip);
            let Stmt { op, span, .. } = stmt;
            if let Op::ArcFeed(arc) = op
                && let Err(fault) = each(arc, walk)
            {
                diags.push(Diagnostic::new(fault, *span));
            }
            walk.step(stmt);
        }
    });
}
