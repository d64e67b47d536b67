//! The dwells of cycles: those that another cycle has left active, those that an option decides, and those of rigid
//! tapping that are left out.

use ncc_dialects::{CycleRow, LEFT_OUT, TAP_DWELL};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::Num;
use ncc_ir::source::Span;
use ncc_ir::unsupported::CycleUnsupported;
use ncc_ir::unsupported::left_out::LeftOut;

use crate::batch::Batch;
use crate::common::known::Know;
use crate::word::block_words::Code;
use crate::word::lower::Lower;
use crate::word::word_state::CycleState;

impl Lower {
    /// Takes note of a cycle's dwell where it stays active for others.
    pub(super) fn note_dwell(&mut self, row: &CycleRow, dwell: Option<Num>, out: &mut Batch) {
        let (Some(dwell), true) = (dwell, self.settings.dialect.cycles.dwell_left) else { return };
        self.state.dwell_left = Know::Said(dwell);
        self.dwells.said = true;
        if let Some(relied) = self.dwells.relied.take() {
            self.fault(left_open(&row.code), relied, out);
        }
    }

    /// The dwell that a cycle without one takes over from an earlier one.
    pub(super) fn dwell_left(&mut self, row: &CycleRow, code: &Code, out: &mut Batch) -> Option<Num> {
        let takes = self.settings.dialect.cycles.dwell_left && row.dwell.is_some() && !row.dwell_needed;
        match self.state.dwell_left {
            _ if !takes => None,
            Know::Said(dwell) | Know::Taken(dwell) => Some(dwell),
            Know::Unsaid => None,
            Know::Lost | Know::Open | Know::Callers if self.dwells.said => {
                self.refuse(left_open(&row.code), code.span, out)
            }
            Know::Lost | Know::Open | Know::Callers => {
                self.dwells.relied.get_or_insert(code.span);
                None
            }
        }
    }

    /// Control goes elsewhere: a cycle that is activated there keeps the dwell of the active one.
    pub(in crate::word) fn carry_dwell(&mut self, out: &mut Batch) {
        let with_dwell = matches!(&self.state.cycle, CycleState::Active(active) if active.dwell.is_some());
        if !(with_dwell && self.settings.dialect.cycles.retained_by_all()) {
            return;
        }
        self.dwells.carried = true;
        if let Some((relied, code)) = self.dwells.over_unknown.take() {
            self.fault(left_open(code), relied, out);
        }
    }

    /// A cycle without a dwell of its own, activated where another may be active whose dwell it would keep.
    pub(super) fn no_dwell_before(&mut self, row: &'static CycleRow, code: &Code, out: &mut Batch) {
        let takes = row.dwell.is_some() || row.dwell_by.is_some();
        if self.state.cycle != CycleState::Lost || !takes || !self.settings.dialect.cycles.retained_by_all() {
            return;
        }
        match self.dwells.carried {
            true => self.fault(left_open(&row.code), code.span, out),
            false => {
                self.dwells.over_unknown.get_or_insert((code.span, &row.code));
            }
        }
    }

    /// The dwell of a rigid tapping cycle, unless the user has it left out.
    pub(super) fn tap_dwell(
        &mut self,
        row: &'static CycleRow,
        rigid: bool,
        dwell: Option<Num>,
        at: Span,
        out: &mut Batch,
    ) -> Option<Num> {
        let dwell = dwell?;
        if !rigid || dwell.is_zero() || self.settings.get(TAP_DWELL) != LEFT_OUT {
            return Some(dwell);
        }
        if self.assume {
            out.report(Fault::CodeLeftOut { what: LeftOut::Dwell { code: row.code.as_str().into() } }, at);
        }
        None
    }
}

fn left_open(code: &str) -> Fault {
    let what = CycleUnsupported::DwellOfBefore.into();
    Fault::NotSupported { code: code.into(), what }
}
