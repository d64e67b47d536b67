//! Which local variables have a value, on every way to where they are read; and what the program decides by that.
//!
//! A control that knows variables without a value leaves their words out, and tells them from zero. For one that does
//! not, what is the same on every way is decided here: a comparison with nothing holds or does not, a word without a
//! value is no word. What is one thing on one way and another on the next is refused at its place.
//!
//! The ways are those of the text: through decisions, loops and jumps, into what is called, with the arguments of all
//! calls together, and with its caller's variables once for each call. A block that may be skipped gives nothing for
//! sure. Not followed: what common variables have; whether they have a value is the same question in both programs.

use std::collections::{BTreeMap, HashMap};

use crate::support::shared_map::SharedMap;
use crate::values::variables::defaults;
use ncc_ir::computed::open::open_variables;
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::value;
use ncc_ir::expr::{Binary, Expr, Function, Many, Node, Numbers, Scope, Target, Unary, Var};
use ncc_ir::program::valid::not_called;
use ncc_ir::program::{Call, Control, Op, Procedure, Program, Stmt, Text};

mod apart;
mod elsewhere;
mod settle;

use apart::Apart;
use settle::Settle;

pub use elsewhere::{Question, questions};

/// Most calls one within another that are looked into with their caller's variables.
const DEEPEST: u32 = 10;

/// What a variable may have, or an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum May {
    /// Nothing at all.
    Nothing,
    /// A number.
    Number,
    /// One or the other.
    Either,
}

impl May {
    fn or(self, other: May) -> May {
        if self == other { self } else { May::Either }
    }
}

/// What the local variables may have at a place; one that is not among them has nothing.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Known {
    vars: SharedMap<Text, May>,
    /// Anything may be: calls within so many others.
    lost: bool,
}

impl Known {
    fn of(&self, name: &str) -> May {
        let otherwise = if self.lost { May::Either } else { May::Nothing };
        self.vars.get(name).copied().unwrap_or(otherwise)
    }

    fn or(&self, other: &Known) -> Known {
        let [own, theirs] = [self, other].map(|known| if known.lost { May::Either } else { May::Nothing });
        let mut vars = self.vars.clone();
        vars.join(&other.vars, |a, b| Some(a.copied().unwrap_or(own).or(b.copied().unwrap_or(theirs))));
        Known { vars, lost: self.lost || other.lost }
    }
}

/// The same, or that no way leads there.
type Way = Option<Known>;

fn either(a: Way, b: Way) -> Way {
    match (a, b) {
        (Some(a), Some(b)) => Some(a.or(&b)),
        (a, None) => a,
        (None, b) => b,
    }
}

/// Which controls know variables without a value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vacant {
    /// The target's does: only what must have a value is looked at.
    pub(super) there: bool,
    /// The source's does: the main program's own variables that it reads unset may have been given values, and may
    /// not, as a macro is called with arguments.
    pub(super) here: bool,
}

/// Decides what a program decides by whether variables have a value.
///
/// # Errors
/// A variable that may or may not have a value where it is read.
pub(super) fn resolve(
    program: &mut Program,
    vacant: Vacant,
    diags: &mut Vec<Diagnostic>,
) -> Result<(), Diagnostic> {
    if vacant.there {
        return settled(program, vacant).map_err(|unsure| unsure.refused);
    }
    defaults::hand_over(program);
    let mut first = None;
    let mut told = Vec::new();
    loop {
        let Err(unsure) = settled(program, vacant) else {
            diags.append(&mut told);
            return Ok(());
        };
        let refused = first.get_or_insert(unsure.refused);
        let Some(apart) = unsure.apart else { return Err(refused.clone()) };
        told.extend(apart.told);
        *program = apart.program;
    }
}

/// A variable that may or may not have a value where it is read.
struct Unsure {
    refused: Diagnostic,
    /// The program as it was with its macros apart, if one is called in several ways.
    apart: Option<Apart>,
}

