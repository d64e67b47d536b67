//! What a control of O words works out though it passes it over, so that it must not fail there.
//!
//! Not here: variables that have no value where they are passed over; a program sets them before.

use ncc_ir::expr::{Binary, Expr, Function, Node};

/// Whether a value may be one that cannot be worked out. The control works out an `elseif` that it passes over, and a
/// `return` or `endsub` where the subprogram is defined (LinuxCNC's interpreter, run), and stops if it cannot.
pub(super) fn may_fail(value: &Expr) -> bool {
    let own = match value {
        Expr::Num(_) => false,
        Expr::Node(node) => match &**node {
            Node::Binary(Binary::Divide | Binary::Modulo, _, by) => by.literal().is_none_or(|n| n.is_zero()),
            Node::Binary(Binary::Power, _, by) => by.literal().and_then(|n| n.whole()).is_none_or(|n| n < 0),
            Node::Element(_) => true,
            Node::Call(Function::Remainder, of) => {
                of.get(1).and_then(Expr::literal).is_none_or(|n| n.is_zero())
            }
            Node::Call(function, _) => !matches!(
                function,
                Function::Sin
                    | Function::Cos
                    | Function::Atan2
                    | Function::Abs
                    | Function::Round
                    | Function::RoundUp
                    | Function::Floor
                    | Function::Ceiling
                    | Function::Truncate
                    | Function::Min
                    | Function::Max
                    | Function::Given
                    | Function::Near
                    | Function::NearRatio
            ),
            Node::Var(_) | Node::Vacant | Node::Unary(..) | Node::Binary(..) => false,
        },
    };
    own || value.parts().any(may_fail)
}
