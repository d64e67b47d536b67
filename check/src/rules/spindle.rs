//! NC0805: moves at feed while the spindle stands, or turns at no stated speed. Told once until the
//! program switches the spindle or says a speed.

use ncc_ir::canon::{AXES, Spindle, same_point};
use ncc_ir::exec::Event;
use ncc_ir::num::Nanos;

use crate::finding::{Finding, What};
use crate::seen::Known;
use crate::watch::Checker;

/// Whether it has been told.
#[derive(Debug, Default)]
pub(crate) struct Met {
    told: bool,
}

/// A move at feed from `last`.
#[inline]
pub(crate) fn cut(checker: &mut Checker, event: &Event, last: [Nanos; AXES]) {
    let stands = event.state.spindle == Spindle::Stopped;
    if !(stands || event.state.speed == 0) || checker.spindle.told {
        return;
    }
    let known = if stands { checker.seen.spindle } else { checker.seen.speed };
    if known == Known::Lost || same_point(&event.end, &last) {
        return;
    }
    checker.spindle.told = true;
    let what = if stands { What::SpindleStands } else { What::SpindleWithoutSpeed };
    let at_entry = known == Known::Entry;
    checker.findings.add(Finding { at_entry, ..Finding::new(what, event.span) });
}
