//! Expressions made ready to be computed: variables are places in memory, literals binary numbers.
//!
//! Not here: what operators and functions mean (`value`).

use std::collections::HashMap;

use crate::diag::Fault;
use crate::expr::{Binary, Expr, Function, Node, Unary, Var};
use crate::num::{Num, POW10, Unit};
use crate::value::{self, Value, Wrong};

/// An expression made ready.
#[derive(Clone, Debug)]
pub(super) enum Term {
    Number(f64),
    Vacant,
    Read(Place),
    /// Something of the control itself, which is not executed: its place among [`Names::system`].
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
    system: Vec<Box<str>>,
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
                let name = self.system.get(at as usize).map_or("", |name| name);
                Fault::NotExecuted { what: format!("the system variable {name}").into() }
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
                    self.system.push(var.name().into());
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
    pub(super) fn value(&self, term: &Term) -> Result<Value, Why> {
        Ok(match term {
            Term::Vacant => Value::Vacant,
            Term::Read(place) => self.read(*place)?,
            Term::Unary(Unary::Negate, a) => match self.value(a)? {
                Value::Vacant => Value::Vacant,
                Value::Number(n) => Value::Number(-n),
            },
            Term::OfTwo(f @ Function::RoundTo, both) => match self.value(&both[0])? {
                Value::Vacant => Value::Vacant,
                Value::Number(n) => {
                    Value::Number(value::function(*f, n, self.number(&both[1])?).map_err(Why::Wrong)?)
                }
            },
            Term::Number(_)
            | Term::System(_)
            | Term::Measured
            | Term::Unary(..)
            | Term::Binary(..)
            | Term::Of(..)
            | Term::OfTwo(..)
            | Term::Miscounted => Value::Number(self.number(term)?),
        })
    }

    /// The same as an operand, which is all that most need of it.
    pub(super) fn number(&self, term: &Term) -> Result<f64, Why> {
        Ok(match term {
            Term::Number(n) => *n,
            Term::Vacant => 0.0,
            Term::Read(place) => self.read(*place)?.number(),
            Term::Unary(operator, a) => value::unary(*operator, self.number(a)?),
            Term::Binary(operator @ (Binary::Equal | Binary::NotEqual), both) => {
                let [a, b] = &**both;
                let same = self.value(a)? == self.value(b)?;
                f64::from(u8::from(same == (*operator == Binary::Equal)))
            }
            Term::Binary(operator, both) => {
                let [a, b] = &**both;
                value::binary(*operator, self.number(a)?, self.number(b)?).map_err(Why::Wrong)?
            }
            Term::Of(f, a) => value::function(*f, self.number(a)?, 0.0).map_err(Why::Wrong)?,
            Term::OfTwo(f, both) => {
                let [a, b] = &**both;
                value::function(*f, self.number(a)?, self.number(b)?).map_err(Why::Wrong)?
            }
            Term::System(at) => return Err(Why::System(*at)),
            Term::Measured => return Err(Why::Measured),
            Term::Miscounted => return Err(Why::Wrong(Wrong::Arguments)),
        })
    }
}
