//! `specialise-procedures`: what a subprogram takes from its callers becomes what they have active.
//!
//! A subprogram whose callers agree keeps its name. One of which they make different things becomes
//! several, one for each: the first keeps the name, the others get names of their own, in the order
//! of the calls. Where the tool stands is not settled: that differs from call to call as a rule. Subprograms with
//! arguments, that call themselves, or that are called under structured control stay as they are.

use std::collections::{BTreeMap, BTreeSet};

use crate::pass::{Pass, ProgramMoment, ProgramStep, Subprograms};
use crate::support::settle::{settle, settle_point};
use crate::support::walk::Walk;
use crate::target::{MOST_STATEMENTS, Target};
use ncc_ir::canon::Motion;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::{Op, Procedure, Program, Stmt, Text};
use ncc_ir::track::Tracker;

/// This pass. It comes before subprograms are inlined: what callers disagree about may be all that is missing.
pub(crate) const PASS: Pass = Pass {
    name: "specialise-procedures",
    about: "specialises subprograms for the active modes of their callers, a copy for each that differs",
    alone: Some(run),
    step: None,
    program: &[ProgramStep {
        moment: ProgramMoment::Calls,
        needed: |_, p| p.subprograms == Subprograms::Specialise,
        run: |l, p| specialise_subprograms(p.program, &l.walk, l.target.caps.flow.inherits_motion, p.diags),
    }],
    parametric: None,
};

/// Times that a repeated call is looked at until what holds before it does not change any more.
const MOST_TURNS: u32 = 8;

/// Settles the subprograms.
pub fn run(program: &mut Program, _: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    specialise_subprograms(program, &Walk::new(entry.clone()), false, diags);
}

/// The same, with a walk that stands before the main procedure. With `inherits`, positions under a
/// caller's cycle stay what they are: the target's subprograms take the cycle from their callers too,
/// so that one serves under several.
fn specialise_subprograms(program: &mut Program, walk: &Walk, inherits: bool, diags: &mut Vec<Diagnostic>) {
    let Some((main, subs)) = program.procedures.split_first() else { return };
    let mut names: BTreeSet<Text> = subs.iter().map(|p| p.name.clone()).collect();
    names.extend(program.name.number.map(|n| n.to_string().into()));
    let mut fixed = BTreeSet::new();
    program.procedures.iter().for_each(|p| in_control(&p.body, false, &mut fixed));
    let mut settler =
        Settler { subs, names, fixed, made: Vec::new(), stack: Vec::new(), statements: 0, inherits };
    let (body, _) = settler.body(&main.body, walk.clone());
    let Settler { made, statements, .. } = settler;
    if statements > MOST_STATEMENTS {
        return;
    }
    let mut procedures = vec![Procedure { body, ..main.clone() }];
    // Looking at repeated calls makes more than is called in the end.
    let called = called(&procedures[0].body, &made);
    for sub in subs {
        let mut own: Vec<&Made> =
            made.iter().filter(|m| m.of == sub.name && called.contains(&m.procedure.name)).collect();
        own.dedup_by(|a, b| a.procedure.name == b.procedure.name);
        if own.is_empty() {
            procedures.push(sub.clone());
        }
        for one in own {
            if one.procedure.name != sub.name {
                let (from, to) = (sub.name.clone(), one.procedure.name.clone());
                let span = sub.body.first().map(|s| s.span).unwrap_or_default();
                diags.push(Diagnostic::new(Fault::NameChanged { from, to }, span));
            }
            procedures.push(one.procedure.clone());
        }
    }
    program.procedures = procedures;
}

/// A subprogram with what one caller has active.
struct Made {
    /// Its name in the program.
    of: Text,
    procedure: Procedure,
}

struct Settler<'p> {
    subs: &'p [Procedure],
    names: BTreeSet<Text>,
    /// What is called where this pass does not look.
    fixed: BTreeSet<Text>,
    made: Vec<Made>,
    stack: Vec<Text>,
    statements: usize,
    /// Positions under the cycle of a caller stay positions.
    inherits: bool,
}