/// Puts into a program what is known on all ways.
///
/// # Errors
/// A variable that may or may not have a value where it is read.
fn settled(program: &mut Program, vacant: Vacant) -> Result<(), Box<Unsure>> {
    let before = program.clone();
    let open = if vacant.here { open_variables(program) } else { Vec::new() };
    let own = open.iter().filter(|(var, _)| matches!(var, Var::Local(_)));
    let vars = own.map(|(var, _)| (Text::from(&*var.name()), May::Either)).collect();
    let mut entries = BTreeMap::from([(0, Known { vars, lost: false })]);
    if vacant.here {
        // What no call of this program leads to, other programs call, with values or without.
        let theirs = not_called(program).into_iter();
        entries.extend(theirs.map(|at| (at, elsewhere::begins(&program.procedures[at]))));
        elsewhere::parameters(&before, &entries)
            .map_err(|refused| Box::new(Unsure { refused, apart: None }))?;
    }
    if let (Some(known), Some(main)) = (entries.get_mut(&0), before.procedures.first()) {
        let parameters = main.parameters.iter().map(|own| (Text::from(&*own.name()), May::Number));
        known.vars.extend(parameters);
    }
    let mut ways = Ways::over(&before.procedures, entries);
    let facts = std::mem::take(&mut ways.facts);
    let entries = std::mem::take(&mut ways.entries);
    let mut refused = BTreeMap::new();
    for (at, procedure) in program.procedures.iter_mut().enumerate() {
        let was = &before.procedures[at].body;
        let mut settle = Settle { facts: &facts, vacant: vacant.there, decided: false };
        match settle.body(was, std::mem::take(&mut procedure.body)) {
            Ok(body) => procedure.body = body,
            Err(fault) => drop(refused.insert(at, fault)),
        }
    }
    let unsure: Vec<usize> = refused.keys().copied().collect();
    if let Some((_, refused)) = refused.pop_first() {
        return Err(Box::new(Unsure { refused, apart: apart::by_arguments(&before, &facts, unsure) }));
    }
    if !vacant.there {
        let handed = |procedure: &Procedure, at: usize| -> Vec<bool> {
            let entry = entries.get(&at);
            let has = |var: &Var| entry.is_none_or(|entry| entry.of(&var.name()) != May::Nothing);
            procedure.parameters.iter().map(has).collect()
        };
        let all = program.procedures.iter().enumerate().skip(1);
        let kept: HashMap<Text, Vec<bool>> = all.map(|(at, p)| (p.name.clone(), handed(p, at))).collect();
        for procedure in &mut program.procedures {
            if let Some(kept) = kept.get(&procedure.name) {
                let mut keep = kept.iter();
                procedure.parameters.retain(|_| keep.next().copied().unwrap_or(true));
                let mut keep = kept.iter();
                procedure.kinds.retain(|_| keep.next().copied().unwrap_or(true));
            }
            calls(&mut procedure.body, &mut |call| {
                let kept = kept.get(&call.name).map(Vec::as_slice).unwrap_or_default();
                let mut keep = kept.iter();
                call.arguments.retain(|_| keep.next().copied().unwrap_or(true));
                for argument in &mut call.arguments {
                    // Nothing reads it there.
                    if is_nothing(argument) {
                        *argument = Expr::int(0);
                    }
                }
            });
        }
    }
    Ok(())
}

pub(super) fn is_nothing(e: &Expr) -> bool {
    matches!(e, Expr::Node(node) if **node == Node::Vacant)
}

fn nothing() -> Expr {
    Expr::Node(Box::new(Node::Vacant))
}

/// Shows every call of a body.
pub(super) fn calls(body: &mut [Stmt], seen: &mut dyn FnMut(&mut Call)) {
    for stmt in body {
        match &mut stmt.op {
            Op::Call(call) => seen(call),
            Op::Control(control) => control.bodies_mut().for_each(|body| calls(body, seen)),
            _ => {}
        }
    }
}

/// By which a statement, or the condition of a loop, is known while it does not move.
fn place<T>(of: &T) -> usize {
    std::ptr::from_ref(of).addr()
}

/// What is known on all ways to each statement.
type Facts = HashMap<usize, Known>;

/// The ways through a program.
struct Ways<'p> {
    procedures: &'p [Procedure],
    facts: Facts,
    /// What procedures with variables of their own begin with.
    entries: BTreeMap<usize, Known>,
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
    fn over(procedures: &'p [Procedure], entries: BTreeMap<usize, Known>) -> Ways<'p> {
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

/// What an expression may be: nothing, where it is a variable without a value, the same with a sign, or rounded.
pub(super) fn may(e: &Expr, known: &Known) -> May {
    let Expr::Node(node) = e else { return May::Number };
    match &**node {
        Node::Vacant => May::Nothing,
        Node::Var(Var::Local(name)) => known.of(name),
        Node::Unary(Unary::Negate, a) => may(a, known),
        Node::Call(Function::RoundTo, arguments) => {
            arguments.first().map_or(May::Number, |first| may(first, known))
        }
        Node::Var(_) | Node::Element(_) | Node::Unary(..) | Node::Binary(..) | Node::Call(..) => May::Number,
    }
}

/// Whether a condition holds, where that follows from which variables have a value.
fn holds(e: &Expr, known: &Known) -> Option<bool> {
    let Expr::Node(node) = e else { return None };
    match &**node {
        Node::Binary(operator @ (Binary::Equal | Binary::NotEqual), a, b) => {
            let same = match (may(a, known), may(b, known)) {
                (May::Nothing, May::Nothing) => true,
                (May::Nothing, May::Number) | (May::Number, May::Nothing) => false,
                _ => return None,
            };
            Some(same == (*operator == Binary::Equal))
        }
        Node::Binary(
            operator @ (Binary::Less | Binary::LessOrEqual | Binary::Greater | Binary::GreaterOrEqual),
            a,
            b,
        ) => {
            // What has no value counts as zero.
            let zero = |e: &Expr| match e.literal() {
                Some(n) => Some((n.mantissa as f64 / 10_f64.powi(i32::from(n.scale)), false)),
                None => (may(e, known) == May::Nothing).then_some((0.0, true)),
            };
            let ((a, first), (b, second)) = (zero(a)?, zero(b)?);
            let result = value::binary(*operator, a, b).ok().filter(|_| first || second)?;
            Some(result != 0.0)
        }
        Node::Binary(Binary::And, a, b) => match (holds(a, known), holds(b, known)) {
            (Some(false), _) | (_, Some(false)) => Some(false),
            (Some(true), Some(true)) => Some(true),
            _ => None,
        },
        Node::Binary(Binary::Or, a, b) => match (holds(a, known), holds(b, known)) {
            (Some(true), _) | (_, Some(true)) => Some(true),
            (Some(false), Some(false)) => Some(false),
            _ => None,
        },
        Node::Unary(Unary::Not, a) => holds(a, known).map(|holds| !holds),
        _ => None,
    }
}
