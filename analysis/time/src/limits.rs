//! What a machine allows along a move: speed, acceleration, and how long acceleration takes to build.
//!
//! A move has one direction in the space of all axes, and each axis bears its share of it: along a
//! unit direction `u`, no axis exceeds its limit while `v ≤ limit / |u|` for each. So do the planners
//! of public controls (grbl 1.1, `nuts_bolts.c`, `limit_value_by_axis_maximum`). Lengths are those of
//! the linear axes, as feeds are; a rotary axis has a share in degrees a millimetre.
//!
//! An arc is one move with a curvature: each axis of its plane bears the whole of the speed and of
//! the acceleration at some point of a circle, so the weaker one counts, for the centripetal
//! acceleration `v² / r` too. That and the acceleration along the path are not added up.

use ncc_exec::Movement;
use ncc_ir::canon::{AXES, Plane};
use ncc_ir::expr::num::Nanos;

use crate::act::Act;
use crate::machine::Machine;
use crate::path::{Path, Round, arc, laid, line, units};

/// Seconds in a minute.
const MINUTE: f64 = 60.0;

/// What a planner must know of a move, or of a function that is over in no time: then there is no
/// length and no limit.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Leg {
    /// mm; degrees of a move of rotary axes alone.
    pub(crate) length: f64,
    /// Highest speed, mm/s.
    pub(crate) speed: f64,
    /// Along the path, mm/s².
    pub(crate) acceleration: f64,
    /// What the speed changes by while acceleration is built up and taken back, mm/s: a²/jerk. 0 where
    /// acceleration is there at once.
    pub(crate) softness: f64,
    /// Square of the highest speed at its start, (mm/s)².
    pub(crate) cap: f64,
}

impl Leg {
    /// A function between moves that takes no time and stops nothing.
    pub(crate) const INSTANT: Leg =
        Leg { length: 0.0, speed: f64::INFINITY, acceleration: 1.0, softness: 0.0, cap: f64::INFINITY };

    /// What the square of the speed may change by on it, (mm/s)².
    pub(crate) fn gain(&self) -> f64 {
        2.0 * self.acceleration * self.length
    }
}

/// Direction of a path at a point, in the space of all axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Heading {
    /// Of length 1.
    pub(crate) unit: [f64; AXES],
    /// Speed in that space for each unit of speed along the path: 1 where no rotary axis moves.
    pub(crate) stretch: f64,
}

/// What a move is at its junctions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shape {
    /// A straight line.
    Straight,
    /// An arc.
    Bent,
    /// Rotary axes alone: its speed is in degrees a second.
    Turning,
}

/// A move with its limits; the cap of its start is not known yet.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Move {
    pub(crate) leg: Leg,
    pub(crate) shape: Shape,
    /// Direction at the start, and at the end.
    pub(crate) headings: [Heading; 2],
}

/// A machine's limits, prepared: what a share is multiplied by, 0 where there is no limit.
#[derive(Clone, Debug)]
pub(crate) struct Limits {
    rapid: [f64; AXES],
    feed: [f64; AXES],
    acceleration: [f64; AXES],
    /// Seconds in which each axis builds up its acceleration.
    build_up: [f64; AXES],
    rapid_line: f64,
    most_feed: f64,
    block: f64,
    soft: bool,
}

impl Limits {
    /// Of a machine; `soft` where jerk counts.
    pub(crate) fn new(machine: &Machine, soft: bool) -> Limits {
        let inverse = |limit: Option<f64>, unit: f64| limit.map_or(0.0, |limit| unit / limit);
        let rapid = machine.axes.map(|axis| inverse(axis.rapid_rate, MINUTE));
        Limits {
            // An axis is no faster at feed than in a rapid.
            feed: std::array::from_fn(|i| rapid[i].max(inverse(machine.axes[i].max_feed, MINUTE))),
            acceleration: machine.axes.map(|axis| inverse(axis.acceleration, 1.0)),
            build_up: machine.axes.map(|axis| match (axis.acceleration, axis.jerk) {
                (Some(acceleration), Some(jerk)) if soft => acceleration / jerk,
                _ => 0.0,
            }),
            rapid,
            rapid_line: machine.rapid_rate.map_or(f64::INFINITY, |rate| rate / MINUTE),
            most_feed: machine.max_feed.map_or(f64::INFINITY, |rate| rate / MINUTE),
            block: machine.block.unwrap_or(0.0),
            soft,
        }
    }

    /// The greatest softness that a move can have: along no direction is acceleration more than all axes'
    /// together, or built up more slowly than by the slowest.
    pub(crate) fn softest(&self) -> f64 {
        let build_up = self.build_up.iter().fold(0.0, |a: f64, b| a.max(*b));
        let together = |axes: std::ops::Range<usize>| {
            self.acceleration[axes].iter().map(|inverse| 1.0 / (inverse * inverse)).sum::<f64>().sqrt()
        };
        build_up * together(0..3).max(together(3..AXES))
    }

    /// How much an acceleration in a direction of all axes loads them: 1 is the most that they bear.
    pub(crate) fn load(&self, direction: &[f64; AXES]) -> f64 {
        load(direction, &self.acceleration)
    }

    /// The same, where no rotary axis takes part.
    pub(crate) fn load_linear(&self, direction: &[f64; 3]) -> f64 {
        load_linear(direction, &self.acceleration)
    }

