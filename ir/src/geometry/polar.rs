//! Where points by radius and angle are, and ends of lines by their angle.
//!
//! One definition for execution, which knows where everything is, and for passes, which know it as
//! far as the program says it. Points pass through floats, and are rounded to a nano.

use crate::canon::{Axis, Distance, Fact, Plane};
use crate::expr::Expr;
use crate::expr::num::{Nanos, Num, ONE, Unit};
use crate::geometry;
use crate::program::kinds::{conduct, miscellaneous};
use crate::program::{Coord, Op, Point, Polar, PoleFrom, PoleWords, SetPole};

/// The longest radius, 100 km: what is longer is a slip of the pen.
const LONGEST: Nanos = 100_000_000 * ONE;

/// The active pole, with the polar words that stay active.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pole {
    /// Its plane; `None` while no pole was set and no point was made.
    pub plane: Option<Plane>,
    /// Where it is in the plane, from program zero.
    pub at: [Nanos; 2],
    /// The last radius.
    pub radius: Option<Nanos>,
    /// The last angle, in degrees.
    pub angle: Option<Nanos>,
}

impl Pole {
    /// The pole before the first one is set.
    pub const ZERO: Pole = Pole { plane: None, at: [0; 2], radius: None, angle: None };

    /// Whether it is one of this plane.
    fn is_of(&self, plane: Plane) -> bool {
        self.plane.is_none_or(|own| own == plane)
    }
}

/// What must be known to say where a polar point is.
pub trait About {
    /// What is reported if it is not.
    type Unknown;

    /// A length or an angle.
    ///
    /// # Errors
    /// It is not known.
    fn value(&self, value: &Expr) -> Result<Nanos, Self::Unknown>;

    /// Whether a word is an increment.
    ///
    /// # Errors
    /// It is not known.
    fn is_increment(&self, distance: Fact<Distance>) -> Result<bool, Self::Unknown>;

    /// Tool position along an axis.
    ///
    /// # Errors
    /// It is not known.
    fn here(&self, axis: Axis) -> Result<Nanos, Self::Unknown>;

    /// The active pole.
    ///
    /// # Errors
    /// It is not known.
    fn pole(&self) -> Result<Pole, Self::Unknown>;

