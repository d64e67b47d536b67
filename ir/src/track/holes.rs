//! Cycles and their holes, as far as the program says where they are.

use super::{ActiveCycle, Tracker};
use crate::canon::{Motion, ReturnLevel};
use crate::program::Move;
use crate::program::cycle::{Cycle, CycleKind};

impl Tracker {
    pub(super) fn start_cycle(&mut self, cycle: &Cycle) {
        if let Some(feed) = &cycle.feed {
            self.feed_is(feed);
        }
        if matches!(cycle.kind, CycleKind::Bore { feed_out: Some(_), .. }) {
            self.feed = None;
        }
        let normal = self.plane(cycle.plane).map(|p| p.axes().2);
        let initial = match &self.cycle {
            Some(before) => before.initial,
            // Active or not, it is the same level.
            None if self.cycle_in_doubt => {
                let here = normal.and_then(|axis| self.position[axis as usize]);
                self.doubtful_initial.filter(|level| here == Some(*level))
            }
            None => normal.and_then(|axis| self.position[axis as usize]),
        };
        let retract = self.resolve(&cycle.retract, initial);
        let depth = self.resolve(&cycle.depth, retract);
        let return_plane = cycle.return_plane.as_ref().and_then(|word| self.resolve(word, retract));
        let cycle = cycle.clone();
        self.cycle = Some(ActiveCycle { cycle, initial, retract, depth, return_plane, drilled: false });
        self.cycle_in_doubt = false;
        self.modes.motion = Some(Motion::Cycle);
    }

    pub(super) fn hole(&mut self, m: &Move) {
        self.position = self.target(&m.to);
        self.out_of_hole();
    }

    /// The state after a hole, besides its position in the plane.
    pub fn out_of_hole(&mut self) {
        let Some(in_force) = &mut self.cycle else {
            self.position[..3].fill(None);
            return;
        };
        in_force.drilled = true;
        match &in_force.cycle.kind {
            CycleKind::Tap(tap) => self.spindle = Some(tap.after),
            CycleKind::FineBore(bore) => self.spindle = bore.after.or(self.spindle),
            CycleKind::BoreStop(bore) => self.spindle = bore.after.or(self.spindle),
            CycleKind::Drill
            | CycleKind::DrillDwell { .. }
            | CycleKind::DrillPeck { .. }
            | CycleKind::DrillBreak { .. }
            | CycleKind::Bore { .. } => {}
        }
        let level = match (in_force.return_plane, in_force.cycle.return_level.known()) {
            (Some(plane), _) => Some(plane),
            (None, _) if in_force.cycle.return_plane.is_some() => None,
            (None, level) => match level.or(self.modes.return_level) {
                Some(ReturnLevel::Retract) => in_force.retract,
                Some(ReturnLevel::Initial) => {
                    let levels = in_force.initial.zip(in_force.retract);
                    levels.map(|(initial, r)| in_force.cycle.approach.initial(initial, r))
                }
                None => None,
            },
        };
        match in_force.cycle.plane.known().or(self.modes.plane) {
            Some(plane) => self.position[plane.axes().2 as usize] = level,
            None => self.position[..3].fill(None),
        }
    }
}
