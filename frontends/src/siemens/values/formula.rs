//! What an expression means: its operators and functions by the language's rules, with the type of the value of it.
//!
//! `/` of whole numbers is a real one, `DIV` cuts off what stands after the point. Comparisons of real numbers find
//! two of them equal that differ by 10^-12 of the greater one, `<` and `>` too (Siemens, Job planning 03/2006, 1.7;
//! machine data 10280 can take that from `<` and `>`). Whole numbers are compared as they are.
//!
//! Not here: which variables there are (`computing`), and texts that are put together (`message`).

use std::borrow::Cow;

use ncc_ir::computed::computes::NEARLY;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::{Binary, Expr, Function, Many, Node, Unary, Var};
use ncc_ir::source::Span;
use ncc_ir::unsupported::{Unsupported, ValueUnsupported};

use super::typed::{Kind, Typed};
use crate::batch::Batch;
use crate::common::Source;
use crate::siemens::lower::Lower;
use crate::siemens::text::tree::{Address, Binary as Operator, Expr as Tree, Place, Unary as Sign};

/// Deepest nesting of an expression.
const DEEPEST: u32 = 64;

/// The circle's number, as `$PI` has it.
const PI: Num = Num { mantissa: 3_141_592_653_589_793, scale: 15, point: true, unit: Unit::One };

/// A function of one expression.
pub(in crate::siemens) fn call_function(function: Function, a: Expr) -> Expr {
    Expr::Node(Box::new(Node::Call(function, vec![a])))
}

fn not(a: Expr) -> Expr {
    Expr::Node(Box::new(Node::Unary(Unary::Not, a)))
}

impl Lower {
    /// The meaning of an expression; `None` if it is refused (reported).
    pub(in crate::siemens) fn formula(&mut self, tree: &Tree, src: Source, out: &mut Batch) -> Option<Typed> {
        if let Some(at) = tree.doubtful_comparison() {
            self.doubt(at, src, out);
        }
        self.meaning(tree, 0, src, out)
    }

    /// An expression that holds or not: any number but 0 does.
    pub(in crate::siemens) fn condition(
        &mut self,
        tree: &Tree,
        src: Source,
        out: &mut Batch,
    ) -> Option<Expr> {
        Some(self.formula(tree, src, out)?.expr)
    }

    /// That comparisons are made last is reported where somebody may have meant it otherwise.
    fn doubt(&mut self, at: Span, src: Source, out: &mut Batch) {
        if self.assume {
            out.report(Fault::ComparedLast { what: src.text(at) }, at);
        }
    }

