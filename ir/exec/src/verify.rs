//! Comparison of two canonical streams: is it the same cut?
//!
//! Equal means: the same events in the same order; end point, centre, plane and sense of arcs agree
//! to within the target's resolution; feed, speed, spindle, tool and coolant are attributes of the
//! event and agree. Moves that rounding has brought to nothing vanish. The comparison consumes both
//! streams as they come, so that its memory does not grow with the program.

use std::collections::BTreeMap;

mod besides;
mod plain;
mod same;

pub(crate) use plain::is_silent;
pub use plain::{counts_from_there, same_arcs, same_lines, same_plain};

use besides::{Passed, from_start, switched_by_control, with_z_of, z_passed_over};

use crate::Event;
use crate::Kind;
use crate::Seen;
use crate::by_control;
use crate::cuts;
use crate::named_tool;
use ncc_ir::alarms::Alarms;
use ncc_ir::canon::{AXES, Axis, Spindle, Turn};

use ncc_ir::expr::num::{Nanos, POW10};
use ncc_ir::program::Text;
use ncc_ir::source::Span;

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
    /// Half the least increment, in nanos.
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
    /// Whether more than half the least increment was met.
    beyond: bool,
    /// What the target's own digits resolve, where the comparison is coarser.
    own: Option<Resolution>,
    /// Whether more than half the target's own least increment was met.
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
    /// What of the machine's state the target supports.
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
    /// Lengths may be off by so much, where that is more than half the least increment.
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

    /// The target supports so much of the machine's state alone: the rest does not count.
    pub fn see(&mut self, seen: Seen) {
        self.seen = (seen != Seen::default()).then_some(seen);
    }

    /// The target's control says alarms so.
    pub fn say_alarms(&mut self, alarms: Option<Alarms>) {
        self.alarms = alarms;
    }

    /// Says whether the pairs are kept from now on, until they are taken.
    pub fn keep_pairs(&mut self, keep: bool) {
        self.pairs = keep.then(Vec::new);
    }

    /// The pairs found since this was last asked, in order; none unless they are kept. What both sides
    /// made by one execution ([`Comparison::pass`]) is among them only where it was put there
    /// ([`Comparison::keep_pair`]).
    pub fn take_pairs(&mut self) -> Vec<Pair> {
        self.pairs.as_mut().map(std::mem::take).unwrap_or_default()
    }

    /// Whether the pairs are kept.
    pub fn keeps_pairs(&self) -> bool {
        self.pairs.is_some()
    }

    /// A pair of events that both sides made by one execution, for somebody who keeps pairs.
    pub fn keep_pair(&mut self, pair: Pair) {
        if let Some(pairs) = &mut self.pairs {
            pairs.push(pair);
        }
    }

    /// Whether nothing that one control did by itself is passed over in what comes next.
    pub fn is_settled(&self) -> bool {
        !self.after_optional && self.passed.is_nothing()
    }

    /// From now on it is noted how far places are apart that are found equal, and they are found equal
    /// within so many nanos of a millimetre, or half the least increment if that is more. Angles,
    /// feeds and seconds are not lengths. What both sides made by one execution is not measured.
    pub fn measure(&mut self, within: Nanos) {
        self.within = within;
        self.measured.get_or_insert_default();
    }

    /// Notes too whether anything is found equal that is further apart than half the target's own least increment,
    /// which is what a translation is held to.
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

    /// The largest deviation met, and whether any was more than half the least increment; nothing
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
    /// own least increment.
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
}
