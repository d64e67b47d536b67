//! The first incremental word of Z after a tool change, for a target that takes Z to machine zero at M06 where the
//! source leaves it.
//!
//! ```text
//! G00 Z20.         G00 Z20.
//! T2 M06      →    T2 M06         from machine zero, `G91 Z-3.` would go 3 mm
//! G91 Z-3.         G90 Z17.
//! ```
//!
//! An absolute word goes to the same place on both. Where Z is not known the word stays, and the comparison refuses it.
//! Not here: cuts from machine zero, and cycles that return to it, which the comparison refuses too.

use crate::frames::frame_increments::changes_place;
use crate::pass::{Moment, Pass, Step};
use crate::support::walk::Walk;
use crate::support::write::at;
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::canon::{Axis, Distance};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::arguments::{words_of, words_of_mut};
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Op, Stmt};

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "z-after-change",
    about: "says where Z stands behind a tool change that takes it away on one control",
    alone: None,
    step: Step::at(
        Moment::Arrival,
        |l, p| l.z_left.concerns(p.stmts),
        |l, p| l.z_left.over(p.stmts, &l.walk),
    ),
};

/// What is remembered from piece to piece.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct State {
    /// Whether the target alone takes Z up.
    used: bool,
    /// Where the source has left Z before the change, if no word has moved it since.
    left: Option<Nanos>,
}

impl State {
    pub(crate) fn new(source: &Behaviours, target: &Behaviours) -> State {
        let change = Behaviour::ZAtChange;
        State { used: target.surely(change) && !source.does(change), left: None }
    }

    /// The same where control comes from elsewhere.
    pub(crate) fn start_over(&mut self) {
        self.left = None;
    }

    /// Whether statements may concern it.
    pub(crate) fn concerns(&self, stmts: &[Stmt]) -> bool {
        self.used && (self.left.is_some() || stmts.iter().any(|stmt| stmt.op == Op::ChangeTool))
    }

    /// Makes the word absolute, where it is known where it leads.
    pub(crate) fn over(&mut self, stmts: &mut [Stmt], start: &Walk) {
        let mut walk = start.clone();
        for stmt in stmts {
            walk.enter(stmt.skip);
            let before = walk.at.position[Axis::Z as usize];
            match &mut stmt.op {
                Op::ChangeTool => self.left = before.filter(|_| stmt.skip.is_none()),
                flow!() => self.left = None,
                Op::StartCycle(_) | Op::UseMachineCoordinates { .. } | Op::GoToReference(_) => {
                    self.left = None
                }
                op if changes_place(op) => self.left = None,
                op => {
                    let moves = words_of(op).is_some_and(|to| to.get(Axis::Z).is_some());
                    if let Some(left) = self.left.take_if(|_| moves)
                        && let Some(to) = words_of_mut(op)
                        && let Some(word) = &mut to.axes[Axis::Z as usize]
                        && word.distance.known().or(walk.at.modes.distance) == Some(Distance::Incremental)
                        && let Some(end) = walk.at.resolve(word, Some(left))
                    {
                        *word = at(end, Axis::Z, walk.unit());
                    }
                }
            }
            walk.step(stmt);
        }
    }
}
