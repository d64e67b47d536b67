//! Holes of one control that another one makes by lines.
//!
//! ```text
//! source: X10. Y20. under MCALL CYCLE81 | output: G0 X10. Y20. / G0 Z2. / G1 Z-20. / G0 Z5.    four straight moves each
//! ```
//!
//! Both controls execute their statements, for the effect on their own states, and what is held against each other are
//! not their events but the moves that make these: whether each cuts, and where in the program it ends ([`Stroke`]).
//!
//! Why that proves as much: an event is made of its kind, of where it ends in the machine, of the feed and of the state
//! ([`Exec::emit_move`], for holes and for lines). Holes that are straight moves alone, and lines, change the position and
//! nothing else of that. So where two states agree in frames, feed and state before them, and where the machine stands,
//! they do so after each move; a place of the program is then one place of the machine, and two moves of one kind to one
//! place are the same event, or none where the machine stands there already. What is not so plain is left to a comparison
//! of events: dwells, boring and tapping, which are no straight moves or have another feed; whatever [`Exec::takes_lines`]
//! and [`Exec::makes_plain_holes`] leave aside.
//!
//! Not here: holes that both controls make as holes (`same`).

use super::Way;
use super::repeated::ValuedHoles;
use crate::moves::lines::valued::{Stroke, ValuedLines};
use crate::{Exec, Kind};
use ncc_ir::diag::Diagnostic;
use ncc_ir::program::Stmt;

/// Strokes that a control makes, while these are kept.
#[derive(Clone, Debug)]
pub(crate) struct Strokes {
    kept: Vec<Stroke>,
    /// Whether all events were such moves.
    alone: bool,
}

impl Exec {
    /// Keeps an event of a control of which the strokes are kept.
    #[inline]
    pub(crate) fn keep_stroke(&mut self, kind: &Kind) {
        let to = self.position;
        let Some(strokes) = &mut self.strokes else { return };
        match kind {
            Kind::Feed => strokes.kept.push(Stroke { feed: true, to }),
            Kind::Traverse => strokes.kept.push(Stroke { feed: false, to }),
            _ => strokes.alone = false,
        }
    }

    /// How many strokes are kept.
    pub(super) fn strokes_kept(&self) -> usize {
        self.strokes.as_ref().map_or(0, |strokes| strokes.kept.len())
    }

    /// The strokes that are kept after the first so many.
    pub(super) fn strokes_from(&self, first: usize) -> &[Stroke] {
        let kept = self.strokes.as_ref().and_then(|strokes| strokes.kept.get(first..));
        kept.unwrap_or_default()
    }

    /// Keeps a stroke of a hole that is not executed.
    pub(super) fn keep(&mut self, stroke: Stroke) {
        if let Some(strokes) = &mut self.strokes {
            strokes.kept.push(stroke);
        }
    }

    /// Executes holes for their effect on the state alone; gives their strokes, or `None` where they make anything else.
    /// With their values most of them are not executed one by one.
    ///
    /// # Errors
    /// As of [`Exec::step`].
    pub fn pass_strokes(
        &mut self,
        stmts: &[Stmt],
        valued: Option<&ValuedHoles>,
    ) -> Result<Option<Vec<Stroke>>, Diagnostic> {
        // Most holes are four of them.
        let kept = Vec::with_capacity(4 * stmts.len());
        (self.quiet, self.counted) = (true, 0);
        self.strokes = Some(Box::new(Strokes { kept, alone: true }));
        let passed = self.make_holes(stmts, valued, |_| {});
        self.quiet = false;
        let strokes = self.strokes.take();
        passed.map(|()| strokes.filter(|strokes| strokes.alone).map(|strokes| strokes.kept))
    }

    /// Whether holes of the active cycle here, and lines along the same strokes on another control, are the same events,
    /// and leave both in states of which that is so again.
    pub fn makes_strokes_of(&self, other: &Exec) -> bool {
        let Some(cycle) = self.cycle.as_ref().filter(|_| other.cycle.is_none()) else { return false };
        let moves = matches!(cycle.way, Way::Drill { .. } | Way::Peck { .. } | Way::Break { .. });
        moves && self.makes_plain_holes() && other.takes_lines() && self.agrees_beside_motion(other)
    }

