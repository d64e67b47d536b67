//! Lowering of canned cycles: call-up, retained words, holes, repetition.
//!
//! The moves of a hole are not made here: a cycle stays a cycle.

use ncc_dialects::{AskedDwell, Bare, CYCLE_APPROACH, CycleRow, Quantity, TAPPING};
use ncc_ir::canon::{Distance, Fact, FeedMode, Plane, ReturnLevel};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::cycle::{Cycle, CycleKind};
use ncc_ir::program::{Coord, Move, Op};
use ncc_ir::source::Span;
use ncc_ir::unsupported::CycleUnsupported;

use super::kind::{Pecks, kind_of};
use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::words::{Value, Word};
use crate::word::block_words::{Code, Words, motion_of};
use crate::word::lower::Lower;
use crate::word::word_state::{ActiveCycle, CycleState};

/// Most repetitions of a cycle's block.
const MOST_REPEATS: u32 = 9999;

impl Lower {
    /// The feed word: of the block, or of the cycle that it activates or changes.
    pub(in crate::word) fn feed_word(
        &mut self,
        motion: &[Code],
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let Some(word) = words.take(self.roles.feed) else {
            return;
        };
        self.now.fed = true;
        if self.is_lead(motion) {
            return self.lead(&word, src, out);
        }
        self.rely_on_feed_mode(word.span, out);
        if let Value::Computed(_) = word.value {
            return self.computed_feed(&word, words, src, out);
        }
        let Some(mut num) = self.number(&word, Quantity::Feed, src, out) else {
            return;
        };
        let mode = self.state.modes.feed_mode.value().unwrap_or(FeedMode::PerMinute);
        if mode != FeedMode::PerMinute {
            let bare = matches!(word.value, Value::Number(d) if !d.point && d.mantissa != 0);
            if bare
                && self.settings.dialect.numbers(Quantity::Feed).bare == Bare::Increments
                && !self.calculator
            {
                let what = CycleUnsupported::FeedPerTurnPoint.into();
                return self.fault(Fault::NotSupported { code: src.text(word.span), what }, word.span, out);
            }
        }
        if mode == FeedMode::InverseTime {
            num.unit = Unit::One;
        }
        if !num.is_zero() {
            self.state.modes.feed = Know::Said(());
        }
        use ncc_dialects::Meaning::{EndCycle, StartCycle};
        if motion.iter().any(|c| c.meaning == StartCycle) {
            self.now.feed = Some(num);
            return;
        }
        let ends = motion.iter().any(|c| c.meaning == EndCycle || motion_of(c.meaning).is_some());
        if let (CycleState::Active(active), false) = (&mut self.state.cycle, ends)
            && active.feed.is_some()
        {
            active.feed = Some(num);
            self.state.cycle_feed = Some(num);
            self.now.recall = true;
            return;
        }
        self.state.cycle_feed = None;
        self.push(word.span, Op::SetFeedRate(Expr::Num(num)), out);
    }

    /// A feed that is computed. That of a cycle's block is one as any other, which is active from there on: the cycle
    /// itself would say it again where its variables may be others.
    fn computed_feed(&mut self, word: &Word, words: &Words, src: Source, out: &mut Batch) {
        if matches!(&self.state.cycle, CycleState::Active(active) if active.feed.is_some()) {
            return self.fault(Fault::MacroLanguage { what: src.text(word.span) }, word.span, out);
        }
        let Some(value) = self.amount(word, Quantity::Feed, words, src, out) else { return };
        self.state.modes.feed = Know::Said(());
        self.state.cycle_feed = None;
        self.push(word.span, Op::SetFeedRate(value), out);
    }

