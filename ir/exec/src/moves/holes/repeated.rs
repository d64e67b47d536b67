//! Many holes of one cycle, of which most are not executed one by one: each makes what the one before it has made,
//! elsewhere.
//!
//! ```text
//! X10. Y20. / X30. / Y5. / … / X0. Y0.    the first two and the last are executed, those between are counted
//! ```
//!
//! Why that gives the same: [`Exec::make_hole`] leaves the tool at the level to return to, so every hole after the
//! first begins at the same level, in the same state, and takes the same way: what it makes hangs on where it is alone.
//! That is one move in the plane, which is no event where the tool is there already, and around it the same moves along
//! the axis, dwells and the like. So the holes after one that went somewhere are known by where they are, and the last
//! one, which is executed again, leaves the state as all of them do. What is not so plain (a frame that turns, a feed
//! that counts for one move, a spindle that is stopped or that the cycle stops) is executed one by one.

use super::Way;
use crate::moves::lines::valued::Stroke;
use crate::verify::is_silent;
use crate::{Event, Exec, by_control};
use ncc_ir::canon::{AXES, Axis, Distance, FeedMode, Spindle};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::{Op, Point, Stmt};

/// Where a hole is, if a statement says that by plain words and nothing else.
pub(super) fn place_of(stmt: &Stmt) -> Option<&Point> {
    match &stmt.op {
        Op::Hole(m) if stmt.skip.is_none() && m.to.axes[Axis::A as usize..].iter().all(Option::is_none) => {
            Some(&m.to)
        }
        _ => None,
    }
}

/// Holes of which the words have their values already: computed once, for all controls that make them.
#[derive(Clone, Debug)]
pub struct ValuedHoles {
    /// The axes that each one names, a bit each, and their values.
    holes: Vec<(u8, [Nanos; 3])>,
    /// The axes that any of them names.
    named: u8,
    /// The unit in which they were computed.
    inch: bool,
}

impl ValuedHoles {
    /// Whether no hole says where it is along an axis.
    pub(super) fn names_no(&self, axis: usize) -> bool {
        self.named >> axis & 1 == 0
    }

    pub(super) fn named(&self) -> u32 {
        self.named.into()
    }

    pub(super) fn inch(&self) -> bool {
        self.inch
    }

    /// Where the holes are after the first `made` ones, from where these have led.
    pub(super) fn places(&self, made: usize, from: [Nanos; AXES]) -> impl Iterator<Item = [Nanos; AXES]> {
        let mut at = from;
        self.holes.iter().skip(made).map(move |(named, values)| {
            for (axis, value) in values.iter().enumerate() {
                if named >> axis & 1 == 1 {
                    at[axis] = *value;
                }
            }
            at
        })
    }
}

/// What is known of a control before a hole.
struct Before {
    at: [Nanos; AXES],
    counted: u64,
    strokes: usize,
}

impl Exec {
    /// The values of holes for this control, and for all that have the same active unit; `None` where one of the
    /// statements is no hole at a place of plain words, or counts from the last one.
    pub fn value_holes(&self, stmts: &[Stmt]) -> Option<ValuedHoles> {
        let (mut holes, mut all) = (Vec::with_capacity(stmts.len()), 0);
        for stmt in stmts.iter().filter(|stmt| !is_silent(stmt)) {
            let (mut named, mut values) = (0, [0; 3]);
            for (axis, word) in place_of(stmt)?.axes[..3].iter().enumerate() {
                let Some(word) = word else { continue };
                if word.distance.or(Distance::Absolute) != Distance::Absolute {
                    return None;
                }
                values[axis] = self.plain_value(&word.value)?;
                named |= 1 << axis;
            }
            all |= named;
            holes.push((named, values));
        }
        Some(ValuedHoles { holes, named: all, inch: self.modes.inch })
    }

    /// Executes holes of which no events are made; `valued` are their values. Tells where each of them is.
    pub(super) fn make_holes(
        &mut self,
        stmts: &[Stmt],
        valued: Option<&ValuedHoles>,
        mut is_at: impl FnMut([Nanos; AXES]),
    ) -> Result<(), Diagnostic> {
        let mut none: Vec<Event> = Vec::new();
        let last = stmts.iter().rposition(|stmt| !is_silent(stmt)).unwrap_or(0);
        let mut valued = valued.filter(|valued| valued.inch == self.modes.inch);
        let (mut made, mut at) = (0, 0);
        while let Some(stmt) = stmts.get(at) {
            let before = Before { at: self.position, counted: self.counted, strokes: self.strokes_kept() };
            self.step(stmt, &mut none)?;
            at += 1;
            if is_silent(stmt) {
                continue;
            }
            made += 1;
            is_at(self.position);
            // The first one may begin at another level than those after it.
            let went = made > 1 && before.at != self.position;
            if let Some(valued) = valued.take_if(|valued| went && self.repeats(valued)) {
                self.repeat(valued, made, &before, &mut is_at);
                at = at.max(last);
            }
        }
        Ok(())
    }

