//! Lowers the functions of a block that are neither moves, cycles nor calls, in the order of execution.
//!
//! ```text
//! S1200 M3 G4 P500    →    SET_SPINDLE_SPEED, START_SPINDLE_CLOCKWISE, DWELL
//! ```
//!
//! It covers modes, feed, speed and tool words, spindle, coolant, dwell, length offsets and stops.
//! Not here: moves, cycles and calls, each in its file.

use ncc_dialects::{CHANGE_IN_BLOCK, DWELL_UNIT, FIRST_TOOL, Meaning, Quantity};
use ncc_ir::canon::{AdviceKind, Motion, PathMode, SpindleMode};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::program::{Advice, FrameSlot, Op, PathControl};
use ncc_ir::source::Span;
use ncc_ir::unsupported::left_out::LeftOut;
use ncc_ir::unsupported::{CodeUnsupported, FrameUnsupported, MoveUnsupported};

use super::block_words::{Code, Words, motion_of};
use super::frames::is_frame;
use super::lower::Lower;
use super::text::block::Block;
use super::word_state::{CycleState, KeptShift};
use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::setting::setting;
use crate::common::sort::{RANK_AFTER, RANK_MOTION, RANK_WORDS};
use crate::common::words::{Value, Word};

/// Whether a code takes the axis words of its block, so that they are no move.
fn takes_axes(meaning: Meaning) -> bool {
    is_frame(meaning)
        || matches!(
            meaning,
            Meaning::GoToReference { .. }
                | Meaning::SetData
                | Meaning::StorePosition(_)
                | Meaning::UseToolLength { .. }
        )
}

