//! Geometry of arcs and patterns: the only place where positions pass through binary floats.
//!
//! All lengths are nanos. Results are rounded to a nano, a thousandth of what any control resolves.
//!
//! ```text
//! arc_solver          start, end and radius of an arc    its centre
//! hole_positions      a circle of 12 holes               12 positions
//! ```
//!
//! Not here: what a control accepts as an arc: that is its own rule.

pub mod arc_feed;
pub mod arc_solver;
pub mod corner;
pub mod hole_positions;
pub mod offset_path;
pub mod polar;

use crate::canon::Turn;
use crate::expr::num::{Nanos, ONE};

/// Why an arc is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArcFault {
    /// The radius cannot reach the end point.
    RadiusTooSmall,
    /// A radius, and end = start.
    NoWay,
    /// The radii at start and end differ by more than is allowed.
    EndOffCircle {
        /// Both radii.
        radii: [Nanos; 2],
        /// The greatest difference that the control accepts for them.
        allowed: Nanos,
    },
    /// Start and centre are the same point.
    NoRadius,
    /// A tangent arc whose end lies straight ahead: a line.
    Straight,
}

/// Centre of an arc by its radius: positive for at most half a turn, negative for more (Fanuc,
/// NIST RS274/NGC 3.5.3.1). Half the chord may exceed the radius by `short`: that is half a turn.
///
/// # Errors
/// [`ArcFault::NoWay`], [`ArcFault::RadiusTooSmall`].
pub fn centre_by_radius(
    start: [Nanos; 2],
    end: [Nanos; 2],
    radius: Nanos,
    turn: Turn,
    short: Nanos,
) -> Result<[Nanos; 2], ArcFault> {
    let (dx, dy) = ((end[0] - start[0]) as f64, (end[1] - start[1]) as f64);
    let chord = dx.hypot(dy);
    if chord == 0.0 {
        return Err(ArcFault::NoWay);
    }
    let r = (radius as f64).abs();
    let half = chord / 2.0;
    if half > r + short as f64 {
        return Err(ArcFault::RadiusTooSmall);
    }
    let rise = (r * r - half * half).max(0.0).sqrt();
    // Left of the chord is the centre of a counter-clockwise arc of less than half a turn.
    let left = (turn == Turn::Counterclockwise) == (radius > 0);
    let side = if left { rise } else { -rise };
    Ok([
        start[0] + (dx / 2.0 - dy / chord * side).round() as Nanos,
        start[1] + (dy / 2.0 + dx / chord * side).round() as Nanos,
    ])
}

/// Radii of an arc at its start and at its end, to a nano.
pub fn radii(start: [Nanos; 2], end: [Nanos; 2], centre: [Nanos; 2]) -> [Nanos; 2] {
    [start, end].map(|p| {
        ((p[0].wrapping_sub(centre[0])) as f64).hypot((p[1].wrapping_sub(centre[1])) as f64).round() as Nanos
    })
}

/// Signed sweep in degrees, counter-clockwise positive: more than 0, and at most 360 plus the full
/// turns.
pub fn sweep_degrees(start: [Nanos; 2], end: [Nanos; 2], centre: [Nanos; 2], turn: Turn, turns: u32) -> f64 {
    let angle = |p: [Nanos; 2]| ((p[1] - centre[1]) as f64).atan2((p[0] - centre[0]) as f64).to_degrees();
    let extra = 360.0 * f64::from(turns);
    if start == end {
        let full = 360.0 + extra;
        return if turn == Turn::Counterclockwise { full } else { -full };
    }
    let ccw = (angle(end) - angle(start)).rem_euclid(360.0);
    match turn {
        Turn::Counterclockwise => (if ccw == 0.0 { 360.0 } else { ccw }) + extra,
        Turn::Clockwise => -((360.0 - ccw) + extra),
    }
}

