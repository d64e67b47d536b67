//! Canned cycles and patterns of holes.
//!
//! Some controls make a hole with the block that calls the cycle up, others do not. For the first
//! kind a call is held back until its first position; a cycle that ends before leaves nothing but
//! its feed.

mod pattern;
mod rows;

use ncc_ir::canon::{Axis, Fact, FeedMode, Motion, Plane, ReturnLevel};
use ncc_ir::diag::Fault;
use ncc_ir::expr::num::Unit;
use ncc_ir::expr::{Expr, Target};
use ncc_ir::lack::{FeedsLack, HolesLack, ThreadsLack, WordsLack};
use ncc_ir::program::arguments::reads;
use ncc_ir::program::cycle::{Cycle, CycleKind, Shift};
use ncc_ir::program::{Coord, Move, Op, Point, Stmt};
use ncc_ir::source::Span;

use super::Writer;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::{Code, CycleCode, Letter};
use crate::common::fault::cannot;
use crate::common::number::WordValue;
use crate::common::setting::{Inserted, Setting};
use crate::common::{Sink, number};

/// A cycle that the program has active.
#[derive(Clone, Debug)]
pub(crate) struct Held {
    pub cycle: Cycle,
    /// Whether the text has called it up, on every path.
    pub in_text: bool,
    /// Skip level of its call.
    skip: Option<u8>,
    /// Block number of its call, if that block has not been written.
    number: Option<u32>,
    /// The cycle that the text had active when this one was activated, so that words which have
    /// not changed need not be written.
    before: Option<Box<Cycle>>,
    /// The feed that the text states for it.
    pub feed: Option<Expr>,
}

impl Held {
    /// Whether a word of it is computed from what is given a value.
    pub(crate) fn reads(&self, to: &Target) -> bool {
        let reads = |cycle: &Cycle| reads(&Op::StartCycle(Box::new(cycle.clone())), to);
        reads(&self.cycle)
            || self.before.as_deref().is_some_and(reads)
            || self.feed.as_ref().is_some_and(|feed| feed.reads(to))
    }
}

/// Words of a cycle's call; of a change of the active cycle, those that change.
struct CallWords {
    /// Letter of the bottom.
    depth_letter: u8,
    code: Option<Code>,
    level: Option<Code>,
    depth: Option<(Letter, Coord)>,
    retract: Option<(Letter, Coord)>,
    pecks: Vec<(u8, WordValue)>,
    dwell: Option<(u8, WordValue)>,
    feed: Option<(u8, WordValue)>,
}

impl Writer {
    pub(crate) fn start_cycle(&mut self, cycle: &Cycle, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        let mut held = Held {
            cycle: cycle.clone(),
            in_text: false,
            skip: stmt.skip,
            number: None,
            before: None,
            feed: None,
        };
        let with_hole = self.dialect.cycles.hole_on_definition;
        let holds_another = |before: &Held| !before.in_text && before.skip != stmt.skip;
        if with_hole && stmt.skip.is_some() && self.held.as_ref().is_some_and(holds_another) {
            return Err(cannot(HolesLack::SkippedAfterCycleWithoutHole));
        }
        match self.held.take() {
            Some(before) if before.in_text && self.words.active.motion == Some(Motion::Cycle) => {
                held.feed = before.feed;
                held.before = Some(Box::new(before.cycle));
            }
            Some(before) if before.skip.is_none() && !before.in_text => {
                // Its feed stays active though it has made no hole.
                held.cycle.feed = held.cycle.feed.or(before.cycle.feed);
                (held.before, held.feed) = (before.before, before.feed);
            }
            Some(_) | None => {}
        }
        if !with_hole {
            return self.call_up(held, None, true, stmt, sink);
        }
        // A cycle without a row is a fault here, not at its first hole.
        self.cycle_code(cycle)?;
        held.number = self.words.block.number.filter(|_| self.words.block.is_empty());
        self.held = Some(held);
        Ok(())
    }

