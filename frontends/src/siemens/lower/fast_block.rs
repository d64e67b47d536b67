//! Fast path for usual Sinumerik blocks ([`crate::common::fast_block`]): checks that all facts of a block are known,
//! and updates the state after it.
//!
//! Not here: plain moves (`fast_lower`). The general path lowers every other block.

use ncc_ir::canon::{Axis, Distance, Fact, FeedMode, Plane};
use ncc_ir::expr::num::Unit;
use ncc_ir::program::{CentreFrom, Text};

use super::super::program::repeated_blocks::PLANE;
use super::super::siemens_state::{Motion, SiemensState};
use super::{Head, Lower, skip_level};
use crate::batch::Batch;
use crate::common::fast_block::{Known, Line, Path, push, read};
use crate::common::known::Know;
use crate::common::number::unit_of;

impl Lower {
    /// Lowers the line at byte `at` of `text` by a fast path, as a plain move or a usual block of at most `longest`
    /// bytes. Gives the end of the line; `None` if neither fits, with the state unchanged.
    #[inline]
    pub(in crate::siemens) fn short_way(
        &mut self,
        text: &[u8],
        at: usize,
        base: u32,
        longest: usize,
        out: &mut Batch,
    ) -> Option<usize> {
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

    /// Lowers a usual block; parameters and result as for [`Lower::short_way`].
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
        if holes.is_none() && !self.moves_are_settled(&self.state) {
            return None;
        }
        let usual = &mut self.usual;
        let end = read(&usual.letters, text, at, base, &mut usual.line).filter(|end| end - at <= longest)?;
        if usual.line.number().is_some() && self.flow.numbered {
            return None;
        }
        if let Some(plane) = holes {
            return self.fast_hole(plane, text, out).map(|()| end);
        }
        let skip = usual.line.skip;
        // If one skip switch covers several blocks, start from the state inside that group.
        let within = self.stretch.as_ref().filter(|stretch| skip == Some(stretch.level));
        let state = within.map_or(&self.state, |stretch| &stretch.inside);
        let moved = within.map_or(self.moved, |stretch| stretch.moved_inside);
        if skip.is_some() && !self.can_be_skipped(state, moved) {
            return None;
        }
        let (said, motion, known) = self.known(state, text)?;
        let head = Head { skip: skip.map(|level| (level, known.span)), span: known.span, ..Head::default() };
        let before = self.enter_stretch(&head, out);
        out.usual_block(&mut self.sub, |stmts| push(&self.usual.line, known, stmts));
        self.block_done(said, motion);
        self.leave_stretch(before, &head, out);
        if skip.is_some() {
            self.refresh();
        }
        Some(end)
    }

    /// Lowers a block that is a hole position. The state then has no last move.
    fn fast_hole(&mut self, plane: Plane, text: &[u8], out: &mut Batch) -> Option<()> {
        if !self.usual.line.is_position(plane) {
            return None;
        }
        let (modes, line) = (&self.state.modes, &self.usual.line);
        let comment = self.comment_of(line, text)?;
        let (unit, distance) = (unit_of(modes.units.fact()), modes.distance.fact());
        let known =
            Known { path: Path::Hole, unit, distance, feed: Unit::One, span: line.span, skip: None, comment };
        push(line, known, out.body(&mut self.sub));
        self.executed = true;
        self.stretch = None;
        (self.moved, self.motion_without_move) = (None, false);
        self.stands_by_line(distance == Fact::Known(Distance::Absolute), unit);
        self.usual.likely = true;
        Some(())
    }

    /// Comment of a line, if any. The outer `None` is a comment range outside the text.
    fn comment_of(&self, line: &Line, text: &[u8]) -> Option<Option<Box<Text>>> {
        let Some((start, end)) = line.comment else { return Some(None) };
        Some(Some(self.text_of_comment(text.get(start..end)?.trim_ascii_end())))
    }

    /// Updates the axis positions from the words of the line. Incremental words make a position unknown.
    fn stands_by_line(&mut self, absolute: bool, unit: Unit) {
        for (place, stand) in self.stand.axes.iter_mut().enumerate() {
            if let Some(num) = self.usual.line.length(place, unit) {
                *stand = if absolute { Some(num) } else { None };
            }
        }
    }

