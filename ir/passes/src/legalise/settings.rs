//! What the legaliser knows of the two controls before it starts.

use crate::arcs::compensated_modes::CompensatedModesState;
use crate::arcs::still_blocks::StillBlocksState;
use crate::frames::frame_increments::FrameIncrementsState;
use crate::frames::rotary_turns::RotaryTurnsState;
use crate::tools::length_axis::LengthAxisState;
use crate::tools::z_after_change::ZAfterChangeState;
use std::collections::{BTreeMap, BTreeSet};

use crate::legalise::Legaliser;
use crate::modes::feed_time;
use crate::modes::feed_unit;
use crate::support::needs::{ARC, CONTROL, ORIENT, RADIUS, TOOL_AXIS};
use ncc_exec::world::Sideways;
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::compensated::Refused;
use ncc_ir::expr::num::Num;
use ncc_ir::geometry::arc_solver::ArcRule;

impl Legaliser {
    /// The value of the source control's lift of chip breaking, for cycles that must be expanded.
    pub fn set_break_lift(&mut self, lift: Option<Num>) {
        self.shared.target.break_lift = lift;
    }

    /// What the source's control refuses while cutter radius compensation is on: its execution finds it.
    pub fn set_source_refuses(&mut self, source: Refused) {
        self.shared.states.state_mut::<CompensatedModesState>().refused =
            self.shared.target.caps.compensation.refused.without(source);
    }

    /// Whether the source looks over blocks of a compensated contour that go nowhere. They are left out then.
    pub fn set_source_looks_over(&mut self, looks_over: bool) {
        self.shared.states.state_mut::<StillBlocksState>().looked_over = looks_over;
        self.shared.follow |= looks_over;
    }

    /// Whether the source can measure the words of a block each in its own way, or have a feed in
    /// another unit than its lengths.
    pub fn set_measures(&mut self, own: bool) {
        let caps = &self.shared.target.caps;
        let has = caps.modes.word_distance && caps.modes.feed_apart;
        self.shared.measures = own && !has;
        self.shared.follow |= self.shared.measures;
    }

    /// The entries of the target's length table that have the lengths of its tools, where they are not
    /// the tools' numbers, and those of edges of its tools other than the first, by tool and edge.
    pub fn set_edge_entries(&mut self, first: BTreeMap<u32, u32>, further: BTreeMap<(u32, u32), u32>) {
        (self.shared.target.edge_entries, self.shared.target.further_edges) = (first, further);
    }

    /// The tool in the spindle before the program begins, as the user states it.
    pub fn hold_tool(&mut self, tool: u32) {
        let tool = Some(i64::from(tool));
        (self.shared.walk.at.tool, self.shared.walk.at.selected) = (tool, tool);
    }

    /// What the source's control has in parameters of fine boring: which way the tool is taken off the wall, and at
    /// which angle the spindle stops, in degrees.
    pub fn set_fine_boring(&mut self, shift: Option<Sideways>, angle: Option<Num>) {
        (self.shared.target.bore_shift, self.shared.target.orientation) = (shift, angle);
    }

    /// Numbers of programs that the target's machine has already, for others than this one's.
    pub fn set_program_numbers(&mut self, numbers: BTreeSet<u32>) {
        self.shared.target.program_numbers = numbers;
    }

    /// The source is the program of another kind of control, whose plain rounding of corners is bounded, or not.
    pub fn between_controls(&mut self, bounded: bool) {
        (self.shared.target.other_control, self.shared.target.corners_bounded) = (true, bounded);
        self.shared.lacks |= ORIENT;
        let caps = &mut self.shared.target.caps;
        if caps.flow.repeat_by_numbers && !caps.flow.repeat_count_known {
            // A pass more or less cuts another part: written out, it is the same on every machine.
            (caps.flow.repeat_blocks, caps.flow.repeat_by_numbers) = (false, false);
            self.shared.lacks |= CONTROL;
        }
        self.shared.lacks |= RADIUS | TOOL_AXIS;
    }

    /// Which arcs the source's control accepts: where the target's has another rule, each arc is judged by it.
    pub fn set_source_arcs(&mut self, rule: ArcRule) {
        self.shared.source_arcs = (rule != self.shared.target.caps.arcs.rule).then_some(rule);
        if self.shared.source_arcs.is_some() {
            self.shared.lacks |= ARC;
            self.shared.follow = true;
        }
    }

    /// Sets the side effects of codes on the source's control. The passes compare them with the target's.
    /// `by_hand`: its operator changes tools, and sets Z again for each.
    pub fn set_source_behaviours(&mut self, source: Behaviours, by_hand: bool) {
        let up = |behaviours: &Behaviours| behaviours.surely(Behaviour::ZAtChange);
        let caps = &self.shared.target.caps;
        self.shared.walk.at.z_lost_at_change =
            up(&source) || up(&caps.behaviours) || by_hand || caps.tools.change_by_hand;
        self.shared.target.caps.tools.change_stops_spindle &= !source.surely(Behaviour::SpindleAtChange);
        self.shared.target.source = source;
        self.shared.feed_again = feed_unit::says_again(&self.shared.target);
        self.shared.times_differ = feed_time::differs(&self.shared.target);
        let own = &self.shared.target.caps.behaviours;
        self.shared.states.put(FrameIncrementsState::new(&source, own));
        self.shared.states.put(LengthAxisState::new(&source, own));
        self.shared.states.put(ZAfterChangeState::new(&source, own));
        self.shared.states.put(RotaryTurnsState::new(&source, own, self.shared.target.other_control));
        self.shared.follow |= self.shared.feed_again || self.shared.times_differ;
        self.shared.follow |= self.shared.states.ask(FrameIncrementsState::is_used)
            || self.shared.states.ask(LengthAxisState::is_used)
            || self.shared.states.ask(RotaryTurnsState::is_used);
    }
}
