//! Holes in which the cycle drives the spindle, for `expand-cycles`: taps, fine boring, boring with a
//! stopped spindle. From the retract plane on; the way there is of all cycles alike.
//!
//! A tap that is left by rapid goes to a target whose own cycle goes on at feed as one call a hole, left at
//! the retract plane. So does a rigid tap that dwells at the retract plane, where the target's cycle does not: the dwell
//! follows the call. Refused are taps for a target that has no moves in step with the spindle, shifts that are computed
//! or whose direction is a parameter that nobody has stated, and a spindle that shall turn on as before
//! where it is not known how it turned.

use crate::Target;
use crate::holes::sayable::lasts;
use crate::support::walk::Walk;
use crate::support::write::{cut, exact, traverse, unit_of};
use ncc_ir::canon::{Axis, Distance, Fact, Plane, ReturnLevel, Spindle};
use ncc_ir::caps::{CycleCap, CycleForm};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::program::cycle::{Cycle, CycleKind, Shift, Tap, absolute};
use ncc_ir::program::{Coord, Move, Op, Point, Synchronised};
use ncc_ir::track::InForce;

/// The moves of a hole in which the cycle drives the spindle, from the retract plane on.
pub(crate) fn with_spindle(
    walk: &Walk,
    in_force: &InForce,
    to: &Point,
    [retract, depth]: [Point; 2],
    out: Option<Point>,
    target: &Target,
    moves: &mut Vec<(bool, Op)>,
) -> Result<(), Fault> {
    let plane =
        walk.at.plane(in_force.cycle.plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
    let normal = plane.axes().2;
    let dwell = |seconds: &Option<Expr>, moves: &mut Vec<(bool, Op)>| {
        if let Some(seconds) = seconds.as_ref().filter(|seconds| lasts(seconds)) {
            moves.push((false, Op::Dwell(seconds.clone())));
        }
    };
    let turn_it = |to: Spindle| {
        (
            false,
            match to {
                Spindle::Stopped => Op::StopSpindleTurning,
                Spindle::Clockwise => Op::StartSpindleClockwise,
                Spindle::Counterclockwise => Op::StartSpindleCounterclockwise,
            },
        )
    };
    let turned = |after: Option<Spindle>| match after.or(walk.at.spindle) {
        Some(spindle) => Ok(turn_it(spindle)),
        None => {
            let what = "a cycle after which the spindle turns as before, which is not known";
            Err(Fault::CannotSay { what: what.into() })
        }
    };
    match &in_force.cycle.kind {
        CycleKind::Tap(tap) => {
            let ends = [&retract, &depth];
            let own = out.as_ref().and_then(|_| own_tap(in_force, &in_force.cycle.kind, plane, ends, target));
            // A dwell at the retract plane follows a cycle that has none there.
            let settle = tap.settle.as_ref().filter(|_| !tap.chuck);
            let alone = Tap { settle: None, after: Spindle::Stopped, ..(**tap).clone() };
            let settled = || own_tap(in_force, &CycleKind::Tap(Box::new(alone)), plane, ends, target);
            let (own, settle) = match (own, settle) {
                (Some(own), _) => (Some(own), None),
                (None, Some(settle)) => (settled(), Some(settle.clone())),
                (None, None) => (None, None),
            };
            if let Some(own) = own {
                moves.push((false, Op::StartCycle(Box::new(own))));
                moves.push((true, Op::Hole(Move { to: Point::default(), said: true })));
                moves.push((false, Op::EndCycle));
                let starts = settle.is_some() && tap.after != Spindle::Stopped;
                dwell(&settle, moves);
                moves.extend(out.map(|out| (false, traverse(out))));
                if starts {
                    moves.push(turn_it(tap.after));
                }
                return Ok(());
            }
            let threads = target.caps.moves.threads;
            let says = if tap.chuck { threads.chuck } else { threads.turned || threads.back };
            if !threads.any && !says {
                let what = match tap.settle == tap.dwell && tap.back.is_none() {
                    true => format!("the cycle {} in this form", in_force.cycle.kind.name()),
                    false => "a tapping cycle that dwells at one end of the thread alone".to_owned(),
                };
                return Err(Fault::CannotSay { what: what.into() });
            }
            let step = |to: &Point, turn| {
                let (to, pitch) = (to.clone(), tap.pitch.clone());
                let turn = (!tap.chuck).then_some(turn);
                (
                    false,
                    Op::SynchronisedFeed(Box::new(Synchronised {
                        to,
                        pitch,
                        chuck: tap.chuck,
                        turn,
                        back: false,
                    })),
                )
            };
            moves.push(step(&depth, tap.turn));
            dwell(&tap.dwell, moves);
            if tap.chuck {
                moves.push(turn_it(tap.turn.back().spindle()));
                dwell(&tap.back, moves);
            } else if tap.back.as_ref().is_some_and(lasts) {
                let what = "a rigid tap that dwells when the spindle has turned round".into();
                return Err(Fault::CannotSay { what });
            }
            let (end, out) = match out {
                Some(out) if tap.to_level => (out, None),
                out => (retract, out),
            };
            moves.push(step(&end, tap.turn.back()));
            dwell(&tap.settle, moves);
            if tap.chuck {
                moves.push(turn_it(tap.after));
            }
            moves.extend(out.map(|out| (false, traverse(out))));
            if !tap.chuck && tap.after != Spindle::Stopped {
                moves.push(turn_it(tap.after));
            }
        }
        CycleKind::FineBore(bore) => {
            moves.extend(bore.turn.map(|turn| turn_it(turn.spindle())));
            moves.push((false, cut(depth)));
            dwell(&bore.dwell, moves);
            let angle = bore.angle.clone().or_else(|| target.orientation.map(Expr::Num));
            moves.push((false, Op::OrientSpindle(angle)));
            let by = off_the_wall(&bore.shift, plane, target)?;
            let (mut aside, mut back) = (Point::default(), Point::default());
            for axis in [Axis::X, Axis::Y, Axis::Z] {
                let Some(by) = &by[axis as usize] else { continue };
                let (Some(by), Expr::Num(num)) = (walk.at.nanos(by), by) else {
                    return Err(Fault::CannotSay { what: "a computed shift".into() });
                };
                if by == 0 {
                    continue;
                }
                let word =
                    |num: Num| Coord { value: num.into(), distance: Fact::Known(Distance::Incremental) };
                let unit = unit_of(axis, walk.unit());
                let foot = match (axis == normal, to.get(axis)) {
                    (true, _) => in_force.depth,
                    (false, Some(word)) => walk.at.resolve(word, walk.at.position[axis as usize]),
                    (false, None) => walk.at.position[axis as usize],
                };
                aside.set(
                    axis,
                    match foot.and_then(|foot| foot.checked_add(by)) {
                        Some(place) => absolute(exact(place, unit)),
                        None => word(*num),
                    },
                );
                if axis != normal {
                    back.set(
                        axis,
                        match foot {
                            Some(foot) => absolute(exact(foot, unit)),
                            None => word(Num { mantissa: -num.mantissa, ..*num }),
                        },
                    );
                }
            }
            if !aside.is_empty() {
                moves.push((false, traverse(aside)));
            }
            moves.push((false, traverse(out.unwrap_or(retract))));
            if !back.is_empty() {
                moves.push((false, traverse(back)));
            }
            moves.push(turned(bore.after)?);
        }
        CycleKind::BoreStop(bore) => {
            moves.extend(bore.turn.map(|turn| turn_it(turn.spindle())));
            moves.push((false, cut(depth)));
            dwell(&bore.dwell, moves);
            moves.push((false, Op::StopSpindleTurning));
            if bore.stop {
                moves.push((false, Op::ProgramStop));
            }
            moves.push((false, traverse(out.unwrap_or(retract))));
            moves.push(turned(bore.after)?);
        }
        CycleKind::Drill
        | CycleKind::DrillDwell { .. }
        | CycleKind::DrillPeck { .. }
        | CycleKind::DrillBreak { .. }
        | CycleKind::Bore { .. } => {}
    }
    Ok(())
}

/// The cycle with which a target taps one hole over which the tool stands at the retract plane, to leave it
/// there: where its own cycle would go on at feed to the level of return, or has no such level.
fn own_tap(
    in_force: &InForce,
    kind: &CycleKind,
    plane: Plane,
    [retract, depth]: [&Point; 2],
    target: &Target,
) -> Option<Cycle> {
    let (cycle, normal) = (&in_force.cycle, plane.axes().2);
    let turn = match kind {
        CycleKind::Tap(tap) if !tap.to_level && !target.caps.flat => tap.turn,
        _ => return None,
    };
    let says = |c: &CycleCap| {
        c.kind == kind.name()
            && c.form.says(kind)
            && c.form != CycleForm::Any
            && c.turns.contains(&turn)
            && c.returns.contains(&ReturnLevel::Retract)
    };
    target.caps.holes.cycles.iter().any(says).then_some(())?;
    Some(Cycle {
        kind: kind.clone(),
        plane: cycle.plane,
        retract: retract.get(normal)?.clone(),
        depth: depth.get(normal)?.clone(),
        return_level: Fact::Known(ReturnLevel::Retract),
        return_plane: None,
        reference: None,
        approach: target.caps.holes.approach.unwrap_or(cycle.approach),
        feed: None,
    })
}

/// How far fine boring shifts the tool along X, Y and Z.
fn off_the_wall(shift: &Shift, plane: Plane, target: &Target) -> Result<[Option<Expr>; 3], Fault> {
    match shift {
        Shift::Stated(words) => Ok(words.clone()),
        Shift::Parameter(amount) => {
            let what = "fine boring whose direction of shift is a parameter of the control";
            let cannot = || Fault::CannotSay { what: what.into() };
            let (direction, amount) = target.bore_shift.zip(amount.literal()).ok_or_else(cannot)?;
            let (first, second, _) = plane.axes();
            let along = if direction.second { second } else { first };
            let mantissa = if direction.minus { -amount.mantissa } else { amount.mantissa };
            let mut by = [None, None, None];
            by[along as usize] = Some(Expr::Num(Num { mantissa, ..amount }));
            Ok(by)
        }
    }
}