    /// Whether lines are these strokes one by one, from where this control stands.
    pub fn goes_along(&self, lines: &ValuedLines, strokes: &[Stroke]) -> bool {
        // A line to where the axes stand is no event then.
        self.machine() == self.last && lines.go_along(self, strokes)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Event;
    use crate::moves::sketch::{drilling, hole, mm, stmt, to, word};
    use crate::world::World;
    use ncc_ir::canon::{Distance, Fact, FeedMode, Modes, Plane, ReturnLevel};
    use ncc_ir::expr::Expr;
    use ncc_ir::expr::num::{Num, Unit};
    use ncc_ir::program::Op;
    use ncc_ir::program::cycle::{Approach, Clearance, Cycle, CycleKind};

    fn cycles() -> Vec<Cycle> {
        let plain = drilling();
        let peck = |clearance, pause: Option<Expr>| CycleKind::DrillPeck {
            peck: mm(5_000),
            first: None,
            less: None,
            clearance,
            pause,
            settle: None,
            dwell: None,
        };
        let chip = CycleKind::DrillBreak {
            peck: mm(5_000),
            first: None,
            less: None,
            lift: Clearance::Stated(mm(1_000)),
            lift_at_feed: false,
            pause: None,
            dwell: None,
        };
        let kinds = [
            CycleKind::Drill,
            CycleKind::DrillDwell { dwell: Expr::int(1) },
            peck(Clearance::Stated(mm(1_000)), None),
            peck(Clearance::Parameter, None),
            peck(Clearance::FromReturn, Some(Expr::int(1))),
            chip,
            CycleKind::Bore { dwell: None, feed_out: None, to_level: false },
            CycleKind::Bore { dwell: None, feed_out: Some(Expr::int(90)), to_level: true },
        ];
        let kinds = kinds.into_iter().map(|kind| Cycle { kind, ..plain.clone() });
        let ways = Approach::ALL.map(|approach| Cycle { approach, ..plain.clone() });
        let initial = Cycle { return_level: Fact::Known(ReturnLevel::Initial), ..plain.clone() };
        let plane = Cycle { return_plane: Some(word(5_000)), ..plain.clone() };
        kinds.chain(ways).chain([initial, plane]).collect()
    }

    /// A control before any hole, after these statements.
    fn control(begin: &[Op]) -> Exec {
        let mut exec = Exec::new(&World::generate(1, &Modes::default()), 0);
        let start = [
            Op::SetDistanceMode(Distance::Absolute),
            Op::SetFeedMode(FeedMode::PerMinute),
            Op::SetReturnLevel(ReturnLevel::Retract),
            Op::SetSpindleSpeed(Expr::int(500)),
            Op::StartSpindleClockwise,
            Op::SetFeedRate(Expr::int(100)),
            Op::StraightTraverse(to([Some(0), Some(0), Some(50_000)])),
        ];
        for op in start.into_iter().chain(begin.iter().cloned()) {
            exec.step(&stmt(op), &mut Vec::new()).expect("a plain program");
        }
        exec
    }

    fn events(exec: &mut Exec, stmts: &[Stmt]) -> Vec<Event> {
        let mut events = Vec::new();
        stmts.iter().try_for_each(|stmt| exec.step(stmt, &mut events)).expect("plain holes");
        events
    }

    /// Strokes as lines.
    fn lines(strokes: &[Stroke]) -> Vec<Stmt> {
        let end = |stroke: &Stroke| {
            let mut end = to([Some(0); 3]);
            for (word, at) in end.to.axes.iter_mut().flatten().zip(stroke.to) {
                word.value = Expr::Num(Num { mantissa: at, scale: 9, point: true, unit: Unit::Mm });
            }
            end
        };
        let line = |stroke: &Stroke| match stroke.feed {
            true => Op::StraightFeed(end(stroke)),
            false => Op::StraightTraverse(end(stroke)),
        };
        strokes.iter().map(|stroke| stmt(line(stroke))).collect()
    }

    fn goes_along(exec: &Exec, stmts: &[Stmt], strokes: &[Stroke]) -> bool {
        exec.value_lines(stmts).is_some_and(|lines| exec.goes_along(&lines, strokes))
    }

    #[test]
    fn lines_along_strokes_are_the_events_of_the_holes() {
        let holes: Vec<Stmt> = (0..5).map(|n| hole(n * 1_500, n * n * 700)).collect();
        let mut passed = 0;
        for (cycle, made) in cycles().iter().flat_map(|cycle| (0..3).map(move |made| (cycle, made))) {
            let what = format!("{cycle:?} behind {made}");
            let start = Op::StartCycle(Box::new(cycle.clone()));
            let (mut source, mut target) = (control(&[start]), control(&[]));
            let strokes = source.pass_strokes(&holes[..made], None).expect("plain holes");
            let Some(strokes) = strokes.filter(|_| source.makes_strokes_of(&target) || made > 0) else {
                continue;
            };
            events(&mut target, &lines(&strokes));
            if !source.makes_strokes_of(&target) {
                continue;
            }
            let mut behind = source.clone();
            let valued = source.value_holes(&holes[made..]).expect("plain words");
            let strokes = behind.pass_strokes(&holes[made..], Some(&valued)).expect("plain holes");
            let Some(strokes) = strokes else { continue };
            let written = lines(&strokes);
            assert!(goes_along(&target, &written, &strokes), "{what}");
            let mut after = target.clone();
            let there = events(&mut after, &written);
            assert_eq!(events(&mut source, &holes[made..]), there, "{what}");
            assert_eq!(behind.counted, there.len() as u64, "{what}");
            behind.counted = source.counted;
            assert_eq!(format!("{behind:?}"), format!("{source:?}"), "{what}");
            assert!(source.makes_strokes_of(&after), "{what}");
            passed += 1;
            for at in 0..strokes.len() {
                let (mut other, mut kind, mut shorter) = (strokes.clone(), strokes.clone(), strokes.clone());
                other[at].to[at % 3] += 1_000_000;
                kind[at].feed ^= true;
                shorter.remove(at);
                for written in [other, kind, shorter] {
                    assert!(!goes_along(&target, &lines(&written), &strokes), "{what}, {at}");
                }
            }
        }
        assert!(passed > 15, "{passed}");
    }

    #[test]
    fn what_is_no_plain_line_goes_along_nothing() {
        let start = Op::StartCycle(Box::new(cycles().remove(0)));
        let (mut source, target) = (control(&[start]), control(&[]));
        let strokes =
            source.pass_strokes(&[hole(1_000, 2_000)], None).expect("a hole").expect("plain strokes");
        let written = lines(&strokes);
        assert!(goes_along(&target, &written, &strokes));
        for at in 0..written.len() {
            let with = |stmt: Stmt| {
                let mut stmts = written.clone();
                stmts.insert(at, stmt);
                goes_along(&target, &stmts, &strokes)
            };
            assert!(with(stmt(Op::Blank)));
            assert!(!with(stmt(Op::SetFeedRate(Expr::int(100)))));
            assert!(!with(stmt(Op::SetDistanceMode(Distance::Incremental))));
            assert!(!with(stmt(Op::Dwell(Expr::int(1)))));
            let mut skipped = written.clone();
            skipped[at].skip = Some(1);
            assert!(!goes_along(&target, &skipped, &strokes));
        }
    }

    /// Nothing of these is seen in the strokes.
    #[test]
    fn another_state_makes_other_events() {
        let start = Op::StartCycle(Box::new(cycles().remove(0)));
        let source = control(std::slice::from_ref(&start));
        assert!(source.makes_strokes_of(&control(&[])));
        assert!(!source.makes_strokes_of(&control(&[start])), "a cycle");
        let turned = [Some(Expr::int(0)), Some(Expr::int(0)), None];
        let slot = ncc_ir::program::Slot::Rotation {
            plane: Fact::Known(Plane::Xy),
            centre: Box::new(turned),
            angle: ncc_ir::program::Coord { value: Expr::int(30), distance: Fact::Known(Distance::Absolute) },
        };
        for op in [
            Op::SetFeedRate(Expr::int(101)),
            Op::SetSpindleSpeed(Expr::int(501)),
            Op::StartSpindleCounterclockwise,
            Op::StopSpindleTurning,
            Op::FloodOn,
            Op::SetFeedMode(FeedMode::PerRevolution),
            Op::SetFeedMode(FeedMode::InverseTime),
            Op::SetDistanceMode(Distance::Incremental),
            Op::SetOriginOffsets(2),
            Op::SetSlot(Box::new(slot)),
            Op::StraightTraverse(to([Some(1), None, None])),
            Op::StraightFeed(to([None, None, Some(49_000)])),
        ] {
            let what = format!("{op:?}");
            assert!(!source.makes_strokes_of(&control(&[op])), "{what}");
        }
    }
}
