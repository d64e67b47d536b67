//! Expressions, variables and numbers of the `ir` text.

use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Binary, Element, Expr, Function, Many, Node, Target, Unary, Var};

use crate::common::quoted::{decimal, quote, write_whole};

/// How tightly the operands of an expression hold together; what holds less needs brackets.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Tie {
    Or,
    And,
    Comparison,
    Sum,
    Product,
    Power,
    /// A literal, or an operand with a sign.
    Atom,
    /// What may follow a sign: a variable, a call, brackets.
    Named,
}

/// Writes an expression with as few brackets as it needs.
pub(super) fn expr(e: &Expr, out: &mut Vec<u8>) {
    tied(e, Tie::Or, out);
}

fn tied(e: &Expr, least: Tie, out: &mut Vec<u8>) {
    let brackets = tie(e) < least;
    if brackets {
        out.push(b'(');
    }
    match e {
        Expr::Num(n) => num(*n, out),
        Expr::Node(node) => match &**node {
            Node::Var(v) => var(v, out),
            Node::Vacant => out.extend_from_slice(b"vacant"),
            Node::Unary(operator, a) => {
                out.extend_from_slice(match operator {
                    Unary::Negate => b"-".as_slice(),
                    Unary::Not => b"not ",
                });
                tied(a, Tie::Named, out);
            }
            Node::Binary(operator, a, b) => {
                let (sign, tie) = operation(*operator);
                let (left, right) = match tie {
                    Tie::Or => (Tie::Or, Tie::And),
                    Tie::And => (Tie::And, Tie::Comparison),
                    Tie::Comparison => (Tie::Sum, Tie::Sum),
                    Tie::Sum => (Tie::Sum, Tie::Product),
                    Tie::Product => (Tie::Product, Tie::Power),
                    Tie::Power | Tie::Atom | Tie::Named => (Tie::Atom, Tie::Atom),
                };
                tied(a, left, out);
                out.push(b' ');
                out.extend_from_slice(sign.as_bytes());
                out.push(b' ');
                tied(b, right, out);
            }
            Node::Element(e) => element(e, out),
            Node::Call(f, args) => {
                out.extend_from_slice(function(*f).as_bytes());
                out.push(b'(');
                list(args, out);
                out.push(b')');
            }
        },
    }
    if brackets {
        out.push(b')');
    }
}

fn tie(e: &Expr) -> Tie {
    match e {
        Expr::Num(_) => Tie::Atom,
        Expr::Node(node) => match &**node {
            Node::Var(_) | Node::Vacant | Node::Element(_) | Node::Call(..) => Tie::Named,
            Node::Unary(..) => Tie::Atom,
            Node::Binary(operator, ..) => operation(*operator).1,
        },
    }
}

fn operation(operator: Binary) -> (&'static str, Tie) {
    match operator {
        Binary::Add => ("+", Tie::Sum),
        Binary::Subtract => ("-", Tie::Sum),
        Binary::Multiply => ("*", Tie::Product),
        Binary::Divide => ("/", Tie::Product),
        Binary::Modulo => ("mod", Tie::Product),
        Binary::Power => ("^", Tie::Power),
        Binary::Equal => ("==", Tie::Comparison),
        Binary::NotEqual => ("!=", Tie::Comparison),
        Binary::Less => ("<", Tie::Comparison),
        Binary::LessOrEqual => ("<=", Tie::Comparison),
        Binary::Greater => (">", Tie::Comparison),
        Binary::GreaterOrEqual => (">=", Tie::Comparison),
        Binary::And => ("and", Tie::And),
        Binary::Or => ("or", Tie::Or),
        Binary::Xor => ("xor", Tie::Or),
    }
}

fn function(f: Function) -> &'static str {
    match f {
        Function::Sin => "sin",
        Function::Cos => "cos",
        Function::Tan => "tan",
        Function::Asin => "asin",
        Function::Acos => "acos",
        Function::Atan2 => "atan2",
        Function::Sqrt => "sqrt",
        Function::Abs => "abs",
        Function::Round => "round",
        Function::RoundTo => "roundto",
        Function::RoundUp => "roundup",
        Function::Floor => "floor",
        Function::Ceiling => "ceiling",
        Function::Truncate => "truncate",
        Function::Ln => "ln",
        Function::Exp => "exp",
        Function::Min => "min",
        Function::Max => "max",
        Function::Remainder => "remainder",
        Function::Given => "given",
        Function::Near => "near",
        Function::NearRatio => "nearratio",
        Function::BitAnd => "bitand",
        Function::BitOr => "bitor",
        Function::BitXor => "bitxor",
    }
}

fn list(all: &[Expr], out: &mut Vec<u8>) {
    for (place, one) in all.iter().enumerate() {
        if place > 0 {
            out.extend_from_slice(b", ");
        }
        expr(one, out);
    }
}

/// Writes one of many variables: which, then all of them.
fn element(e: &Element, out: &mut Vec<u8>) {
    if let Many::Array { var: array, .. } = &e.of {
        var(array, out);
    }
    out.push(b'[');
    list(&e.at, out);
    out.extend_from_slice(b" of ");
    match &e.of {
        Many::Array { sizes, .. } => self::sizes(sizes, out),
        Many::Numbered(numbers) => {
            for (place, range) in numbers.iter().enumerate() {
                out.extend_from_slice(if place > 0 { b", " } else { b"" });
                var(&range.scope.var(&format!("{}{}", range.prefix, range.from)), out);
                out.extend_from_slice(b" to ");
                write_whole(u64::from(range.to), out);
            }
        }
    }
    out.push(b']');
}

/// Writes how many elements an array has in each direction.
pub(super) fn sizes(sizes: &[u32], out: &mut Vec<u8>) {
    for (place, size) in sizes.iter().enumerate() {
        out.extend_from_slice(if place > 0 { b", " } else { b"" });
        write_whole(u64::from(*size), out);
    }
}

/// Writes what is given a value.
pub(super) fn target(target: &Target, out: &mut Vec<u8>) {
    match target {
        Target::Var(v) => var(v, out),
        Target::Element(e) => element(e, out),
    }
}

/// Writes a variable: its kind, and its name, in quotation marks if it is not plain.
pub(super) fn var(v: &Var, out: &mut Vec<u8>) {
    let kind = match v {
        Var::Local(_) => "local:",
        Var::Common(_) => "common:",
        Var::Retentive(_) => "retentive:",
        Var::System(_) => "system:",
    };
    let name = v.name();
    out.extend_from_slice(kind.as_bytes());
    let plain = |b: u8| b.is_ascii_alphanumeric() || matches!(b, b'_' | b'.' | b'$');
    if !name.is_empty() && name.bytes().all(plain) {
        out.extend_from_slice(name.as_bytes());
    } else {
        quote(&name, out);
    }
}

/// Writes a number with its unit.
#[inline]
pub(super) fn num(n: Num, out: &mut Vec<u8>) {
    decimal(n, out);
    out.extend_from_slice(match n.unit {
        Unit::One => b"".as_slice(),
        Unit::Mm => b"mm",
        Unit::Inch => b"in",
        Unit::Entry => b"u",
        Unit::Degree => b"deg",
        Unit::Second => b"s",
    });
}
