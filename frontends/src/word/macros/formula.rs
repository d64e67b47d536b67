//! Expressions and statements of the macro language, as the grammar makes them.
//!
//! `AND`, `OR` and `XOR` join two conditions, or two whole numbers bit by bit (B-63684EN, custom macro, arithmetic and
//! logic operation: "logical operation performed on binary numbers bit by bit"); of one of each they are refused.
//! A condition is no number, and a number is no condition (16-C, custom macro: a condition stands in the
//! brackets of `IF` and `WHILE`; other controls store it, and none says as what).
//!
//! Not here: what rounding and angles mean where an expression stands, and which variables have numbers that are
//! computed (`computing`).

use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Binary, Element, Expr, Function, Many, Node, Target, Var};
use ncc_ir::program::Output;

use crate::common::words::Digits;

/// Deepest nesting of an expression.
const DEEPEST: u32 = 64;

/// An expression with what the grammar must know of it.
#[derive(Clone, Debug)]
pub(crate) struct Formula {
    pub(crate) expr: Expr,
    /// Whether it holds or not, in place of a number.
    pub(crate) condition: bool,
    depth: u32,
}

/// Where a jump goes.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum To {
    /// The block of a number.
    Number(u32),
    /// The block of a number that is computed.
    Computed(Expr),
}

impl To {
    /// A number that is computed; a condition is none.
    pub(crate) fn computed(of: Formula) -> Option<To> {
        (!of.condition).then_some(To::Computed(of.expr))
    }
}

/// A statement, or a part of one, in the order of the text.
#[derive(Clone, Debug)]
pub(crate) enum Piece {
    Assign(Target, Expr),
    If(Expr),
    Then,
    Goto(To),
    While(Expr),
    Do(u32),
    End(u32),
    Output(Option<Output>),
    /// What is refused already.
    Refused,
}

/// The statement of a block.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Statement {
    Assign(Target, Expr),
    /// A jump to a block number, if this holds.
    Goto(Option<Expr>, To),
    /// An assignment, if this holds.
    Then(Expr, Target, Expr),
    /// A loop with its number begins; without a condition it is endless.
    Do(Option<Expr>, u32),
    /// It ends.
    End(u32),
    /// Text for a device.
    Output(Option<Output>),
}

impl Formula {
    fn new(expr: Expr, depth: u32, condition: bool) -> Formula {
        Formula { expr, condition, depth }
    }

    /// An expression that is no condition; `None` is one that is nested too deep.
    pub(crate) fn within(expr: Expr, depth: u32) -> Option<Formula> {
        (depth <= DEEPEST).then(|| Formula::new(expr, depth, false))
    }

    /// How deep it is nested.
    pub(crate) fn depth(&self) -> u32 {
        self.depth
    }

    /// A literal.
    pub(crate) fn number(digits: Digits) -> Formula {
        let Digits { mantissa, scale, point } = digits;
        Formula::new(Expr::Num(Num { mantissa, scale, point, unit: Unit::One }), 0, false)
    }

    /// What stands for an expression that is refused.
    pub(crate) fn nothing() -> Formula {
        Formula::new(Expr::int(0), 0, false)
    }

    /// A variable by its number, written or computed; `#0` is nothing. `None` has no number (`##1` is written `#[#1]`:
    /// B-63684EN, custom macro, variables).
    pub(crate) fn variable(index: Index) -> Option<Formula> {
        let (node, depth) = match index {
            Index::Number(digits) => match digits.to_whole()? {
                0 => (Node::Vacant, 0),
                number => (Node::Var(variable(number)), 0),
            },
            Index::Computed(of) => {
                let depth = of.depth + 1;
                (Node::Element(indexed(of)?), depth)
            }
            Index::Name(_) => return None,
        };
        (depth <= DEEPEST).then(|| Formula::new(Expr::Node(Box::new(node)), depth, false))
    }

    /// What is given a value, by its number; nothing takes none.
    pub(crate) fn target(index: Index) -> Option<Target> {
        match index {
            Index::Number(digits) => {
                digits.to_whole().filter(|number| *number > 0).map(|number| Target::Var(variable(number)))
            }
            Index::Computed(of) => indexed(of).map(|element| Target::Element(Box::new(element))),
            Index::Name(_) => None,
        }
    }

