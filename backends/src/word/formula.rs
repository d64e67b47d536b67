//! What is computed when the program runs: expressions in the words of the control.
//!
//! With the fewest brackets from which the same expression is read again; a sign stands first, or in brackets (16-C,
//! custom macro). Rounding that an address does by itself is not written. Digits are those of the program.
//!
//! Not here: statements (`computing`), and whether the target has variables at all (`computes`).

use ncc_dialects::{ANGLE_RANGE, FormulaRules};
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Binary, Expr, Function, Node, Target, Unary, Var};
use ncc_ir::num::{Num, Unit};
use ncc_ir::source::Span;

use super::codes::Letter;
use super::number::Worth;
use super::{Sink, Writer};

/// The fault of what the control cannot compute.
pub(crate) fn cannot_compute(what: impl Into<Box<str>>) -> Fault {
    Fault::Computes { what: what.into() }
}

/// How tightly an operator binds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Tie {
    Comparison,
    Sum,
    Product,
    Factor,
}

fn tie(operator: Binary) -> Option<Tie> {
    Some(match operator {
        Binary::Equal
        | Binary::NotEqual
        | Binary::Less
        | Binary::LessOrEqual
        | Binary::Greater
        | Binary::GreaterOrEqual => Tie::Comparison,
        Binary::Add | Binary::Subtract | Binary::Or | Binary::Xor => Tie::Sum,
        Binary::Multiply | Binary::Divide | Binary::Modulo | Binary::And => Tie::Product,
        Binary::Power => return None,
    })
}

/// How expressions are spelt where one stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spelling<'d> {
    rules: &'d FormulaRules,
    blanks: bool,
    /// Whether angles of arcs go from 0 to a turn.
    turn: bool,
    /// The digits to which the address rounds; outside of an address, none.
    digits: Option<u8>,
}

impl Spelling<'_> {
    /// What is given a value.
    pub(crate) fn target(&self, to: &Target) -> Result<String, Fault> {
        match to {
            Target::Var(var) => Ok(format!("#{}", number_of(var)?)),
            Target::Element(_) => Err(cannot_compute("a variable whose number is computed")),
        }
    }

    /// An expression in brackets.
    fn bracketed(&self, e: &Expr, depth: u8, out: &mut String) -> Result<(), Fault> {
        if depth >= self.rules.brackets {
            return Err(cannot_compute("brackets within so many others"));
        }
        out.push('[');
        self.expr(e, Tie::Comparison, true, depth + 1, out)?;
        out.push(']');
        Ok(())
    }

    /// An expression that binds at least so tightly, or in brackets; whether it is the first in its brackets.
    fn expr(&self, e: &Expr, least: Tie, first: bool, depth: u8, out: &mut String) -> Result<(), Fault> {
        let node = match e {
            Expr::Num(n) if n.unit != Unit::One => {
                return Err(cannot_compute("a literal with a unit of its own in an expression"));
            }
            Expr::Num(n) if n.mantissa < 0 && !first => return self.bracketed(e, depth, out),
            Expr::Num(n) => {
                literal(*n, n.point, out);
                return Ok(());
            }
            Expr::Node(node) => &**node,
        };
        match node {
            Node::Vacant => {
                out.push_str("#0");
                Ok(())
            }
            Node::Var(var) => {
                out.push('#');
                out.push_str(&number_of(var)?);
                Ok(())
            }
            Node::Element(_) => Err(cannot_compute("a variable whose number is computed")),
            Node::Unary(Unary::Negate, a) => self.negative(e, a, first, depth, out),
            Node::Unary(Unary::Not, _) => Err(cannot_compute("the opposite of a condition")),
            Node::Binary(Binary::Subtract, Expr::Num(zero), a @ Expr::Node(_))
                if *zero == Num::int(0, Unit::One) =>
            {
                self.negative(e, a, first, depth, out)
            }
            Node::Binary(operator, a, b) => {
                if let Some((function, arguments)) = from_zero(*operator, a, b).filter(|_| self.turn) {
                    return self.plain_call(function, arguments, depth, out);
                }
                let own = tie(*operator).ok_or_else(|| cannot_compute("a power"))?;
                if own < least {
                    return self.bracketed(e, depth, out);
                }
                let word = self.rules.operator(*operator);
                let word = word.ok_or_else(|| cannot_compute("this operator"))?;
                self.expr(a, own, first, depth, out)?;
                let apart = self.blanks || word.bytes().all(|b| b.is_ascii_alphabetic());
                let blank = if apart { " " } else { "" };
                out.push_str(blank);
                out.push_str(word);
                out.push_str(blank);
                self.expr(b, tighter(own), false, depth, out)
            }
            Node::Call(function, arguments) => self.call(*function, arguments, depth, out),
        }
    }

    fn negative(&self, e: &Expr, a: &Expr, first: bool, depth: u8, out: &mut String) -> Result<(), Fault> {
        if !first {
            return self.bracketed(e, depth, out);
        }
        out.push('-');
        match a {
            // A sign behind a sign.
            Expr::Num(n) if n.mantissa < 0 => self.bracketed(a, depth, out),
            a => self.expr(a, Tie::Factor, false, depth, out),
        }
    }

    fn call(&self, function: Function, arguments: &[Expr], depth: u8, out: &mut String) -> Result<(), Fault> {
        let (function, arguments) = match (function, arguments, self.digits) {
            (Function::RoundTo, [a, Expr::Num(to)], Some(digits))
                if *to == Num::int(digits.into(), Unit::One) =>
            {
                (Function::Round, std::slice::from_ref(a))
            }
            (Function::RoundTo, [a, Expr::Num(to)], None) if to.is_zero() => {
                (Function::Round, std::slice::from_ref(a))
            }
            (Function::RoundTo, ..) => {
                return Err(cannot_compute("rounding to some digits in an expression"));
            }
            (Function::Round, _, Some(digits)) if digits > 0 => {
                return Err(cannot_compute("rounding to a whole number in a word that is rounded to digits"));
            }
            (Function::Asin | Function::Atan2, ..) if self.turn => {
                return Err(cannot_compute("an arc's angle below zero"));
            }
            (function, arguments, _) => (function, arguments),
        };
        self.plain_call(function, arguments, depth, out)
    }

    fn plain_call(
        &self,
        function: Function,
        arguments: &[Expr],
        depth: u8,
        out: &mut String,
    ) -> Result<(), Fault> {
        let word = self.rules.function(function);
        out.push_str(word.ok_or_else(|| cannot_compute("this function"))?);
        for (at, argument) in arguments.iter().enumerate() {
            if at > 0 {
                out.push('/');
            }
            self.bracketed(argument, depth, out)?;
        }
        Ok(())
    }
}

