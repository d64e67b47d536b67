//! NC0808: a number without a decimal point that counts increments, in a program whose other numbers
//! have points. Where no number has one, that is the programmer's habit, and nothing is found.

use ncc_ir::expr::Expr;
use ncc_ir::num::Num;
use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;

use crate::finding::What;
use crate::watch::Checker;

/// So many numbers are kept.
const MOST: usize = 1000;

/// Numbers that were met.
#[derive(Debug, Default)]
pub(crate) struct Met {
    bare: Vec<(Span, Num, Num)>,
    /// Whether any length has a point.
    pointed: bool,
}

/// A number without a point.
pub(crate) fn note(checker: &mut Checker, span: Span, read: Num, with_point: Num) {
    let met = &mut checker.points;
    // A block may be looked at twice.
    if met.bare.len() < MOST && met.bare.iter().rev().take(16).all(|(other, ..)| *other != span) {
        met.bare.push((span, read, with_point));
    }
}

/// A statement: whether it has a length with a point.
#[inline]
pub(crate) fn look(checker: &mut Checker, stmt: &Stmt) {
    if checker.points.pointed {
        return;
    }
    let (Op::StraightFeed(m) | Op::StraightTraverse(m) | Op::Position(m) | Op::Hole(m)) = &stmt.op else {
        return;
    };
    let point =
        m.to.axes
            .iter()
            .flatten()
            .any(|word| matches!(&word.value, Expr::Num(num) if num.point && num.mantissa != 0));
    let bare = &checker.points.bare;
    let own = bare.iter().any(|(span, ..)| span.start >= stmt.span.start && span.end <= stmt.span.end);
    checker.points.pointed = point && !own;
}

/// The program is over.
pub(crate) fn finish(checker: &mut Checker) {
    if checker.points.pointed {
        for (span, read, with_point) in std::mem::take(&mut checker.points.bare) {
            checker.find(What::BareNumber { read, with_point }, span);
        }
    }
}
