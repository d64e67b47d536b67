//! What a program leaves to the control: facts that are assumed at its entry, and which of them it
//! has never said.

use crate::{DISTANCE, Exec, FEED_MODE, LENGTH, Length, MOTION, PLANE, RETURN, SHIFT, UNITS, WORK};
use ncc_ir::canon::{AXES, Modes, Units};
use ncc_ir::diag::ModeName;
use ncc_ir::expr::num::Nanos;

impl Exec {
    /// Puts the axes somewhere in program coordinates (a stated start).
    pub fn stand_at(&mut self, start: &[Option<Nanos>; AXES]) {
        for (axis, at) in start.iter().enumerate() {
            if let Some(at) = at {
                self.position[axis] = *at;
            }
        }
        self.last = self.machine();
    }

    /// Has a tool in the spindle, and its T code active, before the program begins (a stated start).
    pub fn hold_tool(&mut self, tool: u32) {
        let tool = i64::from(tool);
        (self.state.tool, self.selected, self.changed_to) = (tool, tool, tool);
    }

    /// Takes facts for granted that nothing has set yet.
    pub fn assume(&mut self, facts: &Modes) {
        let here = self.machine();
        let fresh = |said: u16, bit| said & bit == 0;
        if let (Some(d), true) = (facts.distance, fresh(self.said, DISTANCE)) {
            self.modes.distance = d;
            self.said |= DISTANCE;
        }
        if let (Some(u), true) = (facts.units, fresh(self.said, UNITS)) {
            self.modes.inch = u == Units::Inch;
            self.said |= UNITS;
        }
        if let (Some(p), true) = (facts.plane, fresh(self.said, PLANE)) {
            self.modes.plane = p;
            self.said |= PLANE;
            self.along = self.length_axis();
        }
        if let (Some(r), true) = (facts.return_level, fresh(self.said, RETURN)) {
            self.modes.return_level = r;
            self.said |= RETURN;
        }
        if let (Some(m), true) = (facts.motion, fresh(self.said, MOTION)) {
            self.modes.motion = m;
            self.said |= MOTION;
        }
        if let (Some(w), true) = (facts.work_offset, fresh(self.said, WORK)) {
            self.modes.work_offset = w;
            self.said |= WORK;
        }
        if let (Some(l), true) = (facts.length_offset, fresh(self.said, LENGTH)) {
            self.modes.length = Length::Entry(l);
            self.said |= LENGTH;
        }
        if let (Some(n), true) = (facts.no_origin_shift, fresh(self.said, SHIFT)) {
            self.modes.shifted = !n;
            self.said |= SHIFT;
        }
        if let (Some(f), true) = (facts.feed_mode, fresh(self.said, FEED_MODE)) {
            self.state.feed_mode = f;
            self.said |= FEED_MODE;
        }
        self.reframe(here);
    }

    /// The first of these facts that is as the world has it, because the program has not said it, and
    /// otherwise than here.
    pub fn unsaid(&self, facts: &Modes) -> Option<ModeName> {
        let m = &self.modes;
        let inch = facts.units.map(|u| u == Units::Inch);
        let work = facts.work_offset.is_some_and(|w| w != m.work_offset);
        let length = facts.length_offset.is_some_and(|l| Length::Entry(l) != m.length);
        let differing = [
            (MOTION, ModeName::Motion, facts.motion.is_some_and(|v| v != m.motion)),
            (DISTANCE, ModeName::Distance, facts.distance.is_some_and(|v| v != m.distance)),
            (UNITS, ModeName::Units, inch.is_some_and(|v| v != m.inch)),
            (PLANE, ModeName::Plane, facts.plane.is_some_and(|v| v != m.plane)),
            (FEED_MODE, ModeName::FeedMode, facts.feed_mode.is_some_and(|v| v != self.state.feed_mode)),
            (RETURN, ModeName::ReturnLevel, facts.return_level.is_some_and(|v| v != m.return_level)),
            (WORK, ModeName::WorkOffset, work),
            (LENGTH, ModeName::LengthOffset, length),
            (SHIFT, ModeName::OriginShift, facts.no_origin_shift.is_some_and(|v| v == m.shifted)),
        ];
        differing
            .into_iter()
            .find(|(bit, _, differs)| self.said & bit == 0 && *differs)
            .map(|(_, fact, _)| fact)
    }
}
