//! `expand-patterns`: hole patterns become the target's form, or their
//! positions, one block a hole.

use crate::holes::absolute_holes;
use crate::holes::pattern_forms::{self, MOST_HOLES};
use crate::pass::{Moment, Pass, Step};
use crate::support::needs::PATTERN;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, as_absolute, exact, is_absolute, rebuild, rounded, unit_of};
use crate::target::Target;
use ncc_ir::canon::{AXES, Axis, Plane};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, ONE, Unit};
use ncc_ir::program::cycle::{Along, First, Pattern, absolute};
use ncc_ir::program::{Coord, Move, Op, Point, Program, Stmt};
use ncc_ir::syntax::Ranged;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "expand-patterns",
    about: "writes patterns of holes in the target's form, or as positions",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(PATTERN),
        |l, p| expand_patterns(p.stmts, &mut p.start.clone(), &l.target, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// This pass.
pub(crate) const REFORM: Pass = Pass {
    name: "reform-patterns",
    about: "writes what is left of patterns in the target's form",
    alone: None,
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(PATTERN),
        |l, p| reform(p.stmts, &mut p.start.clone(), &l.target, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// Expands the patterns that the target lacks.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        expand_patterns(body, &mut walk.clone(), target, diags);
        reform(body, walk, target, diags);
    });
}

/// Expands the patterns of one body that have no form on the target. The others stay, because a cycle
/// that is expanded needs their exact positions.
pub(crate) fn expand_patterns(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    rebuild(body, |stmt, made| {
        walk.enter(stmt.skip);
        let holes = match &stmt.op {
            Op::Pattern(pattern) if forms(walk, pattern, target).is_none() => {
                Some(holes(walk, pattern, target.decimals_in(walk.unit())))
            }
            _ => None,
        };
        walk.step(&stmt);
        match holes {
            None => made.push(stmt),
            Some(Ok(holes)) => put(stmt, holes, made, diags),
            Some(Err(fault)) => {
                diags.push(Diagnostic::new(fault, stmt.span));
                made.push(stmt);
            }
        }
    });
}

/// The patterns of one body become the target's form, after all cycles are expanded.
pub(crate) fn reform(body: &mut Vec<Stmt>, walk: &mut Walk, target: &Target, diags: &mut Vec<Diagnostic>) {
    let mut reformed = false;
    rebuild(body, |mut stmt, made| {
        walk.enter(stmt.skip);
        let plane = plane(walk);
        let forms = match &mut stmt.op {
            Op::Pattern(pattern) => {
                if let (Some(plane), true) = (plane, reformed) {
                    // An increment would count from the end of the form before, which
                    // may be half an increment off. A position that is unknown here is no reference.
                    let _ = absolute_holes::pattern_absolute(pattern, plane, walk);
                }
                let forms = forms(walk, pattern, target);
                reformed |= forms.as_ref().is_some_and(|f| f.len() != 1 || f.first() != Some(&**pattern));
                forms
            }
            _ => None,
        };
        walk.step(&stmt);
        match forms {
            Some(forms) => put_forms(stmt, forms, made, diags),
            None => made.push(stmt),
        }
    });
}

fn put_forms(mut stmt: Stmt, mut forms: Vec<Pattern>, made: &mut Rebuild, diags: &mut Vec<Diagnostic>) {
    if forms.len() > 1 {
        diags.push(Diagnostic::new(Fault::BlockSplit, stmt.span));
        let with_last = |k: usize| k == 0 && stmt.joined;
        let made_of: Vec<_> =
            forms.into_iter().enumerate().map(|(k, p)| (with_last(k), Op::Pattern(Box::new(p)))).collect();
        return made.replace(stmt, made_of);
    }
    if let Some(form) = forms.pop() {
        stmt.op = Op::Pattern(Box::new(form));
    }
    made.push(stmt);
}

fn put(stmt: Stmt, holes: Vec<Point>, made: &mut Rebuild, diags: &mut Vec<Diagnostic>) {
    diags.push(Diagnostic::new(Fault::PatternExpanded { holes: holes.len() as u32 }, stmt.span));
    made.replace(stmt, holes.into_iter().map(|to| (false, Op::Hole(Move { to, said: false }))));
}

/// Whether the target has a form for this pattern here.
pub(crate) fn sayable(walk: &Walk, pattern: &Pattern, target: &Target) -> bool {
    forms(walk, pattern, target).is_some()
}

/// The target's forms for this pattern here.
fn forms(walk: &Walk, pattern: &Pattern, target: &Target) -> Option<Vec<Pattern>> {
    let as_it_is = || vec![pattern.clone()];
    if target.caps.flat {
        return None;
    }
    let Some(plane) = plane(walk) else { return target.caps.flow.repeats.then(as_it_is) };
    pattern_forms::fit(walk, pattern, plane, target)
}