    /// Whether the hole that was made last stands for all after it.
    fn repeats(&self, valued: &ValuedHoles) -> bool {
        let Some(cycle) = self.cycle.as_ref().filter(|_| self.makes_holes_anywhere()) else { return false };
        let straight = self.chain.is_none() && self.machine() == self.last;
        let turns = self.state.spindle != Spindle::Stopped && !self.standing.at_zero;
        let z = by_control::Z | by_control::Z_AT_START | by_control::Z_COUNTED;
        straight
            && turns
            && !matches!(cycle.way, Way::Tap { .. })
            && !self.speed_watched
            && self.state.feed_mode != FeedMode::InverseTime
            && self.state.by_control & z == 0
            && self.in_block.is_none()
            && self.corner.is_none()
            && self.centre_path.is_none()
            && valued.names_no(cycle.plane.axes().2 as usize)
    }

    /// Makes all holes between the one that was made last and the last of all, as the former.
    fn repeat(
        &mut self,
        valued: &ValuedHoles,
        made: usize,
        before: &Before,
        is_at: &mut impl FnMut([Nanos; AXES]),
    ) {
        let many = valued.holes.len().saturating_sub(made + 1);
        let own: Vec<Stroke> = self.strokes_from(before.strokes).to_vec();
        let events = self.counted - before.counted;
        let normal = self.cycle.as_ref().map_or(2, |cycle| cycle.plane.axes().2 as usize);
        for next in valued.places(made, self.position).take(many) {
            let (from, goes) = (self.position, self.position != next);
            self.counted += events - u64::from(!goes);
            let mut arrived = false;
            for Stroke { feed, to } in &own {
                // Before the way in the plane the tool is where the last hole is.
                let there = (0..AXES).all(|axis| axis == normal || to[axis] == before.at[axis]);
                let arrives = !there && !arrived;
                arrived |= arrives;
                if arrives && !goes {
                    continue;
                }
                let mut to_next = if arrived { next } else { from };
                to_next[normal] = to[normal];
                self.keep(Stroke { feed: *feed, to: to_next });
            }
            self.position = next;
            is_at(next);
        }
        self.last = self.machine();
        self.relies_on_slots(valued.named());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::moves::sketch::{drilling, hole, mm, stmt, to, word};
    use crate::world::World;
    use ncc_ir::canon::{Fact, Modes, Plane, ReturnLevel, Turn};
    use ncc_ir::expr::Expr;
    use ncc_ir::program::cycle::{Approach, BoreStop, Clearance, Cycle, CycleKind, Tap};
    use ncc_ir::program::{Coord, Pitch, Slot};

    fn cycles() -> Vec<Cycle> {
        let peck = |clearance, pause| CycleKind::DrillPeck {
            peck: mm(5_000),
            first: None,
            less: None,
            clearance,
            pause,
            settle: None,
            dwell: None,
        };
        let tap = Tap {
            turn: Turn::Clockwise,
            pitch: Pitch::Stated(mm(1_000)),
            chuck: false,
            dwell: None,
            back: None,
            settle: None,
            after: Spindle::Clockwise,
            to_level: false,
        };
        let kinds = [
            CycleKind::DrillDwell { dwell: Expr::int(1) },
            peck(Clearance::Stated(mm(1_000)), None),
            peck(Clearance::FromReturn, Some(Expr::int(1))),
            CycleKind::Bore { dwell: None, feed_out: Some(Expr::int(90)), to_level: true },
            CycleKind::Tap(Box::new(tap)),
            CycleKind::BoreStop(BoreStop { turn: None, dwell: None, stop: false, after: None }),
        ];
        let mut all: Vec<Cycle> = kinds.into_iter().map(|kind| Cycle { kind, ..drilling() }).collect();
        for level in [ReturnLevel::Retract, ReturnLevel::Initial] {
            let return_level = Fact::Known(level);
            all.extend(Approach::ALL.map(|approach| Cycle { approach, return_level, ..drilling() }));
        }
        all.extend(Approach::ALL.map(|approach| Cycle {
            approach,
            return_plane: Some(word(5_000)),
            ..drilling()
        }));
        all
    }

    fn control(begin: &[Op], cycle: &Cycle) -> Exec {
        let mut exec = Exec::new(&World::generate(1, &Modes::default()), 0);
        let start = [
            Op::SetDistanceMode(Distance::Absolute),
            Op::SetReturnLevel(ReturnLevel::Retract),
            Op::SetSpindleSpeed(Expr::int(500)),
            Op::StartSpindleClockwise,
            Op::SetFeedRate(Expr::int(100)),
            Op::StraightTraverse(to([Some(0), Some(0), Some(50_000)])),
        ];
        let cycle = Op::StartCycle(Box::new(cycle.clone()));
        for op in start.into_iter().chain(begin.iter().cloned()).chain([cycle]) {
            exec.step(&stmt(op), &mut Vec::new()).expect("a plain program");
        }
        // What holes rely on is seen again.
        exec.outlived = crate::run::left::Outlived::default();
        exec
    }

    /// Holes here and there, some where the one before is, some along one axis alone. Of seed 0, only a hole
    /// that is counted names Y.
    fn holes(mut seed: u64) -> Vec<Stmt> {
        if seed == 0 {
            let along_x = |x| stmt(Op::Hole(to([Some(x), None, None])));
            let along_y = stmt(Op::Hole(to([None, Some(1_500), None])));
            return vec![along_x(1_500), along_x(3_000), along_y, along_x(4_500)];
        }
        let mut next = move |below: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) % below
        };
        let mut one = |_| {
            let [x, y] = [0; 2].map(|_| (next(3) != 0).then(|| next(3) as i64 * 1_500));
            match next(8) {
                0 => stmt(Op::Blank),
                _ if x.is_none() && y.is_none() => hole(0, 1_500),
                _ => stmt(Op::Hole(to([x, y, None]))),
            }
        };
        (0..12).map(&mut one).collect()
    }

    fn turned() -> Op {
        let centre = [Some(Expr::int(0)), Some(Expr::int(0)), None];
        let angle = Coord { value: Expr::int(30), distance: Fact::Known(Distance::Absolute) };
        Op::SetSlot(Box::new(Slot::Rotation {
            plane: Fact::Known(Plane::Xy),
            centre: Box::new(centre),
            angle,
        }))
    }

    /// Places, events, strokes and the state after them are those of holes that are executed one by one; or both fail.
    #[test]
    fn holes_that_are_counted_do_what_each_of_them_does() {
        let begins: [&[Op]; 7] = [
            &[],
            &[Op::UseLengthUnits(ncc_ir::canon::Units::Inch)],
            &[Op::SetOriginOffsets(2)],
            &[Op::SetFeedMode(FeedMode::InverseTime), Op::SetFeedRate(Expr::int(2))],
            &[Op::StopSpindleTurning],
            &[turned()],
            &[Op::SetDistanceMode(Distance::Incremental)],
        ];
        let (all, mut counted, mut left) = (cycles(), 0, 0);
        for (begin, cycle) in begins.iter().flat_map(|begin| all.iter().map(move |cycle| (begin, cycle))) {
            for seed in 0..40 {
                let holes = holes(seed);
                let fresh = control(begin, cycle);
                let valued = fresh.value_holes(&holes).expect("plain words");
                let made = |valued: Option<&ValuedHoles>| {
                    let (mut exec, mut places) = (fresh.clone(), Vec::new());
                    let events = exec.pass_holes(&holes, valued, &mut places);
                    let behind = exec.cycle.as_ref().map(|_| {
                        exec.repeats(valued.unwrap_or(&ValuedHoles {
                            holes: Vec::new(),
                            named: 0,
                            inch: false,
                        }))
                    });
                    (format!("{events:?} {places:?} {exec:?}"), events.is_ok() && behind == Some(true))
                };
                let strokes = |valued: Option<&ValuedHoles>| {
                    let mut exec = fresh.clone();
                    let strokes = exec.pass_strokes(&holes, valued);
                    format!("{strokes:?} {exec:?}")
                };
                let (one_by_one, is_plain) = made(None);
                assert_eq!(made(Some(&valued)).0, one_by_one, "{begin:?} {cycle:?} {holes:?}");
                assert_eq!(strokes(Some(&valued)), strokes(None), "{begin:?} {cycle:?} {holes:?}");
                *if is_plain { &mut counted } else { &mut left } += 1;
            }
        }
        assert!(counted > 1_000 && left > 1_000, "{counted} {left}");
    }

    #[test]
    fn what_is_not_plain_has_no_values() {
        let exec = control(&[], &drilling());
        let plain = || hole(1_000, 2_000);
        assert!(exec.value_holes(&[plain(), stmt(Op::Blank), plain()]).is_some());
        let mut from_there = to([Some(1_000), None, None]);
        if let Some(word) = &mut from_there.to.axes[0] {
            word.distance = Fact::Known(Distance::Incremental);
        }
        let skipped = Stmt { skip: Some(1), ..plain() };
        for other in [stmt(Op::Hole(from_there)), skipped, stmt(Op::ProgramStop)] {
            assert!(exec.value_holes(&[plain(), other]).is_none());
        }
    }
}
