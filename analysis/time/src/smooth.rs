//! Look-ahead with limited jerk.
//!
//! Ramps are S-curves that begin and end without acceleration, but one ramp goes on over as many moves
//! as it needs: a line in short pieces is as fast as in one. Acceleration is zero at *nodes*: at
//! the junctions whose cap is reached, and at stops. A junction is a node unless the cap of another one
//! cannot be reached from it, or it from the other, by an S-curve along the path between; that is the
//! two passes of the trapezoidal plan with another law of reach. Nodes known so far are a stack: a
//! junction that has to be braked for takes those away that lie too near before it. The lowest
//! node is settled when the path known after it is long enough to stop, however soft; then the moves
//! before are certain.
//!
//! Between two nodes the speed goes up, along and down. Where it would be over the limit of a move or a
//! junction on the way, the lowest such limit is held there, and both sides are looked at again.
//!
//! Where moves differ in softness, a ramp is as soft as the softest move on it, and whether a limit is
//! within reach is judged by the softest move on the way to it.

use std::collections::VecDeque;

use crate::limits::Leg;
use crate::profile::Profile;
use crate::ramp::{Curve, gain};

/// Gain from which it is counted again, so that it keeps its digits.
const RECOUNT: f64 = 1e9;
/// What a limit may be over by: digits.
const DIGITS: f64 = 1e-9;

/// A junction whose cap is the speed, or the start of the path.
#[derive(Clone, Copy, Debug)]
struct Node {
    /// Number of the leg that starts there.
    leg: u64,
    /// Gain up to there.
    at: f64,
    speed: f64,
    /// Greatest softness from here to the next node.
    softness: f64,
}

/// A cap that may keep later junctions from being reached.
#[derive(Clone, Copy, Debug)]
struct Source {
    at: f64,
    speed: f64,
    softness: f64,
}

/// The legs whose speeds are not certain yet.
#[derive(Clone, Debug, Default)]
pub(crate) struct Smooth {
    legs: VecDeque<Leg>,
    /// Number of the first.
    first: u64,
    nodes: VecDeque<Node>,
    sources: Vec<Source>,
    /// Gain of all legs.
    gains: f64,
    /// The greatest softness that a move can have.
    softest: f64,
    curves: Vec<Curve>,
}

impl Smooth {
    /// For moves of at most such softness.
    pub(crate) fn new(softest: f64) -> Smooth {
        Smooth { softest, ..Smooth::default() }
    }

    /// Takes a leg; gives the profiles of those that are certain now.
    pub(crate) fn push(&mut self, leg: Leg, out: &mut impl FnMut(Profile)) {
        let number = self.first + self.legs.len() as u64;
        if self.legs.is_empty() {
            self.nodes.push_back(Node { leg: number, at: self.gains, speed: 0.0, softness: 0.0 });
            self.sources.push(Source { at: self.gains, speed: 0.0, softness: 0.0 });
        } else if leg.cap.is_finite() {
            self.junction(number, leg.cap.sqrt());
        }
        self.legs.push_back(leg);
        self.gains += leg.gain();
        for source in &mut self.sources {
            source.softness = source.softness.max(leg.softness);
        }
        if let Some(node) = self.nodes.back_mut() {
            node.softness = node.softness.max(leg.softness);
        }
        while let Some(next) = self.nodes.get(1).copied() {
            // What comes may be softer than what is known.
            if gain(0.0, next.speed, self.softest) > self.gains - next.at {
                break;
            }
            self.release(out);
        }
        if self.gains > RECOUNT {
            let base = self.nodes.front().map_or(self.gains, |node| node.at);
            self.nodes.iter_mut().for_each(|node| node.at -= base);
            self.sources.iter_mut().for_each(|source| source.at -= base);
            self.gains -= base;
        }
    }

    /// The path ends in a stop: all the rest is certain.
    pub(crate) fn stop(&mut self, out: &mut impl FnMut(Profile)) {
        if !self.legs.is_empty() {
            self.junction(self.first + self.legs.len() as u64, 0.0);
            while self.nodes.len() > 1 {
                self.release(out);
            }
        }
        self.legs.clear();
        self.nodes.clear();
        self.sources.clear();
        (self.first, self.gains) = (0, 0.0);
    }

