//! The new names put into a program, as `names` has them.

use std::collections::BTreeSet;

use crate::values::variables::expressions;
use crate::values::variables::inventory::{leave_out_results, number_of};
use crate::values::variables::names::{Map, Plan};
use ncc_ir::computed::computes::{ComputeFeature, Computes, Handed};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::{Binary, Element, Expr, Many, Node, Numbers, Scope, Target, Var};
use ncc_ir::program::{Control, Op, Program, Stmt, Text};
use ncc_ir::run_time::RunTimeValue;
use ncc_ir::source::Span;

/// Puts the target's variables in. Those of the main procedure, and those that all procedures see, come back: the
/// source's and the target's.
pub(super) fn rename_variables(
    program: &mut Program,
    from: &Computes,
    computes: &Computes,
    diags: &mut Vec<Diagnostic>,
) -> Vec<(Var, Var)> {
    leave_out_results(program, from, computes);
    let mut plan = Plan::new(program, from, computes);
    if let Err(refused) = plan.make(program) {
        diags.push(refused);
        return Vec::new();
    }
    let own: Vec<bool> = (0..program.procedures.len()).map(|at| plan.has_own(at)).collect();
    let names: Vec<Text> = program.procedures.iter().map(|p| p.name.clone()).collect();
    for (at, procedure) in program.procedures.iter_mut().enumerate() {
        let reported = procedure.parameters.iter().map(|p| p.name().as_ref().into()).collect();
        let mut rename = Rename { plan: &plan, locals: plan.locals_of(at), reported, refused: None };
        rename.body(&mut procedure.body);
        if let Some(refused) = rename.refused {
            diags.push(refused);
            return Vec::new();
        }
        if computes.shares && !from.shares {
            plain_calls(&mut procedure.body, &names, &own);
        }
        plan.head(at, procedure);
    }
    plan.tell(program, diags);
    let mut all: Vec<(Var, Var)> = Vec::new();
    if computes.handed == Handed::Places {
        // A call gives them one after the other, and the head puts them where they are.
        let places = (1..).map(|place: u32| Var::Local(place.to_string().into()));
        all.extend(plan.parameters[0].iter().cloned().zip(places));
    }
    let others = plan.common.iter().chain(plan.locals_of(0));
    let given = |old: &Var| computes.handed == Handed::Places && plan.parameters[0].contains(old);
    all.extend(others.filter(|(old, _)| !given(old)).map(|(old, new)| (old.clone(), new.clone())));
    all
}

/// Puts the new names into a body.
pub(super) struct Rename<'p, 'c> {
    pub(super) plan: &'p Plan<'c>,
    pub(super) locals: &'p Map,
    /// Names that stand beside where they were first given a value.
    pub(super) reported: BTreeSet<Text>,
    pub(super) refused: Option<Diagnostic>,
}

impl Rename<'_, '_> {
    pub(super) fn body(&mut self, body: &mut Vec<Stmt>) {
        expressions(body, &mut |stmt, value| self.expr(value, stmt.span));
        self.targets(body);
    }

    fn new_of(&self, var: &Var) -> Option<&Var> {
        match var {
            Var::Local(_) => self.locals.get(var).or_else(|| self.plan.common.get(var)),
            Var::Common(_) | Var::Retentive(_) => self.plan.common.get(var),
            Var::System(_) => None,
        }
    }

    fn targets(&mut self, body: &mut Vec<Stmt>) {
        let mut out: Vec<Stmt> = Vec::with_capacity(body.len());
        let mut parted = false;
        for mut stmt in std::mem::take(body) {
            if std::mem::take(&mut parted) {
                stmt.joined = false;
            }
            let at = stmt.span;
            if self.declared(&mut stmt, &mut out) {
                parted = true;
                continue;
            }
            match &mut stmt.op {
                Op::Assign(to, _) => {
                    let name = match to {
                        Target::Var(var) => {
                            let name = var.clone();
                            self.var(var);
                            (name != *var).then_some(name)
                        }
                        Target::Element(element) => {
                            let element = element.as_mut();
                            if let Some(var) = self.element(element, at) {
                                *to = Target::Var(var);
                            }
                            None
                        }
                    };
                    parted = name.is_some_and(|name| self.beside(&name, &mut stmt));
                }
                Op::Control(control) => {
                    if let Control::For { variable, .. } = &mut **control {
                        self.var(variable);
                    }
                    control.bodies_mut().for_each(|body| self.targets(body));
                }
                _ => {}
            }
            out.push(stmt);
        }
        *body = out;
    }

