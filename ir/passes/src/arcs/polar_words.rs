//! `polar-words`: points by radius and angle, their poles, and lines by their angle, in the target's form or by
//! coordinates.
//!
//! A computed coordinate is rounded to the target's digits. A point whose place is not known from the
//! program alone is refused.

use super::polar_places::by_coordinates;
use crate::holes::expand_cycles::ExpandCyclesState;
use crate::pass::{First, Moment, Pass, Piece, Shared, Step};
use crate::support::needs::{CORNER, CYCLE, EVERY, FRAME, PATTERN, POLAR};
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{EXACT, exact, rebuild};
use crate::target::Target;
use crate::threads::taps::TapsState;
use ncc_ir::canon::{Distance, Plane};
use ncc_ir::caps::PolarForm;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Unit;
use ncc_ir::geometry::polar::{self, Pole};
use ncc_ir::program::cycle::absolute;
use ncc_ir::program::kinds::{conduct, miscellaneous, moves};
use ncc_ir::program::{Centre, CentreFrom, Coord, Op, Point, Polar, PoleWords, Program, SetPole, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "polar-words",
    about: "writes points by radius and angle in the target's form, or by coordinates",
    alone: Some(run),
    step: Some(Step {
        moment: Moment::Placing,
        needed: |_, p| p.needs(POLAR),
        run: in_coordinates,
        otherwise: |_, _| {},
        first: Some(First { tried: in_its_form, kept: holes_are_kept }),
        finish: |_, _, _| {},
    }),
    program: &[],
    parametric: None,
};

/// Writes them by coordinates, as another pass has to write out what they belong to.
fn in_coordinates(l: &mut Shared, p: &mut Piece) {
    // Corners and frames are computed from exact points.
    let exact = Target { decimals: EXACT - 1, ..l.target.clone() };
    let target = if p.needs(CORNER | FRAME) { &exact } else { &l.target };
    convert_polar_words(p.stmts, &mut p.start.clone(), l.states.state_mut(), target, false, p.diags);
    p.needs &= !POLAR;
}

/// Says them in the target's form, unless a pass after looks into what they say.
fn in_its_form(l: &mut Shared, p: &mut Piece) -> bool {
    let holes = l.states.ask(ExpandCyclesState::is_busy) || l.states.ask(TapsState::is_busy);
    if l.target.caps.moves.polar == PolarForm::None || p.needs(FRAME | EVERY | CORNER) || holes {
        return false;
    }
    convert_polar_words(p.stmts, &mut p.start.clone(), l.states.state_mut(), &l.target, true, p.diags);
    p.needs &= !POLAR;
    true
}

/// Whether no later pass expanded a hole.
fn holes_are_kept(piece: &Piece, before: &[Stmt], after: &[Stmt]) -> bool {
    let counts = |stmts: &[Stmt]| {
        let polar = stmts.iter().filter(|stmt| matches!(stmt.op, Op::Polar(_))).count();
        let calls = stmts.iter().filter(|stmt| matches!(stmt.op, Op::StartCycle(_))).count();
        let others = stmts.iter().filter(|s| matches!(s.op, Op::Hole(_) | Op::Pattern(_) | moves!())).count();
        [polar, calls, others]
    };
    !piece.needs(CYCLE | PATTERN) || counts(before) == counts(after)
}

/// What is known of the target's text.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PolarWordsState {
    /// Whether the last thing that moved in the plane was a polar point that was kept.
    chained: bool,
    /// Whether the text has another pole than the program.
    pole_lost: bool,
    /// Whether it has another last radius or angle.
    words_lost: bool,
}

/// Says them so.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        convert_polar_words(body, walk, &mut PolarWordsState::default(), target, true, diags);
    });
}

/// The same for one piece of a body; `keep` is whether a form of the target's may be used.
pub(crate) fn convert_polar_words(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut PolarWordsState,
    target: &Target,
    keep: bool,
    diags: &mut Vec<Diagnostic>,
) {
    let form = if keep { target.caps.moves.polar } else { PolarForm::None };
    rebuild(body, |mut stmt, made| {
        walk.enter(stmt.skip);
        match &stmt.op {
            Op::SetPole(set) => {
                let op = pole(set, walk, state, target, form);
                walk.step(&stmt);
                match op {
                    Some(op) => made.push(Stmt { op, ..stmt }),
                    None => made.leave_out(stmt),
                }
            }
            Op::Polar(polar) => {
                let op = match kept(polar, walk, state, target, form) {
                    Some(op) => {
                        state.chained = stmt.skip.is_none();
                        Ok(op)
                    }
                    None => {
                        (state.chained, state.words_lost) = (false, true);
                        let op = by_coordinates(polar, walk, target);
                        if op.is_ok() {
                            diags.push(Diagnostic::new(Fault::PolarExpanded, stmt.span));
                        }
                        op
                    }
                };
                walk.step(&stmt);
                match op {
                    Ok(op) => stmt.op = op,
                    Err(fault) => diags.push(Diagnostic::new(fault, stmt.span)),
                }
                made.push(stmt);
            }
            op => {
                state.chained &= stays(op, walk);
                walk.step(&stmt);
                made.push(stmt);
            }
        }
    });
}

/// The statement of a pole in the target's form; nothing where that has none.
fn pole(
    set: &SetPole,
    walk: &Walk,
    state: &mut PolarWordsState,
    target: &Target,
    form: PolarForm,
) -> Option<Op> {
    (state.chained, state.pole_lost, state.words_lost) = (false, false, false);
    let fine = |value: &Expr| is_fine(value, walk, target);
    let sayable = match form {
        PolarForm::Any => true,
        PolarForm::Pole => match &set.at {
            PoleWords::Along(words) => words.iter().flatten().all(fine),
            PoleWords::Polar { radius, angle } => fine(radius) && fine(angle),
        },
        PolarForm::Modal | PolarForm::None => false,
    };
    state.pole_lost = !sayable;
    sayable.then(|| Op::SetPole(Box::new(set.clone())))
}

