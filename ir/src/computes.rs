//! What of a program that computes a target can say, and which place of a program it cannot.
//!
//! Not here: how it spells it, and what only the digits of its words can tell (the back-end's).

use crate::arguments;
use crate::diag::{Diagnostic, Fault};
use crate::expr::{Binary, Expr, Function, Node, Target, Unary, Var};
use crate::program::{Control, Op, Procedure, Program, Stmt, Text};
use crate::source::Span;

/// What a target computes with.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Computes {
    /// Operators.
    pub operators: Vec<Binary>,
    /// Functions.
    pub functions: Vec<Function>,
    /// With what the names of its variables begin; behind it they are numbers.
    pub prefix: Text,
    /// Whether a variable can have no value at all, which is another thing than zero.
    pub vacant: bool,
    /// Whether words round what is computed for them to their increment.
    pub rounds: bool,
    /// Whether the opposite of a condition can be said.
    pub opposite: bool,
    /// Whether comparisons find real numbers equal that are nearly so.
    pub near: bool,
    /// Whether blocks in loops and behind labels say every fact that is known there.
    pub restates: bool,
    /// Whether a decision can be about any blocks; else about one jump or one assignment.
    pub blocks: bool,
    /// Numbers of variables, from and to, that live as long as a call.
    pub local: Vec<[u32; 2]>,
    /// Of those that all programs see.
    pub common: Vec<[u32; 2]>,
    /// Of those that are kept when the control is off.
    pub retentive: Vec<[u32; 2]>,
    /// How deep loops can stand in one another.
    pub loops: u8,
    /// Whether a program can be called several times, each time with variables of its own and the same arguments.
    pub arguments_again: bool,
    /// Whether a program can be called with arguments, and with variables of its own.
    pub arguments: bool,
}

impl Computes {
    /// Whether a variable can be said.
    pub fn says(&self, var: &Var) -> bool {
        let among = |ranges: &[[u32; 2]], name: &str| {
            let name = name.strip_prefix(&*self.prefix).unwrap_or_default();
            let number: Option<u32> = name.parse().ok();
            number.is_some_and(|n| {
                n.to_string() == name && ranges.iter().any(|[from, to]| (*from..=*to).contains(&n))
            })
        };
        match var {
            Var::Local(name) => among(&self.local, name),
            Var::Common(name) => among(&self.common, name),
            Var::Retentive(name) => among(&self.retentive, name),
            Var::System(_) => false,
        }
    }

    /// The first place that cannot be said.
    pub(crate) fn refusal(&self, program: &Program) -> Option<Diagnostic> {
        let look = Look { computes: self };
        program.procedures.iter().find_map(|procedure| look.procedure(procedure).err())
    }
}

fn refuse(what: impl Into<Text>, at: Span) -> Diagnostic {
    Diagnostic::new(Fault::Computes { what: what.into() }, at)
}

/// Whether an endless body can be left, as far as its statements tell. What has no end cannot be verified.
fn ends(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Goto(_) | Op::Return | Op::ProgramEnd | Op::Call(_) | Op::Alarm(_) | Op::Leave => true,
        Op::Control(control) => control.bodies().any(|body| ends(body)),
        _ => false,
    })
}

/// The name of an operator or a function, as in the text form.
fn called(of: &impl std::fmt::Debug) -> String {
    format!("{of:?}").to_lowercase()
}

struct Look<'c> {
    computes: &'c Computes,
}

