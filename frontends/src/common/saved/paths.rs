//! What is known of variables on the ways through a text: of which group they have the active code, or in which range
//! the whole number is that they have. A loop is gone round until nothing new comes of it; what still changes then is
//! not known there.

mod comparisons;
mod range;

use std::collections::{BTreeMap, BTreeSet};
use std::mem::take;

use ncc_ir::computed::computed_code::{ComputedCode, computed_code, of_number};
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Binary, Expr, Node, Target, Unary, Var};
use ncc_ir::program::{Control, Op, Procedure, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::unsupported::CodeUnsupported;

use self::comparisons::{compared, opposite, turned, variable};
pub(crate) use self::range::{Range, range};
use super::{ANY, ANY_PLACE, GroupSource, Saved};
use crate::batch::Batch;

/// Turns of a loop, or of all that jumps lead to, that are followed number by number: more than a group has codes, or a
/// table of work offsets places on most controls.
const TURNS: u32 = 120;

/// Iterations of all loops of a program that are followed so: nested loops have many.
const ALL_TURNS: u32 = 20_000;

/// How deep in calls of calls arguments are followed.
const ROUNDS: u32 = 3;

/// What is known of a variable.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Holds {
    /// It has the active code of a group, by the place of a row that saves it.
    Code(usize),
    /// It has a whole number.
    Whole(Range),
}

/// The ranges of the numbers of codes, by where those begin.
type Ranges = BTreeMap<u32, Range>;

/// Variables and what is known of them.
type Known = BTreeMap<String, Holds>;

impl Saved {
    /// The text is over: whether each such variable has its value from its group on every path to the code.
    pub(crate) fn check(&self, out: &mut Batch) {
        for (span, code, var) in &self.stated {
            let main = |own: &Text| own.is_empty() || !matches!(var, Var::Local(_));
            let sets =
                |(own, set): &(Text, Option<Var>)| set.as_ref().is_none_or(|set| set == var && main(own));
            if self.set.iter().any(sets) {
                let what = CodeUnsupported::Variable.into();
                out.report(Fault::NotSupported { code: code.clone(), what }, *span);
            }
        }
        if self.back.is_empty() {
            return;
        }
        let mut given = vec![Known::new(); out.procedures.len() + 1];
        let mut found = self.found(out, &given);
        for _ in 0..ROUNDS {
            let more = found.given(out);
            if more == given {
                break;
            }
            given = more;
            found = self.found(out, &given);
        }
        let Found { faults, ranges, .. } = found;
        for (span, fault) in faults {
            out.report(fault, span);
        }
        narrow(&mut out.stmts, &ranges);
        out.procedures.iter_mut().for_each(|procedure| narrow(&mut procedure.body, &ranges));
    }
}

/// What is found in a text.
#[derive(Default)]
struct Found {
    faults: Vec<(Span, Fault)>,
    ranges: Ranges,
    /// The arguments of calls, as far as their ranges are known.
    calls: Vec<(Text, Vec<Option<Range>>)>,
}

impl Found {
    /// What the programs of the text are given by all their calls.
    fn given(&self, out: &Batch) -> Vec<Known> {
        let own = |procedure: &Procedure| {
            let calls = || self.calls.iter().filter(|(name, _)| *name == procedure.name);
            let parameters = procedure.parameters.iter().enumerate();
            let ranges = parameters.filter_map(|(at, parameter)| {
                let mut each = calls().map(|(_, arguments)| arguments.get(at).copied().flatten());
                let first = each.next()??;
                let all = each.try_fold(first, |all, next| Some(all.hull(next?)))?;
                Some((key(parameter), Holds::Whole(all)))
            });
            ranges.collect()
        };
        std::iter::once(Known::new()).chain(out.procedures.iter().map(own)).collect()
    }
}

