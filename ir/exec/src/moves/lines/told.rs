//! Lines of a table for a listener that gets each of them: what the first one makes, a step tells; those after it differ
//! from it in their place alone.
//!
//! ```text
//! G1 X5. F100.    executed by a step: an event with the feed, the tool and the spindle that are on
//! X6.             the same event, at X6
//! X7. Y1.         at X7 Y1
//! ```
//!
//! Not here: lines without a listener (`valued`).

use crate::moves::lines::valued::Course;
use crate::{Event, Exec, Kind};
use ncc_ir::canon::{AXES, FeedMode, Motion, Spindle};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::line_table::{AXES_OF_ROW, Row};
use ncc_ir::program::rows::Rows;

/// Axes of a line of a table.
const LINEAR: usize = AXES_OF_ROW;

/// How a control has gone along lines.
#[derive(Clone, Copy, Debug)]
pub struct Along(Course);

impl Along {
    /// How many lines these are.
    pub fn lines(&self) -> usize {
        self.0.executed as usize
    }
}

impl Exec {
    /// Whether lines of a table make events as the last one did, with what is on, and change no more than where the machine
    /// and the program stand, both at one place.
    fn goes_on_as(&self, last: &Event) -> bool {
        let rate = match (&last.kind, self.modes.motion) {
            (Kind::Feed, Motion::Feed) if self.feed != 0 => self.feed,
            (Kind::Traverse, Motion::Traverse) => 0,
            _ => return false,
        };
        (last.rate, last.inch, last.state, last.end) == (rate, self.modes.inch, self.state, self.last)
            && !(self.ended || self.quiet || self.speed_watched || self.standing.at_zero)
            && self.state.spindle != Spindle::Stopped
            && self.state.feed_mode != FeedMode::InverseTime
            && self.goes_plainly()
            && self.chain.is_none()
            && self.machine() == self.last
    }

    /// Whether lines after one that has made this event take this control where they take another one, but for where its
    /// zero is in the machine.
    pub fn goes_along_with(&self, other: &Exec, last: &Event) -> bool {
        let (own, mut theirs) = (self.start_of_course(), other.start_of_course());
        // Rotary axes stay where each control has them.
        theirs.at[LINEAR..].copy_from_slice(&own.at[LINEAR..]);
        own == theirs && self.goes_on_as(last)
    }

    /// The way along the first rows that go as the last line went, which has made this event, and state no feed: `tell` gets each,
    ///  with its end in the program and in the machine. `None` where a line would make another event.
    pub fn way_along(
        &self,
        rows: Rows,
        last: &Event,
        mut tell: impl FnMut(&Row, &[Nanos; AXES], &[Nanos; AXES]),
    ) -> Option<Along> {
        if !self.goes_on_as(last) {
            return None;
        }
        let start = self.start_of_course();
        let (mut at, mut from, mut named, mut executed) = (start.at, None, 0, 0);
        let mut end = self.last;
        for (row, feed) in rows.each() {
            if feed.is_some() || row.motion() != start.motion {
                break;
            }
            let Some(next) = self.next_place(row, rows, &at) else { break };
            if next != at {
                from = Some(at);
                at = next;
            }
            for axis in 0..LINEAR {
                end[axis] = at[axis].wrapping_add(self.frame[axis]);
            }
            named |= u32::from(row.axes());
            executed += 1;
            tell(row, &at, &end);
        }
        Some(Along(Course {
            start,
            at,
            heading: from,
            motion: start.motion,
            feed: start.feed,
            feed_said: false,
            moved: executed > 0,
            events: executed.into(),
            named,
            executed,
        }))
    }

    /// Where a row leads from a place of the program; `None` where a word has no value.
    #[inline(always)]
    fn next_place(&self, row: &Row, rows: Rows, at: &[Nanos; AXES]) -> Option<[Nanos; AXES]> {
        let mut next = *at;
        for (axis, place) in next[..LINEAR].iter_mut().enumerate() {
            if let Some(num) = row.word(axis, rows.unit) {
                *place = self.plain_number(num)?;
            }
        }
        Some(next)
    }

