//! What is put between two moves of a plane to round their corner, or to chamfer it.
//!
//! One definition for execution and for passes. Lengths are nanos; the geometry passes through floats,
//! and its points are rounded to a nano. A corner between two arcs, or an arc and a line, can be rounded;
//! what a chamfer beside an arc is, controls do not say in one way, and it is refused.

use crate::canon::{CornerShape, Turn};
use crate::diag::Fault;
use crate::expr::num::{Nanos, ONE};
use crate::geometry;
use crate::program::Op;
use crate::unexecuted::{CornerUnexecuted, NoCorner};

/// A move of the plane.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leg {
    /// Where it begins.
    pub from: [Nanos; 2],
    /// Where it ends.
    pub to: [Nanos; 2],
    /// Sense and centre, if it is an arc; of less than a whole turn.
    pub bend: Option<(Turn, [Nanos; 2])>,
}

/// What is put between two moves: the first ends where it begins, the second begins where it ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inserted {
    /// Where it begins.
    pub from: [Nanos; 2],
    /// Where it ends.
    pub to: [Nanos; 2],
    /// Sense and centre, if it is an arc.
    pub bend: Option<(Turn, [Nanos; 2])>,
}

/// Why there is no such corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CornerFault {
    /// The second move goes back the way of the first.
    Back,
    /// The moves change direction by less than a degree: some controls put nothing there.
    Slight,
    /// One of the moves is shorter than the corner takes.
    TooLarge,
    /// A chamfer beside an arc.
    ChamferAtArc,
}

impl CornerFault {
    /// Its fault: no control makes the corner, or controls do not agree about it.
    pub fn fault(self) -> Fault {
        match self {
            CornerFault::Back => Fault::NoCorner { why: NoCorner::TurnsBack },
            CornerFault::TooLarge => Fault::NoCorner { why: NoCorner::TooLarge },
            CornerFault::Slight => Fault::not_executed(CornerUnexecuted::Slight),
            CornerFault::ChamferAtArc => Fault::not_executed(CornerUnexecuted::ChamferAtArc),
        }
    }
}

/// How far a computed point may be from where it is.
const SLACK: f64 = 1000.0;

/// Below this angle the moves are tangent, as far as their digits say.
const TANGENT: f64 = 0.01;

type Vector = [f64; 2];

fn vector(from: [Nanos; 2], to: [Nanos; 2]) -> Vector {
    [(to[0] - from[0]) as f64, (to[1] - from[1]) as f64]
}

fn length(v: Vector) -> f64 {
    v[0].hypot(v[1])
}

fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Vector, b: Vector) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn unit(v: Vector) -> Vector {
    let length = length(v);
    [v[0] / length, v[1] / length]
}

impl Leg {
    /// Direction of the leg at one of its ends.
    fn direction(&self, at: [Nanos; 2]) -> Vector {
        unit(match self.bend {
            None => vector(self.from, self.to),
            Some((turn, centre)) => geometry::tangent(at, centre, turn),
        })
    }

    /// How far the way along it is from a point of it to another.
    fn way(&self, from: Vector, to: Vector) -> f64 {
        match self.bend {
            None => dot([to[0] - from[0], to[1] - from[1]], self.direction(self.from)),
            Some((turn, centre)) => {
                let radius = length(vector(centre, self.from));
                let angle = |p: Vector| (p[1] - centre[1] as f64).atan2(p[0] - centre[0] as f64);
                let by = match turn {
                    Turn::Counterclockwise => angle(to) - angle(from),
                    Turn::Clockwise => angle(from) - angle(to),
                };
                let by = by.rem_euclid(std::f64::consts::TAU);
                // Nothing, as floats have it.
                let by = if by * radius > std::f64::consts::TAU * radius - SLACK { 0.0 } else { by };
                by * radius
            }
        }
    }
}

fn wide(p: [Nanos; 2]) -> Vector {
    [p[0] as f64, p[1] as f64]
}

fn nearest(p: Vector) -> [Nanos; 2] {
    [p[0].round() as Nanos, p[1].round() as Nanos]
}