    /// A variable that is made known: as in the target, or as what it is given, one value after the other.
    fn declared(&mut self, stmt: &mut Stmt, out: &mut Vec<Stmt>) -> bool {
        let Op::Declare(declare) = &mut stmt.op else { return false };
        let computes = self.plan.computes;
        let array = !declare.sizes.is_empty();
        let new = self.new_of(&declare.var).cloned().unwrap_or_else(|| declare.var.clone());
        let stays =
            if array { computes.has(ComputeFeature::Array) } else { computes.has(ComputeFeature::Declare) };
        let named = number_of(&new, computes).is_none();
        if stays && named {
            declare.var = new;
            return false;
        }
        let old = declare.var.clone();
        let count = declare.sizes.iter().product::<u32>().max(1);
        if !(named && array) {
            let first = number_of(&new, computes).unwrap_or_default();
            for n in 0..count {
                let to = if array { numbered(&new, first + n, computes) } else { new.clone() };
                let value = declare.initial.get(n as usize).cloned().flatten().unwrap_or(Expr::int(0));
                let mut one = Stmt::new(stmt.span, Op::Assign(to.into(), value));
                (one.number, one.skip) = (stmt.number.filter(|_| n == 0), stmt.skip);
                if n == 0 {
                    self.beside(&old, &mut one);
                }
                if n + 1 == count
                    && let Some(comment) = stmt.comment.take()
                {
                    one.comment = Some(match one.comment {
                        Some(name) => Box::new(format!("{name}, {comment}").into()),
                        None => comment,
                    });
                }
                out.push(one);
            }
            return true;
        }
        false
    }

    /// Puts the name that a variable had beside where it is first given a value, if it is a number now.
    fn beside(&mut self, old: &Var, stmt: &mut Stmt) -> bool {
        let name = old.name();
        if number_of(old, self.plan.from).is_some() || !self.reported.insert(name.as_ref().into()) {
            return false;
        }
        let is_number = self.new_of(old).is_some_and(|new| number_of(new, self.plan.computes).is_some());
        if !is_number {
            return false;
        }
        let text = match stmt.comment.take() {
            Some(comment) => format!("{name}, {comment}"),
            None => name.into_owned(),
        };
        stmt.comment = Some(Box::new(text.into()));
        true
    }

    fn var(&self, var: &mut Var) {
        if let Some(new) = self.new_of(var) {
            *var = new.clone();
        }
    }

