//! Expressions made ready to be computed: variables are places in memory, literals binary numbers.
//!
//! Not here: what operators and functions mean (`value`).

use std::collections::HashMap;
use std::rc::Rc;

use crate::Exec;
use ncc_ir::diag::{Fault, NoValue};
use ncc_ir::expr::num::{Num, ONE, POW10, Unit};
use ncc_ir::expr::system::System;
use ncc_ir::expr::value::{self, Value, Wrong};
use ncc_ir::expr::{Binary, Element, Expr, Function, Many, Node, Numbers, Unary, Var};
use ncc_ir::syntax::Ranged;
use ncc_ir::unexecuted::ValueUnexecuted;

/// An expression made ready.
#[derive(Clone, Debug)]
pub(crate) enum Term {
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
    OfThree(Function, Box<[Term; 3]>),
    Element(Box<Indexed>),
    /// What must have a value.
    Given(Box<Term>),
    /// A function with another number of arguments than it has.
    Miscounted,
}

/// One of many variables, made ready.
#[derive(Clone, Debug)]
pub(crate) struct Indexed {
    of: Rows,
    /// Elements of an array in each direction; of numbers there is one.
    sizes: Box<[u32]>,
    at: Box<[Term]>,
}

/// All those of which one is meant.
type Rows = Rc<[Row]>;

/// Places of variables one after the other.
#[derive(Clone, Debug)]
struct Row {
    /// The number of the first.
    from: u32,
    places: Places,
}

#[derive(Clone, Debug)]
enum Places {
    /// From there on, so many.
    Together(Place, u32),
    Each(Box<[Place]>),
}

/// Most elements of an array.
const MOST_ELEMENTS: u32 = 1_000_000;

/// Where a variable is kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Place {
    /// In the locals of the call.
    Local(u32),
    /// Among those that all procedures see.
    Shared(u32),
}

/// Why an expression has no value.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Why {
    Wrong(Wrong),
    /// The variable was not set by the program.
    Unset(u32),
    System(u32),
    Measured,
    /// No element has this index.
    Index,
}

/// Names of variables, and their places.
#[derive(Clone, Debug, Default)]
pub(crate) struct Names {
    locals: HashMap<Box<str>, u32>,
    shared: HashMap<Var, u32>,
    /// Those of the control's own.
    pub(crate) system: Vec<System>,
    /// Variables that have numbers, where one of them is computed.
    numbered: Vec<(Box<[Numbers]>, Rows)>,
    /// Arrays, each with its first place and how many it has.
    arrays: HashMap<Var, (Place, u32)>,
    /// Places of variables that all procedures see.
    shared_count: u32,
    /// Places of locals in a call, those without a name included.
    pub(crate) count: u32,
}

impl Names {
    /// The place of a variable; one of the control's own has none.
    pub(crate) fn place(&mut self, var: &Var) -> Option<Place> {
        match var {
            Var::Local(name) => Some(Place::Local(match self.locals.get(name) {
                Some(place) => *place,
                None => {
                    let place = self.unnamed();
                    self.locals.insert(name.clone(), place);
                    place
                }
            })),
            Var::Common(_) | Var::Retentive(_) => Some(Place::Shared(match self.shared.get(var) {
                Some(place) => *place,
                None => {
                    let place = self.shared_count;
                    self.shared_count += 1;
                    self.shared.insert(var.clone(), place);
                    place
                }
            })),
            Var::System(_) => None,
        }
    }

    /// All variables that have names, with their places.
    pub(crate) fn all(&self) -> Vec<(Var, Place)> {
        let locals = self.locals.iter().map(|(name, at)| (Var::Local(name.clone()), Place::Local(*at)));
        let shared = self.shared.iter().map(|(var, at)| (var.clone(), Place::Shared(*at)));
        locals.chain(shared).collect()
    }

    /// A further local, without a name.
    pub(crate) fn unnamed(&mut self) -> u32 {
        self.count += 1;
        self.count - 1
    }