    /// Whether a block skip needs no extra modes before the block and no report after it.
    fn can_be_skipped(&self, state: &SiemensState, moved: Option<Motion>) -> bool {
        let said = match state.modes.motion {
            Know::Said(motion) => moved == Some(motion),
            _ => true,
        };
        said && self.rapid_taken.is_none() && self.moves_are_settled(state)
    }

    /// Motion of the code, effective motion, and the facts of the line; `None` if a fact is unknown.
    fn known(&self, state: &SiemensState, text: &[u8]) -> Option<(Option<Motion>, Option<Motion>, Known)> {
        let usual = &self.usual;
        let line = &usual.line;
        let said = match line.code {
            Some(code) => Some(usual.motions.get(usize::from(code)).copied().flatten()?),
            None => None,
        };
        let motion = match (said, state.modes.motion) {
            (Some(motion), _) | (None, Know::Said(motion) | Know::Taken(motion)) => Some(motion),
            (None, Know::Unsaid) if self.assume => return None,
            (None, _) => None,
        };
        // A position may be a hole, and a hole needs the tool length.
        if (line.moves(Axis::Z) || motion.is_none()) && !state.modes.is_length_noted(&self.inherited) {
            return None;
        }
        let by_time = state.modes.feed_mode.value() == Some(FeedMode::InverseTime);
        let feed = match line.feed {
            Some((digits, _)) if !(by_time && digits.mantissa == 0) && self.flow.open.is_empty() => {
                self.unit_of_feed(state)?
            }
            Some(_) => return None,
            None => Unit::One,
        };
        let no_feed = line.feed.is_none() && (by_time || state.modes.feed == Know::Unsaid);
        let path = match motion {
            Some(Motion::Arc(turn)) if !no_feed => {
                let plane = state.modes.plane.value().filter(|plane| line.is_arc(*plane))?;
                // A variable may have the name of the radius word.
                let radius = line.has_radius() && (line.is_radius_zero() || !self.variables.is_empty());
                if radius || !self.repeated_blocks.knows(PLANE) {
                    return None;
                }
                Path::Arc { plane, turn, from: CentreFrom::Start }
            }
            _ if !line.is_straight() => return None,
            Some(Motion::Traverse) => Path::Traverse,
            Some(Motion::Feed) if !no_feed => Path::Feed,
            None if !self.cycled => Path::Position,
            _ => return None,
        };
        let unit = unit_of(state.modes.units.fact());
        let feed = if by_time { Unit::One } else { feed };
        let skip = match line.skip {
            Some(written) => {
                let level = skip_level(written);
                Some(level).filter(|level| *level <= self.settings.dialect.block.skip_levels)?;
                Some(level)
            }
            None => None,
        };
        let comment = self.comment_of(line, text)?;
        let distance = state.modes.distance.fact();
        let known = Known { path, unit, distance, feed, span: line.span, skip, comment };
        Some((said, motion, known))
    }

    /// Updates the state after the line. `said` is the motion of its code, `motion` the effective one.
    fn block_done(&mut self, said: Option<Motion>, motion: Option<Motion>) {
        let before = (self.state.modes.motion, self.state.modes.feed, self.moved);
        self.executed = true;
        let state = &mut self.state;
        let by_time = state.modes.feed_mode.value() == Some(FeedMode::InverseTime);
        if by_time {
            // An inverse time is valid only for the move of its block.
            state.modes.feed = Know::Unsaid;
        }
        let line = &self.usual.line;
        if line.feed.is_some_and(|(digits, _)| digits.mantissa != 0) {
            (state.modes.feed, state.spent) = (Know::Said(()), false);
        }
        state.spent |= by_time && !matches!(motion, Some(Motion::Traverse) | None);
        let repeated = said.is_none() || before.0 == said.map_or(Know::Lost, Know::Said);
        if let Some(motion) = said {
            state.modes.motion = Know::Said(motion);
        }
        (self.moved, self.motion_without_move) = (motion, false);
        let absolute = state.modes.distance.fact() == Fact::Known(Distance::Absolute);
        let unit = unit_of(state.modes.units.fact());
        self.stands_by_line(absolute, unit);
        let stretch_ended = self.fast_lower.is_none();
        if stretch_ended || (self.state.modes.motion, self.state.modes.feed, self.moved) != before {
            self.refresh();
        }
        self.usual.likely = !(repeated && self.usual.line.is_plain() && self.fast_lower.is_some());
    }
}