impl Saved {
    /// Follows all ways; `given` is what is known where each program begins.
    fn found(&self, out: &Batch, given: &[Known]) -> Found {
        let mut found = Found::default();
        let mut bodies = vec![("", &out.stmts)];
        bodies.extend(out.procedures.iter().map(|procedure| (&*procedure.name, &procedure.body)));
        let set: Vec<Set> = bodies.iter().map(|(_, body)| Set::from_body(body)).collect();
        let names: Vec<&str> = bodies.iter().skip(1).map(|(name, _)| *name).collect();
        for (at, (_, body)) in bodies.iter().enumerate() {
            let again = comes_back(at, &set, &names);
            let mut others = Set::default();
            for (_, own) in set.iter().enumerate().filter(|(other, _)| again || *other != at) {
                others.any |= own.any;
                others.vars.extend(own.vars.iter().cloned());
            }
            let (labels, wrong) = (BTreeMap::new(), Vec::new());
            let mut analysis = PathAnalysis { saved: self, others, labels, wrong, found, turns: 0 };
            for turn in 0.. {
                let before = analysis.labels.clone();
                analysis.wrong.clear();
                analysis.body(body, Some(given[at].clone()));
                if analysis.labels == before {
                    break;
                }
                if turn >= TURNS || analysis.turns > ALL_TURNS {
                    analysis.settle_labels(&before);
                }
            }
            let PathAnalysis { mut wrong, found: behind, .. } = analysis;
            found = behind;
            found.faults.append(&mut wrong);
        }
        found
    }
}

/// The variables that statements set.
#[derive(Default)]
struct Set {
    vars: BTreeSet<String>,
    /// One whose number is computed.
    any: bool,
    /// Whether an iteration of a loop ends from within.
    leaves: bool,
    /// The programs that they call.
    calls: BTreeSet<Text>,
}

impl Set {
    fn from_body(body: &[Stmt]) -> Set {
        let mut set = Set::default();
        set.body(body);
        set
    }

    fn body(&mut self, body: &[Stmt]) {
        for stmt in body {
            match &stmt.op {
                Op::Assign(Target::Var(var), _) => drop(self.vars.insert(key(var))),
                Op::Assign(Target::Element(_), _) | Op::Declare(_) | Op::RepeatBlocks(_) => self.any = true,
                Op::Leave | Op::NextTurn => self.leaves = true,
                Op::Call(call) => drop(self.calls.insert(call.name.clone())),
                Op::Control(control) => {
                    if let Control::For { variable, .. } = &**control {
                        self.vars.insert(key(variable));
                    }
                    control.bodies().for_each(|body| self.body(body));
                }
                _ => {}
            }
        }
    }

    fn takes_from(&self, known: &mut Known) {
        known.retain(|var, _| !self.any && !self.vars.contains(var));
    }
}

/// Whether a program may be executed again before it is over: it calls itself, or what calls it, or what is not in the
/// text. The first program has no name here; its number may be called all the same.
fn comes_back(own: usize, set: &[Set], names: &[&str]) -> bool {
    let mut reached = BTreeSet::new();
    let mut next = vec![own];
    while let Some(at) = next.pop() {
        for name in &set[at].calls {
            let Some(called) = names.iter().position(|other| *other == &**name) else { return true };
            if reached.insert(called + 1) {
                next.push(called + 1);
            }
        }
    }
    reached.contains(&own)
}

fn key(var: &Var) -> String {
    let kept = if let Var::Local(_) = var { "local" } else { "shared" };
    format!("{kept} {}", var.name())
}

/// What is known on the ways through a program.
struct PathAnalysis<'s> {
    saved: &'s Saved,
    /// What the other programs set.
    others: Set,
    /// What is known at labels, as far as jumps have led there.
    labels: BTreeMap<Text, Known>,
    wrong: Vec<(Span, Fault)>,
    found: Found,
    /// Iterations of loops that have been followed.
    turns: u32,
}

/// What is known where two ways meet.
fn meet(one: Option<Known>, other: Option<Known>) -> Option<Known> {
    match (one, other) {
        (Some(mut one), Some(other)) => {
            one.retain(|var, holds| match (holds, other.get(var)) {
                (Holds::Code(group), Some(Holds::Code(other))) => group == other,
                (Holds::Whole(range), Some(Holds::Whole(other))) => {
                    *range = range.hull(*other);
                    true
                }
                _ => false,
            });
            Some(one)
        }
        (one, other) => one.or(other),
    }
}

