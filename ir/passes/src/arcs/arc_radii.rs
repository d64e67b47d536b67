//! Arcs that the source's control accepts and the target's may not: radii at start and end that differ, and a stated
//! radius a little below half the chord.
//!
//! `G2 X20. R9.999` from X0 goes half round on a control that takes that for half a circle; for one that does not, the
//! centre is written: `G2 X20. I10.`. Radii that differ by more than the target accepts are refused at their block: no
//! centre within the comparison's tolerance would make them equal.
//!
//! Not here: what the source's own control refuses, which its execution finds; and arcs whose start is not known, which
//! the execution of the output finds.

use crate::arcs::convert_arcs::centre_of;
use crate::support::walk::Walk;
use crate::support::write::is_absolute;
use crate::target::Target;
use ncc_ir::canon::{Axis, Units};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::Nanos;
use ncc_ir::geometry::arc_solver::ArcRule;
use ncc_ir::geometry::{self, ArcFault};
use ncc_ir::lack::ArcsLack;
use ncc_ir::program::{Arc, Centre, CentreFrom};

/// What becomes of an arc.
pub(crate) enum Judged {
    /// It stays as it is.
    Kept,
    /// Its centre was written in the place of its radius.
    ByCentre,
    /// The target does not accept it.
    Refused(Fault),
}

/// What the target's rule says of an arc.
enum Verdict {
    Keeps,
    /// It takes the arc by its centre, where that is known.
    ByCentre,
    Refuses(Fault),
}

/// Judges an arc by the target's rule, for the walk that stands before it. What the source's rule refuses is left to
/// the source's execution.
pub(crate) fn judge_radii(arc: &mut Arc, walk: &Walk, source: &ArcRule, target: &Target) -> Judged {
    match verdict(arc, walk, source, target) {
        (Verdict::Keeps, _) => Judged::Kept,
        (Verdict::Refuses(fault), _) => Judged::Refused(fault),
        (Verdict::ByCentre, start) => match centre_of(arc, start.as_ref().unwrap_or(walk), target) {
            Ok(()) => Judged::ByCentre,
            Err(_) => Judged::Kept,
        },
    }
}

/// Whether an arc surely stays as it is.
pub(crate) fn keeps(arc: &Arc, walk: &Walk, source: &ArcRule, target: &Target) -> bool {
    matches!(verdict(arc, walk, source, target), (Verdict::Keeps, _))
}

/// What the target's rule says, and from which start, where that is not the walk's.
fn verdict(arc: &Arc, walk: &Walk, source: &ArcRule, target: &Target) -> (Verdict, Option<Walk>) {
    let Some(plane) = walk.at.plane(arc.plane) else { return (Verdict::Keeps, None) };
    let (first, second, _) = plane.axes();
    let unknown = |axis: Axis| walk.at.position[axis as usize].is_none();
    if !unknown(first) && !unknown(second) {
        return (verdict_from(arc, walk, [first, second], source, target), None);
    }
    // Where all of its words count from its start, that may be anywhere.
    let counts_on = |axis: Axis| {
        let absolute = |word| is_absolute(word, walk.at.modes.distance);
        !arc.to.get(axis).is_some_and(absolute)
    };
    let from_zero = matches!(arc.centre, Centre::Point { from: CentreFrom::Zero, .. });
    if from_zero || walk.at.modes.distance.is_none() || !counts_on(first) || !counts_on(second) {
        return (Verdict::Keeps, None);
    }
    let mut own = walk.clone();
    for axis in [first, second] {
        own.at.position[axis as usize].get_or_insert(0);
    }
    (verdict_from(arc, &own, [first, second], source, target), Some(own))
}

fn verdict_from(arc: &Arc, walk: &Walk, axes: [Axis; 2], source: &ArcRule, target: &Target) -> Verdict {
    let inch = walk.at.modes.units == Some(Units::Inch);
    let end = walk.at.target(&arc.to);
    let of = |place: &[Option<Nanos>]| Some([place[axes[0] as usize]?, place[axes[1] as usize]?]);
    let (Some(start), Some(end)) = (of(&walk.at.position), of(&end)) else { return Verdict::Keeps };
    if let Centre::Radius(radius) = &arc.centre {
        let Some(radius) = walk.at.nanos(radius) else { return Verdict::Keeps };
        let short = target.caps.arcs.rule.short(inch);
        let reaches = geometry::centre_by_radius(start, end, radius, arc.turn, short);
        return match reaches {
            Err(ArcFault::RadiusTooSmall) => Verdict::ByCentre,
            _ => Verdict::Keeps,
        };
    }
    let Some(centre) = walk.at.centre(arc) else { return Verdict::Keeps };
    let radii = geometry::radii(start, end, centre);
    if source.check(radii, inch).is_err() {
        return Verdict::Keeps;
    }
    match target.caps.arcs.rule.check(radii, inch) {
        Err(ArcFault::EndOffCircle { radii, allowed }) => {
            Verdict::Refuses(Fault::ArcRadiiDiffer { radii, allowed })
        }
        Err(ArcFault::NoRadius) => Verdict::Refuses(Fault::lacks(ArcsLack::Radius)),
        _ => Verdict::Keeps,
    }
}
