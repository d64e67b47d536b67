//! `expand-repeats`: a repetition with a known count is written out.

use super::write::rebuild;
use super::{MOST_STATEMENTS, Target};
use crate::diag::{Diagnostic, Fault};
use crate::program::{Control, Op, Program, Stmt};
use crate::track::Tracker;

/// Writes them out.
pub fn run(program: &mut Program, _: &Target, _: &Tracker, diags: &mut Vec<Diagnostic>) {
    for procedure in &mut program.procedures {
        over(&mut procedure.body, diags);
    }
}

/// The same for one body.
pub(super) fn over(body: &mut Vec<Stmt>, diags: &mut Vec<Diagnostic>) {
    rebuild(body, |stmt, made| {
        let Stmt { span, skip, .. } = stmt;
        let (times, inner) = match &stmt.op {
            Op::Control(control) => match &**control {
                Control::Repeat { times, body } => (times.literal().and_then(|n| n.whole()), body),
                Control::Loop { .. } | Control::While { .. } | Control::For { .. } | Control::If { .. } => {
                    return made.push(stmt);
                }
            },
            _ => return made.push(stmt),
        };
        let Some(times) = times.and_then(|n| u32::try_from(n).ok()) else {
            let what = "a computed repetition".into();
            diags.push(Diagnostic::new(Fault::CannotSay { what }, span));
            return made.push(stmt);
        };
        diags.push(Diagnostic::new(Fault::RepeatExpanded { times }, span));
        let mut inner = inner.clone();
        over(&mut inner, diags);
        if inner.len().saturating_mul(times as usize) > MOST_STATEMENTS {
            let what = "a repetition that is too long to be written out".into();
            diags.push(Diagnostic::new(Fault::CannotSay { what }, span));
            return made.push(stmt);
        }
        made.leave_out(stmt);
        for _ in 0..times {
            for stmt in &inner {
                let mut stmt = stmt.clone();
                stmt.number = None;
                if let Err(fault) = super::expand_calls::also_skipped(&mut stmt, skip) {
                    diags.push(Diagnostic::new(fault, span));
                }
                made.push(stmt);
            }
        }
    });
}
