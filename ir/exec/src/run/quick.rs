//! The short way of a run: assignments, branches and jumps whose variables all hold numbers.
//!
//! ```text
//! #6=5.0*SIN[#4]    with a number in #4: evaluated here
//! #6=#9             with nothing in #9: left to the long way
//! ```
//!
//! It does what the long way does, or nothing: errors, block skip, empty variables and values of the control are left to it.

use super::Runner;
use crate::Exec;
use crate::halt;
use crate::run::code::{Code, Step};
use crate::run::term::{Place, Term, Variables};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::value::{self, Value};
use ncc_ir::expr::{Binary, Function};

/// No value: the long way evaluates the term. A value of a program is finite.
const LEFT: f64 = f64::NAN;

impl Variables {
    /// The value of a term, or [`LEFT`].
    pub(crate) fn quick(&self, term: &Term) -> f64 {
        match term {
            Term::Number(n) => *n,
            Term::Read(place) => self.held(*place),
            Term::Unary(operator, a) => {
                let a = self.quick_operand(a);
                if a.is_nan() { LEFT } else { value::unary(*operator, a) }
            }
            Term::Binary(operator, both) => {
                let (a, b) = (self.quick_operand(&both[0]), self.quick_operand(&both[1]));
                match operator {
                    _ if a.is_nan() || b.is_nan() => LEFT,
                    // The most usual ones first.
                    Binary::Add => finite(a + b),
                    Binary::Subtract => finite(a - b),
                    Binary::Multiply => finite(a * b),
                    operator => value::binary(*operator, a, b).unwrap_or(LEFT),
                }
            }
            Term::Of(f, a) => {
                let a = self.quick_operand(a);
                if a.is_nan() { LEFT } else { value::function(*f, a, 0.0).unwrap_or(LEFT) }
            }
            Term::OfTwo(f, both) => {
                let (a, b) = (self.quick_operand(&both[0]), self.quick_operand(&both[1]));
                match f {
                    _ if a.is_nan() || b.is_nan() => LEFT,
                    Function::RoundTo => value::round_to(a, b).unwrap_or(LEFT),
                    f => value::function(*f, a, b).unwrap_or(LEFT),
                }
            }
            Term::OfThree(f, all) => {
                let [a, b, c] = [&all[0], &all[1], &all[2]].map(|term| self.quick_operand(term));
                if a.is_nan() || b.is_nan() || c.is_nan() {
                    return LEFT;
                }
                value::near(*f, a, b, c).unwrap_or(LEFT)
            }
            Term::Vacant
            | Term::System(_)
            | Term::Measured
            | Term::Element(_)
            | Term::Given(_)
            | Term::Miscounted => LEFT,
        }
    }

    /// The same; literals and variables, which most operands are, without a call.
    #[inline(always)]
    fn quick_operand(&self, term: &Term) -> f64 {
        match term {
            Term::Number(n) => *n,
            Term::Read(place) => self.held(*place),
            term => self.quick(term),
        }
    }

    /// The number in a variable, or [`LEFT`].
    #[inline(always)]
    fn held(&self, place: Place) -> f64 {
        match place {
            Place::Local(at) => match self.locals[self.base + at as usize] {
                Value::Number(n) => n,
                Value::Vacant => LEFT,
            },
            Place::Shared(at) => match self.shared[at as usize] {
                Some(Value::Number(n)) => n,
                Some(Value::Vacant) | None => LEFT,
            },
        }
    }
}

#[inline(always)]
fn finite(n: f64) -> f64 {
    if n.is_finite() { n } else { LEFT }
}

impl<'p> Runner<'p> {
    /// Goes through the next steps as far as they are assignments, branches and jumps of the short way. `before` is the
    /// number of steps before the present statement.
    ///
    /// # Errors
    /// A loop that the run never leaves.
    #[inline]
    pub(super) fn go_quickly(&mut self, code: &Code<'p>, exec: &Exec, before: u64) -> Result<(), Diagnostic> {
        if halt::is_asked_of_all() {
            return Ok(());
        }
        let most = self.most.min(before.saturating_add(self.most_idle)).min(halt::uncounted(self.steps));
        while self.steps < most && self.at != self.end {
            match &code.steps[self.at as usize] {
                Step::Assign(stmt, to) if stmt.skip.is_none() => {
                    let (Some(place), term) = &**to else { break };
                    let value = self.variables.quick(term);
                    if value.is_nan() {
                        break;
                    }
                    self.variables.set(*place, Value::Number(value));
                    self.at += 1;
                }
                Step::Unless(stmt, condition, to) if stmt.skip.is_none() => {
                    let value = self.variables.quick(condition);
                    if value.is_nan() {
                        break;
                    }
                    self.at += 1;
                    self.decide(value == 0.0, *to);
                }
                Step::UnlessCounted(stmt, counter, to) if stmt.skip.is_none() => {
                    self.at += 1;
                    self.decide(self.is_counted_out(counter), *to);
                }
                Step::Count(stmt, counter) if stmt.skip.is_none() => {
                    self.at += 1;
                    self.count(counter);
                }
                Step::Jump(stmt, to) if stmt.skip.is_none() => {
                    self.steps += 1;
                    let from = std::mem::replace(&mut self.at, *to) + 1;
                    self.goes_on(from, stmt.span)?;
                    continue;
                }
                Step::Goto(stmt, to) if stmt.skip.is_none() => {
                    self.steps += 1;
                    self.at += 1;
                    exec.no_open_corner()?;
                    let from = self.at;
                    self.jump(*to, stmt)?;
                    self.goes_on(from, stmt.span)?;
                    continue;
                }
                _ => break,
            }
            self.steps += 1;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Exec;
    use crate::run::term::{Asked, Names};
    use crate::world::World;
    use ncc_ir::canon::Modes;
    use ncc_ir::expr::Unary;
    use ncc_ir::program::{Op, Procedure, Program, Stmt};
    use ncc_ir::source::Span;

    fn random(seed: &mut u64, below: u64) -> u64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 33) % below
    }