    /// A hole at a position.
    pub(crate) fn hole(&mut self, to: &Move, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        let with_call = self.dialect.cycles.hole_on_definition;
        let mixed = self.held.as_ref().is_some_and(|h| !h.in_text && !h.cycle.measured_as(&to.to));
        if mixed && with_call {
            // One block has one distance mode, so the call stands alone.
            self.call_up_now(stmt, sink)?;
        }
        let in_force = self.words.active.motion == Some(Motion::Cycle);
        match self.held.take() {
            Some(held) if !held.in_text || !in_force || (with_call && to.to.is_empty()) => {
                if held.skip.is_some() && held.skip != stmt.skip {
                    return Err(cannot(HolesLack::SkippedCallOnly));
                }
                let at = with_call.then_some(&to.to);
                self.call_up(held, at, to.said, stmt, sink)?;
                if with_call {
                    return Ok(());
                }
            }
            Some(held) => self.held = Some(held),
            None if in_force => {}
            None => return Err(cannot(HolesLack::HoleOfUnknownCycle)),
        }
        if to.to.is_empty() {
            let to = self.stand_words()?;
            return self.hole_words(&to, stmt.span, sink);
        }
        self.hole_words(&to.to, stmt.span, sink)
    }

    fn hole_words(&mut self, to: &Point, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        if self.dialect.cycles.no_rotary
            && [Axis::A, Axis::B, Axis::C].into_iter().any(|axis| to.get(axis).is_some())
        {
            return Err(cannot(HolesLack::RotaryAxis));
        }
        let mut inserted = Inserted::default();
        self.words.need_distance(to.axes.iter().flatten(), &mut inserted)?;
        let need = self.words.point_need(Need::new(Rank::Motion), to)?;
        self.words.admit_with(need, inserted, sink)?;
        self.words.point(to, span, sink)
    }

    /// Words for the position where the tool is, on a control that needs some for a hole.
    fn stand_words(&self) -> Result<Point, Fault> {
        let plane = self.held.as_ref().and_then(|h| h.cycle.plane.known()).or(self.words.active.plane);
        let (first, second, _) = plane.unwrap_or(Plane::Xy).axes();
        let distance = self.words.active.distance;
        let absolute = Some(ncc_ir::canon::Distance::Absolute);
        if distance != absolute {
            return Err(cannot(HolesLack::IncrementalHoleHere));
        }
        let unit = match self.words.active.units {
            Some(ncc_ir::canon::Units::Inch) => Unit::Inch,
            Some(ncc_ir::canon::Units::Mm) => Unit::Mm,
            None => return Err(cannot(HolesLack::PositionUnitUnknown)),
        };
        let mut to = Point::default();
        for axis in [first, second] {
            let letter = self.words.codes.axes[axis as usize].ok_or_else(|| cannot(WordsLack::Axis))?;
            let n = number::from_nanos(self.words.axis_position(axis)?, &letter.format, unit);
            to.set(axis, Coord { value: Expr::Num(n), distance: distance.into() });
        }
        Ok(to)
    }

    pub(crate) fn end_cycle(&mut self, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let held = self.held.take().filter(|h| !h.in_text);
        let dropped = held.is_some() && self.dialect.cycles.hole_on_definition;
        if let Some(feed) = held.and_then(|h| h.cycle.feed) {
            let letter = self.words.codes.feed_word.ok_or_else(|| cannot(FeedsLack::Feed))?;
            let value = self.words.value(&letter, &feed, span, sink)?;
            self.words.admit(&Need::new(Rank::Feed).letter(letter.letter), sink)?;
            self.words.block.word(Part::Feed, letter.letter, value);
            self.words.active.feed = feed.literal();
        }
        let other_motion = self.words.active.motion.is_some_and(|m| m != Motion::Cycle);
        if dropped && other_motion {
            return Ok(());
        }
        let code = self.words.setting(Setting::NoCycle)?.ok_or_else(|| cannot(HolesLack::CycleEnd))?;
        self.words.admit(&Need::new(Rank::CycleEnd).code(Some(code)), sink)?;
        self.words.block.code(Part::Mode, &code);
        self.words.now_in_force(Setting::NoCycle);
        Ok(())
    }

    /// The code that makes a tap rigid, in a block of its own before its call.
    fn make_rigid(&mut self, held: &Held, sink: &mut Sink) -> Result<(), Fault> {
        let by_code = |cycle: &Cycle| {
            let row = self.cycle_code(cycle);
            cycle.kind.name() == "tap-rigid" && row.is_ok_and(|row| row.kind == "tap")
        };
        if !by_code(&held.cycle) || held.before.as_deref().is_some_and(by_code) {
            return Ok(());
        }
        let code = self.words.codes.rigid_tapping.ok_or_else(|| cannot(ThreadsLack::RigidTapping))?;
        let number = self.words.block.number.take();
        if !self.words.block.is_empty() {
            self.words.flush(false, sink);
            self.words.split = true;
        }
        self.words.admit(&Need::new(Rank::Alone).code(Some(code)), sink)?;
        self.words.block.code(Part::Tail, &code);
        self.words.flush(false, sink);
        self.words.block.number = number;
        Ok(())
    }

