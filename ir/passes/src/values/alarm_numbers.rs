//! Alarms under the numbers that the target has, or with their number before the text where it has none
//! ([`ncc_ir::alarms`]), and reported; so is a text that ends before its end.
//!
//! The numbers of alarms that are computed stay. Not here: alarms that the target gives by itself.

use crate::pass::Pass;
use ncc_ir::alarms::{AlarmMapped, AlarmName, Alarms};
use ncc_ir::computed::computed_call::NO_SUCH_PROGRAM;
use ncc_ir::computed::computed_code::NO_SUCH_CODE;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::program::{Alarm, NO_SUCH_BLOCK, Op, Program, Stmt};
use ncc_ir::source::Span;

/// This pass.
pub(crate) const TEXTS: Pass =
    Pass::named("alarm-texts", "says texts of alarms in the target's characters", None);

/// This pass.
pub(crate) const NUMBERS: Pass = Pass::named("alarm-numbers", "numbers alarms as the target does", None);

/// Most alarms that are reported.
const MOST_TOLD: usize = 20;

/// Says the alarms of a program as a control does that has these. `calls` is whether it says calls of a computed
/// program, or so often, and jumps to a computed block, as the alarm comes with them.
pub fn run(program: &mut Program, alarms: &Alarms, calls: bool, diags: &mut Vec<Diagnostic>) {
    let own: &[&str] = match calls {
        true => &[NO_SUCH_BLOCK, NO_SUCH_CODE, NO_SUCH_PROGRAM],
        false => &[NO_SUCH_CODE],
    };
    let mut reported: Vec<(AlarmMapped, Span)> = Vec::new();
    for procedure in &mut program.procedures {
        body(&mut procedure.body, alarms, own, &mut reported);
    }
    if let Some((_, at)) = reported.first() {
        let map = reported.iter().take(MOST_TOLD).map(|(mapped, _)| mapped.clone()).collect();
        diags.push(Diagnostic::new(Fault::AlarmsRenumbered { map }, *at));
    }
}

/// Texts of alarms in the characters that a control shows, as its comments are, and reported.
pub fn in_its_characters(program: &mut Program, alarms: &Alarms, diags: &mut Vec<Diagnostic>) {
    program.procedures.iter_mut().for_each(|procedure| characters(&mut procedure.body, alarms, diags));
}

fn characters(stmts: &mut [Stmt], alarms: &Alarms, diags: &mut Vec<Diagnostic>) {
    for stmt in stmts {
        match &mut stmt.op {
            // One without a number is another's, of which `run` makes one of the control's.
            Op::Alarm(alarm) if alarm.number.is_some() => {
                let shown = alarms.shown(&alarm.text);
                if shown != alarm.text {
                    alarm.text = shown;
                    diags.push(Diagnostic::new(Fault::CommentReformatted, stmt.span));
                }
            }
            Op::Control(control) => control.bodies_mut().for_each(|stmts| characters(stmts, alarms, diags)),
            _ => {}
        }
    }
}

fn body(stmts: &mut [Stmt], alarms: &Alarms, own: &[&str], reported: &mut Vec<(AlarmMapped, Span)>) {
    for stmt in stmts {
        match &mut stmt.op {
            Op::Alarm(alarm) => {
                if let Some(other) = other(alarm, alarms, own) {
                    let name = |alarm: &Alarm| {
                        let number = alarm.number.as_ref().and_then(Expr::literal);
                        let number = number.and_then(|n| n.whole_number());
                        number.map_or_else(|| AlarmName::Text((&*alarm.text).into()), AlarmName::Number)
                    };
                    let is_cut =
                        other.number.is_some() && other.text.chars().count() < alarm.text.chars().count();
                    let text = is_cut.then(|| (&*other.text).into());
                    let mapped = AlarmMapped { from: name(alarm), to: name(&other), text };
                    if !reported.iter().any(|(known, _)| *known == mapped) {
                        reported.push((mapped, stmt.span));
                    }
                    **alarm = other;
                }
            }
            Op::Control(control) => control.bodies_mut().for_each(|stmts| body(stmts, alarms, own, reported)),
            _ => {}
        }
    }
}

/// What an alarm becomes, if that is another one.
fn other(alarm: &Alarm, alarms: &Alarms, own: &[&str]) -> Option<Alarm> {
    let own = alarm.number.is_none() && own.contains(&&*alarm.text);
    let number = match &alarm.number {
        None => None,
        Some(number) => Some(number.literal().and_then(|n| n.whole_number())?),
    };
    let (said, text) = alarms.said(number, &alarm.text).filter(|_| !own)?;
    let same = said == number && text == alarm.text;
    (!same).then(|| Alarm { number: said.map(Expr::int), text })
}