/// The plane of the active cycle.
fn plane(walk: &Walk) -> Option<Plane> {
    if walk.at.cycle_in_doubt {
        return None;
    }
    walk.at.cycle.as_ref().and_then(|c| c.cycle.plane.known()).or(walk.at.modes.plane)
}

/// The positions of a pattern. Programmed ones stay exact; the others of a bolt circle are
/// rounded to `decimals` digits. An axis without motion from the hole before has no word.
///
/// # Errors
/// A fact that is needed and unknown.
pub(crate) fn holes(walk: &Walk, pattern: &Pattern, decimals: u8) -> Result<Vec<Point>, Fault> {
    let count = match pattern {
        Pattern::Circle { count, .. } | Pattern::Line { count, .. } => Some(*count),
        Pattern::List(points) => u32::try_from(points.len()).ok(),
        Pattern::Grid { columns, rows, .. } => columns.count.checked_mul(rows.count),
    };
    if count.is_none_or(|n| n > MOST_HOLES) {
        return Err(Fault::OutOfRange { word: Ranged::Holes });
    }
    let Some(plane) = plane(walk) else {
        return Err(Fault::EntryFactNeeded { fact: ncc_ir::diag::ModeName::Plane });
    };
    let (first, second, _) = plane.axes();
    let axes = [first, second];
    let Some(positions) = walk.at.positions(pattern) else {
        return Err(unknown(&walk.at, axes));
    };
    let mut last: [Option<Coord>; 2] = [None, None];
    let mut points = Vec::with_capacity(positions.len());
    for (k, position) in positions.iter().enumerate() {
        let mut to = Point { axes: [const { None }; AXES] };
        for (i, axis) in axes.into_iter().enumerate() {
            let word = word(walk, pattern, k, i, axis, position[i], decimals);
            if last[i].as_ref() != Some(&word) {
                to.set(axis, word.clone());
                last[i] = Some(word);
            }
        }
        if to.is_empty() {
            // A second hole in the same place still needs a word.
            to.set(first, last[0].clone().unwrap_or_else(|| absolute(exact(position[0], walk.unit()))));
        }
        points.push(to);
    }
    Ok(points)
}

/// The word of a hole's axis.
fn word(
    walk: &Walk,
    pattern: &Pattern,
    k: usize,
    side: usize,
    axis: Axis,
    nanos: Nanos,
    decimals: u8,
) -> Coord {
    let unit = unit_of(axis, walk.unit());
    match pattern {
        Pattern::List(points) => match points.get(k).and_then(|p| p.get(axis)) {
            Some(word) if is_absolute(word, walk.at.modes.distance) => as_absolute(word),
            Some(_) | None => absolute(exact(nanos, unit)),
        },
        Pattern::Circle { first: First::At(first), .. }
            if k == 0 && is_absolute(&first[side], walk.at.modes.distance) =>
        {
            as_absolute(&first[side])
        }
        Pattern::Circle { first, step, .. } => {
            let from = match first {
                First::At(_) => Some(0),
                First::Polar { angle, .. } => walk.at.nanos(angle),
            };
            let turned =
                from.zip(walk.at.nanos(step)).map(|(f, s)| i128::from(f) + i128::from(s) * k as i128);
            placed(nanos, turned, decimals, unit)
        }
        Pattern::Line { angle, .. } => placed(nanos, walk.at.nanos(angle).map(i128::from), decimals, unit),
        Pattern::Grid { columns, rows, .. } => {
            let angle = [columns, rows].into_iter().find_map(|row| match &row.along {
                Along::Axis(_) => None,
                Along::Angle(angle) => Some(walk.at.nanos(angle).map_or(1, i128::from)),
            });
            placed(nanos, Some(angle.unwrap_or(0)), decimals, unit)
        }
    }
}

/// A coordinate that is exact if its angle is that of an axis; else rounded.
fn placed(nanos: Nanos, angle: Option<i128>, decimals: u8, unit: Unit) -> Coord {
    let exactly = angle.is_some_and(|a| a % (90 * i128::from(ONE)) == 0);
    absolute(if exactly { exact(nanos, unit) } else { rounded(nanos, decimals, unit) })
}

/// The axis of an unknown plane.
fn unknown(at: &Tracker, axes: [Axis; 2]) -> Fault {
    let axis = axes.into_iter().find(|a| at.position[*a as usize].is_none()).unwrap_or(axes[0]);
    Fault::PositionUnknown { axis: axis.letter() as char }
}
