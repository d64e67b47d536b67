//! When two events are the same: as far as both controls resolve them, and know them.

use ncc_ir::canon::{AXES, Axis, FeedMode, SpindleMode, same_point};
use ncc_ir::expr::num::{Nanos, ONE};

use super::besides::{but_for_control, same_time, with_z_of, z_passed_over};
use super::{Aspect, Comparison, Part, Resolution, part};
use crate::Event;
use crate::Kind;
use crate::PacedMove;
use crate::State;
use crate::Stored;
use crate::by_control;
use crate::cuts;

/// Half a unit of the sixth digit of a pitch in millimetres.
const FINEST_PITCH: Nanos = 500;

impl Comparison {
    /// Whether an alarm is the same under the target's number.
    fn same_alarm(&self, (number, text): (Option<Nanos>, &str), there: (Option<Nanos>, &str)) -> bool {
        let whole = number.is_none_or(|number| number % ONE == 0);
        let alarms = self.alarms.as_ref().filter(|_| whole);
        let said = alarms.and_then(|alarms| alarms.said(number.map(|n| n / ONE), text));
        let said = said.as_ref().map(|(number, text)| (number.map(|n| n * ONE), &**text));
        (number, text) == there || said == Some(there)
    }

    /// Whether feeds are the same but for the target's least increment, and count the same; `timed` where one of the controls
    /// counts in a way of its own.
    #[inline]
    fn same_rate([a, b]: [Nanos; 2], [mode, other]: [FeedMode; 2], timed: bool, most: Nanos) -> bool {
        let same = a == b || a.abs_diff(b) <= most as u64 || same_time([a, b], timed);
        same && (a == 0 || mode == other)
    }

    /// Whether the moves of two controls that agree otherwise ([`Exec::paces_as`](crate::Exec::paces_as)) are the same
    /// events: they end at the same places exactly, and their feeds are the same as far as [`Comparison::advance`] asks.
    pub fn same_paced(&self, a: &[PacedMove], b: &[PacedMove], inch: bool) -> bool {
        let most = self.resolution.feeds(inch || self.as_inches);
        let same = |(a, b): (&PacedMove, &PacedMove)| {
            let (modes, timed) = ([a.mode, b.mode], a.timed || b.timed);
            a.feed == b.feed
                && same_point(&a.end, &b.end)
                && Comparison::same_rate([a.rate, b.rate], modes, timed, most)
        };
        let plainly = self.is_settled() && self.measured.is_none() && self.pairs.is_none();
        plainly && a.len() == b.len() && a.iter().zip(b).all(same)
    }

    /// Whether tool, spindle, coolant and modes are the same.
    #[inline]
    fn same_state(&self, a: &State, b: &State) -> bool {
        // What is the same as a whole is the same to whoever sees less of it.
        if self.tools.is_none() && self.named.is_empty() && a.same(b) {
            return true;
        }
        let apart = a.speed.abs_diff(b.speed);
        // What a surface's speed counts is no unit of the least increment in inches.
        let turns = a.spindle_mode == SpindleMode::Turns;
        if turns && apart != 0 && apart <= Resolution::half(self.resolution.speed, false) as u64 {
            // As lengths, a speed is what the target's digits say of it.
            return self.same_state(a, &State { speed: a.speed, ..*b });
        }
        match &self.seen {
            None => self.same_tooled(a, b),
            Some(seen) => self.same_tooled(&seen.as_seen(a), &seen.as_seen(b)),
        }
    }

    #[inline]
    fn same_tooled(&self, a: &State, b: &State) -> bool {
        if self.tools.is_none() && self.named.is_empty() {
            return a.same(b);
        }
        // One that the source calls by name is distinguished from all that it calls by number.
        let named = u32::try_from(b.tool).ok().and_then(|tool| self.named.get(&tool));
        if named == Some(&a.tool) {
            return a.same(&State { tool: a.tool, ..*b });
        }
        let Some(tools) = &self.tools else { return a.same(b) };
        // The tool that nobody named is the same on both.
        let tool = match u32::try_from(b.tool) {
            Err(_) => Some(b.tool),
            Ok(tool) => tools.get(&tool).map(|own| i64::from(*own)),
        };
        tool.is_some_and(|tool| a.same(&State { tool, ..*b }))
    }

