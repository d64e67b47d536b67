//! The way of a move: its length, and its directions at both ends.

use ncc_ir::canon::{AXES, Turn};
use ncc_ir::exec::{Event, Kind};
use ncc_ir::num::{Nanos, ONE};

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
pub(crate) fn units(n: Nanos) -> f64 {
    n as f64 / ONE as f64
}

fn norm(v: [f64; 3]) -> f64 {
    // Coordinates are below 1e10: no square can overflow, and `hypot` costs many times as much.
    (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt()
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    match norm(v) {
        n if n > 0.0 => v.map(|x| x / n),
        _ => [0.0; 3],
    }
}

/// The way of an event from a point, both in one coordinate system. An event that is no move has a
/// way of no length.
pub fn path(event: &Event, from: &[Nanos; AXES]) -> Path {
    let change: [f64; AXES] = std::array::from_fn(|i| units(event.end[i] - from[i]));
    let linear = [change[0], change[1], change[2]];
    match &event.kind {
        Kind::Traverse | Kind::Feed => {
            let (length, heading) = match norm(linear) {
                0.0 => (change[3].hypot(change[4]).hypot(change[5]), [0.0; 3]),
                length => {
                    let each = 1.0 / length;
                    (length, linear.map(|x| x * each))
                }
            };
            Path {
                length,
                change,
                heading_from: heading,
                heading_to: heading,
                radius: f64::INFINITY,
                sweep: 0.0,
            }
        }
        Kind::Arc { plane, turn, full, centre } => {
            let (f, s, n) = plane.axes();
            let arm =
                |p: &[Nanos; AXES]| [units(p[f as usize] - centre[0]), units(p[s as usize] - centre[1])];
            let (a, b) = (arm(from), arm(&event.end));
            let radius = (a[0] * a[0] + a[1] * a[1]).sqrt();
            let angle = (b[1].atan2(b[0]) - a[1].atan2(a[0])).rem_euclid(std::f64::consts::TAU);
            let sweep = match turn {
                _ if *full => std::f64::consts::TAU,
                Turn::Counterclockwise => angle,
                Turn::Clockwise => std::f64::consts::TAU - angle,
            };
            let sense = if *turn == Turn::Counterclockwise { 1.0 } else { -1.0 };
            let rise = change[n as usize];
            let heading = |arm: [f64; 2]| {
                let mut v = [0.0; 3];
                v[f as usize] = -arm[1] * sense * sweep;
                v[s as usize] = arm[0] * sense * sweep;
                v[n as usize] = rise;
                unit(v)
            };
            Path {
                length: ((radius * sweep) * (radius * sweep) + rise * rise).sqrt(),
                change,
                heading_from: heading(a),
                heading_to: heading(b),
                radius,
                sweep,
            }
        }
        Kind::Dwell(_)
        | Kind::ToolChange
        | Kind::Coolant
        | Kind::MachineFunction(_)
        | Kind::ProgramStop
        | Kind::OptionalProgramStop
        | Kind::ProgramEnd
        | Kind::TextEnd
        | Kind::Message(_)
        | Kind::Attribute(_) => Path {
            length: 0.0,
            change: [0.0; AXES],
            heading_from: [0.0; 3],
            heading_to: [0.0; 3],
            radius: f64::INFINITY,
            sweep: 0.0,
        },
    }
}
