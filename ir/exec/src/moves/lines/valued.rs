//! Lines whose words have their values already: computed once, for all controls that execute them.
//!
//! ```text
//! X10. F200.    under 64 settings of the block-skip switches in two worlds: two values, not 256
//! ```
//!
//! A value hangs on the word and on the active unit alone (`Exec::plain_value`). Anything that is not so plain, and each
//! fault, is left to [`Exec::pass`]: nothing is done then.

use crate::{Exec, Heading, MOTION, Z};
use ncc_ir::canon::{AXES, Distance, FeedMode, Motion, same_point};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::rows::Rows;
use ncc_ir::program::{Op, Stmt};

/// A line, a feed, or a remark.
#[derive(Clone, Copy, Debug)]
struct Valued {
    /// Its level of block skip as a bit; 0 is none.
    level: u16,
    does: Does,
    /// Values of X, Y and Z that are named; the first one is that of a feed.
    values: [Nanos; 3],
}

#[derive(Clone, Copy, Debug)]
enum Does {
    /// Goes along a line at feed, or rapidly: the axes that are named, a bit each.
    Goes(u8, Motion),
    /// The same by the active motion.
    GoesOn(u8),
    Feeds,
    Nothing,
}

/// Lines with the values of their words.
#[derive(Clone, Debug)]
pub struct ValuedLines {
    lines: Vec<Valued>,
    /// The unit in which they were computed.
    inch: bool,
    /// How controls have gone along them.
    courses: Vec<Course>,
}

/// All that a course depends on besides its lines, where the machine stands where the program does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Start {
    /// Block-skip switches, bit n is level n.
    skip: u16,
    /// Position in the program.
    pub(super) at: [Nanos; AXES],
    pub(super) motion: Motion,
    pub(super) feed: Nanos,
    /// Whether each cut uses its feed up.
    by_time: bool,
    /// Whether the machine stands there.
    stands: bool,
}

/// How lines go, in coordinates of the program.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    pub(super) start: Start,
    pub(super) at: [Nanos; AXES],
    /// From where the last move went.
    pub(super) heading: Option<[Nanos; AXES]>,
    pub(super) motion: Motion,
    pub(super) feed: Nanos,
    pub(super) feed_said: bool,
    pub(super) moved: bool,
    pub(super) events: u64,
    /// Axes that are named, a bit each.
    pub(super) named: u32,
    /// Statements that are not skipped.
    pub(super) executed: u32,
}

/// A straight move that makes an event: of a line, or of a hole.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    /// Whether it goes at feed.
    pub(crate) feed: bool,
    /// Where it ends in the program.
    pub(crate) to: [Nanos; AXES],
}

impl ValuedLines {
    /// Whether these lines are these strokes, on a control from where it stands; not if any of them is under block skip, or says
    /// a feed.
    pub(crate) fn go_along(&self, exec: &Exec, strokes: &[Stroke]) -> bool {
        let (mut at, mut motion) = (exec.position, exec.modes.motion);
        let mut strokes = strokes.iter();
        let mut along = |Valued { level, does, values }: &Valued| {
            let named = match does {
                Does::Goes(named, own) => {
                    motion = *own;
                    *named
                }
                Does::GoesOn(named) => *named,
                Does::Feeds => return false,
                Does::Nothing => return true,
            };
            let mut to = at;
            for (axis, value) in values.iter().enumerate() {
                if named >> axis & 1 == 1 {
                    to[axis] = *value;
                }
            }
            let feed = match motion {
                Motion::Feed => true,
                Motion::Traverse => false,
                Motion::Arc(_) | Motion::Cycle => return false,
            };
            let goes = !same_point(&to, &at);
            at = to;
            *level == 0 && (!goes || strokes.next() == Some(&Stroke { feed, to }))
        };
        exec.modes.inch == self.inch && self.lines.iter().all(&mut along) && strokes.next().is_none()
    }
}

impl Exec {
    /// The values of lines for this control, and for all that have the same active unit; `None` where statements are
    /// anything but plain lines by words from zero, or this control would not take them so.
    pub fn value_lines(&self, stmts: &[Stmt]) -> Option<ValuedLines> {
        if !self.takes_timed_lines() {
            return None;
        }
        let lines = stmts.iter().map(|stmt| self.value_line(stmt)).collect::<Option<Vec<Valued>>>()?;
        Some(ValuedLines { lines, inch: self.modes.inch, courses: Vec::new() })
    }

