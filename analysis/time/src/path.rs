//! The way of a move: its length, and its directions at both ends.

use std::f64::consts::TAU;

use ncc_exec::{Event, Movement};
use ncc_ir::canon::{AXES, Plane, Turn};
use ncc_ir::expr::num::{Nanos, ONE};

/// The geometry of a move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Path {
    /// Length of the way of the linear axes, mm; of a move of rotary axes alone, degrees.
    pub length: f64,
    /// Change of every axis from start to end, mm and degrees.
    pub change: [f64; AXES],
    /// Unit direction in X Y Z at the start; zero for a move of rotary axes alone.
    pub heading_from: [f64; 3],
    /// Unit direction in X Y Z at the end.
    pub heading_to: [f64; 3],
    /// Radius of an arc in its plane, mm; infinite for a straight line.
    pub radius: f64,
    /// The angle that an arc turns through, radians, positive; 0 for a straight line.
    pub sweep: f64,
}

/// Millimetres or degrees of nanos.
#[inline]
pub(crate) fn units(n: Nanos) -> f64 {
    n as f64 / ONE as f64
}

#[inline]
fn norm(v: [f64; 3]) -> f64 {
    // Coordinates are below 1e10: no square can overflow, and `hypot` costs many times as much.
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    match norm(v) {
        n if n > 0.0 => {
            let each = 1.0 / n;
            v.map(|x| x * each)
        }
        _ => [0.0; 3],
    }
}

/// The way of an event from a point, both in one coordinate system. An event that is no move has a
/// way of no length.
#[inline]
pub fn path(event: &Event, from: &[Nanos; AXES]) -> Path {
    match event.kind.moves() {
        Some(Movement::Rapid | Movement::Feed) => line(&event.end, from),
        Some(Movement::Arc { plane, turn, full, centre }) => {
            arc(&Round { plane, turn, full, centre }, &event.end, from)
        }
        None => Path {
            length: 0.0,
            change: [0.0; AXES],
            heading_from: [0.0; 3],
            heading_to: [0.0; 3],
            radius: f64::INFINITY,
            sweep: 0.0,
        },
    }
}

/// Change of every axis.
#[inline]
fn change(end: &[Nanos; AXES], from: &[Nanos; AXES]) -> [f64; AXES] {
    let of = |axis: usize| units(end[axis] - from[axis]);
    let [x, y, z] = [of(0), of(1), of(2)];
    // Rotary axes stand still in most moves.
    if (end[3], end[4], end[5]) == (from[3], from[4], from[5]) {
        return [x, y, z, 0.0, 0.0, 0.0];
    }
    [x, y, z, of(3), of(4), of(5)]
}

/// Of a straight move.
#[inline]
pub(crate) fn line(end: &[Nanos; AXES], from: &[Nanos; AXES]) -> Path {
    let change = change(end, from);
    let linear = [change[0], change[1], change[2]];
    let (length, heading) = match norm(linear) {
        0.0 => (change[3].hypot(change[4]).hypot(change[5]), [0.0; 3]),
        length => {
            let each = 1.0 / length;
            (length, [linear[0] * each, linear[1] * each, linear[2] * each])
        }
    };
    Path { length, change, heading_from: heading, heading_to: heading, radius: f64::INFINITY, sweep: 0.0 }
}

/// What [`Kind::Arc`] says.
pub(crate) struct Round {
    pub(crate) plane: Plane,
    pub(crate) turn: Turn,
    pub(crate) full: bool,
    pub(crate) centre: [Nanos; 2],
}

/// X Y Z of what is along the first and the second axis of a plane, and along its normal.
#[inline]
pub(crate) fn laid(plane: Plane, [first, second, normal]: [f64; 3]) -> [f64; 3] {
    match plane {
        Plane::Xy => [first, second, normal],
        Plane::Yz => [normal, first, second],
        Plane::Zx => [second, normal, first],
    }
}

/// Of an arc.
#[inline]
pub(crate) fn arc(round: &Round, end: &[Nanos; AXES], from: &[Nanos; AXES]) -> Path {
    let Round { plane, turn, full, centre } = round;
    let change = change(end, from);
    let (f, s, n) = plane.axes();
    let arm = |p: &[Nanos; AXES]| [units(p[f as usize] - centre[0]), units(p[s as usize] - centre[1])];
    let (a, b) = (arm(from), arm(end));
    let radius = (a[0] * a[0] + a[1] * a[1]).sqrt();
    let sense = if *turn == Turn::Counterclockwise { 1.0 } else { -1.0 };
    let sweep = if *full {
        TAU
    } else {
        // From the one arm to the other, in the sense of the arc.
        let across = (a[0] * b[1] - a[1] * b[0]) * sense;
        let along = a[0] * b[0] + a[1] * b[1];
        let angle = across.atan2(along);
        if angle < 0.0 { angle + TAU } else { angle }
    };
    let rise = change[n as usize];
    let round = sense * sweep;
    let heading = |arm: [f64; 2]| unit(laid(*plane, [-arm[1] * round, arm[0] * round, rise]));
    Path {
        length: ((radius * sweep) * (radius * sweep) + rise * rise).sqrt(),
        change,
        heading_from: heading(a),
        heading_to: heading(b),
        radius,
        sweep,
    }
}