    /// Goes along lines for which this control, or one that it goes along with, has found the way.
    pub fn go_along(&mut self, way: &Along) {
        let mut course = way.0;
        let stay = &self.position[LINEAR..];
        course.at[LINEAR..].copy_from_slice(stay);
        if let Some(from) = &mut course.heading {
            from[LINEAR..].copy_from_slice(stay);
        }
        self.take_course(&course, self.modes.inch);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::World;
    use ncc_ir::canon::{Distance, Fact, Modes, Units};
    use ncc_ir::expr::Expr;
    use ncc_ir::expr::num::{Num, Unit};
    use ncc_ir::program::line_table::LineTable;
    use ncc_ir::program::{Coord, Move, Op, Point, Stmt};
    use ncc_ir::source::Span;

    fn stmt(op: Op) -> Stmt {
        Stmt::new(Span::default(), op)
    }

    fn number(mantissa: i64, unit: Unit) -> Expr {
        Expr::Num(Num { mantissa, scale: 3, point: true, unit })
    }

    /// Lines of all kinds, by numbers from a simple generator.
    fn table(mut seed: u64, unit: Unit) -> LineTable {
        let mut next = move |below: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) % below
        };
        let mut table = LineTable::default();
        for at in 0..12 {
            let mut axes: [Option<Coord>; AXES] = Default::default();
            let named = 1 + next(7);
            for (axis, word) in axes[..3].iter_mut().enumerate() {
                let value = number(next(3) as i64 * 1_500, unit);
                let distance = Fact::Known(Distance::Absolute);
                *word = (named >> axis & 1 == 1).then_some(Coord { value, distance });
            }
            let to = Move { to: Point { axes }, said: true };
            let op = if next(4) > 0 { Op::StraightFeed(to) } else { Op::StraightTraverse(to) };
            let line = Stmt::new(Span::new(10 * at, 10 * at + 9), op);
            let fed = Stmt::new(line.span, Op::SetFeedRate(number(next(4) as i64 * 50_000, unit)));
            let block = match next(6) {
                0 => vec![fed, Stmt { joined: true, ..line }],
                _ => vec![line],
            };
            assert!(table.push_block(&block));
        }
        table
    }

    fn control(world: u32, start: &[Op]) -> Exec {
        let mut exec = Exec::new(&World::generate(world, &Modes::default()), 0);
        exec.narrate();
        exec.every_move();
        let to = Move { to: Point { axes: Default::default() }, said: true };
        let mut zero = to.clone();
        let distance = Fact::Entry;
        zero.to.axes[..3].fill(Some(Coord { value: number(0, Unit::Mm), distance }));
        let turns = [
            Op::SetDistanceMode(Distance::Absolute),
            Op::StartSpindleClockwise,
            Op::SetFeedRate(number(100_000, Unit::Mm)),
            Op::StraightTraverse(zero),
        ];
        for op in turns.iter().chain(start) {
            exec.step(&stmt(op.clone()), &mut Vec::new()).expect("a plain program");
        }
        exec
    }

    /// Executes a table's rows along their way where there is one, and by steps where not; gives the events, how many
    /// lines were gone along, and whether a step was refused.
    fn along(execs: [&mut Exec; 2], table: &LineTable) -> (Vec<Event>, usize, bool) {
        let [exec, other] = execs;
        let (mut events, mut many, mut rows) = (Vec::new(), 0, Rows::of(table));
        let mut others = Vec::new();
        while !rows.is_empty() {
            let (first, behind) = rows.split(1);
            let mut stmts = Vec::new();
            first.unpack(&mut stmts);
            for stmt in &stmts {
                let refused = exec.step(stmt, &mut events).is_err();
                if refused || other.step(stmt, &mut others).is_err() {
                    return (events, many, true);
                }
            }
            rows = behind;
            let Some(last) = events.last().cloned() else { continue };
            let along_too = others.last().is_some_and(|last| other.goes_along_with(exec, last));
            let way = exec.way_along(rows, &last, |row, _, end| {
                events.push(Event { span: row.span(), end: *end, ..last.clone() });
            });
            if let Some(way) = way {
                exec.go_along(&way);
                let mut stepped = Vec::new();
                rows.split(way.lines()).0.unpack(&mut stepped);
                match along_too {
                    true => other.go_along(&way),
                    false => {
                        stepped.iter().for_each(|stmt| other.step(stmt, &mut Vec::new()).expect("a line"))
                    }
                }
                many += way.lines();
                rows = rows.split(way.lines()).1;
            }
        }
        (events, many, false)
    }

    /// Those that go along leave the state that steps leave, and are reported as these tell it; so are those that go with them.
    #[test]
    fn lines_along_their_way_are_told_as_by_steps() {
        let to = |x| {
            let mut to = Move { to: Point { axes: Default::default() }, said: true };
            to.to.axes[0] = Some(Coord { value: number(x, Unit::Mm), distance: Fact::Entry });
            to
        };
        let mut turning = to(7);
        turning.to.axes[3] = turning.to.axes[0].clone();
        let starts: [&[Op]; 7] = [
            &[],
            &[Op::UseLengthUnits(Units::Inch), Op::SetFeedRate(number(9_000, Unit::Inch))],
            &[Op::StraightFeed(to(1_500))],
            &[Op::SetOriginOffsets(2)],
            &[Op::SetFeedMode(FeedMode::PerRevolution), Op::SetFeedRate(number(100, Unit::Mm))],
            &[Op::StraightFeed(turning)],
            &[Op::StopSpindleTurning],
        ];
        let (mut gone, mut stepped) = (0, 0);
        for (start, seed) in starts.iter().flat_map(|start| (0..200).map(move |seed| (*start, seed))) {
            let unit = if seed % 3 == 0 { Unit::Inch } else { Unit::Mm };
            let (table, mut stmts) = (table(seed, unit), Vec::new());
            table.unpack(&mut stmts);
            let [mut one, mut other] = [1, 2].map(|world| control(world, start));
            // The machine may stand elsewhere than where the program counts from.
            one.last[0] += i64::from(seed % 5 == 0);
            other.position[1] += i64::from(seed % 7 == 0);
            let [mut steps, mut other_steps] = [one.clone(), other.clone()];
            let (events, many, refused) = along([&mut one, &mut other], &table);
            let mut by_steps = Vec::new();
            let failed = stmts.iter().any(|stmt| {
                steps.step(stmt, &mut by_steps).is_err() || other_steps.step(stmt, &mut Vec::new()).is_err()
            });
            assert_eq!((refused, &events), (failed, &by_steps), "{start:?} {seed}");
            if !refused {
                assert_eq!(format!("{one:?}"), format!("{steps:?}"), "{start:?} {seed}");
                assert_eq!(format!("{other:?}"), format!("{other_steps:?}"), "{start:?} {seed}");
            }
            gone += many;
            stepped += stmts.len() - many;
            assert!(
                events
                    .iter()
                    .all(|event| event.kind.moves().is_some() || matches!(event.kind, Kind::Attribute(_)))
            );
        }
        assert!(gone > 2_000 && stepped > 2_000, "{gone} {stepped}");
    }
}
