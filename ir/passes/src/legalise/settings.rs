//! What the legaliser is told of the two controls before it starts.

use std::collections::{BTreeMap, BTreeSet};

use crate::frames::frame_increments;
use crate::frames::rotary_turns;
use crate::legalise::Legaliser;
use crate::modes::feed_time;
use crate::modes::feed_unit;
use crate::support::needs::{ARC, CONTROL, ORIENT, RADIUS, TOOL_AXIS};
use crate::tools::length_axis;
use crate::tools::z_after_change;
use ncc_exec::world::Sideways;
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::compensated::Refused;
use ncc_ir::expr::num::Num;
use ncc_ir::geometry::round::ArcRule;

impl Legaliser {
    /// The value of the source control's lift of chip breaking, for cycles that must be written out.
    pub fn set_break_lift(&mut self, lift: Option<Num>) {
        self.target.break_lift = lift;
    }

    /// What the source's control refuses while cutter radius compensation is on: its execution finds it.
    pub fn set_source_refuses(&mut self, source: Refused) {
        self.compensated.refused = self.target.caps.refused_compensated.without(source);
    }

    /// Whether the source looks over blocks of a compensated contour that go nowhere. They are left out then.
    pub fn set_source_looks_over(&mut self, looks_over: bool) {
        self.still_blocks.looked_over = looks_over;
        self.follow |= looks_over;
    }

    /// Whether the source can measure the words of a block each in its own way, or have a feed in
    /// another unit than its lengths.
    pub fn set_measures(&mut self, own: bool) {
        let caps = &self.target.caps;
        let has = caps.word_distance && caps.feed_apart;
        self.measures = own && !has;
        self.follow |= self.measures;
    }

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
    /// `by_hand`: its operator changes tools, and sets Z anew for each.
    pub fn set_source_behaviours(&mut self, source: Behaviours, by_hand: bool) {
        let up = |behaviours: &Behaviours| behaviours.surely(Behaviour::ZAtChange);
        let caps = &self.target.caps;
        self.walk.at.z_lost_at_change = up(&source) || up(&caps.behaviours) || by_hand || caps.change_by_hand;
        self.target.caps.change_stops_spindle &= !source.surely(Behaviour::SpindleAtChange);
        self.target.source = source;
        self.feed_again = feed_unit::says_again(&self.target);
        self.times_differ = feed_time::differs(&self.target);
        let own = &self.target.caps.behaviours;
        self.increments = frame_increments::FrameIncrementsState::new(&source, own);
        self.length_axis = length_axis::LengthAxisState::new(&source, own);
        self.z_left = z_after_change::ZAfterChangeState::new(&source, own);
        self.rotary = rotary_turns::RotaryTurnsState::new(&source, own, self.target.other_control);
        self.follow |= self.feed_again || self.times_differ;
        self.follow |= self.increments.is_used() || self.length_axis.is_used() || self.rotary.is_used();
    }
}