impl Look<'_> {
    fn procedure(&self, procedure: &Procedure) -> Result<(), Diagnostic> {
        let at = procedure.body.first().map_or(Span::default(), |stmt| stmt.span);
        procedure.parameters.iter().try_for_each(|parameter| self.variable(parameter, at))?;
        self.body(&procedure.body, 0)
    }

    fn body(&self, body: &[Stmt], loops: u8) -> Result<(), Diagnostic> {
        body.iter().try_for_each(|stmt| self.stmt(stmt, loops))
    }

    fn stmt(&self, stmt: &Stmt, loops: u8) -> Result<(), Diagnostic> {
        let at = stmt.span;
        match &stmt.op {
            Op::Declare(_) => Err(refuse("a variable that is made known", at)),
            Op::Leave | Op::NextTurn => Err(refuse("a loop that is left", at)),
            Op::MessageOf(_) => Err(refuse("a message with values in it", at)),
            Op::Assign(to, value) => {
                match to {
                    Target::Var(var) => self.variable(var, at)?,
                    Target::Element(_) => return Err(refuse("a variable whose number is computed", at)),
                }
                self.expr(value, at)
            }
            Op::Control(control) => self.control(control, stmt, loops),
            Op::Call(call) => {
                if (!call.arguments.is_empty() || !call.shared) && !self.computes.arguments {
                    return Err(refuse("a call with variables of its own", at));
                }
                let own = !call.arguments.is_empty() || !call.shared;
                if own && call.times > 1 && !self.computes.arguments_again {
                    return Err(refuse("a call with variables of its own that is made several times", at));
                }
                call.arguments.iter().try_for_each(|argument| self.expr(argument, at))
            }
            op if arguments::computed(op) => {
                arguments::each(&mut op.clone(), &mut |argument, _| match argument.expr() {
                    Some(expr) => self.expr(expr, at),
                    None => Ok(()),
                })
            }
            _ => Ok(()),
        }
    }

    fn control(&self, control: &Control, stmt: &Stmt, loops: u8) -> Result<(), Diagnostic> {
        let at = stmt.span;
        let deeper = || match loops < self.computes.loops {
            true if stmt.skip.is_some() => Err(refuse("a loop that can be skipped", at)),
            true => Ok(loops + 1),
            false => Err(refuse("a loop within so many others", at)),
        };
        match control {
            Control::While { condition, body } => {
                self.expr(condition, at)?;
                self.body(body, deeper()?)
            }
            Control::Loop { body } if !ends(body) => Err(refuse("a loop that has no end", at)),
            Control::Loop { body } => self.body(body, deeper()?),
            Control::Until { .. } => Err(refuse("a loop that is tested behind each turn", at)),
            Control::If { condition, then, otherwise } => {
                self.expr(condition, at)?;
                if self.computes.blocks {
                    if stmt.skip.is_some() {
                        return Err(refuse("a decision that can be skipped", at));
                    }
                    return control.bodies().try_for_each(|body| self.body(body, loops));
                }
                match (&then[..], &otherwise[..]) {
                    ([only], []) if matches!(only.op, Op::Goto(_) | Op::Assign(..)) => self.body(then, loops),
                    _ => Err(refuse("a decision about more than one statement", at)),
                }
            }
            Control::Repeat { times, body } if times.literal().is_some() => self.body(body, loops),
            Control::Repeat { .. } => Err(refuse("a loop that is repeated a number of times", at)),
            Control::For { .. } => Err(refuse("a loop that counts", at)),
        }
    }

    fn variable(&self, var: &Var, at: Span) -> Result<(), Diagnostic> {
        match var {
            _ if self.computes.says(var) => Ok(()),
            Var::System(_) => Err(refuse(format!("the system variable {}", var.name()), at)),
            Var::Local(name) | Var::Common(name) | Var::Retentive(name) => {
                Err(refuse(format!("the variable {name}"), at))
            }
        }
    }

    fn expr(&self, expr: &Expr, at: Span) -> Result<(), Diagnostic> {
        let Expr::Node(node) = expr else { return Ok(()) };
        match &**node {
            Node::Var(var) => self.variable(var, at),
            Node::Vacant if !self.computes.vacant => Err(refuse("no value at all", at)),
            Node::Vacant => Ok(()),
            Node::Element(_) => Err(refuse("a variable whose number is computed", at)),
            Node::Unary(Unary::Negate, a) => self.expr(a, at),
            Node::Unary(Unary::Not, a) if self.computes.opposite => self.expr(a, at),
            Node::Unary(Unary::Not, _) => Err(refuse("the opposite of a condition", at)),
            Node::Binary(operator, a, b) => {
                if !self.computes.operators.contains(operator) {
                    return Err(refuse(format!("the operator {}", called(operator)), at));
                }
                self.expr(a, at)?;
                self.expr(b, at)
            }
            Node::Call(function, arguments) => {
                // What rounds to digits does so for a word, whose own rounding that may be.
                let own =
                    *function == Function::RoundTo || *function == Function::NearRatio && self.computes.near;
                if !own && !self.computes.functions.contains(function) {
                    return Err(refuse(format!("the function {}", called(function)), at));
                }
                arguments.iter().try_for_each(|argument| self.expr(argument, at))
            }
        }
    }
}
