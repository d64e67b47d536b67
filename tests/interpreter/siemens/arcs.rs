//! Centres of arcs from what a Sinumerik program says, in the two coordinates of a plane.
//!
//! From `reference/siemens.md` section 4. CT: SINUMERIK ONE Programming Manual 12/2019, pages
//! 201-203: the tangent is that of the last block with a motion, and where it leads straight to the
//! end point the block is a straight line.

pub(crate) type Point = (f64, f64);

/// By radius: positive up to half a circle, negative beyond.
pub(crate) fn by_radius(from: Point, to: Point, r: f64, clockwise: bool) -> Result<Point, &'static str> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let chord = dx.hypot(dy);
    if chord < 1e-9 {
        return Err("CR= and no way to go");
    }
    let beyond = r * r - chord * chord / 4.0;
    if beyond < -0.01 {
        return Err("CR= does not reach");
    }
    let height = beyond.max(0.0).sqrt();
    // The centre of a short counter-clockwise arc lies to the left of the chord.
    let left = if clockwise == (r > 0.0) { -height } else { height };
    Ok(((from.0 + to.0) / 2.0 - left * dy / chord, (from.1 + to.1) / 2.0 + left * dx / chord))
}

/// By opening angle, degrees, and end point.
pub(crate) fn by_angle(from: Point, to: Point, angle: f64, clockwise: bool) -> Result<Point, &'static str> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    if dx.hypot(dy) < 1e-9 {
        return Err("AR= and the end point is the start");
    }
    // Over half the angle the centre lies beside the middle of the chord.
    let half = (angle / 2.0).to_radians();
    let left = half.cos() / half.sin() / 2.0 * if clockwise { -1.0 } else { 1.0 };
    Ok(((from.0 + to.0) / 2.0 - left * dy, (from.1 + to.1) / 2.0 + left * dx))
}

/// The end of an arc of so many degrees.
pub(crate) fn end_of(from: Point, centre: Point, angle: f64, clockwise: bool) -> Point {
    let (sin, cos) = (if clockwise { -angle } else { angle }).to_radians().sin_cos();
    let (x, y) = (from.0 - centre.0, from.1 - centre.1);
    (centre.0 + x * cos - y * sin, centre.1 + x * sin + y * cos)
}

/// Through a point on the way: the centre, and whether it goes clockwise. `None`: a straight line.
pub(crate) fn by_three(from: Point, via: Point, to: Point) -> Option<(Point, bool)> {
    let (ax, ay) = (via.0 - from.0, via.1 - from.1);
    let (bx, by) = (to.0 - from.0, to.1 - from.1);
    let cross = ax * by - ay * bx;
    if cross.abs() < 1e-9 {
        return None;
    }
    let (a, b) = (ax * ax + ay * ay, bx * bx + by * by);
    let centre = (from.0 + (by * a - ay * b) / (2.0 * cross), from.1 + (ax * b - bx * a) / (2.0 * cross));
    Some((centre, cross < 0.0))
}

/// By the direction at the start: the centre, and whether it goes clockwise. `None`: the end point
/// lies on the line of that direction.
pub(crate) fn by_tangent(from: Point, to: Point, direction: Point) -> Option<(Point, bool)> {
    let length = direction.0.hypot(direction.1);
    let left = (-direction.1 / length, direction.0 / length);
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let aside = dx * left.0 + dy * left.1;
    if aside.abs() < 1e-6 {
        return None;
    }
    let r = (dx * dx + dy * dy) / (2.0 * aside);
    Some(((from.0 + r * left.0, from.1 + r * left.1), r < 0.0))
}
