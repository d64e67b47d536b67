//! Holes that two controls make alike, so that one execution counts for both.
//!
//! ```text
//! source: X10. Y20. under G81 | output: X10 Y20 under MCALL CYCLE81    the same strokes at the same place
//! ```
//!
//! Why that proves the same as two executions: [`Exec::make_hole`] is the same code for both controls. It makes events of
//! the control's state, of the active cycle's effect (its planes, its strokes and dwells, the level to return to
//! and how the way to the hole begins), and of where the hole is; of nothing else. The control's own parameters, such as
//! the clearance of pecks, are in the strokes when the cycle begins. So where two states agree in all but the words of the
//! cycle, both cycles give the same ([`Moves`]), and the hole is at the same place of the program,
//! both controls make the same events. They reach states that agree again, as the state after a hole is made of the same
//! things; and the cycles still give the same, as the tool then stands at the level to return to, from which the way to
//! the next hole begins alike too. What is not so plain (a length that waits, a change of frame that words include,
//! incremental words, rotary axes, a cycle that stops the spindle) is left to execution.

use super::repeated::{ValuedHoles, place_of};
use super::{ActiveCycle, Way};
use crate::Exec;
use crate::verify::is_silent;
use ncc_ir::canon::{AXES, Distance, Plane};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::Stmt;
use ncc_ir::program::cycle::Leg;
use ncc_ir::source::Span;

/// The effect of a cycle at each of its holes.
#[derive(Debug, PartialEq)]
struct Moves {
    plane: Plane,
    retract: Nanos,
    depth: Nanos,
    out_to: Nanos,
    /// How the way begins to the next hole, and to all after it.
    legs: [Leg; 2],
    way: Way,
}

/// Whether statements are nothing but holes at places of plain words.
pub fn are_holes(stmts: &[Stmt]) -> bool {
    stmts.iter().all(|stmt| is_silent(stmt) || place_of(stmt).is_some()) && !stmts.iter().all(is_silent)
}

impl Exec {
    /// Executes holes for their effect on the state alone; gives the number of their events, and appends the places of
    /// the program where they are, along the cycle's plane. With their values most of them are not executed one by one.
    ///
    /// # Errors
    /// As of [`Exec::step`].
    pub fn pass_holes(
        &mut self,
        stmts: &[Stmt],
        valued: Option<&ValuedHoles>,
        places: &mut Vec<[Nanos; AXES]>,
    ) -> Result<u64, Diagnostic> {
        (self.quiet, self.counted) = (true, 0);
        let passed = self.make_holes(stmts, valued, |place| places.push(place));
        self.quiet = false;
        passed.map(|()| self.counted)
    }

    /// Whether holes at the same places are the same events here and on another control, and leave both in states of which
    /// that is so again.
    pub fn makes_holes_of(&self, other: &Exec) -> bool {
        self.has_cycle_like(other) && self.agrees_beside_cycle(other)
    }

    /// Whether the active cycles on both controls give the same.
    pub fn has_cycle_like(&self, other: &Exec) -> bool {
        let moves = self.moves_of_holes();
        moves.is_some() && moves == other.moves_of_holes()
    }

    /// Whether the holes of the active cycle hang on nothing else than where they are.
    pub(super) fn makes_holes_anywhere(&self) -> bool {
        self.moves_of_holes().is_some()
    }

    /// The effect of the active cycle, if its holes hang on nothing else than where they are.
    fn moves_of_holes(&self) -> Option<Moves> {
        let cycle = self.cycle.as_ref().filter(|_| self.makes_plain_holes())?;
        let &ActiveCycle { plane, retract, depth, approach, initial, way, .. } = cycle;
        if matches!(way, Way::Fine { .. } | Way::Stop { .. }) {
            return None;
        }
        // A control that refuses the cycle makes no hole.
        self.spindle_turns_for(cycle, Span::default()).ok()?;
        let level = self.return_to(cycle);
        self.level_is_known(cycle, level, Span::default()).ok()?;
        let out_to = cycle.return_plane.unwrap_or(level);
        let stands = self.position[plane.axes().2 as usize];
        let legs = [stands, out_to].map(|level| approach.leg(level, initial, retract, out_to));
        Some(Moves { plane, retract, depth, out_to, legs, way })
    }

    pub(super) fn makes_plain_holes(&self) -> bool {
        let otherwise = self.ended || self.narrating || self.every_move;
        let beside = self.contour.watched || self.state.tip || self.state.tilted;
        self.modes.distance == Distance::Absolute
            && !otherwise
            && !beside
            && !self.carries_linear()
            && self.waiting.is_none()
            && self.ways.is_none()
            && self.after_stop.is_none()
            && self.raw.is_none()
            && self.probing.is_none()
            && self.detour.is_none()
    }