/// A polar point in the target's form, if it has one.
fn kept(
    polar: &Polar,
    walk: &Walk,
    state: &mut PolarWordsState,
    target: &Target,
    form: PolarForm,
) -> Option<Op> {
    if form == PolarForm::Any {
        return Some(Op::Polar(Box::new(polar.clone())));
    }
    if polar.along {
        let angle = polar.angle.as_ref()?;
        let fine = |word: &Coord| is_fine(&word.value, walk, target);
        let says = target.caps.moves.line_angles && form != PolarForm::None;
        let points = polar::end_of(&polar.op)?.axes.iter().flatten().all(fine);
        return (says && points && fine(angle)).then(|| Op::Polar(Box::new(polar.clone())));
    }
    if form == PolarForm::None {
        return None;
    }
    let plane = walk.at.plane(polar.plane)?;
    let after = walk.at.polar(polar).map(|(_, _, after)| after);
    let pole = (!walk.at.pole_lost).then_some(walk.at.pole);
    let mut polar = polar.clone();
    let line = match &polar.op {
        Op::StraightTraverse(_) | Op::StraightFeed(_) | Op::Hole(_) => true,
        Op::ArcFeed(arc) => match &arc.centre {
            Centre::Radius(_) => form == PolarForm::Modal,
            Centre::Point { words, from } => {
                let about = pole.is_some_and(|pole| is_pole(words, walk, plane, &pole));
                form == PolarForm::Pole && *from == CentreFrom::Zero && about
            }
        },
        _ => false,
    };
    if !line || polar::end_of(&polar.op).is_none_or(|to| names(to, plane)) {
        return None;
    }
    // Whether what is missing or added counts in the target's text from what it does in the program.
    let follows = match form {
        PolarForm::Modal if pole?.at != [0; 2] => return None,
        PolarForm::Pole if state.pole_lost => return None,
        PolarForm::Modal => state.chained,
        PolarForm::Pole => !state.words_lost,
        PolarForm::Any | PolarForm::None => false,
    };
    let increment = |word: &Option<Coord>| match word {
        None => Some(false),
        Some(word) => {
            let distance = word.distance.known().or(walk.at.modes.distance)?;
            Some(distance == Distance::Incremental)
        }
    };
    let stated = |nanos, unit| absolute(exact(nanos, unit));
    if increment(&polar.radius)? || polar.radius.is_none() && !follows {
        polar.radius = Some(stated(after?.radius?, walk.unit()));
    }
    let adds = increment(&polar.angle)?;
    let mixes =
        form == PolarForm::Modal && adds && (polar.radius.is_some() || !all_increments(&polar, walk)?);
    if adds && (!follows || mixes) || polar.angle.is_none() && !follows {
        polar.angle = Some(stated(after?.angle?, Unit::Degree));
    }
    if form == PolarForm::Modal && !increment(&polar.angle)? && !no_increments(&polar, walk)? {
        return None;
    }
    if !polar.radius.iter().chain(&polar.angle).all(|word| is_fine(&word.value, walk, target)) {
        return None;
    }
    state.words_lost = false;
    Some(Op::Polar(Box::new(polar)))
}

/// Whether the words of a move that are not polar are all increments; none is both.
fn all_increments(polar: &Polar, walk: &Walk) -> Option<bool> {
    measured(polar, walk, Distance::Incremental)
}

/// Whether they are all from program zero.
fn no_increments(polar: &Polar, walk: &Walk) -> Option<bool> {
    measured(polar, walk, Distance::Absolute)
}

fn measured(polar: &Polar, walk: &Walk, wanted: Distance) -> Option<bool> {
    let to = polar::end_of(&polar.op)?;
    let mut all = true;
    for word in to.axes.iter().flatten() {
        all &= word.distance.known().or(walk.at.modes.distance)? == wanted;
    }
    Some(all)
}

/// Whether a point has words of a plane.
fn names(to: &Point, plane: Plane) -> bool {
    let (first, second, _) = plane.axes();
    to.get(first).is_some() || to.get(second).is_some()
}

/// Whether words of a centre are those of the pole.
fn is_pole(words: &[Option<Expr>; 3], walk: &Walk, plane: Plane, pole: &Pole) -> bool {
    let (first, second, _) = plane.axes();
    [first, second]
        .into_iter()
        .zip(pole.at)
        .all(|(axis, at)| words[axis as usize].as_ref().and_then(|word| walk.at.nanos(word)) == Some(at))
}

/// Whether the target's digits say a number as it is.
fn is_fine(value: &Expr, walk: &Walk, target: &Target) -> bool {
    value.literal().is_some_and(|n| {
        let decimals = match n.unit {
            Unit::Degree | Unit::One | Unit::Second => target.decimals,
            Unit::Mm | Unit::Inch | Unit::Entry => target.decimals_in(walk.unit()),
        };
        n.trimmed().scale <= decimals
    })
}

/// Whether a statement leaves the axes of the plane where they are, and what the words that follow mean.
fn stays(op: &Op, walk: &Walk) -> bool {
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) => {
            let plane = walk.at.modes.plane;
            !walk.at.raw && plane.is_some_and(|plane| !names(&m.to, plane))
        }
        Op::SetFeedRate(_)
        | Op::SetDistanceMode(_)
        | Op::SetFeedMode(_)
        | Op::SetReturnLevel(_)
        | Op::StartCycle(_)
        | Op::EndCycle
        | miscellaneous!()
        | conduct!() => true,
        _ => false,
    }
}
