//! Lines executed for their effect on the state alone, where nothing is active that would ask for more: most of most
//! programs. What is not so plain is left to [`Exec::step`].

pub(crate) mod paced;
pub(crate) mod told;
pub(crate) mod valued;

use crate::moves::arcs::same::is_plain_arc;
use crate::{Event, Exec, Heading, Kind, MOTION, Z, by_control};
use ncc_ir::canon::{AXES, Distance, FeedMode, Motion, same_point};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::{Op, Point, Stmt};
use ncc_ir::source::Span;

impl Exec {
    /// Executes statements for their effect on the state alone; gives the number of their events.
    ///
    /// # Errors
    /// As of [`Exec::step`].
    pub fn pass(&mut self, stmts: &[Stmt]) -> Result<u64, Diagnostic> {
        (self.quiet, self.counted) = (true, 0);
        let passed = self.pass_each(stmts);
        self.quiet = false;
        passed.map(|()| self.counted)
    }

    fn pass_each(&mut self, stmts: &[Stmt]) -> Result<(), Diagnostic> {
        let (mut none, mut rest) = (Vec::new(), stmts);
        loop {
            rest = &rest[self.pass_lines(rest)?..];
            let Some((stmt, behind)) = rest.split_first() else { return Ok(()) };
            self.step(stmt, &mut none)?;
            rest = behind;
        }
    }

    /// Executes statements, and gives the number of their events, for somebody who does not look at these: `events` is
    /// memory for them.
    ///
    /// # Errors
    /// As of [`Exec::step`].
    pub fn count(&mut self, stmts: &[Stmt], events: &mut Vec<Event>) -> Result<u64, Diagnostic> {
        let (mut rest, mut many) = (stmts, 0);
        while !rest.is_empty() {
            (self.quiet, self.counted) = (true, 0);
            let lines = self.pass_lines(rest);
            self.quiet = false;
            many += self.counted;
            rest = &rest[lines?..];
            let Some((stmt, behind)) = rest.split_first() else { break };
            events.clear();
            self.step(stmt, events)?;
            many += events.len() as u64;
            rest = behind;
        }
        Ok(many)
    }

    /// Whether a line by absolute words changes no more than where the axes stand.
    pub(crate) fn takes_lines(&self) -> bool {
        self.state.feed_mode != FeedMode::InverseTime && self.takes_timed_lines()
    }

    /// The same, whatever a line makes besides an event of it. (The tool centre path counts on a contour, which is
    /// watched, alone.)
    pub(crate) fn goes_plainly(&self) -> bool {
        let state = &self.state;
        !(state.tip || state.tilted || self.contour.watched)
            && state.by_control & (by_control::Z | by_control::Z_AT_START | by_control::Z_COUNTED) == 0
            && self.modes.distance == Distance::Absolute
            && self.along == Z
            && !self.carries_linear()
            && self.waiting.is_none()
            && self.in_block.is_none()
            && self.corner.is_none()
            && self.cycle.is_none()
            && self.ways.is_none()
            && self.after_stop.is_none()
            && self.raw.is_none()
            && self.probing.is_none()
            && self.detour.is_none()
    }

    /// Executes lines, feeds and plain arcs from the first statement on; gives the number of statements that it has
    /// executed.
    ///
    /// # Errors
    /// As of [`Exec::step`].
    pub(crate) fn pass_lines(&mut self, stmts: &[Stmt]) -> Result<usize, Diagnostic> {
        if !self.quiet || !self.takes_lines() {
            return Ok(0);
        }
        // Then a line to where the axes stand moves nothing.
        let in_place = same_point(&self.place(&self.position), &self.last);
        for (at, stmt) in stmts.iter().enumerate() {
            if self.skips(stmt) {
                continue;
            }
            let (to, feed) = match &stmt.op {
                Op::StraightFeed(to) => (&to.to, true),
                Op::StraightTraverse(to) => (&to.to, false),
                Op::Position(to) => match self.modes.motion {
                    Motion::Feed => (&to.to, true),
                    Motion::Traverse => (&to.to, false),
                    Motion::Arc(_) | Motion::Cycle => return Ok(at),
                },
                Op::SetFeedRate(feed) => {
                    self.shown.goes_on();
                    self.feed = self.value(feed, stmt.span)?;
                    self.feed_inch = Some(self.modes.inch);
                    continue;
                }
                Op::ArcFeed(arc) if is_plain_arc(arc) => {
                    self.shown.goes_on();
                    self.arc(arc, stmt.span, &mut Vec::new())?;
                    continue;
                }
                Op::Comment(_) | Op::Blank => {
                    self.shown.goes_on();
                    continue;
                }
                _ => return Ok(at),
            };
            if Exec::turns(to) || feed && self.feed == 0 {
                return Ok(at);
            }
            let mut next = self.position;
            let Some(named) = self.absolute_place(to, &mut next) else { return Ok(at) };
            self.shown.goes_on();
            self.relies_on_slots(named);
            self.at_place &= named >> Z & 1 == 0;
            let moved = !same_point(&next, &self.position);
            if moved {
                self.heading = Heading::From(self.position);
                self.position = next;
            }
            self.modes.motion = if feed { Motion::Feed } else { Motion::Traverse };
            self.said |= MOTION;
            if moved || !in_place {
                let end = self.place(&next);
                if !same_point(&end, &self.last) {
                    self.last = end;
                    self.counted += 1;
                }
            }
        }
        Ok(stmts.len())
    }

