//! Variables that a program reads and may not have set before: what they hold comes from elsewhere.
//!
//! In the order of the text, so that a variable that is set further down is among them. One that all procedures see is so
//! too where it is set on one way alone; the body of a loop is taken to be executed. Not here: what they are given.

use std::collections::HashMap;
use std::convert::Infallible;

use crate::expr::system::System;
use crate::expr::{Expr, Node, Target, Var};
use crate::program::arguments;
use crate::program::{Control, Op, Program, Stmt, Text};
use crate::source::Span;

/// Local variables of the main procedure, and those that all procedures see, each with the first place that reads it.
pub fn free_variables(program: &Program) -> Vec<(Var, Span)> {
    looked_through(program).open
}

/// Of the [`free_variables`], those that all procedures see, which outlive a run of the program; each with the first
/// place that reads it, and whether the program sets it too, so that its next run finds what this one has left.
pub fn outliving_variables(program: &Program) -> Vec<(Var, Span, bool)> {
    let Look { open, set, .. } = looked_through(program);
    let outliving = open.into_iter().filter(|(var, _)| !matches!(var, Var::Local(_)));
    outliving.map(|(var, at)| (var.clone(), at, set.contains_key(&var))).collect()
}

fn looked_through(program: &Program) -> Look {
    let mut look = Look::default();
    // What a call gives is set before it is read.
    let parameters = program.procedures.iter().flat_map(|procedure| &procedure.parameters);
    parameters.for_each(|parameter| look.sets(parameter));
    for (at, procedure) in program.procedures.iter().enumerate() {
        look.main = at == 0;
        look.surely = Some(Set::first(look.set.len()));
        look.jumps.clear();
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

/// The literals of a program's expressions and branches, as a control counts them.
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

/// Some of the variables that a program sets, a bit each by the order in which they are met.
#[derive(Clone, Default)]
struct Set(Vec<u64>);

impl Set {
    /// The first ones.
    fn first(count: usize) -> Set {
        let mut set = Set::default();
        (0..count).for_each(|at| set.add(at));
        set
    }

    fn add(&mut self, at: usize) {
        if self.0.len() <= at / 64 {
            self.0.resize(at / 64 + 1, 0);
        }
        self.0[at / 64] |= 1 << (at % 64);
    }

    fn has(&self, at: usize) -> bool {
        self.0.get(at / 64).is_some_and(|bits| bits >> (at % 64) & 1 == 1)
    }

    /// Keeps what is in the other too.
    fn retain(&mut self, other: &Set) {
        self.0.truncate(other.0.len());
        self.0.iter_mut().zip(&other.0).for_each(|(own, other)| *own &= other);
    }
}

#[derive(Default)]
struct Look {
    main: bool,
    /// What is set anywhere before, in this order.
    set: HashMap<Var, usize>,
    /// What is set on every path to here; none where no way leads.
    surely: Option<Set>,
    /// The same where jumps to a label further down leave.
    jumps: HashMap<Text, Set>,
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
                if let Control::If { then, otherwise, .. } = &**control {
                    let before = self.surely.clone();
                    self.body(then);
                    let through = std::mem::replace(&mut self.surely, before);
                    self.body(otherwise);
                    self.meets(through);
                } else {
                    control.bodies().for_each(|body| self.body(body));
                }
            } else if let Op::Goto(label) = &stmt.op {
                let Some(left) = self.surely.take() else { continue };
                match self.jumps.get_mut(label) {
                    Some(others) => others.retain(&left),
                    None => drop(self.jumps.insert(label.clone(), left)),
                }
            } else if let Op::Label(label) = &stmt.op {
                let jumped = self.jumps.remove(label);
                self.meets(jumped);
                // A jump from further down leads here.
                self.surely.get_or_insert_with(|| Set::first(self.set.len()));
            } else if matches!(
                stmt.op,
                Op::Leave | Op::NextTurn | Op::Return | Op::ProgramEnd | Op::BeginAgain
            ) {
                self.surely = None;
            }
        }
    }

    /// Another way leads here.
    fn meets(&mut self, other: Option<Set>) {
        match (&mut self.surely, other) {
            (Some(own), Some(other)) => own.retain(&other),
            (own @ None, other) => *own = other,
            (Some(_), None) => {}
        }
    }

    fn is_set(&self, var: &Var) -> bool {
        let set = self.set.get(var);
        match (var, &self.surely) {
            (Var::Local(_), _) => set.is_some(),
            (_, None) => true,
            (_, Some(surely)) => set.is_some_and(|at| surely.has(*at)),
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
            let next = self.set.len();
            let at = *self.set.entry(var.clone()).or_insert(next);
            if let Some(surely) = &mut self.surely {
                surely.add(at);
            }
        }
    }

    fn reads(&mut self, e: &Expr, at: Span) {
        if let Expr::Node(node) = e
            && let Node::Var(var) = &**node
            && self.concerns(var)
            && !self.is_set(var)
            && !self.open.iter().any(|(known, _)| known == var)
        {
            self.open.push((var.clone(), at));
        }
        e.parts().for_each(|part| self.reads(part, at));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expr::num::Num;
    use crate::expr::num::Unit;

    fn common(name: &str) -> Var {
        Var::Common(name.into())
    }

    fn sets(name: &str) -> Stmt {
        let one = Expr::Num(Num::from_nanos(1_000_000_000, 9, Unit::One));
        Stmt::new(Span::default(), Op::Assign(Target::Var(common(name)), one))
    }

    fn reads(name: &str) -> Stmt {
        let value = Expr::Node(Box::new(Node::Var(common(name))));
        Stmt::new(Span::default(), Op::Assign(Target::Var(common("result")), value))
    }

    fn decides(then: Vec<Stmt>, otherwise: Vec<Stmt>) -> Stmt {
        let condition = Expr::Num(Num::from_nanos(0, 9, Unit::One));
        Stmt::new(Span::default(), Op::Control(Box::new(Control::If { condition, then, otherwise })))
    }

    fn goes(label: &str) -> Stmt {
        Stmt::new(Span::default(), Op::Goto(label.into()))
    }

    fn label(label: &str) -> Stmt {
        Stmt::new(Span::default(), Op::Label(label.into()))
    }

    #[track_caller]
    fn open(body: Vec<Stmt>, names: &[&str]) {
        let program = Program {
            procedures: vec![crate::program::Procedure { body, ..Default::default() }],
            ..Program::default()
        };
        let found: Vec<String> =
            free_variables(&program).iter().map(|(var, _)| var.name().into_owned()).collect();
        assert_eq!(found, names);
    }

    #[test]
    fn what_one_way_alone_sets_is_open() {
        open(vec![decides(vec![sets("a")], vec![]), reads("a")], &["a"]);
        open(vec![decides(vec![sets("a")], vec![sets("a")]), reads("a")], &[]);
        open(vec![decides(vec![goes("L")], vec![]), sets("a"), label("L"), reads("a")], &["a"]);
        open(
            vec![sets("a"), decides(vec![goes("L")], vec![]), sets("b"), label("L"), reads("a"), reads("b")],
            &["b"],
        );
        // A way that ends leads nowhere.
        let end = || Stmt::new(Span::default(), Op::ProgramEnd);
        open(vec![decides(vec![end()], vec![sets("a")]), reads("a")], &[]);
        open(
            vec![decides(vec![goes("L")], vec![sets("a")]), reads("a"), end(), label("L"), reads("a")],
            &["a"],
        );
    }

    #[test]
    fn further_down_is_not_before() {
        open(vec![reads("a"), sets("a"), reads("a")], &["a"]);
        open(vec![label("L"), reads("a"), sets("a"), goes("L")], &["a"]);
        open(vec![sets("a"), label("L"), reads("a"), sets("b"), goes("L")], &[]);
    }
}
