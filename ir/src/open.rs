//! Variables that a program reads and may not have set before: what they hold comes from elsewhere.
//!
//! In the order of the text, so that a variable that is set further down, or on another way, is among them. Not here:
//! what they are given.

use std::collections::HashSet;
use std::convert::Infallible;

use crate::arguments;
use crate::expr::{Expr, Node, Target, Var};
use crate::program::{Control, Op, Program, Stmt};
use crate::source::Span;
use crate::system::System;

/// Local variables of the main procedure, and those that all procedures see, each with the first place that reads it.
pub fn open_variables(program: &Program) -> Vec<(Var, Span)> {
    looked_through(program).open
}

/// Of the [`open_variables`], those that all procedures see, which outlive a run of the program; each with the first
/// place that reads it, and whether the program sets it too, so that its next run finds what this one has left.
pub fn outliving_variables(program: &Program) -> Vec<(Var, Span, bool)> {
    let Look { open, set, .. } = looked_through(program);
    let outliving = open.into_iter().filter(|(var, _)| !matches!(var, Var::Local(_)));
    outliving.map(|(var, at)| (var.clone(), at, set.contains(&var))).collect()
}

fn looked_through(program: &Program) -> Look {
    let mut look = Look::default();
    // What a call gives is set before it is read.
    let parameters = program.procedures.iter().flat_map(|procedure| &procedure.parameters);
    parameters.for_each(|parameter| look.sets(parameter));
    for (at, procedure) in program.procedures.iter().enumerate() {
        look.main = at == 0;
        look.body(&procedure.body);
    }
    look
}

/// What a program asks that a machine's set-up answers ([`System::is_of_the_machine`]), each with the first place that
/// asks for it.
pub fn asked_of_the_machine(program: &Program) -> Vec<(System, Span)> {
    let mut found: Vec<(System, Span)> = Vec::new();
    for procedure in &program.procedures {
        expressions(&procedure.body, &mut |e, at| asks(e, at, &mut found));
    }
    found
}

fn asks(e: &Expr, at: Span, found: &mut Vec<(System, Span)>) {
    if let Expr::Node(node) = e
        && let Node::Var(Var::System(system)) = &**node
        && system.is_of_the_machine()
        && !found.iter().any(|(known, _)| known == system)
    {
        found.push((system.clone(), at));
    }
    e.parts().for_each(|part| asks(part, at, found));
}

/// The literals of a program's expressions and decisions, as a control counts them.
pub fn literals(program: &Program) -> Vec<f64> {
    let mut found = Vec::new();
    let mut each = |e: &Expr, _: Span| numbers(e, &mut found);
    for procedure in &program.procedures {
        expressions(&procedure.body, &mut each);
    }
    found.sort_by(f64::total_cmp);
    found.dedup();
    found
}

fn numbers(e: &Expr, found: &mut Vec<f64>) {
    if let Some(n) = e.literal() {
        found.push(n.mantissa as f64 / 10_f64.powi(i32::from(n.scale)));
    }
    e.parts().for_each(|part| numbers(part, found));
}

fn expressions(body: &[Stmt], seen: &mut dyn FnMut(&Expr, Span)) {
    for stmt in body {
        of_stmt(stmt, &mut |e| seen(e, stmt.span));
        if let Op::Control(control) = &stmt.op {
            control.bodies().for_each(|body| expressions(body, seen));
        }
    }
}

/// The expressions that a statement itself computes.
fn of_stmt(stmt: &Stmt, seen: &mut dyn FnMut(&Expr)) {
    if let Op::Assign(to, value) = &stmt.op {
        seen(value);
        if let Target::Element(element) = to {
            element.at.iter().for_each(seen);
        }
    } else if let Op::Call(call) = &stmt.op {
        call.arguments.iter().for_each(seen);
    } else if let Op::Declare(declare) = &stmt.op {
        declare.initial.iter().flatten().for_each(seen);
    } else if let Op::Control(control) = &stmt.op {
        match &**control {
            Control::If { condition, .. }
            | Control::While { condition, .. }
            | Control::Until { condition, .. } => seen(condition),
            Control::For { from, to, step, .. } => [from, to, step].into_iter().for_each(seen),
            Control::Repeat { times, .. } => seen(times),
            Control::Loop { .. } => {}
        }
    } else if arguments::computed(&stmt.op) {
        let each = arguments::each(&mut stmt.op.clone(), &mut |argument, _| {
            if let Some(e @ Expr::Node(_)) = argument.expr() {
                seen(e);
            }
            Ok::<(), Infallible>(())
        });
        each.unwrap_or_else(|never| match never {});
    }
}

#[derive(Default)]
struct Look {
    main: bool,
    set: HashSet<Var>,
    open: Vec<(Var, Span)>,
}

impl Look {
    fn body(&mut self, body: &[Stmt]) {
        for stmt in body {
            of_stmt(stmt, &mut |e| self.reads(e, stmt.span));
            if let Op::Assign(Target::Var(var), _) = &stmt.op {
                self.sets(var);
            } else if let Op::Declare(declare) = &stmt.op {
                self.sets(&declare.var);
            } else if let Op::Control(control) = &stmt.op {
                if let Control::For { variable, .. } = &**control {
                    self.sets(variable);
                }
                control.bodies().for_each(|body| self.body(body));
            }
        }
    }

    fn concerns(&self, var: &Var) -> bool {
        match var {
            Var::Local(_) => self.main,
            Var::Common(_) | Var::Retentive(_) => true,
            Var::System(_) => false,
        }
    }

    fn sets(&mut self, var: &Var) {
        if self.concerns(var) {
            self.set.insert(var.clone());
        }
    }

    fn reads(&mut self, e: &Expr, at: Span) {
        if let Expr::Node(node) = e
            && let Node::Var(var) = &**node
            && self.concerns(var)
            && !self.set.contains(var)
            && !self.open.iter().any(|(known, _)| known == var)
        {
            self.open.push((var.clone(), at));
        }
        e.parts().for_each(|part| self.reads(part, at));
    }
}