    /// Calls a cycle up, and makes its first hole if the dialect does.
    pub(in crate::word) fn start_cycle(
        &mut self,
        code: &Code,
        dwell: bool,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let dialect = self.settings.dialect;
        self.cycle_met();
        let Some(index) = dialect.cycle.iter().position(|r| r.code == code.row.code) else {
            return;
        };
        let row = &dialect.cycle[index];
        let refuse = |what: CycleUnsupported| Fault::not_supported(code.row.code.as_str(), what);
        if dwell {
            self.fault(refuse(CycleUnsupported::WithDwell), code.span, out);
        }
        if self.drills_scaled() {
            // Which of a cycle's distances are scaled is the control's own.
            self.fault(refuse(CycleUnsupported::UnderScale), code.span, out);
        }
        if !row.sure {
            self.assume_row(code.row, &code.meaning.to_string(), code.span, out);
        }
        let plane = self.plane(code.span, out);
        let depth_letter = self.depth_letter(row, plane);
        if depth_letter.is_none() {
            self.fault(refuse(CycleUnsupported::OtherAxis), code.span, out);
        }
        let distance = self.distance(code.span, out);
        if self.incremental_unknown(distance) {
            self.fault(refuse(CycleUnsupported::Increments), code.span, out);
        }
        let kept = match &self.state.cycle {
            CycleState::Active(active)
                if dialect.cycles.retained && (active.row == index || !dialect.cycles.retained_by_code) =>
            {
                let mut kept = (**active).clone();
                if dialect.cycles.measured_anew {
                    (kept.retract.distance, kept.depth.distance) = (distance, distance);
                }
                Some(kept)
            }
            CycleState::Active(_) | CycleState::None | CycleState::Lost => None,
        };
        let has_hole_word = self.has_axis_word(words) || words.get(row.retract as u8).is_some();
        self.check_rotary(row, block, words, out);
        // Pecks of other cycles' letter, in one that is made in one go.
        let peck = dialect.cycle.iter().find_map(|other| other.peck);
        let peck = peck.filter(|_| row.peck.is_none() && row.shift.is_none());
        if let Some(word) = peck.and_then(|letter| words.take(letter as u8)) {
            let what = if row.kind.starts_with("tap") {
                CycleUnsupported::PeckTapping
            } else {
                CycleUnsupported::PecksHere
            };
            let code_text = format!("{} {}", row.code, src.text(word.span)).into();
            self.fault(Fault::NotSupported { code: code_text, what: what.into() }, word.span, out);
        }
        let depth_letter = depth_letter.unwrap_or(row.depth);
        let given = self.cycle_words(row, depth_letter, distance, words, src, out);
        let bare = given.depth.is_none() && !self.has_axis_word(words);
        let depth = given.depth.or_else(|| kept.as_ref().map(|k| k.depth.clone()));
        let retract = given.retract.or_else(|| kept.as_ref().map(|k| k.retract.clone()));
        self.note_dwell(row, given.dwell, out);
        let dwell = given.dwell.or_else(|| kept.as_ref().and_then(|k| k.dwell));
        let dwell = dwell.or_else(|| self.dwell_left(row, code, out));
        if dwell.is_none() {
            self.no_dwell_before(row, code, out);
        }
        let peck = given.peck.or_else(|| kept.as_ref().and_then(|k| k.peck.clone()));
        let shrinking = given.shrinking.or_else(|| kept.as_ref().and_then(|k| k.shrinking));
        let pecks = self.pecks(row, peck.clone(), shrinking, code.span, out);
        let blame = !self.now.failed;
        for (letter, missing) in [(depth_letter, depth.is_none()), (row.retract, retract.is_none())] {
            if missing && blame {
                self.missing(code, letter, out);
            }
        }
        if dialect.cycles.measured_anew && blame && bare && depth.is_some() {
            // A code of motion without an axis word is an error there.
            self.missing(code, depth_letter, out);
        }
        let rigid = self.tap_is_rigid(row, code.span, out);
        let bottom = self.dwells(row, [given.dwell, dwell], code.span, out);
        let bottom = self.tap_dwell(row, rigid, bottom, code.span, out);
        let kind = self.kind(row, rigid, bottom, pecks, code, out);
        let feed = self.now.feed;
        if feed.is_some() {
            self.state.cycle_feed = feed;
        } else {
            self.rely_on_feed(block, out);
        }
        let (Some(depth), Some(retract), Some(kind)) = (depth, retract, kind) else {
            self.state.cycle = CycleState::Lost;
            return;
        };
        let called = match &mut self.state.cycle {
            CycleState::Active(before) => before.called.take(),
            CycleState::None | CycleState::Lost => None,
        };
        let active =
            ActiveCycle { row: index, plane, retract, depth, kind, dwell, peck, shrinking, feed, called };
        self.state.cycle = CycleState::Active(Box::new(active));
        self.call_up(block, out);
        if dialect.cycles.hole_on_definition && has_hole_word {
            self.hole(true, depth_letter, block, words, src, out);
        } else {
            self.repeat(words, src, out);
        }
    }

