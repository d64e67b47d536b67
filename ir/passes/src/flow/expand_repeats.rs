//! `expand-repeats`: repetitions are unrolled, or written in the target's form.
//!
//! A repetition of a body with a known count, and one of blocks between labels, can each stand for
//! the other. A target that has neither gets the blocks one after another; labels that only served
//! a repetition are gone then.

use std::collections::BTreeSet;

use crate::flow::repeat_ends;
use crate::pass::{Moment, Pass, ProgramMoment, ProgramStep, Step, Subprograms};
use crate::support::needs::CONTROL;
use crate::support::write::{Rebuild, rebuild};
use crate::target::{MOST_STATEMENTS, Target};
use ncc_exec::again;
use ncc_ir::caps::Caps;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::lack::FlowLack;
use ncc_ir::program::{Control, Op, Program, RepeatBlocks, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const COMPUTED: Pass = Pass::parametric(
    "computed-repeats",
    "writes out repetitions that the target cannot say where a program computes",
    |_, _| true,
    |program, own, found| where_it_computes(program, own.caps, found),
);

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "expand-repeats",
    about: "writes counted repetitions out",
    alone: Some(run),
    step: Step::at(
        Moment::Placing,
        |_, p| p.needs(CONTROL),
        |l, p| expand_repetitions(p.stmts, &l.target, p.diags),
    ),
    program: &[
        ProgramStep {
            moment: ProgramMoment::Repetitions,
            needed: |_, _| true,
            run: |_, p| everywhere(p.program, p.diags),
        },
        ProgramStep {
            moment: ProgramMoment::SubprogramRepetitions,
            needed: |_, p| p.subprograms == Subprograms::Expand,
            run: |l, p| in_procedures(p.program, l.target.caps.flow.repeat_blocks, p.diags),
        },
    ],
    parametric: None,
};

/// Deepest nesting of repetitions of blocks.
const DEEPEST: u32 = 64;

/// Writes them out, or says them in the target's form.
pub fn run(program: &mut Program, target: &Target, _: &Tracker, diags: &mut Vec<Diagnostic>) {
    for procedure in &mut program.procedures {
        expand_repetitions(&mut procedure.body, target, diags);
    }
}

/// The same for one body.
pub(crate) fn expand_repetitions(body: &mut Vec<Stmt>, target: &Target, diags: &mut Vec<Diagnostic>) {
    let caps = &target.caps;
    if !caps.flow.repeats {
        if caps.flow.repeat_blocks {
            by_labels(body, &labels(body), &mut 0, diags);
        } else {
            bodies(body, diags);
        }
    }
    let nowhere = |s: &Stmt| matches!(s.op, Op::Label(_)) && !caps.flow.repeats;
    if !caps.flow.repeat_blocks && (has_blocks(body) || body.iter().any(nowhere)) {
        blocks(body, caps.flow.repeats, diags);
    }
    if caps.flow.repeat_by_numbers && has_blocks(body) {
        if repeat_ends::nested(body) {
            return blocks(body, false, diags);
        }
        repeat_ends::name(body, &labels(body));
    }
}

/// Unrolls repetitions of blocks, before subprograms are inlined; `but_main` leaves those of
/// the main program.
fn in_procedures(program: &mut Program, but_main: bool, diags: &mut Vec<Diagnostic>) {
    for procedure in program.procedures.iter_mut().skip(usize::from(but_main)) {
        if has_blocks(&procedure.body) {
            blocks(&mut procedure.body, false, diags);
        }
    }
}

/// Whether a program repeats blocks.
pub(crate) fn repeats_blocks(program: &Program) -> bool {
    program.procedures.iter().any(|p| has_blocks(&p.body))
}

/// Writes every repetition out.
fn everywhere(program: &mut Program, diags: &mut Vec<Diagnostic>) {
    for procedure in &mut program.procedures {
        expand_repetitions(&mut procedure.body, &Target::default(), diags);
    }
}

/// Writes repetitions of blocks out where a program computes, for a target that has no such words: those of blocks that
/// no jump leads out of, or into. Others are left to be refused.
pub fn where_it_computes(program: &mut Program, target: &Caps, diags: &mut Vec<Diagnostic>) {
    if target.flow.repeat_blocks {
        return;
    }
    for procedure in &mut program.procedures {
        let body = &mut procedure.body;
        if has_blocks(body) && are_straight(body) {
            blocks(body, target.flow.repeats, diags);
        }
    }
}

