//! `absolute-holes`: planes and positions of cycles are written from program zero.
//!
//! For targets whose cycles are only known in absolute mode.

use super::expand_cycles::level;
use super::walk::Walk;
use super::write::{at, is_absolute};
use super::{Target, each_body};
use crate::canon::Axis;
use crate::cycle::Pattern;
use crate::diag::{Diagnostic, Fault, ModeName};
use crate::program::{Coord, Op, Program, Stmt};
use crate::track::Tracker;

/// Makes them absolute.
pub fn run(program: &mut Program, _: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    each_body(program, entry, |body, walk| over(body, walk, diags));
}

/// The same for one body.
pub(super) fn over(body: &mut [Stmt], walk: &mut Walk, diags: &mut Vec<Diagnostic>) {
    for stmt in body {
        walk.enter(stmt.skip);
        let before = walk.clone();
        walk.step(stmt);
        let made = match &mut stmt.op {
            Op::StartCycle(cycle) => match (&walk.at.cycle, walk.at.plane(cycle.plane)) {
                (Some(in_force), Some(plane)) => {
                    let normal = plane.axes().2;
                    let retract = level(walk, &cycle.retract, in_force.retract, normal);
                    let depth = level(walk, &cycle.depth, in_force.depth, normal);
                    retract.and_then(|retract| {
                        cycle.depth = depth?;
                        cycle.retract = retract;
                        Ok(())
                    })
                }
                _ => Err(Fault::EntryFactNeeded { fact: ModeName::Plane }),
            },
            Op::Hole(m) => {
                Axis::ALL.into_iter().zip(&mut m.to.axes).try_for_each(|(axis, word)| match word {
                    Some(coord) => make_absolute(coord, axis, &before),
                    None => Ok(()),
                })
            }
            Op::Pattern(pattern) => match (&mut **pattern, before.at.cycle.as_ref()) {
                (Pattern::Circle { centre, first, .. }, Some(in_force)) => {
                    match before.at.plane(in_force.cycle.plane) {
                        Some(plane) => {
                            let (one, two, _) = plane.axes();
                            let pairs = centre.iter_mut().chain(std::iter::once(first));
                            pairs.into_iter().try_for_each(|pair| {
                                make_absolute(&mut pair[0], one, &before)?;
                                make_absolute(&mut pair[1], two, &before)
                            })
                        }
                        None => Err(Fault::EntryFactNeeded { fact: ModeName::Plane }),
                    }
                }
                (Pattern::Circle { .. } | Pattern::Grid { .. }, _) => Ok(()),
            },
            _ => Ok(()),
        };
        if let Err(fault) = made {
            diags.push(Diagnostic::new(fault, stmt.span));
        }
    }
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
