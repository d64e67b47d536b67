//! How many digits after the point values of a program have at most, as its text tells: 0 are whole numbers.
//!
//! A variable has as many as anything that it is given anywhere; one that is read and may not have been set, or is
//! given something that has no end, has any number. Whole numbers are exact in binary floats, and stay so; decimals
//! are as near as a float is.
//!
//! Not here: which values they are.

use std::collections::BTreeMap;

use crate::computed::free_variables::free_variables;
use crate::expr::num::Num;
use crate::expr::{Binary, Element, Expr, Function, Many, Node, Target, Unary, Var};
use crate::program::{Control, Op, Procedure, Program, Stmt, Text};

/// Most digits that are counted; a value with more has any number.
const MOST: u8 = 9;

/// Most times that a program is gone through.
const MOST_ROUNDS: u32 = 16;

/// A number of digits; `None` is any.
type Digits = Option<u8>;

/// Digits of the variables of a program, those of a call for each of its procedures.
#[derive(Clone, Debug, Default)]
pub struct Decimals {
    known: BTreeMap<(usize, Text), Digits>,
    negative: BTreeMap<(usize, Text), bool>,
    /// The procedure at hand; the variables that all see are those of none.
    at: usize,
}

/// Where the variables stand that all procedures see.
const ALL: usize = usize::MAX;

fn more(a: Digits, b: Digits) -> Digits {
    Some(a?.max(b?))
}

fn of_number(n: Num) -> Digits {
    let (mut mantissa, mut scale) = (n.mantissa, n.scale);
    while scale > 0 && mantissa % 10 == 0 {
        (mantissa, scale) = (mantissa / 10, scale - 1);
    }
    (scale <= MOST).then_some(scale)
}

impl Decimals {
    /// Looks through a program.
    pub fn from_program(program: &Program) -> Decimals {
        let mut found = Decimals::default();
        for (var, _) in free_variables(program) {
            let key = found.key(&var);
            found.known.insert(key.clone(), None);
            found.negative.insert(key, true);
        }
        let names: Vec<&Procedure> = program.procedures.iter().collect();
        for _ in 0..MOST_ROUNDS {
            let before = (found.known.clone(), found.negative.clone());
            for (at, procedure) in program.procedures.iter().enumerate() {
                found.at = at;
                found.body(&procedure.body, &names);
            }
            if before == (found.known.clone(), found.negative.clone()) {
                return found;
            }
        }
        // It grows without an end: nothing is known.
        found.known.values_mut().for_each(|digits| *digits = None);
        found.negative.values_mut().for_each(|negative| *negative = true);
        found
    }

    /// The same, of expressions of another procedure.
    pub fn within(&mut self, procedure: usize) {
        self.at = procedure;
    }

    /// Whether an expression is worth a whole number.
    pub fn is_whole(&self, e: &Expr) -> bool {
        self.digits(e) == Some(0)
    }

    fn key(&self, var: &Var) -> (usize, Text) {
        match var {
            Var::Local(name) => (self.at, name.clone()),
            Var::Common(name) | Var::Retentive(name) => (ALL, name.clone()),
            Var::System(system) => (ALL, format!("system {system}").into()),
        }
    }

    /// At most how many digits an expression has; `None` is any number.
    pub fn digits(&self, e: &Expr) -> Digits {
        let node = match e {
            Expr::Num(n) => return of_number(*n),
            Expr::Node(node) => &**node,
        };
        match node {
            Node::Var(Var::System(_)) => None,
            // What is never given anything is not read either, or it is open.
            Node::Var(var) => self.known.get(&self.key(var)).copied().unwrap_or(Some(0)),
            Node::Vacant => Some(0),
            Node::Element(_) => None,
            Node::Unary(Unary::Negate, a) => self.digits(a),
            Node::Unary(Unary::Not, _) => Some(0),
            Node::Binary(operator, ..) if operator.decides() => Some(0),
            Node::Binary(operator, a, b) => match operator {
                Binary::Add | Binary::Subtract | Binary::Modulo => more(self.digits(a), self.digits(b)),
                Binary::Multiply => {
                    let all = self.digits(a)? + self.digits(b)?;
                    (all <= MOST).then_some(all)
                }
                Binary::Divide => {
                    let by = b.literal().and_then(|n| n.whole_number())?;
                    let further = match by {
                        1 => 0,
                        2 | 5 | 10 => 1,
                        4 | 20 | 25 | 50 | 100 => 2,
                        8 | 1000 => 3,
                        _ => return None,
                    };
                    let all = self.digits(a)? + further;
                    (all <= MOST).then_some(all)
                }
                _ => None,
            },
            Node::Call(function, arguments) => match (function, &arguments[..]) {
                (Function::Abs | Function::Given, [a]) => self.digits(a),
                (Function::Min | Function::Max | Function::Remainder, [a, b]) => {
                    more(self.digits(a), self.digits(b))
                }
                (
                    Function::Round
                    | Function::RoundUp
                    | Function::Floor
                    | Function::Ceiling
                    | Function::Truncate
                    | Function::Near
                    | Function::NearRatio
                    | Function::BitAnd
                    | Function::BitOr
                    | Function::BitXor,
                    _,
                ) => Some(0),
                (Function::RoundTo, [a, to]) => {
                    let to = u8::try_from(to.literal()?.whole_number()?).ok()?;
                    Some(self.digits(a).map_or(to, |digits| digits.min(to)))
                }
                _ => None,
            },
        }
    }

