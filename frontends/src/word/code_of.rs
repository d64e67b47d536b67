//! G codes of which the number is a variable (16-C, custom macro: a variable stands for the value of any address but `O`
//! and `N`; its bolt circle saves `#3=#4003` and puts that back by `G#3 G80`): a decision about each code of the group
//! from which the variable was given its value, and an alarm where none has the number.
//!
//! That it has its value from there on every way to the code is looked at when the whole text has been read; any other
//! is refused by name, since any code might come of it.

use std::collections::{BTreeMap, BTreeSet};

use ncc_dialects::{Statement as Says, SystemRow};
use ncc_ir::canon::Motion;
use ncc_ir::code_of::{code_of, of_number};
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Expr, Node, Target, Var};
use ncc_ir::program::{Move, Op, Point, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::system::System;

use super::Source;
use super::block::{Block, Value, Word};
use super::computing::Computes;
use super::facts::{InForce, Know};
use super::functions::setting;
use super::lower::Lower;
use super::sort::{Code, motion_of};
use crate::Batch;

/// What the text saves of the modes in force and puts back.
#[derive(Debug, Default)]
pub(super) struct Saved {
    /// Variables that are given the code in force of a group, each in its program, in the order of the text.
    rows: Vec<(Text, Var, &'static SystemRow)>,
    /// Where such codes are put back, of which group, and of which variable.
    back: Vec<(Span, &'static SystemRow, Var)>,
}

/// Variables and the groups whose codes they have.
type Known = BTreeMap<String, usize>;

impl Lower {
    /// A variable gets a value as the text has it.
    pub(super) fn saves(&mut self, to: &Target, value: &Expr) {
        let (Target::Var(var), Expr::Node(node)) = (to, value) else { return };
        let Node::Var(Var::System(System::Other(name))) = &**node else { return };
        if let Some((row, 0)) = self.row_of(name)
            && row.refuse.is_none()
            && !row.sum.is_empty()
        {
            let own = self.sub.as_ref().map(|sub| sub.name.clone()).unwrap_or_default();
            self.computes.saved.rows.push((own, var.clone(), row));
        }
    }

    /// Whether a code is one of those that the text may compute.
    pub(super) fn may_be_computed(&self, word: &Word) -> bool {
        word.letter == b'G' && self.settings.dialect.formula.statements.contains(&Says::CodeOf)
    }

    /// The codes of a block of which the number is a variable: they come first, as modes do.
    pub(super) fn computed_codes(&mut self, block: &Block, codes: &[Code], src: Source, out: &mut Batch) {
        let computed = |word: &&Word| matches!((word.letter, word.value), (b'G', Value::Computed(_)));
        for word in block.words.iter().filter(computed) {
            self.computed_code(word, block, codes, src, out);
        }
    }

    fn computed_code(&mut self, word: &Word, block: &Block, codes: &[Code], src: Source, out: &mut Batch) {
        let Value::Computed(place) = word.value else { return };
        let refused = |lower: &mut Lower, name: &str, out: &mut Batch| {
            lower.fault(Fault::NotSupported { code: src.text(word.span), name: name.into() }, word.span, out);
        };
        let number = block.exprs[usize::from(place)].clone();
        let found = match &number {
            Expr::Node(node) => match &**node {
                Node::Var(var) => self.row_saved(var).map(|row| (var.clone(), row)),
                _ => None,
            },
            Expr::Num(_) => None,
        };
        let Some((var, row)) = found else { return refused(self, ANY, out) };
        let group = self.codes_of(row);
        let same = |code: &Code| group.iter().any(|(_, _, group)| **group == *code.row.group);
        if codes.iter().any(same) {
            return refused(self, "code of a variable beside one of its group", out);
        }
        out.whole = true;
        self.leave_motion(None, out);
        if !self.forget_group(&group) {
            return refused(self, "code of a variable while a cycle is in force", out);
        }
        self.computes.saved.back.push((word.span, row, var));
        let group = group.into_iter().map(|(code, op, _)| (code, op)).collect();
        self.push(word.span, of_number(&number, group, word.span), out);
        self.stands_alone();
    }

    /// The group whose code a variable was given last.
    fn row_saved(&self, var: &Var) -> Option<&'static SystemRow> {
        let own = self.sub.as_ref().map(|sub| &*sub.name).unwrap_or_default();
        let here = |(program, of, _): &&(Text, Var, _)| {
            of == var && (!matches!(var, Var::Local(_)) || **program == *own)
        };
        self.computes.saved.rows.iter().rev().find(here).map(|(_, _, row)| *row)
    }

    /// The codes that a group's variable may have the numbers of, what they do, and their group.
    fn codes_of(&self, row: &'static SystemRow) -> Vec<(i64, Op, &'static str)> {
        let base: i64 = row.sum.iter().filter(|term| term.means.is_empty()).map(|term| term.times).sum();
        let numbers = row.sum.iter().filter(|term| !term.means.is_empty()).flat_map(|term| {
            let each = if System::named(&term.means) == System::FirstWorkOffset { 1..=6 } else { 1..=1 };
            each.map(move |worth| base + worth * term.times)
        });
        let dialect = self.settings.dialect;
        let nowhere = || Move { to: Point::default(), said: true };
        let code = |number: i64| {
            let row = dialect.code_row(b'G', u32::try_from(number * 10).ok()?)?;
            let op = match motion_of(row.means?) {
                Some(Motion::Traverse) => Op::StraightTraverse(nowhere()),
                Some(Motion::Feed) => Op::StraightFeed(nowhere()),
                Some(Motion::Arc(_) | Motion::Cycle) => return None,
                None => setting(row.means?)?,
            };
            Some((number, op, &*row.group))
        };
        numbers.filter_map(code).collect()
    }

    /// What such a code says is not known any more; `false` where a cycle in force goes by it.
    fn forget_group(&mut self, codes: &[(i64, Op, &str)]) -> bool {
        let Some((_, op, _)) = codes.first() else { return false };
        let active = matches!(self.state.cycle, InForce::Active(_));
        match op {
            Op::SetDistanceMode(_) => self.state.distance = Know::Lost,
            Op::SetOriginOffsets(_) if self.state.turned == 0 => self.state.work_offset = Know::Lost,
            Op::SetFeedMode(_) if !active => {
                self.state.feed_mode = Know::Lost;
                self.state.feed = Know::Lost;
            }
            Op::UseLengthUnits(_) if !active => self.state.units = Know::Lost,
            Op::SelectPlane(_) if !active => self.state.plane = Know::Lost,
            Op::SetReturnLevel(_) if !active => {
                self.state.return_level = Know::Lost;
                self.state.level_changed |= self.state.cycle == InForce::Lost;
            }
            // It ends a cycle.
            Op::StraightTraverse(_) | Op::StraightFeed(_) => {
                self.state.cycle = InForce::None;
                self.state.after_cycle = false;
                self.state.rigid = false;
                self.state.motion = Know::Lost;
                (self.state.thread, self.state.lead) = (None, None);
                self.state.no_motion = false;
            }
            _ => return false,
        }
        true
    }
}

const ANY: &str =
    "code whose number may be anything: its variable has not, on every way to it, that of a code in force";

impl Computes {
    /// The text is over: whether each such variable has its value from its group on every way to the code.
    pub(super) fn check_saved(&self, out: &mut Batch) {
        if self.saved.back.is_empty() {
            return;
        }
        let mut faults = Vec::new();
        let mut bodies = vec![("", &out.stmts)];
        bodies.extend(out.procedures.iter().map(|procedure| (&*procedure.name, &procedure.body)));
        let mut set: Vec<Set> = Vec::new();
        for (_, body) in &bodies {
            let mut own = Set::default();
            own.body(body);
            set.push(own);
        }
        for (at, (_, body)) in bodies.iter().enumerate() {
            let mut others = Set::default();
            for (_, own) in set.iter().enumerate().filter(|(other, _)| *other != at) {
                others.any |= own.any;
                others.vars.extend(own.vars.iter().cloned());
            }
            let mut ways = Ways { saved: &self.saved, others, labels: BTreeMap::new(), wrong: Vec::new() };
            loop {
                let before = ways.labels.clone();
                ways.wrong.clear();
                ways.body(body, Some(Known::new()));
                if ways.labels == before {
                    break;
                }
            }
            faults.append(&mut ways.wrong);
        }
        for (span, var) in faults {
            let code = format!("G{var}").into();
            out.report(Fault::NotSupported { code, name: ANY.into() }, span);
        }
    }
}

/// The variables that statements set.
#[derive(Default)]
struct Set {
    vars: BTreeSet<String>,
    /// One whose number is computed.
    any: bool,
}

impl Set {
    fn body(&mut self, body: &[Stmt]) {
        for stmt in body {
            match &stmt.op {
                Op::Assign(Target::Var(var), _) => drop(self.vars.insert(key(var))),
                Op::Assign(Target::Element(_), _) => self.any = true,
                Op::Control(control) => control.bodies().for_each(|body| self.body(body)),
                _ => {}
            }
        }
    }

    fn takes_from(&self, known: &mut Known) {
        known.retain(|var, _| !self.any && !self.vars.contains(var));
    }
}

fn key(var: &Var) -> String {
    let kept = if let Var::Local(_) = var { "local" } else { "shared" };
    format!("{kept} {}", var.name())
}

/// What is known on the ways through a program.
struct Ways<'s> {
    saved: &'s Saved,
    /// What the other programs set.
    others: Set,
    /// What is known at labels, as far as jumps have led there.
    labels: BTreeMap<Text, Known>,
    wrong: Vec<(Span, Box<str>)>,
}

/// What is known where two ways meet.
fn meet(one: Option<Known>, other: Option<Known>) -> Option<Known> {
    match (one, other) {
        (Some(mut one), Some(other)) => {
            one.retain(|var, group| other.get(var) == Some(group));
            Some(one)
        }
        (one, other) => one.or(other),
    }
}

impl Ways<'_> {
    /// The group whose code in force a value is.
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
                let group = self.group(value);
                let known = known.as_mut()?;
                match group {
                    Some(group) => drop(known.insert(key(var), group)),
                    None => drop(known.remove(&key(var))),
                }
            }
            Op::Assign(Target::Element(_), _) => known.as_mut()?.clear(),
            Op::Call(call) => {
                let known = known.as_mut()?;
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
            Op::Return | Op::ProgramEnd | Op::Alarm(_) => return None,
            Op::Control(control) => {
                if let Some(code) = code_of(control)
                    && let Some((_, row, var)) = self.saved.back.iter().find(|(span, ..)| *span == stmt.span)
                    && let Some(known) = &known
                {
                    let group = known.get(&key(var)).map(|group| self.saved.rows[*group].2);
                    if !group.is_some_and(|group| std::ptr::eq(group, *row)) || code.codes.is_empty() {
                        self.wrong.push((stmt.span, format!("#{}", var.name()).into()));
                    }
                    return Some(known.clone());
                }
                return self.control(control, known);
            }
            _ => {}
        }
        known
    }

    fn control(&mut self, control: &ncc_ir::program::Control, known: Option<Known>) -> Option<Known> {
        use ncc_ir::program::Control::{For, If, Loop, Repeat, Until, While};
        match control {
            If { then, otherwise, .. } => {
                let then = self.body(then, known.clone());
                let otherwise = self.body(otherwise, known);
                meet(then, otherwise)
            }
            Repeat { body, .. }
            | Loop { body }
            | While { body, .. }
            | Until { body, .. }
            | For { body, .. } => {
                // Come to from its end as well.
                let mut own = Set::default();
                own.body(body);
                let mut known = known;
                if let Some(known) = &mut known {
                    own.takes_from(known);
                }
                let behind = self.body(body, known.clone());
                meet(known, behind)
            }
        }
    }
}

fn own((var, group): (&String, &usize)) -> (String, usize) {
    (var.clone(), *group)
}
