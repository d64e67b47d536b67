//! `passed-labels`: labels that no jump names are left out, and facts are known after them again.
//!
//! A reader that does not see its text's end takes every block with a number for one that may be jumped to. When it
//! has seen it, what the text has said before such a block holds after it too. At other labels, and after all else
//! that leads another way, no more is known than the reader knew.
//!
//! Not here: names that blocks are repeated by.

use crate::pass::Pass;
use std::collections::HashSet;

use crate::support::settle::settle;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Op, Program, Stmt, Text};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass::named("unused-labels", "leaves out labels that no jump leads to", None);

/// Leaves them out.
pub fn run(program: &mut Program) {
    for procedure in &mut program.procedures {
        let mut named = HashSet::new();
        if !names(&procedure.body, &mut named) || !leave_out(&mut procedure.body, &named) {
            continue;
        }
        join(&mut procedure.body);
    }
}

/// Finds the labels that jumps name; false if blocks are repeated.
fn names(body: &[Stmt], named: &mut HashSet<Text>) -> bool {
    body.iter().all(|stmt| match &stmt.op {
        Op::Goto(name) => {
            named.insert(name.clone());
            true
        }
        Op::RepeatBlocks(_) => false,
        Op::Control(control) => control.bodies().all(|body| names(body, named)),
        _ => true,
    })
}

/// Leaves out all other labels that stand for themselves; tells whether there were any.
fn leave_out(body: &mut Vec<Stmt>, named: &HashSet<Text>) -> bool {
    let before = body.len();
    let mut out: Vec<Stmt> = Vec::with_capacity(before);
    // The block that stood after the label has its number.
    let (mut number, mut left_out_one) = (None, false);
    for mut stmt in std::mem::take(body) {
        if matches!(&stmt.op, Op::Label(name) if !named.contains(name)) {
            let Some(comment) = stmt.comment.take() else {
                number = stmt.number.take();
                continue;
            };
            left_out_one = true;
            stmt.op = Op::Comment(*comment);
        }
        if let Some(number) = number.take() {
            stmt.joined = false;
            stmt.number.get_or_insert(number);
        }
        out.push(stmt);
    }
    *body = out;
    let mut any = body.len() < before || left_out_one;
    for stmt in body {
        if let Op::Control(control) = &mut stmt.op {
            any = control.bodies_mut().map(|body| leave_out(body, named)).fold(any, |any, own| any | own);
        }
    }
    any
}

/// Puts in what is stated since the last place that is a jump target.
fn join(body: &mut [Stmt]) {
    let mut at = Tracker::unknown();
    for stmt in body {
        if let Op::Control(control) = &mut stmt.op {
            control.bodies_mut().for_each(|body| join(body));
        }
        if matches!(stmt.op, flow!()) {
            at = Tracker::unknown();
            continue;
        }
        settle(&mut stmt.op, &at);
        let before = stmt.skip.is_some().then(|| at.clone());
        at.apply(&stmt.op);
        if let Some(before) = before {
            at.join(&before);
        }
    }
}
