//! Stops in a contour under cutter radius compensation, where the target's control does not do what the source's does.
//!
//! `M05 M09` before `M00`, or `M03` after it, is one more block without a move. Two of them in a row leave the corner
//! before them to each control, so such a stop is refused.
//!
//! Not here: what stops do (`side_effects`).

use crate::modes::side_effects::SideEffects;
use crate::modes::side_effects::kinds::{commands_z, cuts};
use crate::support::mode_analysis::{self, Known};
use ncc_ir::program::{Op, Procedure, Program, Stmt};
use ncc_ir::track::Tracker;

impl SideEffects {
    /// What holds after each call and label, if compensation may be on somewhere.
    pub(super) fn entries_of(&self, procedures: &[Procedure]) -> Option<Known> {
        fn starts(body: &[Stmt]) -> bool {
            body.iter().any(|stmt| match &stmt.op {
                Op::StartCutterRadiusCompensation { .. } | Op::OptionalProgramStop => true,
                Op::Control(control) => control.bodies().any(|body| starts(body)),
                _ => false,
            })
        }
        let any = self.beside || procedures.iter().any(|procedure| starts(&procedure.body));
        if !any || self.source == self.target {
            return None;
        }
        let program = Program { procedures: procedures.to_vec(), ..Program::default() };
        mode_analysis::starts(&program, &Tracker { compensated: self.beside, ..Tracker::unknown() }, None)
    }
}

/// Whether nothing moves in the block of a code.
pub(super) fn stands_alone(made: &[Stmt], stmt: &Stmt) -> bool {
    let first = (0..made.len()).rev().find(|at| !made[*at].joined).unwrap_or(0);
    !stmt.joined || !made[first..].iter().any(|stmt| cuts(&stmt.op) || commands_z(&stmt.op))
}