impl Lower {
    /// Lowers the functions of a block in the order of execution: settings, feed, speed and tool, codes before the
    /// move, the move, codes after it. `level` is the skip level of the block.
    pub(super) fn functions(
        &mut self,
        block: &Block,
        codes: &[Code],
        words: &mut Words,
        level: Option<u8>,
        src: Source,
        out: &mut Batch,
    ) {
        if self.change_by_hand(codes, words, block.span, src, out) {
            self.lose_level(true);
            return;
        }
        self.length_alone(codes, words, src, out);
        let change = codes.iter().find(|c| c.meaning == Meaning::ChangeTool);
        if let Some(change) = change.filter(|_| self.has_axis_word(words)) {
            self.option(CHANGE_IN_BLOCK, change.span, out);
        }
        let first_function = codes.partition_point(|c| self.rank(c) < RANK_WORDS);
        let (settings, functions) = codes.split_at(first_function);
        let before_motion = functions.partition_point(|c| self.rank(c) < RANK_MOTION);
        let (before, rest) = functions.split_at(before_motion);
        let motion_end = rest.partition_point(|c| self.rank(c) < RANK_AFTER);
        let (motion, after) = rest.split_at(motion_end);

        self.nothing_before_the_tap(codes, block.span, words, out);
        self.units_before_speed(settings, words, out);
        if self.settings.dialect.block.feed_before_units {
            // The feed mode comes first, then the feed, still in the units of the blocks before.
            for code in settings.iter().filter(|c| matches!(c.meaning, Meaning::SetFeedMode(_))) {
                self.setting(code, out);
            }
            self.feed_word(motion, words, src, out);
        }
        // The active cycle needs its plane: end the cycle first, so that each can have a separate block.
        let plane = |c: &Code| matches!(c.meaning, Meaning::SelectPlane(_));
        if matches!(self.state.cycle, CycleState::Active(_))
            && settings.iter().any(plane)
            && let Some(end) = motion.iter().find(|c| c.meaning == Meaning::EndCycle)
        {
            self.end_cycle(end, out);
        }
        let before_feed = self.settings.dialect.block.feed_before_units;
        if !codes.iter().any(|code| code.meaning == Meaning::PolarWords(false)) {
            codes.iter().for_each(|code| self.check_polar(code, out));
        }
        for code in settings {
            match code.meaning {
                Meaning::SetFeedMode(_) if before_feed => {}
                Meaning::PolarWords(on) => self.polar_words(code, on, out),
                Meaning::Advise(kind, None) => self.advise(code, kind, words, src, out),
                Meaning::Overrides(on) => {
                    for kind in [AdviceKind::FeedOverride, AdviceKind::SpeedOverride] {
                        let advice = Advice { kind, value: u8::from(on), amount: None };
                        self.push(code.span, Op::Advise(Box::new(advice)), out);
                    }
                }
                Meaning::Advise(AdviceKind::StrokeCheck, Some(_)) if self.has_axis_word(words) => {
                    let what = CodeUnsupported::StrokeLimits.into();
                    let code_text = code.row.code.as_str().into();
                    self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
                    b"XYZABC".iter().for_each(|letter| _ = words.take(*letter));
                }
                Meaning::SetOriginOffsets(first) if code.row.count.is_some() => {
                    self.counted_offset(code, first, words, src, out);
                }
                Meaning::SetMotionControlMode(_) if !code.row.words.is_empty() => {
                    self.path_within(code, words, src, out);
                }
                Meaning::SetSpindleMode(SpindleMode::Surface) => self.surface_speed(code, words, src, out),
                Meaning::SetPosition
                    if code.row.limits_speed
                        && (!self.has_axis_word(words) || words.get(self.roles.speed).is_some()) =>
                {
                    self.speed_limit(code, functions, words, src, out);
                }
                meaning if is_frame(meaning) => {
                    self.frame(code, functions, words, src, out);
                    if self.now.failed {
                        // These words belong to the frame. They are no move.
                        let own = b"XYZABC".iter().copied().chain(code.row.words.bytes());
                        own.for_each(|letter| _ = words.take(letter));
                    }
                }
                _ => self.setting(code, out),
            }
        }
        self.feed_word(motion, words, src, out);
        // Its words may have the addresses of other functions.
        let oriented = before.iter().find(|code| code.meaning == Meaning::OrientSpindle);
        self.now.angle = oriented.and_then(|code| self.orient_words(code, words, src, out));
        self.speed_and_tool(words, src, out);
        let mut dwell = false;
        for code in before {
            self.skip_in_tail(block, code, level);
            dwell |= code.meaning == Meaning::Dwell;
            self.function(code, words, src, out);
        }
        self.now.skip = if block.tail.is_some() { None } else { level };
        self.corrector(words, src, out);
        // The length offset is active now. Its entry may also give the radius.
        self.compensation(codes, words, src, out);
        let others = codes.iter().any(|code| takes_axes(code.meaning));
        let moves = motion.iter().any(|code| {
            motion_of(code.meaning).is_some() || matches!(code.meaning, Meaning::StraightProbe(_))
        }) || !others && self.has_axis_word(words);
        self.motion_codes(motion, dwell, block.span, words, src, out);
        self.lose_level(moves);
        for code in after {
            self.skip_in_tail(block, code, level);
            self.function(code, words, src, out);
        }
    }

    /// Sets the skip level of a code where the skip mark is in the middle of the block: only codes after it skip.
    fn skip_in_tail(&mut self, block: &Block, code: &Code, level: Option<u8>) {
        if let Some(tail) = block.tail {
            self.now.skip = if code.at >= tail { level } else { None };
        }
    }