    /// How many variables all procedures see.
    pub(crate) fn shared(&self) -> usize {
        self.shared_count as usize
    }

    /// The places of an array; `None` is one of no element, of too many, or of the control's own.
    pub(crate) fn array(&mut self, var: &Var, sizes: &[u32]) -> Option<(Place, u32)> {
        let count = sizes.iter().try_fold(1u32, |all, size| all.checked_mul(*size));
        let count = count.filter(|count| (1..=MOST_ELEMENTS).contains(count))?;
        if let Some(known) = self.arrays.get(var) {
            return (known.1 == count).then_some(*known);
        }
        let first = match var {
            Var::Local(_) => {
                self.count += count;
                Place::Local(self.count - count)
            }
            Var::Common(_) | Var::Retentive(_) => {
                self.shared_count += count;
                Place::Shared(self.shared_count - count)
            }
            Var::System(_) => return None,
        };
        self.arrays.insert(var.clone(), (first, count));
        Some((first, count))
    }

    /// One of many, made ready; `None` is an array that there cannot be.
    pub(crate) fn element(&mut self, element: &Element) -> Option<Indexed> {
        let at: Box<[Term]> = element.at.iter().map(|index| self.term(index)).collect();
        let (of, sizes) = match &element.of {
            Many::Array { var, sizes } => {
                let (first, count) = self.array(var, sizes)?;
                (Rc::from([Row { from: 0, places: Places::Together(first, count) }]), sizes.clone())
            }
            Many::Numbered(numbers) => (self.numbers(numbers), Box::from([u32::MAX])),
        };
        (at.len() == sizes.len()).then_some(Indexed { of, sizes, at })
    }

    fn numbers(&mut self, numbers: &[Numbers]) -> Rows {
        if let Some((_, rows)) = self.numbered.iter().find(|(known, _)| **known == *numbers) {
            return Rc::clone(rows);
        }
        let rows: Rows = numbers
            .iter()
            .filter(|range| range.from <= range.to && range.to - range.from < MOST_ELEMENTS)
            .map(|range| {
                let places = (range.from..=range.to)
                    .filter_map(|number| self.place(&range.scope.var(&format!("{}{number}", range.prefix))));
                Row { from: range.from, places: Places::Each(places.collect()) }
            })
            .collect();
        self.numbered.push((numbers.into(), Rc::clone(&rows)));
        rows
    }

    /// Why an expression has no value, in words of the user's.
    pub(crate) fn fault(&self, why: Why) -> Fault {
        match why {
            Why::Wrong(wrong) => Fault::NoValue { why: NoValue::Wrong(wrong) },
            Why::Unset(place) => {
                let var = self.shared.iter().find(|(_, at)| **at == place).map(|(var, _)| var.name());
                let array = || {
                    let of = |first: &Place, count: u32| match first {
                        Place::Shared(at) => (*at..at + count).contains(&place),
                        Place::Local(_) => false,
                    };
                    let found = self.arrays.iter().find(|(_, (first, count))| of(first, *count));
                    found.map(|(var, _)| var.name())
                };
                Fault::VariableUnset { name: var.or_else(array).unwrap_or_default().into() }
            }
            Why::Index => Fault::NoValue { why: NoValue::Index },
            Why::System(at) => Fault::not_executed(match self.system.get(at as usize) {
                Some(System::Other(name)) => ValueUnexecuted::SystemVariable { name: (**name).into() },
                Some(asked) => ValueUnexecuted::SystemVariableUnknown { asked: asked.clone() },
                None => ValueUnexecuted::SystemVariable { name: "".into() },
            }),
            Why::Measured => Fault::not_executed(ValueUnexecuted::LiteralUnit),
        }
    }