/// Whether no jump leads out of the blocks that are repeated, or into them.
fn are_straight(body: &[Stmt]) -> bool {
    let jumps = jumps(body);
    let crossed = |op: &Op| match op {
        Op::Goto(_) => true,
        Op::Label(name) => jumps.contains(name),
        _ => false,
    };
    body.iter().enumerate().all(|(at, stmt)| match &stmt.op {
        Op::RepeatBlocks(repeat) => {
            let found = again(body, at, &repeat.from, repeat.to.as_deref());
            found.is_some_and(|found| !found.iter().any(|stmt| says(stmt, &crossed)))
        }
        _ => !says(stmt, &|op| matches!(op, Op::RepeatBlocks(_))),
    })
}

/// Whether a statement, or one within its structure, is such a one.
fn says(stmt: &Stmt, such: &dyn Fn(&Op) -> bool) -> bool {
    such(&stmt.op)
        || matches!(&stmt.op, Op::Control(control) if control.bodies().flatten().any(|stmt| says(stmt, such)))
}

/// Labels that jumps of a body name, those within its structures too.
fn jumps(body: &[Stmt]) -> BTreeSet<Text> {
    let mut found = BTreeSet::new();
    for stmt in body {
        match &stmt.op {
            Op::Goto(label) => {
                found.insert(label.clone());
            }
            Op::Control(control) => control.bodies().for_each(|body| found.append(&mut jumps(body))),
            _ => {}
        }
    }
    found
}

fn has_blocks(body: &[Stmt]) -> bool {
    body.iter().any(|s| matches!(s.op, Op::RepeatBlocks(_)))
}

/// Writes repetitions of blocks out; `as_body` puts a repetition of a body in their place.
fn blocks(body: &mut Vec<Stmt>, as_body: bool, diags: &mut Vec<Diagnostic>) {
    let jumps = jumps(body);
    let input = std::mem::take(body);
    let mut made = Rebuild::new(input.len());
    let mut full = false;
    flatten(&input, None, &jumps, as_body, 0, &mut made, &mut full, diags);
    *body = made.out;
}

/// Passes statements on, repetitions of blocks as what they execute.
#[allow(clippy::too_many_arguments)]
fn flatten(
    body: &[Stmt],
    under: Option<Option<u8>>,
    jumps: &BTreeSet<Text>,
    as_body: bool,
    depth: u32,
    made: &mut Rebuild,
    full: &mut bool,
    diags: &mut Vec<Diagnostic>,
) {
    for (at, stmt) in body.iter().enumerate() {
        if *full {
            return;
        }
        let mut stmt = stmt.clone();
        let span = stmt.span;
        if let Some(skip) = under {
            stmt.number = None;
            if let Err(fault) = crate::flow::expand_calls::also_skipped(&mut stmt, skip) {
                diags.push(Diagnostic::new(fault, span));
            }
        }
        match &stmt.op {
            // In what is passed again a label would stand twice.
            Op::Label(name) if !jumps.contains(name) => made.leave_out(stmt),
            Op::Label(_) | Op::Goto(_) if under.is_some() => {
                cannot(FlowLack::RepetitionJumps, span, diags);
                made.leave_out(stmt);
            }
            Op::RepeatBlocks(repeat) => {
                let RepeatBlocks { from, to, times } = &**repeat;
                let (times, skip) = (times.clone(), stmt.skip);
                let Some(blocks) = again(body, at, from, to.as_deref()) else {
                    let name = from.clone();
                    diags.push(Diagnostic::new(Fault::LabelUnknown { name }, span));
                    made.push(stmt);
                    continue;
                };
                if depth >= DEEPEST {
                    cannot(FlowLack::RepetitionDepth, span, diags);
                    *full = true;
                    return;
                }
                let written =
                    times.literal().and_then(|n| n.whole_number()).and_then(|n| u32::try_from(n).ok());
                if let (None, Some(times)) = (under, written) {
                    diags.push(Diagnostic::new(Fault::RepeatExpanded { times }, span));
                }
                if as_body || written.is_none() {
                    let mut inner = Rebuild::new(blocks.len());
                    flatten(blocks, Some(None), jumps, true, depth + 1, &mut inner, full, diags);
                    stmt.op = Op::Control(Box::new(Control::Repeat { times, body: inner.out }));
                    made.push(stmt);
                    continue;
                }
                made.leave_out(stmt);
                for _ in 0..written.unwrap_or_default() {
                    flatten(blocks, Some(skip), jumps, false, depth + 1, made, full, diags);
                    if *full {
                        return;
                    }
                    if made.out.len() > MOST_STATEMENTS {
                        *full = true;
                        return cannot(FlowLack::RepetitionTooLong, span, diags);
                    }
                }
            }
            _ => made.push(stmt),
        }
    }
}

