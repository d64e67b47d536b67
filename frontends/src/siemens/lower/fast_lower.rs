//! Blocks that only move: what they need is kept as long as no other block comes.

use ncc_ir::canon::{Distance, Fact, FeedMode, Plane};
use ncc_ir::expr::num::Unit;
use ncc_ir::program::line_table::AXES_OF_ROW;
use ncc_ir::source::Span;

use super::super::program::repeated_blocks::{CYCLE, DISTANCE, MOTION, PLANE, SCALED, UNITS};
use super::super::siemens_state::{ModalCall, Motion, SiemensState};
use super::{Head, Lower};
use crate::batch::Batch;
use crate::common::fast_lower::{FastLower, FeedWord};
use crate::common::known::Know;
use crate::common::number::unit_of;
use crate::common::words::{Value, Word};
use crate::common::{Source, fast_lower};

impl Lower {
    /// Lowers the line that begins at `at` of `text`, if it is a plain move of at most `longest`
    /// bytes; gives where its end is. `None`, and then nothing was done, if it is not one.
    #[inline]
    pub(in crate::siemens) fn fast_line(
        &mut self,
        text: &[u8],
        at: usize,
        base: u32,
        longest: usize,
        out: &mut Batch,
    ) -> Option<usize> {
        let fast = self.fast_lower.as_ref()?;
        let absolute = fast.distance == Fact::Known(Distance::Absolute);
        let stand = &mut self.stand.axes;
        out.plain_line(&mut self.sub, fast, |row, feed| {
            let end = fast_lower::line(fast, text, at, base, longest, (row, feed))?;
            for (axis, stand) in stand[..AXES_OF_ROW].iter_mut().enumerate() {
                if let Some(num) = row.word(axis, fast.unit) {
                    *stand = if absolute { Some(num) } else { None };
                }
            }
            Some(end)
        })
    }

    /// Finds out whether plain moves can go the short way from here.
    pub(in crate::siemens) fn refresh(&mut self) {
        self.fast_lower = self.settled();
        self.usual.holes = self.plane_of_holes();
    }

    fn settled(&self) -> Option<FastLower> {
        if self.stretch.is_some() {
            // The block after skipped ones ends their stretch.
            return None;
        }
        let state = &self.state;
        let feed = match state.modes.motion {
            Know::Said(Motion::Traverse) | Know::Taken(Motion::Traverse) => false,
            Know::Said(Motion::Feed) | Know::Taken(Motion::Feed) => true,
            _ => return None,
        };
        // The statements of a move say what is active only after one has been looked at.
        let moved = self.moved == Some(if feed { Motion::Feed } else { Motion::Traverse });
        let no_feed = feed && state.modes.feed == Know::Unsaid;
        if no_feed
            || !moved
            || !self.usual.linear
            || !state.modes.is_length_noted(&self.inherited)
            // A time counts for one move, so every block is looked at.
            || state.modes.feed_mode.value() == Some(FeedMode::InverseTime)
            || !self.moves_are_settled(state)
        {
            return None;
        }
        let said = matches!(state.modes.motion, Know::Said(_));
        Some(FastLower {
            unit: unit_of(state.modes.units.fact()),
            distance: state.modes.distance.fact(),
            feed,
            // One of a block may be a jump's.
            number: if self.has_numbered_targets() { 0 } else { b'N' },
            bare: true,
            repeated_motion: self.usual.straight[usize::from(feed)].filter(|_| said),
            other_motion: None,
            feed_word: self.settled_feed(),
        })
    }

    /// Whether every fact is settled that a move depends on, whichever it is, in a block that begins with `state`.
    pub(super) fn moves_are_settled(&self, state: &SiemensState) -> bool {
        state.cycle == ModalCall::None && self.is_settled_beside_cycle(state)
    }

    /// Whether a block of nothing but words of a plane's axes is a hole of the active cycle, and every fact is settled
    /// that it depends on: then it says no more than the hole, and leaves the state as it is. Gives the plane.
    fn plane_of_holes(&self) -> Option<Plane> {
        let (state, modes) = (&self.state, &self.state.modes);
        let ModalCall::Active(cycle) = &state.cycle else { return None };
        let settled = self.is_settled_beside_cycle(state)
            && self.usual.linear
            && modes.motion.value() == Some(Motion::Traverse)
            && modes.is_length_noted(&self.inherited)
            && self.repeated_blocks.knows(PLANE)
            && modes.feed != Know::Unsaid
            && modes.feed_mode.value() != Some(FeedMode::InverseTime)
            // With a feed of its own, nobody knows after a hole which is active.
            && cycle.feed.is_none();
        // The first hole after these says more.
        let called = !self.recall && !self.idle_tap;
        modes.plane.value().filter(|_| settled && called)
    }

    fn is_settled_beside_cycle(&self, state: &SiemensState) -> bool {
        let open = self.assume
            && (state.modes.is_open_to_moves()
                || state.modes.no_shift.unsaid()
                || state.implied_edge.is_some());
        !(open
            || state.modes.is_new_to_moves(&self.inherited)
            || self.ended
            || !self.repeated_blocks.knows(UNITS | DISTANCE | MOTION | CYCLE)
            || self.rounding.is_some()
            || self.stale)
    }

    /// What a feed word needs, while it would change no more than the feed.
    fn settled_feed(&self) -> Option<FeedWord> {
        let unit = self.unit_of_feed(&self.state)?;
        Some(FeedWord { letter: self.usual.feed?, unit, bare: true })
    }

    /// What a feed counts that is no time, if its word changes no more than the feed.
    pub(super) fn unit_of_feed(&self, state: &SiemensState) -> Option<Unit> {
        let settled = state.modes.is_feed_mode_settled(self.assume, &self.inherited)
            && self.repeated_blocks.knows(UNITS | SCALED);
        if !settled || state.modes.feed != Know::Said(()) {
            return None;
        }
        let basic = self.usual.basic;
        match (state.scaled.value(), state.scaled) {
            (Some(true), _) => Some(unit_of(state.modes.units.fact())),
            // Where the active units are other ones, it is told that the feed is not in them.
            (Some(false), _) | (None, Know::Unsaid) if state.modes.units.value() == Some(basic) => {
                Some(unit_of(Fact::Known(basic)))
            }
            (Some(false) | None, _) => None,
        }
    }

    /// Lowers a block that the recogniser has read; its number, if any, is its first word.
    pub(in crate::siemens) fn lower_fast_parsed(
        &mut self,
        plain: &[Word],
        span: Span,
        src: Source,
        out: &mut Batch,
    ) {
        self.stretch = None;
        self.executed = true;
        let mut plain = plain;
        let mut head = Head { span, ..Head::default() };
        if let Some((Word { letter: b'N', value: Value::Number(digits), .. }, rest)) = plain.split_first() {
            head.number = u32::try_from(digits.mantissa).ok();
            plain = rest;
        }
        self.begin(&head, src, out);
        let mut words = std::mem::take(&mut self.words);
        words.clear();
        self.sort_plain(plain, &mut words, src, out);
        self.words(&mut words, &head, src, out);
        self.words = words;
        self.close(&head, src, out);
        self.refresh();
    }
}
