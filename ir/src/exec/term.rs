//! Expressions made ready to be computed: variables are places in memory, literals binary numbers.
//!
//! Not here: what operators and functions mean (`value`).

use std::collections::HashMap;

use super::Exec;
use crate::diag::Fault;
use crate::expr::{Binary, Expr, Function, Node, Unary, Var};
use crate::num::{Num, POW10, Unit};
use crate::system::System;
use crate::value::{self, Value, Wrong};

/// An expression made ready.
#[derive(Clone, Debug)]
pub(super) enum Term {
    Number(f64),
    Vacant,
    Read(Place),
    /// Something of the control itself: its place among [`Names::system`].
    System(u32),
    /// A literal that says its own unit: what it counts here is not said.
    Measured,
    Unary(Unary, Box<Term>),
    Binary(Binary, Box<[Term; 2]>),
    Of(Function, Box<Term>),
    OfTwo(Function, Box<[Term; 2]>),
    /// A function with another number of arguments than it has.
    Miscounted,
}

/// Where a variable is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// In the locals of the call.
    Local(u32),
    /// Among those that all procedures see.
    Shared(u32),
}

/// Why an expression has no value.
#[derive(Clone, Copy, Debug)]
pub(super) enum Why {
    Wrong(Wrong),
    /// The variable was not set by the program.
    Unset(u32),
    System(u32),
    Measured,
}

/// Names of variables, and their places.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    locals: HashMap<Box<str>, u32>,
    shared: HashMap<Var, u32>,
    /// Those of the control's own.
    pub(super) system: Vec<System>,
    /// Places of locals in a call, those without a name included.
    pub(super) count: u32,
}

impl Names {
    /// The place of a variable; one of the control's own has none.
    pub(super) fn place(&mut self, var: &Var) -> Option<Place> {
        match var {
            Var::Local(name) => Some(Place::Local(match self.locals.get(name) {
                Some(place) => *place,
                None => {
                    let place = self.unnamed();
                    self.locals.insert(name.clone(), place);
                    place
                }
            })),
            Var::Common(_) | Var::Retentive(_) => {
                let next = self.shared.len() as u32;
                Some(Place::Shared(*self.shared.entry(var.clone()).or_insert(next)))
            }
            Var::System(_) => None,
        }
    }

    /// A further local, without a name.
    pub(super) fn unnamed(&mut self) -> u32 {
        self.count += 1;
        self.count - 1
    }

    /// How many variables all procedures see.
    pub(super) fn shared(&self) -> usize {
        self.shared.len()
    }

    /// Why an expression has no value, in words of the user's.
    pub(super) fn fault(&self, why: Why) -> Fault {
        match why {
            Why::Wrong(wrong) => Fault::NoValue { what: wrong.words().into() },
            Why::Unset(place) => {
                let var = self.shared.iter().find(|(_, at)| **at == place).map(|(var, _)| var.name());
                Fault::VariableUnset { name: var.unwrap_or_default().into() }
            }
            Why::System(at) => {
                let what = match self.system.get(at as usize) {
                    Some(System::Other(name)) => format!("the system variable {name}"),
                    Some(asked) => format!("the system variable {asked}, which is not known here"),
                    None => String::new(),
                };
                Fault::NotExecuted { what: what.into() }
            }
            Why::Measured => {
                Fault::NotExecuted { what: "a literal with a unit of its own in an expression".into() }
            }
        }
    }

    /// An expression made ready.
    pub(super) fn term(&mut self, e: &Expr) -> Term {
        let node = match e {
            Expr::Num(n) if n.unit == Unit::One => return Term::Number(real(*n)),
            Expr::Num(_) => return Term::Measured,
            Expr::Node(node) => &**node,
        };
        match node {
            Node::Vacant => Term::Vacant,
            Node::Var(var) => match self.place(var) {
                Some(place) => Term::Read(place),
                None => {
                    self.system.extend(match var {
                        Var::System(system) => Some(system.clone()),
                        Var::Local(_) | Var::Common(_) | Var::Retentive(_) => None,
                    });
                    Term::System(self.system.len() as u32 - 1)
                }
            },
            Node::Unary(operator, a) => Term::Unary(*operator, Box::new(self.term(a))),
            Node::Binary(operator, a, b) => Term::Binary(*operator, Box::new([self.term(a), self.term(b)])),
            Node::Call(f, arguments) => match &arguments[..] {
                [a] if f.arguments() == 1 => Term::Of(*f, Box::new(self.term(a))),
                [a, b] if f.arguments() == 2 => Term::OfTwo(*f, Box::new([self.term(a), self.term(b)])),
                _ => Term::Miscounted,
            },
        }
    }
}

