//! What is computed when the program runs: expressions in the words of the control.
//!
//! With the fewest brackets from which the same expression is read again; a sign stands first, or in brackets (16-C,
//! custom macro). Rounding that an address does by itself is not written. Digits are those of the program.
//!
//! Not here: statements (`computing`), and whether the target has variables at all (`computes`).

pub(crate) mod comparisons;

use std::collections::BTreeMap;

use ncc_dialects::{FormulaRules, Settings, SystemRow, VariableName};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::expr::system::System;
use ncc_ir::expr::{Binary, Element, Expr, Function, Many, Node, Target, Unary, Var};
use ncc_ir::program::Text;
use ncc_ir::run_time::RunTimeValue;

use crate::common::fault::cannot_compute;
use comparisons::{exactly, flipped, holds_or_not, nearly, within};

/// How tightly an operator binds: its group's place among those of the dictionary, of which the tightest is the
/// first; a value binds more tightly than any.
pub(crate) type Tie = usize;

/// What binds as loosely as can be stands without brackets.
pub(crate) const LOOSEST: Tie = usize::MAX;

/// How expressions are spelt where one stands.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spelling<'d> {
    pub(crate) rules: &'d FormulaRules,
    /// Values of the control's own.
    pub(crate) own: &'d [(u32, Expr)],
    /// What the control calls its own values.
    pub(crate) system: &'d [SystemRow],
    pub(crate) settings: &'d Settings,
    /// The machine's own unit, if the dialect asks for it.
    pub(crate) machine: &'d str,
    pub(crate) blanks: bool,
    /// Whether angles of arcs go from 0 to a turn.
    pub(crate) turn: bool,
    /// The digits to which the address rounds; outside of an address, none.
    pub(crate) digits: Option<u8>,
    /// Names of the variables of the procedure at hand, as they are spelt.
    pub(crate) names: &'d BTreeMap<Text, String>,
}

