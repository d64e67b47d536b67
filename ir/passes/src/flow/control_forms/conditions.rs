//! Conditions, and opposites that the target lacks.

use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Binary, Expr, Node, Unary};

/// The comparison that holds where another one does not.
const fn other(operator: Binary) -> Option<Binary> {
    Some(match operator {
        Binary::Equal => Binary::NotEqual,
        Binary::NotEqual => Binary::Equal,
        Binary::Less => Binary::GreaterOrEqual,
        Binary::GreaterOrEqual => Binary::Less,
        Binary::Greater => Binary::LessOrEqual,
        Binary::LessOrEqual => Binary::Greater,
        Binary::Add
        | Binary::Subtract
        | Binary::Multiply
        | Binary::Divide
        | Binary::Modulo
        | Binary::Power
        | Binary::And
        | Binary::Or
        | Binary::Xor => return None,
    })
}

/// Whether an expression is worth 1 where something holds, and else 0.
pub(super) fn is_condition(e: &Expr) -> bool {
    let Expr::Node(node) = e else { return false };
    match &**node {
        Node::Binary(operator, ..) => operator.decides(),
        Node::Unary(Unary::Not, _) => true,
        Node::Var(_) | Node::Element(_) | Node::Vacant | Node::Unary(Unary::Negate, _) | Node::Call(..) => {
            false
        }
    }
}

/// The condition that a comparison of another one with 0 or 1 is.
fn of_truth(node: &Node) -> Option<Expr> {
    let Node::Binary(operator @ (Binary::Equal | Binary::NotEqual), a, Expr::Num(n)) = node else {
        return None;
    };
    let one = *n == Num { point: n.point, ..Num::int(1, Unit::One) };
    if !is_condition(a) || !(one || n.is_zero()) {
        return None;
    }
    Some(if one == (*operator == Binary::Equal) { compared(a, false) } else { opposite(a, false) })
}

/// What holds where a condition does not. With `word`, a number has its opposite by a word for it; else it is
/// compared with zero, as every condition of such a control is a comparison.
pub(super) fn opposite(condition: &Expr, word: bool) -> Expr {
    let node = match condition {
        Expr::Num(n) => return Expr::int(i64::from(n.is_zero())),
        Expr::Node(node) => &**node,
    };
    if let Some(of) = of_truth(node).filter(|_| !word) {
        return opposite(&of, false);
    }
    match node {
        Node::Unary(Unary::Not, a) => compared(a, word),
        Node::Binary(operator, a, b) => match (other(*operator), operator) {
            (Some(other), _) => Expr::binary(other, a.clone(), b.clone()),
            // De Morgan.
            (None, Binary::And) => Expr::binary(Binary::Or, opposite(a, word), opposite(b, word)),
            (None, Binary::Or) => Expr::binary(Binary::And, opposite(a, word), opposite(b, word)),
            (None, Binary::Xor) => Expr::binary(Binary::Xor, opposite(a, word), compared(b, word)),
            (None, _) => not(condition, word),
        },
        Node::Var(_) | Node::Element(_) | Node::Vacant | Node::Unary(Unary::Negate, _) | Node::Call(..) => {
            not(condition, word)
        }
    }
}

/// The opposite of a number that stands for a condition.
fn not(number: &Expr, word: bool) -> Expr {
    match word {
        true => Expr::Node(Box::new(Node::Unary(Unary::Not, number.clone()))),
        false => Expr::binary(Binary::Equal, number.clone(), Expr::int(0)),
    }
}

/// A condition; a number that stands for one is compared with zero, unless the control takes numbers.
pub(super) fn compared(condition: &Expr, numbers: bool) -> Expr {
    if numbers {
        return condition.clone();
    }
    let node = match condition {
        Expr::Num(n) => return Expr::int(i64::from(!n.is_zero())),
        Expr::Node(node) => &**node,
    };
    if let Some(of) = of_truth(node) {
        return of;
    }
    if let Node::Binary(Binary::NotEqual, Expr::Num(n), Expr::Num(zero)) = node
        && zero.is_zero()
    {
        return Expr::int(i64::from(!n.is_zero()));
    }
    match node {
        Node::Unary(Unary::Not, a) => opposite(a, false),
        Node::Binary(operator, ..) if other(*operator).is_some() => condition.clone(),
        Node::Binary(operator @ (Binary::And | Binary::Or | Binary::Xor), a, b) => {
            Expr::binary(*operator, compared(a, false), compared(b, false))
        }
        Node::Binary(..)
        | Node::Var(_)
        | Node::Element(_)
        | Node::Vacant
        | Node::Unary(Unary::Negate, _)
        | Node::Call(..) => Expr::binary(Binary::NotEqual, condition.clone(), Expr::int(0)),
    }
}
