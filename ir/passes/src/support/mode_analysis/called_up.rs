//! Holes that activate their cycles by themselves, and the calls that have served only such holes.

use std::collections::HashMap;

use super::called::Called;
use crate::support::settle::settle;
use ncc_ir::program::cycle::Cycle;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Op, Procedure, Program, Stmt};
use ncc_ir::track::Tracker;

/// Has holes activate their cycles. Where all of them do, in whatever program, what has called them up is left out.
pub(super) fn call_up_all(program: &mut Program, cycles: &HashMap<u32, Option<Called>>, bare: bool) {
    let calls = calls_of(program);
    let (mut any, mut all) = (false, true);
    for Procedure { body, .. } in &mut program.procedures {
        let served = call_up(body, (cycles, &calls), bare);
        any |= served;
        all &= served || !has_bare_holes(body);
    }
    if any && all {
        program.procedures.iter_mut().for_each(|procedure| without_holes(&mut procedure.body));
    }
}

/// The calls of cycles, by their places.
fn calls_of(program: &Program) -> HashMap<u32, Cycle> {
    fn collect_calls(body: &[Stmt], out: &mut HashMap<u32, Cycle>) {
        for stmt in body {
            match &stmt.op {
                Op::StartCycle(cycle) => out.insert(stmt.span.start, (**cycle).clone()),
                Op::Control(control) => {
                    control.bodies().for_each(|body| collect_calls(body, out));
                    None
                }
                _ => None,
            };
        }
    }
    let mut out = HashMap::new();
    program.procedures.iter().for_each(|procedure| collect_calls(&procedure.body, &mut out));
    out
}

/// Which cycles are active at holes, and their calls.
type Calls<'c> = (&'c HashMap<u32, Option<Called>>, &'c HashMap<u32, Cycle>);

/// Holes at which a cycle is active activate it by themselves; with `bare`, words too of which only the run knows
/// that they are holes. Tells whether there are any, and all of them do.
fn call_up(body: &mut Vec<Stmt>, from: Calls, bare: bool) -> bool {
    let mut out = Vec::with_capacity(body.len());
    let (mut any, mut all, mut called) = (false, true, false);
    for mut stmt in std::mem::take(body) {
        called &= !matches!(stmt.op, flow!());
        called |= matches!(stmt.op, Op::StartCycle(_));
        if let Op::Control(control) = &mut stmt.op {
            for body in control.bodies_mut() {
                let (served, holes) = (call_up(body, from, bare), has_bare_holes(body));
                any |= served;
                all &= served || !holes;
            }
        }
        let hole = match &stmt.op {
            Op::Position(to) if bare => Some(Op::Hole(to.clone())),
            Op::Position(_) => {
                all = false;
                None
            }
            Op::Hole(_) | Op::Pattern(_) if !called => Some(stmt.op.clone()),
            _ => None,
        };
        let called = from.0.get(&stmt.span.start).copied().flatten();
        match (hole, called.and_then(|called| Some((called, from.1.get(&called.at)?)))) {
            (Some(mut hole), Some((called, cycle))) => {
                any = true;
                let mut cycle = Op::StartCycle(Box::new(cycle.clone()));
                settle(&mut cycle, &Tracker::new(called.with));
                settle(&mut hole, &Tracker::new(called.modes));
                let hole = Stmt { op: hole, joined: true, number: None, ..stmt.clone() };
                out.push(Stmt { op: cycle, comment: None, ..stmt });
                out.push(hole);
            }
            (hole, _) => {
                all &= hole.is_none();
                out.push(stmt);
            }
        }
    }
    *body = out;
    any && all
}

/// Whether holes stand in a stretch before any cycle has been activated there.
pub fn has_bare_holes(body: &[Stmt]) -> bool {
    let mut called = false;
    body.iter().any(|stmt| {
        called &= !matches!(stmt.op, flow!());
        match &stmt.op {
            Op::StartCycle(_) => {
                called = true;
                false
            }
            Op::Hole(_) | Op::Pattern(_) => !called,
            Op::Position(_) => true,
            Op::Control(control) => control.bodies().any(|body| has_bare_holes(body)),
            _ => false,
        }
    })
}

/// Whether programs are called here, or blocks repeated.
fn has_calls(stmt: &Stmt) -> bool {
    match &stmt.op {
        Op::Call(_) | Op::RepeatBlocks(_) => true,
        Op::Control(control) => control.bodies().flatten().any(has_calls),
        _ => false,
    }
}

/// Calls of cycles that make no hole before control goes another way leave their feed unchanged.
fn without_holes(body: &mut [Stmt]) {
    let mut idle = None;
    for at in 0..body.len() {
        match &mut body[at].op {
            Op::StartCycle(_) => idle = Some(at),
            Op::Hole(_) | Op::Pattern(_) | Op::Position(_) => idle = None,
            op if matches!(op, flow!()) => {
                if let Op::Control(control) = op {
                    control.bodies_mut().for_each(|body| without_holes(body));
                }
                if let Some(call) = idle.take().filter(|_| !has_calls(&body[at]))
                    && let Op::StartCycle(cycle) = &mut body[call].op
                {
                    body[call].op = cycle.feed.take().map_or(Op::Blank, Op::SetFeedRate);
                }
            }
            _ => {}
        }
    }
}