    /// The negative of an operand: of nothing it is zero, as of every calculation.
    pub(crate) fn negative(self) -> Option<Formula> {
        match self.expr {
            Expr::Num(n) if !self.condition => {
                Some(Formula::new(Expr::Num(Num { mantissa: -n.mantissa, ..n }), 0, false))
            }
            _ => Formula::binary(Binary::Subtract, Formula::nothing(), self),
        }
    }

    /// Two operands; `None` is what has no meaning, or none that is known.
    pub(crate) fn binary(operator: Binary, a: Formula, b: Formula) -> Option<Formula> {
        let logical = matches!(operator, Binary::And | Binary::Or | Binary::Xor);
        let compares = matches!(
            operator,
            Binary::Equal
                | Binary::NotEqual
                | Binary::Less
                | Binary::LessOrEqual
                | Binary::Greater
                | Binary::GreaterOrEqual
        );
        let depth = a.depth.max(b.depth) + 1;
        if a.condition != b.condition || a.condition && !logical || depth > DEEPEST {
            return None;
        }
        let by_bits = match operator {
            Binary::And => Some(Function::BitAnd),
            Binary::Or => Some(Function::BitOr),
            Binary::Xor => Some(Function::BitXor),
            _ => None,
        };
        if let Some(function) = by_bits.filter(|_| !a.condition) {
            let node = Node::Call(function, vec![a.expr, b.expr]);
            return Some(Formula::new(Expr::Node(Box::new(node)), depth, false));
        }
        let node = Node::Binary(operator, a.expr, b.expr);
        Some(Formula::new(Expr::Node(Box::new(node)), depth, logical || compares))
    }

    /// A function of numbers; `None` is one that is not read, or of another number of arguments.
    pub(crate) fn call(function: Option<Function>, arguments: Vec<Formula>) -> Option<Formula> {
        let function = function.filter(|f| f.arguments() == arguments.len())?;
        let depth = arguments.iter().map(|a| a.depth).max().unwrap_or(0) + 1;
        if depth > DEEPEST || arguments.iter().any(|a| a.condition) {
            return None;
        }
        let arguments = arguments.into_iter().map(|a| a.expr).collect();
        Some(Formula::new(Expr::Node(Box::new(Node::Call(function, arguments))), depth, false))
    }
}

/// A variable whose number is computed; which numbers there are is not known here.
fn indexed(of: Formula) -> Option<Element> {
    (!of.condition).then(|| Element { of: Many::Numbered(Box::new([])), at: vec![of.expr] })
}

/// A variable that has a number: `#1` to `#33` are local, `#100` to `#199` common, `#500` to `#999` are kept when
/// the control is off; any other is the control's own (16-C, custom macro, types of variables).
pub(crate) fn variable(number: u32) -> Var {
    match number {
        1..=33 => Var::Local(number.to_string().into()),
        100..=199 => Var::Common(number.to_string().into()),
        500..=999 => Var::Retentive(number.to_string().into()),
        _ => Var::System(System::Other(format!("#{number}").into())),
    }
}

/// The statement that pieces make together; `None` is none that is known.
pub(crate) fn statement(pieces: Vec<Piece>) -> Option<Statement> {
    let mut pieces = pieces.into_iter();
    let all = [pieces.next(), pieces.next(), pieces.next()];
    if pieces.next().is_some() {
        return None;
    }
    Some(match all {
        [Some(Piece::Assign(to, value)), None, None] => Statement::Assign(to, value),
        [Some(Piece::Goto(to)), None, None] => Statement::Goto(None, to),
        [Some(Piece::If(condition)), Some(Piece::Goto(to)), None] => Statement::Goto(Some(condition), to),
        [Some(Piece::If(condition)), Some(Piece::Then), Some(Piece::Assign(to, value))] => {
            Statement::Then(condition, to, value)
        }
        [Some(Piece::While(condition)), Some(Piece::Do(number)), None] => {
            Statement::Do(Some(condition), number)
        }
        [Some(Piece::Do(number)), None, None] => Statement::Do(None, number),
        [Some(Piece::End(number)), None, None] => Statement::End(number),
        [Some(Piece::Output(output)), None, None] => Statement::Output(output),
        _ => return None,
    })
}

/// What stands after `#`, or after the letter of programs.
#[derive(Clone, Debug)]
pub(crate) enum Index {
    Number(Digits),
    /// In small letters, without blanks.
    Name(Box<str>),
    Computed(Formula),
}
