//! One statement: which words say it, and where they stand in the block.

mod call;

use ncc_dialects::{COMPUTED_DWELL, DWELL_UNIT, Meaning};
use ncc_ir::diag::Fault;
use ncc_ir::expr::{Binary, Expr, Node};
use ncc_ir::lack::{
    ArcsLack, FeedsLack, FlowLack, FramesLack, HolesLack, LengthsLack, MachineLack, OperatorLack, PolarLack,
    ToolsLack, WordsLack,
};
use ncc_ir::program::{Op, Stmt};
use ncc_ir::run_time::{RunTimeFlow, RunTimeValue};
use ncc_ir::source::Span;

use super::Writer;
use super::macros::o_words::is_no_result_yet;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::Dwell;
use crate::common::fault::{cannot, cannot_compute};
use crate::common::number::WordValue;
use crate::common::words::rounded;
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
        if self.words.preamble.is_some() && self.words.absorb(stmt, sink)? {
            return Ok(());
        }
        if self.words.surfaces.unsaid.is_some() {
            self.limit_in_turns(&stmt.op, sink);
        }
        self.leave_polar(stmt, sink)?;
        self.stop_has_text(stmt)?;
        if goes_elsewhere(&stmt.op) {
            self.words.restore_distance(matches!(stmt.op, Op::Label(_)), sink)?;
        }
        let span = stmt.span;
        let codes = &self.words.codes;
        match &stmt.op {
            Op::Comment(_)
            | Op::Blank
            | Op::Lines(_)
            | Op::ClearFrame(_)
            | Op::UseLengthUnits(_)
            | Op::SetDistanceMode(_)
            | Op::SelectPlane(_)
            | Op::SetFeedMode(_)
            | Op::SetReturnLevel(_)
            | Op::SetOriginOffsets(_)
            | Op::StartCutterRadiusCompensation { .. }
            | Op::StopCutterRadiusCompensation
            | Op::SetMotionControlMode(_)
            | Op::Advise(_)
            | Op::SetSpindleMode(_)
            | Op::SetSlot(_)
            | Op::SetPosition(_)
            | Op::UseOriginShift(_)
            | Op::SynchronisedFeed(_)
            | Op::OrientSpindle(_)
            | Op::SetSpindleSpeed(_)
            | Op::SelectTool(_)
            | Op::StartSpindleClockwise
            | Op::StartSpindleCounterclockwise
            | Op::StopSpindleTurning
            | Op::MachineFunction(_)
            | Op::FloodOn
            | Op::MistOn
            | Op::CoolantOff
            | Op::StraightTraverse(_)
            | Op::StraightFeed(_)
            | Op::OptionalProgramStop
            | Op::ProgramEnd => self.words.statement(stmt, sink),
            Op::NoEffect(name) => match codes.code_without_effect(name) {
                None if self.sets_no_effect(name) => self.statement_alone(name, sink),
                Some(_) | None => self.words.statement(stmt, sink),
            },
            Op::TurnRotaryAxes(_) => Err(cannot(WordsLack::RotaryDirection)),
            Op::ExactStop if self.held.is_some() => Err(cannot(HolesLack::ExactStopInCycle)),
            Op::ExactStop => self.words.statement(stmt, sink),
            Op::Corner { shape, size } => self.ask_corner(*shape, size, span, sink),
            Op::LimitSpindleSpeed(limit) => self.speed_limit(limit, span, sink),
            Op::SelectToolByName(name) => Err(cannot(ToolsLack::Name { name: (**name).into() })),
            Op::SetFrame(_) => Err(cannot(FramesLack::Frame)),
            Op::UseMachineCoordinates { length } => {
                let code = codes.machine[usize::from(*length)];
                self.words.machine = Some(code.ok_or_else(|| cannot(MachineLack::CoordinatesCode))?);
                Ok(())
            }
            Op::Probe(probe) => {
                let found = codes.probes.iter().find(|(own, _)| own == probe);
                self.words.probe = Some(found.ok_or_else(|| cannot(MachineLack::Probing))?.1);
                Ok(())
            }
            Op::Detour(detour) => {
                let code = codes.detours[*detour as usize];
                self.words.detour = Some(code.ok_or_else(|| cannot(MachineLack::Detour))?);
                Ok(())
            }
            // It is stated with the length that follows.
            Op::UseToolCentrePoint(on) if codes.tip.is_some() || !on => {
                self.tip = *on;
                Ok(())
            }
            Op::UseToolCentrePoint(_) => Err(cannot(ToolsLack::TipControl)),
            Op::OrientToolAxis(None) => self.words.upright(span, sink),
            Op::OrientToolAxis(Some(_)) => Err(cannot(FramesLack::AxisTurning)),
            Op::GoToReference(reference) => self.reference(reference, span, sink),
            Op::SetData(data) => self.data(data, span, sink),
            Op::UseToolLength(length) => self.stated_length(length, span, sink),
            Op::UseToolEdge { edge, .. } => self.own_length(edge, span, sink),
            Op::ArcForm(_) => Err(cannot(ArcsLack::Form)),
            Op::RepeatBlocks(repeat) => self.repeat_blocks(repeat, span, sink),
            // The mode of polar words is about program zero alone; a pass has seen to it.
            Op::SetPole(_) if codes.polar[1].is_some() => Ok(()),
            Op::SetPole(_) => Err(cannot(PolarLack::Pole)),
            Op::Polar(polar) => self.polar(polar, stmt, sink),
            Op::SetFeedRate(feed) => self.feed_rate(feed, span, sink),
            Op::ChangeTool if self.dialect.can.change_by_hand => self.change_by_hand(span, sink),
            Op::ChangeTool => self.words.statement(stmt, sink),
            Op::UseToolLengthOffset(entry) => self.length_offset(entry, span, sink),
            Op::Dwell(seconds) => self.dwell(seconds, span, sink),
            Op::ArcFeed(arc) => self.arc(arc, span, sink),
            Op::Position(_) => {
                if self.dialect.caps.flow.inherits_motion {
                    self.call_up_now(stmt, sink)?;
                }
                self.words.statement(stmt, sink)
            }
            Op::StartCycle(cycle) => self.start_cycle(cycle, stmt, sink),
            Op::Hole(to) => self.holes(to, stmt, sink),
            Op::Pattern(pattern) => self.pattern(pattern, stmt, sink),
            Op::EndCycle => self.end_cycle(span, sink),
            Op::ProgramStop if self.stop_text.is_some() => self.stop_with_text(stmt, sink),
            Op::ProgramStop => self.words.statement(stmt, sink),
            Op::BeginAgain => self.words.m_code(Rank::Stop, codes.again, FlowLack::ProgramBeginsAgain, sink),
            Op::Message(text) if self.dialect.caps.modes.stop_messages => {
                self.stop_text = Some(text.clone());
                Ok(())
            }
            Op::Message(text) => self.message(text, sink),
            Op::Call(call) => self.call(call, stmt, sink),
            Op::Return => match self.o_return(stmt, sink) {
                Some(written) => written,
                None => self.words.statement(stmt, sink),
            },
            Op::MessageOf(pieces) if self.has_o_words() => self.o_message(pieces, span, sink),
            Op::Alarm(alarm) if self.has_o_words() => self.o_alarm(alarm, sink),
            Op::Leave if self.has_o_words() => self.o_leave(false, stmt, sink),
            Op::NextTurn if self.has_o_words() => self.o_leave(true, stmt, sink),
            Op::MessageOf(_) => Err(cannot(OperatorLack::MessageValues)),
            Op::Output(output) => self.output(output, stmt, sink),
            Op::Alarm(alarm) => self.alarm(alarm, stmt, sink),
            Op::Declare(_) => Err(cannot_compute(RunTimeValue::Declaration)),
            Op::Leave | Op::NextTurn => Err(cannot_compute(RunTimeFlow::LoopLeft)),
            Op::Assign(to, value) => self.assign(to, value, span, sink),
            Op::Control(control) => self.control(control, stmt, sink),
            Op::Goto(label) => self.go_to(label, stmt, sink),
            Op::Label(name) if self.dialect.program.macro_b => self.jump_label(name, stmt, sink),
            Op::Label(name) => self.label(name, sink),
        }
    }

    /// A message: a comment of its own form, in a line of its own.
    fn message(&mut self, text: &str, sink: &mut Sink) -> Result<(), Fault> {
        if self.dialect.comment.message.is_empty() {
            return Err(cannot(OperatorLack::OperatorMessage));
        }
        let waits = !self.words.block.is_empty() || !self.words.block.comment.is_empty();
        if waits {
            self.words.flush(false, sink);
            self.words.split = true;
        }
        let changed = self.words.comments.message(text, &mut self.words.block.comment);
        self.words.flush(false, sink);
        if changed { Err(cannot(OperatorLack::MessageCharacters)) } else { Ok(()) }
    }

    fn feed_rate(&mut self, feed: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        self.words.feed_rate(feed, span, sink)?;
        // A later feed takes the place of the one that a cycle brought.
        if let Some(held) = &mut self.held {
            held.cycle.feed = None;
            held.feed = None;
        }
        Ok(())
    }

    /// A length offset: a code and its entry, or a word that takes it up by itself.
    fn length_offset(&mut self, entry: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let none = entry.literal().is_some_and(|n| n.is_zero());
        if let (true, Some(code)) = (none, self.words.codes.no_length) {
            let rank = if self.dialect.can.length_alone { Rank::Alone } else { Rank::Offset };
            self.words.admit(&Need::new(rank).code(Some(code)), sink)?;
            self.words.block.code(Part::Mode, &code);
            return Ok(());
        }
        let taken_up = if self.tip { self.words.codes.tip } else { self.words.codes.length };
        if let (Some(code), Some(letter)) = (taken_up, self.words.codes.entry) {
            let value = self.words.value(&letter, entry, span, sink)?;
            self.words.admit(&Need::new(Rank::Offset).code(Some(code)).letter(letter.letter), sink)?;
            self.words.block.code(Part::Offset, &code);
            self.words.block.word(Part::Offset, letter.letter, value);
            // With control of the tip it stands where it is switched on.
            self.words.offset_waits = (self.dialect.can.offset_with_z && !self.tip).then_some(span);
            return Ok(());
        }
        let letter = self.words.codes.corrector.filter(|_| self.options.corrector_counts);
        let letter = letter.ok_or_else(|| cannot(LengthsLack::Offset))?;
        let value = self.words.value(&letter, entry, span, sink)?;
        self.words.rely("o_word", span, sink);
        let sure = self.dialect.address_row(letter.letter).is_none_or(|row| row.zero_sure);
        if none && !sure && !std::mem::replace(&mut self.told_no_length, true) {
            let code = format!("{}0", letter.letter as char).into();
            let meaning = Meaning::CancelToolLengthOffset.to_string().into();
            sink.report(Fault::AssumedRow { code, meaning }, span);
        }
        self.words.admit(&Need::new(Rank::Offset).letter(letter.letter), sink)?;
        self.words.block.word(Part::Offset, letter.letter, value);
        Ok(())
    }

    /// The length of the tool in the spindle, whichever that is.
    fn own_length(&mut self, edge: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let code = self.words.codes.length.filter(|_| self.words.codes.own_length && !self.tip);
        let code = code.filter(|_| edge.literal().and_then(|n| n.whole_number()) == Some(1));
        let code = code.ok_or_else(|| cannot(ToolsLack::Edge))?;
        self.words.admit(&Need::new(Rank::Offset).code(Some(code)), sink)?;
        self.words.block.code(Part::Offset, &code);
        self.words.offset_waits = self.dialect.can.offset_with_z.then_some(span);
        Ok(())
    }

    fn dwell(&mut self, seconds: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let (code, dwell) = self.words.codes.dwell.ok_or_else(|| cannot(FeedsLack::Dwell))?;
        self.words.rely(DWELL_UNIT, span, sink);
        // What is computed is rounded as its own word does it.
        let computed = milliseconds(seconds).is_some() && !dwell.milliseconds;
        let other = self.words.codes.dwells.iter().find(|word| computed && word.milliseconds);
        let dwell = other.copied().unwrap_or(dwell);
        let value = self.dwell_value(&dwell, seconds, span, sink)?;
        self.words.admit(&Need::new(Rank::Dwell).code(Some(code)).letter(dwell.word.letter), sink)?;
        self.words.block.code(Part::Mode, &code);
        self.words.block.word(Part::Mode, dwell.word.letter, value);
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
            self.words.rely(COMPUTED_DWELL, span, sink);
        }
        let counted = open && self.words.settings.get(COMPUTED_DWELL) == "milliseconds";
        if !dwell.milliseconds && !counted {
            return self.words.value(&dwell.word, seconds, span, sink);
        }
        let Some(n) = seconds.literal() else {
            let value = milliseconds(seconds);
            let value = value.ok_or_else(|| cannot_compute(RunTimeValue::Milliseconds))?;
            return self.words.computed(&dwell.word, value, span, sink);
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
}

/// The milliseconds of computed seconds that are stated by them.
fn milliseconds(seconds: &Expr) -> Option<&Expr> {
    let Expr::Node(node) = seconds else { return None };
    match &**node {
        Node::Binary(Binary::Divide, a, by) if *by == Expr::int(1000) => Some(a),
        _ => None,
    }
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