    /// A junction with a cap, after all legs so far.
    fn junction(&mut self, leg: u64, speed: f64) {
        let here = self.gains;
        // Sources that this cap is within the reach of count no more: it limits what follows better.
        self.sources.retain(|source| {
            speed > source.speed && gain(source.speed, speed, source.softness) > here - source.at
        });
        let reached = self.sources.is_empty();
        self.sources.push(Source { at: here, speed, softness: 0.0 });
        if !reached {
            return;
        }
        while self.nodes.len() > 1 {
            let Some(last) = self.nodes.back().copied() else { return };
            if last.speed <= speed || gain(speed, last.speed, last.softness) <= here - last.at {
                break;
            }
            self.nodes.pop_back();
            if let Some(before) = self.nodes.back_mut() {
                before.softness = before.softness.max(last.softness);
            }
        }
        self.nodes.push_back(Node { leg, at: here, speed, softness: 0.0 });
    }

    /// Gives the legs between the first two nodes.
    fn release(&mut self, out: &mut impl FnMut(Profile)) {
        let (Some(from), Some(to)) = (self.nodes.pop_front(), self.nodes.front().copied()) else { return };
        let count = (to.leg - from.leg) as usize;
        let mut curves = std::mem::take(&mut self.curves);
        curves.clear();
        let mut softness =
            self.legs.iter().take(count).filter(|leg| leg.length > 0.0).map(|leg| leg.softness);
        let alike = softness.all(|softness| softness == from.softness);
        let span = Span { legs: &self.legs, count, softness: from.softness, alike };
        span.fit(to.at - from.at, from.speed, to.speed, &mut curves);
        span.profiles(&curves, out);
        self.curves = curves;
        self.legs.drain(..count);
        self.first += count as u64;
    }
}

/// The legs between two nodes: the first of the queue.
struct Span<'a> {
    legs: &'a VecDeque<Leg>,
    count: usize,
    /// The greatest.
    softness: f64,
    /// Whether all are as soft.
    alike: bool,
}

/// A piece of a span that is still to be laid.
enum Piece {
    Fit { gains: [f64; 2], speeds: [f64; 2] },
    Level(Curve),
}

/// A limit that a curve is over.
#[derive(Clone, Copy)]
struct Limit {
    speed: f64,
    /// Gains between which it holds.
    from: f64,
    to: f64,
}