impl PathAnalysis<'_> {
    /// Forgets what still changes at labels.
    fn settle_labels(&mut self, before: &BTreeMap<Text, Known>) {
        for (name, known) in &mut self.labels {
            let Some(before) = before.get(name) else { continue };
            known.retain(|var, holds| before.get(var) == Some(holds));
        }
    }

    /// The group whose code active a value is.
    fn group(&self, value: &Expr) -> Option<usize> {
        self.saved.rows.iter().position(|(_, _, row)| row.value(0, "").as_ref() == Some(value))
    }

    fn body(&mut self, body: &[Stmt], mut known: Option<Known>) -> Option<Known> {
        for stmt in body {
            let skipped = stmt.skip.and(known.clone());
            known = self.stmt(stmt, known);
            if stmt.skip.is_some() {
                known = meet(known, skipped);
            }
        }
        known
    }

    fn stmt(&mut self, stmt: &Stmt, mut known: Option<Known>) -> Option<Known> {
        match &stmt.op {
            Op::Assign(Target::Var(var), value) => {
                let group = self.group(value).map(Holds::Code);
                let known = known.as_mut()?;
                let holds = group.or_else(|| worth(value, known).map(Holds::Whole));
                match holds {
                    Some(holds) => drop(known.insert(key(var), holds)),
                    None => drop(known.remove(&key(var))),
                }
            }
            Op::Assign(Target::Element(_), _) | Op::Declare(_) | Op::RepeatBlocks(_) => {
                known.as_mut()?.clear()
            }
            Op::Call(call) => {
                let known = known.as_mut()?;
                let arguments = call.arguments.iter().map(|argument| worth(argument, known)).collect();
                self.found.calls.push((call.name.clone(), arguments));
                let mut local = Known::new();
                if !call.shared {
                    local.extend(known.iter().filter(|(var, _)| var.starts_with("local")).map(own));
                }
                self.others.takes_from(known);
                known.extend(local);
            }
            Op::Label(name) => known = meet(known, self.labels.get(name).cloned()),
            Op::Goto(name) => {
                let there = self.labels.remove(name);
                if let Some(there) = meet(there, known) {
                    self.labels.insert(name.clone(), there);
                }
                return None;
            }
            Op::Return | Op::ProgramEnd | Op::BeginAgain | Op::Alarm(_) => return None,
            Op::Control(control) => {
                if let Some(code) = computed_code(control)
                    && self.saved.back.iter().any(|(span, _)| *span == stmt.span)
                    && let Some(known) = &known
                {
                    if !self.is_one_of(&code, stmt.span, known) {
                        self.wrong.push((stmt.span, self.refused(&code, stmt.span)));
                    }
                    // One of them may give a variable its value.
                    let mut behind = known.clone();
                    control.bodies().for_each(|body| Set::from_body(body).takes_from(&mut behind));
                    return Some(behind);
                }
                return self.control(control, known);
            }
            _ => {}
        }
        known
    }

    /// Why such a code is not kept.
    fn refused(&self, code: &ComputedCode<'_>, at: Span) -> Fault {
        let told = self.saved.back.iter().find(|(span, _)| *span == at);
        let (code, what) = match told {
            Some((_, GroupSource::Entry(name))) => ((*name).into(), ANY_PLACE.into()),
            _ => (format!("G{}", spelt(code.number)).into(), ANY.into()),
        };
        Fault::NotSupported { code, what }
    }

    /// Whether the number of a code is surely that of one of these.
    fn is_one_of(&mut self, code: &ComputedCode<'_>, at: Span, known: &Known) -> bool {
        let Some((_, told)) = self.saved.back.iter().find(|(span, _)| *span == at) else { return true };
        match told {
            GroupSource::Saved(row, var) => {
                let Some(Holds::Code(group)) = known.get(&key(var)) else { return false };
                std::ptr::eq(self.saved.rows[*group].2, *row) && !code.codes.is_empty()
            }
            GroupSource::Range | GroupSource::Entry(_) => {
                let Some(range) = worth(code.number, known) else { return false };
                // What is repeated stands in more than one body.
                let all = self.found.ranges.get(&at.start).map_or(range, |other| range.hull(*other));
                self.found.ranges.insert(at.start, all);
                let mut numbers = range.from..=range.to;
                // No more than there are codes are ever looked at: the next one is none of them.
                numbers.all(|number| code.codes.iter().any(|(own, _)| *own == number))
            }
        }
    }

    fn control(&mut self, control: &Control, known: Option<Known>) -> Option<Known> {
        match control {
            Control::If { condition, then, otherwise } => {
                let holds = known.clone().and_then(|known| where_it(condition, true, known));
                let fails = known.and_then(|known| where_it(condition, false, known));
                let then = self.body(then, holds);
                let otherwise = self.body(otherwise, fails);
                meet(then, otherwise)
            }
            Control::While { condition, body } => {
                let (known, _) = self.turns([Some(condition), None], body, known);
                if Set::from_body(body).leaves {
                    known
                } else {
                    known.and_then(|known| where_it(condition, false, known))
                }
            }
            Control::Loop { body } => self.turns([None, None], body, known).0,
            Control::Until { condition, body } => {
                let (begins, behind) = self.turns([None, Some(condition)], body, known);
                match Set::from_body(body).leaves {
                    true => begins,
                    false => behind.and_then(|known| where_it(condition, true, known)),
                }
            }
            Control::Repeat { body, .. } => {
                let known = without(known, body);
                let behind = self.body(body, known.clone());
                meet(known, behind)
            }
            Control::For { variable, from, to, step, body } => {
                let mut known = without(known, body)?;
                let counts = counted([from, to, step], &known);
                known.remove(&key(variable));
                let own = Set::from_body(body);
                let mut within = known.clone();
                if let Some(range) = counts.filter(|_| !own.any && !own.vars.contains(&key(variable))) {
                    within.insert(key(variable), Holds::Whole(range));
                }
                let mut behind = self.body(body, Some(within));
                if let Some(behind) = &mut behind {
                    behind.remove(&key(variable));
                }
                meet(Some(known), behind)
            }
        }
    }

    /// What is known wherever an iteration of a loop begins, and wherever one ends; `head` must hold before a turn, and `until`
    /// not after it for another one.
    fn turns(
        &mut self,
        [head, until]: [Option<&Expr>; 2],
        body: &[Stmt],
        known: Option<Known>,
    ) -> (Option<Known>, Option<Known>) {
        // Where it is left from within, that place would have to be looked at as well.
        let mut begins = if Set::from_body(body).leaves { without(known, body) } else { known };
        let wrong = take(&mut self.wrong);
        let mut turn = 0;
        let behind = loop {
            self.wrong.clear();
            self.turns += 1;
            let settles = turn >= TURNS || self.turns > ALL_TURNS;
            let holds = begins.clone().and_then(|known| match head {
                Some(condition) => where_it(condition, true, known),
                None => Some(known),
            });
            let behind = self.body(body, holds);
            let again = behind.clone().and_then(|known| match until {
                Some(condition) => where_it(condition, false, known),
                None => Some(known),
            });
            let mut next = meet(begins.clone(), again);
            if next == begins {
                break behind;
            }
            turn += 1;
            if let (true, Some(next), Some(before)) = (settles, &mut next, &begins) {
                next.retain(|var, holds| before.get(var) == Some(holds));
            }
            begins = next;
        };
        self.wrong.splice(0..0, wrong);
        (begins, behind)
    }
}