    /// An element: the variable that it is, if its place is known and it is no array's in the target.
    fn element(&mut self, element: &mut Element, at: Span) -> Option<Var> {
        let computes = self.plan.computes;
        match &mut element.of {
            Many::Array { var, sizes } => {
                let new = self.new_of(var).cloned().unwrap_or_else(|| var.clone());
                let Some(first) = number_of(&new, computes) else {
                    *var = new;
                    return None;
                };
                let whole =
                    |e: &Expr| e.literal().and_then(|n| n.whole_number()).and_then(|n| u32::try_from(n).ok());
                let known: Option<Vec<u32>> = element.at.iter().map(whole).collect();
                if let Some(known) = known {
                    if known.iter().zip(&**sizes).any(|(at, size)| at >= size) {
                        self.refuse(RunTimeValue::NoSuchElement, at);
                        return None;
                    }
                    let place = known.iter().zip(&**sizes).fold(0, |place, (at, size)| place * size + at);
                    return Some(numbered(&new, first + place, computes));
                }
                let count: u32 = sizes.iter().product();
                let place = std::mem::take(&mut element.at).into_iter().zip(&**sizes).fold(
                    None,
                    |place, (at, size)| {
                        Some(match place {
                            None => at,
                            Some(place) => {
                                let row = Expr::binary(Binary::Multiply, place, Expr::int(i64::from(*size)));
                                Expr::binary(Binary::Add, row, at)
                            }
                        })
                    },
                );
                let base = Expr::int(i64::from(first));
                element.at = vec![Expr::binary(Binary::Add, base, place.unwrap_or(Expr::int(0)))];
                let scope = match new {
                    Var::Local(_) => Scope::Local,
                    Var::Retentive(_) => Scope::Retentive,
                    Var::Common(_) | Var::System(_) => Scope::Common,
                };
                let row =
                    Numbers { scope, prefix: computes.prefix.clone(), from: first, to: first + count - 1 };
                element.of = Many::Numbered(Box::new([row]));
            }
            Many::Numbered(rows) => {
                let mut new = Vec::new();
                let clip = |scope: Scope, ranges: &[[u32; 2]], from: u32, to: u32, out: &mut Vec<Numbers>| {
                    for [least, most] in ranges {
                        let (from, to) = (from.max(*least), to.min(*most));
                        if from <= to {
                            out.push(Numbers { scope, prefix: computes.prefix.clone(), from, to });
                        }
                    }
                };
                for row in rows.iter() {
                    let (from, to) = (row.from + self.plan.further, row.to + self.plan.further);
                    if row.scope == Scope::Local && !computes.local.is_empty() {
                        clip(Scope::Local, &computes.local, row.from, row.to, &mut new);
                    } else {
                        clip(Scope::Common, &computes.common, from, to, &mut new);
                        if row.scope == Scope::Retentive {
                            clip(Scope::Retentive, &computes.retentive, from, to, &mut new);
                        }
                    }
                }
                *rows = new.into();
                if self.plan.further > 0 {
                    for index in &mut element.at {
                        let own = std::mem::replace(index, Expr::int(0));
                        let by = Expr::int(i64::from(self.plan.further));
                        *index = Expr::binary(Binary::Add, own, by);
                    }
                }
            }
        }
        None
    }

    fn refuse(&mut self, what: RunTimeValue, at: Span) {
        self.refused.get_or_insert(Diagnostic::new(Fault::computes(what), at));
    }

    fn expr(&mut self, e: &mut Expr, at: Span) {
        e.parts_mut().for_each(|part| self.expr(part, at));
        let Expr::Node(node) = e else { return };
        match &mut **node {
            Node::Var(var) => self.var(var),
            Node::Element(element) => {
                if let Some(var) = self.element(element, at) {
                    **node = Node::Var(var);
                }
            }
            Node::Vacant | Node::Unary(..) | Node::Binary(..) | Node::Call(..) => {}
        }
    }
}

/// Another number for as long as a variable lives.
fn numbered(like: &Var, n: u32, computes: &Computes) -> Var {
    let name = format!("{}{n}", computes.prefix).into();
    match like {
        Var::Local(_) => Var::Local(name),
        Var::Retentive(_) => Var::Retentive(name),
        Var::Common(_) | Var::System(_) => Var::Common(name),
    }
}

/// A call of what has no variables of its own is a plain call, where the target has such.
pub(super) fn plain_calls(body: &mut [Stmt], names: &[Text], own: &[bool]) {
    for stmt in body {
        match &mut stmt.op {
            Op::Call(call) if call.arguments.is_empty() && !call.shared => {
                let called = names.iter().zip(own).skip(1).find(|(name, _)| **name == call.name);
                call.shared = called.is_some_and(|(_, own)| !own);
            }
            Op::Control(control) => {
                control.bodies_mut().for_each(|body| plain_calls(body, names, own));
            }
            _ => {}
        }
    }
}