    /// A pitch that is stated by the feed per revolution has as many digits as that.
    fn check_pitch(&self, cycle: &Cycle) -> Result<(), Fault> {
        let feed = cycle.feed.as_ref().map_or(self.words.active.feed, Expr::literal);
        let by_feed = matches!(cycle.kind, CycleKind::Tap(_))
            && self.words.active.feed_mode == Some(FeedMode::PerRevolution);
        match (feed.filter(|_| by_feed), self.words.codes.feed_word) {
            (Some(feed), Some(letter)) if number::shape(feed, &letter.format).is_ok_and(|s| s.rounded) => {
                Err(cannot(ThreadsLack::PitchDigits))
            }
            _ => Ok(()),
        }
    }

    /// Calls a held cycle up without a hole, before what relies on it being active.
    pub(crate) fn call_up_now(&mut self, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        if !self.dialect.cycles.hole_on_definition || self.held.as_ref().is_none_or(|h| h.in_text) {
            return Ok(());
        }
        if self.dialect.cycles.repeat.is_none() || self.dialect.cycles.repeat_once {
            return Err(cannot(HolesLack::CycleWithoutHole));
        }
        let Some(held) = self.held.take() else { return Ok(()) };
        let (number, split) = (self.words.block.number.take(), self.words.split);
        self.words.flush(false, sink);
        self.call_up(held, None, true, stmt, sink)?;
        self.words.flush(false, sink);
        (self.words.block.number, self.words.split) = (number, split);
        Ok(())
    }

    /// Writes the call of a cycle, with the first position in its block if `at` says one. Unless the
    /// block is to say the code, a change of the active cycle is written by the words that change.
    fn call_up(
        &mut self,
        mut held: Held,
        at: Option<&Point>,
        said: bool,
        stmt: &Stmt,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        self.make_rigid(&held, sink)?;
        self.check_pitch(&held.cycle)?;
        let mut inserted = Inserted::default();
        let cycle = &held.cycle;
        let coords = at.into_iter().flat_map(|p| p.axes.iter().flatten());
        self.words.need_distance(coords.chain([&cycle.retract, &cycle.depth]), &mut inserted)?;
        self.words.need_plane(cycle.plane, &mut inserted)?;
        let words = self.call_words(&held, at, said, stmt.span, sink)?;
        let mut need = Need::new(Rank::Motion).code(words.level).code(words.code);
        for (letter, _) in [&words.depth, &words.retract].into_iter().flatten() {
            need = need.letter(letter.letter);
        }
        for (letter, _) in words.pecks.iter().chain(&words.dwell).chain(&words.feed) {
            need = need.letter(*letter);
        }
        if let Some(at) = at {
            let depth = words.depth_letter;
            let along = |axis: &Axis| at.get(*axis).is_some() && axis.letter() == depth;
            if Axis::ALL.iter().any(along) {
                return Err(cannot(HolesLack::AlongDrillingAxis));
            }
            need = self.words.point_need(need, at)?;
        }
        // Where the call makes a hole, none is made by counting to zero.
        let repeat = self.words.settings.repeat_word().filter(|_| !self.dialect.cycles.repeat_once);
        let none = match (at, self.dialect.cycles.hole_on_definition, repeat) {
            (None, true, Some(letter)) => Some(letter as u8),
            _ => None,
        };
        if let Some(letter) = none {
            need = need.letter(letter);
        }
        self.words.admit_with(need, inserted, sink)?;
        if self.words.block.number.is_none() {
            self.words.block.number = held.number.take();
        }
        self.words.block.calls_up = true;
        for code in [&words.level, &words.code].into_iter().flatten() {
            self.words.block.code(Part::Motion, code);
        }
        self.call_axes(at, words.depth.as_ref(), stmt.span, sink)?;
        if let Some((letter, coord)) = &words.retract {
            let retract = self.words.value(letter, &coord.value, stmt.span, sink)?;
            self.words.block.word(Part::Axes, letter.letter, retract);
        }
        for (letter, value) in words.pecks.iter().chain(&words.dwell) {
            self.words.block.word(Part::Axes, *letter, *value);
        }
        if let Some((letter, value)) = words.feed {
            self.words.block.word(Part::Feed, letter, value);
        }
        if let Some(letter) = none {
            self.words.block.digits(Part::Tail, letter, "0");
        }
        if let Some(feed) = &held.cycle.feed {
            self.words.active.feed = feed.literal();
        }
        self.words.active.motion = Some(Motion::Cycle);
        held.in_text = stmt.skip.is_none() || stmt.skip == held.skip;
        held.before = None;
        if stmt.skip.is_none() {
            held.feed = held.cycle.feed.take().or(held.feed);
        }
        self.held = Some(held);
        Ok(())
    }

