//! What is reported of a difference between source and output.
//!
//! ```text
//! source: M1 | output: M1, which stops the spindle on its control    what the target's control does
//! ```
//!
//! Not here: how a difference is found (`ncc_exec::verify`).

use ncc_exec::verify::{Aspect, Difference};
use ncc_exec::{Event, Kind, by_control};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::Axis;
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::lack::ArcsLack;
use ncc_ir::source::Span;

use super::verifier::Stop;
use crate::render::events;

/// A difference is a fault of the compiler, but where the source leaves open what the target cannot.
pub(super) fn different(difference: &Difference, unsaid: Option<ModeName>, last: Span) -> Stop {
    let at = difference.source.as_ref().map_or(last, |event| event.span);
    if let Some(behaviour) = done_by_target(difference) {
        return Stop::Source(Diagnostic::new(Fault::DoneByTarget { behaviour }, at));
    }
    if let Some(fact) = unsaid {
        return Stop::Source(Diagnostic::new(Fault::ModeNotSet { fact }, at));
    }
    if let Some(fault) = closed_by_rounding(difference) {
        return Stop::Source(Diagnostic::new(fault, at));
    }
    let difference = events::describe(difference).into();
    Stop::Target(Diagnostic::new(Fault::NotTheSame { difference }, at))
}

/// What is refused where an arc ends nearly where it begins, and its start and end are one point in the target's
/// digits: the target would make a whole circle of it. The ends have been found equal before the arcs are compared.
pub(super) fn closed_by_rounding(difference: &Difference) -> Option<Fault> {
    let arc = |event: &Option<Event>| match event.as_ref()?.kind {
        Kind::Arc { plane, turn, full, .. } => Some((plane, turn, full)),
        _ => None,
    };
    let (source, target) = (arc(&difference.source)?, arc(&difference.target)?);
    let same = (source.0, source.1) == (target.0, target.1) && difference.aspect == Aspect::Arc;
    (same && !source.2 && target.2).then(|| Fault::lacks(ArcsLack::ShortAfterRounding))
}

/// What the target's control alone has done by itself, if two events differ by that.
pub(super) fn done_by_target(difference: &Difference) -> Option<Behaviour> {
    let (source, target) = (difference.source.as_ref()?, difference.target.as_ref()?);
    let start = target.state.by_control & by_control::Z_AT_START != 0;
    let of_source = if start { source.state.by_control & by_control::Z } else { 0 };
    let bits = target.state.by_control & !source.state.by_control | of_source;
    match difference.aspect {
        Aspect::State if bits & by_control::SPINDLE != 0 => Some(Behaviour::SpindleAtStop),
        Aspect::State if bits & by_control::COOLANT != 0 => Some(Behaviour::CoolantAtStop),
        Aspect::State
            if bits & by_control::SPINDLE_AT_CHANGE != 0 && source.state.spindle != target.state.spindle =>
        {
            Some(Behaviour::SpindleAtChange)
        }
        Aspect::End(_) if bits & by_control::Z != 0 => Some(Behaviour::ZAtChange),
        Aspect::End(Axis::Z) if bits & by_control::Z_COUNTED != 0 => Some(Behaviour::ZAtChange),
        _ => None,
    }
}
