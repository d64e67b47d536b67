//! The pecks of a hole as moves, and what a target's own pecks and levels are.
//!
//! ```text
//! G83 Z-8. R2. Q4.      →      G01 Z-2. / G00 Z2. / G00 Z-1. / G01 Z-6. / …
//! ```
//!
//! Not here: the last stroke, to the bottom, which every cycle has (`expand_cycles`).

use crate::holes::sayable::lasts;
use crate::support::walk::Walk;
use crate::support::write::{cut, exact, only, traverse, unit_of};
use crate::target::Target;
use ncc_ir::canon::ReturnLevel;
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::lack::HolesLack;
use ncc_ir::program::cycle::{Clearance, CycleKind, absolute, next_peck};
use ncc_ir::program::{Op, Point};
use ncc_ir::syntax::Ranged;
use ncc_ir::track::ActiveCycle;

/// Most pecks of one hole; more is a slip of the pen.
const MAX_PECKS: i64 = 100_000;

/// Whether a control that returns to where the tool stood before the block, and not before the series, gives the same
/// level.
pub(super) fn level_is_here(walk: &Walk, in_force: &ActiveCycle, target: &Target) -> bool {
    let cycle = &in_force.cycle;
    let retract = cycle.return_level.known().or(walk.at.modes.return_level) == Some(ReturnLevel::Retract);
    if !target.caps.holes.level_of_block || retract || cycle.return_plane.is_some() {
        return true;
    }
    let Some(plane) = walk.at.plane(cycle.plane) else { return false };
    let here = walk.at.position[plane.axes().2 as usize];
    here.is_some() && here == in_force.initial && in_force.retract.is_some_and(|r| here >= Some(r))
}

/// What comes between two pecks.
enum Between<'c> {
    /// Out of the hole and back to the clearance, if there is one.
    Out { clearance: Option<Nanos>, settle: Option<&'c Expr> },
    /// Up a little.
    Up { lift: Nanos, at_feed: bool },
}

/// All pecks but the last.
pub(super) fn pecks(
    walk: &Walk,
    in_force: &ActiveCycle,
    [retract_word, left]: [&Point; 2],
    target: &Target,
    stated: bool,
    moves: &mut Vec<(bool, Op)>,
) -> Result<(), Fault> {
    let normal =
        walk.at.plane(in_force.cycle.plane).ok_or(Fault::EntryFactNeeded { fact: ModeName::Plane })?.axes().2;
    let unknown = Fault::PositionUnknown { axis: normal.letter() as char };
    let parameter = |value: Option<Num>, lack: HolesLack| match value.and_then(|n| n.nanos(false)) {
        Some(nanos) => Ok(nanos),
        None => Err(Fault::lacks(lack)),
    };
    let length = |value: &Expr| walk.at.nanos(value).ok_or_else(|| unknown.clone());
    let (peck, first, less, pause, between) = match &in_force.cycle.kind {
        CycleKind::DrillPeck { peck, first, less, clearance, pause, settle, .. } => {
            let clearance = match clearance {
                Clearance::Stated(value) => Some(length(value)?),
                Clearance::Parameter => {
                    Some(parameter(target.peck_clearance, HolesLack::PeckClearanceParameter)?)
                }
                Clearance::FromReturn => None,
            };
            (peck, first, less, pause, Between::Out { clearance, settle: settle.as_ref() })
        }
        CycleKind::DrillBreak { peck, first, less, lift, lift_at_feed, pause, .. } => {
            let lift = match lift {
                Clearance::Stated(value) => length(value)?,
                Clearance::Parameter | Clearance::FromReturn => {
                    parameter(target.break_lift, HolesLack::ChipBreakLiftParameter)?
                }
            };
            (peck, first, less, pause, Between::Up { lift, at_feed: *lift_at_feed })
        }
        CycleKind::Drill
        | CycleKind::DrillDwell { .. }
        | CycleKind::Bore { .. }
        | CycleKind::Tap(_)
        | CycleKind::FineBore(_)
        | CycleKind::BoreStop(_) => return Ok(()),
    };
    let (Some(retract), Some(depth)) = (in_force.retract, in_force.depth) else { return Err(unknown) };
    let peck = length(peck)?.checked_abs().unwrap_or(0);
    let first = match first {
        Some(first) => length(first)?,
        None => peck,
    };
    let less = less.as_ref().map(length).transpose()?;
    let grows = less.is_some_and(|less| less < 0 || first < peck);
    if peck == 0 || first <= 0 || grows || retract.saturating_sub(depth) / peck > MAX_PECKS {
        return Err(Fault::OutOfRange { word: Ranged::PeckDepth });
    }
    let unit = unit_of(normal, walk.unit());
    let go = |nanos: Nanos| only(normal, absolute(exact(nanos, unit)));
    let mut stroke = first;
    let mut bottom = retract.saturating_sub(stroke);
    let mut joined = stated;
    while bottom > depth {
        moves.push((joined, cut(go(bottom))));
        joined = false;
        if let Some(pause) = pause.as_ref().filter(|pause| lasts(pause)) {
            moves.push((false, Op::Dwell(pause.clone())));
        }
        match &between {
            Between::Out { clearance, settle } => {
                let up = if clearance.is_some() { retract_word } else { left };
                moves.push((false, traverse(up.clone())));
                if let Some(settle) = settle.filter(|settle| lasts(settle)) {
                    moves.push((false, Op::Dwell((*settle).clone())));
                }
                if let Some(clearance) = clearance {
                    moves.push((false, traverse(go(bottom.saturating_add(*clearance)))));
                }
            }
            Between::Up { lift, at_feed } => {
                let to = go(bottom.saturating_add(*lift));
                moves.push((false, if *at_feed { cut(to) } else { traverse(to) }));
            }
        }
        stroke = next_peck(stroke, peck, less);
        bottom = bottom.saturating_sub(stroke);
    }
    Ok(())
}
