//! Whether plain moves can go the short way ([`crate::common::fast_lower`]) from here: while every fact that
//! they depend on is settled.

use ncc_dialects::{CYCLE_APPROACH, Quantity};
use ncc_ir::canon::{Distance, Fact, FeedMode, Motion, Plane, ReturnLevel};
use ncc_ir::expr::num::Unit;
use ncc_ir::program::line_table::{AXES_OF_ROW, Row};

use super::lower::Lower;
use super::word_state::{AxisWords, CycleState};
use crate::batch::Batch;
use crate::common::fast_lower::{FastLower, FeedWord, counts_units, line};
use crate::common::known::Know;
use crate::common::number::unit_of;

impl Lower {
    /// Finds out whether plain moves can go the short way from here.
    pub(super) fn refresh(&mut self) {
        self.fast_lower = self.settled();
        self.usual.holes = self.plane_of_holes();
    }

    pub(super) fn settled(&self) -> Option<FastLower> {
        let state = &self.state;
        let feed = match state.modes.motion {
            Know::Said(Motion::Traverse) | Know::Taken(Motion::Traverse) => false,
            Know::Said(Motion::Feed) | Know::Taken(Motion::Feed) => true,
            _ => return None,
        };
        // A time counts for one move, so every block is looked at.
        if state.modes.feed_mode.value() == Some(FeedMode::InverseTime) {
            return None;
        }
        let no_feed = feed && (state.modes.feed == Know::Unsaid || state.cycle_feed.is_some());
        let length = state.modes.is_length_noted(&self.inherited);
        if no_feed || !length || !self.usual.linear || !self.moves_are_settled() {
            return None;
        }
        let said = matches!(state.modes.motion, Know::Said(_));
        let fed = state.modes.feed != Know::Unsaid && state.cycle_feed.is_none();
        let switches = fed && self.usual.switches;
        Some(FastLower {
            unit: unit_of(state.modes.units.fact()),
            distance: state.modes.distance.fact(),
            feed,
            number: self.settings.dialect.block.number.map_or(0, |c| c as u8),
            bare: false,
            repeated_motion: self.usual.straight[usize::from(feed)].filter(|_| said),
            other_motion: self.usual.straight[usize::from(!feed)].filter(|_| switches),
            feed_word: self.settled_feed(),
        })
    }

    /// Whether every fact is settled that a move depends on, whichever it is.
    pub(super) fn moves_are_settled(&self) -> bool {
        self.state.cycle == CycleState::None && self.is_settled_beside_cycle()
    }

    /// Whether a block of nothing but words of a plane's axes is a hole of the active cycle, and every fact is settled
    /// that it depends on: then it says no more than the hole, and leaves the state as it is. Gives the plane.
    fn plane_of_holes(&self) -> Option<Plane> {
        let (state, rules) = (&self.state, &self.settings.dialect.cycles);
        let CycleState::Active(active) = &state.cycle else { return None };
        let modes = &state.modes;
        let row = self.settings.dialect.cycle.get(active.row)?;
        let plane = modes.plane.value().filter(|plane| active.plane == Fact::Known(*plane))?;
        let absolute = Fact::Known(Distance::Absolute);
        let settled = self.is_settled_beside_cycle()
            && self.usual.linear
            && modes.is_length_noted(&self.inherited)
            && modes.distance.fact() == absolute
            && modes.feed_mode.value() != Some(FeedMode::InverseTime)
            // The first hole takes it.
            && state.cycle_feed.is_none()
            && !rules.level_lost
            && self.depth_letter(row, active.plane).is_some()
            && self.option_is_told(CYCLE_APPROACH);
        // Where a cycle's planes are measured again with each block, the first one of another mode activates it again.
        let measured =
            !rules.measured_anew || (active.retract.distance, active.depth.distance) == (absolute, absolute);
        // The first block of a loop says where it begins.
        let within = self.computes.loops.last().is_none_or(|open| open.at.is_some())
            && self.o.open.last().is_none_or(|open| open.at.is_some());
        Some(plane).filter(|_| settled && measured && within)
    }

    fn is_settled_beside_cycle(&self) -> bool {
        let state = &self.state;
        let open = self.assume && (state.modes.is_open_to_moves() || state.modes.no_shift == Know::Unsaid);
        let level_lost = self.settings.dialect.cycles.level_lost
            && state.return_level.value() == Some(ReturnLevel::Retract);
        !(open
            || level_lost
            || state.modes.is_new_to_moves(&self.inherited)
            // Its code is not said yet.
            || self.has_motion_without_move()
            || self.computes.at_moves.is_some()
            || state.after_cycle
            || state.no_motion
            || state.rigid.is_some()
            || state.unplaced != 0
            || state.words != AxisWords::Cartesian
            || state.follows_polar
            || state.thread.is_some()
            || self.level_open()
            || self.ended)
    }

    /// What a feed word needs, while it would change no more than the feed.
    fn settled_feed(&self) -> Option<FeedWord> {
        let state = &self.state;
        let settled = state.modes.is_feed_mode_settled(self.assume, &self.inherited);
        if !self.usual.feed || !settled || state.modes.feed != Know::Said(()) || state.cycle_feed.is_some() {
            return None;
        }
        let rules = &self.rules[Quantity::Feed as usize];
        let bare = counts_units(rules, state.modes.units.fact());
        Some(FeedWord { letter: self.roles.feed, unit: unit_of(state.modes.units.fact()), bare })
    }

    /// Lowers the line that begins at `at` of `text`, if it is a plain move of at most `longest`
    /// bytes; gives where its end is. `None`, and then nothing was done, if it is not one.
    #[inline]
    pub(super) fn fast_line(
        &mut self,
        text: &[u8],
        at: usize,
        base: u32,
        longest: usize,
        out: &mut Batch,
    ) -> Option<usize> {
        let fast = self.fast_lower.as_ref()?;
        let (computes, watch) = (&mut self.computes, self.watch && !out.pointed);
        let (mut pointed, mut at_feed) = (false, fast.feed);
        let end = out.plain_line(&mut self.sub, fast, |row, feed| {
            let end = line(fast, text, at, base, longest, (row, feed))?;
            if computes.jumps && row.number().is_some_and(|number| !computes.passes(number)) {
                return None;
            }
            pointed = watch && has_point(row);
            at_feed = row.motion() == Motion::Feed;
            Some(end)
        })?;
        out.pointed |= pointed;
        if at_feed != fast.feed {
            self.switch_motion(at_feed);
        }
        Some(end)
    }

    /// The other straight motion is active from here on, and nothing else has changed.
    fn switch_motion(&mut self, at_feed: bool) {
        self.set_motion(if at_feed { Motion::Feed } else { Motion::Traverse });
        let codes = self.usual.straight;
        if let Some(fast) = &mut self.fast_lower {
            fast.feed = at_feed;
            (fast.repeated_motion, fast.other_motion) =
                (codes[usize::from(at_feed)], codes[usize::from(!at_feed)]);
        }
        debug_assert_eq!(self.fast_lower, self.settled());
    }
}

/// Whether a line has a length with a point that is not zero.
#[cold]
fn has_point(row: &Row) -> bool {
    let words = (0..AXES_OF_ROW).filter_map(|axis| row.word(axis, Unit::Mm));
    words.into_iter().any(|num| num.point && num.mantissa != 0)
}
