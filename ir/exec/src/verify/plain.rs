//! Plain lines and arcs that two texts say alike.

use ncc_ir::canon::Distance;
use ncc_ir::expr::Expr;
use ncc_ir::program::{Arc, Centre, CentreFrom, Op, Point, Stmt};

#[inline]
fn same_value(a: &Expr, b: &Expr) -> bool {
    match (a, b) {
        (Expr::Num(a), Expr::Num(b)) => a.mantissa == b.mantissa && a.scale == b.scale && a.unit == b.unit,
        (Expr::Node(_), _) | (_, Expr::Node(_)) => false,
    }
}

/// Whether two points have the same words, none of them of a rotary axis.
#[inline]
fn same_words(a: &Point, b: &Point) -> bool {
    a.axes[..3].iter().zip(&b.axes[..3]).all(|(a, b)| match (a, b) {
        (None, None) => true,
        (Some(a), Some(b)) => a.distance == b.distance && same_value(&a.value, &b.value),
        (None, Some(_)) | (Some(_), None) => false,
    }) && a.axes[3..].iter().chain(&b.axes[3..]).all(Option::is_none)
}

/// Whether two statements are the same plain move or feed, so that controls in the same state do
/// the same. What is not so plain is left to execution.
pub fn same_plain(a: &Stmt, b: &Stmt) -> bool {
    let (value, words) = (same_value, same_words);
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

/// Whether a statement is for the reader alone.
pub(crate) fn is_silent(stmt: &Stmt) -> bool {
    matches!(stmt.op, Op::Comment(_) | Op::Blank)
}

/// Whether two texts say the same one by one, whatever remarks are between it.
fn each_same(a: &[Stmt], b: &[Stmt], same: impl Fn(&Stmt, &Stmt) -> bool) -> bool {
    let mut others = b.iter().filter(|stmt| !is_silent(stmt));
    a.iter().filter(|stmt| !is_silent(stmt)).all(|a| others.next().is_some_and(|b| same(a, b)))
        && others.next().is_none()
}

/// Whether two texts say the same plain moves and feeds ([`same_plain`]).
pub fn same_lines(a: &[Stmt], b: &[Stmt]) -> bool {
    each_same(a, b, same_plain)
}

/// Whether two texts say the same plain moves, feeds and arcs.
pub fn same_arcs(a: &[Stmt], b: &[Stmt]) -> bool {
    each_same(a, b, |a, b| match (&a.op, &b.op) {
        (Op::ArcFeed(x), Op::ArcFeed(y)) => a.skip == b.skip && same_arc(x, y),
        _ => same_plain(a, b),
    })
}

/// Whether two arcs have the same words. (A word of the centre that counts from the start says nothing as 0.)
fn same_arc(a: &Arc, b: &Arc) -> bool {
    let centre = match (&a.centre, &b.centre) {
        (Centre::Radius(a), Centre::Radius(b)) => same_value(a, b),
        (Centre::Point { words: a, from }, Centre::Point { words: b, from: other }) => {
            let nothing = |word: &Expr| {
                *from == CentreFrom::Start && word.literal().is_some_and(|number| number.is_zero())
            };
            from == other
                && a.iter().zip(b).all(|(a, b)| match (a, b) {
                    (None, None) => true,
                    (Some(a), Some(b)) => same_value(a, b),
                    (Some(word), None) | (None, Some(word)) => nothing(word),
                })
        }
        (Centre::Radius(_), Centre::Point { .. }) | (Centre::Point { .. }, Centre::Radius(_)) => false,
    };
    let same = a.plane == b.plane && a.turn == b.turn && same_value(&a.turns.0, &b.turns.0);
    same && centre && same_words(&a.to, &b.to)
}