    /// Whether a move goes nowhere, as seen from where the other machine stands: a straight one, or an arc of less than a
    /// quarter of a turn.
    pub(super) fn vanishes(&self, event: &Event, [own, other]: [&[Nanos; AXES]; 2]) -> bool {
        let short = match event.kind {
            Kind::Traverse | Kind::Feed | Kind::Synchronised { .. } => true,
            Kind::Arc { .. } => part(event, own) == Part::Little,
            _ => false,
        };
        short && self.end(&event.end, other, event.inch).is_none()
    }

    /// Whether one of two arcs is nearly nothing and the other nearly a whole circle: their ends and
    /// centres may be as good as the same.
    fn other_way_round(&self, a: &Event, b: &Event) -> bool {
        matches!(
            (part(a, &self.source_at), part(b, &self.target_at)),
            (Part::Little, Part::Nearly) | (Part::Nearly, Part::Little)
        )
    }

    /// Whether one of two arcs is a full circle and the other nearly one, which ends where it begins to half the least increment.
    fn as_good_as_full(&self, a: &Event, b: &Event) -> bool {
        let full = |event: &Event| matches!(event.kind, Kind::Arc { full: true, .. });
        let (nearly, start) = if full(b) { (a, &self.source_at) } else { (b, &self.target_at) };
        let Kind::Arc { plane, .. } = nearly.kind else { return false };
        // Along the normal it may be a helix.
        let mut end = nearly.end;
        let normal = plane.axes().2 as usize;
        end[normal] = start[normal];
        full(a) != full(b) && part(nearly, start) == Part::Nearly && self.end(&end, start, a.inch).is_none()
    }

    /// The axis in which two points differ.
    #[inline]
    pub(super) fn end(&self, a: &[Nanos; AXES], b: &[Nanos; AXES], inch: bool) -> Option<Axis> {
        if same_point(a, b) {
            return None;
        }
        Axis::ALL.into_iter().find(|&axis| {
            let off = a[axis as usize].abs_diff(b[axis as usize]);
            let half = if axis.is_rotary() {
                Resolution::half(self.resolution.degree, false)
            } else {
                self.half[usize::from(inch || self.as_inches)].max(self.within)
            };
            off > half as u64
        })
    }

    /// Whether the same is put into the tables, to half the least increment.
    fn same_data(&self, a: &Stored, b: &Stored, inch: bool) -> bool {
        let near = |x: Nanos, y: Nanos| x.abs_diff(y) <= self.half[usize::from(inch)].max(self.within) as u64;
        match (a, b) {
            (Stored::Offset(m, a, s), Stored::Offset(n, b, t)) => {
                let turned = s.abs_diff(*t) <= Resolution::half(self.resolution.degree, false) as u64;
                m == n && turned && self.end(a, b, inch).is_none()
            }
            (Stored::Position(m, a), Stored::Position(n, b)) => m == n && self.end(a, b, inch).is_none(),
            (Stored::Tool(m), Stored::Tool(n)) => m == n,
            (Stored::Length(m, a), Stored::Length(n, b)) => m == n && near(*a, *b),
            (Stored::Value(m, p, s, a), Stored::Value(n, q, t, b)) => (m, p, s) == (n, q, t) && near(*a, *b),
            (Stored::Offset(..) | Stored::Position(..) | Stored::Tool(_), _)
            | (Stored::Length(..) | Stored::Value(..), _) => false,
        }
    }

