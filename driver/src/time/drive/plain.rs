//! The world in which a program is executed to be timed.

use ncc_dialects::{BREAK_LIFT, PECK_CLEARANCE};
use ncc_exec::maps::Renaming;
use ncc_exec::world::{Sideways, World};
use ncc_ir::canon::{AXES, Modes};

use super::Plan;
use crate::job::parameters::parameter;
use crate::verify_run::controls::fixed;

/// The plain world: the machine's tables, zero where it states nothing, the dictionary's state at
/// power-on.
pub(super) fn world(plan: &Plan) -> World {
    let (job, fixed) = (plan.job, fixed(plan.job.from.dialect));
    let value = |option| parameter(job, option).and_then(|value| value.nanos(false)).unwrap_or(0);
    World {
        external: [0; AXES],
        seed: 0,
        power_on: Modes { no_origin_shift: Some(true), ..fixed },
        path: None,
        start: [0; AXES],
        peck_clearance: value(PECK_CLEARANCE),
        backs_off: 0,
        length_by_change: false,
        zeroed_by_tool: false,
        behaviours: job.from.behaviours(),
        increments: job.from.fine_increments(),
        optional_stop: false,
        feed_ends_with_mode: job.from.dialect.can.feed_ends_with_mode,
        cycles_need_spindle: job.from.dialect.can.cycles_need_spindle,
        compensation_again: job.from.dialect.caps.compensation.again,
        looks_over_blocks: job.looks_over_blocks(),
        arcs: job.from.arc_rule(),
        refused_compensated: job.from.dialect.caps.compensation.refused,
        break_lift: value(BREAK_LIFT),
        orientation: 0,
        bore_shift: Sideways::default(),
        tables: plan.tables.clone(),
        renaming: Renaming::default(),
    }
}
