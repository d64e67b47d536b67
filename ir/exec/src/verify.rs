//! Comparison of two canonical streams: is it the same cut?
//!
//! Equal means: the same events in the same order; end point, centre, plane and sense of arcs agree
//! to within the target's resolution; feed, speed, spindle, tool and coolant are attributes of the
//! event and agree. Moves that rounding has brought to nothing vanish. The comparison consumes both
//! streams as they come, so that its memory does not grow with the program.

use std::collections::BTreeMap;

mod besides;
mod plain;

pub use plain::{counts_from_there, same_plain};

use besides::{
    Passed, but_for_control, from_start, same_time, switched_by_control, with_z_of, z_passed_over,
};

use crate::Event;
use crate::Kind;
use crate::Seen;
use crate::State;
use crate::Stored;
use crate::by_control;
use crate::cuts;
use crate::named_tool;
use ncc_ir::alarms::Alarms;
use ncc_ir::canon::{AXES, Axis, Spindle, SpindleMode, Turn, same_point};

use ncc_ir::expr::num::{Nanos, ONE, POW10};
use ncc_ir::program::Text;
use ncc_ir::source::Span;

/// Half a unit of the sixth digit of a pitch in millimetres.
const FINEST_PITCH: Nanos = 500;

/// What the target resolves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Resolution {
    /// Digits after the point of a length in mm.
    pub mm: u8,
    /// Digits after the point of a length in inches.
    pub inch: u8,
    /// Digits after the point of an angle in degrees.
    pub degree: u8,
    /// Digits after the point of a feed in mm.
    pub feed: u8,
    /// Digits after the point of a feed in inches.
    pub feed_inch: u8,
    /// Digits after the point of a dwell in seconds.
    pub second: u8,
    /// Digits after the point of a spindle speed.
    pub speed: u8,
}

impl Resolution {
    /// Half a unit of the last digit, in nanos.
    fn half(digits: u8, inch: bool) -> Nanos {
        let unit = POW10[9 - digits.min(9) as usize];
        // An inch is 25.4 mm.
        (if inch { unit * 254 / 10 } else { unit }) / 2
    }

    fn feeds(&self, inch: bool) -> Nanos {
        Resolution::half(if inch { self.feed_inch } else { self.feed }, inch)
    }

    #[inline]
    fn lengths(&self, inch: bool) -> Nanos {
        Resolution::half(if inch { self.inch } else { self.mm }, inch)
    }
}

/// How two streams differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// In what.
    pub aspect: Aspect,
    /// The source's event; `None` if it has no further one.
    pub source: Option<Event>,
    /// The target's event; `None` if it has no further one.
    pub target: Option<Event>,
}

/// In what two events differ.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Aspect {
    /// The kind of event.
    Kind,
    /// The end point, in this axis.
    End(Axis),
    /// The centre, plane or sense of an arc.
    Arc,
    /// The feed.
    Feed,
    /// Tool, spindle or coolant.
    State,
    /// One stream has more events.
    Length,
}

/// Two events found equal.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// What both are.
    pub kind: Kind,
    /// Where the source's comes from.
    pub source: Span,
    /// Where the target's comes from, in the target's text.
    pub target: Span,
}

/// How far from each other two places lie that were found equal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Deviation {
    /// In nanos of a millimetre.
    pub by: Nanos,
    /// Along this axis.
    pub axis: Axis,
    /// Where the source's event comes from.
    pub source: Span,
    /// Where the target's comes from, in the target's text.
    pub target: Span,
}

/// What is noted while places are measured ([`Comparison::measure`]).
#[derive(Clone, Copy, Debug, Default)]
struct Measured {
    farthest: Option<Deviation>,
    /// Whether more than half a unit of the last digit was met.
    beyond: bool,
    /// What the target's own digits resolve, where the comparison is coarser.
    own: Option<Resolution>,
    /// Whether more than half a unit of the target's own last digit was met.
    coarse: bool,
}

