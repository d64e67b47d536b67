//! Points by radius and angle, and the direction in which axes turn, as the `ir` text has them.

use ncc_ir::canon::RotaryWay;
use ncc_ir::program::{Polar, PoleFrom, PoleWords, SetPole};

use super::expr::expr;
use super::frame::axis_words;
use super::words::{coord, plane, put};

/// Where a pole is.
pub(super) fn pole(set: &SetPole, out: &mut Vec<u8>) {
    put(set.plane.known().map_or("entry", plane), out);
    put(
        match set.from {
            PoleFrom::Zero => ", zero",
            PoleFrom::Here => ", here",
            PoleFrom::Pole => ", pole",
        },
        out,
    );
    match &set.at {
        PoleWords::Along(words) => axis_words(&words[..], ", ", out),
        PoleWords::Polar { radius, angle } => {
            put(", radius ", out);
            expr(radius, out);
            put(", angle ", out);
            expr(angle, out);
        }
    }
}

/// A polar point; the move to it comes after it.
pub(super) fn polar_point(polar: &Polar, out: &mut Vec<u8>) {
    put("POLAR(", out);
    put(polar.plane.known().map_or("entry", plane), out);
    let angle = if polar.along { ", along " } else { ", angle " };
    for (name, word) in [(", radius ", &polar.radius), (angle, &polar.angle)] {
        if let Some(word) = word {
            put(name, out);
            coord(word, out);
        }
    }
    put(") ", out);
}

/// The direction in which rotary axes turn.
pub(super) fn rotary_ways(ways: &[Option<RotaryWay>; 3], out: &mut Vec<u8>) {
    let named = ["A ", "B ", "C "].into_iter().zip(ways).filter_map(|(axis, way)| Some((axis, (*way)?)));
    for (place, (axis, way)) in named.enumerate() {
        put(if place > 0 { ", " } else { "" }, out);
        put(axis, out);
        put(way.name(), out);
    }
}