/// What is known where a body may have been executed, or not.
fn without(known: Option<Known>, body: &[Stmt]) -> Option<Known> {
    let mut known = known?;
    Set::from_body(body).takes_from(&mut known);
    Some(known)
}

/// The numbers that a loop counts through: from where it begins to where it ends at the furthest.
fn counted([from, to, step]: [&Expr; 3], known: &Known) -> Option<Range> {
    let (from, to, step) = (worth(from, known)?, worth(to, known)?, worth(step, known)?);
    (step.from > 0 && from.from <= to.to).then_some(Range { from: from.from, to: to.to })
}

/// The range of a value.
fn worth(value: &Expr, known: &Known) -> Option<Range> {
    range(value, &|var| match known.get(&key(var)) {
        Some(Holds::Whole(range)) => Some(*range),
        Some(Holds::Code(_)) | None => None,
    })
}

/// What is known where a condition holds, or does not; `None` where that never happens.
fn where_it(condition: &Expr, holds: bool, known: Known) -> Option<Known> {
    let Expr::Node(node) = condition else { return Some(known) };
    let (operator, a, b) = match &**node {
        Node::Unary(Unary::Not, a) => return where_it(a, !holds, known),
        Node::Binary(Binary::And, a, b) if holds => return where_it(b, true, where_it(a, true, known)?),
        Node::Binary(Binary::Or, a, b) if !holds => return where_it(b, false, where_it(a, false, known)?),
        Node::Binary(Binary::And | Binary::Or, a, b) => {
            return meet(where_it(a, holds, known.clone()), where_it(b, holds, known));
        }
        node => match compared(node) {
            Some(compared) => compared,
            None => return Some(known),
        },
    };
    // A condition that is worth nothing does not hold.
    if let (Binary::Equal | Binary::NotEqual, Expr::Node(inner), Some(0)) =
        (operator, a, b.literal().and_then(|n| n.whole_number()))
        && let Node::Binary(decision, ..) = &**inner
        && decision.decides()
    {
        return where_it(a, holds == (operator == Binary::NotEqual), known);
    }
    let operator = if holds { Some(operator) } else { opposite(operator) };
    let Some(operator) = operator else { return Some(known) };
    let known = limit(a, operator, b, known)?;
    limit(b, turned(operator), a, known)
}

