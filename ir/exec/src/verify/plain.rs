//! Plain lines that two texts say alike.

use ncc_ir::canon::Distance;
use ncc_ir::expr::Expr;
use ncc_ir::program::{Op, Point, Stmt};

/// Whether two statements are the same plain move or feed, so that controls in the same state do
/// the same. What is not so plain is left to execution.
pub fn same_plain(a: &Stmt, b: &Stmt) -> bool {
    let value = |a: &Expr, b: &Expr| match (a, b) {
        (Expr::Num(a), Expr::Num(b)) => a.mantissa == b.mantissa && a.scale == b.scale && a.unit == b.unit,
        (Expr::Node(_), _) | (_, Expr::Node(_)) => false,
    };
    let words = |a: &Point, b: &Point| {
        a.axes[..3].iter().zip(&b.axes[..3]).all(|(a, b)| match (a, b) {
            (None, None) => true,
            (Some(a), Some(b)) => a.distance == b.distance && value(&a.value, &b.value),
            (None, Some(_)) | (Some(_), None) => false,
        }) && a.axes[3..].iter().chain(&b.axes[3..]).all(Option::is_none)
    };
    if a.skip != b.skip {
        return false;
    }
    match (&a.op, &b.op) {
        // How far rotary axes turn, and how long a cut with them takes, each control counts for itself.
        (Op::StraightFeed(a), Op::StraightFeed(b))
        | (Op::StraightTraverse(a), Op::StraightTraverse(b))
        | (Op::Position(a), Op::Position(b)) => words(&a.to, &b.to),
        (Op::SetFeedRate(a), Op::SetFeedRate(b)) => value(a, b),
        _ => false,
    }
}

/// Whether a plain move has a word that says itself that it counts from where the axis stands.
pub fn counts_from_there(stmt: &Stmt) -> bool {
    let (Op::StraightFeed(m) | Op::StraightTraverse(m) | Op::Position(m)) = &stmt.op else { return false };
    m.to.axes.iter().flatten().any(|word| word.distance.known() == Some(Distance::Incremental))
}
