//! NC0805: feed moves with the spindle stopped, or without a speed. Reported once until the program switches the
//! spindle or sets a speed. The block that stopped the spindle is related. A spindle that the program holds at an angle
//! is meant to stand, and so is one with a probe in it.

use ncc_exec::Event;
use ncc_ir::canon::{AXES, Spindle, same_point};
use ncc_ir::expr::num::Nanos;

use crate::finding::{Finding, What};
use crate::seen::Known;
use crate::watched::Watched;

/// A move until something is touched: what is in the spindle is a probe.
pub(crate) fn probed(checker: &mut Watched) {
    if let Some(at) = checker.spindle.stopped_at.take() {
        checker.findings.retain(|finding| finding.span != at || !matches!(finding.what, What::SpindleStands));
    }
    checker.spindle.reported = true;
    checker.spindle.probes = true;
}

/// Another tool is in the spindle.
pub(crate) fn changed(checker: &mut Watched) {
    if checker.spindle.probes {
        checker.spindle = checker.spindle.renewed();
    }
}

/// A move at feed from `last`.
#[inline]
pub(crate) fn cut(checker: &mut Watched, event: &Event, last: [Nanos; AXES]) {
    let stands = event.state.spindle == Spindle::Stopped;
    if !(stands || event.state.speed == 0) || checker.spindle.reported {
        return;
    }
    let known = if stands { checker.seen.spindle } else { checker.seen.speed };
    if known == Known::Lost || same_point(&event.end, &last) {
        return;
    }
    checker.spindle.reported = true;
    checker.spindle.stopped_at = stands.then_some(event.span);
    let what = if stands { What::SpindleStands } else { What::SpindleWithoutSpeed };
    let at_entry = known == Known::Entry;
    let stop = checker.spindle.stop.filter(|_| stands);
    checker.findings.add(Finding { at_entry, ..Finding::new(what, event.span) }.with(stop));
}
