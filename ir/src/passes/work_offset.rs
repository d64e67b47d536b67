//! `work-offset`: a control that has one work offset stands for the only one that a program uses.
//!
//! A second one is refused, and so is one that the target cannot name.

use super::write::{Rebuild, rebuild};
use super::{Target, each_body};
use crate::canon::Modes;
use crate::diag::{Diagnostic, Fault};
use crate::program::{Op, Program, Stmt};
use crate::track::Tracker;

/// What the pass remembers from piece to piece of a program.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct State {
    /// The work offset that the target's own one stands for.
    pub(super) only: Option<u16>,
    told: bool,
}

/// Takes the work offsets out, or refuses them.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    let mut state = State::default();
    let assumed = entry.modes;
    each_body(program, entry, |body, _| over(body, &mut state, &assumed, target, diags));
}

/// The same for one piece of a body.
pub(super) fn over(
    body: &mut Vec<Stmt>,
    state: &mut State,
    assumed: &Modes,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    state.only = state.only.or(assumed.work_offset);
    let names = target.caps.work_offsets;
    rebuild(body, |stmt: Stmt, made: &mut Rebuild| {
        let Op::SetOriginOffsets(number) = stmt.op else { return made.push(stmt) };
        if names > 0 {
            if number > names {
                let what = format!("work offset {number}").into();
                diags.push(Diagnostic::new(Fault::CannotSay { what }, stmt.span));
            }
            return made.push(stmt);
        }
        match state.only {
            Some(first) if first != number => {
                diags.push(Diagnostic::new(Fault::SecondWorkOffset { first, second: number }, stmt.span));
            }
            _ if !state.told => {
                diags.push(Diagnostic::new(Fault::AssumedWorkOffset { offset: number }, stmt.span));
                state.told = true;
                state.only = Some(number);
            }
            _ => {}
        }
        made.leave_out(stmt);
    });
}