impl Span<'_> {
    /// Lays curves over the whole of it, from one speed to another.
    fn fit(&self, whole: f64, from: f64, to: f64, curves: &mut Vec<Curve>) {
        let mut rest = vec![Piece::Fit { gains: [0.0, whole], speeds: [from, to] }];
        // Each piece that is cut is cut at another limit.
        let mut cuts = 2 * self.count;
        while let Some(piece) = rest.pop() {
            let (gains, speeds) = match piece {
                Piece::Level(curve) => {
                    curves.push(curve);
                    continue;
                }
                Piece::Fit { gains, speeds } => (gains, speeds),
            };
            let curve = self.curve(gains, speeds);
            match self.lowest_limit(&curve, gains[0]) {
                Some(limit) if cuts > 0 => {
                    cuts -= 1;
                    let (left, speed, right) = self.hold(limit, gains, speeds);
                    rest.push(Piece::Fit { gains: [right, gains[1]], speeds: [speed, speeds[1]] });
                    if right > left {
                        rest.push(Piece::Level(Curve::level(speed, right - left)));
                    }
                    rest.push(Piece::Fit { gains: [gains[0], left], speeds: [speeds[0], speed] });
                }
                _ => curves.push(curve),
            }
        }
    }

    /// The fastest from one gain to another. Each ramp is as soft as the softest move on it.
    fn curve(&self, [a, b]: [f64; 2], [from, to]: [f64; 2]) -> Curve {
        let mut softness = [self.softest(a, a), self.softest(b, b)];
        loop {
            let curve = Curve::new(from, to, b - a, softness);
            let on_them = [self.softest(a, a + curve.up), self.softest(a + curve.level, b)];
            if on_them[0] <= softness[0] && on_them[1] <= softness[1] {
                return curve;
            }
            softness = [softness[0].max(on_them[0]), softness[1].max(on_them[1])];
        }
    }

    /// Gain of a ramp; `over` says between which gains it lies if it takes so much.
    fn ramp(&self, from: f64, to: f64, over: impl Fn(f64) -> (f64, f64)) -> f64 {
        let mut softness = 0.0;
        loop {
            let gain = gain(from, to, softness);
            let (a, b) = over(gain);
            let on_it = self.softest(a, b);
            if on_it <= softness {
                return gain;
            }
            softness = on_it;
        }
    }

    /// The greatest softness of the moves between two gains.
    fn softest(&self, a: f64, b: f64) -> f64 {
        if self.alike {
            return self.softness;
        }
        let (mut at, mut most) = (0.0, 0.0);
        for leg in self.legs.iter().take(self.count).filter(|leg| leg.length > 0.0) {
            let from = at;
            at += leg.gain();
            // What only touches does not count, unless there is nothing else.
            let within = from < b && at > a || a == b && from <= a && at >= b;
            if within {
                most = leg.softness.max(most);
            }
        }
        most
    }

    /// A held limit: from which gain to which, and its speed.
    fn hold(&self, limit: Limit, [a, b]: [f64; 2], [from, to]: [f64; 2]) -> (f64, f64, f64) {
        let up = a + self.ramp(from, limit.speed, |gain| (a, (a + gain).min(b)));
        let down = b - self.ramp(limit.speed, to, |gain| ((b - gain).max(a), b));
        if up <= down {
            // Where it holds, and where the ramps to it end beyond that.
            let (left, right) = (up.max(limit.from), down.min(limit.to));
            if left <= right {
                return (left, limit.speed, right);
            }
            let at = if up > limit.to { up } else { down };
            return (at, limit.speed, at);
        }
        // No room for both ramps: softness has to give way.
        let at = if from > to { limit.from } else { limit.to }.clamp(a, b);
        let speed = limit.speed.min((from * from + at - a).sqrt()).min((to * to + b - at).sqrt());
        (at, speed, at)
    }

    /// The lowest limit that a curve from a gain on is over, with all of the stretch where it holds: moves
    /// of one speed, joined where nothing is slower, are one.
    fn lowest_limit(&self, curve: &Curve, start: f64) -> Option<Limit> {
        let end = start + curve.whole();
        let over = |speed: f64, limit: f64| speed > limit * (1.0 + DIGITS);
        let mut found: Option<Limit> = None;
        let mut stretch: Option<(Limit, bool)> = None;
        let lower = |limit: Limit, found: &mut Option<Limit>| {
            if found.is_none_or(|other| limit.speed < other.speed) {
                *found = Some(limit);
            }
        };
        let mut at = 0.0;
        for (i, leg) in self.legs.iter().take(self.count).enumerate() {
            let (from, to) = (at, at + leg.gain());
            at = to;
            if to <= start || from >= end || leg.length <= 0.0 {
                continue;
            }
            let cap = leg.cap.sqrt();
            if i > 0 && from > start && over(curve.at(from - start).speed, cap) {
                lower(Limit { speed: cap, from, to: from }, &mut found);
            }
            let (a, b) = (from.max(start), to.min(end));
            let excess = over(curve.highest(a - start, b - start), leg.speed);
            let joined = |last: &Limit| {
                (last.speed - leg.speed).abs() <= DIGITS * last.speed && !over(last.speed, cap)
            };
            match &mut stretch {
                Some((last, exceeded)) if joined(last) => {
                    last.to = b;
                    *exceeded |= excess;
                }
                _ => {
                    if let Some((last, true)) = stretch {
                        lower(last, &mut found);
                    }
                    stretch = Some((Limit { speed: leg.speed, from: a, to: b }, excess));
                }
            }
        }
        if let Some((last, true)) = stretch {
            lower(last, &mut found);
        }
        found
    }

    /// Gives each leg its part of the curves.
    fn profiles(&self, curves: &[Curve], out: &mut impl FnMut(Profile)) {
        let mut curves = curves.iter();
        let Some(mut curve) = curves.next() else { return };
        // How far along it; where that is.
        let mut along = 0.0;
        let mut at = curve.at(0.0);
        let legs = || self.legs.iter().take(self.count);
        let last = legs().rposition(|leg| leg.length > 0.0);
        for (i, leg) in legs().enumerate() {
            // Near a stop, the last digit of a gain is a time that counts: the last leg takes what is left.
            let mut left = if Some(i) == last { f64::INFINITY } else { leg.gain() };
            let mut profile =
                Profile { entry: at.speed, peak: at.speed, exit: at.speed, ..Profile::default() };
            if leg.length <= 0.0 {
                out(Profile::default());
                continue;
            }
            loop {
                let more = curve.whole() - along;
                let whole = left >= more;
                let to = if whole { curve.whole() } else { along + left };
                let end = curve.at(to);
                let seconds = |i: usize| (end.times[i] - at.times[i]).max(0.0) / (2.0 * leg.acceleration);
                profile.t_accel += seconds(0);
                profile.t_cruise += seconds(1);
                profile.t_decel += seconds(2);
                profile.peak = profile.peak.max(curve.highest(along, to));
                (along, at) = (to, end);
                left -= more;
                if !whole {
                    break;
                }
                let Some(next) = curves.next() else { break };
                (curve, along, at) = (next, 0.0, next.at(0.0));
            }
            profile.exit = at.speed;
            out(profile);
        }
    }
}
