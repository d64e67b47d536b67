//! How fast a path may go through the junction of two moves.
//!
//! The rule is the junction deviation of grbl 1.1 (`planner.c`, `plan_buffer_line`): think of a circle
//! that touches both moves and comes no further from the corner than the path tolerance δ; its
//! radius is δ·sin(θ/2)/(1 − sin(θ/2)), θ being the angle between the moves (180° is straight on), and
//! v² is at most radius times acceleration. The acceleration is what the axes allow in the direction
//! in which the corner changes the velocity. The path itself is not rounded: its length stays.
//!
//! To that rule one is added: the circle may touch a move no further from the corner than its middle.
//! Without it, chords that follow a curve more closely than δ would be driven faster than the curve
//! itself; with it, v² is at most a·r on chords of a circle of radius r, as on the arc. Marlin 2 has
//! a like limit for short moves (`planner.cpp`, `HANDLE_SMALL_SEGMENTS`); here it has no threshold.
//! A straight line in several pieces counts as one move; so a corner may have to wait for what comes
//! after it.
//!
//! Between a move of linear axes and one of rotary axes alone is a stop: their speeds are not of one
//! kind. In other moves a degree counts as a millimetre, as in grbl.

use crate::corner;
use crate::limits::{Heading, Leg, Limits, Move, Shape};

/// Squared sine of half the change of direction up to which a line goes straight on: 2e-6 radians.
const STRAIGHT: f64 = 1e-12;

/// What is known of the path so far where the next move joins on.
#[derive(Clone, Copy, Debug)]
struct Last {
    shape: Shape,
    heading: Heading,
    speed: f64,
    /// Length of the straight line, or of the arc, that ends here.
    run: f64,
    /// How the corner is taken.
    corner: corner::Corner,
}

/// A corner that waits for the length of what comes after it.
#[derive(Clone, Copy, Debug)]
struct Corner {
    /// Square of the speed by all but that, (mm/s)².
    cap: f64,
    /// (mm/s)² for each mm of it.
    by_length: f64,
}

/// The junctions of a path: legs go in without a cap and come out with it, in order.
#[derive(Clone, Debug, Default)]
pub(crate) struct Junctions {
    last: Option<Last>,
    /// Legs that came after the corner; the first is the one with it.
    held: Vec<Leg>,
    corner: Option<Corner>,
}

impl Junctions {
    /// Takes a move, and how the corner at its end is taken.
    pub(crate) fn push(&mut self, m: &Move, end: corner::Corner, limits: &Limits, mut out: impl FnMut(Leg)) {
        let mut leg = m.leg;
        let mut run = leg.length;
        let ends = Last { shape: m.shape, heading: m.headings[1], speed: leg.speed, run, corner: end };
        let Some(last) = self.last else {
            // From rest.
            leg.cap = 0.0;
            self.last = Some(ends);
            return out(leg);
        };
        let slower = last.speed.min(leg.speed);
        leg.cap = slower * slower;
        if last.corner.stop || (last.shape == Shape::Turning) != (m.shape == Shape::Turning) {
            leg.cap = 0.0;
        }
        let turn = turn(&last.heading, &m.headings[0], limits);
        let mut corner = None;
        if turn.half_sine_squared <= STRAIGHT {
            let mut after = last.run;
            if last.shape == Shape::Straight && m.shape == Shape::Straight {
                run += last.run;
                after = run;
                if self.corner.is_some_and(|corner| corner.by_length * run < corner.cap) {
                    self.last = Some(Last { run, ..ends });
                    return self.held.push(leg);
                }
            }
            self.resolve(after, &mut out);
        } else {
            self.resolve(last.run, &mut out);
            if leg.cap > 0.0 {
                let (cap, by_length) = turn.caps(last.corner.tolerance);
                // A circle that begins so far from the corner touches its moves as one of twice the length does.
                let by_distance = by_length * 2.0 * last.corner.distance;
                leg.cap = leg.cap.min(cap).min(by_distance).min(by_length * last.run);
                if by_length * leg.length < leg.cap {
                    corner = Some(Corner { cap: leg.cap, by_length });
                }
            }
        }
        self.last = Some(Last { run, ..ends });
        self.corner = corner;
        match corner {
            Some(_) => self.held.push(leg),
            None => out(leg),
        }
    }

    /// Takes a function that takes no time, between moves.
    pub(crate) fn instant(&mut self, mut out: impl FnMut(Leg)) {
        match self.corner {
            Some(_) => self.held.push(Leg::INSTANT),
            None => out(Leg::INSTANT),
        }
    }

    /// The path ends in a stop.
    pub(crate) fn stop(&mut self, mut out: impl FnMut(Leg)) {
        if let Some(last) = self.last {
            self.resolve(last.run, &mut out);
        }
        self.last = None;
    }

    /// What comes after the corner is so long.
    fn resolve(&mut self, run: f64, out: &mut impl FnMut(Leg)) {
        if let Some(corner) = self.corner.take() {
            if let Some(first) = self.held.first_mut() {
                first.cap = corner.cap.min(corner.by_length * run);
            }
            self.held.iter().for_each(|leg| out(*leg));
            self.held.clear();
        }
    }
}

/// A change of direction.
struct Turn {
    half_sine_squared: f64,
    half_cosine: f64,
    /// How much an acceleration by the difference of the directions loads the axes.
    load: f64,
    /// Speed in the space of all axes for each unit along the path: the greater of both sides.
    stretch: f64,
}

#[inline]
fn turn(from: &Heading, to: &Heading, limits: &Limits) -> Turn {
    let stretch = from.stretch.max(to.stretch);
    // Where no rotary axis moves on either side, three axes are all.
    let (difference, sum, load) = if stretch == 1.0 {
        let (a, b) = ([0, 1, 2].map(|i| from.unit[i]), [0, 1, 2].map(|i| to.unit[i]));
        let (difference, sum, change) = squares(&a, &b);
        (difference, sum, limits.load_linear(&change))
    } else {
        let (difference, sum, change) = squares(&from.unit, &to.unit);
        (difference, sum, limits.load(&change))
    };
    Turn { half_sine_squared: difference / 4.0, half_cosine: sum.sqrt() / 2.0, load, stretch }
}

/// Squared lengths of the difference and of the sum of two directions, and the difference. From these
/// an angle is exact for the smallest, where a cosine is 1, and at a reversal, where it is -1.
#[inline]
fn squares<const N: usize>(from: &[f64; N], to: &[f64; N]) -> (f64, f64, [f64; N]) {
    let change: [f64; N] = std::array::from_fn(|i| to[i] - from[i]);
    let (mut difference, mut sum) = (0.0, 0.0);
    for ((from, to), change) in from.iter().zip(to).zip(&change) {
        difference += change * change;
        sum += (from + to) * (from + to);
    }
    (difference, sum, change)
}

impl Turn {
    /// Squares of the speed: by the tolerance, and for each mm of the shorter move.
    #[inline]
    fn caps(&self, tolerance: f64) -> (f64, f64) {
        // The sine of half the turn is the cosine of θ/2. The acceleration along the change of direction,
        // made a unit vector, is 2·cos(θ/2) over the load of the change itself; radius by radius, what
        // can be is multiplied out: divisions are dear. 1 / (1 − sin) is (1 + sin) / cos², without the
        // difference of two numbers near 1.
        let (squared, sine) = (self.half_sine_squared, self.half_cosine);
        let each = 1.0 / (self.load * self.stretch * self.stretch);
        let by_tolerance = 2.0 * tolerance * sine * (1.0 + sine) / squared.sqrt();
        (by_tolerance * each, sine * each)
    }
}