    /// Records a mode in the state, even if ncc refuses the block.
    pub(super) fn set_mode(&mut self, meaning: Meaning, out: &mut Batch) {
        match meaning {
            Meaning::UseLengthUnits(units) => {
                self.state.modes.units = Know::Said(units);
                self.see_units(units, out);
            }
            Meaning::SelectPlane(plane) => self.state.modes.plane = Know::Said(plane),
            Meaning::SetDistanceMode(distance) => self.state.modes.distance = Know::Said(distance),
            Meaning::SetFeedMode(mode) => {
                // A new feed mode cancels the feed of the old one.
                if self.state.modes.feed_mode.value().is_some_and(|before| before != mode) {
                    self.state.modes.feed = Know::Unsaid;
                }
                self.state.modes.feed_mode = Know::Said(mode);
            }
            Meaning::SetReturnLevel(level) => {
                self.now.recall |= self.state.return_level.value() != Some(level);
                self.state.return_level = Know::Said(level);
                self.state.level_changed |= self.state.cycle == CycleState::Lost;
            }
            Meaning::SetCentreMode(from) => self.set_centre_mode(from, out),
            Meaning::SetOriginOffsets(offset) => self.state.modes.work_offset = Know::Said(offset),
            Meaning::ClearFrame(FrameSlot::Shift) => {
                self.state.modes.no_shift = Know::Said(true);
                self.state.shift_kept = KeptShift::Active;
            }
            Meaning::UseOriginShift(on) => {
                if !on {
                    self.state.modes.no_shift = Know::Said(true);
                }
                self.state.shift_kept = self.state.shift_kept.used(on);
            }
            Meaning::StraightTraverse => self.set_motion(Motion::Traverse),
            Meaning::StraightFeed => self.set_motion(Motion::Feed),
            Meaning::ArcFeed(turn) => self.set_motion(Motion::Arc(turn)),
            Meaning::StartCutterRadiusCompensation(_) | Meaning::StartCompensationByDiameter(_) => {
                self.state.compensated = Know::Said(true);
            }
            Meaning::StopCutterRadiusCompensation => self.state.compensated = Know::Said(false),
            Meaning::UseToolCentrePoint(on) => self.state.tip = Know::Said(on),
            Meaning::SetTilt => self.state.modes.tilt = Know::Said(true),
            Meaning::EndCycle => {
                self.state.cycle = CycleState::None;
                self.state.no_motion |= self.settings.dialect.cycles.ends_motion;
            }
            _ => {}
        }
    }

    pub(super) fn set_motion(&mut self, motion: Motion) {
        self.state.modes.motion = Know::Said(motion);
        (self.state.thread, self.state.lead) = (None, None);
        self.state.no_motion = false;
    }

    fn setting(&mut self, code: &Code, out: &mut Batch) {
        if let Meaning::ClearFrame(slot) = code.meaning {
            self.frame_over(slot);
            if slot == FrameSlot::Rotation && self.end_tilt(code, out) {
                return;
            }
        }
        if let (Meaning::SetOriginOffsets(_), false) = (code.meaning, self.now.failed) {
            self.check_shut(code, out);
        }
        if let (Meaning::UseOriginShift(true), KeptShift::Unknown) = (code.meaning, self.state.shift_kept) {
            let what = FrameUnsupported::OriginOfBefore.into();
            self.fault(Fault::NotSupported { code: code.row.code.as_str().into(), what }, code.span, out);
        }
        if let (Meaning::SelectPlane(plane), CycleState::Active(active)) = (code.meaning, &self.state.cycle)
            && active.plane.known() != Some(plane)
            // In emitted text, the plane at the start is the assumed one.
            && (self.assume || active.plane.known().is_some())
        {
            let what = MoveUnsupported::PlaneInCycle.into();
            self.fault(Fault::NotSupported { code: code.row.code.as_str().into(), what }, code.span, out);
        }
        self.set_mode(code.meaning, out);
        let op = match code.meaning {
            Meaning::LeftOut => {
                if self.first_time(code.row) {
                    out.report(Fault::CodeLeftOut { what: LeftOut::code(&code.row.code) }, code.span);
                }
                return;
            }
            Meaning::NoEffect => {
                let name = code.row.code.as_str();
                if self.assume && self.first_time(code.row) {
                    out.report(Fault::AssumedNoEffect { code: name.into() }, code.span);
                }
                Op::NoEffect(name.into())
            }
            meaning => match setting(meaning) {
                Some(op) => op,
                None => return,
            },
        };
        self.push(code.span, op, out);
    }

