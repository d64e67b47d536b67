//! Ranges of whole numbers, and of what is computed from them.

use ncc_ir::expr::{Binary, Expr, Function, Node, Unary, Var};

/// Whole numbers from one to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Range {
    /// The least of them.
    pub(crate) from: i64,
    /// The greatest.
    pub(crate) to: i64,
}

impl Range {
    /// One number; none is known that a control may not hold exactly.
    pub(crate) fn only(number: i64) -> Option<Range> {
        (-MOST..=MOST).contains(&number).then_some(Range { from: number, to: number })
    }

    /// Those of both, and what lies between.
    pub(super) fn hull(self, other: Range) -> Range {
        Range { from: self.from.min(other.from), to: self.to.max(other.to) }
    }

    /// Of whatever two numbers of each come to.
    fn from_corners(corners: [Option<i64>; 4]) -> Option<Range> {
        let mut ranges = corners.into_iter().map(|number| number.and_then(Range::only));
        let first = ranges.next()??;
        ranges.try_fold(first, |range, next| Some(range.hull(next?)))
    }
}

/// The range of an expression, of which each value is whole then.
pub(crate) fn range(expr: &Expr, known: &dyn Fn(&Var) -> Option<Range>) -> Option<Range> {
    let node = match expr {
        Expr::Num(number) => return number.whole_number().and_then(Range::only),
        Expr::Node(node) => node,
    };
    match &**node {
        Node::Var(Var::System(_)) => None,
        Node::Var(var) => known(var),
        Node::Unary(Unary::Negate, a) => range(a, known).map(|a| Range { from: -a.to, to: -a.from }),
        Node::Binary(operator, a, b) => {
            let (a, b) = (range(a, known)?, range(b, known)?);
            let both = |of: fn(i64, i64) -> Option<i64>| {
                Range::from_corners([of(a.from, b.from), of(a.from, b.to), of(a.to, b.from), of(a.to, b.to)])
            };
            match operator {
                Binary::Add => both(i64::checked_add),
                Binary::Subtract => both(i64::checked_sub),
                Binary::Multiply => both(i64::checked_mul),
                _ => None,
            }
        }
        // What is whole stays what it is.
        Node::Call(
            Function::Given
            | Function::Round
            | Function::RoundTo
            | Function::Floor
            | Function::Truncate
            | Function::RoundUp,
            of,
        ) => range(of.first()?, known),
        Node::Element(_) | Node::Vacant | Node::Unary(Unary::Not, _) | Node::Call(..) => None,
    }
}

/// The greatest number that is reckoned with: each control holds those below it exactly.
const MOST: i64 = 10_000_000;