/// What is put between two moves, the second of which begins where the first ends; `None` where they are
/// tangent, and nothing is.
///
/// # Errors
/// What no such corner has.
pub fn between(
    before: &Leg,
    after: &Leg,
    shape: CornerShape,
    size: Nanos,
) -> Result<Option<Inserted>, CornerFault> {
    let (u, v) = (before.direction(before.to), after.direction(after.from));
    let angle = cross(u, v).atan2(dot(u, v)).to_degrees();
    if angle.abs() < TANGENT {
        return Ok(None);
    }
    if angle.abs() > 180.0 - TANGENT {
        return Err(CornerFault::Back);
    }
    if angle.abs() < 1.0 {
        return Err(CornerFault::Slight);
    }
    let left = angle > 0.0;
    let corner = wide(before.to);
    let size = size as f64;
    let round = shape == CornerShape::Round;
    if !round && (before.bend.is_some() || after.bend.is_some()) {
        return Err(CornerFault::ChamferAtArc);
    }
    if before.bend.is_none() && after.bend.is_none() {
        // Tangent of half the angle, and the cosine of it.
        let half = cross(u, v).abs() / (1.0 + dot(u, v));
        let reach = match shape {
            CornerShape::Round => size * half,
            CornerShape::Leg => size,
            CornerShape::Length => size / (2.0 * (1.0 / half.hypot(1.0))),
        };
        let from = [corner[0] - u[0] * reach, corner[1] - u[1] * reach];
        let to = [corner[0] + v[0] * reach, corner[1] + v[1] * reach];
        let side = if left { size } else { -size };
        let centre = [from[0] - u[1] * side, from[1] + u[0] * side];
        return made(before, after, from, to, round.then_some((left, centre))).map(Some);
    }
    let mut best: Option<(f64, Result<Inserted, CornerFault>)> = None;
    for centre in centres(before, after, u, v, left, size).into_iter().flatten() {
        let from = foot(before, corner, u, centre);
        let to = foot(after, corner, v, centre);
        let found = made(before, after, from, to, Some((left, centre)));
        let far = length([centre[0] - corner[0], centre[1] - corner[1]]);
        if found.is_ok() && best.as_ref().is_none_or(|(other, _)| far < *other) {
            best = Some((far, found));
        }
    }
    match best {
        Some((_, found)) => found.map(Some),
        None => Err(CornerFault::TooLarge),
    }
}

/// The corner, if both moves are long enough for it.
fn made(
    before: &Leg,
    after: &Leg,
    from: Vector,
    to: Vector,
    bend: Option<(bool, Vector)>,
) -> Result<Inserted, CornerFault> {
    let corner = wide(before.to);
    let rest = [before.way(wide(before.from), corner) - before.way(from, corner), {
        after.way(corner, wide(after.to)) - after.way(corner, to)
    }];
    if rest.iter().any(|rest| *rest < -SLACK) {
        return Err(CornerFault::TooLarge);
    }
    let sense = |left| if left { Turn::Counterclockwise } else { Turn::Clockwise };
    Ok(Inserted {
        from: if rest[0] < SLACK { before.from } else { nearest(from) },
        to: if rest[1] < SLACK { after.to } else { nearest(to) },
        bend: bend.map(|(left, centre)| (sense(left), nearest(centre))),
    })
}

/// Where a circle that touches a leg from this centre does so.
fn foot(leg: &Leg, corner: Vector, along: Vector, centre: Vector) -> Vector {
    match leg.bend {
        None => {
            let by = dot([centre[0] - corner[0], centre[1] - corner[1]], along);
            [corner[0] + along[0] * by, corner[1] + along[1] * by]
        }
        Some((_, middle)) => {
            let radius = length(vector(middle, leg.from));
            let middle = wide(middle);
            let out = unit([centre[0] - middle[0], centre[1] - middle[1]]);
            [middle[0] + out[0] * radius, middle[1] + out[1] * radius]
        }
    }
}

/// What a leg is, moved sideways: all points from which a circle of that size touches it on its side.
enum Beside {
    Line { through: Vector, along: Vector },
    Circle { about: Vector, radius: f64 },
}

