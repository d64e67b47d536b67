//! The tool centre path beside a contour, in a plane: lines and arcs at the tool's radius.
//!
//! Each leg of the contour is offset by the radius; a corner away from the tool is gone round by
//! an arc about it, at one towards the tool both legs end where their paths meet. One leg is held until
//! the next is known, because a corner may shorten it. The rules are those of RS274/NGC in its present
//! form (LinuxCNC, `interp_convert.cc` and `interp_queue.cc`; NISTIR 6556, appendix B): how the tool goes
//! onto the contour, which corners are gone round, and what cannot be reached without cutting into the
//! contour. Only legs that meet are looked at, as there: not whether the path crosses itself further on.
//!
//! Not here: statements and events, and what stands between the moves.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A point of the plane, mm.
pub type Spot = [f64; 2];

/// What differs from control to control.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// Corners of no more than this, in radians, are neither gone round nor cut short.
    pub shallow: f64,
    /// Shortest way round a corner, mm: a shorter one is left out.
    pub least: f64,
    /// The first move after the contour goes to the programmed point of the plane, whatever words it has; otherwise
    /// the first that has words of the plane does.
    pub left_at_once: bool,
    /// Whether every leg is looked at for having been turned round, and not only where the interpreter does.
    pub strict: bool,
}

impl Rules {
    /// Those of LinuxCNC's interpreter.
    pub const INTERPRETER: Rules = Rules { shallow: 0.05, least: 0.0, left_at_once: true, strict: false };

    /// For controls that say no more than that the tool goes beside the contour: as near to it as can be
    /// written.
    pub const NEAR: Rules = Rules { shallow: 0.002, least: 0.005, left_at_once: false, strict: true };
}

impl Default for Rules {
    fn default() -> Rules {
        Rules::NEAR
    }
}

/// Why a contour cannot be gone along.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unreachable {
    /// The first move is not longer than the radius.
    Entry,
    /// An arc with the tool inside is not larger than the tool.
    SmallArc,
    /// A straight leg is shorter than what its corners take from it.
    ShortLine,
    /// An arc is shorter than what its corners take from it.
    ShortArc,
    /// Two paths do not meet at an inner corner.
    NoMeeting,
    /// A line turns straight back towards the tool.
    TurnedBack,
}

/// A leg of the contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Leg {
    /// Straight; rapid or not.
    Line {
        /// Whether it is a rapid move, which goes round no corner in an arc.
        rapid: bool,
    },
    /// An arc about a centre.
    Arc {
        /// The centre.
        centre: Spot,
        /// Whether it goes counter-clockwise.
        ccw: bool,
        /// Full turns beyond the first, partial one.
        turns: u32,
    },
}

/// What follows from a further leg.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Where the leg before it ends.
    pub end: Spot,
    /// The way round the corner that follows.
    pub round: Option<Round>,
}

/// The way round a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Round {
    /// The corner: the centre of the arc.
    pub centre: Spot,
    /// Its end, where the further leg begins.
    pub to: Spot,
    /// Whether it goes counter-clockwise.
    pub ccw: bool,
    /// Whether it is a straight rapid move instead.
    pub straight: bool,
}

/// The leg whose end is not settled.
#[derive(Clone, Copy, Debug)]
struct Held {
    /// Where its path begins.
    start: Spot,
    way: Way,
}

#[derive(Clone, Copy, Debug)]
enum Way {
    /// It must not be turned against this direction.
    Line(Spot),
    /// It must not sweep more than this.
    Arc { centre: Spot, ccw: bool, sweep: f64 },
}

/// The path as far as it is known.
#[derive(Clone, Copy, Debug)]
pub struct OffsetPath {
    radius: f64,
    /// 1 to the left of the contour, -1 to its right.
    side: f64,
    rules: Rules,
    /// End of the last leg, as programmed.
    at: Spot,
    /// The same on the path, as long as no corner shortens it.
    now: Spot,
    held: Held,
}

fn minus(a: Spot, b: Spot) -> Spot {
    [a[0] - b[0], a[1] - b[1]]
}

fn along(from: Spot, angle: f64, by: f64) -> Spot {
    [from[0] + by * angle.cos(), from[1] + by * angle.sin()]
}

fn angle(v: Spot) -> f64 {
    v[1].atan2(v[0])
}

fn length(v: Spot) -> f64 {
    v[0].hypot(v[1])
}

fn dot(a: Spot, b: Spot) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

/// How far an arc sweeps, radians: more than 0, a full turn if both points are one.
fn sweep(start: Spot, end: Spot, centre: Spot, ccw: bool) -> f64 {
    if start == end {
        return TAU;
    }
    let by = angle(minus(end, centre)) - angle(minus(start, centre));
    let forwards = if ccw { by } else { -by };
    match forwards.rem_euclid(TAU) {
        0.0 => TAU,
        part => part,
    }
}

