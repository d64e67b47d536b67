//! Arcs that two controls make alike, so that one execution counts for both.
//!
//! ```text
//! source: G3 X20. Y0. I10. | output: G3 X20 Y0 I10    the same arc, if both controls accept it
//! ```
//!
//! Why that proves the same as two executions: an arc is made by the same code for both controls ([`Exec::arc`]). Its event
//! is made of the control's state, of the words, and of the control's own rule for arcs ([`ArcRule`]); of nothing else
//! where [`Exec::takes_lines`] holds, because no contour, no time of the block and no change of frame that its words include counts then. The rule
//! alone differs between two controls that agree. It never moves an arc: it accepts one or not, or takes a radius that
//! is a little too short for half a circle. So the arc that the source's rule makes is judged by the target's rule as well,
//! from the same numbers: its radii, or the centre that comes of its radius. Where the target's rule says anything else,
//! nothing stands for both, and both controls execute the piece by themselves. Two controls that agree before an arc agree
//! after it, since its end, its direction and the motion are made of the same numbers.
//!
//! Not here: arcs with rotary axes or incremental words, and those of another form than [`Op::ArcFeed`]. They are left to
//! execution.

use crate::Exec;
use crate::verify::is_silent;
use ncc_ir::canon::{AXES, Distance, Turn};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::Nanos;
use ncc_ir::geometry;
use ncc_ir::geometry::arc_solver::ArcRule;
use ncc_ir::program::{Arc, Op, Point, Stmt};

/// Another control's rule, by which each arc is judged as well.
#[derive(Clone, Debug)]
pub(crate) struct Beside {
    rule: ArcRule,
    /// Whether it took every arc so far as the own rule did.
    alike: bool,
}

impl Beside {
    /// Judges an arc by its radii at start and end.
    pub(super) fn judge_radii(&mut self, radii: [Nanos; 2], inch: bool) {
        self.alike &= self.rule.check(radii, inch).is_ok();
    }

    /// Judges an arc by its radius, of which the own rule has made this centre.
    pub(super) fn judge_centre(
        &mut self,
        [start, end]: [[Nanos; 2]; 2],
        (radius, turn): (Nanos, Turn),
        centre: [Nanos; 2],
        inch: bool,
    ) {
        let short = self.rule.short(inch);
        self.alike &= geometry::centre_by_radius(start, end, radius, turn, short) == Ok(centre);
    }
}

/// Whether all words are of linear axes and count from zero, unless the active mode says otherwise.
fn is_plain(to: &Point) -> bool {
    const FIRST_TURNING: usize = 3;
    let absolute = |word: &ncc_ir::program::Coord| word.distance.or(Distance::Absolute) == Distance::Absolute;
    to.axes[..FIRST_TURNING].iter().flatten().all(absolute)
        && to.axes[FIRST_TURNING..AXES].iter().all(Option::is_none)
}

/// Whether an arc has plain words alone.
pub(crate) fn is_plain_arc(arc: &Arc) -> bool {
    is_plain(&arc.to)
}

/// Whether statements are nothing but plain moves, feeds and arcs, and at least one of them is an arc.
pub fn are_arcs(stmts: &[Stmt]) -> bool {
    let mut arcs = false;
    stmts.iter().all(|stmt| match &stmt.op {
        Op::ArcFeed(arc) => {
            arcs = true;
            is_plain_arc(arc)
        }
        Op::StraightFeed(to) | Op::StraightTraverse(to) => is_plain(&to.to),
        Op::SetFeedRate(_) => true,
        _ => is_silent(stmt),
    }) && arcs
}

impl Exec {
    /// Whether plain arcs are executed by their words, the state and the rule for arcs alone.
    pub fn takes_arcs(&self) -> bool {
        self.takes_lines()
    }

    /// Whether plain arcs that both controls accept alike are the same events here and on another control.
    pub fn makes_arcs_of(&self, other: &Exec) -> bool {
        self.takes_arcs() && other.takes_arcs() && self.agrees_on_lines(other)
    }