    /// The words of a call, all but those of its position.
    fn call_words(
        &mut self,
        held: &Held,
        at: Option<&Point>,
        said: bool,
        span: Span,
        sink: &mut Sink,
    ) -> Result<CallWords, Fault> {
        let cycle = &held.cycle;
        let row = self.cycle_code(cycle)?.clone();
        let mut row = row;
        let normal = cycle.plane.known().or(self.words.active.plane).map(|p| p.axes().2.letter());
        if let Some(normal) = normal.filter(|normal| *normal != row.depth.letter) {
            let text = String::from_utf8_lossy(row.code.text());
            let one_plane = self.dialect.cycle_row(&text).is_some_and(|row| row.one_plane);
            if !self.dialect.cycles.any_plane || one_plane {
                return Err(cannot(HolesLack::NotAlongZ));
            }
            row.depth.letter = normal;
        }
        if self.dialect.cycles.no_rotary
            && at.is_some_and(|to| [Axis::A, Axis::B, Axis::C].into_iter().any(|a| to.get(a).is_some()))
        {
            return Err(cannot(HolesLack::RotaryAxis));
        }
        let (peck, dwell) = match &cycle.kind {
            CycleKind::Drill => (None, None),
            CycleKind::DrillDwell { dwell } => (None, Some(dwell)),
            CycleKind::DrillPeck { peck, dwell, .. } | CycleKind::DrillBreak { peck, dwell, .. } => {
                (Some(peck), dwell.as_ref())
            }
            CycleKind::Bore { dwell, .. } => (None, dwell.as_ref()),
            CycleKind::Tap(tap) => (None, tap.dwell.as_ref().or(tap.back.as_ref())),
            CycleKind::FineBore(bore) => match &bore.shift {
                Shift::Parameter(amount) => (Some(amount), bore.dwell.as_ref()),
                Shift::Stated(_) => return Err(cannot(HolesLack::StatedShift)),
            },
            CycleKind::BoreStop(bore) => (None, bore.dwell.as_ref()),
        };
        // A change keeps code and plane, and needs a word that makes a hole.
        let moves = at.is_some_and(|p| !p.is_empty());
        let before = held.before.as_deref().filter(|b| {
            !said
                && moves
                && self.dialect.cycles.retained
                && self.words.active.motion == Some(Motion::Cycle)
                && b.plane == cycle.plane
                && b.kind.name() == cycle.kind.name()
                && self.cycle_code(b).is_ok_and(|r| r.code == row.code)
        });
        let same_kind = before.is_some_and(|b| b.kind == cycle.kind);
        let pecks = self.peck_words(&row, &cycle.kind, peck.filter(|_| !same_kind), span, sink)?;
        if self.words.active.motion != Some(Motion::Cycle) && !self.dialect.cycles.dwell_left {
            self.dwell_left = false;
        }
        let left = self.dwell_left;
        let dwell = match (row.dwell, dwell.filter(|_| !same_kind)) {
            (Some(word), Some(dwell)) => {
                if let Some(option) = row.asked {
                    self.words.rely(option, span, sink);
                }
                Some((word.word.letter, self.dwell_value(&word, dwell, span, sink)?))
            }
            // Else an earlier one would hold.
            (Some(word), None) if !same_kind && (left || row.dwell_needed) => {
                Some((word.word.letter, self.dwell_value(&word, &Expr::int(0), span, sink)?))
            }
            _ => None,
        };
        self.dwell_left |=
            dwell.is_some() && (self.dialect.cycles.dwell_left || self.dialect.cycles.retained);
        let stated = before.and(held.feed.as_ref());
        let feed = match (cycle.feed.as_ref().filter(|f| Some(*f) != stated), self.words.codes.feed_word) {
            (Some(feed), Some(letter)) => Some((letter.letter, self.words.value(&letter, feed, span, sink)?)),
            (Some(_), None) => return Err(cannot(FeedsLack::Feed)),
            (None, _) => None,
        };
        let same_depth = before.is_some_and(|b| b.depth == cycle.depth);
        let same_retract = before.is_some_and(|b| b.retract == cycle.retract);
        let level = match before {
            Some(b)
                if b.return_level == cycle.return_level
                    && self.words.active.level == b.return_level.known() =>
            {
                None
            }
            Some(_) | None => self.level_code(cycle.return_level)?,
        };
        Ok(CallWords {
            depth_letter: row.depth.letter,
            code: before.is_none().then_some(row.code),
            level,
            depth: (!same_depth).then(|| (row.depth, cycle.depth.clone())),
            retract: (!same_retract).then(|| (row.retract, cycle.retract.clone())),
            pecks,
            dwell,
            feed,
        })
    }