    /// A block while a cycle is active, without a code of motion.
    pub(in crate::word) fn in_cycle(
        &mut self,
        dwell: bool,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let dialect = self.settings.dialect;
        let CycleState::Active(active) = &self.state.cycle else {
            return;
        };
        let row = &dialect.cycle[active.row];
        let depth_letter = self.depth_letter(row, active.plane).unwrap_or(row.depth);
        let has_hole_word = !dwell && (self.has_axis_word(words) || words.get(row.retract as u8).is_some());
        if has_hole_word {
            let distance = self.distance(block, out);
            if self.incremental_unknown(distance) {
                let what = CycleUnsupported::Increments.into();
                self.fault(Fault::NotSupported { code: row.code.as_str().into(), what }, block, out);
            }
            self.check_rotary(row, block, words, out);
            if let (CycleState::Active(active), true) = (&mut self.state.cycle, dialect.cycles.measured_anew)
                && (active.retract.distance, active.depth.distance) != (distance, distance)
            {
                (active.retract.distance, active.depth.distance) = (distance, distance);
                self.now.recall = true;
            }
            if dialect.cycles.retained {
                self.change_cycle(row, depth_letter, distance, block, words, src, out);
            }
        }
        if self.now.recall {
            self.call_up(block, out);
        }
        if has_hole_word {
            self.hole(false, depth_letter, block, words, src, out);
        }
    }

    /// Words that change the active cycle.
    #[allow(clippy::too_many_arguments)] // All that a block says of its cycle.
    fn change_cycle(
        &mut self,
        row: &'static CycleRow,
        depth_letter: char,
        distance: Fact<Distance>,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let given = self.cycle_words(row, depth_letter, distance, words, src, out);
        self.note_dwell(row, given.dwell, out);
        let CycleState::Active(active) = &mut self.state.cycle else {
            return;
        };
        let pecks = given.peck.is_some() || given.shrinking.is_some();
        let changes = given.depth.is_some() || given.retract.is_some() || given.dwell.is_some() || pecks;
        if !changes {
            return;
        }
        if let Some(depth) = given.depth {
            active.depth = depth;
        }
        if let Some(retract) = given.retract {
            active.retract = retract;
        }
        active.dwell = given.dwell.or(active.dwell);
        active.peck = given.peck.or(active.peck.take());
        active.shrinking = given.shrinking.or(active.shrinking);
        let rigid = active.kind.name() == "tap-rigid";
        let (dwell, peck, shrinking) = (active.dwell, active.peck.clone(), active.shrinking);
        let bottom = self.dwells(row, [given.dwell, dwell], block, out);
        let bottom = self.tap_dwell(row, rigid, bottom, block, out);
        let pecks = self.pecks(row, peck, shrinking, block, out);
        if let (Ok(kind), CycleState::Active(active)) =
            (kind_of(row, rigid, bottom, pecks), &mut self.state.cycle)
        {
            active.kind = kind;
        }
        self.now.recall = true;
    }

    /// The active cycle as a statement.
    pub(in crate::word) fn call_up(&mut self, block: Span, out: &mut Batch) {
        let return_level = self.return_level(block, out);
        let anew = self.start_anew(return_level, block, out);
        let CycleState::Active(active) = &self.state.cycle else {
            return;
        };
        let mut kind = active.kind.clone();
        if return_level == Fact::Known(ReturnLevel::Retract) {
            kind.end_feed_at_retract();
        }
        let cycle = Cycle {
            kind,
            plane: active.plane,
            retract: active.retract.clone(),
            depth: active.depth.clone(),
            return_level,
            return_plane: None,
            reference: None,
            approach: self.settings.approach(),
            feed: active.feed.map(Expr::Num),
        };
        self.push(block, Op::StartCycle(Box::new(cycle)), out);
        if anew {
            self.separate(out);
        }
    }

