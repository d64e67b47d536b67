//! Lines whose time each control counts by words of its own: with rotary axes, or under inverse time.
//!
//! ```text
//! source: G94 G1 X10. A90. F100. | output: G93 G1 X10 A90 F1.104    one end point, reached in one time
//! ```
//!
//! Both controls execute their statements, for the effect on their own states. Instead of their events, what these are
//! made of is compared ([`PacedMove`]): whether a move is rapid, where it ends in the machine, its feed, and what that counts.
//!
//! Why that proves as much: the event of a line is made of these, of the active unit, and of the state
//! ([`Exec::emit_move`]). Lines change position, feed and feed mode, and nothing else of the state, where
//! [`Exec::takes_paced`] holds. So two controls that agree in all but feed and feed mode before them ([`Exec::paces_as`]) do
//! so after each move that ends at one place, and all that may differ between two events is compared. How far an
//! axis turns, and how F counts, each control computes by its own rules, in the code that also makes the event.
//!
//! Not here: incremental words, arcs, and directions of rotary axes that a word states. They are left to [`Exec::step`].

use crate::{Event, Exec, Kind, State, by_control};
use ncc_ir::canon::{AXES, Distance, FeedMode, Motion, Spindle, same_point};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::{Op, Point, Stmt};
use ncc_ir::source::Span;

/// A line, a feed, a feed mode or a remark.
#[derive(Clone, Copy, Debug)]
struct Line {
    /// Its level of block skip as a bit; 0 is none.
    level: u16,
    does: Does,
    /// Values of the axes that are named, nanos; the first one is that of a feed.
    values: [Nanos; AXES],
    span: Span,
}

#[derive(Clone, Copy, Debug)]
enum Does {
    /// Goes along a line at feed, or rapidly: the axes that are named, a bit each.
    Goes(u8, Motion),
    /// The same by the active motion.
    GoesOn(u8),
    Feeds,
    Counts(FeedMode),
    Nothing,
}

/// Lines with the values of their words.
#[derive(Clone, Debug)]
pub struct PacedLines {
    lines: Vec<Line>,
    /// The unit in which they were computed.
    inch: bool,
}

impl PacedLines {
    /// Whether they were computed in inches.
    pub fn inch(&self) -> bool {
        self.inch
    }
}

/// A straight move that makes an event.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PacedMove {
    /// Whether it goes at feed.
    pub(crate) feed: bool,
    /// Where it ends, machine coordinates in nanos.
    pub(crate) end: [Nanos; AXES],
    /// As of [`Event::rate`].
    pub(crate) rate: Nanos,
    /// What the rate counts; under a rapid move, what a feed counts.
    pub(crate) mode: FeedMode,
    /// Whether the rate is a time because the control counts F in a way of its own.
    pub(crate) timed: bool,
    span: Span,
}

/// Whether a statement turns a rotary axis along a line.
fn turns(stmt: &Stmt) -> bool {
    let (Op::StraightFeed(m) | Op::StraightTraverse(m) | Op::Position(m)) = &stmt.op else { return false };
    Exec::turns(&m.to)
}

impl Exec {
    /// Whether a line by absolute words changes no more than where the axes stand, and uses up a time.
    pub(crate) fn takes_paced(&self) -> bool {
        self.takes_timed_lines() && !self.standing.at_zero
    }

    /// Whether lines that make the same moves here and on another control are the same events, and leave both in states of
    /// which that is so again.
    pub fn paces_as(&self, other: &Exec) -> bool {
        self.takes_paced() && other.takes_paced() && self.agrees_beside_feed(other)
    }

    /// The values of lines for this control, and for all that have the same active unit; `None` where statements are
    /// anything but lines by words from zero, feeds and feed modes, or where none of them turns a rotary axis.
    pub fn value_paced(&self, stmts: &[Stmt]) -> Option<PacedLines> {
        if !stmts.iter().any(turns) || !self.takes_paced() {
            return None;
        }
        let mut lines = Vec::with_capacity(stmts.len());
        for stmt in stmts {
            lines.push(self.value_paced_line(stmt)?);
        }
        Some(PacedLines { lines, inch: self.modes.inch })
    }

