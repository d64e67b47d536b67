//! `skip-levels`: replaces block-skip levels that the target lacks by the first level.
//!
//! ```text
//! /2 G00 X10.      /G00 X10.      the target has one switch: NC0407
//! ```
//!
//! One switch of the target then skips the blocks of several levels. A block skip on a target without it is refused, and
//! so is a level above the switches of a target that has several: no free switch is known before the program's end.

use crate::pass::{Moment, Pass, Step};
use crate::support::needs::SKIP;
use crate::support::walk::each_body;
use crate::target::Target;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::FlowLack;
use ncc_ir::program::{Program, Stmt};
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "skip-levels",
    about: "replaces block-skip levels that the target lacks by the first",
    alone: Some(run),
    step: Step::at(
        Moment::Placing,
        |_, p| p.needs(SKIP),
        |l, p| limit_skip_levels(p.stmts, l.states.state_mut::<SkipLevelsState>(), &l.target, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// Levels that were reported: bit n is level n.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SkipLevelsState {
    reported: u16,
}

/// Replaces the levels, or refuses them.
pub fn run(program: &mut Program, target: &Target, entry: &Tracker, diags: &mut Vec<Diagnostic>) {
    let mut state = SkipLevelsState::default();
    each_body(program, entry, |body, _| limit_skip_levels(body, &mut state, target, diags));
}

/// The same for one piece of a body.
pub(crate) fn limit_skip_levels(
    body: &mut [Stmt],
    state: &mut SkipLevelsState,
    target: &Target,
    diags: &mut Vec<Diagnostic>,
) {
    let highest = target.caps.flow.skip_levels;
    for stmt in body {
        let Some(level) = stmt.skip.filter(|l| *l > highest) else { continue };
        let bit = 1u16 << level.min(15);
        if state.reported & bit == 0 {
            state.reported |= bit;
            let fault = match highest {
                0 => Fault::lacks(FlowLack::SkippedBlock),
                1 => Fault::SkipLevelLost { level },
                // Which of the target's switches is free is not known before the program's end.
                _ => Fault::lacks(FlowLack::TenthSkipSwitch),
            };
            diags.push(Diagnostic::new(fault, stmt.span));
        }
        stmt.skip = Some(1);
    }
}