    /// An expression made ready.
    pub(crate) fn term(&mut self, e: &Expr) -> Term {
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
            Node::Element(element) => match self.element(element) {
                Some(indexed) => Term::Element(Box::new(indexed)),
                None => Term::Miscounted,
            },
            Node::Unary(operator, a) => Term::Unary(*operator, Box::new(self.term(a))),
            Node::Binary(operator, a, b) => Term::Binary(*operator, Box::new([self.term(a), self.term(b)])),
            Node::Call(f, arguments) => match &arguments[..] {
                [a] if *f == Function::Given => Term::Given(Box::new(self.term(a))),
                [a] if f.arguments() == 1 => Term::Of(*f, Box::new(self.term(a))),
                [a, b] if f.arguments() == 2 => Term::OfTwo(*f, Box::new([self.term(a), self.term(b)])),
                [a, b, c] if f.arguments() == 3 => {
                    Term::OfThree(*f, Box::new([self.term(a), self.term(b), self.term(c)]))
                }
                _ => Term::Miscounted,
            },
        }
    }
}

pub(crate) fn real(n: Num) -> f64 {
    n.mantissa as f64 / POW10[usize::from(n.scale.min(18))] as f64
}

/// A value as a literal, to a billionth, or where it may be of an inch to a hundred-millionth; nothing is none.
#[inline]
pub(crate) fn literal(value: Value, unit: Unit) -> Result<Option<Num>, Fault> {
    let Value::Number(n) = value else { return Ok(None) };
    if unit == Unit::One && n.abs() < 1e15 && n == n as i64 as f64 {
        return Ok(Some(Num::int(n as i64, unit)));
    }
    let (scale, scaled) = match unit {
        Unit::Entry => (8, n * (ONE as f64 / 10.0)),
        Unit::One | Unit::Mm | Unit::Inch | Unit::Degree | Unit::Second => (9, n * ONE as f64),
    };
    if scaled.abs() >= 9e18 {
        return Err(Fault::OutOfRange { word: Ranged::TooLarge { about: n as i64 } });
    }
    // Half away from zero.
    let mantissa = (scaled + 0.5f64.copysign(scaled)) as i64;
    Ok(Some(Num { mantissa, scale, point: true, unit }))
}

/// Who answers for the control's own values.
#[derive(Clone, Copy)]
pub(crate) struct Asked<'a> {
    pub(crate) exec: &'a Exec,
    /// Another control that executes the same program; what they do not agree about is not known.
    pub(crate) other: Option<&'a Exec>,
    pub(crate) system: &'a [System],
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
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Variables {
    /// Those of all active calls, one after the other.
    pub(crate) locals: Vec<Value>,
    /// Where those of the present call begin.
    pub(crate) base: usize,
    pub(crate) shared: Vec<Option<Value>>,
}

impl Variables {
    pub(crate) fn new(names: &Names) -> Variables {
        let locals = vec![Value::Vacant; names.count as usize];
        Variables { locals, base: 0, shared: vec![None; names.shared()] }
    }

    pub(crate) fn set(&mut self, place: Place, value: Value) {
        match place {
            Place::Local(at) => self.locals[self.base + at as usize] = value,
            Place::Shared(at) => self.shared[at as usize] = Some(value),
        }
    }

    /// The value of one that is set; else nothing.
    pub(crate) fn get(&self, place: Place) -> Value {
        self.read(place).unwrap_or(Value::Vacant)
    }

    #[inline]
    pub(crate) fn read(&self, place: Place) -> Result<Value, Why> {
        match place {
            Place::Local(at) => Ok(self.locals[self.base + at as usize]),
            Place::Shared(at) => self.shared[at as usize].ok_or(Why::Unset(at)),
        }
    }

    /// Where one of many is.
    pub(crate) fn at(&self, element: &Indexed, asked: Asked) -> Result<Place, Why> {
        let mut number = 0.0;
        for (term, size) in element.at.iter().zip(&*element.sizes) {
            let index = self.number(term, asked)?;
            if index != index.trunc() || !(0.0..f64::from(*size)).contains(&index) {
                return Err(Why::Index);
            }
            number = number * f64::from(*size) + index;
        }
        let number = number as u32;
        let found = element.of.iter().find_map(|row| {
            let offset = number.checked_sub(row.from)?;
            match &row.places {
                Places::Together(Place::Local(first), count) => {
                    (offset < *count).then(|| Place::Local(first + offset))
                }
                Places::Together(Place::Shared(first), count) => {
                    (offset < *count).then(|| Place::Shared(first + offset))
                }
                Places::Each(places) => places.get(offset as usize).copied(),
            }
        });
        found.ok_or(Why::Index)
    }

