//! `flatten-facts`: for targets that are a list of events, every move names every axis from zero.
//!
//! An axis that is not known stays without a word; the target says what that means. Arcs get their
//! centre from zero. Modes that only decide how words are read are left out.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::EVERY;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{exact, rebuild, unit_of};
use crate::target::Target;
use ncc_ir::canon::{Axis, Fact, Motion};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num, Unit};
use ncc_ir::program::cycle::absolute;
use ncc_ir::program::{Arc, Centre, CentreFrom, Op, Point, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "flatten-facts",
    about: "gives every move all its axes, from program zero",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |_, p| p.needs(EVERY),
        |_, p| state_facts(p.stmts, &mut p.start.clone(), p.diags),
    ),
    program: &[],
    parametric: None,
};

/// Names every axis.
pub fn run(program: &mut Program, _: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| state_facts(body, walk, diags));
}

/// The same for one body.
pub(crate) fn state_facts(body: &mut Vec<Stmt>, walk: &mut Walk, diags: &mut Vec<Diagnostic>) {
    let mut superfluous = false;
    for stmt in body.iter_mut() {
        flatten(stmt, walk, diags);
        superfluous |= is_superfluous(&stmt.op);
    }
    if superfluous {
        rebuild(body, |stmt, made| match is_superfluous(&stmt.op) {
            true => made.leave_out(stmt),
            false => made.push(stmt),
        });
    }
}

/// Whether a statement only says how others are read.
fn is_superfluous(op: &Op) -> bool {
    matches!(op, Op::SetDistanceMode(_) | Op::SetReturnLevel(_))
}

fn flatten(stmt: &mut Stmt, walk: &mut Walk, diags: &mut Vec<Diagnostic>) {
    walk.enter(stmt.skip);
    if let Op::Position(m) = &mut stmt.op {
        let m = std::mem::take(m);
        stmt.op = match walk.at.modes.motion {
            Some(Motion::Traverse) => Op::StraightTraverse(m),
            Some(Motion::Feed) => Op::StraightFeed(m),
            Some(Motion::Cycle) => Op::Hole(m),
            Some(Motion::Arc(_)) => {
                diags.push(Diagnostic::new(Fault::ArcWithoutCentre, stmt.span));
                Op::Position(m)
            }
            None => {
                let fact = ModeName::Motion;
                diags.push(Diagnostic::new(Fault::EntryFactNeeded { fact }, stmt.span));
                Op::Position(m)
            }
        };
    }
    if let Op::ArcFeed(arc) = &mut stmt.op
        && let Err(fault) = centre_from_zero(arc, walk)
    {
        diags.push(Diagnostic::new(fault, stmt.span));
    }
    walk.step(stmt);
    let to = match &mut stmt.op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) => &mut m.to,
        Op::SynchronisedFeed(m) => &mut m.to,
        Op::ArcFeed(arc) => &mut arc.to,
        _ => return,
    };
    if let Err(fault) = name_all(to, walk) {
        diags.push(Diagnostic::new(fault, stmt.span));
    }
}

/// Gives every axis its word; the walk stands after the move.
#[inline]
fn name_all(to: &mut Point, walk: &Walk) -> Result<(), Fault> {
    for (axis, word) in Axis::ALL.into_iter().zip(&mut to.axes) {
        let from_zero =
            word.as_ref().is_some_and(|w| crate::support::write::is_absolute(w, walk.at.modes.distance));
        match walk.at.position[axis as usize] {
            _ if from_zero => {
                if let Some(word) = word {
                    word.distance = Fact::Known(ncc_ir::canon::Distance::Absolute);
                }
            }
            // Its length would take effect by the word.
            Some(_) if axis == Axis::Z && word.is_none() && walk.waiting => {}
            Some(nanos) => *word = Some(absolute(rounded_literal(nanos, unit_of(axis, walk.unit())))),
            None if word.is_some() => {
                return Err(Fault::PositionUnknown { axis: axis.letter() as char });
            }
            None => {}
        }
    }
    Ok(())
}

/// The literal of a position that is rounded once, by the target: in millimetres where no digits say it in
/// inches, because what is rounded to finer digits first may come out another.
fn rounded_literal(nanos: Nanos, unit: Unit) -> Num {
    let n = exact(nanos, unit);
    if unit != Unit::Inch || n.nanos(true) == Some(nanos) { n } else { exact(nanos, Unit::Mm) }
}

fn centre_from_zero(arc: &mut Arc, walk: &Walk) -> Result<(), Fault> {
    let plane = walk.at.plane(arc.plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
    arc.plane = Fact::Known(plane);
    let (first, second, _) = plane.axes();
    if let Centre::Point { words, from: CentreFrom::Zero } = &arc.centre
        && words[first as usize].is_some()
        && words[second as usize].is_some()
    {
        return Ok(());
    }
    let Some(centre) = walk.at.centre(arc) else {
        let unknown = [first, second].into_iter().find(|a| walk.at.position[*a as usize].is_none());
        let axis = unknown.unwrap_or(first).letter() as char;
        return Err(match unknown {
            Some(_) => Fault::PositionUnknown { axis },
            None => Fault::ArcRadiusTooSmall,
        });
    };
    let mut words: [Option<Expr>; 3] = [None, None, None];
    for (axis, nanos) in [first, second].into_iter().zip(centre) {
        words[axis as usize] = Some(rounded_literal(nanos, unit_of(axis, walk.unit())).into());
    }
    arc.centre = Centre::Point { words, from: CentreFrom::Zero };
    Ok(())
}
