//! What the legaliser is told of the two controls before it starts.

use std::collections::{BTreeMap, BTreeSet};

use super::super::needs::{ARC, CONTROL, ORIENT, RADIUS, TOOL_AXIS};
use super::super::{feed_time, feed_unit, frame_increments, length_axis, rotary_turns, z_after_change};
use super::Legaliser;
use crate::behaviour::{Behaviour, Behaviours};
use crate::num::Num;
use crate::round::ArcRule;
use crate::world::Sideways;

impl Legaliser {
    /// The entries of the target's length table that have the lengths of its tools, where they are not
    /// the tools' numbers.
    pub fn set_edge_entries(&mut self, entries: BTreeMap<u32, u32>) {
        self.target.edge_entries = entries;
    }

    /// What the source's control has in parameters of fine boring: which way the tool is taken off the wall, and at
    /// which angle the spindle stops, in degrees.
    pub fn set_fine_boring(&mut self, shift: Option<Sideways>, angle: Option<Num>) {
        (self.target.bore_shift, self.target.orientation) = (shift, angle);
    }

    /// Numbers of programs that the target's machine has already, for others than this one's.
    pub fn set_program_numbers(&mut self, numbers: BTreeSet<u32>) {
        self.target.program_numbers = numbers;
    }

    /// The source is the program of another kind of control, whose plain rounding of corners is bounded, or not.
    pub fn between_controls(&mut self, bounded: bool) {
        (self.target.other_control, self.target.corners_bounded) = (true, bounded);
        self.lacks |= ORIENT;
        let caps = &mut self.target.caps;
        if caps.repeat_by_numbers && !caps.repeat_count_known {
            // A pass more or less cuts another part: written out, it is the same on every machine.
            (caps.repeat_blocks, caps.repeat_by_numbers) = (false, false);
            self.lacks |= CONTROL;
        }
        self.lacks |= RADIUS | TOOL_AXIS;
    }

    /// Which arcs the source's control accepts: where the target's has another rule, each arc is judged by it.
    pub fn set_source_arcs(&mut self, rule: ArcRule) {
        self.source_arcs = (rule != self.target.caps.arcs).then_some(rule);
        if self.source_arcs.is_some() {
            self.lacks |= ARC;
            self.follow = true;
        }
    }

    /// Sets the side effects of codes on the source's control. The passes compare them with the target's.
    pub fn set_source_behaviours(&mut self, source: Behaviours) {
        let up = |behaviours: &Behaviours| behaviours.surely(Behaviour::ZAtChange);
        self.walk.at.z_lost_at_change = up(&source) || up(&self.target.caps.behaviours);
        self.target.caps.change_stops_spindle &= !source.surely(Behaviour::SpindleAtChange);
        self.target.source = source;
        self.feed_again = feed_unit::says_again(&self.target);
        self.times_differ = feed_time::differs(&self.target);
        let own = &self.target.caps.behaviours;
        self.increments = frame_increments::State::new(&source, own);
        self.length_axis = length_axis::State::new(&source, own);
        self.z_left = z_after_change::State::new(&source, own);
        self.rotary = rotary_turns::State::new(&source, own, self.target.other_control);
        self.follow |= self.feed_again || self.times_differ;
        self.follow |= self.increments.is_used() || self.length_axis.is_used() || self.rotary.is_used();
    }
}