/// The function of an arc whose angle is brought between 0 and a turn, as a control that has it there does.
fn from_zero<'e>(operator: Binary, a: &'e Expr, b: &Expr) -> Option<(Function, &'e [Expr])> {
    let turn = |e: &Expr| *e == Expr::int(360);
    let Expr::Node(sum) = a else { return None };
    let Node::Binary(Binary::Add, arc, more) = &**sum else { return None };
    let Expr::Node(arc) = arc else { return None };
    match &**arc {
        Node::Call(function @ (Function::Asin | Function::Atan2), arguments)
            if operator == Binary::Modulo && turn(more) && turn(b) =>
        {
            Some((*function, arguments))
        }
        _ => None,
    }
}

fn tighter(tie: Tie) -> Tie {
    match tie {
        Tie::Comparison => Tie::Sum,
        Tie::Sum => Tie::Product,
        Tie::Product | Tie::Factor => Tie::Factor,
    }
}

/// The number of a variable, which is its name.
pub(crate) fn number_of(var: &Var) -> Result<String, Fault> {
    match var {
        Var::System(_) => Err(cannot_compute(format!("the system variable {}", var.name()))),
        Var::Local(name) | Var::Common(name) | Var::Retentive(name) => {
            let number = !name.is_empty() && name.bytes().all(|b| b.is_ascii_digit());
            if number { Ok(name.to_string()) } else { Err(cannot_compute(format!("the variable {name}"))) }
        }
    }
}

/// A number as it was written.
pub(crate) fn literal(n: Num, point: bool, out: &mut String) {
    let digits = n.mantissa.unsigned_abs().to_string();
    let scale = usize::from(n.scale);
    let digits = format!("{digits:0>width$}", width = scale + 1);
    let (whole, rest) = digits.split_at(digits.len() - scale);
    if n.mantissa < 0 {
        out.push('-');
    }
    out.push_str(whole);
    if point || scale > 0 {
        out.push('.');
        out.push_str(rest);
    }
}

