//! Blocks of a compensated contour that go nowhere, of a source that looks over them.
//!
//! ```text
//! G1 G41 X10        G41 D1 G01 X10.
//! X10          →    G01 Y20.
//! Y20
//! ```
//!
//! Another control may find no corner at such a block.
//!
//! Not here: blocks of which only the run knows that they go nowhere, which execution refuses.

use crate::pass::{Moment, Pass, Step};
use crate::support::walk::Walk;
use crate::support::write::{Rebuild, rebuild};
use ncc_ir::canon::Axis;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::{Op, Stmt};

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "still-blocks",
    about: "leaves out blocks of a compensated contour that go nowhere",
    // Of another source it would not be the same.
    alone: None,
    step: Step::at(
        Moment::Wording,
        |l, _| l.states.ask(|own: &StillBlocksState| own.looked_over),
        |l, p| {
            drop_still_blocks(
                p.stmts,
                &mut p.start.clone(),
                l.states.state_mut::<StillBlocksState>(),
                p.diags,
            )
        },
    ),
    program: &[],
    parametric: None,
};

/// What the pass remembers from piece to piece of a program.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct StillBlocksState {
    /// The source looks over such blocks.
    pub(crate) looked_over: bool,
    /// Whether that was reported.
    reported: bool,
}

/// Leaves them out.
pub(crate) fn drop_still_blocks(
    body: &mut Vec<Stmt>,
    walk: &mut Walk,
    state: &mut StillBlocksState,
    diags: &mut Vec<Diagnostic>,
) {
    rebuild(body, |stmt, made: &mut Rebuild| {
        walk.enter(stmt.skip);
        let still = goes_nowhere(walk, &stmt);
        walk.step(&stmt);
        if still && !std::mem::replace(&mut state.reported, true) {
            diags.push(Diagnostic::new(Fault::AssumedFact { fact: ControlFact::StillBlock }, stmt.span));
        }
        if still { made.leave_out(stmt) } else { made.push(stmt) }
    });
}

/// Whether a statement is a straight move under compensation that surely goes nowhere.
fn goes_nowhere(walk: &Walk, stmt: &Stmt) -> bool {
    let (Op::StraightTraverse(m) | Op::StraightFeed(m)) = &stmt.op else { return false };
    let at = &walk.at;
    let plain = at.compensated && !at.raw && !at.probing && !at.detour && !walk.waiting;
    plain
        && !m.to.is_empty()
        && Axis::ALL.into_iter().all(|axis| {
            let now = at.position[axis as usize];
            m.to.get(axis).is_none_or(|word| now.is_some() && at.resolve(word, now) == now)
        })
}
