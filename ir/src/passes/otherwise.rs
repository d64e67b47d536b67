//! What a translation takes for granted of the numbers of a program, read the other way: not a pass.
//!
//! A target that compares to the least bit takes for granted that no two numbers are only nearly equal; one whose
//! functions round towards zero, that none is below zero; one whose words have fewer digits, that what it rounds comes to
//! nothing where it adds up. Where an output differs from its source, and not from the
//! source in the other reading, the numbers are not as they were taken for; any other difference is a wrong translation.

use super::arithmetic::compared;
use super::variables::{Fineness, as_rounded, expressions};
use crate::expr::{Binary, Expr, Function, Node};
use crate::program::Program;

/// What is taken for granted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Taken {
    /// Numbers that are compared are equal, or further apart than any tolerance.
    Apart,
    /// Numbers that are rounded up or down, or divided for a remainder, are not below zero.
    NotNegative,
    /// Lengths that the target rounds, each by itself, add up to no more than its last digit.
    Together,
}

impl Taken {
    /// What the numbers are where that is not so, in words.
    pub const fn otherwise(self) -> &'static str {
        match self {
            Taken::Apart => "two numbers that are nearly the same where they are compared",
            Taken::NotNegative => "a number below zero that is rounded, or divided for a remainder",
            Taken::Together => {
                "lengths with more digits than the control's, which it rounds one by one, and which add up"
            }
        }
    }
}

/// The program with the other reading of what is taken for granted, where a target has these functions and digits;
/// `None` where it has none.
pub fn otherwise(
    program: &Program,
    taken: &[Taken],
    functions: &[Function],
    fineness: Fineness,
) -> Option<Program> {
    let mut other = program.clone();
    let mut found = taken.contains(&Taken::Together) && as_rounded(&mut other, fineness);
    for procedure in &mut other.procedures {
        expressions(&mut procedure.body, &mut |_, expr| over(expr, taken, functions, &mut found));
    }
    found.then_some(other)
}

fn over(e: &mut Expr, taken: &[Taken], functions: &[Function], found: &mut bool) {
    e.parts_mut().for_each(|part| over(part, taken, functions, found));
    let Expr::Node(node) = e else { return };
    let of = |operator, a: &Expr, b: &Expr| Some(Node::Binary(operator, a.clone(), b.clone()));
    let apart = taken.contains(&Taken::Apart);
    let not_negative = taken.contains(&Taken::NotNegative);
    // One that the target has is none that another stands for.
    let has = |function| functions.contains(&function);
    let other = match &**node {
        Node::Call(Function::Near | Function::NearRatio, all) if apart => match &all[..] {
            [a, b, _] => of(Binary::Equal, a, b),
            _ => None,
        },
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