impl OffsetPath {
    /// Goes onto the contour by a straight move: to the left of its end or to the right, at right angles.
    /// The path's first leg ends there as long as nothing else follows.
    ///
    /// # Errors
    /// [`Unreachable::Entry`].
    pub fn enter(
        radius: f64,
        left: bool,
        rules: Rules,
        from: Spot,
        to: Spot,
    ) -> Result<OffsetPath, Unreachable> {
        let way = minus(to, from);
        if length(way) <= radius {
            return Err(Unreachable::Entry);
        }
        let side = if left { 1.0 } else { -1.0 };
        let sideways = angle(way) + side * FRAC_PI_2;
        // It may be cut short, but never so that it goes to the other side.
        let direction = if rules.strict { way } else { along([0.0; 2], sideways, 1.0) };
        let held = Held { start: from, way: Way::Line(direction) };
        Ok(OffsetPath { radius, side, rules, at: to, now: along(to, sideways, radius), held })
    }

    /// Where the tool is, beside the programmed point, at the end of the last leg.
    pub fn now(&self) -> Spot {
        self.now
    }

    /// A further leg of the contour, to a point that is not the last one unless it is a full circle.
    ///
    /// # Errors
    /// The tool cannot go there without cutting into the contour.
    pub fn go_on(&mut self, leg: Leg, to: Spot) -> Result<Corner, Unreachable> {
        let towards_tool = self.side * FRAC_PI_2;
        // Directions of the contour before the corner and after it.
        let before = angle(minus(self.now, self.at)) - towards_tool;
        let behind = match leg {
            Leg::Line { .. } => angle(minus(to, self.at)),
            Leg::Arc { centre, ccw, .. } => {
                angle(minus(centre, self.at)) + if ccw { -FRAC_PI_2 } else { FRAC_PI_2 }
            }
        };
        // How far it turns away from the tool: from -90° to 270°, beyond 180° it is towards it.
        let away = (self.side * (before - behind) + FRAC_PI_2).rem_euclid(TAU) - FRAC_PI_2;
        let inside = |ccw: bool| ccw == (self.side > 0.0);
        let after_hump = matches!(self.held.way, Way::Arc { ccw, .. } if !inside(ccw));
        let onto_hump = matches!(leg, Leg::Arc { ccw, .. } if !inside(ccw));
        let shallow = self.rules.shallow;
        let cusp = match leg {
            // Down from a hump and straight back up beside it.
            Leg::Line { .. } => after_hump && away > PI - shallow,
            Leg::Arc { .. } => onto_hump && (away - PI).abs() < shallow,
        };
        let concave = away < -shallow || away > PI + shallow || cusp;
        let to_left = along(self.at, behind + towards_tool, self.radius);
        let chord = length(minus(to_left, self.now));
        let (end, round) = if concave {
            (self.meeting(leg, before, behind, away, to)?, None)
        } else if away > shallow && chord > self.rules.least {
            let straight = leg == Leg::Line { rapid: true };
            let round = Round { centre: self.at, to: to_left, ccw: self.side < 0.0, straight };
            (self.now, Some(round))
        } else {
            (self.now, None)
        };
        if self.rules.strict || concave || round.is_some() && matches!(leg, Leg::Line { .. }) {
            self.check(end)?;
        }
        let start = round.map_or(end, |round| round.to);
        let (now, way) = match leg {
            Leg::Line { .. } => {
                (along(to, behind + towards_tool, self.radius), Way::Line(minus(to, self.at)))
            }
            Leg::Arc { centre, ccw, turns } => {
                let out = minus(to, centre);
                if inside(ccw) && length(out) <= self.radius {
                    return Err(Unreachable::SmallArc);
                }
                let by = if inside(ccw) { -self.radius } else { self.radius };
                let mut now = along(to, angle(out), by);
                if to == self.at && !concave && length(minus(now, start)) < 0.01 {
                    // A full circle comes back to where it began.
                    now = start;
                }
                let sweep = sweep(self.at, to, centre, ccw) + TAU * f64::from(turns);
                (now, Way::Arc { centre, ccw, sweep })
            }
        };
        self.held = Held { start, way };
        (self.at, self.now) = (to, now);
        Ok(Corner { end, round })
    }

    /// Ends the last leg beside its programmed end.
    ///
    /// # Errors
    /// Its corners take more of it than there is.
    pub fn leave(&self) -> Result<Spot, Unreachable> {
        self.check(self.now)?;
        Ok(self.now)
    }