    /// Whether an expression may be worth less than zero.
    pub fn may_be_negative(&self, e: &Expr) -> bool {
        let node = match e {
            Expr::Num(n) => return n.mantissa < 0,
            Expr::Node(node) => &**node,
        };
        match node {
            Node::Var(Var::System(_)) | Node::Element(_) | Node::Unary(Unary::Negate, _) => true,
            Node::Var(var) => self.negative.get(&self.key(var)).copied().unwrap_or(false),
            Node::Vacant | Node::Unary(Unary::Not, _) => false,
            Node::Binary(operator, ..) if operator.decides() => false,
            Node::Binary(Binary::Subtract, ..) => true,
            Node::Binary(Binary::Modulo, a, _) => self.may_be_negative(a),
            Node::Binary(_, a, b) => self.may_be_negative(a) || self.may_be_negative(b),
            Node::Call(function, arguments) => match function {
                Function::Abs
                | Function::Sqrt
                | Function::Exp
                | Function::Acos
                | Function::Remainder
                | Function::Near
                | Function::NearRatio => false,
                Function::Given
                | Function::Round
                | Function::RoundUp
                | Function::Floor
                | Function::Ceiling
                | Function::Truncate
                | Function::Min => arguments.iter().any(|a| self.may_be_negative(a)),
                Function::RoundTo => arguments.first().is_none_or(|a| self.may_be_negative(a)),
                Function::Max => arguments.iter().all(|a| self.may_be_negative(a)),
                _ => true,
            },
        }
    }

    fn gives(&mut self, var: &Var, value: &Expr) {
        let (digits, negative) = (self.digits(value), self.may_be_negative(value));
        self.has(self.key(var), digits, negative);
    }

    fn has(&mut self, key: (usize, Text), digits: Digits, negative: bool) {
        let known = self.known.entry(key.clone()).or_insert(digits);
        *known = more(*known, digits);
        *self.negative.entry(key).or_insert(false) |= negative;
    }

    fn body(&mut self, body: &[Stmt], procedures: &[&Procedure]) {
        for stmt in body {
            match &stmt.op {
                Op::Assign(Target::Var(var), value) => self.gives(var, value),
                Op::Assign(Target::Element(element), value) => self.element(element, value),
                Op::Declare(declare) => {
                    let zero = Expr::int(0);
                    let values: Vec<&Expr> = declare.initial.iter().flatten().collect();
                    for value in values.into_iter().chain([&zero]) {
                        self.gives(&declare.var, value);
                    }
                }
                Op::Call(call) => self.call(call, procedures),
                Op::Control(control) => {
                    if let Control::For { variable, from, to: _, step, .. } = &**control {
                        self.gives(variable, from);
                        let digits = more(self.digits(from), self.digits(step));
                        let negative = self.may_be_negative(step);
                        self.has(self.key(variable), digits, negative);
                    }
                    control.bodies().for_each(|body| self.body(body, procedures));
                }
                _ => {}
            }
        }
    }

    /// Values for the parameters of what is called; those that it shares with its caller have what that has.
    fn call(&mut self, call: &crate::program::Call, procedures: &[&Procedure]) {
        let Some((there, called)) = procedures.iter().enumerate().skip(1).find(|(_, p)| p.name == call.name)
        else {
            return;
        };
        if call.shared && call.arguments.is_empty() {
            let here: Vec<_> =
                self.known.keys().filter(|(at, _)| *at == self.at || *at == there).cloned().collect();
            for (at, name) in here {
                let digits = self.known.get(&(at, name.clone())).copied().flatten();
                let negative = self.negative.get(&(at, name.clone())).copied().unwrap_or(true);
                let other = if at == there { self.at } else { there };
                self.has((other, name), digits, negative);
            }
            return;
        }
        for (parameter, value) in called.parameters.iter().zip(&call.arguments) {
            let (digits, negative) = (self.digits(value), self.may_be_negative(value));
            match parameter {
                Var::Local(name) => self.has((there, name.clone()), digits, negative),
                Var::Common(_) | Var::Retentive(_) | Var::System(_) => {
                    self.has(self.key(parameter), digits, negative);
                }
            }
        }
    }

    /// A value for one of many: it may be any of them.
    fn element(&mut self, element: &Element, value: &Expr) {
        let (digits, negative) = (self.digits(value), self.may_be_negative(value));
        if let Many::Array { var, .. } = &element.of {
            let key = self.key(var);
            return self.has(key, digits, negative);
        }
        let numbered = |name: &str| name.bytes().any(|b| b.is_ascii_digit());
        let met: Vec<_> = self.known.keys().filter(|(_, name)| numbered(name)).cloned().collect();
        for key in met {
            self.has(key, digits, negative);
        }
    }
}
