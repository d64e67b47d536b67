//! Holes in which the cycle drives the spindle, for `expand-cycles`: taps, fine boring, boring with a
//! stopped spindle. From the retract plane on; the way there is of all cycles alike.
//!
//! A tap that is left by rapid goes to a target whose own cycle goes on at feed as one call a hole, left at
//! the retract plane. So does a rigid tap that dwells at the retract plane, where the target's cycle does not: the dwell
//! follows the call. Refused are taps for a target that has no spindle-synchronised moves, shifts that are computed
//! or whose direction is a parameter that nobody has stated, and a spindle that shall turn on as before
//! where it is not known how it turned.

use crate::holes::sayable::lasts;
use crate::support::walk::Walk;
use crate::support::write::{cut, exact, traverse, unit_of};
use crate::target::Target;
use ncc_ir::canon::{Axis, Distance, Fact, Plane, ReturnLevel, Spindle, Turn};
use ncc_ir::caps::{CycleCap, CycleForm};
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::lack::{HolesLack, Lack, ThreadsLack};
use ncc_ir::program::cycle::{BoreStop, Cycle, CycleKind, FineBore, Shift, Tap, absolute};
use ncc_ir::program::{Coord, Move, Op, Point, Synchronised};
use ncc_ir::track::ActiveCycle;

/// A hole in which the cycle drives the spindle, from the retract plane on.
struct Driven<'h> {
    walk: &'h Walk,
    in_force: &'h ActiveCycle,
    to: &'h Point,
    retract: Point,
    depth: Point,
    /// Where the tool is left, if that is not the retract plane.
    out: Option<Point>,
    plane: Plane,
    target: &'h Target,
}

