//! What an arc in another form amounts to: its centre, its sense, its end.
//!
//! One definition for execution, which knows where everything is, and for the pass that writes such
//! an arc by its centre.

use crate::canon::{Distance, Fact, Plane, Turn};
use crate::expr::Expr;
use crate::geometry::{self, ArcFault};
use crate::num::{Nanos, ONE};
use crate::program::{Coord, Point, Shape};

/// Greatest difference of an arc's two radii, 0.02 mm; a control's parameter is of this order.
pub const ARC_TOLERANCE: Nanos = ONE / 50;

/// What must be known to say what an arc amounts to.
pub trait Around {
    /// What is told if it is not.
    type Unknown;

    /// A length or an angle.
    ///
    /// # Errors
    /// It is not known.
    fn value(&self, value: &Expr) -> Result<Nanos, Self::Unknown>;

    /// The point through which an arc goes, in the plane of the start.
    ///
    /// # Errors
    /// It is not known, or lies in another plane.
    fn via(&self, point: &Point) -> Result<[Nanos; 2], Self::Unknown>;

    /// Direction in which the move before ended; zero if there is none.
    ///
    /// # Errors
    /// It is not known.
    fn heading(&self) -> Result<[f64; 2], Self::Unknown>;
}

/// An arc in its plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Round {
    /// Its centre.
    pub centre: [Nanos; 2],
    /// Its end.
    pub end: [Nanos; 2],
    /// Its sense.
    pub turn: Turn,
}

/// What a shape amounts to between two points of a plane; the end follows from some shapes.
///
/// # Errors
/// Something that must be known is not; in `Ok`, that it is no arc.
pub fn round<A: Around>(
    shape: &Shape,
    plane: Plane,
    start: [Nanos; 2],
    end: [Nanos; 2],
    around: &A,
) -> Result<Result<Round, ArcFault>, A::Unknown> {
    let on = |centre, end, turn| {
        geometry::check_on_circle(start, end, centre, ARC_TOLERANCE).map(|()| Round { centre, end, turn })
    };
    Ok(match shape {
        Shape::Angle { turn, angle } => {
            let angle = around.value(angle)?;
            geometry::centre_by_angle(start, end, angle, *turn).map(|centre| Round {
                centre,
                end,
                turn: *turn,
            })
        }
        Shape::AngleAbout { turn, angle, centre } => {
            let centre = centre_of(centre, plane, start, around)?;
            let angle = around.value(angle)?;
            if angle <= 0 || angle >= 360 * ONE {
                return Ok(Err(ArcFault::NoWay));
            }
            let signed = if *turn == Turn::Counterclockwise { angle } else { -angle };
            on(centre, geometry::turned(centre, start, signed), *turn)
        }
        Shape::Mixed { turn, centre } => on(centre_of(centre, plane, start, around)?, end, *turn),
        Shape::Through(via) => geometry::arc_through(start, around.via(via)?, end)
            .map(|(centre, turn)| Round { centre, end, turn }),
        Shape::Tangent => geometry::arc_tangent(start, end, around.heading()?).map(|(centre, turn)| Round {
            centre,
            end,
            turn,
        }),
    })
}

/// A centre whose words say each from where they are measured.
fn centre_of<A: Around>(
    words: &[Option<Coord>; 3],
    plane: Plane,
    start: [Nanos; 2],
    around: &A,
) -> Result<[Nanos; 2], A::Unknown> {
    let (first, second, _) = plane.axes();
    let mut centre = start;
    for (centre, axis) in centre.iter_mut().zip([first, second]) {
        if let Some(word) = &words[axis as usize] {
            let value = around.value(&word.value)?;
            *centre = match word.distance {
                Fact::Known(Distance::Absolute) => value,
                Fact::Known(Distance::Incremental) | Fact::Entry => centre.wrapping_add(value),
            };
        }
    }
    Ok(centre)
}
