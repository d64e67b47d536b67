//! Values that may be none: what a control computes though it passes it over must not fail there.
//!
//! Not here: variables that have no value where they are passed over; a program sets them before.

use crate::expr::{Binary, Expr, Function, Node};

/// Whether a value may be one that cannot be computed. A control of O words computes an `elseif` that it passes over
/// (LinuxCNC's interpreter, run), and stops if it cannot.
pub fn may_fail(value: &Expr) -> bool {
    let own = match value {
        Expr::Num(_) => false,
        Expr::Node(node) => match &**node {
            Node::Binary(Binary::Divide | Binary::Modulo, _, by) => by.literal().is_none_or(|n| n.is_zero()),
            Node::Binary(Binary::Power, _, by) => {
                by.literal().and_then(|n| n.whole_number()).is_none_or(|n| n < 0)
            }
            Node::Element(_) => true,
            Node::Call(function, of) => fails(*function, of),
            Node::Var(_) | Node::Vacant | Node::Unary(..) | Node::Binary(..) => false,
        },
    };
    own || value.parts().any(may_fail)
}

fn fails(function: Function, of: &[Expr]) -> bool {
    match function {
        Function::Remainder => of.get(1).and_then(Expr::literal).is_none_or(|n| n.is_zero()),
        // Of some numbers they are not defined, or more than a number can hold.
        Function::Tan | Function::Asin | Function::Acos | Function::Sqrt | Function::Ln | Function::Exp => {
            true
        }
        Function::RoundTo | Function::BitAnd | Function::BitOr | Function::BitXor => true,
        Function::Sin | Function::Cos | Function::Atan2 | Function::Abs | Function::Min | Function::Max => {
            false
        }
        Function::Round | Function::RoundUp | Function::Floor | Function::Ceiling => false,
        Function::Truncate | Function::Given | Function::Near | Function::NearRatio => false,
    }
}