fn real(n: Num) -> f64 {
    n.mantissa as f64 / POW10[usize::from(n.scale.min(18))] as f64
}

/// Who answers for the control's own values.
#[derive(Clone, Copy)]
pub(super) struct Asked<'a> {
    pub(super) exec: &'a Exec,
    /// Another control that executes the same program; what they do not agree about is not known.
    pub(super) other: Option<&'a Exec>,
    pub(super) system: &'a [System],
}

impl Asked<'_> {
    #[cold]
    fn answer(self, at: u32) -> Option<f64> {
        let asked = self.system.get(at as usize)?;
        let answer = self.exec.answer(asked)?;
        match self.other {
            None => Some(answer),
            Some(other) => other.answer(asked).filter(|theirs| (theirs - answer).abs() < 1e-8),
        }
    }
}

/// Variables while a program runs.
#[derive(Clone, Debug)]
pub(super) struct Variables {
    /// Those of all calls in force, one after the other.
    pub(super) locals: Vec<Value>,
    /// Where those of the present call begin.
    pub(super) base: usize,
    shared: Vec<Option<Value>>,
}

impl Variables {
    pub(super) fn new(names: &Names) -> Variables {
        let locals = vec![Value::Vacant; names.count as usize];
        Variables { locals, base: 0, shared: vec![None; names.shared()] }
    }

    pub(super) fn set(&mut self, place: Place, value: Value) {
        match place {
            Place::Local(at) => self.locals[self.base + at as usize] = value,
            Place::Shared(at) => self.shared[at as usize] = Some(value),
        }
    }

    /// The value of one that is set; else nothing.
    pub(super) fn get(&self, place: Place) -> Value {
        self.read(place).unwrap_or(Value::Vacant)
    }

    #[inline]
    fn read(&self, place: Place) -> Result<Value, Why> {
        match place {
            Place::Local(at) => Ok(self.locals[self.base + at as usize]),
            Place::Shared(at) => self.shared[at as usize].ok_or(Why::Unset(at)),
        }
    }

    /// What an expression is worth. With another sign, or rounded to some digits, nothing stays nothing: a word
    /// `X-#1` is left out where `X#1` is.
    pub(super) fn value(&self, term: &Term, asked: Asked) -> Result<Value, Why> {
        Ok(match term {
            Term::Vacant => Value::Vacant,
            Term::Read(place) => self.read(*place)?,
            Term::Unary(Unary::Negate, a) => match self.value(a, asked)? {
                Value::Vacant => Value::Vacant,
                Value::Number(n) => Value::Number(-n),
            },
            Term::OfTwo(f @ Function::RoundTo, both) => match self.value(&both[0], asked)? {
                Value::Vacant => Value::Vacant,
                Value::Number(n) => {
                    Value::Number(value::function(*f, n, self.number(&both[1], asked)?).map_err(Why::Wrong)?)
                }
            },
            Term::Number(_)
            | Term::System(_)
            | Term::Measured
            | Term::Unary(..)
            | Term::Binary(..)
            | Term::Of(..)
            | Term::OfTwo(..)
            | Term::Miscounted => Value::Number(self.number(term, asked)?),
        })
    }

    /// The same as an operand, which is all that most need of it.
    pub(super) fn number(&self, term: &Term, asked: Asked) -> Result<f64, Why> {
        Ok(match term {
            Term::Number(n) => *n,
            Term::Vacant => 0.0,
            Term::Read(place) => self.read(*place)?.number(),
            Term::Unary(operator, a) => value::unary(*operator, self.number(a, asked)?),
            Term::Binary(operator @ (Binary::Equal | Binary::NotEqual), both) => {
                let [a, b] = &**both;
                let same = self.value(a, asked)? == self.value(b, asked)?;
                f64::from(u8::from(same == (*operator == Binary::Equal)))
            }
            Term::Binary(operator, both) => {
                let [a, b] = &**both;
                value::binary(*operator, self.number(a, asked)?, self.number(b, asked)?)
                    .map_err(Why::Wrong)?
            }
            Term::Of(f, a) => value::function(*f, self.number(a, asked)?, 0.0).map_err(Why::Wrong)?,
            Term::OfTwo(f, both) => {
                let [a, b] = &**both;
                value::function(*f, self.number(a, asked)?, self.number(b, asked)?).map_err(Why::Wrong)?
            }
            Term::System(at) => asked.answer(*at).ok_or(Why::System(*at))?,
            Term::Measured => return Err(Why::Measured),
            Term::Miscounted => return Err(Why::Wrong(Wrong::Arguments)),
        })
    }
}