    /// One hole, or as many as the block says.
    fn hole(
        &mut self,
        said: bool,
        depth_letter: char,
        block: Span,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) {
        let times = self.repeat(words, src, out);
        let mark = self.now.mark;
        if self.target(out).iter().skip(mark).any(|stmt| stmt.op == Op::ExactStop) {
            // Of which ways of the cycle it would be the end, no source tells.
            let what = CycleUnsupported::ExactStop.into();
            self.fault(Fault::NotSupported { code: src.text(block), what }, block, out);
        }
        let to = self.point(Some(depth_letter as u8), block, words, src, out);
        // How the tool comes to a hole elsewhere is open in some dictionaries: it is reported.
        self.option(CYCLE_APPROACH, block, out);
        for turn in 0..times {
            if self.now.failed {
                return;
            }
            let hole = Move { to: to.clone(), said: said && turn == 0 };
            self.push_move(block, Op::Hole(hole), src, out);
            if turn > 0 {
                self.separate(out);
            }
            self.holes_made();
        }
    }

    /// A hole has used the cycle's feed.
    pub(in crate::word) fn holes_made(&mut self) {
        if self.now.skip.is_none() {
            self.state.cycle_feed = None;
        }
    }

    /// Repeat count of the block's hole.
    fn repeat(&mut self, words: &mut Words, src: Source, out: &mut Batch) -> u32 {
        let letter = self.settings.repeat_word();
        let Some(word) = letter.and_then(|l| words.take(l as u8)) else {
            return 1;
        };
        match self.read_whole(&word, src, out) {
            Some(times)
                if times <= MOST_REPEATS && (times > 0 || !self.settings.dialect.cycles.repeat_once) =>
            {
                times
            }
            Some(_) => {
                self.fault(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
                0
            }
            None => 0,
        }
    }

    /// The letter of a cycle's bottom in a plane; `None` if the cycle does not work there.
    pub(in crate::word) fn depth_letter(&self, row: &CycleRow, plane: Fact<Plane>) -> Option<char> {
        let Some(plane) = plane.known() else { return Some(row.depth) };
        let normal = char::from(plane.axes().2.letter());
        (normal == row.depth || self.settings.dialect.cycles.any_plane && !row.one_plane).then_some(normal)
    }

    /// A cycle cannot turn rotary axes on some controls.
    fn check_rotary(&mut self, row: &CycleRow, block: Span, words: &Words, out: &mut Batch) {
        if self.settings.dialect.cycles.no_rotary && words.has_any(self.roles.rotary) {
            let what = CycleUnsupported::RotaryAxis.into();
            self.fault(Fault::NotSupported { code: row.code.as_str().into(), what }, block, out);
        }
    }

    /// The cycle's own words in the block.
    fn cycle_words(
        &mut self,
        row: &CycleRow,
        depth_letter: char,
        distance: Fact<Distance>,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Given {
        let mut level = |lower: &mut Lower, letter: char| {
            let word = words.take(letter as u8)?;
            let value = lower.amount(&word, Quantity::Length, words, src, out)?;
            Some(Coord { value, distance })
        };
        let depth = level(self, depth_letter);
        let retract = level(self, row.retract);
        let dwell = row.dwell.or(row.dwell_by.as_ref().map(AskedDwell::word)).and_then(|d| {
            let word = words.take(d.letter as u8)?;
            self.number(&word, d.quantity, src, out)
        });
        let peck = row.peck.or(row.shift).and_then(|letter| {
            let word = words.take(letter as u8)?;
            // Execution looks at what is computed.
            let num = match self.amount(&word, Quantity::Length, words, src, out)? {
                Expr::Num(num) => num,
                computed => return Some(computed),
            };
            if num.is_zero() {
                return self.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
            }
            if num.mantissa < 0 && self.settings.dialect.cycles.measured_anew {
                return self.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
            }
            // A peck's sign is ignored by the other controls that take one.
            Some(Expr::Num(Num { mantissa: num.mantissa.abs(), ..num }))
        });
        let shrinking = self.shrinking(row, words, src, out);
        Given { depth, retract, dwell, peck, shrinking }
    }

    /// The words of pecks that decrease: all of them, or none.
    fn shrinking(
        &mut self,
        row: &CycleRow,
        words: &mut Words,
        src: Source,
        out: &mut Batch,
    ) -> Option<[Num; 3]> {
        let letters = row.shrinking?;
        let found = letters.map(|letter| words.take(letter as u8));
        let word = found.iter().flatten().next()?;
        let code = || row.code.as_str().into();
        if let [None, None, Some(least)] = &found {
            let what = CycleUnsupported::RetractAfterPecks.into();
            let code = format!("{} {}", row.code, src.text(least.span)).into();
            return self.refuse(Fault::NotSupported { code, what }, least.span, out);
        }
        if let Some(missing) =
            letters.iter().zip(&found).find_map(|(letter, word)| word.is_none().then_some(letter))
        {
            let fault = Fault::WordMissing { code: code(), word: missing.to_string().into() };
            return self.refuse(fault, word.span, out);
        }
        let mut pecks = [Num::int(0, Unit::Mm); 3];
        for (peck, word) in pecks.iter_mut().zip(found.iter().flatten()) {
            *peck = self.number(word, Quantity::Length, src, out)?;
        }
        let [first, less, least] = pecks.map(|num| num.nanos(false).unwrap_or(0));
        if less < 0 || least <= 0 || first < least {
            return self.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out);
        }
        Some(pecks)
    }

    /// The pecks of a cycle. Which count where both are active, no source tells.
    fn pecks(
        &mut self,
        row: &CycleRow,
        peck: Option<Expr>,
        shrinking: Option<[Num; 3]>,
        at: Span,
        out: &mut Batch,
    ) -> Option<Pecks> {
        match (peck, shrinking.filter(|_| row.shrinking.is_some())) {
            (Some(_), Some(_)) => {
                let what = CycleUnsupported::TwoPecks.into();
                self.refuse(Fault::NotSupported { code: row.code.as_str().into(), what }, at, out)
            }
            (Some(peck), None) => Some(Pecks { peck, shrinking: None }),
            (None, Some([first, less, peck])) => {
                Some(Pecks { peck: Expr::Num(peck), shrinking: Some([first, less]) })
            }
            (None, None) => None,
        }
    }

    /// Whether a row's tapping is rigid: by its own kind, by a code before it, or as the machine is set.
    fn tap_is_rigid(&mut self, row: &CycleRow, at: Span, out: &mut Batch) -> bool {
        match row.kind.as_str() {
            "tap-rigid" => true,
            "tap" if self.state.rigid.is_some() => true,
            "tap" => self.option(TAPPING, at, out) == "rigid",
            _ => false,
        }
    }

    fn kind(
        &mut self,
        row: &CycleRow,
        rigid: bool,
        dwell: Option<Num>,
        peck: Option<Pecks>,
        code: &Code,
        out: &mut Batch,
    ) -> Option<CycleKind> {
        match kind_of(row, rigid, dwell, peck) {
            Ok(kind) => Some(kind),
            Err(letter) => {
                if !self.now.failed {
                    self.missing(code, letter, out);
                }
                None
            }
        }
    }

    pub(in crate::word) fn missing(&mut self, code: &Code, letter: char, out: &mut Batch) {
        let word = letter.to_string().into();
        self.fault(Fault::WordMissing { code: code.row.code.as_str().into(), word }, code.span, out);
    }
}

/// A cycle's words in one block.
struct Given {
    depth: Option<Coord>,
    retract: Option<Coord>,
    dwell: Option<Num>,
    peck: Option<Expr>,
    shrinking: Option<[Num; 3]>,
}
