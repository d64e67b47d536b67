//! The paths through a program, and which variables may have a value on all of them.

use std::collections::{BTreeMap, HashMap};

use super::may::{Known, May, Way, either, holds, may};
use crate::support::shared_map::SharedMap;
use ncc_ir::expr::{Expr, Many, Numbers, Scope, Target, Var};
use ncc_ir::program::{Call, Control, Op, Procedure, Stmt, Text};

/// Most calls one within another that are looked into with their caller's variables.
const DEEPEST: u32 = 10;

/// By which a statement, or the condition of a loop, is known while it does not move.
pub(super) fn place<T>(of: &T) -> usize {
    std::ptr::from_ref(of).addr()
}

/// What is known on all ways to each statement.
pub(super) type Facts = HashMap<usize, Known>;

/// The ways through a program.
pub(super) struct Ways<'p> {
    procedures: &'p [Procedure],
    pub(super) facts: Facts,
    /// What procedures with variables of their own begin with.
    pub(super) entries: BTreeMap<usize, Known>,
    /// What is known here.
    here: Way,
    /// What is known where labels of the procedure at hand are jumped to.
    labels: BTreeMap<&'p str, Known>,
    /// Where bodies that are executed again are left, and where their next turns begin.
    leaves: Vec<(Way, Way)>,
    /// Where the procedure at hand is left.
    returns: Way,
    depth: u32,
}

