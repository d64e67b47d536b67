//! By which row of the dictionary a cycle is written.
//!
//! Not here: the words of the row (`cycles`).

use ncc_ir::canon::{Fact, ReturnLevel};
use ncc_ir::diag::Fault;
use ncc_ir::lack::HolesLack;
use ncc_ir::program::cycle::{Clearance, Cycle, CycleKind};

use crate::common::codes::CycleCode;
use crate::common::fault::cannot;
use crate::word::Writer;

impl Writer {
    /// The row of a cycle.
    pub(super) fn cycle_code(&self, cycle: &Cycle) -> Result<&CycleCode, Fault> {
        let dwell = match &cycle.kind {
            CycleKind::Drill => None,
            CycleKind::DrillDwell { dwell } => Some(dwell),
            CycleKind::DrillPeck { dwell, clearance, .. }
            | CycleKind::DrillBreak { dwell, lift: clearance, .. } => {
                let of = self.words.codes.cycles.iter().filter(|row| row.kind == cycle.kind.name());
                let mut fits = of.filter(|row| row.from_return == (*clearance == Clearance::FromReturn));
                let Some(row) = fits.next().filter(|_| !matches!(clearance, Clearance::Stated(_))) else {
                    return Err(cannot(HolesLack::ClearanceIsParameter));
                };
                if row.own_pause {
                    return Ok(row);
                }
                dwell.as_ref()
            }
            CycleKind::Bore { dwell, .. } => dwell.as_ref(),
            CycleKind::Tap(_) | CycleKind::FineBore(_) | CycleKind::BoreStop(_) => {
                return self.driven_code(cycle);
            }
        };
        let row = |dwell| self.words.codes.cycle(cycle.kind.name(), dwell).filter(|row| ends(row, cycle));
        // One that can have a dwell need have none, or has one of no seconds.
        let code = row(dwell.is_some()).or_else(|| row(true).filter(|_| dwell.is_none()));
        code.ok_or_else(|| cannot(HolesLack::Cycle { kind: cycle.kind.name() }))
    }

    /// The row of a cycle that drives the spindle.
    fn driven_code(&self, cycle: &Cycle) -> Result<&CycleCode, Fault> {
        let kind = &cycle.kind;
        let cannot = || cannot(HolesLack::CycleForm { kind: kind.name() });
        let dwells = match kind {
            CycleKind::Tap(tap) => tap.dwell.is_some() || tap.back.is_some(),
            CycleKind::FineBore(bore) => bore.dwell.is_some(),
            CycleKind::BoreStop(bore) => bore.dwell.is_some(),
            CycleKind::Drill
            | CycleKind::DrillDwell { .. }
            | CycleKind::DrillPeck { .. }
            | CycleKind::DrillBreak { .. }
            | CycleKind::Bore { .. } => return Err(cannot()),
        };
        let name = |row: &CycleCode| match kind {
            CycleKind::Tap(tap) if !tap.chuck && row.kind == "tap" => {
                self.words.codes.rigid_tapping.is_some()
            }
            CycleKind::Tap(tap) if tap.chuck && row.kind == "tap" => !self.options.rigid_taps,
            _ => row.kind == kind.name(),
        };
        let hand = |row: &CycleCode| match kind {
            CycleKind::Tap(tap) => row.hand == Some(tap.turn),
            _ => true,
        };
        let mut rows = self.words.codes.cycles.iter();
        let row = rows.find(|row| {
            name(row)
                && hand(row)
                && (row.dwell.is_some() || !dwells)
                && row.form.says(kind)
                && ends(row, cycle)
        });
        row.ok_or_else(cannot)
    }
}

/// Whether a row's feed out of the hole, if it has one, ends where the cycle's does.
fn ends(row: &CycleCode, cycle: &Cycle) -> bool {
    let feeds_out = matches!(cycle.kind, CycleKind::Bore { .. } | CycleKind::Tap(_));
    !feeds_out
        || row.to_level == cycle.kind.feeds_to_level()
        || cycle.return_level == Fact::Known(ReturnLevel::Retract) && cycle.return_plane.is_none()
}