    /// What is reported where a word is missing, and none is active.
    fn missing(&self, what: &'static str) -> Self::Unknown;

    /// What is reported of a value that no point has.
    fn out_of_range(&self, what: &'static str) -> Self::Unknown;
}

/// A pole that is set.
///
/// # Errors
/// What it depends on is not known, or it is nowhere.
pub fn pole<A: About>(set: &SetPole, plane: Plane, about: &A) -> Result<Pole, A::Unknown> {
    let (first, second, _) = plane.axes();
    let from = match set.from {
        PoleFrom::Zero => [0; 2],
        PoleFrom::Here => [about.here(first)?, about.here(second)?],
        PoleFrom::Pole => {
            let before = about.pole()?;
            if !before.is_of(plane) {
                return Err(about.missing("pole of this plane"));
            }
            before.at
        }
    };
    let by = match &set.at {
        PoleWords::Along(words) => {
            let along = |axis: Axis| words[axis as usize].as_ref().map_or(Ok(0), |word| about.value(word));
            [along(first)?, along(second)?]
        }
        PoleWords::Polar { radius, angle } => {
            let radius = about.value(radius)?;
            if !(0..=LONGEST).contains(&radius) {
                return Err(about.out_of_range("radius of a pole"));
            }
            geometry::polar(radius, about.value(angle)?)
        }
    };
    let at = [from[0].wrapping_add(by[0]), from[1].wrapping_add(by[1])];
    if at.iter().any(|at| at.unsigned_abs() > LONGEST as u64) {
        return Err(about.out_of_range("place of a pole"));
    }
    Ok(Pole { plane: Some(plane), at, radius: None, angle: None })
}

/// Where a polar point is in the plane, and the pole with the words that are active after it.
///
/// # Errors
/// What it depends on is not known, or it is nowhere.
pub fn point<A: About>(polar: &Polar, plane: Plane, about: &A) -> Result<([Nanos; 2], Pole), A::Unknown> {
    if polar.along {
        // Which pole and which words about it are active does not matter, and stays as it is.
        return Ok((on_line(polar, plane, about)?, about.pole().unwrap_or_default()));
    }
    let before = about.pole()?;
    if !before.is_of(plane) {
        return Err(about.missing("pole of this plane"));
    }
    let word = |word: &Option<Coord>, last: Option<Nanos>, what: &'static str| match word {
        None => last.ok_or_else(|| about.missing(what)),
        Some(word) => {
            let value = about.value(&word.value)?;
            match (about.is_increment(word.distance)?, last) {
                (false, _) => Ok(value),
                (true, Some(last)) => Ok(last.wrapping_add(value)),
                (true, None) => Err(about.missing(what)),
            }
        }
    };
    let radius = word(&polar.radius, before.radius, "polar radius")?;
    let angle = word(&polar.angle, before.angle, "polar angle")?;
    if !(0..=LONGEST).contains(&radius) {
        return Err(about.out_of_range("polar radius"));
    }
    if angle.unsigned_abs() > 1_000_000 * ONE as u64 {
        return Err(about.out_of_range("polar angle"));
    }
    let by = geometry::polar(radius, angle);
    let at = [before.at[0].wrapping_add(by[0]), before.at[1].wrapping_add(by[1])];
    Ok((at, Pole { plane: Some(plane), radius: Some(radius), angle: Some(angle), ..before }))
}

/// A line that is stated by its angle and lies nearer than this to square with the axis of its word ends
/// anywhere.
const LEAST_SLOPE: f64 = 1e-4;

/// Where a line by its angle ends.
fn on_line<A: About>(polar: &Polar, plane: Plane, about: &A) -> Result<[Nanos; 2], A::Unknown> {
    let (first, second, _) = plane.axes();
    let angle = polar.angle.as_ref().ok_or_else(|| about.missing("angle of a line"))?;
    if about.is_increment(angle.distance)? {
        return Err(about.missing("angle of a line from an axis"));
    }
    let (sin, cos) = geometry::sin_cos(about.value(&angle.value)?);
    let to = end_of(&polar.op).ok_or_else(|| about.missing("point of a line"))?;
    let here = [about.here(first)?, about.here(second)?];
    let (own, word, way, slope) = match (to.get(first), to.get(second)) {
        (Some(word), None) => (0, word, cos, sin),
        (None, Some(word)) => (1, word, sin, cos),
        (Some(_), Some(_)) | (None, None) => {
            return Err(about.missing("one word of the plane beside an angle"));
        }
    };
    let value = about.value(&word.value)?;
    let by = match about.is_increment(word.distance)? {
        true => value,
        false => value.wrapping_sub(here[own]),
    };
    if way.abs() < LEAST_SLOPE || (by as f64) * way < 0.0 {
        return Err(about.out_of_range("angle of a line that does not lead to its end point"));
    }
    let across = by as f64 / way * slope;
    if across.abs() > LONGEST as f64 || by.unsigned_abs() > LONGEST as u64 {
        return Err(about.out_of_range("end of a line by its angle"));
    }
    let mut at = here;
    at[own] = at[own].wrapping_add(by);
    at[1 - own] = at[1 - own].wrapping_add(across.round() as Nanos);
    Ok(at)
}

/// The move of a polar point with the words of the plane in their place: `make` says them, by side.
/// `None` where no move of this kind has such a point.
pub fn with_words(polar: &Polar, plane: Plane, at: [Nanos; 2], make: impl Fn(Nanos) -> Coord) -> Option<Op> {
    let mut op = polar.op.clone();
    let to = end(&mut op)?;
    let (first, second, _) = plane.axes();
    to.set(first, make(at[0]));
    to.set(second, make(at[1]));
    Some(op)
}

/// The point of a move that can be polar.
pub fn end(op: &mut Op) -> Option<&mut Point> {
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Hole(m) | Op::Position(m) => Some(&mut m.to),
        Op::ArcFeed(arc) => Some(&mut arc.to),
        _ => None,
    }
}

/// The same, to look at.
pub fn end_of(op: &Op) -> Option<&Point> {
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Hole(m) | Op::Position(m) => Some(&m.to),
        Op::ArcFeed(arc) => Some(&arc.to),
        _ => None,
    }
}

/// Whether a statement is more than one that stands among polar points: it has words of the plane, or
/// goes where the mode that they are written in need not be active.
pub fn leaves_points(op: &Op, plane: Option<Plane>) -> bool {
    match op {
        Op::StraightTraverse(m) | Op::StraightFeed(m) => plane.is_none_or(|plane| {
            let (first, second, _) = plane.axes();
            m.to.get(first).is_some() || m.to.get(second).is_some()
        }),
        Op::Polar(_)
        | Op::SetPole(_)
        | Op::SetFeedRate(_)
        | Op::SetDistanceMode(_)
        | Op::SetFeedMode(_)
        | Op::SetReturnLevel(_)
        | Op::UseLengthUnits(_)
        | Op::UseToolLengthOffset(_)
        | Op::UseToolLength(_)
        | Op::StartCycle(_)
        | Op::EndCycle
        | miscellaneous!()
        | conduct!() => false,
        _ => true,
    }
}

/// A word that is exactly so many nanos from program zero.
pub fn exact(at: Nanos) -> Coord {
    let value = Expr::Num(Num { mantissa: at, scale: 9, point: true, unit: Unit::Mm });
    Coord { value, distance: Fact::Known(Distance::Absolute) }
}
