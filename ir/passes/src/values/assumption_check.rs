//! What a translation assumes of the numbers of a program, read the other way: not a pass.
//!
//! A target that compares to the least bit assumes that no two numbers are only nearly equal, and so does one
//! that finds these equal of a source that does not; one whose
//! functions round towards zero, that none is below zero; one whose words have fewer digits, that what it rounds gives nothing
//! where it adds up. Where an output differs from its source, and not from the
//! source in the other reading, the numbers are not as they were taken for; any other difference is a wrong translation.

use crate::values::variables::{Fineness, as_rounded, expressions};
use ncc_ir::computed::computes::NEARLY;
use ncc_ir::expr::compared;
use ncc_ir::expr::num::Num;
use ncc_ir::expr::{Binary, Element, Expr, Function, Many, Node, Unary};
use ncc_ir::program::Program;
use ncc_ir::run_time::RunTimeValue;
use ncc_ir::source::Span;

/// A fact about run-time values that a pass relies on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assumption {
    /// Numbers that are compared are equal, or further apart than any tolerance.
    Apart,
    /// Numbers that are rounded up or down, or divided for a remainder, are not below zero.
    NotNegative,
    /// Lengths that the target rounds, each by itself, add up to no more than its least increment.
    Together,
}

impl Assumption {
    /// What the numbers are where that is not so, in words.
    pub const fn violation(self) -> RunTimeValue {
        match self {
            Assumption::Apart => RunTimeValue::NearlyEqual,
            Assumption::NotNegative => RunTimeValue::NegativeRounded,
            Assumption::Together => RunTimeValue::RoundedOneByOne,
        }
    }
}

/// What the target has of which something is assumed.
#[derive(Clone, Copy, Debug)]
pub struct TargetNumerics<'t> {
    /// Its functions.
    pub functions: &'t [Function],
    /// To which digits its lengths are rounded.
    pub fineness: Fineness,
    /// Whether its comparisons find real numbers equal that are nearly so, and the source's do not.
    pub near: bool,
    /// How far apart two numbers are that its own comparisons find equal, in the unit of the numbers.
    pub equal_within: Option<Num>,
}

/// Whether a program compares to within a part of the greater number.
pub fn compares_nearly(program: &Program) -> bool {
    let mut found = false;
    for procedure in &mut program.clone().procedures {
        expressions(&mut procedure.body, &mut |_, expr| {
            found |= expr.has(&|node| matches!(node, Node::Call(Function::NearRatio, _)));
        });
    }
    found
}

/// Whether a program reads a variable whose number it computes.
pub fn computes_numbers(program: &Program) -> bool {
    let mut found = false;
    for procedure in &mut program.clone().procedures {
        expressions(&mut procedure.body, &mut |_, expr| {
            let numbered = |element: &Element| matches!(element.of, Many::Numbered(_));
            found |= expr.has(&|node| matches!(node, Node::Element(element) if numbered(element)));
        });
    }
    found
}

/// The program with the other reading of what is assumed, for such a target; `None` where it has none.
/// Expressions are read so up to a place of the text.
pub fn other_reading(
    program: &Program,
    assumed: &[Assumption],
    target: TargetNumerics,
    until: u32,
) -> Option<Program> {
    let mut other = program.clone();
    let mut found = assumed.contains(&Assumption::Together) && as_rounded(&mut other, target.fineness);
    for procedure in &mut other.procedures {
        expressions(&mut procedure.body, &mut |stmt, expr| {
            if stmt.span.start <= until {
                read_otherwise(expr, assumed, target, &mut found);
            }
        });
    }
    found.then_some(other)
}

/// Where a program says what another reading changes, in the order of the text.
pub fn assumed_places(program: &Program, assumed: &[Assumption], target: TargetNumerics) -> Vec<Span> {
    let mut places = Vec::new();
    for procedure in &mut program.clone().procedures {
        expressions(&mut procedure.body, &mut |stmt, expr| {
            let mut found = false;
            read_otherwise(expr, assumed, target, &mut found);
            places.extend(found.then_some(stmt.span));
        });
    }
    places.sort_by_key(|span| span.start);
    places.dedup();
    places
}

fn node(node: Node) -> Expr {
    Expr::Node(Box::new(node))
}

fn is_vacant(e: &Expr) -> bool {
    matches!(e, Expr::Node(node) if **node == Node::Vacant)
}

/// A comparison that finds equal what is nearly so.
fn nearly(operator: Binary, a: &Expr, b: &Expr) -> Option<Node> {
    if is_vacant(a) || is_vacant(b) {
        return None;
    }
    let near = Node::Call(Function::NearRatio, vec![a.clone(), b.clone(), Expr::Num(NEARLY)]);
    let plain = node(Node::Binary(operator, a.clone(), b.clone()));
    Some(match operator {
        Binary::Equal => near,
        Binary::NotEqual => Node::Unary(Unary::Not, node(near)),
        Binary::Less | Binary::Greater => {
            Node::Binary(Binary::And, plain, node(Node::Unary(Unary::Not, node(near))))
        }
        Binary::LessOrEqual | Binary::GreaterOrEqual => Node::Binary(Binary::Or, plain, node(near)),
        _ => return None,
    })
}

fn read_otherwise(e: &mut Expr, assumed: &[Assumption], target: TargetNumerics, found: &mut bool) {
    e.parts_mut().for_each(|part| read_otherwise(part, assumed, target, found));
    let Expr::Node(node) = e else { return };
    let functions = target.functions;
    let of = |operator, a: &Expr, b: &Expr| Some(Node::Binary(operator, a.clone(), b.clone()));
    let apart = assumed.contains(&Assumption::Apart);
    let not_negative = assumed.contains(&Assumption::NotNegative);
    // One that the target has is none that another stands for.
    let has = |function| functions.contains(&function);
    let other = match &**node {
        Node::Call(Function::Near | Function::NearRatio, all) if apart => {
            match (&all[..], target.equal_within) {
                ([a, b, _], Some(tolerance)) => {
                    let apart = vec![self::node(Node::Binary(Binary::Subtract, a.clone(), b.clone()))];
                    let apart = self::node(Node::Call(Function::Abs, apart));
                    Some(Node::Binary(Binary::Less, apart, Expr::Num(tolerance)))
                }
                ([a, b, _], None) => of(Binary::Equal, a, b),
                _ => None,
            }
        }
        Node::Binary(operator, a, b) if apart && target.near => nearly(*operator, a, b),
        Node::Binary(operator, by, Expr::Num(limit)) if apart => {
            compared(*operator, by, *limit).and_then(|(operator, a, b)| of(operator, a, b))
        }
        Node::Call(Function::Remainder, all) if not_negative && !has(Function::Remainder) => match &all[..] {
            [a, b] => of(Binary::Modulo, a, b),
            _ => None,
        },
        Node::Call(function, all) if not_negative && !has(*function) => match function {
            Function::Floor => Some(Node::Call(Function::Truncate, all.clone())),
            Function::Ceiling if has(Function::RoundUp) => Some(Node::Call(Function::RoundUp, all.clone())),
            Function::RoundUp if has(Function::Ceiling) => Some(Node::Call(Function::Ceiling, all.clone())),
            _ => None,
        },
        _ => None,
    };
    if let Some(other) = other {
        **node = other;
        *found = true;
    }
}