    fn meaning(&mut self, tree: &Tree, depth: u32, src: Source, out: &mut Batch) -> Option<Typed> {
        if depth > DEEPEST {
            let what = ValueUnsupported::TooDeep;
            self.not_supported(&src.text(tree.span()), what, tree.span(), out);
            return None;
        }
        let one = |mantissa| Num { mantissa, scale: 0, point: false, unit: Unit::One };
        Some(match tree {
            Tree::Number(digits, _) => {
                let kind = if digits.point { Kind::Real } else { Kind::Int };
                let num = Num {
                    mantissa: digits.mantissa,
                    scale: digits.scale,
                    point: digits.point,
                    unit: Unit::One,
                };
                Typed::literal(num, kind)
            }
            Tree::Bits(bits, _) => Typed::literal(one(*bits), Kind::Int),
            Tree::Character(span) => {
                self.not_supported(&src.text(*span), ValueUnsupported::CharacterValue, *span, out);
                return None;
            }
            Tree::Text(span) => {
                self.not_supported(&src.text(*span), ValueUnsupported::Text, *span, out);
                return None;
            }
            Tree::Place(place) => self.read(place, src, out)?,
            Tree::Group(inner, _) => self.meaning(inner, depth + 1, src, out)?,
            Tree::Call { name, arguments, span } => {
                self.function(*name, arguments, *span, depth, src, out)?
            }
            Tree::Unary(Sign::Show, _, span) => {
                self.not_supported(&src.text(*span), ValueUnsupported::Text, *span, out);
                return None;
            }
            Tree::Unary(sign, operand, _) => {
                let a = self.meaning(operand, depth + 1, src, out)?;
                match sign {
                    Sign::Negate => {
                        let kind = if a.kind == Kind::Bool { Kind::Int } else { a.kind };
                        Typed::new(Node::Unary(Unary::Negate, a.expr), kind)
                    }
                    Sign::Not => Typed::new(Node::Unary(Unary::Not, a.expr), Kind::Bool),
                    // Refused before.
                    Sign::Show => a,
                    // All bits turned, in two's complement.
                    Sign::BitNot => {
                        let a = self.whole_number(a, tree.span(), out);
                        let negative = Expr::Node(Box::new(Node::Unary(Unary::Negate, a)));
                        Typed::new(Node::Binary(Binary::Subtract, negative, Expr::int(1)), Kind::Int)
                    }
                }
            }
            Tree::Binary(operator, operands) => {
                let (a, b) = &**operands;
                let span = tree.span();
                if matches!(operator, Operator::Join | Operator::Chain) {
                    let what = if *operator == Operator::Join {
                        ValueUnsupported::TextsJoined
                    } else {
                        ValueUnsupported::FramesChained
                    };
                    self.not_supported(&src.text(span), what, span, out);
                    return None;
                }
                if matches!(operator, Operator::Equal | Operator::NotEqual)
                    && let Some(same) = self.same_texts([a, b], span, src, out)
                {
                    let holds = same? == (*operator == Operator::Equal);
                    return Some(Typed::literal(one(i64::from(holds)), Kind::Bool));
                }
                let a = self.meaning(a, depth + 1, src, out);
                let b = self.meaning(b, depth + 1, src, out)?;
                self.operation(*operator, a?, b, span, out)
            }
        })
    }

    fn operation(&mut self, operator: Operator, a: Typed, b: Typed, span: Span, out: &mut Batch) -> Typed {
        let real = a.kind == Kind::Real || b.kind == Kind::Real;
        let number = if real { Kind::Real } else { Kind::Int };
        let plain =
            |operator, kind, a: Typed, b: Typed| Typed::new(Node::Binary(operator, a.expr, b.expr), kind);
        match operator {
            Operator::Multiply => plain(Binary::Multiply, number, a, b),
            Operator::Add => plain(Binary::Add, number, a, b),
            Operator::Subtract => plain(Binary::Subtract, number, a, b),
            Operator::Divide => plain(Binary::Divide, Kind::Real, a, b),
            Operator::IntegerDivide => {
                let quotient = Expr::binary(Binary::Divide, a.expr, b.expr);
                Typed { expr: call_function(Function::Truncate, quotient), kind: Kind::Int }
            }
            Operator::Modulo => plain(Binary::Modulo, number, a, b),
            Operator::And => plain(Binary::And, Kind::Bool, a, b),
            Operator::Or => plain(Binary::Or, Kind::Bool, a, b),
            Operator::Xor => plain(Binary::Xor, Kind::Bool, a, b),
            Operator::BitAnd | Operator::BitXor | Operator::BitOr => {
                let [a, b] = [a, b].map(|operand| self.whole_number(operand, span, out));
                let function = match operator {
                    Operator::BitAnd => Function::BitAnd,
                    Operator::BitXor => Function::BitXor,
                    _ => Function::BitOr,
                };
                Typed::new(Node::Call(function, vec![a, b]), Kind::Int)
            }
            Operator::Equal
            | Operator::NotEqual
            | Operator::Less
            | Operator::LessOrEqual
            | Operator::Greater
            | Operator::GreaterOrEqual => self.comparison(operator, a, b, span, out),
            // Refused before.
            Operator::Join | Operator::Chain => a,
        }
    }