    /// Path blending with a tolerance (`G64 P Q`). The first word is the distance from the path; without it the
    /// control decides. The second is the distance within which moves merge into one line; by default the first.
    fn path_within(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) {
        let mut letters = code.row.words.bytes();
        let (first, second) = (letters.next().unwrap_or(0), letters.next().unwrap_or(0));
        let mut length = |lower: &mut Lower, letter: u8, out: &mut Batch| {
            let word = words.take(letter)?;
            let value = lower.amount(&word, Quantity::Length, words, src, out)?;
            match value.literal().is_some_and(|number| number.mantissa < 0) {
                true => lower.refuse(Fault::OutOfRange { word: src.text(word.span).into() }, word.span, out),
                false => Some((value, word.span)),
            }
        };
        let same = |one: &Expr, other: &Expr| match (one.literal(), other.literal()) {
            (Some(one), Some(other)) => one.trimmed() == other.trimmed(),
            _ => one == other,
        };
        let within = length(self, first, out);
        let merged = length(self, second, out);
        let control = match (within, merged) {
            (Some((within, _)), merged) => PathControl {
                merged: merged.map(|merged| merged.0).filter(|merged| !same(merged, &within)),
                within: Some(within),
                ..PathControl::plain(PathMode::Tolerance)
            },
            (None, None) => PathControl::plain(PathMode::Continuous),
            (None, Some((_, span))) => {
                let what = CodeUnsupported::CornerTolerance.into();
                return self.fault(Fault::NotSupported { code: src.text(span), what }, span, out);
            }
        };
        self.push(code.span, Op::SetMotionControlMode(Box::new(control)), out);
    }

    /// Lowers a code that advises the control. A word of the block switches it on or off.
    fn advise(&mut self, code: &Code, kind: AdviceKind, words: &mut Words, src: Source, out: &mut Batch) {
        let code_text: Box<str> = code.row.code.as_str().into();
        let letter = code.row.words.bytes().next().unwrap_or(b' ');
        let Some(word) = words.take(letter) else {
            if let Some(value) = kind.alone() {
                let advice = Advice { kind, value, amount: None };
                return self.push(code.span, Op::Advise(Box::new(advice)), out);
            }
            let word = char::from(letter).to_string().into();
            return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
        };
        if self.has_axis_word(words) {
            let what = CodeUnsupported::AdviceWithAxis.into();
            return self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
        }
        let value = match self.read_whole(&word, src, out) {
            None => return,
            Some(0) => 0,
            // The number of blocks to read ahead does not matter.
            Some(_) if kind == AdviceKind::ReadAhead => 1,
            Some(value) if kind.has_amount() && (value as usize) < kind.values().len() => value as u8,
            Some(value) if code.row.on.unwrap_or(1) == value => 1,
            Some(_) => {
                let what = CodeUnsupported::OtherUse.into();
                return self.fault(Fault::NotSupported { code: src.text(word.span), what }, word.span, out);
            }
        };
        let letter = code.row.words.as_bytes().get(1).copied().filter(|_| kind.has_amount());
        let word = letter.and_then(|letter| words.take(letter));
        let amount = match word.map(|word| self.amount(&word, Quantity::Length, words, src, out)) {
            Some(None) => return,
            Some(amount) => amount,
            None => None,
        };
        self.push(code.span, Op::Advise(Box::new(Advice { kind, value, amount })), out);
    }

    /// Lowers the speed word, then the tool word.
    pub(super) fn speed_and_tool(&mut self, words: &mut Words, src: Source, out: &mut Batch) {
        if let Some(word) = words.take(self.roles.speed)
            && let Some(value) = self.amount(&word, Quantity::Speed, words, src, out)
        {
            self.push(word.span, Op::SetSpindleSpeed(value), out);
        }
        if let Some(word) = words.take(self.roles.tool) {
            self.note_tool_code(&word);
            self.tool_named(&word);
            if let Some(value) = self.entry(&word, words, src, out) {
                self.push(word.span, Op::SelectTool(value), out);
            }
        }
    }

    /// Refuses a move or a speed word between the code for rigid tapping and its cycle: a control alarms.
    fn nothing_before_the_tap(&mut self, codes: &[Code], block: Span, words: &Words, out: &mut Batch) {
        let waits = self.state.rigid.is_some() && self.state.cycle == CycleState::None;
        let settled =
            |c: &Code| matches!(c.meaning, Meaning::StartCycle | Meaning::EndCycle | Meaning::Dwell);
        let words = || self.has_axis_word(words) || words.get(self.roles.speed).is_some();
        if waits && !codes.iter().any(settled) && words() {
            let what = MoveUnsupported::RigidTappingMove.into();
            self.fault(Fault::NotSupported { code: self.rigid_code(), what }, block, out);
        }
    }

