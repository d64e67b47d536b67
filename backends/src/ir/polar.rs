//! Points by radius and angle, as the `ir` text has them.

use ncc_ir::program::{Polar, PoleFrom, PoleWords, SetPole};

use super::expr::expr;
use super::frame::axis_words;
use super::op::{coord, op, plane, put};

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

/// A polar point, and the move to it.
pub(super) fn polar_move(polar: &Polar, out: &mut Vec<u8>) {
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
    op(&polar.op, out);
}
