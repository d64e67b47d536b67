//! NC0807: rapids below a plane that the user has named, in program coordinates. Straight up out of it is
//! the way home, and no finding. Of a cycle, its retract plane counts, to which it goes in rapid.

use ncc_exec::Exec;
use ncc_ir::canon::{Axis, Distance, Plane};
use ncc_ir::program::Op;

use crate::finding::What;
use crate::watched::{Step, Watched};

const Z: usize = Axis::Z as usize;

/// A straight rapid has been made.
#[inline]
pub(crate) fn moved(checker: &mut Watched, step: &Step, exec: &Exec) {
    let Some(plane) = checker.limits.rapid_plane else { return };
    // Rapids of a cycle are its own matter.
    if step.raw || !matches!(step.stmt.op, Op::StraightTraverse(_) | Op::Position(_)) {
        return;
    }
    if exec.cycle_levels().is_some() {
        return;
    }
    let (from, to) = (step.from, exec.position());
    let aside = from[0] != to[0] || from[1] != to[1];
    let known = checker.seen.program[Z];
    let ends_below = known && to[Z] < plane && (aside || !step.from_known[Z] || to[Z] < from[Z]);
    let goes_below = step.from_known[Z] && from[Z] < plane && aside;
    if ends_below || goes_below {
        let z = if ends_below { to[Z] } else { from[Z] };
        checker.find(What::RapidBelow { z, plane, cycle: false }, step.stmt.span);
    }
}

/// A cycle has been activated.
pub(crate) fn cycle(checker: &mut Watched, step: &Step, exec: &Exec) {
    let Some(plane) = checker.limits.rapid_plane else { return };
    let Op::StartCycle(cycle) = &step.stmt.op else { return };
    let absolute = cycle.retract.distance.or(exec.distance()) == Distance::Absolute;
    if let Some((Plane::Xy, retract, _)) = exec.cycle_levels()
        && retract < plane
        && (absolute || step.from_known[Z])
    {
        checker.find(What::RapidBelow { z: retract, plane, cycle: true }, step.stmt.span);
    }
}