/// What of a turn an arc goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Less than a quarter.
    Little,
    /// More than three quarters, and not all of it.
    Nearly,
    /// Something between; or all of it; or no arc.
    Other,
}

/// What of a turn an event goes that starts there, in machine coordinates. Within a tolerance, of two arcs
/// with one centre and one end the one can be nearly nothing and the other nearly all of the circle.
pub fn part(event: &Event, start: &[Nanos; AXES]) -> Part {
    let Kind::Arc { plane, turn, full: false, centre } = &event.kind else { return Part::Other };
    let (first, second, _) = plane.axes();
    let from_centre = |p: &[Nanos; AXES]| {
        [(first, centre[0]), (second, centre[1])]
            .map(|(axis, c)| i128::from(p[axis as usize]) - i128::from(c))
    };
    let ([a, b], [c, d]) = (from_centre(start), from_centre(&event.end));
    // Twice the triangle's area, positive where the end lies counterclockwise of the start.
    let area = if *turn == Turn::Counterclockwise { a * d - b * c } else { b * c - a * d };
    match area.signum() {
        _ if a * c + b * d <= 0 => Part::Other,
        1 => Part::Little,
        -1 => Part::Nearly,
        _ => Part::Other,
    }
}

/// A comparison in progress.
#[derive(Clone, Debug)]
pub struct Comparison {
    resolution: Resolution,
    half: [Nanos; 2],
    /// Whether everything is compared as what stands in inches is.
    as_inches: bool,
    source_at: [Nanos; AXES],
    target_at: [Nanos; AXES],
    /// What of the machine's state the target has words for.
    seen: Option<Seen>,
    /// How the target says alarms, where that may be another way.
    alarms: Option<Alarms>,
    /// What the source calls the target's tools, where that may be another number.
    tools: Option<BTreeMap<u32, u32>>,
    /// What the source's tools are that it calls by name, by the target's numbers.
    named: BTreeMap<u32, i64>,
    /// Pairs of events found equal.
    pub events: u64,
    /// The pairs themselves, if somebody asked.
    pairs: Option<Vec<Pair>>,
    /// Lengths may be off by so much, where that is more than half a unit of the last digit.
    within: Nanos,
    /// How far places are apart, if somebody asked.
    measured: Option<Measured>,
    /// Whether optional stops switch spindle and coolant off on one of the controls.
    optional_stops: bool,
    /// An optional stop came, and nothing was cut since.
    after_optional: bool,
    /// What the target's control alone has done by itself.
    passed: Passed,
}

impl Comparison {
    /// Nothing compared yet; both machines stand at `start`.
    pub fn new(resolution: Resolution, start: [Nanos; AXES]) -> Comparison {
        let half = [resolution.lengths(false), resolution.lengths(true)];
        Comparison {
            resolution,
            half,
            as_inches: false,
            source_at: start,
            target_at: start,
            seen: None,
            alarms: None,
            tools: None,
            named: BTreeMap::new(),
            events: 0,
            pairs: None,
            within: 0,
            measured: None,
            optional_stops: false,
            after_optional: false,
            passed: Passed::default(),
        }
    }

    /// The same tool has another number in the target: `tools` says what the source calls each of the
    /// target's. One that is not among them is none of the source's.
    /// `names` has those that the source may call by name.
    pub fn rename_tools(&mut self, tools: Option<BTreeMap<u32, u32>>, names: &BTreeMap<u32, Text>) {
        self.tools = tools;
        self.named = names.iter().map(|(number, name)| (*number, named_tool(name))).collect();
    }

    /// The target has words for so much of the machine's state alone: the rest does not count.
    pub fn see(&mut self, seen: Seen) {
        self.seen = (seen != Seen::default()).then_some(seen);
    }

    /// The target's control says alarms so.
    pub fn say_alarms(&mut self, alarms: Option<Alarms>) {
        self.alarms = alarms;
    }

