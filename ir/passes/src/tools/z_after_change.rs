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
//! An arc of which Z is an axis of the plane starts on another circle, and is refused here.
//! Not here: other cuts from machine zero, and cycles that return to it, which the comparison refuses.

use crate::frames::frame_increments::changes_place;
use crate::pass::{Moment, Pass, Step};
use crate::support::walk::Walk;
use crate::support::write::at;
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::canon::{Axis, Distance, Plane};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::arguments::{words_of, words_of_mut};
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Op, Stmt};

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "z-after-change",
    about: "states Z after a tool change that retracts it on one control",
    alone: None,
    step: Step::at(
        Moment::Arrival,
        |l, p| l.states.ask(|own: &ZAfterChangeState| own.concerns(p.stmts)),
        |l, p| l.states.state_mut::<ZAfterChangeState>().make_absolute(p.stmts, &l.walk, p.diags),
    ),
    program: &[],
    parametric: None,
};

/// What is remembered from piece to piece.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct ZAfterChangeState {
    /// Whether the target alone takes Z up.
    used: bool,
    /// Where the source has left Z before the change, if no word has moved it since.
    left: Option<Nanos>,
    /// The target has taken Z up, and no word has moved it since.
    up: bool,
}

impl ZAfterChangeState {
    pub(crate) fn new(source: &Behaviours, target: &Behaviours) -> ZAfterChangeState {
        let change = Behaviour::ZAtChange;
        ZAfterChangeState { used: target.surely(change) && !source.does(change), left: None, up: false }
    }

    /// The same where control comes from elsewhere.
    pub(crate) fn start_over(&mut self) {
        (self.left, self.up) = (None, false);
    }

    /// Whether statements may concern it.
    pub(crate) fn concerns(&self, stmts: &[Stmt]) -> bool {
        self.used && (self.up || stmts.iter().any(|stmt| stmt.op == Op::ChangeTool))
    }

    /// Makes the word absolute, where it is known where it leads. Refuses arcs around a centre that Z counts in.
    pub(crate) fn make_absolute(&mut self, stmts: &mut [Stmt], start: &Walk, diags: &mut Vec<Diagnostic>) {
        let mut walk = start.clone();
        for stmt in stmts {
            walk.enter(stmt.skip);
            let before = walk.at.position[Axis::Z as usize];
            if let (Op::ArcFeed(arc), true) = (&stmt.op, self.up)
                && walk.at.plane(arc.plane) != Some(Plane::Xy)
            {
                let fault = Fault::DoneByTarget { behaviour: Behaviour::ZAtChange };
                diags.push(Diagnostic::new(fault, stmt.span));
            }
            match &mut stmt.op {
                Op::ChangeTool => {
                    let sure = stmt.skip.is_none();
                    (self.left, self.up) = (before.filter(|_| sure), true);
                }
                flow!() | Op::StartCycle(_) | Op::UseMachineCoordinates { .. } | Op::GoToReference(_) => {
                    (self.left, self.up) = (None, false);
                }
                // With another length, its end is another.
                Op::UseToolLengthOffset(_) | Op::UseToolLength(_) => self.left = None,
                op if changes_place(op) => self.left = None,
                op => {
                    let moves = words_of(op).is_some_and(|to| to.get(Axis::Z).is_some());
                    self.up &= !moves;
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
