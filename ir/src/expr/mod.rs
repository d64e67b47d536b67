//! Expressions: the arguments of statements.
//!
//! Nearly every argument of a real program is a literal, so a literal is stored inline and
//! everything else after a box. The value of an expression is in `value`.
//!
//! ```text
//! 10.5mm                 a literal, with its unit and its digits
//! common:100 + 1         a variable and a literal
//! ```
//!
//! Not here: the spelling of a formula on any control.

pub mod decimals;
pub mod num;
pub mod partial_expr;
pub mod system;
pub mod types;
pub mod units;
pub mod value;

use std::borrow::Cow;
use std::slice::{from_mut, from_ref};

use crate::expr::num::{Num, Unit};
use crate::expr::system::System;

/// An argument.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// A decimal literal.
    Num(Num),
    /// Anything that must be computed.
    Node(Box<Node>),
}

/// A computed expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// The value of a variable.
    Var(Var),
    /// The value of one of many variables.
    Element(Element),
    /// "No value": a Fanuc variable that was never set. A value of its own, not zero.
    Vacant,
    /// Sign or logical negation.
    Unary(Unary, Expr),
    /// Two operands.
    Binary(Binary, Expr, Expr),
    /// A function of its arguments.
    Call(Function, Vec<Expr>),
}

/// A variable. The IR keeps variables apart by how long they live, not by a control's spelling.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Var {
    /// Lives as long as the call of its procedure.
    Local(Box<str>),
    /// Lives until power-off, seen by all procedures.
    Common(Box<str>),
    /// Survives power-off.
    Retentive(Box<str>),
    /// Something of the control itself, by its meaning.
    System(System),
}

/// One of many variables: which, is computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Element {
    /// Of which.
    pub of: Many,
    /// Which: one index for each size of an array, one number for variables that have numbers. A value that is
    /// not whole, or none of theirs, is a fault where it is executed; a control that rounds it says so in the
    /// expression.
    pub at: Vec<Expr>,
}

/// Many variables.
#[derive(Clone, Debug, PartialEq)]
pub enum Many {
    /// The elements of an array, in each direction from 0.
    Array {
        /// Its name.
        var: Var,
        /// How many in each direction; the last index changes first.
        sizes: Box<[u32]>,
    },
    /// Variables whose names are numbers.
    Numbered(Box<[Numbers]>),
}

/// Variables whose names are numbers after a prefix: `{common:R0 to 99}` are `common:R0`, `common:R1` and so on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Numbers {
    /// How long they live.
    pub scope: Scope,
    /// What stands before the number, if anything.
    pub prefix: Box<str>,
    /// The lowest number.
    pub from: u32,
    /// The highest one.
    pub to: u32,
}

/// How long a variable lives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scope {
    /// As [`Var::Local`].
    Local,
    /// As [`Var::Common`].
    Common,
    /// As [`Var::Retentive`].
    Retentive,
}

impl Scope {
    /// A variable that lives so long.
    pub fn var(self, name: &str) -> Var {
        match self {
            Scope::Local => Var::Local(name.into()),
            Scope::Common => Var::Common(name.into()),
            Scope::Retentive => Var::Retentive(name.into()),
        }
    }
}

/// What is given a value.
#[derive(Clone, Debug, PartialEq)]
pub enum Target {
    /// A variable.
    Var(Var),
    /// One of many.
    Element(Box<Element>),
}

impl From<Var> for Target {
    fn from(var: Var) -> Target {
        Target::Var(var)
    }
}

impl Var {
    /// Its name, without its kind.
    pub fn name(&self) -> Cow<'_, str> {
        match self {
            Var::Local(name) | Var::Common(name) | Var::Retentive(name) => Cow::Borrowed(name),
            Var::System(system) => Cow::Owned(system.to_string()),
        }
    }
}

/// Operators with one operand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unary {
    /// `-a`
    Negate,
    /// Logical not.
    Not,
}

/// Operators with two operands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // The names are the meaning.
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Modulo,
    Power,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    And,
    Or,
    Xor,
}

impl Binary {
    /// Whether the result is a truth value: a comparison, or truth values joined.
    pub const fn decides(self) -> bool {
        match self {
            Binary::Equal
            | Binary::NotEqual
            | Binary::Less
            | Binary::LessOrEqual
            | Binary::Greater
            | Binary::GreaterOrEqual
            | Binary::And
            | Binary::Or
            | Binary::Xor => true,
            Binary::Add
            | Binary::Subtract
            | Binary::Multiply
            | Binary::Divide
            | Binary::Modulo
            | Binary::Power => false,
        }
    }
}

/// Functions. Angles are degrees.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // The names are the meaning.
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan2,
    Sqrt,
    Abs,
    Round,
    RoundTo,
    RoundUp,
    Floor,
    Ceiling,
    Truncate,
    Ln,
    Exp,
    Min,
    Max,
    Remainder,
    Given,
    Near,
    NearRatio,
    BitAnd,
    BitOr,
    BitXor,
}

