//! Which local variables have a value, on every way to where they are read; and what the program decides by that.
//!
//! A control that knows variables without a value leaves their words out, and tells them from zero. For one that does
//! not, what is the same on every way is decided here: a comparison with nothing holds or does not, a word without a
//! value is no word. What is one thing on one way and another on the next is refused at its place.
//!
//! The ways are those of the text: through decisions, loops and jumps, into what is called, with the arguments of all
//! calls together, and with its caller's variables once for each call. A block that may be skipped gives nothing for
//! sure. Not followed: what common variables have; whether they have a value is the same question in both programs.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::defaults;
use crate::arguments::{self, Argument};
use crate::diag::{Diagnostic, Fault};
use crate::expr::{Binary, Expr, Function, Many, Node, Numbers, Scope, Target, Unary, Var};
use crate::open::open_variables;
use crate::program::{Call, Control, Op, Piece, Procedure, Program, Stmt, Text};
use crate::source::Span;
use crate::valid::not_called;
use crate::value;

mod elsewhere;

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
    vars: BTreeMap<Text, May>,
    /// Anything may be: calls within so many others.
    lost: bool,
}

impl Known {
    fn of(&self, name: &str) -> May {
        let otherwise = if self.lost { May::Either } else { May::Nothing };
        self.vars.get(name).copied().unwrap_or(otherwise)
    }