    /// The same of rows of a table.
    pub fn value_rows(&self, rows: Rows) -> Option<ValuedLines> {
        if !self.takes_lines() {
            return None;
        }
        let mut lines = Vec::with_capacity(rows.len() + rows.len() / 8);
        for (row, feed) in rows.each() {
            if let Some((feed, _)) = feed {
                let values = [self.plain_number(*feed)?, 0, 0];
                lines.push(Valued { level: 0, does: Does::Feeds, values });
            }
            let mut values = [0; 3];
            for (axis, value) in values.iter_mut().enumerate() {
                if let Some(num) = row.word(axis, rows.unit) {
                    *value = self.plain_number(num)?;
                }
            }
            lines.push(Valued { level: 0, does: Does::Goes(row.axes(), row.motion()), values });
        }
        Some(ValuedLines { lines, inch: self.modes.inch, courses: Vec::new() })
    }

    fn value_line(&self, stmt: &Stmt) -> Option<Valued> {
        let mut values = [0; 3];
        let (to, motion) = match &stmt.op {
            Op::StraightFeed(to) => (Some(to), Some(Motion::Feed)),
            Op::StraightTraverse(to) => (Some(to), Some(Motion::Traverse)),
            Op::Position(to) => (Some(to), None),
            Op::SetFeedRate(feed) => {
                values[0] = self.plain_value(feed)?;
                (None, Some(Motion::Feed))
            }
            Op::Comment(_) | Op::Blank => (None, None),
            _ => return None,
        };
        let mut named = 0;
        if let Some(to) = to {
            if Exec::turns(&to.to) {
                return None;
            }
            for (axis, word) in to.to.axes[..3].iter().enumerate() {
                let Some(word) = word else { continue };
                if word.distance.or(Distance::Absolute) != Distance::Absolute {
                    return None;
                }
                values[axis] = self.plain_value(&word.value)?;
                named |= 1 << axis;
            }
        }
        let does = match (to, motion) {
            (Some(_), Some(motion)) => Does::Goes(named, motion),
            (Some(_), None) => Does::GoesOn(named),
            (None, Some(_)) => Does::Feeds,
            (None, None) => Does::Nothing,
        };
        let level = match stmt.skip {
            Some(level) => 1u16.checked_shl(level.into())?,
            None => 0,
        };
        Some(Valued { level, does, values })
    }

    /// Executes lines for their effect on the state alone, as [`Exec::pass`] does; gives the number of their events.
    /// `None`, and nothing done, where that is not plain to see.
    ///
    /// Controls that stand at the same place of the program go the same course, whatever frames they have.
    pub fn pass_valued(&mut self, valued: &mut ValuedLines) -> Option<u64> {
        if !self.takes_timed_lines() || self.modes.inch != valued.inch {
            return None;
        }
        let start = self.start_of_course();
        // Two places may be one on the machine where a frame turns or scales them.
        let apart = self.chain.as_ref().is_none_or(|chain| chain.turn().is_none());
        let same = |course: &&Course| apart && start.stands && course.start == start;
        let course = match valued.courses.iter().find(same) {
            Some(course) => *course,
            None if apart => {
                let course = self.course::<true>(&valued.lines, start)?;
                valued.courses.push(course);
                course
            }
            None => self.course::<false>(&valued.lines, start)?,
        };
        Some(self.take_course(&course, valued.inch))
    }

    /// Executes rows of a table, of which these are the values, for their effect on the state alone; gives the number of
    /// their events.
    ///
    /// # Errors
    /// Those of [`Exec::pass`].
    pub fn pass_rows(&mut self, rows: Rows, valued: &mut ValuedLines) -> Result<u64, Diagnostic> {
        if let Some(events) = self.pass_valued(valued) {
            return Ok(events);
        }
        let mut stmts = Vec::new();
        rows.unpack(&mut stmts);
        self.pass(&stmts)
    }

    /// Whether two controls make the same events of rows of a table, which count from zero and which no level of block skip
    /// leaves out: one execution counts for both then.
    pub fn agrees_on_rows(&self, other: &Exec) -> bool {
        self.counts_absolute()
            && other.counts_absolute()
            && self.agrees_on_lines(other)
            && !other.carries_linear()
    }

