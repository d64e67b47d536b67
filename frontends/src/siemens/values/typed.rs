//! The value of an expression, with its type.

use ncc_ir::expr::num::Num;
use ncc_ir::expr::{Expr, Node};

/// The type of a variable or an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::siemens) enum Kind {
    Real,
    Int,
    /// 1 where it holds, else 0.
    Bool,
    /// A text, which is never a value of an expression.
    Text,
}

/// An expression and its type.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::siemens) struct Typed {
    pub(in crate::siemens) expr: Expr,
    pub(in crate::siemens) kind: Kind,
}

impl Typed {
    pub(in crate::siemens) fn new(node: Node, kind: Kind) -> Typed {
        Typed { expr: Expr::Node(Box::new(node)), kind }
    }

    pub(super) fn literal(num: Num, kind: Kind) -> Typed {
        Typed { expr: Expr::Num(num), kind }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.expr.literal().is_some_and(Num::is_zero)
    }
}
