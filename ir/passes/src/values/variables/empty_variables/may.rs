//! Whether a variable or an expression may be empty at a place, and calls.

use crate::support::shared_map::SharedMap;
use ncc_ir::expr::value;
use ncc_ir::expr::{Binary, Expr, Function, Node, Unary, Var};
use ncc_ir::program::{Call, Op, Stmt, Text};

/// The possible values of a variable or an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::values::variables) enum May {
    /// Empty.
    Nothing,
    /// A number.
    Number,
    /// Either.
    Either,
}

impl May {
    pub(in crate::values::variables) fn or(self, other: May) -> May {
        if self == other { self } else { May::Either }
    }
}

/// The possible values of the local variables at a place; a variable that is not listed is empty.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::values::variables) struct Known {
    pub(in crate::values::variables) vars: SharedMap<Text, May>,
    /// Any value: too many nested calls.
    pub(in crate::values::variables) lost: bool,
}

impl Known {
    pub(in crate::values::variables) fn value_of(&self, name: &str) -> May {
        let otherwise = if self.lost { May::Either } else { May::Nothing };
        self.vars.get(name).copied().unwrap_or(otherwise)
    }

    pub(in crate::values::variables) fn or(&self, other: &Known) -> Known {
        let [own, theirs] = [self, other].map(|known| if known.lost { May::Either } else { May::Nothing });
        let mut vars = self.vars.clone();
        vars.join(&other.vars, |a, b| Some(a.copied().unwrap_or(own).or(b.copied().unwrap_or(theirs))));
        Known { vars, lost: self.lost || other.lost }
    }
}

/// Merges two paths.
pub(in crate::values::variables) type Way = Option<Known>;

pub(in crate::values::variables) fn either(a: Way, b: Way) -> Way {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.or(&b)),
        (a, None) => a,
        (None, b) => b,
    }
}

pub(in crate::values::variables) fn is_nothing(e: &Expr) -> bool {
    matches!(e, Expr::Node(node) if **node == Node::Vacant)
}

pub(in crate::values::variables) fn nothing() -> Expr {
    Expr::Node(Box::new(Node::Vacant))
}

/// Visits every call of a body.
pub(in crate::values::variables) fn calls(body: &mut [Stmt], seen: &mut dyn FnMut(&mut Call)) {
    for stmt in body {
        match &mut stmt.op {
            Op::Call(call) => seen(call),
            Op::Control(control) => control.bodies_mut().for_each(|body| calls(body, seen)),
            _ => {}
        }
    }
}

/// The possible values of an expression: an empty variable, also with a sign or rounded, is empty.
pub(in crate::values::variables) fn may(e: &Expr, known: &Known) -> May {
    let Expr::Node(node) = e else { return May::Number };
    match &**node {
        Node::Vacant => May::Nothing,
        Node::Var(Var::Local(name)) => known.value_of(name),
        Node::Unary(Unary::Negate, a) => may(a, known),
        Node::Call(Function::RoundTo, arguments) => {
            arguments.first().map_or(May::Number, |first| may(first, known))
        }
        Node::Var(_) | Node::Element(_) | Node::Unary(..) | Node::Binary(..) | Node::Call(..) => May::Number,
    }
}

/// Whether a condition holds, if the empty variables decide it.
pub(in crate::values::variables) fn holds(e: &Expr, known: &Known) -> Option<bool> {
    let Expr::Node(node) = e else { return None };
    match &**node {
        Node::Binary(operator @ (Binary::Equal | Binary::NotEqual), a, b) => {
            let same = match (may(a, known), may(b, known)) {
                (May::Nothing, May::Nothing) => true,
                (May::Nothing, May::Number) | (May::Number, May::Nothing) => false,
                _ => return None,
            };
            Some(same == (*operator == Binary::Equal))
        }
        Node::Binary(
            operator @ (Binary::Less | Binary::LessOrEqual | Binary::Greater | Binary::GreaterOrEqual),
            a,
            b,
        ) => {
            // An empty variable counts as zero.
            let zero = |e: &Expr| match e.literal() {
                Some(n) => Some((n.mantissa as f64 / 10_f64.powi(i32::from(n.scale)), false)),
                None => (may(e, known) == May::Nothing).then_some((0.0, true)),
            };
            let ((a, first), (b, second)) = (zero(a)?, zero(b)?);
            let result = value::binary(*operator, a, b).ok().filter(|_| first || second)?;
            Some(result != 0.0)
        }
        Node::Binary(Binary::And, a, b) => match (holds(a, known), holds(b, known)) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        },
        Node::Binary(Binary::Or, a, b) => match (holds(a, known), holds(b, known)) {
            (Some(true), _) | (_, Some(true)) => Some(true),
            (Some(false), Some(false)) => Some(false),
            _ => None,
        },
        Node::Unary(Unary::Not, a) => holds(a, known).map(|holds| !holds),
        _ => None,
    }
}
