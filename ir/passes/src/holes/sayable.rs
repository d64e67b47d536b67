//! Which cycles a target says as they are.

use crate::support::walk::Walk;
use crate::support::write::{as_absolute, at, is_absolute};
use crate::target::Target;
use ncc_ir::canon::{Axis, ReturnLevel, Spindle};
use ncc_ir::caps::{Caps, CycleCap, CycleForm, Lift};
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::Coord;
use ncc_ir::program::cycle::{Clearance, Cycle, CycleKind};
use ncc_ir::source::Span;

/// Whether the target supports a cycle, whatever the tool does before it.
pub(crate) fn sayable(
    walk: &Walk,
    cycle: &Cycle,
    target: &Target,
    span: Span,
    diags: &mut Vec<Diagnostic>,
) -> bool {
    let caps = &target.caps;
    if caps.flat {
        return false;
    }
    let kind = cycle.kind.name();
    let cap = |has: fn(&CycleCap) -> bool| caps.holes.cycles.iter().any(|c| c.kind == kind && has(c));
    let (dwell, details) = match &cycle.kind {
        CycleKind::Drill => (false, true),
        CycleKind::DrillDwell { .. } => (true, true),
        CycleKind::DrillPeck { dwell, clearance, first, less, pause, settle, .. } => {
            let other_first = first.is_some() && less.is_none();
            let own = dwells_alike(caps, kind, [pause, dwell]);
            let strokes = other_first || settle.is_some() || own.is_none() && pause.is_some();
            let says = says_pecks(&cap, clearance, strokes) && (less.is_none() || cap(|c| c.shrinks));
            (own.is_none() && dwell.is_some(), says && own != Some(false))
        }
        CycleKind::DrillBreak { dwell, lift, first, less, pause, lift_at_feed, .. } => {
            let own = dwells_alike(caps, kind, [pause, dwell]);
            let strokes = first.is_some() && less.is_none() || own.is_none() && pause.is_some();
            let rapid = cap(|c| c.lift != Lift::Feed);
            let way = if *lift_at_feed { cap(|c| c.lift != Lift::Rapid) } else { rapid };
            let shrinks = less.is_none() || cap(|c| c.shrinks);
            let says = says_pecks(&cap, lift, strokes) && way && shrinks;
            (own.is_none() && dwell.is_some(), says && own != Some(false))
        }
        CycleKind::Bore { dwell, feed_out, .. } => {
            (dwell.is_some(), feed_out.is_none() || cap(|c| c.feed_out))
        }
        CycleKind::Tap(tap) => {
            let turns = |c: &CycleCap| c.form == CycleForm::Any || c.turns.contains(&tap.turn);
            (
                tap.dwell.is_some() || tap.back.is_some(),
                driven(caps, cycle) && caps.holes.cycles.iter().any(|c| c.kind == kind && turns(c)),
            )
        }
        CycleKind::FineBore(bore) => (bore.dwell.is_some(), driven(caps, cycle)),
        CycleKind::BoreStop(bore) => {
            let refused = caps.holes.bore_needs_spindle && walk.at.spindle == Some(Spindle::Stopped);
            (bore.dwell.is_some(), driven(caps, cycle) && !refused)
        }
    };
    if !details || !caps.holes.returns.says(cycle.return_plane.is_some()) {
        return false;
    }
    let mut rows = caps.holes.cycles.iter().filter(|c| c.kind == kind && (c.dwell || !dwell));
    if cycle.return_plane.is_some() {
        return rows.any(|c| c.ends_feed(&cycle.kind, None));
    }
    let says =
        |level| rows.clone().any(|c| c.returns.contains(&level) && c.ends_feed(&cycle.kind, Some(level)));
    match cycle.return_level.known().or(walk.at.modes.return_level) {
        Some(level) => says(level),
        None => {
            let (initial, retract) = (says(ReturnLevel::Initial), says(ReturnLevel::Retract));
            if initial != retract {
                diags.push(Diagnostic::new(Fault::EntryFactNeeded { fact: ModeName::ReturnLevel }, span));
            }
            initial || retract
        }
    }
}

/// Whether the target says what a cycle does with the spindle in the way that it does it.
fn driven(caps: &Caps, cycle: &Cycle) -> bool {
    let kind = cycle.kind.name();
    caps.holes.cycles.iter().any(|c| c.kind == kind && c.form.says(&cycle.kind))
}

/// Whether the target can say how a hole is pecked.
fn says_pecks(cap: &dyn Fn(fn(&CycleCap) -> bool) -> bool, clearance: &Clearance, strokes: bool) -> bool {
    let stated = match clearance {
        Clearance::Stated(_) => cap(|c| c.clearance),
        Clearance::Parameter => cap(|c| c.parameter),
        Clearance::FromReturn => cap(|c| c.from_return),
    };
    stated && (!strokes || cap(|c| c.strokes))
}

/// A level of a cycle as an absolute word.
pub(crate) fn level(
    walk: &Walk,
    word: &Coord,
    resolved: Option<Nanos>,
    normal: Axis,
) -> Result<Coord, Fault> {
    if is_absolute(word, walk.at.modes.distance) {
        return Ok(as_absolute(word));
    }
    match resolved {
        Some(nanos) => Ok(at(nanos, normal, walk.unit())),
        None if word.distance.known().or(walk.at.modes.distance).is_none() => {
            Err(Fault::EntryFactNeeded { fact: ModeName::Distance })
        }
        None => Err(Fault::PositionUnknown { axis: normal.letter() as char }),
    }
}

/// Whether a cycle's dwell is one: of no seconds it is none.
pub(crate) fn lasts(seconds: &Expr) -> bool {
    seconds.literal().is_none_or(|n| !n.is_zero())
}

/// Whether a control that dwells after each peck by itself does so for as long as the cycle has it, at the bottom too.
/// `None` if the target's cycle of this kind has no such dwell.
fn dwells_alike(caps: &Caps, kind: &str, dwells: [&Option<Expr>; 2]) -> Option<bool> {
    let own = caps.holes.cycles.iter().find(|c| c.kind == kind)?.pause?;
    let same = |dwell: &Option<Expr>| {
        dwell.as_ref().and_then(Expr::literal).is_some_and(|n| n.nanos(false) == own.nanos(false))
    };
    Some(dwells.into_iter().all(same))
}
