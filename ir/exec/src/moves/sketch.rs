//! Statements for the tests of moves, by words in thousandths of a millimetre.

use ncc_ir::canon::{AXES, Distance, Fact, Plane, ReturnLevel};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::{Approach, Cycle, CycleKind};
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

/// A hole at absolute words of X and Y.
pub(crate) fn hole(x: i64, y: i64) -> Stmt {
    stmt(Op::Hole(to([Some(x), Some(y), None])))
}

/// Drilling in the plane XY from 2 mm down to -20 mm, left at 2 mm.
pub(crate) fn drilling() -> Cycle {
    Cycle {
        kind: CycleKind::Drill,
        plane: Fact::Known(Plane::Xy),
        retract: word(2_000),
        reference: None,
        depth: word(-20_000),
        return_level: Fact::Known(ReturnLevel::Retract),
        return_plane: None,
        approach: Approach::PlaneFirst,
        feed: None,
    }
}
