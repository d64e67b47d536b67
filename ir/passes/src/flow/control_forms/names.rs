//! New names for labels and variables that the pass inserts, such as `LEFT_1`, and unique label names.
//!
//! Not here: the loops and branches that need them (`control_forms`).

use std::collections::{BTreeMap, BTreeSet};

use crate::values::variables::expressions;
use ncc_ir::computed::free_variables::free_variables;
use ncc_ir::expr::{Element, Expr, Many, Node, Scope, Target, Var};
use ncc_ir::program::{Control, Op, Procedure, Program, Stmt, Text};

/// Names of labels and variables in use.
#[derive(Debug, Default)]
pub(super) struct Names {
    labels: BTreeSet<Text>,
    variables: BTreeSet<Text>,
    /// Highest number used so far, by kind. The sets only grow, so no number is free again.
    last_label: BTreeMap<Text, u32>,
    last_variable: BTreeMap<Text, u32>,
    /// Whether local variables have numbers, and whether a computed number may reach any of them.
    numbered: bool,
    reached: bool,
}

impl Names {
    pub(super) fn from_program(program: &Program) -> Names {
        let mut names = Names::default();
        for procedure in &program.procedures {
            procedure.parameters.iter().for_each(|var| names.variable(var));
            names.look(&procedure.body);
        }
        free_variables(program).iter().for_each(|(var, _)| names.variable(var));
        names
    }

    fn variable(&mut self, var: &Var) {
        let name = var.name();
        self.numbered |= matches!(var, Var::Local(_)) && name.bytes().all(|b| b.is_ascii_digit());
        self.variables.insert(name.into());
    }

    fn look(&mut self, body: &[Stmt]) {
        for stmt in body {
            match &stmt.op {
                Op::Label(name) | Op::Goto(name) => {
                    self.labels.insert(name.clone());
                }
                Op::RepeatBlocks(repeat) => {
                    self.labels.insert(repeat.from.clone());
                    self.labels.extend(repeat.to.clone());
                }
                Op::Assign(Target::Var(var), _) => self.variable(var),
                Op::Assign(Target::Element(element), _) => self.element(element),
                Op::Declare(declare) => self.variable(&declare.var),
                Op::Control(control) => {
                    if let Control::For { variable, .. } = &**control {
                        self.variable(variable);
                    }
                    control.bodies().for_each(|body| self.look(body));
                }
                _ => {}
            }
        }
    }

    /// A new name of a kind: `LEFT_1`.
    fn fresh(names: &mut BTreeSet<Text>, last: &mut BTreeMap<Text, u32>, kind: &str) -> Text {
        let last = last.entry(kind.into()).or_default();
        loop {
            *last += 1;
            let name: Text = format!("{kind}_{last}").into();
            if names.insert(name.clone()) {
                return name;
            }
        }
    }

    pub(super) fn label(&mut self, kind: &str) -> Text {
        Names::fresh(&mut self.labels, &mut self.last_label, kind)
    }

    pub(super) fn counter(&mut self, kind: &str) -> Var {
        Var::Local(Names::fresh(&mut self.variables, &mut self.last_variable, kind))
    }

    /// Adds the variables that the program reads.
    pub(super) fn read(&mut self, program: &mut Program) {
        fn each(names: &mut Names, e: &Expr) {
            if let Expr::Node(node) = e {
                match &**node {
                    Node::Var(var) => names.variable(var),
                    Node::Element(element) => names.element(element),
                    Node::Vacant | Node::Unary(..) | Node::Binary(..) | Node::Call(..) => {}
                }
            }
            e.parts().for_each(|part| each(names, part));
        }
        for procedure in &mut program.procedures {
            expressions(&mut procedure.body, &mut |_, e| each(self, e));
        }
    }

    fn element(&mut self, element: &Element) {
        if let Many::Numbered(rows) = &element.of {
            self.reached |= rows.iter().any(|row| row.scope == Scope::Local);
        }
    }

    /// A new work variable. If the program numbers its local variables, it is the highest free number of the ranges
    /// `local`. It has a name instead if all are in use, or if a computed number may reach one.
    pub(super) fn room(&mut self, local: &[[u32; 2]]) -> Var {
        let numbers = local.iter().rev().flat_map(|[from, to]| (*from..=*to).rev());
        let mut free = numbers.map(|n| Text::from(n.to_string())).filter(|_| self.numbered && !self.reached);
        match free.find(|name| !self.variables.contains(name)) {
            Some(name) => {
                self.variables.insert(name.clone());
                Var::Local(name)
            }
            None => self.counter("WORKED"),
        }
    }

    /// Renames labels of equal name and the jumps to each. Later, bodies move into other bodies, and equal names
    /// would then clash.
    pub(super) fn only_once(&mut self, procedure: &mut Procedure) {
        let mut labels = Labels::default();
        labels.look(&procedure.body, &mut Vec::new());
        if labels.repeats || labels.found.values().all(|places| places.len() < 2) {
            return;
        }
        let mut names = BTreeMap::new();
        for (name, places) in &labels.found {
            for (at, _) in places.iter().skip(1) {
                names.insert(*at, self.label(name));
            }
        }
        let mut renaming = Renaming { labels: &labels, names: &names, at: 0, next: 0 };
        renaming.rename_labels(&mut procedure.body, &mut Vec::new());
    }
}