/// What is known where a variable compares so with something else; `None` where it cannot.
fn limit(what: &Expr, operator: Binary, with: &Expr, mut known: Known) -> Option<Known> {
    let Some(with) = worth(with, &known) else { return Some(known) };
    let Some(var) = variable(what) else { return Some(known) };
    let Some(Holds::Whole(range)) = known.get_mut(&key(var)) else { return Some(known) };
    match operator {
        Binary::Less => range.to = range.to.min(with.to - 1),
        Binary::LessOrEqual => range.to = range.to.min(with.to),
        Binary::Greater => range.from = range.from.max(with.from + 1),
        Binary::GreaterOrEqual => range.from = range.from.max(with.from),
        Binary::Equal => {
            *range = Range { from: range.from.max(with.from), to: range.to.min(with.to) };
        }
        Binary::NotEqual if with.from == with.to => {
            let (first, last) = (range.from == with.from, range.to == with.to);
            *range = Range { from: range.from + i64::from(first), to: range.to - i64::from(last) };
        }
        _ => {}
    }
    (range.from <= range.to).then_some(known)
}

/// Takes the codes away of which the number is not in the range.
fn narrow(body: &mut [Stmt], ranges: &Ranges) {
    for stmt in body {
        let Op::Control(control) = &mut stmt.op else { continue };
        let Some((code, range)) = computed_code(control).zip(ranges.get(&stmt.span.start)) else {
            control.bodies_mut().for_each(|body| narrow(body, ranges));
            continue;
        };
        let within = |(number, _): &(i64, &Op)| (range.from..=range.to).contains(number);
        let codes = code.codes.iter().filter(|code| within(code));
        let codes = codes.map(|(number, op)| (*number, (*op).clone())).collect();
        stmt.op = of_number(code.number, codes, stmt.span);
    }
}

/// The number of a code, as a message names it.
fn spelt(number: &Expr) -> Box<str> {
    if let Expr::Node(node) = number
        && let Node::Var(var) = &**node
    {
        return format!("#{}", var.name()).into();
    }
    "[…]".into()
}

fn own((var, holds): (&String, &Holds)) -> (String, Holds) {
    (var.clone(), *holds)
}
