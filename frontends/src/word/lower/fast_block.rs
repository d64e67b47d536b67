//! Moves that go the short way of the usual blocks ([`crate::common::fast_block`]): which of them depend on nothing that
//! is not settled, and what they change of the state.
//!
//! Not here: plain moves (`fast_lower`).

use ncc_dialects::Quantity;
use ncc_ir::canon::{Axis, FeedMode, Motion, Plane, Turn};
use ncc_ir::expr::num::Unit;
use ncc_ir::program::{CentreFrom, Text};

use super::Lower;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::fast_block::{Known, Path, push, read};
use crate::common::fast_lower::counts_units;
use crate::common::known::Know;
use crate::common::number::unit_of;
use crate::common::text::{begins, decode};
use crate::common::words::Digits;

impl Lower {
    /// Lowers the line that begins at `at` of `text` the short way, as a plain move or as another usual block of at most
    /// `longest` bytes; gives where its end is. `None`, and then nothing was done, if it is neither.
    #[inline]
    pub(in crate::word) fn short_way(
        &mut self,
        text: &[u8],
        at: usize,
        base: u32,
        longest: usize,
        out: &mut Batch,
    ) -> Option<usize> {
        #[cfg(test)]
        if self.usual.off {
            return None;
        }
        if !self.usual.likely
            && let Some(end) = self.fast_line(text, at, base, longest, out)
        {
            return Some(end);
        }
        let end = self.fast_block(text, at, base, longest, out);
        match end {
            None if self.usual.likely => {
                self.usual.likely = false;
                self.fast_line(text, at, base, longest, out)
            }
            end => end,
        }
    }

    /// The same of a usual block.
    #[inline(never)]
    fn fast_block(
        &mut self,
        text: &[u8],
        at: usize,
        base: u32,
        longest: usize,
        out: &mut Batch,
    ) -> Option<usize> {
        let holes = self.usual.holes;
        if holes.is_none() && !self.moves_are_settled() {
            return None;
        }
        let usual = &mut self.usual;
        let end = read(&usual.letters, text, at, base, &mut usual.line).filter(|end| end - at <= longest)?;
        let src = Source { text, base };
        let (motion, known) = match holes {
            Some(plane) => (None, self.known_hole(plane, src)?),
            None => self.known(src)?,
        };
        if self.computes.jumps && self.usual.line.number().is_some_and(|number| !self.computes.passes(number))
        {
            return None;
        }
        out.usual_block(&mut self.sub, |stmts| push(&self.usual.line, known, stmts));
        if self.watch && !out.pointed {
            out.pointed = self.usual.line.has_point();
        }
        if !out.whole {
            self.cycles.entered = holes.is_some();
        }
        match holes {
            // A hole changes nothing.
            Some(_) => self.usual.likely = true,
            None => self.block_done(motion),
        }
        Some(end)
    }

    /// What the block at hand says, if it is a hole of the active cycle.
    fn known_hole(&self, plane: Plane, src: Source) -> Option<Known> {
        let (modes, usual) = (&self.state.modes, &self.usual);
        let line = &usual.line;
        if !line.is_position(plane) || !line.is_understood([usual.lengths, usual.angles]) {
            return None;
        }
        let (unit, distance) = (unit_of(modes.units.fact()), modes.distance.fact());
        let comment = self.comment_of(src)?;
        Some(Known {
            path: Path::Hole,
            unit,
            distance,
            feed: Unit::One,
            span: line.whole,
            skip: None,
            comment,
        })
    }

    /// The comment of the block at hand; `None` if it does something.
    fn comment_of(&self, src: Source) -> Option<Option<Box<Text>>> {
        let Some((start, end)) = self.usual.line.comment else { return Some(None) };
        self.text_of_comment(src.text.get(start..end)?).map(Some)
    }