    /// Whether an alarm is the same under the target's number.
    fn same_alarm(&self, (number, text): (Option<Nanos>, &str), there: (Option<Nanos>, &str)) -> bool {
        let whole = number.is_none_or(|number| number % ONE == 0);
        let alarms = self.alarms.as_ref().filter(|_| whole);
        let said = alarms.and_then(|alarms| alarms.said(number.map(|n| n / ONE), text));
        let said = said.as_ref().map(|(number, text)| (number.map(|n| n * ONE), &**text));
        (number, text) == there || said == Some(there)
    }

    /// Says whether the pairs are kept from now on, until they are taken.
    pub fn keep_pairs(&mut self, keep: bool) {
        self.pairs = keep.then(Vec::new);
    }

    /// The pairs found since this was last asked, in order; none unless they are kept. What both sides
    /// made by one execution ([`Comparison::pass`]) is not among them.
    pub fn take_pairs(&mut self) -> Vec<Pair> {
        self.pairs.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// From now on it is noted how far places are apart that are found equal, and they are found equal
    /// within so many nanos of a millimetre, or half a unit of the last digit if that is more. Angles,
    /// feeds and seconds are not lengths. What both sides made by one execution is not measured.
    pub fn measure(&mut self, within: Nanos) {
        self.within = within;
        self.measured.get_or_insert_default();
    }

    /// Notes too whether anything is found equal that is further apart than half a unit of the target's
    /// own last digit, which is what a translation is held to.
    pub fn measure_by(&mut self, own: Resolution) {
        self.measured.get_or_insert_default().own = Some(own);
    }

    /// Whether that was met.
    pub fn coarse(&self) -> bool {
        self.measured.is_some_and(|measured| measured.coarse)
    }

    /// From now on everything is compared as what stands in inches is: the source has inches.
    pub fn as_inches(&mut self) {
        self.as_inches = true;
    }

    /// The largest deviation met, and whether any was more than half a unit of the last digit; nothing
    /// unless it is measured, and where all places are the same.
    pub fn deviation(&self) -> Option<(Deviation, bool)> {
        self.measured.and_then(|m| m.farthest.map(|farthest| (farthest, m.beyond)))
    }

    /// Notes how far apart the ends, and the centres of arcs, of two events are that were found equal.
    #[cold]
    fn note(&mut self, a: &Event, b: &Event, ends: [&[Nanos; AXES]; 2]) {
        let half = self.half[usize::from(b.inch || self.as_inches)];
        let Some(measured) = &mut self.measured else { return };
        let own = measured.own.map_or(half, |own| own.lengths(b.inch));
        let mut note = |axis: Axis, x: Nanos, y: Nanos, [half, own]: [Nanos; 2]| {
            let by = Nanos::try_from(x.abs_diff(y)).unwrap_or(Nanos::MAX);
            measured.beyond |= by > half;
            measured.coarse |= by > own;
            if by > measured.farthest.map_or(0, |farthest| farthest.by) {
                measured.farthest = Some(Deviation { by, axis, source: a.span, target: b.span });
            }
        };
        for axis in Axis::ALL.into_iter().filter(|axis| !axis.is_rotary()) {
            note(axis, ends[0][axis as usize], ends[1][axis as usize], [half, own]);
        }
        if let (Kind::Arc { plane, centre, .. }, Kind::Arc { centre: other, .. }) = (&a.kind, &b.kind) {
            let (first, second, _) = plane.axes();
            let most = [half, own].map(|half| half * 3 / 2);
            note(first, centre[0], other[0], most);
            note(second, centre[1], other[1], most);
        }
        let Some(own) = measured.own else { return };
        let mut angles = Axis::ALL.into_iter().filter(|axis| axis.is_rotary());
        let degree = Resolution::half(own.degree, false) as u64;
        measured.coarse |=
            angles.any(|axis| ends[0][axis as usize].abs_diff(ends[1][axis as usize]) > degree);
    }

    /// Notes whether feeds and seconds of two events that were found equal are the same to the target's
    /// own last digit.
    fn note_values(&mut self, a: &Event, b: &Event) {
        let Some(Measured { own: Some(own), coarse, .. }) = &mut self.measured else { return };
        *coarse |= a.rate.abs_diff(b.rate) > own.feeds(b.inch) as u64;
        *coarse |= a.state.spindle != Spindle::Stopped
            && a.state.speed.abs_diff(b.state.speed) > Resolution::half(own.speed, false) as u64;
        if let (Kind::Dwell(x), Kind::Dwell(y)) = (&a.kind, &b.kind) {
            *coarse |= x.abs_diff(*y) > Resolution::half(own.second, false) as u64;
        }
    }

    /// Optional stops switch spindle and coolant off on one of the controls, if the operator wants them: what words switch
    /// off for that before the stop, and on again after it, is passed over where nothing is cut.
    pub fn optional_stops(&mut self) {
        self.optional_stops = true;
    }

    /// Whether an event of the target switches coolant for an optional stop.
    fn at_optional_stop(&self, a: &Event, b: &Event) -> bool {
        let before = a.kind == Kind::OptionalProgramStop && !(b.state.flood || b.state.mist);
        b.kind == Kind::Coolant && (before || self.after_optional)
    }

    /// What of spindle and coolant is passed over at an optional stop, and after it until something is cut.
    fn around_optional_stop(&self, a: &Event, b: &Event) -> u8 {
        let stops = a.kind == Kind::OptionalProgramStop || self.after_optional;
        let off = |on: bool, bit: u8| if stops && !on { bit } else { 0 };
        off(b.state.spindle != Spindle::Stopped, by_control::SPINDLE)
            | off(b.state.flood || b.state.mist, by_control::COOLANT)
    }

    /// Whether tool, spindle, coolant and modes are the same.
    #[inline]
    fn same_state(&self, a: &State, b: &State) -> bool {
        // What is the same as a whole is the same to whoever sees less of it.
        if self.tools.is_none() && self.named.is_empty() && a.same(b) {
            return true;
        }
        let apart = a.speed.abs_diff(b.speed);
        // What a surface's speed counts is no unit of the last digit in inches.
        let turns = a.spindle_mode == SpindleMode::Turns;
        if turns && apart != 0 && apart <= Resolution::half(self.resolution.speed, false) as u64 {
            // As lengths, a speed is what the target's digits say of it.
            return self.same_state(a, &State { speed: a.speed, ..*b });
        }
        match &self.seen {
            None => self.same_tooled(a, b),
            Some(seen) => self.same_tooled(&seen.of(a), &seen.of(b)),
        }
    }

    #[inline]
    fn same_tooled(&self, a: &State, b: &State) -> bool {
        if self.tools.is_none() && self.named.is_empty() {
            return a.same(b);
        }
        // One that the source calls by name is told from all that it calls by number.
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

    /// From now on lengths of one unit may be off by half a unit of this digit, where the target
    /// resolves finer: holes that the source writes rounded are made where a pattern has them.
    pub fn rounded(&mut self, digits: u8, inch: bool) {
        let resolved = if inch { &mut self.resolution.inch } else { &mut self.resolution.mm };
        *resolved = (*resolved).min(digits);
        self.half = [self.resolution.lengths(false), self.resolution.lengths(true)];
    }

    /// Both machines stand here; before the first event.
    pub fn start_at(&mut self, start: [Nanos; AXES]) {
        self.source_at = start;
        self.target_at = start;
        self.passed = Passed::default();
    }

    /// Notes events that need no comparison, because both sides executed the same in the same state.
    pub fn pass(&mut self, events: u64, at: [Nanos; AXES]) {
        self.events += events;
        self.start_at(at);
    }

    /// Compares as far as both streams go, and removes what was compared. With `over`, what is left
    /// of one stream must be nothing.
    ///
    /// # Errors
    /// The first difference.
    pub fn advance(
        &mut self,
        source: &mut Vec<Event>,
        target: &mut Vec<Event>,
        over: bool,
    ) -> Result<(), Box<Difference>> {
        let (mut s, mut t) = (0, 0);
        let found = loop {
            match (source.get(s), target.get(t)) {
                (Some(a), Some(b)) => match self.compare(a, b) {
                    None => {
                        self.source_at = a.end;
                        self.target_at = b.end;
                        self.events += 1;
                        let around = if self.optional_stops { self.around_optional_stop(a, b) } else { 0 };
                        self.passed.after(a, b, around);
                        if self.optional_stops {
                            let stop = a.kind == Kind::OptionalProgramStop;
                            self.after_optional = stop || self.after_optional && !cuts(&a.kind);
                        }
                        if self.measured.is_some() {
                            let end = if z_passed_over(a, b) { with_z_of(a, b) } else { b.end };
                            self.note(a, b, [&a.end, &end]);
                            self.note_values(a, b);
                        }
                        if let Some(pairs) = &mut self.pairs {
                            pairs.push(Pair { kind: a.kind.clone(), source: a.span, target: b.span });
                        }
                        s += 1;
                        t += 1;
                    }
                    Some(_) if switched_by_control(a, b) => s += 1,
                    Some(_) if switched_by_control(b, a) => t += 1,
                    Some(_) if self.optional_stops && self.at_optional_stop(a, b) => t += 1,
                    Some(_) if self.passed.off_already(a, b) => s += 1,
                    Some(_) if b.state.by_control & by_control::MOVE != 0 => {
                        // Only the target's control goes there: up, before it changes the tool.
                        self.target_at = b.end;
                        t += 1;
                    }
                    Some(_) if from_start(a, b) && a.state.by_control & by_control::MOVE != 0 => {
                        // From where the operator has left it, which is no part of the program.
                        self.source_at = a.end;
                        s += 1;
                    }
                    Some(_) if self.vanishes(a, [&self.source_at, &self.target_at]) => {
                        if self.measured.is_some() {
                            self.note(a, b, [&a.end, &self.target_at.clone()]);
                        }
                        self.source_at = a.end;
                        s += 1;
                    }
                    Some(_) if self.vanishes(b, [&self.target_at, &self.source_at]) => {
                        if self.measured.is_some() {
                            self.note(a, b, [&self.source_at.clone(), &b.end]);
                        }
                        self.target_at = b.end;
                        t += 1;
                    }
                    Some(aspect) => break Some((aspect, Some(a.clone()), Some(b.clone()))),
                },
                (Some(a), None) if over => {
                    if !self.vanishes(a, [&self.source_at, &self.target_at]) {
                        break Some((Aspect::Length, Some(a.clone()), None));
                    }
                    s += 1;
                }
                (None, Some(b)) if over => {
                    if !self.vanishes(b, [&self.target_at, &self.source_at]) {
                        break Some((Aspect::Length, None, Some(b.clone())));
                    }
                    t += 1;
                }
                (None, _) | (_, None) => break None,
            }
        };
        source.drain(..s);
        target.drain(..t);
        match found {
            None => Ok(()),
            Some((aspect, source, target)) => Err(Box::new(Difference { aspect, source, target })),
        }
    }

    /// Whether a move goes nowhere, as seen from where the other machine stands: a straight one, or an arc of less than a
    /// quarter of a turn.
    fn vanishes(&self, event: &Event, [own, other]: [&[Nanos; AXES]; 2]) -> bool {
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

    /// Whether one of two arcs is a full circle and the other nearly one, which ends where it begins to half a unit of the
    /// last digit.
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
    fn end(&self, a: &[Nanos; AXES], b: &[Nanos; AXES], inch: bool) -> Option<Axis> {
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

    /// Whether the same is put into the tables, to half a unit of the last digit.
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
    fn compare(&self, a: &Event, b: &Event) -> Option<Aspect> {
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
                // Where a pitch is said by feed and speed, it is as fine as the feed.
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
        let most = self.resolution.feeds(b.inch || self.as_inches);
        if a.rate != b.rate && !synchronised && !near(a.rate, b.rate, most) && !same_time(a, b) {
            return Some(Aspect::Feed);
        }
        if a.rate != 0 && !synchronised && a.state.feed_mode != b.state.feed_mode {
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
