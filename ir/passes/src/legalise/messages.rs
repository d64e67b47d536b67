//! Messages to the operator, for a target that cannot show them, or only where the program stops; text for devices that it
//! does not write to.

use crate::pass::Pass;
use ncc_ir::caps::Caps;
use ncc_ir::computed::computes::ComputeFeature;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::OperatorLack;
use ncc_ir::program::{Op, Output, Piece, Program, Stmt, Text};
use ncc_ir::source::Span;

/// This pass.
pub(crate) const OUTPUT: Pass =
    Pass::named("leave-out-output", "leaves out what is written to devices that the target has not", None);

/// This pass.
pub(crate) const VALUES: Pass =
    Pass::named("leave-out-values", "leaves out of messages the values that the target cannot show", None);

/// A message that is a comment from here on, by what stands after it: where the program stops before another one takes its
/// place, the message asks the operator for an action.
fn lost(behind: &[Stmt]) -> Fault {
    if stops_first(behind) == Some(true) { Fault::MessageDropped } else { Fault::MessageAsComment }
}

/// Whether the program stops before the next message; `None` if it does neither.
fn stops_first(stmts: &[Stmt]) -> Option<bool> {
    stmts.iter().find_map(|stmt| match &stmt.op {
        Op::ProgramStop | Op::OptionalProgramStop => Some(true),
        Op::Message(_) | Op::MessageOf(_) => Some(false),
        // A stop on one of the ways counts.
        Op::Control(control) => control.bodies().find_map(|body| stops_first(body)).filter(|stops| *stops),
        _ => None,
    })
}

/// Messages become comments; those with which the program stops stay where the target has them, in the block of the
/// stop or in the one before it, in the characters that it shows. One without a text, which takes another back, is none
/// where none stays.
pub(super) fn drop_messages(stmts: &mut [Stmt], caps: &Caps, diags: &mut Vec<Diagnostic>) {
    let alarms = caps.flow.computes.as_ref().and_then(|target| target.alarms.as_ref());
    for at in 0..stmts.len() {
        let (before, behind) = stmts.split_at_mut(at + 1);
        let Some(stmt) = before.last_mut() else { continue };
        let Op::Message(text) = &mut stmt.op else { continue };
        let stops = behind.first().is_some_and(|next| next.op == Op::ProgramStop && next.skip == stmt.skip);
        if text.is_empty() {
            stmt.op = Op::Blank;
        } else if caps.modes.stop_messages && stops {
            if let Some(shown) = alarms.map(|alarms| alarms.shown(text)).filter(|shown| shown != text) {
                *text = shown;
                diags.push(Diagnostic::new(Fault::CommentReformatted, stmt.span));
            }
        } else {
            let text = std::mem::take(text);
            diags.push(Diagnostic::new(lost(behind), stmt.span));
            stmt.op = Op::Comment(text);
        }
    }
}

/// Messages with values become comments where the target shows no message while the program runs. What they read has no
/// effect on the cut.
pub fn leave_out_values(program: &mut Program, caps: &Caps, diags: &mut Vec<Diagnostic>) {
    let says = caps.flow.computes.as_ref().is_some_and(|target| target.has(ComputeFeature::Values));
    if !caps.modes.messages && !says {
        program.procedures.iter_mut().for_each(|procedure| values(&mut procedure.body, diags));
    }
}

/// Text for devices becomes comments where the target writes to none.
pub fn leave_out_output(program: &mut Program, caps: &Caps, diags: &mut Vec<Diagnostic>) {
    if !caps.flow.computes.as_ref().is_some_and(|target| target.has(ComputeFeature::Output)) {
        program.procedures.iter_mut().for_each(|procedure| output(&mut procedure.body, diags));
    }
}

fn output(stmts: &mut [Stmt], diags: &mut Vec<Diagnostic>) {
    for stmt in stmts {
        match &mut stmt.op {
            Op::Output(output) => {
                diags.push(Diagnostic::new(Fault::OutputDropped, stmt.span));
                stmt.op = match &**output {
                    Output::Line(pieces) if !pieces.is_empty() => Op::Comment(without_values(pieces)),
                    Output::Line(_) | Output::Open | Output::Close => Op::Blank,
                };
            }
            Op::Control(control) => control.bodies_mut().for_each(|stmts| output(stmts, diags)),
            _ => {}
        }
    }
}

/// What is assumed of text for a device of another control, and what is refused: `opened` is whether it must be
/// opened there.
pub fn output_elsewhere(program: &Program, opened: bool) -> Vec<Diagnostic> {
    let (mut opens, mut line, mut value) = (false, None, None);
    let bodies = program.procedures.iter().map(|procedure| &procedure.body);
    bodies.for_each(|body| written(body, &mut opens, &mut line, &mut value));
    let unopened = line
        .filter(|_| opened && !opens)
        .map(|at| Diagnostic::new(Fault::lacks(OperatorLack::DeviceNotOpened), at));
    let digits = value.map(|at| Diagnostic::new(Fault::AssumedFact { fact: ControlFact::DeviceValue }, at));
    unopened.into_iter().chain(digits).collect()
}

fn written(stmts: &[Stmt], opens: &mut bool, line: &mut Option<Span>, value: &mut Option<Span>) {
    for stmt in stmts {
        match &stmt.op {
            Op::Output(output) => match &**output {
                Output::Line(pieces) => {
                    line.get_or_insert(stmt.span);
                    if pieces.iter().any(|piece| matches!(piece, Piece::Value { .. })) {
                        value.get_or_insert(stmt.span);
                    }
                }
                Output::Open => *opens = true,
                Output::Close => {}
            },
            Op::Control(control) => {
                control.bodies().for_each(|body| written(body, opens, line, value));
            }
            _ => {}
        }
    }
}

/// A text that can be no more than a comment.
fn without_values(pieces: &[Piece]) -> Text {
    let text = pieces.iter().map(|piece| match piece {
        Piece::Text(text) => text,
        Piece::Value { .. } => "...",
    });
    text.collect::<String>().trim().into()
}

fn values(stmts: &mut [Stmt], diags: &mut Vec<Diagnostic>) {
    for at in 0..stmts.len() {
        let (before, behind) = stmts.split_at_mut(at + 1);
        let Some(stmt) = before.last_mut() else { continue };
        match &mut stmt.op {
            Op::MessageOf(pieces) => {
                diags.push(Diagnostic::new(lost(behind), stmt.span));
                stmt.op = Op::Comment(without_values(pieces));
            }
            Op::Control(control) => control.bodies_mut().for_each(|stmts| values(stmts, diags)),
            _ => {}
        }
    }
}
