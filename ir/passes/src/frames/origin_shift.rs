//! `origin-shift`: a control without a word that cancels a G92 shift is taken
//! to start without one.
//!
//! Not here: a shift that the program has set itself, which `expand-frames` takes back before.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::SHIFT;
use crate::support::walk::each_body;
use crate::support::write::{Rebuild, rebuild};
use crate::target::Target;
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::program::{FrameSlot, Op, Program, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "origin-shift",
    about: "takes a target that cannot cancel a G92 shift to start without one",
    alone: Some(run),
    step: Step::at(
        Moment::Placing,
        |_, p| p.needs(SHIFT),
        |l, p| cancel_origin_shift(p.stmts, l.states.state_mut::<OriginShiftState>(), p.diags),
    ),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece of a program.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct OriginShiftState {
    /// Whether the target was taken to start without a shift.
    pub(crate) none: bool,
}

/// Takes the cancelling statements out.
pub fn run(program: &mut Program, _: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    let mut state = OriginShiftState::default();
    each_body(program, entry, |body, _| cancel_origin_shift(body, &mut state, diags));
}

/// The same for one piece of a body.
pub(crate) fn cancel_origin_shift(
    body: &mut Vec<Stmt>,
    state: &mut OriginShiftState,
    diags: &mut Vec<Diagnostic>,
) {
    rebuild(body, |stmt: Stmt, made: &mut Rebuild| {
        if stmt.op != Op::ClearFrame(FrameSlot::Shift) {
            return made.push(stmt);
        }
        take(state, stmt.span, diags);
        made.leave_out(stmt);
    });
}

/// Takes for granted that the target starts without a shift, and tells it once.
pub(crate) fn take(state: &mut OriginShiftState, at: Span, diags: &mut Vec<Diagnostic>) {
    if !state.none {
        let fault = Fault::AssumedMode { fact: ModeName::OriginShift, value: "none".into() };
        diags.push(Diagnostic::new(fault, at));
        state.none = true;
    }
}