impl<'p> Ways<'p> {
    /// Begins where `entries` tell what procedures begin with.
    pub(super) fn follow_paths(procedures: &'p [Procedure], entries: BTreeMap<usize, Known>) -> Ways<'p> {
        let mut ways = Ways {
            procedures,
            facts: Facts::new(),
            entries,
            here: None,
            labels: BTreeMap::new(),
            leaves: Vec::new(),
            returns: None,
            depth: 0,
        };
        loop {
            let before = ways.entries.clone();
            for (at, entry) in &before {
                ways.procedure(&procedures[*at], entry.clone());
            }
            if ways.entries == before {
                return ways;
            }
        }
    }

    /// A procedure from its beginning to where it is left.
    fn procedure(&mut self, procedure: &'p Procedure, entry: Known) -> Way {
        let labels = std::mem::take(&mut self.labels);
        let leaves = std::mem::take(&mut self.leaves);
        let (here, returns) = (self.here.take(), self.returns.take());
        let result = loop {
            let before = self.labels.clone();
            self.here = Some(entry.clone());
            self.returns = None;
            self.body(&procedure.body);
            if self.labels == before {
                break either(self.here.take(), self.returns.take());
            }
        };
        (self.labels, self.leaves, self.here, self.returns) = (labels, leaves, here, returns);
        result
    }

    fn body(&mut self, body: &'p [Stmt]) {
        body.iter().for_each(|stmt| self.stmt(stmt));
    }

    /// Takes down what is known here, of a statement or of the condition of a loop.
    fn note<T>(&mut self, of: &T) {
        let Some(here) = &self.here else { return };
        let at = place(of);
        let all = self.facts.get(&at).map_or_else(|| here.clone(), |known| known.or(here));
        self.facts.insert(at, all);
    }

    pub(super) fn may(&self, e: &Expr) -> May {
        self.here.as_ref().map_or(May::Number, |here| may(e, here))
    }

    fn set(&mut self, var: &Var, to: May) {
        if let (Var::Local(name), Some(here)) = (var, &mut self.here) {
            here.vars.insert(name.clone(), to);
        }
    }

    fn stmt(&mut self, stmt: &'p Stmt) {
        if let Op::Label(name) = &stmt.op {
            let there = self.labels.get(&**name).cloned();
            self.here = either(self.here.take(), there);
        }
        self.note(stmt);
        let before = self.here.clone();
        match &stmt.op {
            Op::Assign(Target::Var(var), value) => {
                let to = self.may(value);
                self.set(var, to);
            }
            Op::Assign(Target::Element(element), _) => {
                let local = |row: &Numbers| row.scope == Scope::Local;
                let any = matches!(&element.of, Many::Numbered(rows) if rows.iter().any(local));
                if let Some(here) = self.here.as_mut().filter(|_| any) {
                    // Whichever it is.
                    here.vars =
                        here.vars.iter().map(|(name, may)| (name.clone(), may.or(May::Number))).collect();
                    here.lost = true;
                }
            }
            Op::Declare(declare) => self.set(&declare.var, May::Number),
            Op::Control(control) => self.control(control),
            Op::Goto(label) => {
                if let Some(here) = self.here.take() {
                    let all = self.labels.get(&**label).map_or_else(|| here.clone(), |there| there.or(&here));
                    self.labels.insert(label, all);
                }
            }
            Op::Return => {
                let here = self.here.take();
                self.returns = either(self.returns.take(), here);
            }
            Op::ProgramEnd | Op::BeginAgain | Op::Alarm(_) => self.here = None,
            Op::Leave | Op::NextTurn => {
                let here = self.here.take();
                if let Some((leave, next)) = self.leaves.last_mut() {
                    let there = if stmt.op == Op::Leave { leave } else { next };
                    *there = either(there.take(), here);
                }
            }
            Op::Call(call) => self.call(call),
            _ => {}
        }
        if stmt.skip.is_some() {
            self.here = either(self.here.take(), before);
        }
    }

    fn call(&mut self, call: &'p Call) {
        let found = self.procedures.iter().enumerate().skip(1).find(|(_, p)| p.name == call.name);
        let (Some((at, procedure)), Some(here)) = (found, &self.here) else { return };
        if call.shared {
            if self.depth >= DEEPEST {
                self.here = Some(Known { vars: SharedMap::default(), lost: true });
                return;
            }
            self.depth += 1;
            let (entry, again) = (here.clone(), call.times > 1);
            let mut behind = self.procedure(procedure, entry.clone());
            if again && let Some(behind) = &mut behind {
                *behind = behind.or(&entry);
                let second = self.procedure(procedure, behind.clone());
                *behind = second.map_or_else(|| behind.clone(), |second| behind.or(&second));
            }
            self.here = behind;
            self.depth -= 1;
            return;
        }
        let given = call.arguments.iter().map(|value| may(value, here));
        let given = procedure.parameters.iter().map(Var::name).zip(given);
        let vars = given.map(|(name, may)| (Text::from(&*name), may)).collect();
        let entry = Known { vars, lost: false };
        let all = self.entries.get(&at).map_or_else(|| entry.clone(), |known| known.or(&entry));
        self.entries.insert(at, all);
    }

    fn control(&mut self, control: &'p Control) {
        match control {
            Control::If { condition, then, otherwise } => {
                let here = self.here.clone();
                let holds = here.as_ref().and_then(|here| holds(condition, here));
                if holds == Some(false) {
                    self.here = None;
                }
                self.body(then);
                let behind = self.here.take();
                self.here = here.filter(|_| holds != Some(true));
                self.body(otherwise);
                self.here = either(behind, self.here.take());
            }
            Control::While { body, .. } | Control::Repeat { body, .. } => {
                let (left, _) = self.turns(body, None);
                self.note(control);
                self.here = either(self.here.take(), left);
            }
            Control::For { variable, body, .. } => {
                self.set(variable, May::Number);
                let (left, _) = self.turns(body, Some(variable));
                self.here = either(self.here.take(), left);
            }
            Control::Loop { body } => {
                let (left, _) = self.turns(body, None);
                self.here = left;
            }
            Control::Until { body, .. } => {
                let (left, end) = self.turns(body, None);
                self.here = end;
                self.note(control);
                self.here = either(self.here.take(), left);
            }
        }
    }

    /// The turns of a body. Leaves what is known at its head; what is where it is left, and where a turn is over,
    /// comes back.
    fn turns(&mut self, body: &'p [Stmt], counter: Option<&'p Var>) -> (Way, Way) {
        loop {
            let head = self.here.clone();
            self.leaves.push((None, None));
            self.body(body);
            let (leave, next) = self.leaves.pop().unwrap_or_default();
            let end = either(self.here.take(), next);
            self.here = end;
            if let Some(counter) = counter {
                self.set(counter, May::Number);
            }
            let end = self.here.take();
            self.here = either(head.clone(), end.clone());
            if self.here == head {
                return (leave, end);
            }
        }
    }
}