/// The `k`-th hole of a circle (0 is the first), the step in degrees, counter-clockwise positive.
pub fn circle_position(centre: [Nanos; 2], first: [Nanos; 2], step: Nanos, k: u32) -> [Nanos; 2] {
    let turned = (i128::from(step) * i128::from(k)).rem_euclid(360 * i128::from(ONE)) as f64 / ONE as f64;
    let (sin, cos) = sin_cos_degrees(turned);
    let (x, y) = ((first[0] - centre[0]) as f64, (first[1] - centre[1]) as f64);
    [centre[0] + (x * cos - y * sin).round() as Nanos, centre[1] + (x * sin + y * cos).round() as Nanos]
}

/// The point at a distance and an angle (nanos of a degree) from the origin.
pub fn polar(distance: Nanos, angle: Nanos) -> [Nanos; 2] {
    let (sin, cos) = sin_cos(angle);
    [(distance as f64 * cos).round() as Nanos, (distance as f64 * sin).round() as Nanos]
}

/// Sine and cosine of an angle in nanos of a degree, exact at multiples of 90°.
pub fn sin_cos(angle: Nanos) -> (f64, f64) {
    sin_cos_degrees(angle.rem_euclid(360 * ONE) as f64 / ONE as f64)
}

/// Centre of an arc by its opening angle (nanos of a degree, more than 0 and less than 360).
///
/// # Errors
/// [`ArcFault::NoWay`] if start and end are one point or the angle opens none.
pub fn centre_by_angle(
    start: [Nanos; 2],
    end: [Nanos; 2],
    angle: Nanos,
    turn: Turn,
) -> Result<[Nanos; 2], ArcFault> {
    let (dx, dy) = ((end[0] - start[0]) as f64, (end[1] - start[1]) as f64);
    if dx == 0.0 && dy == 0.0 || angle <= 0 || angle >= 360 * ONE {
        return Err(ArcFault::NoWay);
    }
    // The centre lies on the chord's bisector; left of the chord for less than half a turn
    // counter-clockwise.
    let half = (angle as f64 / ONE as f64 / 2.0).to_radians();
    let rise = if angle == 180 * ONE { 0.0 } else { 1.0 / half.tan() / 2.0 };
    let side = if turn == Turn::Counterclockwise { rise } else { -rise };
    Ok([
        start[0] + (dx / 2.0 - dy * side).round() as Nanos,
        start[1] + (dy / 2.0 + dx * side).round() as Nanos,
    ])
}

/// A point turned about a centre; the angle in nanos of a degree, counter-clockwise positive.
pub fn turned(centre: [Nanos; 2], point: [Nanos; 2], angle: Nanos) -> [Nanos; 2] {
    circle_position(centre, point, angle, 1)
}

/// Centre and sense of the arc from `start` through `via` to `end`.
///
/// # Errors
/// [`ArcFault::NoWay`] if two of the points are one, or all lie on a line.
pub fn arc_through(
    start: [Nanos; 2],
    via: [Nanos; 2],
    end: [Nanos; 2],
) -> Result<([Nanos; 2], Turn), ArcFault> {
    let from_start = |p: [Nanos; 2]| ((p[0] - start[0]) as f64, (p[1] - start[1]) as f64);
    let ((ax, ay), (bx, by)) = (from_start(via), from_start(end));
    let cross = ax * by - ay * bx;
    let (a, b) = (ax * ax + ay * ay, bx * bx + by * by);
    // A height of less than a micrometre over the chord is a line.
    if a == 0.0 || b == 0.0 || cross.abs() < 1000.0 * b.sqrt() {
        return Err(ArcFault::NoWay);
    }
    let x = (by * a - ay * b) / (2.0 * cross);
    let y = (ax * b - bx * a) / (2.0 * cross);
    let turn = if cross > 0.0 { Turn::Counterclockwise } else { Turn::Clockwise };
    Ok(([start[0] + x.round() as Nanos, start[1] + y.round() as Nanos], turn))
}