    pub(super) fn start_of_course(&self) -> Start {
        Start {
            skip: self.skip,
            at: self.position,
            motion: self.modes.motion,
            feed: self.feed,
            by_time: self.state.feed_mode == FeedMode::InverseTime,
            stands: self.machine() == self.last,
        }
    }

    /// How lines go from here; `None` where one of them is a fault or no straight line. `APART`: whether two places of the
    /// program are two on the machine.
    fn course<const APART: bool>(&self, lines: &[Valued], start: Start) -> Option<Course> {
        let Start { by_time, mut motion, mut feed, mut stands, .. } = start;
        // Rotary axes stay where they are.
        let [mut x, mut y, mut z, a, b, c] = start.at;
        let (mut from, mut feed_said, mut moved, mut last) = (None, false, false, self.last);
        let (mut events, mut named_all, mut executed) = (0, 0, 0);
        for Valued { level, does, values } in lines {
            if start.skip & level != 0 {
                continue;
            }
            executed += 1;
            let named = match does {
                Does::Goes(named, own) => {
                    motion = *own;
                    *named
                }
                Does::GoesOn(named) => *named,
                Does::Feeds => {
                    (feed, feed_said) = (values[0], true);
                    continue;
                }
                Does::Nothing => continue,
            };
            match motion {
                Motion::Feed if feed != 0 => {}
                Motion::Traverse => {}
                Motion::Feed | Motion::Arc(_) | Motion::Cycle => return None,
            }
            let to = |axis: usize, at: Nanos| if named >> axis & 1 == 1 { values[axis] } else { at };
            let next = [to(0, x), to(1, y), to(2, z)];
            let other = (next[0] ^ x) | (next[1] ^ y) | (next[2] ^ z) != 0;
            if other {
                from = Some([x, y, z]);
                [x, y, z] = next;
            }
            let goes = if APART && stands {
                other
            } else {
                let before = last;
                if other || !stands {
                    last = self.place(&[x, y, z, a, b, c]);
                }
                last != before
            };
            events += u64::from(goes);
            // After the first move the machine stands where the program does.
            (stands, moved) = (true, true);
            named_all |= named;
            if by_time && goes && motion == Motion::Feed {
                // The time of one move says nothing of the next.
                feed = 0;
            }
        }
        let heading = from.map(|[x, y, z]| [x, y, z, a, b, c]);
        let (at, named) = ([x, y, z, a, b, c], u32::from(named_all));
        Some(Course { start, at, heading, motion, feed, feed_said, moved, events, named, executed })
    }