    fn value_paced_line(&self, stmt: &Stmt) -> Option<Line> {
        let mut values = [0; AXES];
        let does = match &stmt.op {
            Op::StraightFeed(m) => Does::Goes(self.value_point(&m.to, &mut values)?, Motion::Feed),
            Op::StraightTraverse(m) => Does::Goes(self.value_point(&m.to, &mut values)?, Motion::Traverse),
            Op::Position(m) => Does::GoesOn(self.value_point(&m.to, &mut values)?),
            Op::SetFeedRate(feed) => {
                values[0] = self.plain_value(feed)?;
                Does::Feeds
            }
            Op::SetFeedMode(mode) => Does::Counts(*mode),
            Op::Comment(_) | Op::Blank => Does::Nothing,
            _ => return None,
        };
        let level = match stmt.skip {
            Some(level) => 1u16.checked_shl(level.into())?,
            None => 0,
        };
        Some(Line { level, does, values, span: stmt.span })
    }

    /// Values of the words of a point; gives the axes that have one, a bit each.
    fn value_point(&self, to: &Point, values: &mut [Nanos; AXES]) -> Option<u8> {
        let mut named = 0;
        for (axis, word) in to.axes.iter().enumerate() {
            let Some(word) = word else { continue };
            if word.distance.or(Distance::Absolute) != Distance::Absolute {
                return None;
            }
            values[axis] = self.plain_value(&word.value)?;
            named |= 1 << axis;
        }
        Some(named)
    }

    /// Executes lines for their effect on the state; gives their moves. `None` is a fault, or more than lines do: the
    /// control is then in no state to go on from.
    pub fn pass_paced(&mut self, paced: &PacedLines) -> Option<Vec<PacedMove>> {
        if !self.takes_paced() || self.modes.inch != paced.inch {
            return None;
        }
        let mut moves = Vec::with_capacity(paced.lines.len());
        let mut named_all = 0;
        for Line { level, does, values, span } in &paced.lines {
            if self.skip & level != 0 {
                continue;
            }
            self.shown.goes_on();
            let (named, motion) = match does {
                Does::Goes(named, motion) => (*named, *motion),
                Does::GoesOn(named) => (*named, self.modes.motion),
                Does::Feeds => {
                    (self.feed, self.feed_inch) = (values[0], Some(paced.inch));
                    continue;
                }
                Does::Counts(mode) => {
                    self.set_feed_mode(*mode);
                    continue;
                }
                Does::Nothing => continue,
            };
            let feed = match motion {
                Motion::Feed => true,
                Motion::Traverse => false,
                Motion::Arc(_) | Motion::Cycle => return None,
            };
            if feed && self.feed == 0 {
                return None;
            }
            let mut next = self.position;
            for axis in 0..AXES {
                if named >> axis & 1 == 1 {
                    next[axis] = if axis < 3 { values[axis] } else { self.turned(axis, values[axis]) };
                }
            }
            named_all |= u32::from(named);
            let end = self.go_plainly(&next, named.into(), feed);
            if same_point(&end, &self.last) {
                continue;
            }
            let mode = self.state.feed_mode;
            let (rate, mode, timed) = match feed.then(|| self.pace_of_line(&end)) {
                None => (0, mode, false),
                Some(None) => (self.feed, mode, false),
                Some(Some(pace)) => (pace, FeedMode::InverseTime, true),
            };
            self.last = end;
            moves.push(PacedMove { feed, end, rate, mode, timed, span: *span });
            if feed && self.state.feed_mode == FeedMode::InverseTime {
                // The time of one move says nothing of the next.
                self.feed = 0;
            }
        }
        self.carries_no_more(named_all);
        Some(moves)
    }