impl Settler<'_> {
    /// A body with what holds in it, and what holds after it.
    fn body(&mut self, body: &[Stmt], mut walk: Walk) -> (Vec<Stmt>, Tracker) {
        let mut out = Vec::with_capacity(body.len());
        let mut left: Option<Tracker> = None;
        let mut over = false;
        self.statements += body.len();
        for stmt in body {
            let mut stmt = stmt.clone();
            if over || self.statements > MOST_STATEMENTS {
                out.push(stmt);
                continue;
            }
            walk.enter(stmt.skip);
            match &mut stmt.op {
                Op::Call(call) if call.arguments.is_empty() && self.can_settle(&call.name) => {
                    if let Some((name, behind)) = self.call(&call.name, call.times, &walk) {
                        call.name = name;
                        walk.at = behind;
                    }
                }
                Op::Return => {
                    let here = walk.at.clone();
                    left = Some(joined(left, here));
                    over = stmt.skip.is_none();
                    walk.step(&stmt);
                }
                Op::Position(m)
                    if self.inherits
                        && !self.stack.is_empty()
                        && walk.at.modes.motion == Some(Motion::Cycle) =>
                {
                    settle_point(&mut m.to, &walk.at);
                    walk.step(&stmt);
                }
                op => {
                    settle(op, &walk.at);
                    walk.step(&stmt);
                }
            }
            out.push(stmt);
        }
        walk.enter(None);
        let behind = match (left, over) {
            (Some(left), true) => left,
            (left, _) => joined(left, walk.at),
        };
        (out, behind)
    }

    fn can_settle(&self, name: &str) -> bool {
        let sub = self.subs.iter().find(|p| *p.name == *name);
        let free = !self.fixed.contains(name) && sub.is_some_and(|p| p.parameters.is_empty());
        free && !self.stack.iter().any(|s| **s == *name)
    }

    /// The subprogram that is called in the other's place, and what holds after the call.
    fn call(&mut self, name: &Text, times: u32, walk: &Walk) -> Option<(Text, Tracker)> {
        let subs = self.subs;
        let sub = subs.iter().find(|p| p.name == *name)?;
        if times == 0 {
            return None;
        }
        self.stack.push(name.clone());
        let mut entry = walk.clone();
        entry.enter(None);
        let mut settled = self.body(&sub.body, entry.clone());
        if times > 1 {
            // Every turn but the first begins where the one before ended.
            for turn in 0.. {
                let before = joined(Some(entry.at.clone()), settled.1.clone());
                if before == entry.at {
                    break;
                }
                entry.at = if turn < MOST_TURNS { before } else { Tracker::unknown() };
                settled = self.body(&sub.body, entry.clone());
                if turn >= MOST_TURNS {
                    break;
                }
            }
        }
        self.stack.pop();
        let (body, behind) = settled;
        let same = |m: &&Made| m.of == *name && m.procedure.body == body;
        if let Some(found) = self.made.iter().find(same) {
            return Some((found.procedure.name.clone(), behind));
        }
        let first = !self.made.iter().any(|m| m.of == *name);
        let new = if first { name.clone() } else { free(&mut self.names, name) };
        let procedure = Procedure { name: new.clone(), body, ..sub.clone() };
        self.made.push(Made { of: name.clone(), procedure });
        Some((new, behind))
    }
}

/// A name that nothing has: the next number, or the name with a number after it.
pub(crate) fn free(names: &mut BTreeSet<Text>, name: &str) -> Text {
    let number = name.parse::<u32>().ok();
    let mut k = 1u32;
    loop {
        k = k.saturating_add(1);
        let new: Text = match number {
            Some(number) => number.saturating_add(k - 1).to_string().into(),
            None => format!("{name}_{k}").into(),
        };
        if names.insert(new.clone()) {
            return new;
        }
    }
}

/// Names that are called in bodies of structured control, or with arguments.
fn in_control(body: &[Stmt], inside: bool, found: &mut BTreeSet<Text>) {
    for stmt in body {
        match &stmt.op {
            Op::Call(call) if inside || !call.arguments.is_empty() => {
                found.insert(call.name.clone());
            }
            Op::Control(control) => {
                for body in control.bodies() {
                    in_control(body, true, found);
                }
            }
            _ => {}
        }
    }
}

/// What holds on both of two ways.
fn joined(one: Option<Tracker>, mut other: Tracker) -> Tracker {
    if let Some(one) = one {
        other.join(&one);
    }
    other
}

/// Names of what is called, directly or not.
fn called(main: &[Stmt], made: &[Made]) -> BTreeSet<Text> {
    let bodies: BTreeMap<&Text, &[Stmt]> =
        made.iter().map(|m| (&m.procedure.name, &m.procedure.body[..])).collect();
    let mut found: BTreeSet<Text> = BTreeSet::new();
    let mut rest = vec![main];
    while let Some(body) = rest.pop() {
        for stmt in body {
            let Op::Call(call) = &stmt.op else { continue };
            if found.insert(call.name.clone())
                && let Some(body) = bodies.get(&call.name)
            {
                rest.push(body);
            }
        }
    }
    found
}
