//! Which place of a program a target cannot say.

use crate::run_time::{RunTime, RunTimeFlow, RunTimeValue, RunTimeWord};
use std::collections::HashMap;

use super::{ComputeFeature, Computes, Handed, counted};
use crate::computed::computed_call::computed_call;
use crate::computed::computed_code::computed_code;
use crate::diag::{Diagnostic, Fault};
use crate::expr::{Binary, Element, Expr, Function, Many, Node, Target, Unary, Var};
use crate::program::arguments;
use crate::program::{Control, Op, Output, Piece, Procedure, Program, Stmt};
use crate::source::Span;

/// Most calls without variables of their own, one within another, that are looked into.
const MOST_SHARED: u32 = 16;

impl Computes {
    /// The first call with variables of its own that stands within more others than the target takes; what calls
    /// itself may do so any number of times.
    pub fn too_deep(&self, program: &Program) -> Option<Diagnostic> {
        struct Depth<'p> {
            program: &'p Program,
            places: HashMap<&'p str, usize>,
            /// What was found in a procedure with so many calls left of both kinds.
            known: HashMap<(usize, u32, u32), Option<Span>>,
        }
        fn down(depth: &mut Depth, body: &[Stmt], left: u32, shared: u32) -> Option<Span> {
            body.iter().find_map(|stmt| match &stmt.op {
                Op::Control(control) => control.bodies().find_map(|body| down(depth, body, left, shared)),
                Op::Call(call) => {
                    let own = !call.shared || !call.arguments.is_empty();
                    let left = left.checked_sub(u32::from(own));
                    match (left, depth.places.get(&*call.name).copied()) {
                        (None, _) => Some(stmt.span),
                        (Some(left), Some(place)) => {
                            let shared = shared.checked_sub(u32::from(!own))?;
                            if let Some(found) = depth.known.get(&(place, left, shared)) {
                                return *found;
                            }
                            let program = depth.program;
                            let found = down(depth, &program.procedures[place].body, left, shared);
                            depth.known.insert((place, left, shared), found);
                            found
                        }
                        (Some(_), None) => None,
                    }
                }
                _ => None,
            })
        }
        if self.calls == 0 {
            return None;
        }
        let most = u32::from(self.calls);
        let mut depth = Depth { program, places: program.by_name(), known: HashMap::new() };
        let at = program
            .procedures
            .iter()
            .find_map(|procedure| down(&mut depth, &procedure.body, most, MOST_SHARED))?;
        Some(refuse(RunTimeFlow::CallOwnDepth, at))
    }

    /// The first place that cannot be stated.
    pub fn refusal<'c>(&'c self, program: &'c Program) -> Option<Diagnostic> {
        let references = match self.handed {
            Handed::Names => program.procedures.iter().flat_map(|procedure| &procedure.parameters).collect(),
            Handed::Letters | Handed::Places => Vec::new(),
        };
        let look = Look { computes: self, references };
        program.procedures.iter().find_map(|procedure| look.procedure(procedure).err())
    }
}

fn refuse(what: impl Into<RunTime>, at: Span) -> Diagnostic {
    Diagnostic::new(Fault::computes(what), at)
}

/// Whether an endless body can be left, as far as its statements tell. What has no end cannot be verified.
fn ends(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::Goto(_)
        | Op::Return
        | Op::ProgramEnd
        | Op::BeginAgain
        | Op::Call(_)
        | Op::Alarm(_)
        | Op::Leave => true,
        Op::Control(control) => control.bodies().any(|body| ends(body)),
        _ => false,
    })
}

