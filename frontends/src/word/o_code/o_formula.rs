//! Expressions of a control with O words, as the grammar makes them (LinuxCNC 2.9, gcode/overview.html).
//!
//! Not here: which variable a parameter is (`parameters`).

use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::system::System;
use ncc_ir::expr::value;
use ncc_ir::expr::{Binary, Element, Expr, Function, Many, Node, Unary, Var};

use crate::word::macros::formula::{Formula, Index};

/// How far apart values are that are equal (overview, equality and floating-point values).
const EQUAL: Num = Num { mantissa: 1, scale: 6, point: true, unit: Unit::One };

/// A parameter as the text names it.
pub(super) fn named(name: String) -> Expr {
    Expr::Node(Box::new(Node::Var(Var::System(System::Other(name.into())))))
}

pub(super) fn node(node: Node) -> Expr {
    Expr::Node(Box::new(node))
}

impl Formula {
    /// A function of values; `None` is one that is refused, or nested too deep.
    pub(crate) fn call_function(function: Option<Function>, arguments: Vec<Formula>) -> Option<Formula> {
        Formula::call(function, arguments)
    }

    /// The opposite of a value.
    pub(crate) fn opposite(self) -> Option<Formula> {
        let depth = self.depth() + 1;
        match self.expr {
            Expr::Num(n) => Formula::within(Expr::Num(Num { mantissa: -n.mantissa, ..n }), depth),
            expr => Formula::within(node(Node::Unary(Unary::Negate, expr)), depth),
        }
    }

    /// Two values and what joins them; of logic, anything but zero holds, and what comes of it is a number.
    pub(crate) fn joined(operator: Binary, a: Formula, b: Formula) -> Option<Formula> {
        let depth = a.depth().max(b.depth()) + 1;
        Formula::within(node(Node::Binary(operator, a.expr, b.expr)), depth)
    }

    /// A comparison: what is less than a millionth apart is equal, and as such neither less nor greater by `LE` and
    /// `GE` (interp_execute.cc, execute_binary2: `LT` and `GT` compare as they are).
    pub(crate) fn compared(operator: Binary, a: Formula, b: Formula) -> Option<Formula> {
        let depth = a.depth().max(b.depth()) + 2;
        let (a, b) = (a.expr, b.expr);
        let apart = |a, b| node(Node::Binary(Binary::Subtract, a, b));
        let difference = |a, b| node(Node::Call(Function::Abs, vec![apart(a, b)]));
        let expr = match operator {
            Binary::Equal => node(Node::Binary(Binary::Less, difference(a, b), Expr::Num(EQUAL))),
            Binary::NotEqual => {
                node(Node::Binary(Binary::GreaterOrEqual, difference(a, b), Expr::Num(EQUAL)))
            }
            Binary::LessOrEqual => node(Node::Binary(Binary::Less, apart(a, b), Expr::Num(EQUAL))),
            Binary::GreaterOrEqual => {
                let least = Num { mantissa: -EQUAL.mantissa, ..EQUAL };
                node(Node::Binary(Binary::Greater, apart(a, b), Expr::Num(least)))
            }
            operator => node(Node::Binary(operator, a, b)),
        };
        Formula::within(expr, depth)
    }

    /// Whether a parameter with a name exists; `None` for one without (overview, functions: an error).
    pub(crate) fn exists(of: Index) -> Option<Formula> {
        let Index::Name(name) = of else { return None };
        let named = named(format!("#<{name}>"));
        Formula::within(node(Node::Binary(Binary::NotEqual, named, node(Node::Vacant))), 1)
    }

    /// The value of a parameter; `None` is no number of one.
    pub(crate) fn parameter(of: Index) -> Option<Formula> {
        match of {
            Index::Number(digits) => {
                let number = digits.to_whole().filter(|number| *number > 0)?;
                Formula::within(named(format!("#{number}")), 0)
            }
            Index::Name(name) => Formula::within(named(format!("#<{name}>")), 0),
            Index::Computed(formula) => {
                let depth = formula.depth() + 1;
                let element = Element { of: Many::Numbered(Box::new([])), at: vec![formula.expr] };
                Formula::within(node(Node::Element(element)), depth)
            }
        }
    }
}

/// Value of an expression without parameters.
pub(in crate::word) fn constant(expr: &Expr) -> Option<f64> {
    let node = match expr {
        Expr::Num(n) => return Some(n.mantissa as f64 / 10f64.powi(i32::from(n.scale))),
        Expr::Node(node) => &**node,
    };
    match node {
        Node::Var(_) | Node::Element(_) | Node::Vacant => None,
        Node::Unary(operator, a) => Some(value::unary(*operator, constant(a)?)),
        Node::Binary(operator, a, b) => value::binary(*operator, constant(a)?, constant(b)?).ok(),
        Node::Call(f, arguments) => match &arguments[..] {
            [a] if f.arguments() == 1 => value::function(*f, constant(a)?, 0.0).ok(),
            [a, b] if f.arguments() == 2 => value::function(*f, constant(a)?, constant(b)?).ok(),
            _ => None,
        },
    }
}