    /// Executes plain moves and arcs for their effect on the state alone, and judges each arc by the rule of another
    /// control as well. Gives the number of their events; `None` where that rule takes an arc otherwise.
    ///
    /// # Errors
    /// As of [`Exec::step`].
    pub fn pass_arcs(&mut self, stmts: &[Stmt], other: &Exec) -> Result<Option<u64>, Diagnostic> {
        let rule = other.world.arcs;
        self.beside = (rule != self.world.arcs).then(|| Box::new(Beside { rule, alike: true }));
        let passed = self.pass(stmts);
        let beside = self.beside.take();
        let events = passed?;
        Ok(beside.is_none_or(|beside| beside.alike).then_some(events))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Event;
    use crate::moves::sketch::{mm, stmt, to};
    use crate::world::World;
    use ncc_ir::canon::{Fact, Modes, Plane};
    use ncc_ir::expr::Expr;
    use ncc_ir::expr::num::ONE;
    use ncc_ir::program::{Centre, CentreFrom, Coord, Turns};

    fn arc(turn: Turn, end: [Option<i64>; 3], centre: Centre) -> Stmt {
        let plane = Fact::Known(Plane::Xy);
        stmt(Op::ArcFeed(Box::new(Arc {
            plane,
            turn,
            to: to(end).to,
            centre,
            turns: Turns::NONE,
            said: true,
        })))
    }

    fn centre([i, j]: [i64; 2]) -> Centre {
        Centre::Point { words: [Some(mm(i)), Some(mm(j)), None], from: CentreFrom::Start }
    }

    /// Arcs from X0 Y0: whole and half circles, a helix, radii that differ a little or much, radii that are a little or
    /// much too short.
    fn arcs() -> Vec<Stmt> {
        let (cw, ccw) = (Turn::Clockwise, Turn::Counterclockwise);
        let by_centre = [5_000, 5_004, 5_006, 5_020, 5_300, 10_000, 0, 1]
            .map(|i| [cw, ccw].map(|turn| arc(turn, [Some(10_000), Some(0), None], centre([i, 0]))));
        let by_radius = [5_000, 4_999, 4_995, 4_980, 4_900, 8_000, -8_000].map(|radius| {
            [cw, ccw].map(|turn| arc(turn, [Some(10_000), Some(0), None], Centre::Radius(mm(radius))))
        });
        let further = [
            arc(cw, [None; 3], centre([3_000, 0])),
            arc(ccw, [Some(10_000), Some(0), Some(-3_000)], centre([5_000, 0])),
            arc(ccw, [Some(7_000), Some(7_000), None], centre([0, 7_000])),
        ];
        by_centre.into_iter().chain(by_radius).flatten().chain(further).collect()
    }

    fn rules() -> Vec<ArcRule> {
        let of = |tolerance: Nanos, short: Nanos, least: Nanos| ArcRule {
            tolerance: Some([tolerance; 2]),
            short: [short; 2],
            least,
            ..ArcRule::UNTESTED
        };
        vec![
            ArcRule::UNTESTED,
            ArcRule::default(),
            of(ONE / 100, 0, 1000),
            of(ONE / 100, ONE / 200, 1000),
            of(ONE, ONE / 50, 4 * ONE),
            ArcRule { relative: ONE / 1000, of_larger: true, limit: 3, ..of(ONE / 100, ONE / 10, 0) },
        ]
    }

    /// A control with this rule that stands at X0 Y0.
    fn control(rule: ArcRule) -> Exec {
        let world = World { arcs: rule, ..World::generate(1, &Modes::default()) };
        let mut exec = Exec::new(&world, 0);
        let start = [
            Op::SetDistanceMode(Distance::Absolute),
            Op::SetSpindleSpeed(Expr::int(500)),
            Op::StartSpindleClockwise,
            Op::SetFeedRate(Expr::int(100)),
            Op::StraightTraverse(to([Some(0), Some(0), Some(50_000)])),
        ];
        for op in start {
            exec.step(&stmt(op), &mut Vec::new()).expect("a plain program");
        }
        exec
    }

    fn events(exec: &mut Exec, stmts: &[Stmt]) -> Option<Vec<Event>> {
        let mut events = Vec::new();
        stmts.iter().try_for_each(|stmt| exec.step(stmt, &mut events)).ok().map(|()| events)
    }

    /// Where one execution is said to stand for both, two executions make the same events, and the controls agree after
    /// them. That is so with most arcs of two rules, and not with those of which one rule says something else.
    #[test]
    fn arcs_that_pass_are_the_same_events() {
        let line = |x: i64| stmt(Op::StraightFeed(to([Some(x), Some(1_000), None])));
        let (mut alike, mut differ) = (0, 0);
        for (own, others) in
            rules().iter().flat_map(|own| rules().into_iter().map(move |other| (*own, other)))
        {
            for arc in arcs() {
                let (mut one, mut other) = (control(own), control(others));
                assert!(one.makes_arcs_of(&other));
                let said = [arc, stmt(Op::Blank), line(3_000)];
                assert!(are_arcs(&said));
                let mut passed = one.clone();
                let counted = passed.pass_arcs(&said, &other);
                let what = format!("{own:?} and {others:?}: {:?}", said[0]);
                let [a, b] = [&mut one, &mut other].map(|exec| events(exec, &said));
                let Ok(Some(counted)) = counted else {
                    assert!(a.is_none() || a != b, "{what}");
                    differ += 1;
                    continue;
                };
                alike += 1;
                assert_eq!(a, b, "{what}");
                assert_eq!(Some(counted), a.map(|events| events.len() as u64), "{what}");
                assert!(one.makes_arcs_of(&other), "{what}");
                passed.counted = one.counted;
                assert_eq!(format!("{passed:?}"), format!("{one:?}"), "{what}");
            }
        }
        assert!(alike > 500 && differ > 100, "{alike} {differ}");
    }

    #[test]
    fn what_is_no_plain_arc_is_executed() {
        let half = || arc(Turn::Clockwise, [Some(10_000), Some(0), None], centre([5_000, 0]));
        assert!(are_arcs(&[half()]) && !are_arcs(&[stmt(Op::Blank)]) && !are_arcs(&[]));
        assert!(!are_arcs(&[half(), stmt(Op::ProgramStop)]));
        for axis in [0, 3] {
            let Op::ArcFeed(mut arc) = half().op else { panic!("an arc") };
            let distance = Fact::Known(if axis == 0 { Distance::Incremental } else { Distance::Absolute });
            arc.to.axes[axis] = Some(Coord { value: mm(1_000), distance });
            assert!(!are_arcs(&[stmt(Op::ArcFeed(arc))]), "{axis}");
        }
        let mut exec = control(ArcRule::default());
        assert!(exec.takes_arcs());
        for op in [Op::SetDistanceMode(Distance::Incremental), Op::StopSpindleTurning] {
            let mut other = exec.clone();
            other.step(&stmt(op), &mut Vec::new()).expect("a mode");
            assert!(!other.takes_arcs() && !exec.makes_arcs_of(&other));
        }
        exec.step(&stmt(Op::SetFeedRate(Expr::int(200))), &mut Vec::new()).expect("a feed");
        assert!(!exec.makes_arcs_of(&control(ArcRule::default())));
    }
}