struct Look<'c> {
    computes: &'c Computes,
    /// Parameters, where the head of a program can say that one is the caller's variable itself.
    references: Vec<&'c Var>,
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
            Op::Declare(declare) => {
                match declare.sizes.is_empty() {
                    true => self.has(ComputeFeature::Declare, RunTimeValue::Declaration, at)?,
                    false => self.has(ComputeFeature::Array, RunTimeValue::Array, at)?,
                }
                self.variable(&declare.var, at)?;
                declare.initial.iter().flatten().try_for_each(|value| self.expr(value, at))
            }
            Op::Leave => self.has(ComputeFeature::Leave, RunTimeFlow::LoopLeft, at),
            Op::NextTurn => self.has(ComputeFeature::NextTurn, RunTimeFlow::LoopNextTurn, at),
            Op::Goto(_) => self.has(ComputeFeature::Jump, RunTimeFlow::Jump, at),
            Op::MessageOf(pieces) => {
                self.has(ComputeFeature::Values, RunTimeWord::MessageValues, at)?;
                self.pieces(pieces, at)
            }
            Op::Output(output) => {
                self.has(ComputeFeature::Output, RunTimeWord::DeviceOutput, at)?;
                if let Output::Line(pieces) = &**output { self.pieces(pieces, at) } else { Ok(()) }
            }
            Op::Alarm(alarm) => {
                self.has(ComputeFeature::Alarm, RunTimeWord::Alarm, at)?;
                alarm.number.iter().try_for_each(|number| self.expr(number, at))
            }
            Op::Assign(to, value) => {
                match to {
                    Target::Var(var) => self.variable(var, at)?,
                    Target::Element(element) => self.element(element, at)?,
                }
                self.expr(value, at)
            }
            Op::Control(control) => self.control(control, stmt, loops),
            Op::Call(call) => {
                if (!call.arguments.is_empty() || !call.shared) && !self.computes.arguments {
                    return Err(refuse(RunTimeFlow::CallOwnVariables, at));
                }
                let own = !call.arguments.is_empty() || !call.shared;
                if own && call.times > 1 && !self.computes.arguments_again {
                    return Err(refuse(RunTimeFlow::CallOwnAgain, at));
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
            true if stmt.skip.is_some() => Err(refuse(RunTimeFlow::LoopSkipped, at)),
            true => Ok(loops + 1),
            false => Err(refuse(RunTimeFlow::LoopDepth, at)),
        };
        if self.computes.has(ComputeFeature::CallOf)
            && let Some(call) = computed_call(control)
        {
            return call.number.into_iter().chain(call.times).try_for_each(|value| self.expr(value, at));
        }
        if self.computes.says_number(control)
            && let Some(code) = computed_code(control)
        {
            self.expr(code.number, at)?;
            // What each of them says is of one form.
            let first = code.codes.first().filter(|(_, op)| matches!(op, Op::Assign(..) | Op::SetData(_)));
            return first.map_or(Ok(()), |(_, op)| self.stmt(&Stmt::new(at, (*op).clone()), loops));
        }
        match control {
            Control::While { condition, body } => {
                self.expr(condition, at)?;
                self.body(body, deeper()?)
            }
            Control::Loop { body } if !ends(body) => Err(refuse(RunTimeFlow::LoopEndless, at)),
            Control::Loop { body } => {
                self.has(ComputeFeature::Endless, RunTimeFlow::LoopWithoutCondition, at)?;
                self.body(body, deeper()?)
            }
            Control::Until { condition, body } => {
                self.has(ComputeFeature::Until, RunTimeFlow::LoopTestedAfter, at)?;
                self.body(body, deeper()?)?;
                self.expr(condition, at)
            }
            Control::If { condition, then, otherwise } => {
                self.expr(condition, at)?;
                if self.computes.blocks {
                    if stmt.skip.is_some() {
                        return Err(refuse(RunTimeFlow::DecisionSkipped, at));
                    }
                    return control.bodies().try_for_each(|body| self.body(body, loops));
                }
                match &otherwise[..] {
                    [] if self.computes.decides(then) => self.body(then, loops),
                    _ => Err(refuse(RunTimeFlow::DecisionStatements, at)),
                }
            }
            Control::Repeat { times, body } if times.literal().is_some() => self.body(body, loops),
            Control::Repeat { times, body } => {
                self.has(ComputeFeature::Times, RunTimeFlow::LoopComputedTimes, at)?;
                self.expr(counted(times), at)?;
                self.body(body, deeper()?)
            }
            Control::For { variable, from, to, step, body } => {
                self.has(ComputeFeature::Count, RunTimeFlow::LoopCounts, at)?;
                self.variable(variable, at)?;
                [from, to, step].into_iter().try_for_each(|value| self.expr(value, at))?;
                self.body(body, deeper()?)
            }
        }
    }

    fn has(&self, statement: ComputeFeature, what: impl Into<RunTime>, at: Span) -> Result<(), Diagnostic> {
        if self.computes.has(statement) { Ok(()) } else { Err(refuse(what, at)) }
    }

    fn element(&self, element: &Element, at: Span) -> Result<(), Diagnostic> {
        match &element.of {
            Many::Array { var, .. } => {
                self.has(ComputeFeature::Array, RunTimeValue::Array, at)?;
                self.variable(var, at)?;
            }
            Many::Numbered(numbers) => {
                self.has(ComputeFeature::Numbered, RunTimeValue::ComputedNumber, at)?;
                if !numbers.iter().all(|range| self.computes.says_all(range)) {
                    return Err(refuse(RunTimeValue::ComputedNumberOfOthers, at));
                }
            }
        }
        element.at.iter().try_for_each(|index| self.expr(index, at))
    }

    fn variable(&self, var: &Var, at: Span) -> Result<(), Diagnostic> {
        match var {
            _ if self.computes.says(var) || self.references.contains(&var) => Ok(()),
            Var::System(asked) => Err(refuse(RunTimeValue::AskedVariable { asked: asked.clone() }, at)),
            Var::Local(name) | Var::Common(name) | Var::Retentive(name) => {
                Err(refuse(RunTimeValue::Variable { name: (**name).into() }, at))
            }
        }
    }

    fn pieces(&self, pieces: &[Piece], at: Span) -> Result<(), Diagnostic> {
        pieces.iter().try_for_each(|piece| match piece {
            Piece::Text(_) => Ok(()),
            Piece::Value { value, .. } => self.expr(value, at),
        })
    }

    fn expr(&self, expr: &Expr, at: Span) -> Result<(), Diagnostic> {
        let Expr::Node(node) = expr else { return Ok(()) };
        match &**node {
            _ if self.computes.values.contains(expr) => Ok(()),
            Node::Var(var) => self.variable(var, at),
            Node::Vacant if !self.computes.vacant => Err(refuse(RunTimeValue::NoValue, at)),
            Node::Vacant => Ok(()),
            Node::Element(element) => self.element(element, at),
            Node::Unary(Unary::Negate, a) => self.expr(a, at),
            Node::Unary(Unary::Not, a) if self.computes.opposite => self.expr(a, at),
            Node::Unary(Unary::Not, _) => Err(refuse(RunTimeValue::Opposite, at)),
            Node::Binary(Binary::NotEqual, Expr::Node(a), Expr::Node(b))
                if self.computes.exists && matches!(**b, Node::Vacant) =>
            {
                match &**a {
                    Node::Var(var @ Var::Local(name)) if self.computes.is_name(name, false) => {
                        self.variable(var, at)
                    }
                    Node::Var(var @ Var::Common(name)) if self.computes.is_name(name, true) => {
                        self.variable(var, at)
                    }
                    _ => Err(refuse(RunTimeValue::NamelessHasValue, at)),
                }
            }
            Node::Binary(operator, a, b) => {
                if !self.computes.operators.contains(operator) {
                    return Err(refuse(RunTimeValue::Operator { operator: *operator }, at));
                }
                self.expr(a, at)?;
                self.expr(b, at)
            }
            Node::Call(function, arguments) => {
                // What rounds to digits does so for a word, whose own rounding that may be.
                let own =
                    *function == Function::RoundTo || *function == Function::NearRatio && self.computes.near;
                if !own && !self.computes.functions.contains(function) {
                    return Err(refuse(RunTimeValue::Function { function: *function }, at));
                }
                arguments.iter().try_for_each(|argument| self.expr(argument, at))
            }
        }
    }
}