    /// The words that say how deep the pecks are, or how far fine boring shifts. Pecks that decrease, and pecks
    /// of one depth, stay active until the cycle ends: which of them count then, nobody knows.
    fn peck_words(
        &mut self,
        row: &CycleCode,
        kind: &CycleKind,
        peck: Option<&Expr>,
        span: Span,
        sink: &mut Sink,
    ) -> Result<Vec<(u8, WordValue)>, Fault> {
        let (first, less) = match kind {
            CycleKind::DrillPeck { first, less, .. } | CycleKind::DrillBreak { first, less, .. } => {
                (first, less)
            }
            CycleKind::Drill
            | CycleKind::DrillDwell { .. }
            | CycleKind::Bore { .. }
            | CycleKind::Tap(_)
            | CycleKind::FineBore(_)
            | CycleKind::BoreStop(_) => (&None, &None),
        };
        let Some(peck) = peck else { return Ok(Vec::new()) };
        if self.words.active.motion != Some(Motion::Cycle) || !self.dialect.cycles.retained {
            self.pecks_left = None;
        }
        let shrinks = less.is_some();
        if self.pecks_left.is_some_and(|left| left != shrinks) {
            return Err(cannot(HolesLack::PeckKindsWithoutCycleEnd));
        }
        let words = match (first, less, row.shrinking, row.peck) {
            (Some(first), Some(less), Some(letters), _) => {
                letters.into_iter().zip([first, less, peck]).collect::<Vec<_>>()
            }
            (None, None, _, Some(letter)) => vec![(letter, peck)],
            (None, None, _, None) => return Ok(Vec::new()),
            _ => return Err(cannot(HolesLack::PecksDiffer)),
        };
        self.pecks_left = Some(shrinks);
        let mut written = Vec::with_capacity(words.len());
        for (letter, value) in words {
            written.push((letter.letter, self.words.value(&letter, value, span, sink)?));
        }
        Ok(written)
    }

    /// The code of a cycle's return level, where it has to be stated.
    fn level_code(&mut self, level: Fact<ReturnLevel>) -> Result<Option<Code>, Fault> {
        let fixed = self.dialect.cycles.return_level.map(ReturnLevel::from);
        match (level, fixed) {
            (Fact::Known(level), Some(fixed)) if level == fixed => Ok(None),
            (Fact::Known(_), Some(_)) => Err(cannot(HolesLack::OtherReturnLevel)),
            (Fact::Entry, Some(_)) => Err(cannot(HolesLack::CallersReturnLevel)),
            (Fact::Entry, None) if self.words.active.our_level => Err(cannot(HolesLack::ReturnLevelUnknown)),
            (Fact::Entry, None) => Ok(None),
            (Fact::Known(level), None)
                if self.words.active.level == Some(level)
                    && !self.words.active.our_level
                    // Else the last move has ended it.
                    && !self.dialect.cycles.level_lost =>
            {
                Ok(None)
            }
            (Fact::Known(level), None) => {
                let code = self.words.setting(Setting::Level(level))?;
                self.words.active.level = Some(level);
                self.words.active.our_level = true;
                Ok(code)
            }
        }
    }

    /// The axis words of a call in the order of the axes, the bottom among them.
    fn call_axes(
        &mut self,
        at: Option<&Point>,
        mut depth: Option<&(Letter, Coord)>,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        for axis in Axis::ALL {
            if let Some((letter, coord)) = depth.take_if(|(l, _)| l.letter <= axis.letter() || axis > Axis::Z)
            {
                let value = self.words.value(letter, &coord.value, span, sink)?;
                self.words.block.word(Part::Axes, letter.letter, value);
            }
            if let Some(coord) = at.and_then(|p| p.get(axis)) {
                self.words.axis_word(axis, coord, span, sink)?;
            }
        }
        Ok(())
    }
}
