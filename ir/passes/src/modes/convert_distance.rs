//! `absolute` and `incremental`: words of moves, arcs and holes are measured in one way.
//!
//! An axis whose place is not known is refused. Planes of cycles and places of patterns stay
//! as they are measured; machine coordinates too.

use crate::pass::Pass;
use crate::support::walk::Walk;
use crate::support::walk::each_body;
use crate::support::write::{at, exact, unit_of};
use crate::target::Target;
use ncc_ir::canon::{Axis, Distance, Fact};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::program::{Coord, Op, Point, Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const ABSOLUTE: Pass =
    Pass::named("absolute", "measures words of moves from program zero", Some(absolute));

/// This pass.
pub(crate) const INCREMENTAL: Pass =
    Pass::named("incremental", "measures words of moves from where the axes stand", Some(incremental));

/// From program zero.
pub fn absolute(program: &mut Program, _: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    run(program, entry, Distance::Absolute, diags);
}

/// From where the axis stands.
pub fn incremental(program: &mut Program, _: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    run(program, entry, Distance::Incremental, diags);
}

fn run(program: &mut Program, entry: &Tracker, to: Distance, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| {
        for stmt in body {
            walk.enter(stmt.skip);
            let before = walk.clone();
            walk.step(stmt);
            if before.at.raw {
                continue;
            }
            let Stmt { op, span, .. } = stmt;
            let point = match op {
                Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Hole(m) => &mut m.to,
                Op::ArcFeed(arc) => &mut arc.to,
                Op::SynchronisedFeed(m) => &mut m.to,
                Op::SetDistanceMode(distance) => {
                    *distance = to;
                    continue;
                }
                _ => continue,
            };
            if let Err(fault) = convert(point, to, &before) {
                diags.push(Diagnostic::new(fault, *span));
            }
        }
    });
}

fn convert(point: &mut Point, to: Distance, before: &Walk) -> Result<(), Fault> {
    let here = &before.at;
    for (axis, word) in Axis::ALL.into_iter().zip(&mut point.axes) {
        let Some(word) = word else { continue };
        let from = word.distance.known().or(here.modes.distance);
        let from = from.ok_or(Fault::EntryFactNeeded { fact: ModeName::Distance })?;
        if from == to {
            word.distance = Fact::Known(to);
            continue;
        }
        let unknown = Fault::PositionUnknown { axis: axis.letter() as char };
        let now = here.position[axis as usize].ok_or_else(|| unknown.clone())?;
        let next = here.resolve(word, Some(now)).ok_or(unknown)?;
        *word = match to {
            Distance::Absolute => at(next, axis, before.unit()),
            Distance::Incremental => Coord {
                value: exact(next.wrapping_sub(now), unit_of(axis, before.unit())).into(),
                distance: Fact::Known(to),
            },
        };
    }
    Ok(())
}
