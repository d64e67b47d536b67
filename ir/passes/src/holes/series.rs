//! Expands consecutive holes of one cycle: each repeats the moves of the hole before it at another position.
//!
//! ```text
//! X10. Y20. / X30. / Y5.    →    four moves each; only the move in the plane differs
//! ```
//!
//! After a hole the tool is at the return level of the cycle. So all holes after the first start at one level, and nothing
//! between them changes the other moves.
//!
//! Not here: what these moves are (`expand_cycles`).

use crate::support::walk::Walk;
use crate::support::write::{Rebuild, at, is_absolute, traverse};
use ncc_ir::canon::Axis;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::{Op, Point, Stmt};

/// The moves of a hole but the one in the plane; `true` marks those that stand in the block of the one before.
pub(super) struct Series {
    /// The level where the tool is before it.
    pub(super) from: Nanos,
    pub(super) moves: Vec<(bool, Op)>,
    /// Before which of them the move in the plane comes.
    pub(super) place: usize,
}

impl Series {
    /// Puts the moves of a hole in the place of its statement, which no switch skips: `over` is the way in the plane, if
    /// there is one.
    pub(super) fn write(&self, stmt: Stmt, over: Option<Point>, made: &mut Rebuild) {
        let (before, behind) = self.moves.split_at(self.place);
        let over = over.map(|over| (false, traverse(over)));
        let moves = before.iter().cloned().chain(over).chain(behind.iter().cloned());
        if stmt.joined || stmt.number.is_some() || stmt.comment.is_some() || self.moves.is_empty() {
            return made.replace(stmt, moves);
        }
        made.blocks(stmt.span, moves);
    }
}

/// The words of a point in the plane, absolute where that is known; and whether the tool goes anywhere by them.
pub(super) fn over_hole(walk: &Walk, to: &Point, normal: Axis) -> (Point, bool) {
    let here = &walk.at;
    let mut over = to.clone();
    over.axes[normal as usize] = None;
    // A waiting length offset takes effect at the next Z word, even if the tool is at that Z already.
    let mut goes = walk.waiting && over.get(Axis::Z).is_some();
    for (axis, word) in Axis::ALL.into_iter().zip(&mut over.axes) {
        let Some(coord) = word else { continue };
        let from = here.position[axis as usize];
        let known = here.resolve(coord, from);
        goes |= from.is_none() || known != from;
        if let (false, Some(nanos)) = (is_absolute(coord, here.modes.distance), known) {
            *coord = at(nanos, axis, walk.unit());
        }
    }
    (over, goes)
}