/// The moves of a hole in which the cycle drives the spindle, from the retract plane on.
pub(crate) fn with_spindle(
    walk: &Walk,
    in_force: &ActiveCycle,
    to: &Point,
    [retract, depth]: [Point; 2],
    out: Option<Point>,
    target: &Target,
    moves: &mut Vec<(bool, Op)>,
) -> Result<(), Fault> {
    let plane =
        walk.at.plane(in_force.cycle.plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?;
    let hole = Driven { walk, in_force, to, retract, depth, out, plane, target };
    match &in_force.cycle.kind {
        CycleKind::Tap(tap) => match hole.own_cycle(tap) {
            Some((own, settle)) => {
                hole.in_one_call(tap, own, settle, moves);
                Ok(())
            }
            None => hole.tap(tap, moves),
        },
        CycleKind::FineBore(bore) => hole.fine_bore(bore, moves),
        CycleKind::BoreStop(bore) => hole.bore_stop(bore, moves),
        CycleKind::Drill
        | CycleKind::DrillDwell { .. }
        | CycleKind::DrillPeck { .. }
        | CycleKind::DrillBreak { .. }
        | CycleKind::Bore { .. } => Ok(()),
    }
}

/// A dwell that is one.
fn dwell(seconds: &Option<Expr>, moves: &mut Vec<(bool, Op)>) {
    if let Some(seconds) = seconds.as_ref().filter(|seconds| lasts(seconds)) {
        moves.push((false, Op::Dwell(seconds.clone())));
    }
}

/// The spindle switched.
fn turn_it(to: Spindle) -> (bool, Op) {
    let op = match to {
        Spindle::Stopped => Op::StopSpindleTurning,
        Spindle::Clockwise => Op::StartSpindleClockwise,
        Spindle::Counterclockwise => Op::StartSpindleCounterclockwise,
    };
    (false, op)
}

/// A move of a tap synchronised with the spindle.
fn in_step(tap: &Tap, to: Point, turn: Turn) -> Op {
    Op::SynchronisedFeed(Box::new(Synchronised {
        to,
        pitch: tap.pitch.clone(),
        chuck: tap.chuck,
        turn: (!tap.chuck).then_some(turn),
        back: false,
    }))
}

impl Driven<'_> {
    /// The spindle after the hole, which may turn as before.
    fn turned(&self, after: Option<Spindle>) -> Result<(bool, Op), Fault> {
        match after.or(self.walk.at.spindle) {
            Some(spindle) => Ok(turn_it(spindle)),
            None => Err(Fault::lacks(HolesLack::SpindleAfterUnknown)),
        }
    }

    /// The cycle with which the target taps the hole, and a dwell that follows it.
    fn own_cycle(&self, tap: &Tap) -> Option<(Cycle, Option<Expr>)> {
        let ends = [&self.retract, &self.depth];
        let own = self
            .out
            .as_ref()
            .and_then(|_| own_tap(self.in_force, &self.in_force.cycle.kind, self.plane, ends, self.target));
        // A dwell at the retract plane follows a cycle that has none there.
        let settle = tap.settle.as_ref().filter(|_| !tap.chuck);
        let alone = Tap { settle: None, after: Spindle::Stopped, ..tap.clone() };
        let settled =
            || own_tap(self.in_force, &CycleKind::Tap(Box::new(alone)), self.plane, ends, self.target);
        match (own, settle) {
            (Some(own), _) => Some((own, None)),
            (None, Some(settle)) => settled().map(|own| (own, Some(settle.clone()))),
            (None, None) => None,
        }
    }

    /// The target's own cycle, called once, and what follows it.
    fn in_one_call(self, tap: &Tap, own: Cycle, settle: Option<Expr>, moves: &mut Vec<(bool, Op)>) {
        moves.push((false, Op::StartCycle(Box::new(own))));
        moves.push((true, Op::Hole(Move { to: Point::default(), said: true })));
        moves.push((false, Op::EndCycle));
        let starts = settle.is_some() && tap.after != Spindle::Stopped;
        dwell(&settle, moves);
        moves.extend(self.out.map(|out| (false, traverse(out))));
        if starts {
            moves.push(turn_it(tap.after));
        }
    }

    /// A tap by spindle-synchronised moves.
    fn tap(self, tap: &Tap, moves: &mut Vec<(bool, Op)>) -> Result<(), Fault> {
        let threads = self.target.caps.moves.threads;
        let says = if tap.chuck { threads.chuck } else { threads.turned || threads.back };
        if !threads.any && !says {
            let lack: Lack = match tap.settle == tap.dwell && tap.back.is_none() {
                true => HolesLack::CycleForm { kind: self.in_force.cycle.kind.name() }.into(),
                false => ThreadsLack::DwellAtOneEnd.into(),
            };
            return Err(Fault::lacks(lack));
        }
        moves.push((false, in_step(tap, self.depth, tap.turn)));
        dwell(&tap.dwell, moves);
        if tap.chuck {
            moves.push(turn_it(tap.turn.back().spindle()));
            dwell(&tap.back, moves);
        } else if tap.back.as_ref().is_some_and(lasts) {
            return Err(Fault::lacks(ThreadsLack::DwellAfterReversal));
        }
        let (end, out) = match self.out {
            Some(out) if tap.to_level => (out, None),
            out => (self.retract, out),
        };
        moves.push((false, in_step(tap, end, tap.turn.back())));
        dwell(&tap.settle, moves);
        if tap.chuck {
            moves.push(turn_it(tap.after));
        }
        moves.extend(out.map(|out| (false, traverse(out))));
        if !tap.chuck && tap.after != Spindle::Stopped {
            moves.push(turn_it(tap.after));
        }
        Ok(())
    }

    /// Boring that is left off the wall, with the spindle turned to an angle.
    fn fine_bore(self, bore: &FineBore, moves: &mut Vec<(bool, Op)>) -> Result<(), Fault> {
        let normal = self.plane.axes().2;
        let turned = self.turned(bore.after);
        moves.extend(bore.turn.map(|turn| turn_it(turn.spindle())));
        moves.push((false, cut(self.depth)));
        dwell(&bore.dwell, moves);
        let angle = bore.angle.clone().or_else(|| self.target.orientation.map(Expr::Num));
        moves.push((false, Op::OrientSpindle(angle)));
        let by = off_the_wall(&bore.shift, self.plane, self.target)?;
        let (mut aside, mut back) = (Point::default(), Point::default());
        for axis in [Axis::X, Axis::Y, Axis::Z] {
            let Some(by) = &by[axis as usize] else { continue };
            let (Some(by), Expr::Num(num)) = (self.walk.at.nanos(by), by) else {
                return Err(Fault::lacks(HolesLack::ComputedShift));
            };
            if by == 0 {
                continue;
            }
            let word = |num: Num| Coord { value: num.into(), distance: Fact::Known(Distance::Incremental) };
            let unit = unit_of(axis, self.walk.unit());
            let foot = match (axis == normal, self.to.get(axis)) {
                (true, _) => self.in_force.depth,
                (false, Some(word)) => self.walk.at.resolve(word, self.walk.at.position[axis as usize]),
                (false, None) => self.walk.at.position[axis as usize],
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
        moves.push((false, traverse(self.out.unwrap_or(self.retract))));
        if !back.is_empty() {
            moves.push((false, traverse(back)));
        }
        moves.push(turned?);
        Ok(())
    }

    /// Boring that is left with a stopped spindle.
    fn bore_stop(self, bore: &BoreStop, moves: &mut Vec<(bool, Op)>) -> Result<(), Fault> {
        let turned = self.turned(bore.after);
        moves.extend(bore.turn.map(|turn| turn_it(turn.spindle())));
        moves.push((false, cut(self.depth)));
        dwell(&bore.dwell, moves);
        moves.push((false, Op::StopSpindleTurning));
        if bore.stop {
            moves.push((false, Op::ProgramStop));
        }
        moves.push((false, traverse(self.out.unwrap_or(self.retract))));
        moves.push(turned?);
        Ok(())
    }
}

/// The cycle with which a target taps one hole over which the tool stands at the retract plane, to leave it
/// there: where its own cycle would go on at feed to the return level, or has no such level.
fn own_tap(
    in_force: &ActiveCycle,
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
            let cannot = || Fault::lacks(HolesLack::ShiftDirection);
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