fn cannot(lack: FlowLack, span: Span, diags: &mut Vec<Diagnostic>) {
    diags.push(Diagnostic::new(Fault::lacks(lack), span));
}

/// Says repetitions of a body by labels: the body once, and its blocks again.
fn by_labels(body: &mut Vec<Stmt>, known: &BTreeSet<Text>, last: &mut u32, diags: &mut Vec<Diagnostic>) {
    rebuild(body, |mut stmt, made| {
        let Stmt { span, skip, .. } = stmt;
        let Some((times, mut inner)) = repeat_of(&mut stmt) else { return made.push(stmt) };
        let Some(times) = times.literal().and_then(|n| n.whole_number()).and_then(|n| u32::try_from(n).ok())
        else {
            cannot(FlowLack::RepetitionComputed, span, diags);
            return made.push(stmt);
        };
        by_labels(&mut inner, known, last, diags);
        made.leave_out(stmt);
        let name = loop {
            *last += 1;
            let name: Text = format!("AGAIN{last}").into();
            if !known.contains(&name) {
                break name;
            }
        };
        if times == 0 {
            return;
        }
        let mut put = |op: Op| {
            let mut new = Stmt::new(span, op);
            new.skip = skip;
            made.push(new);
        };
        put(Op::Label(name.clone()));
        for mut stmt in inner {
            if let Err(fault) = crate::flow::expand_calls::also_skipped(&mut stmt, skip) {
                diags.push(Diagnostic::new(fault, span));
            }
            made.push(stmt);
        }
        if times > 1 {
            let op = Op::RepeatBlocks(Box::new(RepeatBlocks {
                from: name,
                to: None,
                times: Expr::int(i64::from(times - 1)),
            }));
            let mut new = Stmt::new(span, op);
            new.skip = skip;
            made.push(new);
        }
    });
}

/// The labels of a body.
fn labels(body: &[Stmt]) -> BTreeSet<Text> {
    let label = |s: &Stmt| match &s.op {
        Op::Label(name) => Some(name.clone()),
        _ => None,
    };
    body.iter().filter_map(label).collect()
}

/// The count and body of a repetition, taken out of its statement.
fn repeat_of(stmt: &mut Stmt) -> Option<(Expr, Vec<Stmt>)> {
    let Op::Control(control) = &mut stmt.op else { return None };
    match &mut **control {
        Control::Repeat { times, body } => Some((times.clone(), std::mem::take(body))),
        Control::Loop { .. }
        | Control::While { .. }
        | Control::Until { .. }
        | Control::For { .. }
        | Control::If { .. } => None,
    }
}

/// Writes repetitions of a body out.
fn bodies(body: &mut Vec<Stmt>, diags: &mut Vec<Diagnostic>) {
    rebuild(body, |stmt, made| {
        let Stmt { span, skip, .. } = stmt;
        let (times, inner) = match &stmt.op {
            Op::Control(control) => match &**control {
                Control::Repeat { times, body } => (times.literal().and_then(|n| n.whole_number()), body),
                Control::Loop { .. }
                | Control::While { .. }
                | Control::Until { .. }
                | Control::For { .. }
                | Control::If { .. } => {
                    return made.push(stmt);
                }
            },
            _ => return made.push(stmt),
        };
        let Some(times) = times.and_then(|n| u32::try_from(n).ok()) else {
            diags.push(Diagnostic::new(Fault::lacks(FlowLack::RepetitionComputed), span));
            return made.push(stmt);
        };
        diags.push(Diagnostic::new(Fault::RepeatExpanded { times }, span));
        let mut inner = inner.clone();
        bodies(&mut inner, diags);
        if inner.len().saturating_mul(times as usize) > MOST_STATEMENTS {
            diags.push(Diagnostic::new(Fault::lacks(FlowLack::RepetitionTooLong), span));
            return made.push(stmt);
        }
        made.leave_out(stmt);
        for _ in 0..times {
            for stmt in &inner {
                let mut stmt = stmt.clone();
                stmt.number = None;
                if let Err(fault) = crate::flow::expand_calls::also_skipped(&mut stmt, skip) {
                    diags.push(Diagnostic::new(fault, span));
                }
                made.push(stmt);
            }
        }
    });
}