/// Labels of a procedure. For each name: its indices in text order, each with the numbers of the enclosing bodies.
#[derive(Debug, Default)]
struct Labels {
    found: BTreeMap<Text, Vec<(usize, Vec<usize>)>>,
    count: usize,
    bodies: usize,
    /// Whether the procedure repeats blocks between labels. That statement finds labels by other rules.
    repeats: bool,
}

impl Labels {
    fn look(&mut self, body: &[Stmt], within: &mut Vec<usize>) {
        within.push(self.bodies);
        self.bodies += 1;
        for stmt in body {
            match &stmt.op {
                Op::Label(name) => {
                    self.found.entry(name.clone()).or_default().push((self.count, within.clone()));
                    self.count += 1;
                }
                Op::RepeatBlocks(_) => self.repeats = true,
                Op::Control(control) => control.bodies().for_each(|body| self.look(body, within)),
                _ => {}
            }
        }
        within.pop();
    }

    /// Index of the jump target `name` for a jump after `behind` labels in the bodies `within`: the next label of that
    /// name, else the first. Only labels in enclosing bodies count.
    fn reached(&self, name: &str, behind: usize, within: &[usize]) -> Option<usize> {
        let places = self.found.get(name)?;
        let mut reached = places.iter().filter(|(_, bodies)| within.starts_with(bodies)).map(|(at, _)| *at);
        let ahead = reached.clone().find(|at| *at >= behind);
        ahead.or_else(|| reached.next())
    }
}

/// Renames labels, and the jumps to them.
struct Renaming<'l> {
    labels: &'l Labels,
    names: &'l BTreeMap<usize, Text>,
    /// Number of labels passed, then (`next`) of bodies passed.
    at: usize,
    next: usize,
}

impl Renaming<'_> {
    fn rename_labels(&mut self, body: &mut [Stmt], within: &mut Vec<usize>) {
        within.push(self.next);
        self.next += 1;
        for stmt in body {
            match &mut stmt.op {
                Op::Label(name) => {
                    if let Some(own) = self.names.get(&self.at) {
                        *name = own.clone();
                    }
                    self.at += 1;
                }
                Op::Goto(name) => {
                    let to = self.labels.reached(name, self.at, within);
                    if let Some(own) = to.and_then(|to| self.names.get(&to)) {
                        *name = own.clone();
                    }
                }
                Op::Control(control) => {
                    control.bodies_mut().for_each(|body| self.rename_labels(body, within))
                }
                _ => {}
            }
        }
        within.pop();
    }
}

/// Merges consecutive labels into one and redirects the jumps. It removes only labels that this pass inserted, and
/// keeps a label of the program if the run has one.
pub(super) fn one_label_a_place(body: &mut Vec<Stmt>) {
    let mut names = BTreeMap::new();
    merge(body, &mut names);
    if !names.is_empty() {
        rename(body, &names);
    }
}

fn merge(body: &mut Vec<Stmt>, names: &mut BTreeMap<Text, Text>) {
    let mut at = 0;
    while at < body.len() {
        if let Op::Control(control) = &mut body[at].op {
            control.bodies_mut().for_each(|body| merge(body, names));
        }
        let labels = body[at..].iter().take_while(|stmt| matches!(stmt.op, Op::Label(_))).count();
        if labels > 1 {
            let run = &body[at..at + labels];
            let stays = run.iter().position(|stmt| !is_made(stmt)).unwrap_or(0);
            let name = match &run[stays].op {
                Op::Label(name) => name.clone(),
                _ => return,
            };
            let mut place = 0;
            let (first, last) = (at, at + labels);
            body.retain(|stmt| {
                let gone = (first..last).contains(&place) && place != first + stays && is_made(stmt);
                place += 1;
                if let (true, Op::Label(own)) = (gone, &stmt.op) {
                    names.insert(own.clone(), name.clone());
                }
                !gone
            });
            at += 1;
            continue;
        }
        at += labels.max(1);
    }
}

/// Whether this pass inserted the label: its prefix is known, and it has no number, comment or block skip.
fn is_made(stmt: &Stmt) -> bool {
    let own = ["OVER_", "ELSE_", "LEFT_", "NEXT_", "AGAIN_"];
    let made = matches!(&stmt.op, Op::Label(name) if own.iter().any(|own| name.starts_with(own)));
    made && stmt.number.is_none() && stmt.comment.is_none() && stmt.skip.is_none()
}

fn rename(body: &mut [Stmt], names: &BTreeMap<Text, Text>) {
    for stmt in body {
        match &mut stmt.op {
            Op::Goto(name) => {
                if let Some(other) = names.get(name) {
                    *name = other.clone();
                }
            }
            Op::Control(control) => control.bodies_mut().for_each(|body| rename(body, names)),
            _ => {}
        }
    }
}
