//! Statements for the tests of moves, by words in thousandths of a millimetre.

use ncc_ir::canon::{AXES, Distance, Fact};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::{Coord, Move, Op, Point, Stmt};
use ncc_ir::source::Span;

pub(crate) fn stmt(op: Op) -> Stmt {
    Stmt::new(Span::default(), op)
}

pub(crate) fn mm(thousandths: i64) -> Expr {
    Expr::Num(Num { mantissa: thousandths, scale: 3, point: true, unit: Unit::Mm })
}

/// An absolute word.
pub(crate) fn word(thousandths: i64) -> Coord {
    Coord { value: mm(thousandths), distance: Fact::Known(Distance::Absolute) }
}

/// A move by absolute words of X, Y and Z.
pub(crate) fn to(words: [Option<i64>; 3]) -> Move {
    let mut axes: [Option<Coord>; AXES] = Default::default();
    for (axis, value) in axes.iter_mut().zip(words) {
        *axis = value.map(word);
    }
    Move { to: Point { axes }, said: true }
}