impl Expr {
    /// A whole number.
    pub const fn int(value: i64) -> Expr {
        Expr::Num(Num::int(value, Unit::One))
    }

    /// An operator between two operands.
    pub fn binary(operator: Binary, a: Expr, b: Expr) -> Expr {
        Expr::Node(Box::new(Node::Binary(operator, a, b)))
    }

    /// The sum of two, exact where both are numbers of one unit; else it is stated as it stands.
    pub fn plus(&self, other: &Expr) -> Expr {
        let exact = self.literal().zip(other.literal()).and_then(|(a, b)| a.plus(b));
        exact.map_or_else(|| Expr::binary(Binary::Add, self.operand(), other.operand()), Expr::from)
    }

    /// The difference of two, as [`Expr::plus`].
    pub fn minus(&self, other: &Expr) -> Expr {
        let exact = self.literal().zip(other.literal()).and_then(|(a, b)| a.minus(b));
        exact.map_or_else(|| Expr::binary(Binary::Subtract, self.operand(), other.operand()), Expr::from)
    }

    /// It as an operand of another expression: there a number has no unit, and counts in the active one.
    pub fn operand(&self) -> Expr {
        match self {
            Expr::Num(n) => Expr::Num(Num { unit: Unit::One, ..*n }),
            Expr::Node(_) => self.clone(),
        }
    }

    /// Whether it follows from what is given a value; of variables whose number is computed, any may be one.
    pub fn reads(&self, to: &Target) -> bool {
        let Expr::Node(node) = self else { return false };
        match (&**node, to) {
            (Node::Var(var), Target::Var(to)) => var == to,
            (Node::Var(_), Target::Element(_)) | (Node::Element(_), _) => true,
            _ => self.parts().any(|part| part.reads(to)),
        }
    }

    /// Whether anything in it is such.
    pub fn has(&self, such: &dyn Fn(&Node) -> bool) -> bool {
        matches!(self, Expr::Node(node) if such(node)) || self.parts().any(|part| part.has(such))
    }

    /// The expressions that it is made of, as they are written: operands, arguments, indices.
    pub fn parts(&self) -> impl Iterator<Item = &Expr> {
        let (first, second): (&[Expr], &[Expr]) = match self {
            Expr::Num(_) => (&[], &[]),
            Expr::Node(node) => match &**node {
                Node::Var(_) | Node::Vacant => (&[], &[]),
                Node::Element(element) => (&element.at, &[]),
                Node::Unary(_, a) => (from_ref(a), &[]),
                Node::Binary(_, a, b) => (from_ref(a), from_ref(b)),
                Node::Call(_, arguments) => (arguments, &[]),
            },
        };
        first.iter().chain(second)
    }

    /// As [`Expr::parts`], to be changed.
    pub fn parts_mut(&mut self) -> impl Iterator<Item = &mut Expr> {
        let (first, second): (&mut [Expr], &mut [Expr]) = match self {
            Expr::Num(_) => (&mut [], &mut []),
            Expr::Node(node) => match &mut **node {
                Node::Var(_) | Node::Vacant => (&mut [], &mut []),
                Node::Element(element) => (&mut element.at, &mut []),
                Node::Unary(_, a) => (from_mut(a), &mut []),
                Node::Binary(_, a, b) => (from_mut(a), from_mut(b)),
                Node::Call(_, arguments) => (arguments, &mut []),
            },
        };
        first.iter_mut().chain(second)
    }

    /// The literal, if it is one.
    pub fn literal(&self) -> Option<Num> {
        match self {
            Expr::Num(n) => Some(*n),
            Expr::Node(_) => None,
        }
    }
}

impl From<Num> for Expr {
    fn from(n: Num) -> Expr {
        Expr::Num(n)
    }
}

/// What is compared within a tolerance of not more than 1, and how.
pub fn compared<'e>(operator: Binary, by: &'e Expr, limit: Num) -> Option<(Binary, &'e Expr, &'e Expr)> {
    let apart = |e: &'e Expr| match e {
        Expr::Node(node) => match &**node {
            Node::Binary(Binary::Subtract, a, b) => Some((a, b)),
            _ => None,
        },
        Expr::Num(_) => None,
    };
    let difference = || {
        let Expr::Node(node) = by else { return None };
        match &**node {
            Node::Call(Function::Abs, arguments) => apart(arguments.first()?),
            _ => None,
        }
    };
    let one = 10_i64.checked_pow(limit.scale.into())?;
    if limit.unit != Unit::One || limit.mantissa == 0 || limit.mantissa.abs() > one {
        return None;
    }
    let (found, (a, b)) = match (operator, limit.mantissa > 0) {
        (Binary::Less, true) => match difference() {
            Some(both) => (Binary::Equal, both),
            None => (Binary::LessOrEqual, apart(by)?),
        },
        (Binary::GreaterOrEqual, true) => (Binary::NotEqual, difference()?),
        (Binary::Greater, false) => (Binary::GreaterOrEqual, apart(by)?),
        _ => return None,
    };
    Some((found, a, b))
}
