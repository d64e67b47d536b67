//! The return level on a control that has it again with each block.
//!
//! ```text
//! G0 Z10 / G99 G81 X1 Z-5 R2 / G98 X2      the second hole ends at Z2, where the tool stood before its block
//! G99 / G0 X5 / G81 X6 Z-5 R2              G0 has made G98 the level again
//! ```
//!
//! Not here: where the tool goes by it, which execution knows.

use ncc_ir::canon::{Distance, Fact, ReturnLevel};
use ncc_ir::program::Op;
use ncc_ir::source::Span;

use crate::batch::Batch;
use crate::common::known::Know;
use crate::word::lower::Lower;
use crate::word::word_state::CycleState;

impl Lower {
    /// Ends the active cycle before it is activated again, on a control whose initial level is where the tool is
    /// before each block, where that level counts and may be another than before the series.
    pub(super) fn start_anew(&mut self, level: Fact<ReturnLevel>, block: Span, out: &mut Batch) -> bool {
        if !self.settings.dialect.cycles.level_of_block {
            return false;
        }
        let CycleState::Active(active) = &mut self.state.cycle else { return false };
        let called = active.called.replace((level, active.retract.clone()));
        let Some((before, retract)) = called else { return false };
        let from_level = active.retract.distance != Fact::Known(Distance::Absolute);
        let counts = level != Fact::Known(ReturnLevel::Retract) || from_level;
        let same = before == level && level == Fact::Known(ReturnLevel::Initial) && retract == active.retract;
        let anew = counts && (!same || from_level);
        if anew {
            self.push(block, Op::EndCycle, out);
            self.separate(out);
        }
        anew
    }

    /// After a block, on a control where every move that is no cycle's makes the initial level the return level, and
    /// every block while no motion is active.
    pub(in crate::word) fn lose_level(&mut self, moves: bool) {
        let lost = self.settings.dialect.cycles.level_lost && (moves || self.state.no_motion);
        if lost && !matches!(self.state.cycle, CycleState::Active(_)) {
            self.state.return_level = match self.now.skip {
                None => Know::Said(ReturnLevel::Initial),
                Some(_) => self.state.return_level.lost(),
            };
        }
    }
}