/// Centres of circles that touch both legs, on the side to which the way turns.
fn centres(before: &Leg, after: &Leg, u: Vector, v: Vector, left: bool, size: f64) -> [Option<Vector>; 2] {
    let corner = wide(before.to);
    let side = if left { size } else { -size };
    let beside = |leg: &Leg, along: Vector| match leg.bend {
        None => {
            let through = [corner[0] - along[1] * side, corner[1] + along[0] * side];
            Some(Beside::Line { through, along })
        }
        Some((turn, centre)) => {
            let inside = left == (turn == Turn::Counterclockwise);
            let radius = length(vector(centre, leg.from)) + if inside { -size } else { size };
            (radius > 0.0).then(|| Beside::Circle { about: wide(centre), radius })
        }
    };
    match (beside(before, u), beside(after, v)) {
        (Some(Beside::Line { through, along }), Some(Beside::Circle { about, radius }))
        | (Some(Beside::Circle { about, radius }), Some(Beside::Line { through, along })) => {
            let by = dot([about[0] - through[0], about[1] - through[1]], along);
            let off = cross(along, [about[0] - through[0], about[1] - through[1]]);
            let reach = radius * radius - off * off;
            if reach < 0.0 {
                return [None, None];
            }
            let at = |by: f64| Some([through[0] + along[0] * by, through[1] + along[1] * by]);
            [at(by - reach.sqrt()), at(by + reach.sqrt())]
        }
        (Some(Beside::Circle { about: a, radius: r }), Some(Beside::Circle { about: b, radius: s })) => {
            let apart = [b[0] - a[0], b[1] - a[1]];
            let distance = length(apart);
            if distance == 0.0 {
                return [None, None];
            }
            let along = (distance * distance + r * r - s * s) / (2.0 * distance);
            let reach = r * r - along * along;
            if reach < 0.0 {
                return [None, None];
            }
            let (reach, way) = (reach.sqrt(), unit(apart));
            let at =
                |by: f64| Some([a[0] + way[0] * along - way[1] * by, a[1] + way[1] * along + way[0] * by]);
            [at(reach), at(-reach)]
        }
        _ => [None, None],
    }
}

/// Whether a statement may stand between the two moves of a corner: a setting that changes nothing of
/// what they are.
pub fn may_stand_between(op: &Op) -> bool {
    matches!(
        op,
        Op::Comment(_)
            | Op::NoEffect(_)
            | Op::Blank
            | Op::Lines(_)
            | Op::Label(_)
            | Op::SetFeedRate(_)
            | Op::SetDistanceMode(_)
            | Op::SelectPlane(_)
            | Op::SetReturnLevel(_)
            | Op::SetPole(_)
            | Op::UseLengthUnits(_)
            | Op::ExactStop
    )
}

/// The largest size, 100 km: what is larger is a slip of the pen.
pub const LARGEST: Nanos = 100_000_000 * ONE;

#[cfg(test)]
mod tests {
    use super::*;

    fn mm(x: f64, y: f64) -> [Nanos; 2] {
        [(x * ONE as f64).round() as Nanos, (y * ONE as f64).round() as Nanos]
    }

    fn line(from: [Nanos; 2], to: [Nanos; 2]) -> Leg {
        Leg { from, to, bend: None }
    }

    fn round(size: f64, before: Leg, after: Leg) -> Result<Option<Inserted>, CornerFault> {
        between(&before, &after, CornerShape::Round, mm(size, 0.0)[0])
    }

    #[test]
    fn square_corners_are_exact() {
        let (a, b) = (line(mm(0.0, 0.0), mm(50.0, 0.0)), line(mm(50.0, 0.0), mm(50.0, 40.0)));
        let made = round(5.0, a, b);
        let bend = Some((Turn::Counterclockwise, mm(45.0, 5.0)));
        assert_eq!(made, Ok(Some(Inserted { from: mm(45.0, 0.0), to: mm(50.0, 5.0), bend })));
        let leg = between(&a, &b, CornerShape::Leg, 2 * ONE);
        assert_eq!(leg, Ok(Some(Inserted { from: mm(48.0, 0.0), to: mm(50.0, 2.0), bend: None })));
        let long = between(&a, &b, CornerShape::Length, mm(2.0 * 2.0_f64.sqrt(), 0.0)[0]);
        assert_eq!(long, leg);
    }

