//! Comparisons as controls make them: of numbers that are nearly equal, of those that are less than some amount apart,
//! and to the least bit where a control has only some of them so.

use ncc_ir::expr::num::Num;
use ncc_ir::expr::{Binary, Expr, Function, Node, Unary};

/// A comparison that finds equal what is nearly so, as a control does it by itself.
pub(crate) fn nearly(node: &Node) -> Option<(Binary, &Expr, &Expr)> {
    fn equal(e: &Expr) -> Option<(&Expr, &Expr)> {
        let Expr::Node(node) = e else { return None };
        match &**node {
            Node::Call(Function::NearRatio, arguments) => match &arguments[..] {
                [a, b, _] => Some((a, b)),
                _ => None,
            },
            _ => None,
        }
    }
    fn other(e: &Expr) -> Option<(&Expr, &Expr)> {
        let Expr::Node(node) = e else { return None };
        match &**node {
            Node::Unary(Unary::Not, a) => equal(a),
            _ => None,
        }
    }
    fn compares(e: &Expr) -> Option<(Binary, &Expr, &Expr)> {
        let Expr::Node(node) = e else { return None };
        match &**node {
            Node::Binary(operator, a, b) => Some((*operator, a, b)),
            _ => None,
        }
    }
    match node {
        Node::Call(Function::NearRatio, arguments) => match &arguments[..] {
            [a, b, _] => Some((Binary::Equal, a, b)),
            _ => None,
        },
        Node::Unary(Unary::Not, a) => equal(a).map(|(a, b)| (Binary::NotEqual, a, b)),
        Node::Binary(Binary::And, exact, near) => {
            let found = compares(exact)?;
            let same = other(near) == Some((found.1, found.2));
            (same && matches!(found.0, Binary::Less | Binary::Greater)).then_some(found)
        }
        Node::Binary(Binary::Or, exact, near) => {
            let found = compares(exact)?;
            let same = equal(near) == Some((found.1, found.2));
            (same && matches!(found.0, Binary::LessOrEqual | Binary::GreaterOrEqual)).then_some(found)
        }
        _ => None,
    }
}

/// Whether an expression is worth 1 or 0.
pub(crate) fn holds_or_not(e: &Expr) -> bool {
    matches!(e, Expr::Node(node) if decides(node))
}

/// Whether the value of this is a truth value.
pub(crate) fn decides(node: &Node) -> bool {
    match node {
        Node::Unary(operator, _) => *operator == Unary::Not,
        Node::Binary(operator, ..) => operator.decides(),
        Node::Call(function, _) => matches!(function, Function::Near | Function::NearRatio),
        Node::Var(_) | Node::Element(_) | Node::Vacant => false,
    }
}

/// A comparison that finds equal what is less than this apart, as a control does it by itself.
pub(crate) fn within(node: &Node, tolerance: Num) -> Option<(Binary, &Expr, &Expr)> {
    fn apart(e: &Expr) -> Option<(&Expr, &Expr)> {
        let Expr::Node(node) = e else { return None };
        match &**node {
            Node::Binary(Binary::Subtract, a, b) => Some((a, b)),
            _ => None,
        }
    }
    let Node::Binary(operator, by, Expr::Num(limit)) = node else { return None };
    let same = |n: Num| limit.mantissa == n.mantissa && limit.scale == n.scale && limit.unit == n.unit;
    let below = Num { mantissa: -tolerance.mantissa, ..tolerance };
    let difference = || {
        let Expr::Node(node) = by else { return None };
        match &**node {
            Node::Call(Function::Abs, arguments) => apart(arguments.first()?),
            _ => None,
        }
    };
    let (found, (a, b)) = match operator {
        Binary::Less if same(tolerance) => match difference() {
            Some(both) => (Binary::Equal, both),
            None => (Binary::LessOrEqual, apart(by)?),
        },
        Binary::GreaterOrEqual if same(tolerance) => (Binary::NotEqual, difference()?),
        Binary::Greater if same(below) => (Binary::GreaterOrEqual, apart(by)?),
        _ => return None,
    };
    Some((found, a, b))
}

/// A comparison to the least bit, in `LT` and `GT`, which are so on a control whose others are not; `true` where it is
/// the opposite of what is given.
pub(crate) fn exactly(node: &Node) -> Option<(Expr, bool)> {
    let Node::Binary(operator, a, b) = node else { return None };
    if [a, b].iter().any(|e| matches!(e, Expr::Node(node) if **node == Node::Vacant)) {
        return None;
    }
    let of =
        |operator, a: &Expr, b: &Expr| Expr::Node(Box::new(Node::Binary(operator, a.clone(), b.clone())));
    let apart = || of(Binary::Or, &of(Binary::Less, a, b), &of(Binary::Greater, a, b));
    match operator {
        Binary::LessOrEqual => Some((of(Binary::Greater, a, b), true)),
        Binary::GreaterOrEqual => Some((of(Binary::Less, a, b), true)),
        Binary::Equal => Some((apart(), true)),
        Binary::NotEqual => Some((apart(), false)),
        _ => None,
    }
}

/// The opposite of a comparison, where one comparison says it too; `tolerance` is that of the control's own, if any.
pub(crate) fn flipped(e: &Expr, tolerance: Option<Num>) -> Option<Expr> {
    let Expr::Node(node) = e else { return None };
    let Node::Binary(operator, a, b) = &**node else { return None };
    // Of those within a tolerance, only the same and not the same are each other's opposite.
    let own = tolerance.and_then(|tolerance| within(node, tolerance));
    if own.is_some_and(|(found, ..)| !matches!(found, Binary::Equal | Binary::NotEqual)) {
        return None;
    }
    let other = match operator {
        Binary::Equal => Binary::NotEqual,
        Binary::NotEqual => Binary::Equal,
        Binary::Less => Binary::GreaterOrEqual,
        Binary::LessOrEqual => Binary::Greater,
        Binary::Greater => Binary::LessOrEqual,
        Binary::GreaterOrEqual => Binary::Less,
        _ => return None,
    };
    Some(Expr::Node(Box::new(Node::Binary(other, a.clone(), b.clone()))))
}