    fn comparison(&mut self, operator: Operator, a: Typed, b: Typed, span: Span, out: &mut Batch) -> Typed {
        // Nothing but 0 is nearly 0.
        let exact = a.kind != Kind::Real && b.kind != Kind::Real || a.is_zero() || b.is_zero();
        let plain = match operator {
            Operator::Equal => Binary::Equal,
            Operator::NotEqual => Binary::NotEqual,
            Operator::Less => Binary::Less,
            Operator::LessOrEqual => Binary::LessOrEqual,
            Operator::Greater => Binary::Greater,
            _ => Binary::GreaterOrEqual,
        };
        if exact {
            return Typed::new(Node::Binary(plain, a.expr, b.expr), Kind::Bool);
        }
        if matches!(operator, Operator::Less | Operator::Greater) && self.first_time("MD 10280") {
            out.report(Fault::AssumedFact { fact: ControlFact::InexactComparison }, span);
        }
        let equal = |a: &Typed, b: &Typed| {
            let arguments = vec![a.expr.clone(), b.expr.clone(), Expr::Num(NEARLY)];
            Expr::Node(Box::new(Node::Call(Function::NearRatio, arguments)))
        };
        let near = equal(&a, &b);
        let expr = match operator {
            Operator::Equal => near,
            Operator::NotEqual => not(near),
            Operator::Less | Operator::Greater => {
                Expr::binary(Binary::And, Expr::binary(plain, a.expr, b.expr), not(near))
            }
            _ => Expr::binary(Binary::Or, Expr::binary(plain, a.expr, b.expr), near),
        };
        Typed { expr, kind: Kind::Bool }
    }

    fn function(
        &mut self,
        name: Span,
        arguments: &[Option<Tree>],
        span: Span,
        depth: u32,
        src: Source,
        out: &mut Batch,
    ) -> Option<Typed> {
        let written = src.text(name).to_ascii_uppercase();
        let count = match written.as_str() {
            "SIN" | "COS" | "TAN" | "ASIN" | "ACOS" | "SQRT" | "ABS" | "POT" | "TRUNC" | "ROUND"
            | "ROUNDUP" | "LN" | "EXP" => 1,
            "ATAN2" | "MINVAL" | "MAXVAL" => 2,
            "BOUND" => 3,
            _ => {
                let refuse = self.settings.dialect.name_row(&written).and_then(|row| row.refuse.as_deref());
                let what = refuse.map_or(ValueUnsupported::UnknownFunction.into(), Unsupported::named);
                self.not_supported(&written, what, span, out);
                return None;
            }
        };
        if arguments.len() != count || arguments.iter().any(Option::is_none) {
            let what = ValueUnsupported::FunctionArguments;
            self.not_supported(&src.text(span), what, span, out);
            return None;
        }
        let mut given = Vec::with_capacity(count);
        for argument in arguments.iter().flatten() {
            given.push(self.meaning(argument, depth + 1, src, out)?);
        }
        let mut given = given.into_iter();
        let (a, b, c) = (given.next()?, given.next(), given.next());
        let kind = if a.kind == Kind::Real { Kind::Real } else { Kind::Int };
        let real = |function| Some(Typed { expr: call_function(function, a.expr.clone()), kind: Kind::Real });
        match written.as_str() {
            "SIN" => real(Function::Sin),
            "COS" => real(Function::Cos),
            "TAN" => real(Function::Tan),
            "ASIN" => real(Function::Asin),
            "ACOS" => real(Function::Acos),
            "SQRT" => real(Function::Sqrt),
            "LN" => real(Function::Ln),
            "EXP" => real(Function::Exp),
            "ABS" => Some(Typed { expr: call_function(Function::Abs, a.expr), kind }),
            "POT" => Some(Typed { expr: Expr::binary(Binary::Multiply, a.expr.clone(), a.expr), kind }),
            "TRUNC" => Some(Typed { expr: call_function(Function::Truncate, a.expr), kind: Kind::Int }),
            "ROUND" => Some(Typed { expr: self.whole_number(a, span, out), kind: Kind::Int }),
            "ROUNDUP" => {
                if self.first_time("ROUNDUP") {
                    // The manual's words say the next smaller one of negative numbers, its examples this one.
                    out.report(Fault::AssumedFact { fact: ControlFact::RoundUpNegative }, span);
                }
                Some(Typed { expr: call_function(Function::Ceiling, a.expr), kind: Kind::Int })
            }
            "ATAN2" => {
                let node = Node::Call(Function::Atan2, vec![a.expr, b?.expr]);
                Some(Typed::new(node, Kind::Real))
            }
            "MINVAL" => Some(extreme(Function::Min, a, b?)),
            "MAXVAL" => Some(extreme(Function::Max, a, b?)),
            // BOUND(least, greatest, value)
            _ => Some(extreme(Function::Min, extreme(Function::Max, a, c?), b?)),
        }
    }