    fn or(&self, other: &Known) -> Known {
        let names: HashSet<&Text> = self.vars.keys().chain(other.vars.keys()).collect();
        let vars = names.into_iter().map(|name| (name.clone(), self.of(name).or(other.of(name)))).collect();
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

/// Decides what a program decides by whether variables have a value. For a target that knows such variables
/// (`vacant`), only what must have a value is looked at. Where the source's control knows them (`given`), the main
/// program's own variables that it reads unset may have been given values, and may not: a macro is called with arguments.
///
/// # Errors
/// A variable that may or may not have a value where it is read.
pub(super) fn resolve(program: &mut Program, vacant: bool, given: bool) -> Result<(), Diagnostic> {
    if !vacant {
        defaults::hand_over(program);
    }
    let before = program.clone();
    let open = if given { open_variables(program) } else { Vec::new() };
    let own = open.iter().filter(|(var, _)| matches!(var, Var::Local(_)));
    let vars = own.map(|(var, _)| (Text::from(&*var.name()), May::Either)).collect();
    let mut entries = BTreeMap::from([(0, Known { vars, lost: false })]);
    if given {
        // What no call of this program leads to, other programs call, with values or without.
        let theirs = not_called(program).into_iter();
        entries.extend(theirs.map(|at| (at, elsewhere::begins(&program.procedures[at]))));
        elsewhere::parameters(&before, &entries)?;
    }
    if let (Some(known), Some(main)) = (entries.get_mut(&0), before.procedures.first()) {
        let parameters = main.parameters.iter().map(|own| (Text::from(&*own.name()), May::Number));
        known.vars.extend(parameters);
    }
    let mut ways = Ways::over(&before.procedures, entries);
    let facts = std::mem::take(&mut ways.facts);
    let entries = std::mem::take(&mut ways.entries);
    for (at, procedure) in program.procedures.iter_mut().enumerate() {
        let was = &before.procedures[at].body;
        let mut settle = Settle { facts: &facts, vacant, decided: false };
        let body = std::mem::take(&mut procedure.body);
        procedure.body = settle.body(was, body)?;
    }
    if !vacant {
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
                    here.vars.values_mut().for_each(|may| *may = may.or(May::Number));
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
            Op::ProgramEnd | Op::Alarm(_) => self.here = None,
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
                self.here = Some(Known { vars: BTreeMap::new(), lost: true });
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

/// Puts in what is known.
struct Settle<'f> {
    facts: &'f Facts,
    /// Whether the target knows variables without a value.
    vacant: bool,
    /// Whether a decision of this procedure is made.
    decided: bool,
}

/// What becomes of a statement.
enum Kept {
    As(Stmt),
    /// In its place, as blocks of their own.
    Instead(Vec<Stmt>),
}

impl Settle<'_> {
    fn body(&mut self, was: &[Stmt], body: Vec<Stmt>) -> Result<Vec<Stmt>, Diagnostic> {
        let mut out: Vec<Stmt> = Vec::with_capacity(body.len());
        // What the first statement of a block was that is gone.
        let mut first: Option<Option<u32>> = None;
        for (was, mut stmt) in was.iter().zip(body) {
            if let Some(number) = first.take()
                && stmt.joined
            {
                (stmt.joined, stmt.number) = (false, number);
            }
            let (joined, number, skip) = (stmt.joined, stmt.number, stmt.skip);
            match self.stmt(was, stmt)? {
                Kept::As(stmt) => out.push(stmt),
                Kept::Instead(mut stmts) => {
                    let own = number.filter(|_| stmts.is_empty());
                    if let Some(stmt) = stmts.first_mut() {
                        stmt.number = number.or(stmt.number);
                    }
                    first = (!joined).then_some(own);
                    for stmt in &mut stmts {
                        stmt.skip = stmt.skip.or(skip);
                    }
                    out.append(&mut stmts);
                }
            }
        }
        Ok(out)
    }

    fn stmt(&mut self, was: &Stmt, mut stmt: Stmt) -> Result<Kept, Diagnostic> {
        let Some(known) = self.facts.get(&place(was)) else {
            // No way leads here. What a decision has cut off is gone.
            let stays = matches!(stmt.op, Op::Label(_) | Op::Comment(_)) || !self.decided;
            return Ok(if stays { Kept::As(stmt) } else { Kept::Instead(Vec::new()) });
        };
        let at = stmt.span;
        let values = Values { known, vacant: self.vacant, at };
        let gone = |stmt: Stmt| {
            let comment = stmt.comment.map(|text| Stmt::new(stmt.span, Op::Comment(*text)));
            Kept::Instead(comment.into_iter().collect())
        };
        match &mut stmt.op {
            Op::Assign(to, value) => {
                if let Target::Element(element) = to {
                    element.at.iter_mut().try_for_each(|index| values.number(index))?;
                }
                values.whole(value)?;
                if !self.vacant && is_nothing(value) && matches!(to, Target::Var(Var::Local(_))) {
                    return Ok(gone(stmt));
                }
            }
            Op::Declare(declare) => {
                declare.initial.iter_mut().flatten().try_for_each(|value| values.number(value))?;
            }
            Op::Call(call) => call.arguments.iter_mut().try_for_each(|value| values.handed(value))?,
            Op::Control(control) => {
                let Op::Control(before) = &was.op else { return Ok(Kept::As(stmt)) };
                if let Control::If { condition, then, otherwise } = &mut **control {
                    let decided = holds(condition, known).filter(|_| !self.vacant);
                    self.decided |= decided.is_some();
                    let mut bodies = before.bodies();
                    for (place, body) in [then, otherwise].into_iter().enumerate() {
                        let Some(was) = bodies.next() else { continue };
                        let own = std::mem::take(body);
                        if decided.is_none_or(|holds| holds == (place == 0)) {
                            *body = self.body(was, own)?;
                        }
                    }
                    return match decided {
                        None => {
                            values.number(condition)?;
                            Ok(Kept::As(stmt))
                        }
                        Some(_) => {
                            let comment = stmt.comment.take();
                            let Op::Control(control) = stmt.op else { return Ok(Kept::Instead(Vec::new())) };
                            let Control::If { then, otherwise, .. } = *control else {
                                return Ok(Kept::Instead(Vec::new()));
                            };
                            let mut all: Vec<Stmt> = then.into_iter().chain(otherwise).collect();
                            match (all.last_mut(), comment) {
                                (Some(last), Some(comment)) => {
                                    last.comment.get_or_insert(comment);
                                }
                                (None, Some(comment)) => all.push(Stmt::new(at, Op::Comment(*comment))),
                                (_, None) => {}
                            }
                            Ok(Kept::Instead(all))
                        }
                    };
                }
                match &mut **control {
                    Control::While { condition: value, .. } | Control::Until { condition: value, .. } => {
                        let known = self.facts.get(&place(&**before)).unwrap_or(known);
                        Values { known, ..values }.number(value)?;
                    }
                    Control::Repeat { times: value, .. } => values.number(value)?,
                    Control::For { from, to, step, .. } => {
                        [from, to, step].into_iter().try_for_each(|value| values.number(value))?;
                    }
                    Control::Loop { .. } | Control::If { .. } => {}
                }
                for (was, body) in before.bodies().zip(control.bodies_mut()) {
                    let own = std::mem::take(body);
                    *body = self.body(was, own)?;
                }
            }
            Op::MessageOf(pieces) => {
                let mut all = std::mem::take(pieces).into_vec();
                for piece in &mut all {
                    if let Piece::Value { value, .. } = piece {
                        values.whole(value)?;
                    }
                }
                if !self.vacant {
                    all.retain(|piece| !matches!(piece, Piece::Value { value, .. } if is_nothing(value)));
                }
                *pieces = all.into();
            }
            op if arguments::computed(op) => {
                let droppable = matches!(op, Op::SetFeedRate(_) | Op::SetSpindleSpeed(_) | Op::SelectTool(_));
                let mut left = true;
                arguments::each(op, &mut |argument, _| {
                    let takes = |value: &mut Expr| {
                        values.whole(value)?;
                        Ok(!self.vacant && is_nothing(value))
                    };
                    match argument {
                        Argument::Word(word) => {
                            if let Some(own) = word
                                && takes(&mut own.value)?
                            {
                                *word = None;
                            }
                        }
                        Argument::Optional(place) => {
                            if let Some(own) = place
                                && takes(own)?
                            {
                                *place = None;
                            }
                        }
                        Argument::Value(value) => left &= !takes(value)? || !droppable,
                    }
                    Ok(())
                })?;
                if !left {
                    return Ok(gone(stmt));
                }
            }
            _ => {}
        }
        Ok(Kept::As(stmt))
    }
}

/// The values of a statement.
#[derive(Clone, Copy)]
struct Values<'f> {
    known: &'f Known,
    vacant: bool,
    at: Span,
}

impl Values<'_> {
    fn refused(&self, name: &str) -> Diagnostic {
        let what = format!("the variable {name}, which may have no value where it is read").into();
        Diagnostic::new(Fault::Computes { what }, self.at)
    }

