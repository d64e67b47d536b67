//! Comparisons of whole numbers: what they compare, their opposites, and the same from the other side.

use ncc_ir::expr::{Binary, Expr, Function, Node, Var};

/// A comparison, as whole numbers have it: within a tolerance they are the same, or one apart at least.
pub(super) fn compared(node: &Node) -> Option<(Binary, &Expr, &Expr)> {
    let apart = |e: &'_ Expr| -> Option<bool> {
        let Expr::Num(n) = e else { return None };
        let one = 10_i64.checked_pow(u32::from(n.scale))?;
        (n.mantissa != 0 && n.mantissa.checked_abs()? < one).then_some(n.mantissa > 0)
    };
    match node {
        Node::Call(Function::Near | Function::NearRatio, of) => match &of[..] {
            [a, b, within] if apart(within) == Some(true) => Some((Binary::Equal, a, b)),
            _ => None,
        },
        Node::Binary(operator, Expr::Node(of), within) if apart(within).is_some() => {
            let above = apart(within)?;
            match (operator, &**of) {
                (Binary::Less, Node::Binary(Binary::Subtract, a, b)) if above => {
                    Some((Binary::LessOrEqual, a, b))
                }
                (Binary::Greater, Node::Binary(Binary::Subtract, a, b)) if !above => {
                    Some((Binary::GreaterOrEqual, a, b))
                }
                (Binary::Less | Binary::GreaterOrEqual, Node::Call(Function::Abs, of)) if above => {
                    let [Expr::Node(of)] = &of[..] else { return None };
                    let Node::Binary(Binary::Subtract, a, b) = &**of else { return None };
                    let same = *operator == Binary::Less;
                    Some((if same { Binary::Equal } else { Binary::NotEqual }, a, b))
                }
                _ => None,
            }
        }
        Node::Binary(operator, a, b) => Some((*operator, a, b)),
        _ => None,
    }
}

/// The comparison that holds where another does not.
pub(super) fn opposite(operator: Binary) -> Option<Binary> {
    Some(match operator {
        Binary::Equal => Binary::NotEqual,
        Binary::NotEqual => Binary::Equal,
        Binary::Less => Binary::GreaterOrEqual,
        Binary::GreaterOrEqual => Binary::Less,
        Binary::Greater => Binary::LessOrEqual,
        Binary::LessOrEqual => Binary::Greater,
        _ => return None,
    })
}

/// The same comparison from the other side.
pub(super) fn turned(operator: Binary) -> Binary {
    match operator {
        Binary::Less => Binary::Greater,
        Binary::Greater => Binary::Less,
        Binary::LessOrEqual => Binary::GreaterOrEqual,
        Binary::GreaterOrEqual => Binary::LessOrEqual,
        same => same,
    }
}

/// The variable that an expression is, with a value or whether it has one or not.
pub(super) fn variable(e: &Expr) -> Option<&Var> {
    let Expr::Node(node) = e else { return None };
    match &**node {
        Node::Var(var) => Some(var),
        Node::Call(Function::Given, of) => variable(of.first()?),
        _ => None,
    }
}
