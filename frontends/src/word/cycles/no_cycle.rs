//! Codes that cannot be where a canned cycle is active: `G28`, `G53`, `G60`, `G31`.
//!
//! ```text
//! G81 … G80 / M98 P100 / G91 G28 Z0.      whether program 100 leaves a cycle active, its text says
//! ```
//!
//! Where a call, a jump or a label is before the block, the whole text decides. Not here: what these codes do.

use ncc_ir::diag::Fault;
use ncc_ir::program::Procedure;
use ncc_ir::source::Span;
use ncc_passes::support::mode_analysis::ActiveCycles;

use crate::batch::Batch;
use crate::word::lower::Lower;
use crate::word::word_state::CycleState;

impl Lower {
    /// Refuses a code where a cycle is active. After a call, a jump or a label the end of the text decides.
    pub(in crate::word) fn without_cycle(&mut self, fault: Fault, span: Span, out: &mut Batch) {
        match self.state.cycle {
            CycleState::None => {}
            CycleState::Lost if out.whole => self.cycles.doubts.push((fault, span)),
            CycleState::Active(_) | CycleState::Lost => self.fault(fault, span, out),
        }
    }

    /// Notes whether a cycle is active before a block, as long as the statements may be drained.
    pub(in crate::word) fn cycle_before(&mut self, out: &Batch) {
        if !out.whole {
            self.cycles.entered = matches!(self.state.cycle, CycleState::Active(_) | CycleState::Lost);
        }
    }

    /// The text calls a cycle up.
    pub(in crate::word) fn cycle_met(&mut self) {
        self.cycles.any = true;
    }

    /// The text has been read: refuses the codes that a path may reach with a cycle active. A subprogram without its
    /// main program begins with none.
    pub(in crate::word) fn settle_cycles(&mut self, out: &mut Batch) {
        let doubts = std::mem::take(&mut self.cycles.doubts);
        if doubts.is_empty() || !self.cycles.any {
            return;
        }
        let main = Procedure { body: out.stmts.clone(), ..Procedure::default() };
        let procedures: Vec<_> = std::iter::once(main).chain(out.procedures.iter().cloned()).collect();
        let active = ActiveCycles::from_procedures(&procedures, self.cycles.entered);
        for (fault, span) in doubts {
            if active.as_ref().is_none_or(|active| active.at(span.start)) {
                out.report(fault, span);
            }
        }
    }
}
