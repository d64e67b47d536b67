//! Words that several statements of the `ir` text share: names, coordinates, points, planes.
//!
//! The incremental word `G91 X5`, in mm, is `X inc 5mm` as text. Not here: the statements, and expressions (`expr`).

use ncc_ir::canon::{Axis, Distance, Fact, Plane, ReturnLevel, Turn};
use ncc_ir::expr::Expr;
use ncc_ir::program::{Coord, Point};

use super::expr::expr;
use crate::common::quoted::quote;

pub(super) fn put(text: &str, out: &mut Vec<u8>) {
    out.extend_from_slice(text.as_bytes());
}

/// Writes a name: bare if it is a number of 1 to 18 digits without leading zeros, else in quotation marks.
pub(super) fn name(text: &str, out: &mut Vec<u8>) {
    let number = text.bytes().all(|b| b.is_ascii_digit())
        && (1..=18).contains(&text.len())
        && (text.len() == 1 || !text.starts_with('0'));
    if number { put(text, out) } else { text_argument(text, out) }
}

/// Writes a text between quotation marks. The reader undoes each escape, so nothing is lost.
pub(super) fn text_argument(text: &str, out: &mut Vec<u8>) {
    let _escaped = quote(text, out);
}

pub(super) fn further(arguments: &[Expr], out: &mut Vec<u8>) {
    for e in arguments {
        put(", ", out);
        expr(e, out);
    }
}

/// Writes the axis words of a point, each followed by `after`. With an empty `after`, commas separate them.
pub(super) fn point(to: &Point, after: &[u8], out: &mut Vec<u8>) {
    let mut first = true;
    for axis in Axis::ALL {
        if let Some(c) = to.get(axis) {
            if !first && after.is_empty() {
                put(", ", out);
            }
            first = false;
            out.push(axis.letter());
            out.push(b' ');
            coord(c, out);
            out.extend_from_slice(after);
        }
    }
}

pub(super) fn coord(c: &Coord, out: &mut Vec<u8>) {
    put(
        match c.distance {
            Fact::Known(Distance::Absolute) => "",
            Fact::Known(Distance::Incremental) => "inc ",
            Fact::Entry => "entry ",
        },
        out,
    );
    expr(&c.value, out);
}

pub(super) fn plane(p: Plane) -> &'static str {
    match p {
        Plane::Xy => "XY",
        Plane::Zx => "ZX",
        Plane::Yz => "YZ",
    }
}

pub(super) fn return_level(r: ReturnLevel) -> &'static str {
    match r {
        ReturnLevel::Initial => "initial",
        ReturnLevel::Retract => "retract",
    }
}

pub(super) fn turn(t: Turn) -> &'static str {
    match t {
        Turn::Clockwise => "clockwise",
        Turn::Counterclockwise => "counterclockwise",
    }
}
