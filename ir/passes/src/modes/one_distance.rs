//! `one-distance`: the words of a block are measured in one way, from program zero.
//!
//! For targets whose distance mode holds for a whole block. Only blocks that mix are touched; an
//! incremental word of an axis whose place is not known is refused.

use crate::pass::{Moment, Pass, Piece, Shared, Step};
use crate::support::needs::{ARC, CORNER, FRAME, MEASURE};
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{at, is_absolute};
use crate::target::Target;
use ncc_ir::canon::{Axis, Distance};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::{Op, Point, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "one-distance",
    about: "measures the words of a block in one way",
    alone: Some(run),
    step: Step::at(
        Moment::Wording,
        |l, p| is_measured(l, p) && !l.target.caps.modes.word_distance,
        |_, p| unify_distance(p.stmts, &mut p.start.clone(), p.diags),
    ),
    program: &[],
    parametric: None,
};

/// Whether words of a piece may be measured in several ways, or feeds in another unit than lengths. Computed words
/// are from zero, others may not be.
pub(crate) fn is_measured(l: &Shared, p: &Piece) -> bool {
    let computed = l.measures && p.needs(ARC | FRAME | CORNER);
    p.needs(MEASURE) || computed && p.stmts.iter().any(|stmt| may_mix(&stmt.op))
}

/// Measures them from program zero.
pub fn run(program: &mut Program, _: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| unify_distance(body, walk, diags));
}

/// The same for one body.
pub(crate) fn unify_distance(body: &mut [Stmt], walk: &mut Walk, diags: &mut Vec<Diagnostic>) {
    for stmt in body {
        walk.enter(stmt.skip);
        let in_force = walk.at.modes.distance;
        let mixed = words(&stmt.op).is_some_and(|to| is_mixed(to, in_force));
        let before = mixed.then(|| walk.clone());
        walk.step(stmt);
        let Some(before) = before else { continue };
        let span = stmt.span;
        let to = match &mut stmt.op {
            Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) | Op::Hole(m) => &mut m.to,
            Op::SynchronisedFeed(m) => &mut m.to,
            Op::ArcFeed(arc) => &mut arc.to,
            Op::ArcForm(arc) => &mut arc.to,
            _ => continue,
        };
        if let Err(fault) = measure(to, &before) {
            diags.push(Diagnostic::new(fault, span));
        }
    }
}

/// Whether a statement may mix, whatever is active.
pub(crate) fn may_mix(op: &Op) -> bool {
    words(op).is_some_and(|to| is_mixed(to, None))
}

fn words(op: &Op) -> Option<&Point> {
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) | Op::Hole(m) => Some(&m.to),
        Op::SynchronisedFeed(m) => Some(&m.to),
        Op::ArcFeed(arc) => Some(&arc.to),
        Op::ArcForm(arc) => Some(&arc.to),
        _ => None,
    }
}

fn is_mixed(to: &Point, in_force: Option<Distance>) -> bool {
    let mut measures = to.axes.iter().flatten().map(|word| word.distance.known().or(in_force));
    let Some(first) = measures.next() else { return false };
    measures.any(|other| other != first)
}

fn measure(to: &mut Point, before: &Walk) -> Result<(), Fault> {
    for (axis, word) in Axis::ALL.into_iter().zip(&mut to.axes) {
        let Some(word) = word else { continue };
        if is_absolute(word, before.at.modes.distance) {
            *word = crate::support::write::as_absolute(word);
            continue;
        }
        let nanos = before.at.resolve(word, before.at.position[axis as usize]);
        let nanos = nanos.ok_or(Fault::PositionUnknown { axis: axis.letter() as char })?;
        *word = at(nanos, axis, before.unit());
    }
    Ok(())
}
