//! One statement: which words say it, and where they stand in the block.

mod call;

use ncc_dialects::{COMPUTED_DWELL, DWELL_UNIT, Meaning};
use ncc_ir::canon::{Motion, PathMode, Side, SpindleMode};
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Binary, Expr, Node};
use ncc_ir::program::{Advice, CutterRadius, FrameSlot, Op, PathControl, Stmt};
use ncc_ir::source::Span;

use super::Writer;
use super::macros::o_words::is_no_result_yet;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::{AdviceCode, Code, Dwell, Letter};
use crate::common::fault::{cannot, cannot_compute, unwritable};
use crate::common::number::{Shaped, WordValue};
use crate::common::setting::Setting;
use crate::common::{Sink, number};

impl Writer {
    /// Puts a statement into the block at hand, or into a new one if it does not fit.
    ///
    /// # Errors
    /// The dialect cannot say it.
    pub(crate) fn statement(&mut self, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        if self.has_o_words() && is_no_result_yet(stmt) {
            return Ok(());
        }
        if self.preamble.is_some() && self.absorb(stmt, sink)? {
            return Ok(());
        }
        if self.surfaces.unsaid.is_some() {
            self.limit_in_turns(&stmt.op, sink);
        }
        self.leave_polar(stmt, sink)?;
        self.stop_has_text(stmt)?;
        if goes_elsewhere(&stmt.op) {
            self.restore_distance(matches!(stmt.op, Op::Label(_)), sink)?;
        }
        let span = stmt.span;
        let codes = &self.codes;
        if matches!(
            stmt.op,
            Op::OrientSpindle(_) | Op::StartSpindleClockwise | Op::StartSpindleCounterclockwise
        ) {
            self.turned_in = None;
        }
        match &stmt.op {
            Op::Comment(text) => {
                self.comment(text, span, sink);
                Ok(())
            }
            Op::NoEffect(name) => self.no_effect(name, span, sink),
            Op::Blank => {
                self.flush(true, sink);
                Ok(())
            }
            Op::ClearFrame(
                slot @ (FrameSlot::Local
                | FrameSlot::Rotation
                | FrameSlot::Scale
                | FrameSlot::Mirror
                | FrameSlot::Tilt),
            ) => self.clear_slot(*slot, span, sink),
            Op::UseLengthUnits(_)
            | Op::SetDistanceMode(_)
            | Op::SelectPlane(_)
            | Op::SetFeedMode(_)
            | Op::SetReturnLevel(_)
            | Op::SetOriginOffsets(_)
            | Op::ClearFrame(_)
            | Op::SetSpindleMode(SpindleMode::Turns)
            | Op::StopCutterRadiusCompensation => match Setting::from_op(&stmt.op) {
                Some(setting) => self.write_setting(setting, sink),
                None => Err(cannot("clearing this frame")),
            },
            Op::StartCutterRadiusCompensation { side, radius } => {
                self.compensation(*side, radius, span, sink)
            }
            Op::SetMotionControlMode(control) => self.path_control(control, span, sink),
            Op::TurnRotaryAxes(_) => Err(cannot("which way round a rotary axis goes")),
            Op::ExactStop if self.held.is_some() || self.active.motion == Some(Motion::Cycle) => {
                // Of which ways of a cycle it would be the end, no source tells.
                Err(cannot("an exact stop in a block of a cycle"))
            }
            Op::ExactStop => {
                let code = codes.exact_stop.ok_or_else(|| cannot("an exact stop of one move"))?;
                self.admit(&Need::new(Rank::ExactStop).code(Some(code)), sink)?;
                self.block.code(Part::Mode, &code);
                Ok(())
            }
            Op::Corner { shape, size } => self.ask_corner(*shape, size, span, sink),
            Op::Advise(advice) => self.advise(advice, stmt.span, sink),
            Op::SetSpindleMode(SpindleMode::Surface) => self.surface_speed(stmt, sink),
            Op::LimitSpindleSpeed(limit) => self.speed_limit(limit, span, sink),
            Op::SelectToolByName(name) => Err(cannot(format!("a tool called {name}"))),
            Op::SetFrame(_) => Err(cannot("a frame")),
            Op::SetSlot(slot) => self.slot(slot, span, sink),
            Op::SetPosition(axes) => self.present_point(&axes[..], span, sink),
            Op::UseOriginShift(on) => self.origin_shift(*on, span, sink),
            Op::UseMachineCoordinates { length } => {
                let code = codes.machine[usize::from(*length)];
                self.machine = Some(code.ok_or_else(|| cannot("machine coordinates"))?);
                Ok(())
            }
            Op::Probe(probe) => {
                let found = codes.probes.iter().find(|(own, _)| own == probe);
                self.probe = Some(found.ok_or_else(|| cannot("a probing move"))?.1);
                Ok(())
            }
            Op::Detour(detour) => {
                let code = codes.detours[*detour as usize];
                self.detour = Some(code.ok_or_else(|| cannot("a rapid move by a detour"))?);
                Ok(())
            }
            // It is said with the length that follows.
            Op::UseToolCentrePoint(on) if codes.tip.is_some() || !on => {
                self.tip = *on;
                Ok(())
            }
            Op::UseToolCentrePoint(_) => Err(cannot("control of the tool's tip")),
            Op::OrientToolAxis(None) => self.upright(span, sink),
            Op::OrientToolAxis(Some(_)) => Err(cannot("the way in which the tool's axis is turned")),
            Op::GoToReference(reference) => self.reference(reference, span, sink),
            Op::SetData(data) => self.data(data, span, sink),
            Op::UseToolLength(length) => self.stated_length(length, span, sink),
            Op::UseToolEdge { edge, .. } => self.own_length(edge, span, sink),
            Op::ArcForm(_) => Err(cannot("an arc in this form")),
            Op::SynchronisedFeed(m) => self.thread(m, span, sink),
            Op::OrientSpindle(angle) => self.orient(angle.as_ref(), span, sink),
            Op::RepeatBlocks(repeat) => self.repeat_blocks(repeat, span, sink),
            // The mode of polar words is about program zero alone; a pass has seen to it.
            Op::SetPole(_) if codes.polar[1].is_some() => Ok(()),
            Op::SetPole(_) => Err(cannot("a pole")),
            Op::Polar(polar) => self.polar(polar, stmt, sink),
            Op::SetFeedRate(feed) => self.feed_rate(feed, span, sink),
            Op::SetSpindleSpeed(speed) => {
                self.number_word(Rank::Speed, codes.speed, speed, "a spindle speed", span, sink)
            }
            Op::SelectTool(tool) => {
                let letter = codes.tool;
                self.number_word(Rank::Tool, letter, tool, "a tool number", span, sink)
            }
            Op::ChangeTool if self.dialect.can.change_by_hand => self.change_by_hand(span, sink),
            Op::ChangeTool => self.m_code(Rank::ToolChange, codes.change_tool, "a tool change", sink),
            Op::UseToolLengthOffset(entry) => self.length_offset(entry, span, sink),
            Op::StartSpindleClockwise => {
                self.m_code(Rank::SpindleOn, codes.spindle_clockwise, "a clockwise spindle", sink)
            }
            Op::StartSpindleCounterclockwise => {
                let code = codes.spindle_counterclockwise;
                self.m_code(Rank::SpindleOn, code, "a counter-clockwise spindle", sink)
            }
            Op::StopSpindleTurning => {
                let before = self.dialect.block.off_before_move;
                let rank = if before { Rank::SpindleOn } else { Rank::SpindleOff };
                self.m_code(rank, codes.spindle_stop, "a spindle stop", sink)
            }
            Op::MachineFunction(name) => self.machine_function(name, sink),
            Op::FloodOn => self.m_code(Rank::Coolant, codes.flood, "flood coolant", sink),
            Op::MistOn => self.m_code(Rank::Coolant, codes.mist, "mist coolant", sink),
            Op::CoolantOff => {
                let before = self.dialect.block.off_before_move;
                let rank = if before { Rank::Coolant } else { Rank::CoolantOff };
                self.m_code(rank, codes.coolant_off, "coolant off", sink)
            }
            Op::Dwell(seconds) => self.dwell(seconds, span, sink),
            Op::StraightTraverse(to) => self.straight(to, true, span, sink),
            Op::StraightFeed(to) => self.straight(to, false, span, sink),
            Op::ArcFeed(arc) => self.arc(arc, span, sink),
            Op::Position(to) => self.position(to, stmt, sink),
            Op::StartCycle(cycle) => self.start_cycle(cycle, stmt, sink),
            Op::Hole(to) => self.holes(to, stmt, sink),
            Op::Pattern(pattern) => self.pattern(pattern, stmt, sink),
            Op::EndCycle => self.end_cycle(span, sink),
            Op::ProgramStop if self.stop_text.is_some() => self.stop_with_text(stmt, sink),
            Op::ProgramStop => self.m_code(Rank::Stop, codes.stop, "a program stop", sink),
            Op::OptionalProgramStop => self.m_code(Rank::Stop, codes.optional_stop, "an optional stop", sink),
            Op::ProgramEnd => self.m_code(Rank::Stop, codes.end, "the program's end", sink),
            Op::BeginAgain => self.m_code(Rank::Stop, codes.again, "a program that begins again", sink),
            Op::Message(text) if self.dialect.caps.modes.stop_messages => {
                self.stop_text = Some(text.clone());
                Ok(())
            }
            Op::Message(text) => self.message(text, sink),
            Op::Call(call) => self.call(call, stmt, sink),
            Op::Return => match self.o_return(stmt, sink) {
                Some(written) => written,
                None => self.m_code(Rank::Call, self.codes.back, "a return from a subprogram", sink),
            },
            Op::MessageOf(pieces) if self.has_o_words() => self.o_message(pieces, span, sink),
            Op::Alarm(alarm) if self.has_o_words() => self.o_alarm(alarm, sink),
            Op::Leave if self.has_o_words() => self.o_leave(false, stmt, sink),
            Op::NextTurn if self.has_o_words() => self.o_leave(true, stmt, sink),
            Op::MessageOf(_) => Err(cannot("a message with values in it")),
            Op::Output(output) => self.output(output, stmt, sink),
            Op::Alarm(alarm) => self.alarm(alarm, stmt, sink),
            Op::Declare(_) => Err(cannot_compute("a variable that is made known")),
            Op::Leave | Op::NextTurn => Err(cannot_compute("a loop that is left")),
            Op::Assign(to, value) => self.assign(to, value, span, sink),
            Op::Control(control) => self.control(control, stmt, sink),
            Op::Goto(label) => self.go_to(label, stmt, sink),
            Op::Label(name) if self.dialect.program.macro_b => self.jump_label(name, stmt, sink),
            Op::Label(name) => self.label(name, sink),
        }
    }

