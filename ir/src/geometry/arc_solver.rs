//! What an arc in another form amounts to: its centre, its sense, its end.
//!
//! One definition for execution, which knows where everything is, and for the pass that writes such
//! an arc by its centre.

use crate::canon::{Distance, Fact, Plane, Turn};
use crate::expr::Expr;
use crate::expr::num::{Nanos, ONE};
use crate::geometry::{self, ArcFault};
use crate::program::{Coord, Point, Shape};

/// Which arcs a control accepts. Lengths in nanos of a millimetre, each for a program in millimetres and for one in
/// inches, because some controls have a parameter for each.
///
/// ```
/// use ncc_ir::geometry::ArcFault;
/// use ncc_ir::expr::num::ONE;
/// use ncc_ir::geometry::arc_solver::ArcRule;
///
/// let rule = ArcRule { tolerance: Some([ONE / 100; 2]), relative: ONE / 1000, ..ArcRule::UNTESTED };
/// // Radius 50: the thousandth of it counts, not the hundredth of a millimetre.
/// assert_eq!(rule.check([50 * ONE, 50 * ONE + ONE / 25], false), Ok(()));
/// let off = ArcFault::EndOffCircle { radii: [2 * ONE, 2 * ONE + ONE / 50], allowed: ONE / 100 };
/// assert_eq!(rule.check([2 * ONE, 2 * ONE + ONE / 50], false), Err(off));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArcRule {
    /// Difference of the radii at start and end that is always accepted; `None`: the control does not test it.
    pub tolerance: Option<[Nanos; 2]>,
    /// A difference up to this part of a radius is accepted too, in billionths; 0 is none.
    pub relative: Nanos,
    /// Whether that is a part of the larger radius; else of the one at the start.
    pub of_larger: bool,
    /// A difference above so many times the tolerance is never accepted; 0 is no such limit.
    pub limit: i64,
    /// The least radius at either end.
    pub least: Nanos,
    /// By how much half the chord may exceed a stated radius: the arc is half a circle then.
    pub short: [Nanos; 2],
}

/// The most by which half a chord may exceed the radius on any control known, 0.001 in: what passes take for an arc.
/// Execution judges by the control's own rule.
pub const MOST_SHORT: Nanos = 254 * ONE / 10_000;

impl ArcRule {
    /// No test at all.
    pub const UNTESTED: ArcRule = ArcRule {
        tolerance: None,
        relative: 0,
        of_larger: false,
        limit: 0,
        least: 1000,
        short: [MOST_SHORT; 2],
    };

    /// Judges the radii at start and end, in nanos of a millimetre; `inch` is the active unit.
    ///
    /// # Errors
    /// [`ArcFault::NoRadius`], [`ArcFault::EndOffCircle`].
    pub fn check(&self, radii: [Nanos; 2], inch: bool) -> Result<(), ArcFault> {
        let [start, end] = radii;
        if start.min(end) < self.least {
            return Err(ArcFault::NoRadius);
        }
        let Some(tolerance) = self.tolerance else { return Ok(()) };
        let tolerance = tolerance[usize::from(inch)];
        let of = if self.of_larger { start.max(end) } else { start };
        let part = (i128::from(of) * i128::from(self.relative) / i128::from(ONE)) as Nanos;
        let most = if self.limit == 0 { Nanos::MAX } else { tolerance.saturating_mul(self.limit) };
        let allowed = tolerance.max(part).min(most);
        if start.abs_diff(end) > allowed as u64 {
            return Err(ArcFault::EndOffCircle { radii, allowed });
        }
        Ok(())
    }

    /// By how much half the chord may exceed a stated radius.
    pub fn short(&self, inch: bool) -> Nanos {
        self.short[usize::from(inch)]
    }
}

/// A control of which nothing is known: 0.02 mm, the order of the parameters of all that are.
impl Default for ArcRule {
    fn default() -> ArcRule {
        ArcRule { tolerance: Some([ONE / 50; 2]), short: [1000; 2], ..ArcRule::UNTESTED }
    }
}

/// What must be known to say what an arc amounts to.
pub trait Around {
    /// What is reported if it is not.
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

    /// Which arcs the control accepts, and whether inches are active.
    fn rule(&self) -> (ArcRule, bool);
}

/// An arc in its plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SolvedArc {
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
pub fn solve_arc<A: Around>(
    shape: &Shape,
    plane: Plane,
    start: [Nanos; 2],
    end: [Nanos; 2],
    around: &A,
) -> Result<Result<SolvedArc, ArcFault>, A::Unknown> {
    let on = |centre, end, turn| {
        let (rule, inch) = around.rule();
        rule.check(geometry::radii(start, end, centre), inch).map(|()| SolvedArc { centre, end, turn })
    };
    Ok(match shape {
        Shape::Angle { turn, angle } => {
            let angle = around.value(angle)?;
            geometry::centre_by_angle(start, end, angle, *turn).map(|centre| SolvedArc {
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
            .map(|(centre, turn)| SolvedArc { centre, end, turn }),
        Shape::Tangent => geometry::arc_tangent(start, end, around.heading()?)
            .map(|(centre, turn)| SolvedArc { centre, end, turn }),
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

#[cfg(test)]
mod tests {
    use super::*;

    /// LinuxCNC's interpreter, run: with radius 50 a difference of 0.05 goes and 0.08 does not, with radius 5 one of 0.03
    /// does not, with radius 5000 one of 10.2 does not. Each alone of the three limits decides one of these.
    #[test]
    fn the_larger_of_two_limits_within_a_third() {
        let rule = ArcRule {
            tolerance: Some([28_284_271, 71_842_048]),
            relative: ONE / 1000,
            of_larger: true,
            limit: 100,
            least: 1_270_000,
            short: [1_270_000; 2],
        };
        let goes = |radius: Nanos, by: Nanos| rule.check([radius, radius + by], false).is_ok();
        let hundredth = ONE / 100;
        assert!(goes(50 * ONE, 5 * hundredth) && !goes(50 * ONE, 8 * hundredth));
        assert!(goes(2 * ONE, 18 * ONE / 1000) && !goes(5 * ONE, 3 * hundredth));
        assert!(goes(5000 * ONE, 2 * ONE) && !goes(5000 * ONE, 3 * ONE));
        // In inches it is another length.
        assert!(rule.check([5 * ONE, 5 * ONE + 7 * hundredth], true).is_ok());
        assert_eq!(rule.check([ONE / 1000, ONE / 1000], false), Err(ArcFault::NoRadius));
    }

    /// A part of the larger radius is more than that of the one at the start, and nothing is tested without a tolerance.
    #[test]
    fn of_which_radius() {
        let start = ArcRule { tolerance: Some([0; 2]), relative: ONE / 10, ..ArcRule::UNTESTED };
        let larger = ArcRule { of_larger: true, ..start };
        let radii = [10 * ONE, 11 * ONE + ONE / 20];
        assert!(start.check(radii, false).is_err() && larger.check(radii, false).is_ok());
        assert_eq!(ArcRule::UNTESTED.check([ONE, 9 * ONE], false), Ok(()));
    }
}