    /// Whether the held leg still goes forwards, if it ends there.
    fn check(&self, end: Spot) -> Result<(), Unreachable> {
        let start = self.held.start;
        match self.held.way {
            Way::Line(direction) if dot(direction, minus(end, start)) < 0.0 => Err(Unreachable::ShortLine),
            Way::Line(_) => Ok(()),
            Way::Arc { centre, ccw, sweep: most } => {
                let most = most.rem_euclid(TAU);
                let most = if most == 0.0 { TAU } else { most };
                let own = length(minus(end, centre));
                // A shallow corner before it may have left the beginning a little early.
                let early =
                    if self.rules.strict { 2.0 * self.rules.shallow * self.radius / own } else { 0.0 };
                match sweep(start, end, centre, ccw) > most + 0.001 + early.min(0.05) {
                    true => Err(Unreachable::ShortArc),
                    false => Ok(()),
                }
            }
        }
    }

    /// Where the held path and that of the next leg meet: going back from the end of the held one, the
    /// first point of the next.
    fn meeting(&self, leg: Leg, before: f64, behind: f64, away: f64, to: Spot) -> Result<Spot, Unreachable> {
        let inside = |ccw: bool| ccw == (self.side > 0.0);
        let circle = |centre: Spot, ccw: bool| -> Result<f64, Unreachable> {
            // Rounded words make a spiral: near is what counts here.
            let by = if self.rules.strict { self.at } else { to };
            let radius = length(minus(by, centre));
            match inside(ccw) {
                true if radius <= self.radius => Err(Unreachable::SmallArc),
                true => Ok(radius - self.radius),
                false => Ok(radius + self.radius),
            }
        };
        let first_back = |found: [Spot; 2], back: &dyn Fn(Spot) -> f64| {
            if back(found[0]) <= back(found[1]) { found[0] } else { found[1] }
        };
        match (self.held.way, leg) {
            (Way::Line(_), Leg::Line { .. }) => {
                let half = (away + PI) / 2.0;
                let tangent = half.tan();
                if tangent.abs() < 1e-9 {
                    return Err(Unreachable::TurnedBack);
                }
                Ok(along(self.now, before, -self.radius / tangent))
            }
            (Way::Line(_), Leg::Arc { centre, ccw, .. }) => {
                let own = circle(centre, ccw)?;
                let found = line_and_circle(self.now, before, centre, own)?;
                let back = |spot: Spot| backwards(-dot(minus(spot, self.now), along([0.0; 2], before, 1.0)));
                Ok(first_back(found, &back))
            }
            (Way::Arc { centre, ccw, .. }, leg) => {
                let own = length(minus(self.now, centre));
                let found = match leg {
                    Leg::Line { .. } => {
                        let start = along(self.at, behind + self.side * FRAC_PI_2, self.radius);
                        line_and_circle(start, behind, centre, own)?
                    }
                    Leg::Arc { centre: next, ccw, .. } => two_circles(centre, own, next, circle(next, ccw)?)?,
                };
                let back = |spot: Spot| {
                    let by = sweep(spot, self.now, centre, ccw) * own;
                    let around = TAU * own;
                    // Going back nearly all the way round is a little forwards.
                    if around - by < FORWARDS { around - by } else { by }
                };
                Ok(first_back(found, &back))
            }
        }
    }
}

/// How far forwards two paths may meet, mm: where they are nearly tangent, rounded words make that much.
const FORWARDS: f64 = 0.05;

/// A distance backwards; farther forwards than rounding explains is farther than any.
fn backwards(by: f64) -> f64 {
    if by < -FORWARDS { f64::INFINITY } else { by.abs() }
}

/// Both points where a line through a point in a direction meets a circle.
fn line_and_circle(point: Spot, direction: f64, centre: Spot, radius: f64) -> Result<[Spot; 2], Unreachable> {
    let unit = along([0.0; 2], direction, 1.0);
    let nearest = dot(minus(centre, point), unit);
    let foot = along(point, direction, nearest);
    let off = length(minus(centre, foot));
    if off > radius {
        return Err(Unreachable::NoMeeting);
    }
    let half = (radius * radius - off * off).max(0.0).sqrt();
    Ok([along(foot, direction, half), along(foot, direction, -half)])
}

/// Both points where two circles meet.
fn two_circles(a: Spot, of_a: f64, b: Spot, of_b: f64) -> Result<[Spot; 2], Unreachable> {
    let between = length(minus(b, a));
    if between == 0.0 || of_a == 0.0 {
        return Err(Unreachable::NoMeeting);
    }
    let cosine = (of_a * of_a + between * between - of_b * of_b) / (2.0 * of_a * between);
    if cosine.abs() > 1.0 {
        return Err(Unreachable::NoMeeting);
    }
    let (towards, aside) = (angle(minus(b, a)), cosine.acos());
    Ok([along(a, towards + aside, of_a), along(a, towards - aside, of_a)])
}