    /// The value of a word: a number in the control's digits, or what is computed.
    ///
    /// # Errors
    /// It cannot be computed, is in another unit than the one in force, or out of range.
    pub(crate) fn value(
        &mut self,
        letter: &Letter,
        value: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<WordValue, Fault> {
        match value {
            Expr::Num(_) => self.number(letter, value, span, sink).map(WordValue::Number),
            Expr::Node(_) => self.computed(letter, value, span, sink),
        }
    }

    /// The number of a word in the control's digits.
    ///
    /// # Errors
    /// It is computed, in another unit than the one in force, or out of range.
    pub(crate) fn number(
        &mut self,
        letter: &Letter,
        value: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<Shaped, Fault> {
        let Some(n) = value.literal() else {
            return Err(cannot("a computed value"));
        };
        self.check_unit(n, span)?;
        let shaped = number::shape(n, &letter.format).map_err(|why| unwritable(why, letter.letter, n))?;
        if shaped.rounded {
            rounded(letter.letter, n, shaped, span, sink);
        }
        Ok(shaped)
    }

    /// A word on its own.
    fn number_word(
        &mut self,
        rank: Rank,
        letter: Option<Letter>,
        value: &Expr,
        what: &str,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let letter = letter.ok_or_else(|| cannot(what))?;
        let value = self.value(&letter, value, span, sink)?;
        self.admit(&Need::new(rank).letter(letter.letter), sink)?;
        self.block.word(Part::Tail, letter.letter, value);
        Ok(())
    }

    /// A message: a comment of its own form, in a line of its own.
    fn message(&mut self, text: &str, sink: &mut Sink) -> Result<(), Fault> {
        if self.dialect.comment.message.is_empty() {
            return Err(cannot("a message to the operator"));
        }
        let waits = !self.block.is_empty() || !self.block.comment.is_empty();
        if waits {
            self.flush(false, sink);
            self.split = true;
        }
        let changed = self.comments.message(text, &mut self.block.comment);
        self.flush(false, sink);
        if changed { Err(cannot("a message with these characters")) } else { Ok(()) }
    }

    pub(crate) fn m_code(
        &mut self,
        rank: Rank,
        code: Option<Code>,
        what: &str,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let code = code.ok_or_else(|| cannot(what))?;
        self.admit(&Need::new(rank).code(Some(code)), sink)?;
        self.block.code(Part::Tail, &code);
        Ok(())
    }

    /// A way of taking corners that has a code, and a length of its own where that is a word of the code.
    fn path_control(&mut self, control: &PathControl, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        if let (PathMode::Tolerance, Some(within), Some((code, letter))) =
            (control.mode, &control.within, self.codes.path_within)
        {
            let value = self.value(&letter, within, span, sink)?;
            let mut need = Need::new(Rank::Setting).code(Some(code)).letter(letter.letter);
            let mut merged = None;
            if let Some(length) = &control.merged {
                let letter = self.codes.path_merged;
                let letter = letter.ok_or_else(|| cannot("a tolerance for moves that are made one"))?;
                need = need.letter(letter.letter);
                merged = Some((letter, self.value(&letter, length, span, sink)?));
            }
            self.admit(&need, sink)?;
            self.block.code(Part::Mode, &code);
            self.block.word(Part::Mode, letter.letter, value);
            if let Some((letter, value)) = merged {
                self.block.word(Part::Mode, letter.letter, value);
            }
            return Ok(());
        }
        let code = self.codes.path[control.mode as usize];
        let plain = (&control.within, &control.rapids, &control.merged) == (&None, &None, &None);
        let code = code.filter(|_| plain);
        let code = code.ok_or_else(|| cannot(format!("corners by {}", control.mode.name())))?;
        self.admit(&Need::new(Rank::Setting).code(Some(code)), sink)?;
        self.block.code(Part::Mode, &code);
        Ok(())
    }

    /// Cutter radius compensation: the code of its side, and the entry that has the radius.
    fn compensation(
        &mut self,
        side: Side,
        radius: &CutterRadius,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let code = match radius {
            CutterRadius::Diameter(_) => self.codes.compensation_by_diameter[side as usize].map(|c| c.0),
            CutterRadius::Entry(_) | CutterRadius::Tool | CutterRadius::InForce => {
                self.codes.compensation[side as usize]
            }
        };
        let code = code.ok_or_else(|| cannot("cutter radius compensation"))?;
        let own = self.codes.compensation_by_diameter[side as usize].map(|c| c.1);
        let entry = match (
            radius,
            self.codes
                .radius_entry
                .map(|l| own.filter(|_| matches!(radius, CutterRadius::Diameter(_))).unwrap_or(l)),
        ) {
            (CutterRadius::Entry(entry) | CutterRadius::Diameter(entry), Some(letter)) => {
                Some((letter, self.value(&letter, entry, span, sink)?))
            }
            (CutterRadius::Tool, Some(_)) if self.codes.own_radius => None,
            (CutterRadius::InForce, None) => None,
            (
                CutterRadius::Entry(_)
                | CutterRadius::Tool
                | CutterRadius::InForce
                | CutterRadius::Diameter(_),
                _,
            ) => {
                return Err(cannot("compensation by this radius"));
            }
        };
        let need = Need::new(Rank::Offset).code(Some(code));
        let need = entry.map_or(need, |(letter, _)| need.letter(letter.letter));
        self.admit(&need, sink)?;
        self.block.code(Part::Offset, &code);
        if let Some((letter, value)) = entry {
            self.block.word(Part::Offset, letter.letter, value);
        }
        Ok(())
    }

    /// Advice: a code of its own, or one with a word that switches it, which stands alone.
    fn advise(&mut self, advice: &Advice, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let says = |found: &&AdviceCode| {
            let value = found.value.is_none_or(|value| value == advice.value);
            found.kind == advice.kind && value && (advice.amount.is_none() || found.amount.is_some())
        };
        let Some(AdviceCode { code, word, amount, .. }) = self.codes.advice.iter().find(says).copied() else {
            return Err(cannot(format!("advice on {}", advice.kind.name())));
        };
        let Some((letter, on)) = word else {
            self.admit(&Need::new(Rank::Setting).code(Some(code)), sink)?;
            self.block.code(Part::Mode, &code);
            return Ok(());
        };
        if !self.block.is_empty() {
            self.flush(false, sink);
            self.split = true;
        }
        self.admit(&Need::new(Rank::Alone).code(Some(code)).letter(letter), sink)?;
        self.block.code(Part::Mode, &code);
        let value = match advice.value {
            0 if advice.kind.alone() == Some(0) => return Ok(()),
            0 => 0,
            value if advice.kind.has_amount() => u32::from(value),
            _ => on,
        };
        self.block.digits(Part::Mode, letter, &value.to_string());
        if let (Some(letter), Some(value)) = (amount, &advice.amount) {
            let value = self.value(&letter, value, span, sink)?;
            self.block.word(Part::Mode, letter.letter, value);
        }
        Ok(())
    }

    /// A function of the machine, in a block of its own: what comes before and after it must not be a
    /// matter of the machine.
    fn machine_function(&mut self, name: &str, sink: &mut Sink) -> Result<(), Fault> {
        let code = self.codes.machine_functions.iter().find(|(n, _)| *n == name).map(|(_, code)| *code);
        let code = code.ok_or_else(|| cannot(format!("the machine function {name}")))?;
        if !self.block.is_empty() {
            self.flush(false, sink);
            self.split = true;
        }
        self.admit(&Need::new(Rank::Alone).code(Some(code)), sink)?;
        self.block.code(Part::Tail, &code);
        Ok(())
    }

    pub(crate) fn feed_rate(&mut self, feed: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let letter = self.codes.feed_word.ok_or_else(|| cannot("a feed"))?;
        let value = self.value(&letter, feed, span, sink)?;
        if matches!(value, WordValue::Number(Shaped { mantissa: 0, rounded: true, .. })) {
            return Err(cannot("a feed so small that the digits make it 0"));
        }
        self.feed_apart(sink);
        self.admit(&Need::new(Rank::Feed).letter(letter.letter), sink)?;
        self.block.word(Part::Feed, letter.letter, value);
        self.active.feed = feed.literal();
        // A later feed takes the place of the one that a cycle brought.
        if let Some(held) = &mut self.held {
            held.cycle.feed = None;
            held.feed = None;
        }
        Ok(())
    }

    /// A feed cannot stand in the block that changes its units, if it comes before them there.
    pub(crate) fn feed_apart(&mut self, sink: &mut Sink) {
        let groups = self.codes.units.iter().flatten().fold(0, |bits, code| bits | code.group);
        if self.dialect.block.feed_before_units && self.block.says(groups) {
            self.flush(false, sink);
            self.split = true;
        }
    }

    /// A length offset: a code and its entry, or a word that takes it up by itself.
    fn length_offset(&mut self, entry: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let none = entry.literal().is_some_and(|n| n.is_zero());
        if let (true, Some(code)) = (none, self.codes.no_length) {
            let rank = if self.dialect.can.length_alone { Rank::Alone } else { Rank::Offset };
            self.admit(&Need::new(rank).code(Some(code)), sink)?;
            self.block.code(Part::Mode, &code);
            return Ok(());
        }
        let taken_up = if self.tip { self.codes.tip } else { self.codes.length };
        if let (Some(code), Some(letter)) = (taken_up, self.codes.entry) {
            let value = self.value(&letter, entry, span, sink)?;
            self.admit(&Need::new(Rank::Offset).code(Some(code)).letter(letter.letter), sink)?;
            self.block.code(Part::Offset, &code);
            self.block.word(Part::Offset, letter.letter, value);
            // With control of the tip it stands where it is switched on.
            self.offset_waits = (self.dialect.can.offset_with_z && !self.tip).then_some(span);
            return Ok(());
        }
        let letter = self.codes.corrector.filter(|_| self.options.corrector_counts);
        let letter = letter.ok_or_else(|| cannot("a length offset"))?;
        let value = self.value(&letter, entry, span, sink)?;
        self.rely("o_word", span, sink);
        let sure = self.dialect.address_row(letter.letter).is_none_or(|row| row.zero_sure);
        if none && !sure && !std::mem::replace(&mut self.told_no_length, true) {
            let code = format!("{}0", letter.letter as char).into();
            let meaning = Meaning::CancelToolLengthOffset.to_string().into();
            sink.report(Fault::AssumedRow { code, meaning }, span);
        }
        self.admit(&Need::new(Rank::Offset).letter(letter.letter), sink)?;
        self.block.word(Part::Offset, letter.letter, value);
        Ok(())
    }

    /// The length of the tool in the spindle, whichever that is.
    fn own_length(&mut self, edge: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let code = self.codes.length.filter(|_| self.codes.own_length && !self.tip);
        let code = code.filter(|_| edge.literal().and_then(|n| n.whole_number()) == Some(1));
        let code = code.ok_or_else(|| cannot("an edge of a tool"))?;
        self.admit(&Need::new(Rank::Offset).code(Some(code)), sink)?;
        self.block.code(Part::Offset, &code);
        self.offset_waits = self.dialect.can.offset_with_z.then_some(span);
        Ok(())
    }

    fn dwell(&mut self, seconds: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let (code, dwell) = self.codes.dwell.ok_or_else(|| cannot("a dwell"))?;
        self.rely(DWELL_UNIT, span, sink);
        // What is computed is rounded as its own word does it.
        let computed = milliseconds(seconds).is_some() && !dwell.milliseconds;
        let other = self.codes.dwells.iter().find(|word| computed && word.milliseconds);
        let dwell = other.copied().unwrap_or(dwell);
        let value = self.dwell_value(&dwell, seconds, span, sink)?;
        self.admit(&Need::new(Rank::Dwell).code(Some(code)).letter(dwell.word.letter), sink)?;
        self.block.code(Part::Mode, &code);
        self.block.word(Part::Mode, dwell.word.letter, value);
        Ok(())
    }

    /// The value of a dwell word, in its own unit.
    pub(crate) fn dwell_value(
        &mut self,
        dwell: &Dwell,
        seconds: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<WordValue, Fault> {
        let open = seconds.literal().is_none() && !dwell.milliseconds;
        if open {
            self.rely(COMPUTED_DWELL, span, sink);
        }
        let counted = open && self.settings.get(COMPUTED_DWELL) == "milliseconds";
        if !dwell.milliseconds && !counted {
            return self.value(&dwell.word, seconds, span, sink);
        }
        let Some(n) = seconds.literal() else {
            let value = milliseconds(seconds);
            let value = value.ok_or_else(|| cannot_compute("computed seconds in a word of milliseconds"))?;
            return self.computed(&dwell.word, value, span, sink);
        };
        let letter = dwell.word.letter;
        let range = || Fault::TargetRange { word: number::spell(letter, n) };
        let (ms, lost) = number::milliseconds(n).ok_or_else(range)?;
        let shaped = number::shape(ms, &dwell.word.format).map_err(|_| range())?;
        if lost {
            rounded(letter, n, shaped, span, sink);
        }
        Ok(shaped.into())
    }

    /// Whether it is an assignment to a variable of the control's own that has no effect on what the program says.
    fn sets_no_effect(&self, name: &str) -> bool {
        let to = name.split('=').next();
        let variable = to.and_then(|to| to.strip_prefix(&*self.dialect.formula.variable));
        let number: Option<u32> = variable.and_then(|number| number.parse().ok());
        let row = |number| self.dialect.system.iter().find(|row| row.number == number);
        number.and_then(row).is_some_and(|row| self.dialect.program.macro_b && row.means == "single-block")
    }

    /// A word without effect: its own code, or a comment.
    fn no_effect(&mut self, name: &str, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let code = self.codes.no_effect.iter().find(|(own, _)| own == name).map(|(_, code)| *code);
        let Some(code) = code else {
            if self.sets_no_effect(name) {
                return self.statement_alone(name, sink);
            }
            self.comment(name, span, sink);
            return Ok(());
        };
        self.admit(&Need::new(Rank::Setting).code(Some(code)), sink)?;
        self.block.code(Part::Mode, &code);
        Ok(())
    }
}

/// The milliseconds of computed seconds that are said by them.
fn milliseconds(seconds: &Expr) -> Option<&Expr> {
    let Expr::Node(node) = seconds else { return None };
    match &**node {
        Node::Binary(Binary::Divide, a, by) if *by == Expr::int(1000) => Some(a),
        _ => None,
    }
}

/// Reports a number that lost digits.
pub(crate) fn rounded(letter: u8, n: ncc_ir::expr::num::Num, to: Shaped, span: Span, sink: &mut Sink) {
    let mut written = vec![letter];
    number::append(&mut written, to);
    let written = String::from_utf8_lossy(&written).into_owned().into();
    sink.report(Fault::Rounded { word: number::spell(letter, n), written }, span);
}

/// Whether control goes another way there, or comes from another.
fn goes_elsewhere(op: &Op) -> bool {
    matches!(
        op,
        Op::Call(_)
            | Op::Return
            | Op::RepeatBlocks(_)
            | Op::Control(_)
            | Op::Goto(_)
            | Op::Label(_)
            | Op::Leave
            | Op::NextTurn
    )
}