    /// What the block at hand says, and the motion of its code; `None` if that is not settled.
    fn known(&self, src: Source) -> Option<(Option<Motion>, Known)> {
        let (state, usual) = (&self.state, &self.usual);
        let line = &usual.line;
        let new_length = line.moves(Axis::Z) && !state.modes.is_length_noted(&self.inherited);
        if new_length || !line.is_understood([usual.lengths, usual.angles]) {
            return None;
        }
        let said = match line.code {
            Some(code) => Some(usual.motions.get(usize::from(code)).copied().flatten()?),
            None => None,
        };
        let motion = match (said, state.modes.motion) {
            (Some(motion), _) | (None, Know::Said(motion) | Know::Taken(motion)) => Some(motion),
            (None, Know::Unsaid) if self.assume => return None,
            (None, _) => None,
        };
        let by_time = state.modes.feed_mode.value() == Some(FeedMode::InverseTime);
        let feed = match line.feed {
            Some((digits, _)) => self.unit_of_feed(digits, by_time)?,
            None => Unit::One,
        };
        let no_feed = line.feed.is_none() && (by_time || state.modes.feed == Know::Unsaid);
        let fed = !no_feed && state.cycle_feed.is_none();
        let path = match motion {
            Some(Motion::Arc(turn)) if fed => self.arc_path(turn)?,
            _ if !line.is_straight() => return None,
            Some(Motion::Traverse) => Path::Traverse,
            Some(Motion::Feed) if fed => Path::Feed,
            None if !state.level_changed && self.position_is_told() => Path::Position,
            Some(Motion::Feed | Motion::Arc(_) | Motion::Cycle) | None => return None,
        };
        let unit = unit_of(state.modes.units.fact());
        let distance = state.modes.distance.fact();
        let skip = match line.skip {
            Some(level) => Some(self.skip_level(level)?),
            None => None,
        };
        let comment = self.comment_of(src)?;
        let known = Known { path, unit, distance, feed, span: line.whole, skip, comment };
        // The return level is another one after the block.
        let keeps_level = !self.settings.dialect.cycles.level_lost;
        keeps_level.then_some((said, known))
    }

    /// The arc of the block at hand, with its words in the plane that is active.
    fn arc_path(&self, turn: Turn) -> Option<Path> {
        let (line, rules) = (&self.usual.line, &self.settings.dialect.arc);
        let plane = self.state.modes.plane.value().filter(|plane| line.is_arc(*plane))?;
        if !rules.helix && line.moves(plane.axes().2) {
            return None;
        }
        if line.has_radius() {
            return Some(Path::Arc { plane, turn, from: CentreFrom::Start });
        }
        let from = self.settled_centre()?;
        let complete = from == CentreFrom::Start || !rules.centre_complete || line.has_whole_centre();
        complete.then_some(Path::Arc { plane, turn, from })
    }

    /// The level of the block at hand under block skip.
    fn skip_level(&self, written: u8) -> Option<u8> {
        let level = written.max(1);
        let unsure = self.settings.dialect.block.skip_unsure && !self.reported.skip;
        (level <= self.usual.skip_levels && !(self.assume && unsure)).then_some(level)
    }

    /// The text of a comment that does nothing.
    fn text_of_comment(&self, bytes: &[u8]) -> Option<Box<Text>> {
        let rules = &self.settings.dialect.comment;
        let words = rules.shown.iter().chain(&rules.logs).chain(&rules.active);
        let mut words = words.chain([&rules.message, &rules.alarm]).filter(|word| !word.is_empty());
        let acts = words.any(|word| begins(bytes, word).is_some());
        (!acts).then(|| Box::new(decode(bytes)))
    }

    /// What a feed word counts, if it changes no more than the feed.
    fn unit_of_feed(&self, digits: Digits, by_time: bool) -> Option<Unit> {
        let modes = &self.state.modes;
        let settled = modes.is_feed_mode_settled(self.assume, &self.inherited);
        if !settled || modes.feed != Know::Said(()) || self.state.cycle_feed.is_some() {
            return None;
        }
        let bare = !digits.point && digits.mantissa != 0;
        let by_minute = modes.feed_mode.value().unwrap_or(FeedMode::PerMinute) == FeedMode::PerMinute;
        let understood =
            || by_minute && counts_units(&self.rules[Quantity::Feed as usize], modes.units.fact());
        if bare && !understood() || by_time && digits.mantissa == 0 {
            return None;
        }
        Some(if by_time { Unit::One } else { unit_of(modes.units.fact()) })
    }

    /// The state after the block at hand.
    fn block_done(&mut self, said: Option<Motion>) {
        let before = (self.state.modes.motion, self.state.modes.feed);
        if self.state.modes.feed_mode.value() == Some(FeedMode::InverseTime) {
            // A time counts for the move of its own block.
            self.state.modes.feed = Know::Unsaid;
        }
        let line = &self.usual.line;
        if line.feed.is_some_and(|(digits, _)| digits.mantissa != 0) {
            self.state.modes.feed = Know::Said(());
        }
        self.rotary_named |= line.rotary().fold(0, |bits, letter| bits | 1 << (letter - b'A'));
        let repeated = said.is_none() || before.0 == said.map_or(Know::Lost, Know::Said);
        if let Some(motion) = said {
            self.set_motion(motion);
        }
        if self.usual.line.skip.is_some() {
            // Nothing else can have changed.
            self.state.modes.motion.join(before.0);
            self.state.modes.feed.join(before.1);
        }
        if (self.state.modes.motion, self.state.modes.feed) != before {
            self.refresh();
        }
        let plain = self.fast_lower.is_some_and(|fast| repeated || fast.other_motion.is_some());
        self.usual.likely = !(plain && self.usual.line.is_plain());
    }
}
