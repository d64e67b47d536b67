//! What the target's control alone has switched off, started again.

use crate::modes::side_effects::SideEffects;
use crate::modes::side_effects::kinds::starts_spindle;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::SpindleLack;
use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;

impl SideEffects {
    /// Starts again what the target's control alone has switched off, before a block that cuts.
    pub(super) fn again_before(
        &mut self,
        made: &mut Vec<Stmt>,
        joined: &mut bool,
        diags: &mut Vec<Diagnostic>,
        (span, label): (Span, bool),
    ) {
        // A label alone cuts nothing.
        if let Some(at) = self.lost_stop.take_if(|_| !label) {
            diags.push(Diagnostic::new(Fault::lacks(SpindleLack::OptionalStopTurning), at));
        }
        if self.again.iter().all(Option::is_none) {
            return;
        }
        let mut at = made.len();
        if *joined {
            at = (0..made.len()).rev().find(|at| !made[*at].joined).unwrap_or(0);
        }
        let mut new = Vec::new();
        for (behaviour, ops) in self.again.iter_mut().filter_map(Option::take) {
            diags.push(Diagnostic::new(Fault::StartedAgain { behaviour }, span));
            self.stopped_in_words &= !ops.iter().any(starts_spindle);
            new.extend(ops.into_iter().map(|op| Stmt::new(span, op)));
        }
        for (place, stmt) in new.iter_mut().enumerate() {
            stmt.joined = place > 0;
        }
        // The block keeps its number and its jump target at the first of its statements.
        made.splice(at..at, new);
    }

    /// Coolant of the other kind, before a code that switches one on: in the source both flow from here on.
    ///
    /// ```text
    /// M7 / T2 M6 / M8     →     M7 / T2 M6 / M7 / M8       for a control that switches coolant off at a change
    /// ```
    pub(super) fn other_coolant_before(
        &mut self,
        switched: &Op,
        stmt: &Stmt,
        made: &mut Vec<Stmt>,
        diags: &mut Vec<Diagnostic>,
    ) {
        let [_, coolant] = &mut self.again;
        let Some((behaviour, mut ops)) = coolant.take_if(|_| stmt.skip.is_none()) else { return };
        ops.retain(|op| op != switched);
        if ops.is_empty() {
            return;
        }
        diags.push(Diagnostic::new(Fault::StartedAgain { behaviour }, stmt.span));
        let block = |made: &[Stmt]| (0..made.len()).rev().find(|at| !made[*at].joined).unwrap_or(0);
        let at = if stmt.joined { block(made) } else { made.len() };
        made.splice(at..at, ops.into_iter().map(|op| Stmt::new(stmt.span, op)));
    }
}