    /// The value of an expression. With another sign, or rounded to some digits, nothing stays nothing: a word
    /// `X-#1` is left out where `X#1` is.
    #[inline]
    pub(crate) fn value(&self, term: &Term, asked: Asked) -> Result<Value, Why> {
        let quick = self.quick(term);
        if quick.is_nan() { self.value_at_length(term, asked) } else { Ok(Value::Number(quick)) }
    }

    pub(crate) fn value_at_length(&self, term: &Term, asked: Asked) -> Result<Value, Why> {
        Ok(match term {
            Term::Vacant => Value::Vacant,
            Term::Read(place) => self.read(*place)?,
            Term::Element(element) => self.read(self.at(element, asked)?)?,
            Term::Unary(Unary::Negate, a) => match self.value_at_length(a, asked)? {
                Value::Vacant => Value::Vacant,
                Value::Number(n) => Value::Number(-n),
            },
            Term::OfTwo(f @ Function::RoundTo, both) => match self.value_at_length(&both[0], asked)? {
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
            | Term::OfThree(..)
            | Term::Given(_)
            | Term::Miscounted => Value::Number(self.number(term, asked)?),
        })
    }

    /// The same where it is next to nothing to be computed, which it nearly always is.
    #[inline(always)]
    fn operand(&self, term: &Term, asked: Asked) -> Result<f64, Why> {
        match term {
            Term::Number(n) => Ok(*n),
            Term::Read(Place::Local(at)) => Ok(self.locals[self.base + *at as usize].number()),
            term => self.number(term, asked),
        }
    }

    /// The same as an operand, which is all that most need of it.
    pub(crate) fn number(&self, term: &Term, asked: Asked) -> Result<f64, Why> {
        Ok(match term {
            Term::Number(n) => *n,
            Term::Vacant => 0.0,
            Term::Read(place) => self.read(*place)?.number(),
            Term::Element(element) => self.read(self.at(element, asked)?)?.number(),
            Term::Unary(operator, a) => value::unary(*operator, self.operand(a, asked)?),
            Term::Binary(operator @ (Binary::Equal | Binary::NotEqual), both) => {
                let [a, b] = &**both;
                let same = self.value_at_length(a, asked)? == self.value_at_length(b, asked)?;
                f64::from(u8::from(same == (*operator == Binary::Equal)))
            }
            Term::Binary(operator, both) => {
                let [a, b] = &**both;
                value::binary(*operator, self.operand(a, asked)?, self.operand(b, asked)?)
                    .map_err(Why::Wrong)?
            }
            Term::Given(a) => match self.value_at_length(a, asked)? {
                Value::Number(n) => n,
                Value::Vacant => return Err(Why::Wrong(Wrong::NothingGiven)),
            },
            Term::Of(f, a) => value::function(*f, self.operand(a, asked)?, 0.0).map_err(Why::Wrong)?,
            Term::OfTwo(f, both) => {
                let [a, b] = &**both;
                value::function(*f, self.operand(a, asked)?, self.operand(b, asked)?).map_err(Why::Wrong)?
            }
            Term::OfThree(f, all) => {
                let [a, b, c] = &**all;
                let (a, b) = (self.operand(a, asked)?, self.operand(b, asked)?);
                value::near(*f, a, b, self.operand(c, asked)?).map_err(Why::Wrong)?
            }
            Term::System(at) => asked.answer(*at).ok_or(Why::System(*at))?,
            Term::Measured => return Err(Why::Measured),
            Term::Miscounted => return Err(Why::Wrong(Wrong::Arguments)),
        })
    }
}