    /// Puts the axes that a line of absolute words names where it goes; gives these, a bit each. `None` is another line, or
    /// a word without a value.
    #[inline(always)]
    fn absolute_place(&self, to: &Point, next: &mut [Nanos; AXES]) -> Option<u32> {
        let mut named = 0;
        for (axis, (word, place)) in to.axes[..3].iter().zip(next).enumerate() {
            let Some(word) = word else { continue };
            // What has no value is reported by the step that executes it.
            *place = self.plain_value(&word.value)?;
            if word.distance.or(Distance::Absolute) != Distance::Absolute {
                return None;
            }
            named |= 1 << axis;
        }
        Some(named)
    }

    /// Goes to a place of the program; gives where that is in machine coordinates.
    #[inline(always)]
    pub(crate) fn go_plainly(&mut self, next: &[Nanos; AXES], named: u32, feed: bool) -> [Nanos; AXES] {
        self.relies_on_slots(named);
        self.at_place &= named >> Z & 1 == 0;
        if !same_point(next, &self.position) {
            self.heading = Heading::From(self.position);
        }
        self.position = *next;
        self.modes.motion = if feed { Motion::Feed } else { Motion::Traverse };
        self.said |= MOTION;
        self.place(next)
    }

    /// Executes a line where nothing is active that would ask for more than its event; whether it did. Without an error
    /// and without effect where it did not.
    #[inline]
    pub(crate) fn plain_line(
        &mut self,
        to: &Point,
        feed: bool,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<bool, Diagnostic> {
        if Exec::turns(to) || feed && self.feed == 0 || !self.goes_plainly() {
            return Ok(false);
        }
        let mut next = self.position;
        let Some(named) = self.absolute_place(to, &mut next) else { return Ok(false) };
        let end = self.go_plainly(&next, named, feed);
        if same_point(&end, &self.last) && !(self.every_move || self.narrating) {
            return Ok(true);
        }
        let kind = if feed { Kind::Feed } else { Kind::Traverse };
        self.pace = if feed { self.pace_of_line(&end) } else { None };
        self.last = end;
        self.emit(kind, span, out)?;
        Ok(true)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::World;
    use ncc_ir::canon::{Fact, Modes, Plane};
    use ncc_ir::expr::Expr;
    use ncc_ir::expr::num::{Num, Unit};
    use ncc_ir::program::{Coord, Move, Slot};

    fn stmt(op: Op) -> Stmt {
        Stmt::new(Span::default(), op)
    }

    /// A line by words of so many micrometres.
    fn line(feed: bool, words: [Option<i64>; 3], distance: Fact<Distance>) -> Stmt {
        let mut axes: [Option<Coord>; AXES] = Default::default();
        for (axis, word) in axes.iter_mut().zip(words) {
            let value = |mantissa| Num { mantissa, scale: 3, point: true, unit: Unit::Mm };
            *axis = word.map(|mantissa| Coord { value: Expr::Num(value(mantissa)), distance });
        }
        let line = Move { to: Point { axes }, said: true };
        stmt(if feed { Op::StraightFeed(line) } else { Op::StraightTraverse(line) })
    }

    /// Executes a statement through everything that may be active.
    fn step_the_long_way(exec: &mut Exec, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let straight = match &stmt.op {
            Op::StraightFeed(to) => Some((to, true)),
            Op::StraightTraverse(to) => Some((to, false)),
            Op::Position(to) => Some((to, exec.modes.motion == Motion::Feed)),
            _ => None,
        };
        match straight.filter(|_| !exec.skips(stmt)) {
            Some((to, feed)) => {
                exec.shown.goes_on();
                exec.other_straight(&to.to, feed, stmt.span, out)
            }
            None => exec.step(stmt, out),
        }
    }

    /// Where moves that go nowhere are reported too, both ways make the same events.
    fn told_alike(before: &Exec, lines: &[Stmt], what: &str) {
        for (narrates, every_move) in [(true, false), (false, true), (true, true)] {
            let [mut one, mut other] = [before, before].map(Exec::clone);
            for exec in [&mut one, &mut other] {
                (exec.narrating, exec.every_move) = (narrates, every_move);
            }
            let (mut events, mut long) = (Vec::new(), Vec::new());
            let done = lines.iter().try_for_each(|stmt| one.step(stmt, &mut events));
            let stepped = lines.iter().try_for_each(|stmt| step_the_long_way(&mut other, stmt, &mut long));
            assert_eq!((done.is_err(), &events), (stepped.is_err(), &long), "{what}");
            if done.is_ok() {
                assert_eq!(format!("{one:?}"), format!("{other:?}"), "{what}");
            }
        }
    }

    /// What is passed leaves the state that steps leave, event by event, in whatever order lines come.
    #[test]
    fn lines_that_are_passed_leave_what_steps_leave() {
        let said = Fact::Known(Distance::Absolute);
        let incremental = Fact::Known(Distance::Incremental);
        let position = |words| match line(true, words, said).op {
            Op::StraightFeed(to) => stmt(Op::Position(to)),
            op => stmt(op),
        };
        let start = [
            stmt(Op::SetDistanceMode(Distance::Absolute)),
            stmt(Op::SetSpindleSpeed(Expr::int(500))),
            stmt(Op::StartSpindleClockwise),
            stmt(Op::SetFeedRate(Expr::int(100))),
            line(false, [Some(1), Some(2), Some(5_000)], incremental),
        ];
        let lines = [
            line(true, [Some(1_000), None, Some(-250)], Fact::Entry),
            line(true, [Some(1_000), None, None], Fact::Entry),
            line(false, [None, Some(-3_333), None], said),
            stmt(Op::SetFeedRate(Expr::int(80))),
            line(true, [None, None, Some(12)], said),
            line(false, [None, None, None], said),
            line(true, [Some(7), None, None], incremental),
            line(true, [Some(7), Some(8), Some(9)], said),
            Stmt { skip: Some(1), ..line(true, [Some(70), None, None], said) },
            Stmt { skip: Some(2), ..line(false, [None, Some(71), None], said) },
            Stmt { skip: Some(1), ..stmt(Op::SetFeedRate(Expr::int(70))) },
            line(true, [Some(8), None, None], said),
            position([Some(9), None, Some(10)]),
            Stmt { skip: Some(2), ..line(false, [None, Some(72), None], said) },
            Stmt { skip: Some(2), ..position([Some(11), None, Some(12)]) },
            position([None, Some(13), None]),
        ];
        let turned = Slot::Rotation {
            plane: Fact::Known(Plane::Xy),
            centre: Box::new([Some(Expr::int(1)), Some(Expr::int(2)), None]),
            angle: Coord { value: Expr::int(30), distance: said },
        };
        let frames = [stmt(Op::Blank), stmt(Op::SetSlot(Box::new(turned)))];
        let world = World::generate(1, &Modes::default());
        let begun = frames.iter().flat_map(|frame| (0..start.len()).map(move |at| (frame, at)));
        for ((frame, skipped), many) in
            begun.flat_map(|begun| (0..=lines.len()).map(move |many| (begun, many)))
        {
            let (what, lines) = (format!("without {skipped}, {many} lines"), &lines[..many]);
            let mut one = Exec::new(&world, 1 << 1);
            let head = start.iter().enumerate().filter(|(at, _)| skipped == 0 || *at != skipped);
            let mut events = Vec::new();
            for stmt in head.map(|(_, stmt)| stmt).chain([frame]) {
                let _ = one.step(stmt, &mut events);
            }
            assert_eq!(one.chain.is_some(), matches!(frame.op, Op::SetSlot(_)), "{what}");
            let before = one.clone();
            let (mut other, mut third) = (one.clone(), one.clone());
            let passed = one.pass(lines);
            events.clear();
            let stepped = lines.iter().try_for_each(|stmt| step_the_long_way(&mut other, stmt, &mut events));
            let (mut fourth, mut own) = (before.clone(), Vec::new());
            let done = lines.iter().try_for_each(|stmt| fourth.step(stmt, &mut own));
            assert_eq!((done.is_err(), &own), (stepped.is_err(), &events), "{what}");
            told_alike(&before, lines, &what);
            assert_eq!(passed.is_err(), stepped.is_err(), "{what}");
            let counted = third.count(lines, &mut Vec::new());
            assert_eq!(counted.is_err(), stepped.is_err(), "{what}");
            if passed.is_ok() {
                assert_eq!(counted.ok(), Some(events.len() as u64), "{what}");
                third.counted = one.counted;
                assert_eq!(format!("{one:?}"), format!("{third:?}"), "{what}");
                assert_eq!(passed.ok(), Some(events.len() as u64), "{what}");
                other.counted = one.counted;
                assert_eq!(format!("{one:?}"), format!("{other:?}"), "{what}");
            }
        }
    }
}