    /// The events of moves that this control has made last.
    pub fn events_of<'m>(&self, moves: &'m [PacedMove]) -> impl Iterator<Item = Event> + use<'m> {
        let (state, inch) = (self.state, self.modes.inch);
        moves.iter().map(move |PacedMove { feed, end, rate, mode, timed, span }| {
            let timed = if *timed { by_control::TIMED } else { 0 };
            let state = State { feed_mode: *mode, by_control: state.by_control | timed, ..state };
            let kind = if *feed { Kind::Feed } else { Kind::Traverse };
            Event { kind, end: *end, rate: *rate, state, inch, span: *span }
        })
    }

    /// Whether a line by absolute words makes no more than its event, and leaves nothing but a time used up.
    pub(crate) fn takes_timed_lines(&self) -> bool {
        !(self.ended || self.narrating || self.every_move || self.speed_watched)
            && self.state.spindle != Spindle::Stopped
            && self.goes_plainly()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::moves::sketch::{mm, stmt, word};
    use crate::verify::{Comparison, Resolution};
    use crate::world::World;
    use ncc_ir::behaviour::Behaviour;
    use ncc_ir::canon::{Fact, Modes};
    use ncc_ir::expr::Expr;
    use ncc_ir::expr::num::{Num, Unit};
    use ncc_ir::program::{Coord, Move};

    const RESOLUTION: Resolution =
        Resolution { mm: 3, inch: 4, degree: 3, feed: 3, feed_inch: 4, second: 3, speed: 0 };

    fn to(words: [Option<i64>; AXES]) -> Move {
        let mut axes: [Option<Coord>; AXES] = Default::default();
        for (axis, value) in words.into_iter().enumerate() {
            let degrees = |mantissa| Num { mantissa, scale: 3, point: true, unit: Unit::Degree };
            axes[axis] = value.map(|value| match axis < 3 {
                true => word(value),
                false => {
                    Coord { value: Expr::Num(degrees(value)), distance: Fact::Known(Distance::Absolute) }
                }
            });
        }
        Move { to: Point { axes }, said: true }
    }

    /// Numbers from a simple generator.
    fn numbers(mut seed: u64) -> impl FnMut(u64) -> u64 {
        move |below| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) % below
        }
    }

    /// Lines of all kinds, some under levels of block skip; the first one turns.
    fn lines(seed: u64) -> Vec<Stmt> {
        let mut next = numbers(seed);
        let first = stmt(Op::StraightTraverse(to([None, None, None, Some(20_000), None, None])));
        let mut line = |_| {
            let skip = [None, None, None, Some(1), Some(2)][next(5) as usize];
            let words = std::array::from_fn(|axis| {
                let many = if axis < 3 { 1_500 } else { 100_000 };
                (next(3) == 0).then(|| next(5) as i64 * many - many)
            });
            let feed = Op::SetFeedRate(mm(next(40) as i64 * 50_000 + 50_000));
            let ops = match next(10) {
                0..4 => vec![feed, Op::StraightFeed(to(words))],
                4 => vec![Op::StraightTraverse(to(words))],
                5 => vec![feed, Op::Position(to(words))],
                6 => vec![Op::Comment("a remark".into())],
                7 => vec![Op::StraightFeed(to(words))],
                8 => vec![Op::SetFeedMode(FeedMode::InverseTime), feed, Op::StraightFeed(to(words))],
                _ => vec![Op::SetFeedMode(FeedMode::PerMinute), feed, Op::StraightFeed(to(words))],
            };
            ops.into_iter().map(|op| Stmt { skip, ..stmt(op) }).collect::<Vec<Stmt>>()
        };
        std::iter::once(first).chain((0..10).flat_map(&mut line)).collect()
    }

    fn control(skip: u16, facts: &[(Behaviour, u8)], start: &[Op]) -> Exec {
        let mut exec = Exec::new(&World::generate(2, &Modes::default()), skip);
        facts.iter().for_each(|(behaviour, value)| exec.behave(*behaviour, *value));
        let turns = [
            Op::SetDistanceMode(Distance::Absolute),
            Op::SetSpindleSpeed(Expr::int(500)),
            Op::StartSpindleClockwise,
            Op::SetFeedMode(FeedMode::PerMinute),
            Op::SetFeedRate(mm(100_000)),
            Op::StraightTraverse(to([Some(0), Some(0), Some(0), None, None, None])),
        ];
        for op in turns.iter().chain(start) {
            exec.step(&stmt(op.clone()), &mut Vec::new()).expect("a plain program");
        }
        exec
    }

    /// Values of what a feed counts with rotary axes, and of how these turn.
    fn facts() -> impl Iterator<Item = [(Behaviour, u8); 2]> {
        (0..9).map(|n| [(Behaviour::RotaryFeed, n % 3), (Behaviour::RotaryTurn, n / 3)])
    }

    /// Executed by values, lines make the events that they make one by one, and leave the same state.
    #[test]
    fn paced_lines_do_what_steps_do() {
        let starts: [&[Op]; 4] = [
            &[],
            &[Op::SetOriginOffsets(2)],
            &[Op::StraightFeed(to([Some(1_500), None, None, Some(50_000), Some(10_000), None]))],
            &[Op::SetFeedMode(FeedMode::PerRevolution), Op::SetFeedRate(mm(200))],
        ];
        let (mut executed, mut left, mut timed) = (0, 0, 0);
        for (start, facts) in starts.iter().flat_map(|start| facts().map(move |facts| (*start, facts))) {
            for (seed, skip) in (0..60).flat_map(|seed| [0, 1 << 1, 1 << 2].map(|skip| (seed, skip))) {
                let lines = lines(seed);
                let mut by_values = control(skip, &facts, start);
                let mut by_steps = by_values.clone();
                let valued = control(0, &facts, start).value_paced(&lines).expect("lines");
                let mut events = Vec::new();
                let stepped = lines.iter().try_for_each(|stmt| by_steps.step(stmt, &mut events));
                let Some(moves) = by_values.pass_paced(&valued) else {
                    left += 1;
                    continue;
                };
                stepped.expect("no fault");
                timed += moves.iter().filter(|paced| paced.timed).count();
                let own: Vec<Event> = by_values.events_of(&moves).collect();
                assert_eq!(own, events, "{lines:?}");
                assert_eq!(format!("{by_values:?}"), format!("{by_steps:?}"), "{lines:?}");
                executed += 1;
            }
        }
        assert!(executed > 3_000 && left > 100 && timed > 1_000, "{executed} {left} {timed}");
    }

    /// A control asks what F counts with rotary axes only where it was known before that lines reach that.
    #[test]
    fn lines_come_to_what_they_ask() {
        let bit = Behaviour::RotaryFeed.bit();
        let (mut asked, mut never) = (0, 0);
        for (seed, facts) in (0..400).flat_map(|seed| facts().map(move |facts| (seed, facts))) {
            let position = |stmt: &Stmt| matches!(stmt.op, Op::Position(_));
            let mut lines: Vec<Stmt> = lines(seed).into_iter().take(seed as usize % 6 + 1).collect();
            lines.retain(|stmt| !position(stmt));
            for start in [20_000, 120_000, -100_000] {
                let begin = Op::StraightTraverse(to([None, None, None, Some(start), None, Some(-10_000)]));
                let mut exec = control(0, &facts, &[begin]);
                exec.ask_anew();
                let comes = exec.comes_to(&lines) & bit != 0;
                let _ = lines.iter().try_for_each(|stmt| exec.step(stmt, &mut Vec::new()));
                assert!(comes || exec.asked() & bit == 0, "{facts:?} {lines:?}");
                asked += u32::from(exec.asked() & bit != 0);
                let turning = |stmt: &Stmt| matches!(stmt.op, Op::StraightFeed(_)) && turns(stmt);
                never += u32::from(!comes && lines.iter().any(turning));
            }
        }
        assert!(asked > 1_000 && never > 100, "{asked} {never}");
    }

    /// Whether two programs are said to be the same by their moves, and are by their events; `None` where one of them is
    /// left to steps.
    fn same(facts: [&[(Behaviour, u8)]; 2], programs: [&[Stmt]; 2]) -> Option<[bool; 2]> {
        let [own, other] = facts.map(|facts| control(0, facts, &[]));
        assert!(own.paces_as(&other) && other.paces_as(&own));
        let comparison = Comparison::new(RESOLUTION, own.last);
        let mut moves = Vec::new();
        let mut events = [Vec::new(), Vec::new()];
        let mut behind = Vec::new();
        for (side, (exec, lines)) in [own, other].iter().zip(programs).enumerate() {
            let mut passed = exec.clone();
            moves.push(passed.pass_paced(&exec.value_paced(lines)?)?);
            behind.push(passed);
            let mut stepped = exec.clone();
            lines.iter().try_for_each(|stmt| stepped.step(stmt, &mut events[side])).ok()?;
        }
        let by_moves = comparison.same_paced(&moves[0], &moves[1], false);
        assert!(!by_moves || behind[0].paces_as(&behind[1]), "they agree again");
        let [mut a, mut b] = events;
        Some([by_moves, comparison.clone().advance(&mut a, &mut b, true).is_ok()])
    }

    /// What is the same by moves is the same by events, whatever is changed in a line and whatever facts controls have.
    #[test]
    fn moves_that_pass_are_the_same_events() {
        let (mut alike, mut differ) = (0, 0);
        for seed in 0..60 {
            let lines = lines(seed);
            for (own, there) in facts().flat_map(|own| facts().map(move |there| (own, there))) {
                let Some([by_moves, by_events]) = same([&own, &there], [&lines; 2]) else { continue };
                assert_eq!(by_moves, by_events, "{own:?} {there:?} {lines:?}");
                (alike, differ) = (alike + u32::from(by_moves), differ + u32::from(!by_moves));
            }
            let own = [(Behaviour::RotaryFeed, 0), (Behaviour::RotaryTurn, 0)];
            for at in 1..lines.len() {
                let mut changed = lines.clone();
                let more = |value: &mut Expr| {
                    if let Expr::Num(number) = value {
                        number.mantissa += 1_000;
                    }
                };
                match &mut changed[at].op {
                    Op::StraightFeed(m) | Op::StraightTraverse(m) | Op::Position(m) => {
                        m.to.axes.iter_mut().flatten().for_each(|word| more(&mut word.value));
                    }
                    Op::SetFeedRate(feed) => more(feed),
                    _ => {
                        changed.remove(at);
                    }
                }
                let Some([by_moves, by_events]) = same([&own; 2], [&lines, &changed]) else { continue };
                assert!(!by_moves || by_events, "{lines:?} {changed:?}");
                differ += u32::from(!by_moves);
            }
        }
        assert!(alike > 200 && differ > 500, "{alike} {differ}");
    }

    #[test]
    fn what_is_no_paced_line_is_left() {
        let exec = control(0, &[], &[]);
        let turning = || stmt(Op::StraightFeed(to([Some(1_000), None, None, Some(1_000), None, None])));
        assert!(exec.value_paced(&[turning()]).is_some());
        let straight = stmt(Op::StraightFeed(to([Some(1_000), None, None, None, None, None])));
        assert!(exec.value_paced(std::slice::from_ref(&straight)).is_none(), "others execute that");
        let Op::StraightFeed(mut incremental) = turning().op else { panic!("a move") };
        let Some(word) = &mut incremental.to.axes[3] else { panic!("a word") };
        word.distance = Fact::Known(Distance::Incremental);
        for op in [Op::StraightFeed(incremental), Op::ProgramStop] {
            assert!(exec.value_paced(&[turning(), stmt(op)]).is_none());
        }
        let valued = exec.value_paced(&[turning()]).expect("a line");
        for op in [Op::SetDistanceMode(Distance::Incremental), Op::StopSpindleTurning, Op::SetFeedRate(mm(0))]
        {
            assert_eq!(control(0, &[], &[op]).pass_paced(&valued), None);
        }
        for op in [Op::SetOriginOffsets(6), Op::SetSpindleSpeed(Expr::int(501)), Op::FloodOn] {
            let other = control(0, &[], std::slice::from_ref(&op));
            assert!(!exec.paces_as(&other), "{op:?}");
        }
        let faster = control(0, &[], &[Op::SetFeedMode(FeedMode::InverseTime), Op::SetFeedRate(mm(7_000))]);
        assert!(exec.paces_as(&faster));
    }
}
