//! Words that say by themselves from where they count, in programs that compute.
//!
//! A target whose distance mode holds for whole blocks says them by a mode of its own, which stays active. That does no
//! harm where every word after it says its own; a word that counts as the mode of the source does, wherever that was
//! set, would get the other one.

use std::collections::BTreeSet;

use crate::support::mode_analysis::Known;
use ncc_ir::canon::{Distance, Fact};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::arguments::{self, Argument};
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Coord, Op, Program, Stmt};
use ncc_ir::run_time::RunTimeWord;
use ncc_ir::source::Span;

/// The places of statements with a word that says another mode than the source's there, or one where that is not known,
/// in a program that relies on the source's elsewhere. `known` is what holds where stretches of its blocks begin.
pub fn places(program: &Program, known: &Known) -> BTreeSet<u32> {
    match program.procedures.iter().any(|procedure| is_open(&procedure.body)) {
        true => others(program, known),
        false => BTreeSet::new(),
    }
}

/// The places of statements with a word that says another mode than the source's there, or one where that is not known.
pub fn others(program: &Program, known: &Known) -> BTreeSet<u32> {
    let mut found = BTreeSet::new();
    program.procedures.iter().for_each(|procedure| within(&procedure.body, known, &mut found));
    found
}

/// Refuses the first of them, for a target that has no words with a mode of their own.
///
/// # Errors
/// There is one.
pub fn refused(places: &BTreeSet<u32>, program: &Program) -> Result<(), Diagnostic> {
    fn first(body: &[Stmt], places: &BTreeSet<u32>) -> Option<Span> {
        body.iter().find_map(|stmt| match &stmt.op {
            Op::Control(control) => control.bodies().find_map(|body| first(body, places)),
            _ => Some(stmt.span).filter(|span| places.contains(&span.start)),
        })
    }
    let found = program.procedures.iter().find_map(|procedure| first(&procedure.body, places));
    found.map_or(Ok(()), |at| Err(Diagnostic::new(Fault::computes(RunTimeWord::DistanceWord), at)))
}

/// Whether words count in a mode that is not known where they are executed.
fn is_open(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Control(control) => control.bodies().any(|body| is_open(body)),
        op => words(op, &|word| word.distance == Fact::Entry),
    })
}

fn within(body: &[Stmt], known: &Known, found: &mut BTreeSet<u32>) {
    // The mode of the source; nothing where a stretch of blocks begins.
    let mut in_force: Option<Option<Distance>> = None;
    for stmt in body {
        if matches!(stmt.op, flow!()) {
            in_force = None;
            if let Op::Control(control) = &stmt.op {
                control.bodies().for_each(|body| within(body, known, found));
            }
            continue;
        }
        let before = || known.before(stmt).and_then(|at| at.modes.distance);
        let mode = *in_force.get_or_insert_with(before);
        if let Op::SetDistanceMode(distance) = stmt.op {
            in_force = Some(Some(distance).filter(|_| stmt.skip.is_none() || mode == Some(distance)));
        } else if words(&stmt.op, &|word| word.distance.known().is_some_and(|own| mode != Some(own))) {
            found.insert(stmt.span.start);
        }
    }
}

/// Whether any word of a statement is one of these.
fn words(op: &Op, is: &dyn Fn(&Coord) -> bool) -> bool {
    // Plain moves are nearly all there is.
    if let Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) | Op::Hole(m) = op {
        return m.to.axes.iter().flatten().any(is);
    }
    let mut found = false;
    let all = arguments::each(&mut op.clone(), &mut |argument, _| {
        if let Argument::Word(Some(word)) = argument {
            found |= is(word);
        }
        Ok::<(), std::convert::Infallible>(())
    });
    all.unwrap_or_else(|never| match never {});
    found
}