/// Centre and sense of the arc from `start` to `end` that leaves in a direction.
///
/// # Errors
/// [`ArcFault::NoWay`] if there is no direction, or the end lies behind; [`ArcFault::Straight`] if it
/// lies ahead.
pub fn arc_tangent(
    start: [Nanos; 2],
    end: [Nanos; 2],
    direction: [f64; 2],
) -> Result<([Nanos; 2], Turn), ArcFault> {
    let length = direction[0].hypot(direction[1]);
    let (dx, dy) = ((end[0] - start[0]) as f64, (end[1] - start[1]) as f64);
    let (ux, uy) = (direction[0] / length, direction[1] / length);
    // How far the end lies to the left of the direction.
    let left = ux * dy - uy * dx;
    if length == 0.0 || dx == 0.0 && dy == 0.0 {
        return Err(ArcFault::NoWay);
    }
    if left.abs() < 1000.0 {
        let ahead = ux * dx + uy * dy > 0.0;
        return Err(if ahead { ArcFault::Straight } else { ArcFault::NoWay });
    }
    let radius = (dx * dx + dy * dy) / (2.0 * left);
    let turn = if left > 0.0 { Turn::Counterclockwise } else { Turn::Clockwise };
    let centre = [start[0] + (-uy * radius).round() as Nanos, start[1] + (ux * radius).round() as Nanos];
    Ok((centre, turn))
}

/// Direction in which an arc ends.
pub fn tangent(end: [Nanos; 2], centre: [Nanos; 2], turn: Turn) -> [f64; 2] {
    let (x, y) = ((end[0] - centre[0]) as f64, (end[1] - centre[1]) as f64);
    match turn {
        Turn::Counterclockwise => [-y, x],
        Turn::Clockwise => [y, -x],
    }
}

/// Sine and cosine of degrees in 0..360, exact at multiples of 90.
fn sin_cos_degrees(degrees: f64) -> (f64, f64) {
    let quarter = (degrees / 90.0).floor();
    let (sin, cos) = (degrees - 90.0 * quarter).to_radians().sin_cos();
    match quarter as u8 {
        0 => (sin, cos),
        1 => (cos, -sin),
        2 => (-sin, -cos),
        _ => (-cos, sin),
    }
}

/// The `k`-th hole of a grid of `columns` × `rows` from its first: steps along the row and from row
/// to row.
pub fn grid_position(columns: u32, serpentine: bool, k: u32) -> (u32, u32) {
    let (row, column) = (k / columns.max(1), k % columns.max(1));
    if serpentine && row % 2 == 1 { (columns - 1 - column, row) } else { (column, row) }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MM: Nanos = ONE;

    #[test]
    fn a_positive_radius_is_the_short_way() {
        // Quarter circle from (10, 0) to (0, 10), counter-clockwise about the origin.
        let c = centre_by_radius([10 * MM, 0], [0, 10 * MM], 10 * MM, Turn::Counterclockwise, 0);
        assert_eq!(c, Ok([0, 0]));
        let far = centre_by_radius([10 * MM, 0], [0, 10 * MM], -10 * MM, Turn::Counterclockwise, 0);
        assert_eq!(far, Ok([10 * MM, 10 * MM]));
        let cw = centre_by_radius([10 * MM, 0], [0, 10 * MM], 10 * MM, Turn::Clockwise, 0);
        assert_eq!(cw, Ok([10 * MM, 10 * MM]));
    }

    #[test]
    fn bolt_circle_of_the_case_study() {
        let at = |k| circle_position([0, 0], [0, 18 * MM], 30 * MM, k);
        assert_eq!(at(0), [0, 18 * MM]);
        assert_eq!(at(1), [-9 * MM, 15_588_457_268]);
        assert_eq!(at(3), [-18 * MM, 0]);
    }

    #[test]
    fn sweep_of_a_clockwise_three_quarter_turn() {
        let s = sweep_degrees([10 * MM, 0], [0, 10 * MM], [0, 0], Turn::Clockwise, 0);
        assert!((s + 270.0).abs() < 1e-9);
    }
}
