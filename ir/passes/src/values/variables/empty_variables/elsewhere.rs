//! Procedures that programs call which are not in the text: what they begin with.

use std::collections::BTreeMap;
use std::convert::Infallible;

use super::may::{Known, May, is_nothing, may};
use super::ways::{Facts, Ways, place};
use crate::values::variables::defaults;
use ncc_ir::computed::free_variables::free_variables;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Num;
use ncc_ir::expr::{Binary, Expr, Many, Node, Scope, Target, Var};
use ncc_ir::program::arguments;
use ncc_ir::program::{Control, Op, Procedure, Program, Stmt, Text};
use ncc_ir::run_time::RunTimeValue;
use ncc_ir::source::Span;

/// What a procedure begins with: its arguments have values or not.
pub(super) fn begins(procedure: &Procedure) -> Known {
    let by_itself = Program { procedures: vec![procedure.clone()], ..Program::default() };
    let open = free_variables(&by_itself).into_iter().map(|(var, _)| var);
    let open = open.filter(|var| matches!(var, Var::Local(_)));
    let may = |var: &Var| if procedure.parameters.contains(var) { May::Number } else { May::Either };
    Known { vars: open.map(|var| (Text::from(&*var.name()), may(&var))).collect(), lost: false }
}

/// Whether a macro's call gives an argument, as the macro itself asks.
#[derive(Clone, Debug, PartialEq)]
pub struct Question {
    /// The argument, or what it was put into.
    pub name: Text,
    /// Where.
    pub at: Span,
    /// What it is given there if it is not.
    pub default: Option<Num>,
}

/// The questions of a main procedure with parameters whether its call gives them, in the order of the text.
pub fn questions(program: &Program) -> Vec<Question> {
    let own = free_variables(program).into_iter().filter(|(var, _)| matches!(var, Var::Local(_)));
    let vars = own.map(|(var, _)| (Text::from(&*var.name()), May::Either)).collect();
    asked_in(program, BTreeMap::from([(0, Known { vars, lost: false })]))
}

fn asked_in(program: &Program, entries: BTreeMap<usize, Known>) -> Vec<Question> {
    let ways = Ways::follow_paths(&program.procedures, entries);
    let mut found = Vec::new();
    program.procedures.iter().for_each(|procedure| asks(&procedure.body, &ways.facts, &mut found));
    found
}

/// Parameters that the main procedure has for its arguments, each of which is given: questions whether one is are
/// answered by that, which is reported where they stand ([`questions`]).
///
/// # Errors
/// The program asks whether something has a value that is no parameter.
pub(super) fn parameters(program: &Program, entries: &BTreeMap<usize, Known>) -> Result<(), Diagnostic> {
    let Some(main) = program.procedures.first().filter(|main| !main.parameters.is_empty()) else {
        return Ok(());
    };
    let is_parameter = |name: &str| main.parameters.iter().any(|own| *own.name() == *name);
    let asked = asked_in(program, entries.clone());
    if let Some(other) = asked.iter().find(|asked| !is_parameter(&asked.name)) {
        let what = RunTimeValue::ArgumentGiven { name: (*other.name).into() };
        return Err(Diagnostic::new(Fault::computes(what), other.at));
    }
    by_number(&main.body)
}

/// Whether a variable has a computed number, which may be that of an argument.
fn by_number(body: &[Stmt]) -> Result<(), Diagnostic> {
    let local =
        |of: &Many| matches!(of, Many::Numbered(rows) if rows.iter().any(|row| row.scope == Scope::Local));
    for stmt in body {
        let mut found = matches!(&stmt.op, Op::Assign(Target::Element(element), _) if local(&element.of));
        let is = |node: &Node| matches!(node, Node::Element(element) if local(&element.of));
        each(&stmt.op, &mut |e| found |= e.has(&is));
        if found {
            return Err(Diagnostic::new(Fault::computes(RunTimeValue::ComputedNumberOfArguments), stmt.span));
        }
        if let Op::Control(control) = &stmt.op {
            control.bodies().try_for_each(|body| by_number(body))?;
        }
    }
    Ok(())
}

/// What is compared with nothing, and may be it or not.
fn asks(body: &[Stmt], facts: &Facts, found: &mut Vec<Question>) {
    for (at, stmt) in body.iter().enumerate() {
        let known = facts.get(&place(stmt)).into_iter();
        let known: Vec<&Known> = match &stmt.op {
            Op::Control(control) => known.chain(facts.get(&place(&**control))).collect(),
            _ => known.collect(),
        };
        let mut names = Vec::new();
        each(&stmt.op, &mut |e| asked(e, &known, &mut names));
        names.dedup();
        let default = defaults::given_at(&body[at..]);
        found.extend(names.into_iter().map(|name| {
            let default = default.filter(|(own, _)| **own == name).map(|(_, value)| value);
            Question { name, at: stmt.span, default }
        }));
        if let Op::Control(control) = &stmt.op {
            control.bodies().for_each(|body| asks(body, facts, found));
        }
    }
}

/// The names of what is compared so.
fn asked(e: &Expr, known: &[&Known], found: &mut Vec<Text>) {
    let Expr::Node(node) = e else { return };
    if let Node::Binary(Binary::Equal | Binary::NotEqual, a, b) = &**node {
        let other = if is_nothing(a) { b } else { a };
        let either = known.iter().any(|known| may(other, known) == May::Either);
        if (is_nothing(a) || is_nothing(b)) && either {
            found.push(name(other));
        }
    }
    e.parts().for_each(|part| asked(part, known, found));
}

fn name(e: &Expr) -> Text {
    match e {
        Expr::Node(node) => match &**node {
            Node::Var(var) => var.name().as_ref().into(),
            _ => e.parts().next().map(name).unwrap_or_default(),
        },
        _ => Text::default(),
    }
}

/// Shows what a statement computes by itself.
fn each(op: &Op, seen: &mut dyn FnMut(&Expr)) {
    match op {
        Op::Assign(_, value) => seen(value),
        Op::Call(call) => call.arguments.iter().for_each(seen),
        Op::Control(control) => match &**control {
            Control::If { condition: value, .. }
            | Control::While { condition: value, .. }
            | Control::Until { condition: value, .. }
            | Control::Repeat { times: value, .. } => seen(value),
            Control::For { from, to, step, .. } => [from, to, step].into_iter().for_each(seen),
            Control::Loop { .. } => {}
        },
        op if arguments::computed(op) => {
            let all = arguments::each(&mut op.clone(), &mut |argument, _| {
                if let Some(e) = argument.expr() {
                    seen(e);
                }
                Ok::<(), Infallible>(())
            });
            all.unwrap_or_else(|never| match never {});
        }
        _ => {}
    }
}