    /// Number of a table entry or of a tool: whole and not negative, or an expression.
    pub(super) fn entry(&mut self, word: &Word, words: &Words, src: Source, out: &mut Batch) -> Option<Expr> {
        if let Value::Computed(_) = word.value {
            return self.amount(word, Quantity::Integer, words, src, out);
        }
        let whole = self.read_whole(word, src, out)?;
        Some(Expr::int(i64::from(whole)))
    }

    /// Before a tool change without a tool preselect, selects the tool of the option `FIRST_TOOL`, or reports it.
    fn tool_waits(&mut self, at: Span, out: &mut Batch) {
        if self.state.modes.tool != Know::Unsaid {
            return;
        }
        match self.settings.get(FIRST_TOOL).parse().ok().filter(|first| *first > 0) {
            Some(first) => {
                self.state.modes.tool = Know::Said(Some(first));
                self.push(at, Op::SelectTool(Expr::int(first.into())), out);
                let assumption = ControlFact::WaitingTool { tool: first };
                out.report(Fault::AssumedFact { fact: assumption }, at);
            }
            None => self.fault(Fault::NoToolSelected, at, out),
        }
    }

    /// Lowers a code that is executed before or after the move.
    fn function(&mut self, code: &Code, words: &mut Words, src: Source, out: &mut Batch) {
        if let Some(other) = code.row.read_as.as_deref()
            && self.assume
            && self.first_time(code.row)
        {
            let what = LeftOut::ReadAs { code: code.row.code.as_str().into(), other: other.into() };
            out.report(Fault::CodeLeftOut { what }, code.span);
        }
        let op = match code.meaning {
            Meaning::ChangeTool => {
                self.tool_waits(code.span, out);
                self.tool_changed();
                Op::ChangeTool
            }
            // Exact stop needs a move.
            Meaning::ExactStop if !self.has_axis_word(words) => return,
            Meaning::ExactStop => Op::ExactStop,
            Meaning::OrientSpindle => Op::OrientSpindle(self.now.angle.take().map(Expr::Num)),
            Meaning::StartSpindleClockwise => Op::StartSpindleClockwise,
            Meaning::StartSpindleCounterclockwise => Op::StartSpindleCounterclockwise,
            Meaning::StopSpindleTurning => Op::StopSpindleTurning,
            Meaning::MachineFunction(name) => {
                if !code.row.after_move && b"XYZABC".iter().any(|letter| words.get(*letter).is_some()) {
                    // The order of the function and the move depends on the machine.
                    let what = CodeUnsupported::AxisWords.into();
                    let code_text = code.row.code.as_str().into();
                    return self.fault(Fault::NotSupported { code: code_text, what }, code.span, out);
                }
                Op::MachineFunction(name.into())
            }
            Meaning::RigidTapping => {
                self.state.rigid = Some(code.span);
                return;
            }
            Meaning::FloodOn => Op::FloodOn,
            Meaning::MistOn => Op::MistOn,
            Meaning::CoolantOff => Op::CoolantOff,
            Meaning::Dwell => {
                let found =
                    code.row.dwell.iter().find_map(|d| Some((words.take(d.letter as u8)?, d.quantity)));
                let Some((word, quantity)) = found else {
                    let word = code.row.dwell.first().map_or(' ', |d| d.letter).to_string().into();
                    let code_text = code.row.code.as_str().into();
                    return self.fault(Fault::WordMissing { code: code_text, word }, code.span, out);
                };
                self.option(DWELL_UNIT, code.span, out);
                match self.amount(&word, quantity, words, src, out) {
                    Some(value) => Op::Dwell(value),
                    None => return,
                }
            }
            Meaning::UseToolLengthOffset => {
                self.end_tip(code.span, out);
                let word = words.take(self.roles.length_entry);
                if word.is_none() && code.row.own_tool {
                    self.state.length_open(true);
                    let edge = Expr::int(1);
                    return self.push(code.span, Op::UseToolEdge { edge, said: true }, out);
                }
                let Some(word) = word else { return self.length_as_before(code, words, out) };
                return self.length_offset(&word, code.span.to(word.span), words, src, out);
            }
            Meaning::UseToolLength { added } => return self.stated_length(code, added, words, src, out),
            Meaning::UseToolCentrePoint(true) => return self.use_tip(code, words, src, out),
            Meaning::OrientToolAxis => return self.upright(code, words, out),
            Meaning::CancelToolLengthOffset => {
                self.end_tip(code.span, out);
                self.state.length_open(false);
                Op::UseToolLengthOffset(Expr::int(0))
            }
            Meaning::SetData => return self.data(code, words, src, out),
            Meaning::StorePosition(_) | Meaning::SetToolNumber => return self.stored(code, words, src, out),
            Meaning::ProgramStop => Op::ProgramStop,
            Meaning::OptionalProgramStop => Op::OptionalProgramStop,
            Meaning::ProgramEnd => {
                self.ended |= self.now.skip.is_none();
                self.main_ending.ends |= self.sub.is_none();
                Op::ProgramEnd
            }
            Meaning::BeginAgain => return self.begin_again(code, out),
            Meaning::Return if self.goes_on_within(code, words, src, out) => return,
            // The executor checks called programs: ncc keeps the program whole from here on.
            Meaning::Return if self.level_open() && self.may_go_back() => {
                // The caller may not know the changed length offset.
                return self.refuse_level(code.span, out);
            }
            Meaning::Call => return self.call(code, words, src, out),
            Meaning::EndCallsAtMoves => return self.end_calls_at_moves(code, words, out),
            Meaning::Return => {
                let names = code.row.blocks.bytes().any(|letter| words.get(letter).is_some());
                if names && !self.may_go_back() {
                    // The main program continues at that block, without end.
                    self.endless(code.span, code.row.code.as_str().into(), out);
                } else if self.notes_return(code, words, src, out) {
                    self.return_from(code, out);
                }
                return;
            }
            _ => return,
        };
        self.push(code.span, op, out);
    }