    /// A value as a whole number, rounded as `ROUND` does.
    pub(in crate::siemens) fn whole_number(&mut self, value: Typed, at: Span, out: &mut Batch) -> Expr {
        if value.kind != Kind::Real {
            return value.expr;
        }
        if let Some(num) = value.expr.literal()
            && let Some(whole) = num.whole_number()
        {
            return Expr::int(whole);
        }
        if self.first_time("ROUND") {
            out.report(Fault::AssumedFact { fact: ControlFact::HalfRounded }, at);
        }
        call_function(Function::Round, value.expr)
    }

    /// A value as a variable of a type takes it; `None` if it cannot (reported).
    pub(in crate::siemens) fn converted(
        &mut self,
        value: Typed,
        to: Kind,
        at: Span,
        out: &mut Batch,
    ) -> Option<Expr> {
        Some(match to {
            Kind::Real => value.expr,
            Kind::Int => self.whole_number(value, at, out),
            Kind::Bool if value.kind == Kind::Bool => value.expr,
            Kind::Bool => Expr::binary(Binary::NotEqual, value.expr, Expr::int(0)),
            Kind::Text => return None,
        })
    }

    /// The value of a constant by its name.
    pub(in crate::siemens) fn named_constant(name: &str) -> Option<Typed> {
        Some(match name {
            "TRUE" => Typed { expr: Expr::int(1), kind: Kind::Bool },
            "FALSE" => Typed { expr: Expr::int(0), kind: Kind::Bool },
            "$PI" => Typed::literal(PI, Kind::Real),
            _ => return None,
        })
    }
}

fn extreme(function: Function, a: Typed, b: Typed) -> Typed {
    let kind = if a.kind == Kind::Real || b.kind == Kind::Real { Kind::Real } else { Kind::Int };
    Typed::new(Node::Call(function, vec![a.expr, b.expr]), kind)
}

/// Shows the variables that an expression reads, and whether one of several that only the run tells.
pub(in crate::siemens) fn reads(expr: &Expr, seen: &mut dyn FnMut(&str)) {
    if let Expr::Node(node) = expr {
        match &**node {
            Node::Var(var) => seen(&var.name()),
            Node::Element(element) => seen(&several(&element.of)),
            Node::Vacant | Node::Unary(..) | Node::Binary(..) | Node::Call(..) => {}
        }
    }
    expr.parts().for_each(|part| reads(part, seen));
}

/// The name that stands for all of several variables.
pub(in crate::siemens) fn several(of: &Many) -> Cow<'_, str> {
    match of {
        Many::Array { var, .. } => var.name(),
        Many::Numbered(_) => Cow::Borrowed(ANY_R),
    }
}

/// Stands for every R parameter.
pub(in crate::siemens) const ANY_R: &str = "R";

/// Whether two names may be one variable.
pub(in crate::siemens) fn may_be_one(a: &str, b: &str) -> bool {
    let is_r = |name: &str| name.strip_prefix('R').is_some_and(|n| n.bytes().all(|b| b.is_ascii_digit()));
    a == b || a == ANY_R && is_r(b) || b == ANY_R && is_r(a)
}

/// An R parameter.
pub(in crate::siemens) fn r_parameter(number: u32) -> Var {
    Var::Common(format!("R{number}").into())
}

/// Whether a place is an R parameter by its number alone.
pub(in crate::siemens) fn is_r(place: &Place) -> bool {
    matches!(place.address, Address::Letter(b'R'))
}
