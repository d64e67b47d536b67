//! Blocks that are nothing but a hole or an arc, written straight from their statements where nothing is to be stated besides.
//!
//! ```text
//! X10. Y20. under a cycle that the text has activated | G2 X10. Y0. I5. J0.
//! ```
//!
//! Anything unusual is left untouched to the general way (`cycle`, `motion`), which writes the same text.
//!
//! Not here: straight moves, which all languages write so (`common::words`).

use ncc_ir::canon::{Axis, Units};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Unit;
use ncc_ir::program::{Arc, Centre, CentreFrom, Point, Stmt};

use super::{Modal, Writer};
use crate::common::number::{self, Format};
use crate::common::table::WritesBlocks;
use crate::common::words::Behind;

impl Writer {
    /// Writes a block that is nothing but a hole of the active cycle, or leaves it untouched.
    pub(super) fn plain_hole(&mut self, stmt: &Stmt, to: &Point, out: &mut Vec<u8>) -> bool {
        let tracker = &self.words.tracker;
        let plane = tracker.cycle.as_ref().and_then(|in_force| tracker.plane(in_force.cycle.plane));
        let Some(normal) = plane.map(|plane| plane.axes().2) else { return false };
        let plain = self.standing.modal == Modal::On
            && self.owed.is_none()
            && !(self.raw || self.stale)
            && self.hole_plane() == plane
            && to.get(normal).is_none()
            && self.variables.executed
            && self.computing.word_distance.is_empty();
        let written = plain && self.words.plain_point(stmt, to, out);
        if written {
            // Its words are those of a line; the axis along which it is drilled stands where the cycle leaves it.
            self.words.tracker.out_of_hole();
        }
        written
    }

    /// Writes a block that is nothing but an arc about a centre that counts from its start, or by its radius; or leaves it
    /// untouched.
    pub(super) fn plain_arc(&mut self, stmt: &Stmt, arc: &Arc, out: &mut Vec<u8>) -> bool {
        let Some(plane) = arc.plane.known().filter(|_| self.writes_plainly() && self.variables.executed)
        else {
            return false;
        };
        let Some(units) = self.words.active.units else { return false };
        let unit = if units == Units::Inch { Unit::Inch } else { Unit::Mm };
        let word = |name, value: &Expr, format: &Format| {
            let num = value.literal().filter(|num| num.unit == unit)?;
            Some(Behind { name, value: number::plain(num, format)? })
        };
        let mut centre = [Behind::NONE; 3];
        let mut many = 0;
        match &arc.centre {
            Centre::Radius(radius) => {
                let Some((name, format)) = &self.radius else { return false };
                let Some(radius) = word(name.as_str(), radius, format) else { return false };
                (centre[0], many) = (radius, 1);
            }
            Centre::Point { words, from: CentreFrom::Start } => {
                for (axis, value) in [Axis::X, Axis::Y, Axis::Z].into_iter().zip(words) {
                    let Some(value) = value.as_ref().filter(|_| plane.axes().2 != axis) else { continue };
                    let Ok(letter) = self.words.centre_letter(axis) else { return false };
                    let name = match letter.letter {
                        b'I' => "I",
                        b'J' => "J",
                        b'K' => "K",
                        _ => return false,
                    };
                    let Some(word) = word(name, value, &letter.format) else { return false };
                    (centre[many], many) = (word, many + 1);
                }
            }
            Centre::Point { .. } => return false,
        }
        self.words.plain_arc(stmt, arc, &centre[..many], out)
    }
}