impl Writer {
    /// How expressions are spelt, in a word that rounds to digits or elsewhere.
    pub(crate) fn spelling(&self, digits: Option<u8>) -> Result<Spelling<'static>, Fault> {
        if !self.dialect.program.macro_b {
            return Err(cannot_compute("a value that is computed"));
        }
        Ok(Spelling {
            rules: &self.dialect.formula,
            blanks: self.dialect.block.blanks,
            turn: self.settings.get(ANGLE_RANGE) != "half",
            digits,
        })
    }

    /// An expression as what is assigned.
    pub(crate) fn expression(&mut self, e: &Expr, span: Span, sink: &mut Sink) -> Result<String, Fault> {
        self.rely_on_range(e, span, sink);
        let mut out = String::new();
        self.spelling(None)?.expr(e, Tie::Comparison, true, 0, &mut out)?;
        Ok(out)
    }

    /// A condition, in its brackets.
    pub(crate) fn condition(&mut self, e: &Expr, span: Span, sink: &mut Sink) -> Result<String, Fault> {
        self.rely_on_range(e, span, sink);
        let mut out = String::new();
        self.spelling(None)?.bracketed(e, 0, &mut out)?;
        Ok(out)
    }

    /// What is computed behind a letter: a variable, with its sign, or an expression in brackets.
    pub(crate) fn behind(
        &mut self,
        e: &Expr,
        digits: Option<u8>,
        span: Span,
        sink: &mut Sink,
    ) -> Result<String, Fault> {
        self.rely_on_range(e, span, sink);
        let spelling = self.spelling(digits)?;
        let mut out = String::new();
        let e = match e {
            Expr::Node(node) => match &**node {
                Node::Unary(Unary::Negate, a) => {
                    out.push('-');
                    a
                }
                _ => e,
            },
            Expr::Num(_) => e,
        };
        match e {
            Expr::Node(node) if matches!(**node, Node::Var(_) | Node::Vacant) => {
                spelling.expr(e, Tie::Factor, true, 0, &mut out)?;
            }
            e => spelling.bracketed(e, 0, &mut out)?,
        }
        Ok(out)
    }

    /// The value of a word that is computed.
    ///
    /// # Errors
    /// The control rounds it to other digits than the program says, or cannot compute it.
    pub(crate) fn computed(
        &mut self,
        letter: &Letter,
        value: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<Worth, Fault> {
        let (said, inner) = rounding(value);
        let digits = match (said, letter.format.rounds) {
            (None, None) => None,
            (Some(said), Some([mm, inch])) if mm == inch && said == mm => Some(said),
            (Some(said), Some([mm, inch])) if mm != inch && (said == mm || said == inch) => {
                // Which of them it is follows from the units in force.
                let unit = if said == mm { Unit::Mm } else { Unit::Inch };
                self.check_unit(Num::int(1, unit), span)?;
                Some(said)
            }
            (Some(_), _) => {
                return Err(cannot_compute("a computed value that is rounded to other digits than its word"));
            }
            (None, Some(_)) => {
                return Err(cannot_compute("a computed value that is not rounded, in a word that rounds it"));
            }
        };
        let text = self.behind(inner, digits, span, sink)?;
        Ok(self.block.formula(text))
    }

    fn rely_on_range(&mut self, e: &Expr, span: Span, sink: &mut Sink) {
        if arcs(e) {
            self.rely(ANGLE_RANGE, span, sink);
        }
    }
}

/// What is rounded to some digits, and to how many.
fn rounding(e: &Expr) -> (Option<u8>, &Expr) {
    if let Expr::Node(node) = e
        && let Node::Call(Function::RoundTo, arguments) = &**node
        && let [a, Expr::Num(to)] = &arguments[..]
        && to.scale == 0
        && let Ok(digits) = u8::try_from(to.mantissa)
    {
        return (Some(digits), a);
    }
    (None, e)
}

/// Whether there is an angle of an arc in an expression.
fn arcs(e: &Expr) -> bool {
    let Expr::Node(node) = e else { return false };
    match &**node {
        Node::Var(_) | Node::Vacant => false,
        Node::Element(element) => element.at.iter().any(arcs),
        Node::Unary(_, a) => arcs(a),
        Node::Binary(_, a, b) => arcs(a) || arcs(b),
        Node::Call(function, arguments) => {
            matches!(function, Function::Asin | Function::Atan2) || arguments.iter().any(arcs)
        }
    }
}
