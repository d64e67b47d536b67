//! `expand-calls`: subprograms are inlined.
//!
//! What a subprogram takes from its caller (motion or cycle active, distance mode, plane, units)
//! becomes what this caller has active.

use ncc_ir::unsupported::CallUnsupported;
use std::collections::{BTreeSet, HashMap, HashSet};

use crate::pass::{Pass, ProgramMoment, ProgramStep, Subprograms};
use crate::support::settle::settle;
use crate::support::walk::Walk;
use crate::support::write::Rebuild;
use crate::target::{MOST_STATEMENTS, Target};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::FlowLack;
use ncc_ir::program::{Call, Op, Procedure, Program, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "expand-calls",
    about: "writes subprograms out where they are called",
    alone: Some(run),
    step: None,
    program: &[ProgramStep {
        moment: ProgramMoment::Calls,
        needed: |_, p| matches!(p.subprograms, Subprograms::Expand | Subprograms::ExpandNamed(_)),
        // The walk is needed again for the other passes.
        run: |l, p| match p.subprograms {
            Subprograms::ExpandNamed(names) => some(p.program, &mut l.walk.clone(), names, p.diags),
            _ => inline_subprograms(p.program, &mut l.walk.clone(), p.diags),
        },
    }],
    parametric: None,
};

/// Writes the subprograms out; only the main procedure is left.
pub fn run(program: &mut Program, _: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    inline_subprograms(program, &mut Walk::new(entry.clone()), diags);
}

/// The same, with a walk that stands before the main procedure.
fn inline_subprograms(program: &mut Program, walk: &mut Walk, diags: &mut Vec<Diagnostic>) {
    let names = program.procedures.iter().skip(1).map(|sub| sub.name.clone()).collect();
    some(program, walk, &names, diags);
}

/// Writes out those subprograms that are named, wherever they are called; the others stay.
fn some(program: &mut Program, walk: &mut Walk, names: &BTreeSet<Text>, diags: &mut Vec<Diagnostic>) {
    let procedures = std::mem::take(&mut program.procedures);
    let subs = procedures.iter().skip(1).map(|p| (&*p.name, p)).collect();
    let kept = procedures.iter().skip(1).map(|p| &*p.name).filter(|name| !names.contains(*name)).collect();
    for (at, procedure) in procedures.iter().enumerate() {
        if at > 0 && names.contains(&procedure.name) {
            continue;
        }
        let mut inliner = Inliner {
            subs: &subs,
            kept: &kept,
            stack: Vec::new(),
            calls: 0,
            walk: if at == 0 { std::mem::take(walk) } else { Walk::new(Tracker::unknown()) },
            diags,
            full: false,
        };
        let mut made = Rebuild::new(procedure.body.len());
        inliner.body(&procedure.body, None, &mut made);
        if at == 0 {
            *walk = inliner.walk;
        }
        program.procedures.push(Procedure { body: made.out, ..procedure.clone() });
    }
}

struct Inliner<'a> {
    subs: &'a HashMap<&'a str, &'a Procedure>,
    /// Those that are not inlined.
    kept: &'a HashSet<&'a str>,
    stack: Vec<&'a str>,
    /// Number of calls inlined so far.
    calls: usize,
    walk: Walk,
    diags: &'a mut Vec<Diagnostic>,
    /// There is no room for more.
    full: bool,
}

impl<'a> Inliner<'a> {
    /// Writes a body out; `skip` is the level under which it was called.
    fn body(&mut self, body: &'a [Stmt], skip: Option<u8>, made: &mut Rebuild) {
        let called = !self.stack.is_empty();
        for stmt in body {
            let mut stmt = stmt.clone();
            if called {
                stmt.number = None;
                if let Err(fault) = also_skipped(&mut stmt, skip) {
                    self.diags.push(Diagnostic::new(fault, stmt.span));
                }
            }
            self.walk.enter(stmt.skip);
            match &mut stmt.op {
                Op::Call(call) if !self.kept.contains(&*call.name) => {
                    let call = std::mem::replace(
                        &mut **call,
                        Call { name: "".into(), times: 0, arguments: Vec::new(), shared: false },
                    );
                    let (span, skip) = (stmt.span, stmt.skip);
                    made.leave_out(stmt);
                    self.call(&call, span, skip, made);
                }
                Op::Return if called => {
                    if stmt.skip != skip {
                        self.diags.push(Diagnostic::new(Fault::lacks(FlowLack::ReturnSkipped), stmt.span));
                    }
                    made.leave_out(stmt);
                    return;
                }
                Op::Control(control) => {
                    for body in control.bodies_mut() {
                        self.nested(body);
                    }
                    self.walk.step(&stmt);
                    made.push(stmt);
                }
                Op::Goto(_) | Op::Label(_) if called => {
                    self.diags.push(Diagnostic::new(Fault::lacks(FlowLack::SubprogramJumps), stmt.span));
                    made.leave_out(stmt);
                }
                op => {
                    settle(op, &self.walk.at);
                    self.walk.step(&stmt);
                    made.push(stmt);
                }
            }
            if self.full {
                return;
            }
        }
    }

    /// A body that is not run straight through: what holds at its start is not known.
    fn nested(&mut self, body: &mut Vec<Stmt>) {
        let before = std::mem::take(&mut self.walk);
        let input = std::mem::take(body);
        let mut made = Rebuild::new(input.len());
        for stmt in input {
            if let Op::Call(call) = &stmt.op
                && !self.kept.contains(&*call.name)
            {
                let (call, span, skip) = ((**call).clone(), stmt.span, stmt.skip);
                self.walk.enter(skip);
                made.leave_out(stmt);
                self.call(&call, span, skip, &mut made);
            } else {
                self.walk.step(&stmt);
                made.push(stmt);
            }
        }
        *body = made.out;
        self.walk = before;
    }

    fn call(&mut self, call: &Call, span: Span, skip: Option<u8>, made: &mut Rebuild) {
        let Some((name, sub)) = self.subs.get_key_value(&*call.name).map(|(n, p)| (*n, *p)) else {
            return self.refuse(Fault::CallUnknown { name: call.name.clone() }, span);
        };
        if self.stack.contains(&name) {
            return self.refuse(Fault::CallRecursive { name: call.name.clone() }, span);
        }
        if !sub.parameters.is_empty() || !call.arguments.is_empty() {
            return self.refuse(Fault::not_supported(&*call.name, CallUnsupported::Arguments), span);
        }
        let fault = Fault::CallExpanded { name: call.name.clone(), times: call.times };
        self.diags.push(Diagnostic::new(fault, span));
        self.stack.push(name);
        for _ in 0..call.times {
            self.calls += 1;
            self.body(&sub.body, skip, made);
            if made.out.len().max(self.calls) > MOST_STATEMENTS && !self.full {
                self.full = true;
                self.refuse(Fault::lacks(FlowLack::CallsTooLong), span);
            }
            if self.full {
                break;
            }
        }
        self.stack.pop();
    }

    fn refuse(&mut self, fault: Fault, span: Span) {
        self.diags.push(Diagnostic::new(fault, span));
    }
}

/// Puts a statement under a further skip level.
pub(crate) fn also_skipped(stmt: &mut Stmt, skip: Option<u8>) -> Result<(), Fault> {
    match (stmt.skip, skip) {
        (Some(a), Some(b)) if a != b => Err(Fault::lacks(FlowLack::TwoSkipLevels)),
        _ => {
            stmt.skip = stmt.skip.or(skip);
            Ok(())
        }
    }
}