    /// A word that activates a length offset without a code: `O` on mach9 (option `o_word`).
    fn corrector(&mut self, words: &mut Words, src: Source, out: &mut Batch) {
        let Some(word) = words.take(self.roles.corrector) else {
            return;
        };
        if self.option("o_word", word.span, out) == "ignore" {
            let _ = self.read_whole(&word, src, out);
            self.state.modes.length = Know::Said(true);
            return;
        }
        let zero = matches!(word.value, Value::Number(d) if d.mantissa == 0);
        let sure = self.settings.dialect.address_row(word.letter).is_none_or(|row| row.zero_sure);
        if self.assume && zero && !sure && !std::mem::replace(&mut self.reported.no_length, true) {
            let meaning = Meaning::CancelToolLengthOffset.to_string().into();
            out.report(Fault::AssumedRow { code: src.text(word.span), meaning }, word.span);
        }
        self.length_offset(&word, word.span, words, src, out);
    }

    pub(super) fn length_offset(
        &mut self,
        word: &Word,
        span: Span,
        words: &Words,
        src: Source,
        out: &mut Batch,
    ) {
        self.note_length_code(word);
        self.length_named(word, out);
        match self.entry(word, words, src, out) {
            Some(entry) => self.use_entry(entry, span, words, out),
            None => self.state.length_open(true),
        }
    }

    /// Activates the length offset of an entry. It takes effect at the next Z move.
    pub(super) fn use_entry(&mut self, entry: Expr, span: Span, words: &Words, out: &mut Batch) {
        self.state.length_open(true);
        let with_z = words.get(b'Z').is_some();
        if self.assume && !with_z && !std::mem::replace(&mut self.reported.offset_with_z, true) {
            out.report(Fault::AssumedOffsetWithZ, span);
        }
        self.push(span, Op::UseToolLengthOffset(entry), out);
    }
}
