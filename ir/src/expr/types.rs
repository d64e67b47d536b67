//! Types of expressions, by what variables are declared to hold.
//!
//! As the languages with types have it: a sum, a difference, a product and a remainder of whole numbers are whole, a
//! quotient is not; what is rounded is whole; a comparison is a truth value (Siemens, Job planning 03/2006, 1.6 and 1.7).
//!
//! Not here: values (`value`), and converting one type into another, which a program says where it assigns.

use std::collections::HashMap;

use crate::expr::{Binary, Expr, Function, Many, Node, Unary, Var};
use crate::program::{Op, Procedure, Stmt, Type};

/// What the variables of a procedure hold; what is not declared is any number.
#[derive(Clone, Debug, Default)]
pub struct Types {
    held: HashMap<Var, Type>,
}

impl Types {
    /// Those of a procedure.
    pub fn of_procedure(procedure: &Procedure) -> Types {
        let mut types = Types::default();
        for (var, kind) in procedure.parameters.iter().zip(&procedure.kinds) {
            types.held.insert(var.clone(), *kind);
        }
        types.look(&procedure.body);
        types
    }

    fn look(&mut self, body: &[Stmt]) {
        for stmt in body {
            match &stmt.op {
                Op::Declare(declare) => {
                    self.held.insert(declare.var.clone(), declare.kind);
                }
                Op::Control(control) => control.bodies().for_each(|body| self.look(body)),
                _ => {}
            }
        }
    }

    /// What a variable holds.
    pub fn of_var(&self, var: &Var) -> Type {
        self.held.get(var).copied().unwrap_or(Type::Real)
    }

    /// What one of many variables holds.
    pub fn of_many(&self, many: &Many) -> Type {
        match many {
            Many::Array { var, .. } => self.of_var(var),
            Many::Numbered(_) => Type::Real,
        }
    }

    /// The type of an expression.
    pub fn type_of(&self, expr: &Expr) -> Type {
        let node = match expr {
            Expr::Num(n) if n.point || n.scale > 0 => return Type::Real,
            Expr::Num(_) => return Type::Int,
            Expr::Node(node) => &**node,
        };
        let number = |a: &Expr| if self.type_of(a) == Type::Real { Type::Real } else { Type::Int };
        let both = |a: &Expr, b: &Expr| if self.are_whole(a) { number(b) } else { Type::Real };
        match node {
            Node::Var(var) => self.of_var(var),
            Node::Element(element) => self.of_many(&element.of),
            Node::Vacant => Type::Real,
            Node::Unary(Unary::Negate, a) => number(a),
            Node::Unary(Unary::Not, _) => Type::Bool,
            Node::Binary(operator, ..) if operator.decides() => Type::Bool,
            Node::Binary(Binary::Divide | Binary::Power, ..) => Type::Real,
            Node::Binary(_, a, b) => both(a, b),
            Node::Call(function, arguments) => match (function, &arguments[..]) {
                (Function::Abs, [a]) => number(a),
                (Function::Min | Function::Max, [a, b]) => both(a, b),
                (
                    Function::Round
                    | Function::Truncate
                    | Function::Ceiling
                    | Function::BitAnd
                    | Function::BitOr
                    | Function::BitXor,
                    _,
                ) => Type::Int,
                (Function::Near | Function::NearRatio, _) => Type::Bool,
                _ => Type::Real,
            },
        }
    }

    /// Whether an expression is a whole number, or a truth value.
    pub fn are_whole(&self, expr: &Expr) -> bool {
        self.type_of(expr) != Type::Real
    }
}
