//! Lengths of tools that lie along another axis on the target's control than on the source's.
//!
//! In the plane of X and Y a length lies along Z on all of them. In G18, some take it along Y: the tool would stand
//! lower by its length. No word of a program says which; where both controls are known and differ, such moves are
//! refused. A length that moves its axis at once is written with a word of that axis (`length_moves`).
//!
//! Not here: a control of which it is open ([`ncc_exec`] runs both).

use crate::pass::{Moment, Pass, Step};
use crate::support::walk::Walk;
use crate::tools::length_moves;
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::canon::Plane;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::LengthsLack;
use ncc_ir::program::kinds::{drilling, moves};
use ncc_ir::program::{Op, Stmt};

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "length-axis",
    about: "refuses lengths that the target would count along another axis",
    alone: None,
    step: Step::at(
        Moment::Arrival,
        |l, _| l.states.ask(LengthAxisState::is_used),
        |l, p| l.states.state_mut::<LengthAxisState>().check(p.stmts, &l.walk, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// Whether the two controls differ: by the active plane, and by that of the call.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LengthAxisState {
    in_plane: bool,
    at_call: bool,
    moves: length_moves::LengthMovesState,
}

impl LengthAxisState {
    pub(crate) fn new(source: &Behaviours, target: &Behaviours) -> LengthAxisState {
        let differ = |behaviour| source.does(behaviour) != target.does(behaviour);
        LengthAxisState {
            in_plane: differ(Behaviour::LengthAxisInPlane),
            at_call: differ(Behaviour::LengthAxisAtCall),
            moves: length_moves::LengthMovesState::new(source, target),
        }
    }

    /// Whether they differ at all.
    pub(crate) fn is_used(&self) -> bool {
        self.in_plane || self.at_call || self.moves.is_used()
    }

    /// Whether statements would be rewritten.
    pub(crate) fn concerns(&self, stmts: &[Stmt]) -> bool {
        self.moves.is_used() && stmts.iter().any(|stmt| stmt.op.calls_length())
    }

    /// Refuses what is not the same on both, and writes the moves that a length makes.
    pub(crate) fn check(&mut self, stmts: &mut Vec<Stmt>, start: &Walk, diags: &mut Vec<Diagnostic>) {
        if self.moves.is_used() {
            self.moves.rewrite_moves(stmts, start, diags);
        }
        let mut walk = start.clone();
        for stmt in stmts.iter() {
            walk.enter(stmt.skip);
            let aside = walk.at.modes.plane != Some(Plane::Xy);
            let long = walk.waiting || walk.at.modes.length_offset != Some(0);
            let found = match &stmt.op {
                moves!() | drilling!() | Op::Position(_) | Op::Polar(_) => self.in_plane && aside && long,
                op if op.calls_length() => self.at_call && aside,
                _ => false,
            };
            walk.step(stmt);
            if found && !(self.at_call && walk.at.modes.length_offset == Some(0)) {
                return diags.push(Diagnostic::new(Fault::lacks(LengthsLack::OtherPlane), stmt.span));
            }
        }
    }
}