    /// The first variable of an expression that is one thing or the other.
    fn unsure(&self, e: &Expr) -> Diagnostic {
        fn first<'e>(e: &'e Expr, known: &Known) -> Option<&'e str> {
            if let Expr::Node(node) = e
                && let Node::Var(Var::Local(name)) = &**node
            {
                return (known.of(name) != May::Number).then_some(&**name);
            }
            e.parts().find_map(|part| first(part, known))
        }
        self.refused(first(e, self.known).unwrap_or_default())
    }

    /// What may be nothing: a word, what a variable is given.
    fn whole(&self, e: &mut Expr) -> Result<(), Diagnostic> {
        self.settled(e, nothing())
    }

    /// What is handed over. One that may have no value is refused where it is read there: nothing reads it, so that
    /// any number will do, and a control that knows no variables without one is not asked for it.
    fn handed(&self, e: &mut Expr) -> Result<(), Diagnostic> {
        let handed_on = matches!(e, Expr::Node(node) if matches!(**node, Node::Var(_)));
        if !self.vacant && may(e, self.known) == May::Either && handed_on {
            *e = Expr::int(0);
            return Ok(());
        }
        self.whole(e)
    }

    /// What counts as zero where it is nothing.
    fn number(&self, e: &mut Expr) -> Result<(), Diagnostic> {
        self.settled(e, Expr::int(0))
    }

    /// What is nothing becomes this; what may be nothing or a number is refused.
    fn settled(&self, e: &mut Expr, nothing: Expr) -> Result<(), Diagnostic> {
        if self.vacant {
            return self.inner(e);
        }
        match may(e, self.known) {
            May::Nothing => {
                *e = nothing;
                Ok(())
            }
            May::Either => Err(self.unsure(e)),
            May::Number => self.inner(e),
        }
    }

    /// The parts of an expression.
    fn inner(&self, e: &mut Expr) -> Result<(), Diagnostic> {
        if !self.vacant
            && let Some(holds) = holds(e, self.known)
        {
            *e = Expr::int(i64::from(holds));
            return Ok(());
        }
        if let Expr::Node(node) = e
            && let Node::Call(Function::Given, arguments) = &mut **node
        {
            let [a] = &mut arguments[..] else { return Ok(()) };
            if may(a, self.known) != May::Number {
                return Err(self.unsure(a));
            }
            self.number(a)?;
            *e = a.clone();
            return Ok(());
        }
        e.parts_mut().try_for_each(|part| self.number(part))
    }
}