    /// Whether these are holes at these places, under the active cycle; `false` where that is not plain to see.
    pub fn has_holes_at(&mut self, holes: &ValuedHoles, places: &[[Nanos; AXES]]) -> bool {
        let Some(normal) = self.cycle.as_ref().map(|cycle| cycle.plane.axes().2 as usize) else {
            return false;
        };
        let mut places = places.iter();
        let there = |at: &[Nanos; AXES], place: &[Nanos; AXES]| {
            (0..AXES).all(|axis| axis == normal || at[axis] == place[axis])
        };
        let same = holes.inch() == self.modes.inch
            && holes.names_no(normal)
            && holes.places(0, self.position).all(|at| places.next().is_some_and(|place| there(&at, place)))
            && places.next().is_none();
        if same {
            self.relies_on_slots(holes.named());
        }
        same
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Event;
    use crate::moves::sketch::{drilling, hole, mm, stmt, to, word};
    use crate::world::World;
    use ncc_ir::canon::{Fact, Modes, ReturnLevel, Spindle, Turn};
    use ncc_ir::expr::Expr;
    use ncc_ir::program::cycle::{Approach, BoreStop, Clearance, Cycle, CycleKind, Tap};
    use ncc_ir::program::{Op, Pitch};

    fn peck(peck: i64, clearance: Clearance) -> CycleKind {
        let (first, less, pause, settle, dwell) = (None, None, None, None, None);
        CycleKind::DrillPeck { peck: mm(peck), first, less, clearance, pause, settle, dwell }
    }

    fn tap(pitch: i64) -> CycleKind {
        CycleKind::Tap(Box::new(Tap {
            turn: Turn::Clockwise,
            pitch: Pitch::Stated(mm(pitch)),
            chuck: false,
            dwell: None,
            back: None,
            settle: None,
            after: Spindle::Clockwise,
            to_level: false,
        }))
    }

    /// Cycles that differ from each other, and some that give the same in other words.
    fn cycles() -> Vec<Cycle> {
        let stop = BoreStop { turn: None, dwell: None, stop: false, after: None };
        let kinds = [
            CycleKind::DrillDwell { dwell: Expr::int(1) },
            CycleKind::DrillDwell { dwell: Expr::int(2) },
            peck(5_000, Clearance::Stated(mm(1_000))),
            peck(5_000, Clearance::Parameter),
            peck(5_000, Clearance::FromReturn),
            peck(4_000, Clearance::Parameter),
            CycleKind::Bore { dwell: None, feed_out: None, to_level: false },
            CycleKind::Bore { dwell: None, feed_out: None, to_level: true },
            CycleKind::Bore { dwell: None, feed_out: Some(Expr::int(90)), to_level: true },
            tap(1_000),
            tap(1_500),
            CycleKind::BoreStop(stop),
        ];
        let mut all: Vec<Cycle> = kinds.into_iter().map(|kind| Cycle { kind, ..drilling() }).collect();
        let initial = Fact::Known(ReturnLevel::Initial);
        for return_level in [Fact::Known(ReturnLevel::Retract), initial, Fact::Entry] {
            all.extend(Approach::ALL.map(|approach| Cycle { approach, return_level, ..drilling() }));
        }
        all.extend([2_000, 5_000, 50_000].map(|to| Cycle { return_plane: Some(word(to)), ..drilling() }));
        all.extend([1_000, 60_000].map(|retract| Cycle { retract: word(retract), ..drilling() }));
        all.push(Cycle { depth: word(-20_001), ..drilling() });
        all.push(Cycle { retract: word(1_000), return_plane: Some(word(5_000)), ..drilling() });
        all.push(Cycle { depth: word(-20_001), return_plane: Some(word(2_000)), ..drilling() });
        all
    }

    /// A control with an active cycle, whose clearance of pecks is so much.
    fn control(cycle: &Cycle, clearance: Nanos) -> Exec {
        in_world(&World { peck_clearance: clearance, ..World::generate(1, &Modes::default()) }, cycle)
    }

    fn in_world(world: &World, cycle: &Cycle) -> Exec {
        let mut exec = Exec::new(world, 0);
        let start = [
            Op::SetDistanceMode(Distance::Absolute),
            Op::SetReturnLevel(ReturnLevel::Retract),
            Op::SetSpindleSpeed(Expr::int(500)),
            Op::StartSpindleClockwise,
            Op::SetFeedRate(Expr::int(100)),
            Op::StraightTraverse(to([Some(0), Some(0), Some(50_000)])),
            Op::StartCycle(Box::new(cycle.clone())),
        ];
        for op in start {
            exec.step(&stmt(op), &mut Vec::new()).expect("a plain program");
        }
        exec
    }

    fn events(exec: &mut Exec, holes: &[Stmt]) -> Option<Vec<Event>> {
        let mut events = Vec::new();
        holes.iter().try_for_each(|hole| exec.step(hole, &mut events)).ok().map(|()| events)
    }

    /// Where two controls are said to make the same holes, two executions make the same events, and they are in such states
    /// again after each hole.
    #[test]
    fn holes_that_pass_are_the_same_events() {
        let holes: Vec<Stmt> = (0..4).map(|n| hole(n * 1_500, n * n * 700)).collect();
        let (all, mut alike, mut differ) = (cycles(), 0, 0);
        let sides: Vec<(&Cycle, Nanos)> =
            all.iter().flat_map(|cycle| [1_000_000, 3_000_000].map(|clearance| (cycle, clearance))).collect();
        for (at, (one, own)) in sides.iter().enumerate() {
            for (other, others) in &sides[at..] {
                for made in 0..3 {
                    let [mut one, mut other] = [control(one, *own), control(other, *others)];
                    let first = [events(&mut one, &holes[..made]), events(&mut other, &holes[..made])];
                    if !one.agrees_beside_cycle(&other) || first[0].is_none() {
                        continue;
                    }
                    let what = format!("{one:?} and {other:?} behind {made}");
                    let same = one.makes_holes_of(&other);
                    let (mut passed, mut places) = (one.clone(), Vec::new());
                    let valued = one.value_holes(&holes[made..]).expect("plain words");
                    let counted = passed.pass_holes(&holes[made..], Some(&valued), &mut places);
                    let is_at = other.clone().has_holes_at(&valued, &places);
                    let [a, b] = [&mut one, &mut other].map(|exec| events(exec, &holes[made..]));
                    if !same {
                        differ += u32::from(a != b);
                        continue;
                    }
                    alike += 1;
                    assert_eq!(a, b, "{what}");
                    assert!(one.makes_holes_of(&other), "{what}");
                    assert_eq!(counted.ok(), a.map(|events| events.len() as u64), "{what}");
                    assert!(is_at, "{what}");
                    passed.counted = one.counted;
                    assert_eq!(format!("{passed:?}"), format!("{one:?}"), "{what}");
                }
            }
        }
        assert!(alike > 200 && differ > 1_000, "{alike} {differ}");
    }

    #[test]
    fn a_tap_that_one_control_refuses_is_no_same_hole() {
        let cycle = Cycle { kind: tap(1_000), ..drilling() };
        let needs = World { cycles_need_spindle: true, ..World::generate(1, &Modes::default()) };
        let mut sides = [World::generate(1, &Modes::default()), needs].map(|world| in_world(&world, &cycle));
        let [one, other] = &sides;
        assert!(one.makes_holes_of(other));
        for side in &mut sides {
            side.step(&stmt(Op::StartSpindleCounterclockwise), &mut Vec::new()).expect("a plain program");
        }
        let [one, other] = &mut sides;
        assert!(!one.makes_holes_of(other));
        assert!(events(one, &[hole(0, 0)]).is_some() && events(other, &[hole(0, 0)]).is_none());
    }

    #[test]
    fn another_place_is_no_same_hole() {
        let mut exec = control(&drilling(), 0);
        let mut places = Vec::new();
        let said = [hole(1_000, 2_000), stmt(Op::Blank), hole(3_000, 2_000)];
        exec.clone().pass_holes(&said, None, &mut places).expect("plain holes");
        let only_x = stmt(Op::Hole(to([Some(3_000), None, None])));
        let mut holds = |written: &[Stmt]| {
            exec.value_holes(written).is_some_and(|written| exec.has_holes_at(&written, &places))
        };
        assert!(holds(&said) && holds(&[hole(1_000, 2_000), only_x]));
        assert!(!holds(&[hole(1_001, 2_000), hole(3_000, 2_000)]));
        assert!(!holds(&[hole(1_000, 2_000), hole(3_000, 2_001)]));
        assert!(!holds(&[hole(1_000, 2_000)]) && !holds(&[]));
        assert!(!holds(&[hole(1_000, 2_000), hole(3_000, 2_000), hole(3_000, 2_000)]));
        let skipped = Stmt { skip: Some(1), ..hole(3_000, 2_000) };
        assert!(!holds(&[hole(1_000, 2_000), skipped]));
        let lower = stmt(Op::Hole(to([Some(3_000), Some(2_000), Some(1_000)])));
        assert!(!holds(&[hole(1_000, 2_000), lower]));
    }
}