    /// A move, if it is one and goes anywhere.
    #[inline]
    pub(crate) fn movement(&self, act: &Act) -> Option<Move> {
        let event = &act.event;
        match event.kind.moves()? {
            Movement::Rapid => self.straight(line(&event.end, &act.from), self.rapid_line, &self.rapid),
            Movement::Feed => self.straight(line(&event.end, &act.from), self.wanted(event.rate), &self.feed),
            Movement::Arc { plane, turn, full, centre } => {
                let round = Round { plane, turn, full, centre };
                self.bent(arc(&round, &event.end, &act.from), plane, self.wanted(event.rate))
            }
        }
    }

    /// The speed that a feed asks for.
    #[inline]
    fn wanted(&self, rate: Nanos) -> f64 {
        if rate > 0 { self.most_feed.min(units(rate) / MINUTE) } else { self.most_feed }
    }

    /// A straight move, at most at such a speed, its axes within their rates.
    #[inline]
    fn straight(&self, way: Path, wanted: f64, rates: &[f64; AXES]) -> Option<Move> {
        if way.length <= 0.0 {
            return None;
        }
        let [x, y, z, a, b, c] = way.change;
        if a == 0.0 && b == 0.0 && c == 0.0 {
            let headings = [Heading::linear(way.heading_from); 2];
            let linear = [x, y, z];
            let speed = wanted.min(way.length / load_linear(&linear, rates));
            let acceleration = way.length / load_linear(&linear, &self.acceleration);
            return Some(Move {
                leg: self.leg(&way, &way.change, speed, acceleration),
                shape: Shape::Straight,
                headings,
            });
        }
        let linear = x != 0.0 || y != 0.0 || z != 0.0;
        let heading = if linear { way.heading(way.heading_from) } else { Heading::linear([0.0; 3]) };
        let speed = wanted.min(way.length / load(&way.change, rates));
        let acceleration = way.length / load(&way.change, &self.acceleration);
        Some(Move {
            leg: self.leg(&way, &way.change, speed, acceleration),
            shape: if linear { Shape::Straight } else { Shape::Turning },
            headings: [heading; 2],
        })
    }

    /// An arc, at most at such a speed.
    #[inline]
    fn bent(&self, way: Path, plane: Plane, wanted: f64) -> Option<Move> {
        if way.length <= 0.0 {
            return None;
        }
        let (f, s, n) = plane.axes();
        // What each axis would travel at its fastest: those of the plane, where the arc runs along them.
        let round = way.radius * way.sweep;
        let [x, y, z] = laid(plane, [round, round, way.change[n as usize]]);
        let travel = [x, y, z, way.change[3], way.change[4], way.change[5]];
        let inward = 1.0 / self.acceleration[f as usize].max(self.acceleration[s as usize]);
        let speed = wanted
            .min(way.length / load(&travel, &self.feed))
            .min((inward * way.radius).sqrt() * way.length / round);
        let acceleration = way.length / load(&travel, &self.acceleration);
        let headings = if way.turns() {
            [way.heading(way.heading_from), way.heading(way.heading_to)]
        } else {
            [Heading::linear(way.heading_from), Heading::linear(way.heading_to)]
        };
        Some(Move { leg: self.leg(&way, &travel, speed, acceleration), shape: Shape::Bent, headings })
    }

    /// The leg of a move, its cap not known yet.
    #[inline]
    fn leg(&self, way: &Path, travel: &[f64; AXES], speed: f64, acceleration: f64) -> Leg {
        // A control that needs so long for a block feeds no faster than blocks come.
        let speed = if self.block > 0.0 { speed.min(way.length / self.block) } else { speed };
        let mut softness = 0.0;
        if self.soft {
            // The slowest axis that moves sets the time in which acceleration is built up.
            let moving = (0..AXES).filter(|i| travel[*i] != 0.0);
            softness = acceleration * moving.fold(0.0, |most: f64, i| most.max(self.build_up[i]));
        }
        Leg { length: way.length, speed, acceleration, softness, cap: 0.0 }
    }
}

/// The largest part of its limit that an axis bears; its inverse is the limit along a direction.
fn load(direction: &[f64; AXES], inverse_limits: &[f64; AXES]) -> f64 {
    // As an expression, without a branch: which axis counts changes from move to move.
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let load = |i: usize| direction[i].abs() * inverse_limits[i];
    larger(larger(larger(load(0), load(1)), larger(load(2), load(3))), larger(load(4), load(5)))
}

/// The same, where no rotary axis takes part.
fn load_linear(direction: &[f64; 3], inverse_limits: &[f64; AXES]) -> f64 {
    let larger = |a: f64, b: f64| if a > b { a } else { b };
    let load = |i: usize| direction[i].abs() * inverse_limits[i];
    larger(larger(load(0), load(1)), load(2))
}

impl Path {
    /// Whether rotary axes take part.
    fn turns(&self) -> bool {
        self.change[3..].iter().any(|change| *change != 0.0)
    }

    /// A direction of its linear axes with the share of the rotary ones.
    fn heading(&self, [x, y, z]: [f64; 3]) -> Heading {
        let [a, b, c] = [3, 4, 5].map(|i: usize| self.change[i] / self.length);
        let stretch = (1.0 + a * a + b * b + c * c).sqrt();
        Heading { unit: [x, y, z, a, b, c].map(|u| u / stretch), stretch }
    }
}

impl Heading {
    /// Of linear axes alone.
    fn linear([x, y, z]: [f64; 3]) -> Heading {
        Heading { unit: [x, y, z, 0.0, 0.0, 0.0], stretch: 1.0 }
    }
}