    pub(super) fn take_course(&mut self, course: &Course, inch: bool) -> u64 {
        // What a statement does to messages, it does no more after the second one.
        (0..course.executed.min(2)).for_each(|_| self.shown.goes_on());
        self.feed = course.feed;
        if course.feed_said {
            self.feed_inch = Some(inch);
        }
        if course.moved {
            self.position = course.at;
            if let Some(from) = course.heading {
                self.heading = Heading::From(from);
            }
            self.modes.motion = course.motion;
            self.said |= MOTION;
            self.relies_on_slots(course.named);
            self.at_place &= course.named >> Z & 1 == 0;
            self.last = self.machine();
        }
        course.events
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::World;
    use ncc_ir::canon::{Fact, Modes, Plane, Units};
    use ncc_ir::expr::Expr;
    use ncc_ir::expr::num::{Num, Unit};
    use ncc_ir::program::{Coord, Frame, FrameStep, Move, Point, Slot};
    use ncc_ir::source::Span;

    fn entry(mantissa: i64) -> Expr {
        Expr::Num(Num { mantissa, scale: 3, point: true, unit: Unit::Entry })
    }

    fn to(words: [Option<i64>; 3]) -> Move {
        let mut axes: [Option<Coord>; AXES] = Default::default();
        for (axis, value) in axes.iter_mut().zip(words) {
            *axis = value.map(|value| Coord { value: entry(value), distance: Fact::Entry });
        }
        Move { to: Point { axes }, said: true }
    }

    fn turned(degrees: i64) -> Op {
        let angle = Coord { value: Expr::int(degrees), distance: Fact::Known(Distance::Absolute) };
        let centre = Box::new([Some(Expr::int(1)), Some(Expr::int(2)), None]);
        Op::SetSlot(Box::new(Slot::Rotation { plane: Fact::Known(Plane::Xy), centre, angle }))
    }

    /// By such factors that 0 and 1.5 mm are one place on the machine, and 3 mm is another.
    fn scaled() -> [Op; 2] {
        [(1, 9), (25, 2)].map(|(mantissa, scale)| {
            let factor = Expr::Num(Num { mantissa, scale, point: true, unit: Unit::One });
            let step = FrameStep::Scale(Box::new([0; 3].map(|_| Some(factor.clone()))));
            Op::SetFrame(Box::new(Frame { added: true, step }))
        })
    }

    fn stmt(skip: Option<u8>, op: Op) -> Stmt {
        Stmt { skip, ..Stmt::new(Span::default(), op) }
    }

    /// Lines of all kinds, some under levels of block skip, by numbers from a simple generator.
    fn lines(mut seed: u64) -> Vec<Stmt> {
        let mut next = move |below: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) % below
        };
        let mut line = |_| {
            let skip = [None, None, Some(1), Some(2), Some(10)][next(5) as usize];
            let words = [0; 3].map(|_| (next(2) == 0).then(|| next(3) as i64 * 1_500));
            let op = match next(7) {
                0 | 1 => Op::StraightFeed(to(words)),
                2 => Op::StraightTraverse(to(words)),
                3 => Op::SetFeedRate(entry(next(4) as i64 * 50_000)),
                4 => Op::Comment("a remark".into()),
                _ => Op::Position(to(words)),
            };
            stmt(skip, op)
        };
        (0..12).map(&mut line).collect()
    }

    fn control(skip: u16, start: &[Op]) -> Exec {
        control_in(2, skip, start)
    }

    fn control_in(world: u32, skip: u16, start: &[Op]) -> Exec {
        let mut exec = Exec::new(&World::generate(world, &Modes::default()), skip);
        let turns = [
            Op::SetDistanceMode(Distance::Absolute),
            Op::StartSpindleClockwise,
            Op::SetFeedRate(entry(100_000)),
            Op::StraightTraverse(to([Some(0); 3])),
        ];
        for op in turns.iter().chain(start) {
            exec.step(&stmt(None, op.clone()), &mut Vec::new()).expect("a plain program");
        }
        exec
    }

    /// One control works the values out, others execute them: in the same state as where each executes the words, and
    /// with as many events.
    #[test]
    fn valued_lines_do_what_their_words_do() {
        let scaled = scaled();
        let starts: [&[Op]; 7] = [
            &[],
            &[Op::UseLengthUnits(Units::Inch), Op::SetFeedRate(entry(9_000))],
            &[Op::StraightFeed(to([Some(1_500), None, Some(3_000)]))],
            &[Op::SetOriginOffsets(2)],
            &[Op::SetFeedMode(ncc_ir::canon::FeedMode::PerRevolution)],
            &[turned(30), Op::StraightFeed(to([Some(1_500), None, Some(3_000)]))],
            &scaled,
        ];
        let (mut executed, mut left) = (0, 0);
        for (start, seed) in starts.iter().flat_map(|start| (0..200).map(move |seed| (*start, seed))) {
            let lines = lines(seed);
            let mut valued = control(0, start).value_lines(&lines).expect("plain lines");
            let skips = [0, 1 << 1, 1 << 2 | 1 << 10, 1 << 1 | 1 << 2 | 1 << 10];
            for (world, skip) in [2, 1].into_iter().flat_map(|world| skips.map(|skip| (world, skip))) {
                let mut by_values = control_in(world, skip, start);
                // The machine may stand elsewhere than where the program counts from.
                by_values.last[0] += i64::from(seed % 5 == 0);
                let mut by_words = by_values.clone();
                let before = format!("{by_values:?}");
                let Some(events) = by_values.pass_valued(&mut valued) else {
                    assert_eq!(format!("{by_values:?}"), before);
                    left += 1;
                    continue;
                };
                let counted = by_words.pass(&lines).expect("no fault");
                by_words.counted = by_values.counted;
                assert_eq!(
                    (events, format!("{by_values:?}")),
                    (counted, format!("{by_words:?}")),
                    "{lines:?}"
                );
                executed += 1;
            }
        }
        assert!(executed > 1_000 && left > 100, "{executed} {left}");
    }

    /// A time is used up by each cut, and by no other line.
    #[test]
    fn times_of_lines_do_what_their_words_do() {
        let start = [Op::SetFeedMode(FeedMode::InverseTime)];
        let (mut executed, mut left) = (0, 0);
        for seed in 0..400 {
            let mut feeds = seed;
            let timed = |line: Stmt| {
                feeds += 1;
                let feed = stmt(line.skip, Op::SetFeedRate(entry(feeds as i64 * 1_000)));
                // One in 16 is left out.
                let without = feeds % 16 == 3 || matches!(line.op, Op::SetFeedRate(_));
                if without { vec![line] } else { vec![feed, line] }
            };
            let lines: Vec<Stmt> = lines(seed).into_iter().flat_map(timed).collect();
            let mut valued = control(0, &start).value_lines(&lines).expect("plain lines");
            for skip in [0, 1 << 1] {
                let mut by_values = control(skip, &start);
                by_values.last[0] += i64::from(seed % 5 == 0);
                let mut by_words = by_values.clone();
                let counted = by_words.pass(&lines);
                let Some(events) = by_values.pass_valued(&mut valued) else {
                    left += 1;
                    continue;
                };
                by_words.counted = by_values.counted;
                assert_eq!(
                    (events, format!("{by_values:?}")),
                    (counted.expect("no fault"), format!("{by_words:?}")),
                    "{lines:?}"
                );
                executed += 1;
            }
        }
        assert!(executed > 100 && left > 100, "{executed} {left}");
    }

    #[test]
    fn what_is_not_plain_is_left() {
        let exec = control(0, &[]);
        let plain = || stmt(None, Op::StraightFeed(to([Some(1_000), None, None])));
        assert!(exec.value_lines(&[plain()]).is_some());
        let Op::StraightFeed(mut turning) = plain().op else { panic!("a move") };
        let mut incremental = turning.clone();
        turning.to.axes[3] = turning.to.axes[0].clone();
        let Some(word) = &mut incremental.to.axes[0] else { panic!("a word") };
        word.distance = Fact::Known(Distance::Incremental);
        for op in [Op::StraightFeed(turning), Op::StraightFeed(incremental), Op::ProgramStop] {
            assert!(exec.value_lines(&[plain(), stmt(None, op)]).is_none());
        }
        let mut valued = exec.value_lines(&[plain()]).expect("a plain line");
        for op in [
            Op::UseLengthUnits(Units::Inch),
            Op::SetDistanceMode(Distance::Incremental),
            Op::StopSpindleTurning,
            Op::SetFeedRate(entry(0)),
        ] {
            assert_eq!(control(0, &[op]).pass_valued(&mut valued), None);
        }
    }

    /// Controls that agree on rows make the same events of them.
    #[test]
    fn controls_that_agree_on_rows_make_the_same_events() {
        let states: [(u32, &[Op]); 9] = [
            (2, &[]),
            (2, &[Op::Comment("nothing else".into())]),
            (1, &[]),
            (2, &[Op::SetSpindleSpeed(entry(700_000))]),
            (2, &[Op::SetFeedRate(entry(90_000))]),
            (2, &[Op::SetFeedMode(FeedMode::PerRevolution), Op::SetFeedRate(entry(200))]),
            (2, &[Op::SetDistanceMode(Distance::Incremental)]),
            (2, &[Op::UseLengthUnits(Units::Inch)]),
            (2, &[Op::StraightTraverse(to([Some(4_500), None, None]))]),
        ];
        let (mut agree, mut differ) = (0, 0);
        for (one, other) in states.iter().flat_map(|one| states.iter().map(move |other| (one, other))) {
            for seed in 0..20 {
                let [mut one, mut other] = [one, other].map(|(world, state)| control_in(*world, 0, state));
                let agrees = one.agrees_on_rows(&other);
                let [mut events, mut there] = [Vec::new(), Vec::new()];
                for line in lines(seed).into_iter().filter(|line| line.skip.is_none()) {
                    let done = [one.step(&line, &mut events), other.step(&line, &mut there)];
                    assert!(!agrees || done[0].is_ok() == done[1].is_ok());
                }
                assert!(!agrees || events == there, "{one:?} {other:?}");
                agree += u32::from(agrees);
                differ += u32::from(events != there);
            }
        }
        assert!(agree >= 200 && differ > 500, "{agree} {differ}");
    }
}