    #[inline]
    pub(super) fn compare(&self, a: &Event, b: &Event) -> Option<Aspect> {
        let near = |x: Nanos, y: Nanos, half: Nanos| x.abs_diff(y) <= half as u64;
        if b.state.by_control & !a.state.by_control & by_control::MOVE != 0 {
            return Some(Aspect::Kind);
        }
        match (&a.kind, &b.kind) {
            (Kind::Feed, Kind::Feed) | (Kind::Traverse, Kind::Traverse) => {}
            (
                Kind::Arc { plane, turn, full, centre },
                Kind::Arc { plane: p2, turn: t2, full: f2, centre: c2 },
            ) => {
                // The centre follows from the rounded start and a rounded word, so it may be off by
                // up to one and a half times what an end point may.
                let half = (self.half[usize::from(b.inch || self.as_inches)] * 3 / 2).max(self.within);
                let round = full == f2 || self.as_good_as_full(a, b);
                let same = plane == p2 && turn == t2 && round && !self.other_way_round(a, b);
                if !same || !near(centre[0], c2[0], half) || !near(centre[1], c2[1], half) {
                    return Some(Aspect::Arc);
                }
            }
            (Kind::Probe { to, probe }, Kind::Probe { to: other, probe: sought }) => {
                if probe != sought || self.end(to, other, b.inch).is_some() {
                    return Some(Aspect::Kind);
                }
            }
            (Kind::Dwell(x), Kind::Dwell(y)) => {
                if !near(*x, *y, Resolution::half(self.resolution.second, false)) {
                    return Some(Aspect::Kind);
                }
            }
            (Kind::Data(x), Kind::Data(y)) => {
                if !self.same_data(x, y, b.inch || self.as_inches) {
                    return Some(Aspect::Kind);
                }
            }
            (Kind::Synchronised { pitch, chuck }, Kind::Synchronised { pitch: p2, chuck: c2 }) => {
                // Where a pitch is stated by feed and speed, it is as fine as the feed.
                let finest = if b.state.speed == 0 {
                    0
                } else {
                    let feeds = i128::from(self.resolution.feeds(b.inch || self.as_inches)) * i128::from(ONE);
                    Nanos::try_from(feeds / i128::from(b.state.speed)).unwrap_or(0)
                };
                if chuck != c2 || !near(*pitch, *p2, finest.max(FINEST_PITCH)) {
                    return Some(Aspect::Kind);
                }
            }
            (Kind::Tilt(Some(x)), Kind::Tilt(Some(y))) => {
                let half = self.half[usize::from(b.inch || self.as_inches)].max(self.within);
                if !x.is_same(y, half, Resolution::half(self.resolution.degree, false)) {
                    return Some(Aspect::Kind);
                }
            }
            (Kind::Alarm(number, text), Kind::Alarm(other, shown)) => {
                if !self.same_alarm((*number, text), (*other, shown)) {
                    return Some(Aspect::Kind);
                }
            }
            (Kind::Message(text), Kind::Message(shown)) => {
                let here = || self.alarms.as_ref().map(|alarms| alarms.shown(text));
                if text != shown && here().as_ref() != Some(shown) {
                    return Some(Aspect::Kind);
                }
            }
            // One that does not say the way takes the machine's.
            (Kind::OrientToolAxis(x), Kind::OrientToolAxis(y)) if x.is_none() || y.is_none() => {}
            (Kind::Orient(x), Kind::Orient(y)) => {
                if !near(*x, *y, Resolution::half(self.resolution.degree, false)) {
                    return Some(Aspect::Kind);
                }
            }
            (x, y) if x == y => {}
            _ => return Some(Aspect::Kind),
        }
        // It counts as soon as something is cut.
        let by_target = b.state.by_control & !a.state.by_control;
        let z_elsewhere = z_passed_over(a, b);
        if z_elsewhere && cuts(&b.kind) {
            return Some(Aspect::End(Axis::Z));
        }
        let half = self.half[usize::from(b.inch || self.as_inches)].max(self.within);
        let end = match z_elsewhere && !self.passed.z_moved(a, half) {
            true => self.end(&a.end, &with_z_of(a, b), b.inch),
            false => self.end(&a.end, &b.end, b.inch),
        };
        if let Some(axis) = end {
            return Some(Aspect::End(axis));
        }
        let synchronised = matches!(a.kind, Kind::Synchronised { .. });
        let timed = (a.state.by_control | b.state.by_control) & by_control::TIMED != 0;
        let modes = [a.state.feed_mode, b.state.feed_mode];
        let most = self.resolution.feeds(b.inch || self.as_inches);
        if !synchronised && !Comparison::same_rate([a.rate, b.rate], modes, timed, most) {
            return Some(Aspect::Feed);
        }
        let switches = by_control::SPINDLE | by_control::COOLANT;
        let around = if self.optional_stops { self.around_optional_stop(a, b) } else { 0 };
        // A code that switches coolant says what flows from there on.
        let switches = if a.kind == Kind::Coolant { by_control::SPINDLE } else { switches };
        let same = match self.passed.unsaid(a, by_target & switches | around) {
            0 => self.same_state(&a.state, &b.state),
            _ if cuts(&b.kind) => self.same_state(&a.state, &b.state),
            bits => self.same_state(&a.state, &but_for_control(&a.state, &b.state, bits)),
        };
        (!same).then_some(Aspect::State)
    }
}
