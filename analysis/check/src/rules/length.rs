//! NC0806: Z moves after a tool change before the length of the tool is active.

use ncc_exec::{Event, Exec};
use ncc_ir::source::Span;

use crate::finding::{Finding, LeftOn, What};
use crate::seen::Length;
use crate::watched::Watched;

/// The tool was changed.
pub(crate) fn changed(checker: &mut Watched, event: &Event) {
    // Without a tool there is nothing to measure.
    checker.seen.length = match event.state.tool {
        0 => Length::Fine,
        _ if checker.limits.no_lengths => Length::Fine,
        _ => Length::Missing(event.span),
    };
}

/// A length is stated: a tool's, or none.
pub(crate) fn said(checker: &mut Watched, at: Span, exec: &Exec) {
    let none = exec.length_entry() == Some(0) || exec.length_edge().is_some_and(|(_, edge)| edge == 0);
    if none {
        checker.cancels_length |= checker.seen.is_on(LeftOn::Length);
        checker.seen.switch_off(LeftOn::Length);
        return;
    }
    checker.seen.length = Length::Fine;
    checker.seen.switch_on(LeftOn::Length, at);
}

/// Z moves in the coordinates of a work offset.
#[inline]
pub(crate) fn z_moves(checker: &mut Watched, event: &Event) {
    let Length::Missing(change) = checker.seen.length else { return };
    checker.seen.length = Length::Fine;
    let tool = event.state.tool;
    let old = checker.seen.on().iter().find(|(mode, _)| *mode == LeftOn::Length).map(|(_, at)| *at);
    let what = if old.is_some() { What::OldLength { tool } } else { What::NoLength { tool } };
    checker.findings.add(Finding::new(what, event.span).with([change]).with(old));
}