    /// A term of any kind but those of arrays.
    fn term(seed: &mut u64, deep: u8) -> Term {
        let kind = random(seed, if deep == 0 { 5 } else { 12 });
        let part = |seed: &mut u64| term(seed, deep - 1);
        match kind {
            0 => Term::Number(random(seed, 9) as f64 * 0.5 - 2.0),
            1 => Term::Number([0.0, -0.0, 1e300, 3.0, 1e-7][random(seed, 5) as usize]),
            2 | 3 => Term::Read(Place::Local(random(seed, 4) as u32)),
            4 => Term::Read(Place::Shared(random(seed, 3) as u32)),
            5 => Term::Vacant,
            6 => Term::Unary([Unary::Negate, Unary::Not][random(seed, 2) as usize], Box::new(part(seed))),
            7 | 8 => {
                use Binary::*;
                let all = [
                    Add,
                    Subtract,
                    Multiply,
                    Divide,
                    Modulo,
                    Power,
                    Equal,
                    NotEqual,
                    Less,
                    LessOrEqual,
                    Greater,
                    GreaterOrEqual,
                    And,
                    Or,
                    Xor,
                ];
                let operator = all[random(seed, 15) as usize];
                Term::Binary(operator, Box::new([part(seed), part(seed)]))
            }
            9 => {
                use Function::*;
                let all =
                    [Sin, Cos, Tan, Asin, Acos, Sqrt, Abs, Round, RoundUp, Floor, Ceiling, Truncate, Ln, Exp];
                Term::Of(all[random(seed, 14) as usize], Box::new(part(seed)))
            }
            10 => {
                use Function::*;
                let all = [Atan2, RoundTo, Min, Max, Remainder, BitAnd, BitOr, BitXor];
                Term::OfTwo(all[random(seed, 8) as usize], Box::new([part(seed), part(seed)]))
            }
            _ if random(seed, 2) == 0 => Term::Given(Box::new(part(seed))),
            _ => Term::OfThree(Function::Near, Box::new([part(seed), part(seed), part(seed)])),
        }
    }

    /// The short way gives what the long way gives, bit for bit, or nothing.
    #[test]
    fn quick_values_are_those_of_the_long_way() {
        let exec = Exec::new(&World::generate(1, &Modes::default()), 0);
        let asked = Asked { exec: &exec, other: None, system: &[] };
        let mut variables = Variables::new(&Names::default());
        let held = [Value::Number(2.5), Value::Vacant, Value::Number(-0.0), Value::Number(7.0)];
        variables.locals = [Value::Number(9.0)].into_iter().chain(held).collect();
        variables.base = 1;
        variables.shared = vec![Some(Value::Number(-3.0)), Some(Value::Vacant), None];
        let (mut seed, mut quick, mut left) = (1, 0, 0);
        for _ in 0..200_000 {
            let term = term(&mut seed, 3);
            let value = variables.quick(&term);
            if value.is_nan() {
                left += 1;
                continue;
            }
            quick += 1;
            let Ok(Value::Number(long)) = variables.value_at_length(&term, asked) else {
                panic!("{value} of {term:?}")
            };
            assert_eq!(value.to_bits(), long.to_bits(), "{term:?}");
        }
        assert!(quick > 50_000 && left > 20_000, "{quick} {left}");
    }

    /// Steps of the short way count: a run ends after as many as without it, in the same place.
    #[test]
    fn quick_steps_are_counted() {
        let stmt = |at: u32, op| Stmt::new(Span::new(at, at + 1), op);
        let jumps = (0..8).map(|at| match at {
            0 => stmt(0, Op::Label("A".into())),
            7 => stmt(7, Op::Goto("A".into())),
            at => stmt(at, Op::Assign(ncc_ir::expr::Target::Var(counter()), next())),
        });
        let program = Program {
            procedures: vec![Procedure { body: jumps.collect(), ..Procedure::default() }],
            ..Program::default()
        };
        for most in [10, 11, 12, 100, 70_000] {
            let mut runner = Runner::new(&program);
            runner.give(&mut |_| Some(Value::Number(0.0)));
            runner.limit(most);
            let exec = Exec::new(&World::generate(1, &Modes::default()), 0);
            let mut labels = 0;
            let fault = loop {
                match runner.next(&exec) {
                    Ok(Some(_)) => labels += 1,
                    Ok(None) => panic!("no end"),
                    Err(fault) => break fault,
                }
            };
            assert_eq!(fault.fault, ncc_ir::diag::Fault::NoEnd { steps: most });
            assert_eq!((runner.steps(), labels), (most + 1, most.div_ceil(8)), "{most}");
            assert_eq!(u64::from(fault.span.start), most % 8, "{most}");
        }
    }

    fn counter() -> ncc_ir::expr::Var {
        ncc_ir::expr::Var::Local("1".into())
    }

    /// #1+1.
    fn next() -> ncc_ir::expr::Expr {
        use ncc_ir::expr::num::{Num, Unit};
        use ncc_ir::expr::{Expr, Node};
        let one = Expr::Num(Num::int(1, Unit::One));
        Expr::Node(Box::new(Node::Binary(Binary::Add, Expr::Node(Box::new(Node::Var(counter()))), one)))
    }
}