    #[test]
    fn turns_right_and_goes_on_straight() {
        let a = line(mm(0.0, 0.0), mm(50.0, 0.0));
        let right = round(5.0, a, line(mm(50.0, 0.0), mm(50.0, -40.0)));
        let bend = Some((Turn::Clockwise, mm(45.0, -5.0)));
        assert_eq!(right, Ok(Some(Inserted { from: mm(45.0, 0.0), to: mm(50.0, -5.0), bend })));
        assert_eq!(round(5.0, a, line(mm(50.0, 0.0), mm(90.0, 0.0))), Ok(None));
        assert_eq!(round(5.0, a, line(mm(50.0, 0.0), mm(20.0, 0.0))), Err(CornerFault::Back));
        assert_eq!(round(5.0, a, line(mm(50.0, 0.0), mm(90.0, 0.5))), Err(CornerFault::Slight));
    }

    #[test]
    fn takes_no_more_than_the_moves_have() {
        let (a, b) = (line(mm(0.0, 0.0), mm(5.0, 0.0)), line(mm(5.0, 0.0), mm(5.0, 40.0)));
        let whole = round(5.0, a, b).ok().flatten().map(|made| made.from);
        assert_eq!(whole, Some(mm(0.0, 0.0)));
        assert_eq!(round(5.001, a, b), Err(CornerFault::TooLarge));
        assert_eq!(between(&a, &b, CornerShape::Leg, 6 * ONE), Err(CornerFault::TooLarge));
    }

    /// A line into an arc about (0, 0) of radius 20 that it meets at (20, 0) under a right angle.
    #[test]
    fn touches_arcs() {
        let a = line(mm(50.0, 0.0), mm(20.0, 0.0));
        for (turn, end, up) in
            [(Turn::Counterclockwise, mm(0.0, 20.0), 1.0), (Turn::Clockwise, mm(0.0, -20.0), -1.0)]
        {
            let b = Leg { from: mm(20.0, 0.0), to: end, bend: Some((turn, mm(0.0, 0.0))) };
            let Ok(Some(made)) = round(5.0, a, b) else { panic!("no corner") };
            let (sense, centre) = made.bend.expect("an arc");
            // Outside of the circle, 25 from its centre and 5 from the line.
            let x = (25.0_f64 * 25.0 - 25.0).sqrt();
            assert_eq!(centre, mm(x, 5.0 * up));
            assert_eq!(made.from, mm(x, 0.0));
            assert_eq!(made.to, mm(x * 0.8, 4.0 * up));
            assert_eq!(sense == Turn::Clockwise, up > 0.0);
            assert_eq!(between(&a, &b, CornerShape::Leg, ONE), Err(CornerFault::ChamferAtArc));
            assert_eq!(round(100.0, a, b), Err(CornerFault::TooLarge));
        }
    }

    #[test]
    fn touches_two_arcs() {
        // Two arcs of radius 10 about (-8, 0) and (8, 0), which meet at (0, 6), on the way from left to right.
        let a = Leg { from: mm(-8.0, 10.0), to: mm(0.0, 6.0), bend: Some((Turn::Clockwise, mm(-8.0, 0.0))) };
        let b = Leg { from: mm(0.0, 6.0), to: mm(8.0, 10.0), bend: Some((Turn::Clockwise, mm(8.0, 0.0))) };
        let Ok(Some(made)) = round(2.0, a, b) else { panic!("no corner") };
        let (sense, centre) = made.bend.expect("an arc");
        assert_eq!(sense, Turn::Counterclockwise);
        assert_eq!(centre, mm(0.0, (144.0_f64 - 64.0).sqrt()));
        assert_eq!(made.from[0], -made.to[0]);
    }
}
