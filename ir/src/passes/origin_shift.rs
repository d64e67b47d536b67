//! `origin-shift`: a control without a word that cancels a temporary shift of the origin is taken
//! to start without one.
//!
//! Not here: a shift that the program has set itself, which `expand-frames` takes back before.

use super::write::{Rebuild, rebuild};
use super::{Target, each_body};
use crate::diag::{Diagnostic, Fault, ModeName};
use crate::program::{FrameSlot, Op, Program, Stmt};
use crate::source::Span;
use crate::track::Tracker;

/// What the pass remembers from piece to piece of a program.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct State {
    /// Whether the target was taken to start without a shift.
    pub(super) none: bool,
}

/// Takes the cancelling statements out.
pub fn run(program: &mut Program, _: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    let mut state = State::default();
    each_body(program, entry, |body, _| over(body, &mut state, diags));
}

/// The same for one piece of a body.
pub(super) fn over(body: &mut Vec<Stmt>, state: &mut State, diags: &mut Vec<Diagnostic>) {
    rebuild(body, |stmt: Stmt, made: &mut Rebuild| {
        if stmt.op != Op::ClearFrame(FrameSlot::Shift) {
            return made.push(stmt);
        }
        take(state, stmt.span, diags);
        made.leave_out(stmt);
    });
}

/// Takes for granted that the target starts without a shift, and tells it once.
pub(super) fn take(state: &mut State, at: Span, diags: &mut Vec<Diagnostic>) {
    if !state.none {
        let fault = Fault::AssumedMode { fact: ModeName::OriginShift, value: "none".into() };
        diags.push(Diagnostic::new(fault, at));
        state.none = true;
    }
}