impl Spelling<'_> {
    fn tie(&self, operator: Binary) -> Option<Tie> {
        let group = |group: &Vec<_>| group.iter().any(|own| Binary::from(*own) == operator);
        self.rules.priority.iter().position(group).map(|place| place + 1)
    }

    fn variable(&self, var: &Var, out: &mut String) -> Result<(), Fault> {
        // One that all programs see has a name of its own where it is a parameter of one of them.
        let named = |name: &str| matches!(var, Var::Local(_)) || name.contains('.');
        if let Var::Local(name) | Var::Common(name) = var
            && named(name)
            && let Some(name) = self.names.get(name)
        {
            out.push_str(name);
            return Ok(());
        }
        out.push_str(&self.rules.variable);
        if let Var::System(system) = var {
            out.push_str(&self.own_value(system)?);
            return Ok(());
        }
        if let Some(name) = self.named(var) {
            let mut signs = self.rules.name_signs.chars();
            out.extend(signs.next());
            out.push_str(name);
            out.extend(signs.next());
            return Ok(());
        }
        out.push_str(&self.rules.prefix);
        out.push_str(&number_of(var, &self.rules.prefix)?);
        Ok(())
    }

    /// What is given a value.
    pub(crate) fn target(&self, to: &Target) -> Result<String, Fault> {
        match to {
            Target::Var(var) => {
                let mut out = String::new();
                self.variable(var, &mut out)?;
                Ok(out)
            }
            Target::Element(element) => {
                let mut out = String::new();
                self.element(element, 0, &mut out)?;
                Ok(out)
            }
        }
    }

    /// One of many variables: its array's name or the prefix of all, and which in brackets of their own, where the control
    /// rounds; or in those of expressions.
    fn element(&self, element: &Element, depth: u8, out: &mut String) -> Result<(), Fault> {
        match &element.of {
            Many::Array { var, .. } if self.rules.index.is_some() => self.variable(var, out)?,
            Many::Array { .. } => return Err(cannot_compute(RunTimeValue::Array)),
            Many::Numbered(_) => {
                out.push_str(&self.rules.variable);
                out.push_str(&self.rules.prefix);
            }
        }
        // Within its brackets ROUND goes to a whole number, whatever the word does that it stands in.
        let within = Spelling { digits: None, ..*self };
        let Some([open, close]) = &self.rules.index else {
            return match &element.at[..] {
                [number] => within.bracketed(self.without_rounding(number), depth, out),
                _ => Err(cannot_compute(RunTimeValue::SeveralNumbers)),
            };
        };
        out.push_str(open);
        for (place, at) in element.at.iter().enumerate() {
            out.push_str(if place > 0 { "," } else { "" });
            within.expr(without_rounding(at), LOOSEST, true, depth + 1, out)?;
        }
        out.push_str(close);
        Ok(())
    }

    /// The name of a variable that has one, and no number.
    fn named<'v>(&self, var: &'v Var) -> Option<&'v str> {
        let (name, common) = match var {
            Var::Local(name) => (name, false),
            Var::Common(name) => (name, true),
            Var::Retentive(_) | Var::System(_) => return None,
        };
        let global = self.rules.named.as_ref()?.common.as_deref().filter(|sign| !sign.is_empty());
        let number = name.bytes().all(|b| b.is_ascii_digit());
        let fits = global.is_none_or(|global| name.starts_with(global) == common);
        (!number && fits).then_some(&**name)
    }

    /// Whether it is a value of the control's own that has a name.
    fn has_name(&self, node: &Node) -> bool {
        let Node::Var(Var::System(system)) = node else { return false };
        self.own_value(system).is_ok_and(|spelt| spelt.starts_with('<'))
    }

    /// What the control calls one of its own values.
    fn own_value(&self, system: &System) -> Result<String, Fault> {
        let rows = self.system.iter().filter(|row| row.counts(self.settings));
        let all = rows.flat_map(|row| row.says_in(self.machine)).filter(|(own, _)| own == system);
        // A name says more than a number.
        let found =
            all.map(|(_, spelt)| spelt).min_by_key(|spelt| !matches!(spelt, VariableName::Bracketed(_)));
        found
            .map(|spelt| spelt.to_string())
            .ok_or_else(|| cannot_compute(RunTimeValue::AskedVariable { asked: system.clone() }))
    }

    /// What is looked at as a whole number, without the rounding that the control does by itself.
    pub(crate) fn without_rounding<'e>(&self, e: &'e Expr) -> &'e Expr {
        let (digits, inner) = rounding(e);
        if digits.is_some() && digits == self.rules.whole { inner } else { e }
    }

    /// An expression in brackets.
    pub(crate) fn bracketed(&self, e: &Expr, depth: u8, out: &mut String) -> Result<(), Fault> {
        if depth >= self.rules.brackets {
            return Err(cannot_compute(RunTimeValue::BracketDepth));
        }
        out.push_str(&self.rules.open);
        self.expr(e, LOOSEST, true, depth + 1, out)?;
        out.push_str(&self.rules.close);
        Ok(())
    }

    /// An expression that binds at least so tightly, or in brackets; whether it is the first in its brackets.
    pub(crate) fn expr(
        &self,
        e: &Expr,
        least: Tie,
        first: bool,
        depth: u8,
        out: &mut String,
    ) -> Result<(), Fault> {
        let node = match e {
            Expr::Num(n) if n.unit != Unit::One => {
                return Err(cannot_compute(RunTimeValue::LiteralUnit));
            }
            Expr::Num(n) if n.mantissa < 0 && !first => return self.bracketed(e, depth, out),
            Expr::Num(n) => {
                literal(*n, n.point, out);
                return Ok(());
            }
            Expr::Node(node) => &**node,
        };
        if !self.has_name(node)
            && let Some((number, _)) = self.own.iter().find(|(_, value)| value == e)
        {
            out.push_str(&self.rules.variable);
            out.push_str(&number.to_string());
            return Ok(());
        }
        if let Some(tolerance) = self.rules.tolerance() {
            if let Some((operator, a, b)) = within(node, tolerance) {
                return self.operation(operator, [a, b], least, first, depth, out);
            }
            match exactly(node) {
                Some((opposite, true)) => return self.opposite(&opposite, least, depth, out),
                Some((same, false)) => return self.expr(&same, least, first, depth, out),
                None => {}
            }
        }
        if let Some((operator, a, b)) = nearly(node).filter(|_| self.rules.near) {
            return self.operation(operator, [a, b], least, first, depth, out);
        }
        match node {
            Node::Vacant => {
                let word = self.rules.vacant.as_ref();
                out.push_str(word.ok_or_else(|| cannot_compute(RunTimeValue::NoValue))?);
                Ok(())
            }
            Node::Var(var) => self.variable(var, out),
            Node::Element(element) => self.element(element, depth, out),
            Node::Binary(Binary::NotEqual, Expr::Node(a), Expr::Node(b))
                if self.rules.exists.is_some() && **b == Node::Vacant =>
            {
                self.exists(a, out)
            }
            Node::Unary(Unary::Not, a) if self.rules.not_behind.is_some() => {
                match flipped(a, self.rules.tolerance()) {
                    Some(other) => self.expr(&other, least, first, depth, out),
                    None => self.opposite(a, least, depth, out),
                }
            }
            Node::Unary(Unary::Negate, a) => self.negative(e, a, first, depth, out),
            Node::Unary(Unary::Not, a) => {
                let word = self.rules.not.as_ref();
                let word = word.ok_or_else(|| cannot_compute(RunTimeValue::Opposite))?;
                if !first {
                    return self.bracketed(e, depth, out);
                }
                out.push_str(word);
                out.push(' ');
                self.expr(a, 0, false, depth, out)
            }
            Node::Binary(Binary::Subtract, Expr::Num(zero), a @ Expr::Node(_))
                if *zero == Num::int(0, Unit::One) =>
            {
                self.negative(e, a, first, depth, out)
            }
            Node::Binary(operator, a, b) => {
                if let Some((function, arguments)) = from_zero(*operator, a, b).filter(|_| self.turn) {
                    return self.plain_call(function, arguments, depth, out);
                }
                self.operation(*operator, [a, b], least, first, depth, out)
            }
            Node::Call(Function::Given, arguments) if self.rules.exists.is_some() => match &arguments[..] {
                [a] => self.expr(a, least, first, depth, out),
                _ => Err(cannot_compute(RunTimeValue::ThisFunction)),
            },
            Node::Call(Function::Remainder, arguments) => match (&self.rules.remainder, &arguments[..]) {
                (Some(word), [a, b]) => {
                    let own =
                        self.tie(Binary::Modulo).ok_or_else(|| cannot_compute(RunTimeValue::ThisOperator))?;
                    self.joined(word, own, [a, b], least, first, depth, out)
                }
                _ => Err(cannot_compute(RunTimeValue::ThisFunction)),
            },
            Node::Call(function, arguments) => match (self.rules.by_bits(*function), &arguments[..]) {
                (Some(operator), [a, b]) => self.operation(operator, [a, b], least, first, depth, out),
                _ => self.call(*function, arguments, depth, out),
            },
        }
    }

    /// Whether a variable with a name has a value.
    fn exists(&self, of: &Node, out: &mut String) -> Result<(), Fault> {
        let (Some(word), Node::Var(var)) = (&self.rules.exists, of) else {
            return Err(cannot_compute(RunTimeValue::HasValue));
        };
        if self.named(var).is_none() {
            return Err(cannot_compute(RunTimeValue::NamelessHasValue));
        }
        out.push_str(word);
        out.push_str(&self.rules.open);
        self.variable(var, out)?;
        out.push_str(&self.rules.close);
        Ok(())
    }

    /// The opposite of a condition, which is a number here: zero, where it holds.
    fn opposite(&self, e: &Expr, least: Tie, depth: u8, out: &mut String) -> Result<(), Fault> {
        let word = self.rules.not_behind.as_ref();
        let word = word.ok_or_else(|| cannot_compute(RunTimeValue::Opposite))?;
        let own = self.tie(Binary::Equal).ok_or_else(|| cannot_compute(RunTimeValue::ThisOperator))?;
        if own > least {
            out.push_str(&self.rules.open);
            self.opposite(e, LOOSEST, depth + 1, out)?;
            out.push_str(&self.rules.close);
            return Ok(());
        }
        let zero = || Expr::int(0);
        let of = |operator, a: Expr, b: Expr| Expr::Node(Box::new(Node::Binary(operator, a, b)));
        match holds_or_not(e) {
            true => self.bracketed(e, depth, out)?,
            // As near to zero as can be is something else.
            false => {
                let other = of(
                    Binary::Or,
                    of(Binary::Less, e.clone(), zero()),
                    of(Binary::Greater, e.clone(), zero()),
                );
                self.bracketed(&other, depth, out)?;
            }
        }
        out.push(' ');
        out.push_str(word);
        Ok(())
    }

    fn operation(
        &self,
        operator: Binary,
        [a, b]: [&Expr; 2],
        least: Tie,
        first: bool,
        depth: u8,
        out: &mut String,
    ) -> Result<(), Fault> {
        let own = self.tie(operator).ok_or_else(|| cannot_compute(RunTimeValue::ThisOperator))?;
        let word = self.rules.operator(operator);
        let word = word.ok_or_else(|| cannot_compute(RunTimeValue::ThisOperator))?;
        self.joined(word, own, [a, b], least, first, depth, out)
    }

    /// Two values with a word between them that binds so.
    #[allow(clippy::too_many_arguments)]
    fn joined(
        &self,
        word: &str,
        own: Tie,
        [a, b]: [&Expr; 2],
        least: Tie,
        first: bool,
        depth: u8,
        out: &mut String,
    ) -> Result<(), Fault> {
        if own > least {
            if depth >= self.rules.brackets {
                return Err(cannot_compute(RunTimeValue::BracketDepth));
            }
            out.push_str(&self.rules.open);
            self.joined(word, own, [a, b], LOOSEST, true, depth + 1, out)?;
            out.push_str(&self.rules.close);
            return Ok(());
        }
        // A comparison of what a comparison is worth is one that nobody reads without brackets.
        let compares = Some(own) == self.tie(Binary::Equal);
        self.expr(a, if compares { own - 1 } else { own }, first, depth, out)?;
        let apart = self.blanks || word.bytes().all(|b| b.is_ascii_alphabetic());
        let blank = if apart { " " } else { "" };
        out.push_str(blank);
        out.push_str(word);
        out.push_str(blank);
        self.expr(b, own - 1, false, depth, out)
    }

    fn negative(&self, e: &Expr, a: &Expr, first: bool, depth: u8, out: &mut String) -> Result<(), Fault> {
        if !first {
            return self.bracketed(e, depth, out);
        }
        out.push('-');
        match a {
            // A sign after a sign.
            Expr::Num(n) if n.mantissa < 0 => self.bracketed(a, depth, out),
            a => self.expr(a, 0, false, depth, out),
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
                return Err(cannot_compute(RunTimeValue::RoundingInExpression));
            }
            (Function::Round, _, Some(digits)) if digits > 0 => {
                return Err(cannot_compute(RunTimeValue::WholeInRoundedWord));
            }
            (Function::Asin | Function::Atan2, ..) if self.turn => {
                return Err(cannot_compute(RunTimeValue::NegativeArcAngle));
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
        if let (Some(word), [a, b]) = (self.rules.between(function), arguments) {
            let sum = self.tie(Binary::Add).unwrap_or(0);
            out.push_str(&self.rules.open);
            self.expr(a, sum, true, depth + 1, out)?;
            out.push_str(&format!(" {word} "));
            self.expr(b, sum, false, depth + 1, out)?;
            out.push_str(&self.rules.close);
            return Ok(());
        }
        let word = self.rules.function(function);
        out.push_str(word.ok_or_else(|| cannot_compute(RunTimeValue::ThisFunction))?);
        if self.rules.together {
            out.push_str(&self.rules.open);
            for (at, argument) in arguments.iter().enumerate() {
                out.push_str(if at > 0 { "," } else { "" });
                self.expr(argument, LOOSEST, true, depth + 1, out)?;
            }
            out.push_str(&self.rules.close);
            return Ok(());
        }
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

/// What is rounded to a whole number where an index does that by itself.
fn without_rounding(at: &Expr) -> &Expr {
    match at {
        Expr::Node(node) => match &**node {
            Node::Call(Function::Round, arguments) => arguments.first().unwrap_or(at),
            _ => at,
        },
        Expr::Num(_) => at,
    }
}

/// The number of a variable, which is its name after the prefix.
pub(crate) fn number_of(var: &Var, prefix: &str) -> Result<String, Fault> {
    match var {
        Var::System(asked) => Err(cannot_compute(RunTimeValue::AskedVariable { asked: asked.clone() })),
        Var::Local(name) | Var::Common(name) | Var::Retentive(name) => {
            let number = name.strip_prefix(prefix).unwrap_or_default();
            let plain = !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
            if plain {
                Ok(number.to_string())
            } else {
                Err(cannot_compute(RunTimeValue::Variable { name: (**name).into() }))
            }
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

/// What is rounded to some digits, and to how many.
pub(crate) fn rounding(e: &Expr) -> (Option<u8>, &Expr) {
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
pub(crate) fn arcs(e: &Expr) -> bool {
    e.has(&|node| matches!(node, Node::Call(Function::Asin | Function::Atan2, _)))
}
