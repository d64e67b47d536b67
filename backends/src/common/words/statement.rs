//! One statement that is stated by codes and words alone: which ones, and where they stand in the block.

use ncc_ir::canon::{Motion, PathMode, Side, SpindleMode};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Num;
use ncc_ir::lack::{
    CompensationLack, FeedsLack, FlowLack, FramesLack, HolesLack, Lack, ModesLack, SpindleLack, ToolsLack,
    WordsLack,
};
use ncc_ir::program::{Advice, CutterRadius, FrameSlot, Op, PathControl, Stmt};
use ncc_ir::source::Span;

use super::Words;
use crate::common::block::{Need, Part, Rank};
use crate::common::codes::{AdviceCode, Code, Letter};
use crate::common::fault::{cannot, unwritable};
use crate::common::number::{Shaped, WordValue};
use crate::common::setting::Setting;
use crate::common::{Sink, number};

impl Words {
    /// Puts a statement into the block at hand, or into a new one if it does not fit. Statements that every language
    /// says in its own way are their writers'.
    ///
    /// # Errors
    /// The dialect cannot say it by codes and words alone.
    pub(crate) fn statement(&mut self, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        let span = stmt.span;
        match &stmt.op {
            Op::Comment(text) => {
                self.comment(text, span, sink);
                Ok(())
            }
            Op::NoEffect(name) => self.no_effect(name, span, sink),
            Op::Lines(_) => Err(cannot(WordsLack::Packed)),
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
                None => Err(cannot(FramesLack::Clear)),
            },
            Op::StartCutterRadiusCompensation { side, radius } => {
                self.compensation(*side, radius, span, sink)
            }
            Op::SetMotionControlMode(control) => self.path_control(control, span, sink),
            Op::ExactStop => self.exact_stop(sink),
            Op::Advise(advice) => self.advise(advice, span, sink),
            Op::SetSpindleMode(SpindleMode::Surface) => self.surface_speed(stmt, sink),
            Op::SetSlot(slot) => self.slot(slot, span, sink),
            Op::SetPosition(axes) => self.present_point(&axes[..], span, sink),
            Op::UseOriginShift(on) => self.origin_shift(*on, span, sink),
            Op::SynchronisedFeed(m) => self.thread(m, span, sink),
            Op::SetSpindleSpeed(speed) => {
                self.number_word(Rank::Speed, self.codes.speed, speed, SpindleLack::Speed, span, sink)
            }
            Op::SelectTool(tool) => {
                self.number_word(Rank::Tool, self.codes.tool, tool, ToolsLack::Number, span, sink)
            }
            Op::StraightTraverse(to) => self.straight(to, true, span, sink),
            Op::StraightFeed(to) => self.straight(to, false, span, sink),
            Op::Position(to) => self.position(to, span, sink),
            Op::OrientSpindle(angle) => {
                self.turned_in = None;
                self.orient(angle.as_ref(), span, sink)
            }
            Op::StartSpindleClockwise => {
                self.turned_in = None;
                self.m_code(Rank::SpindleOn, self.codes.spindle_clockwise, SpindleLack::Clockwise, sink)
            }
            Op::StartSpindleCounterclockwise => {
                self.turned_in = None;
                let code = self.codes.spindle_counterclockwise;
                self.m_code(Rank::SpindleOn, code, SpindleLack::Counterclockwise, sink)
            }
            Op::StopSpindleTurning => {
                let before = self.dialect.block.off_before_move;
                let rank = if before { Rank::SpindleOn } else { Rank::SpindleOff };
                self.m_code(rank, self.codes.spindle_stop, SpindleLack::Stop, sink)
            }
            Op::MachineFunction(name) => self.machine_function(name, sink),
            Op::FloodOn => self.m_code(Rank::Coolant, self.codes.flood, SpindleLack::Flood, sink),
            Op::MistOn => self.m_code(Rank::Coolant, self.codes.mist, SpindleLack::Mist, sink),
            Op::CoolantOff => {
                let before = self.dialect.block.off_before_move;
                let rank = if before { Rank::Coolant } else { Rank::CoolantOff };
                self.m_code(rank, self.codes.coolant_off, SpindleLack::CoolantOff, sink)
            }
            Op::ChangeTool => self.m_code(Rank::ToolChange, self.codes.change_tool, ToolsLack::Change, sink),
            Op::ProgramStop => self.m_code(Rank::Stop, self.codes.stop, FlowLack::ProgramStop, sink),
            Op::OptionalProgramStop => {
                self.m_code(Rank::Stop, self.codes.optional_stop, FlowLack::OptionalStop, sink)
            }
            Op::ProgramEnd => self.m_code(Rank::Stop, self.codes.end, FlowLack::ProgramEnd, sink),
            Op::Return => self.m_code(Rank::Call, self.codes.back, FlowLack::ReturnFromSubprogram, sink),
            // The writers say these themselves.
            Op::TurnRotaryAxes(_)
            | Op::Corner { .. }
            | Op::LimitSpindleSpeed(_)
            | Op::SelectToolByName(_)
            | Op::SetFrame(_)
            | Op::UseMachineCoordinates { .. }
            | Op::Probe(_)
            | Op::Detour(_)
            | Op::UseToolCentrePoint(_)
            | Op::OrientToolAxis(_)
            | Op::GoToReference(_)
            | Op::SetData(_)
            | Op::UseToolLength(_)
            | Op::UseToolEdge { .. }
            | Op::UseToolLengthOffset(_)
            | Op::ArcFeed(_)
            | Op::ArcForm(_)
            | Op::SetPole(_)
            | Op::Polar(_)
            | Op::SetFeedRate(_)
            | Op::Dwell(_)
            | Op::StartCycle(_)
            | Op::Hole(_)
            | Op::Pattern(_)
            | Op::EndCycle
            | Op::BeginAgain
            | Op::Message(_)
            | Op::MessageOf(_)
            | Op::Output(_)
            | Op::Alarm(_)
            | Op::Declare(_)
            | Op::Assign(..)
            | Op::Control(_)
            | Op::Call(_)
            | Op::RepeatBlocks(_)
            | Op::Goto(_)
            | Op::Label(_)
            | Op::Leave
            | Op::NextTurn => Err(cannot(WordsLack::CodesAndWords)),
        }
    }

    fn exact_stop(&mut self, sink: &mut Sink) -> Result<(), Fault> {
        if self.active.motion == Some(Motion::Cycle) {
            // Of which ways of a cycle it would be the end, no source tells.
            return Err(cannot(HolesLack::ExactStopInCycle));
        }
        let code = self.codes.exact_stop.ok_or_else(|| cannot(ModesLack::ExactStop))?;
        self.admit(&Need::new(Rank::ExactStop).code(Some(code)), sink)?;
        self.block.code(Part::Mode, &code);
        Ok(())
    }

    /// The value of a word: a number in the control's digits, or what is computed.
    ///
    /// # Errors
    /// It cannot be computed, is in another unit than the active one, or out of range.
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
    /// It is computed, in another unit than the active one, or out of range.
    pub(crate) fn number(
        &mut self,
        letter: &Letter,
        value: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<Shaped, Fault> {
        let Some(n) = value.literal() else {
            return Err(cannot(WordsLack::ComputedValue));
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
        lack: impl Into<Lack>,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let letter = letter.ok_or_else(|| cannot(lack))?;
        let value = self.value(&letter, value, span, sink)?;
        self.admit(&Need::new(rank).letter(letter.letter), sink)?;
        self.block.word(Part::Tail, letter.letter, value);
        Ok(())
    }

    pub(crate) fn m_code(
        &mut self,
        rank: Rank,
        code: Option<Code>,
        lack: impl Into<Lack>,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let code = code.ok_or_else(|| cannot(lack))?;
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
                let letter = letter.ok_or_else(|| cannot(ModesLack::MergedMovesTolerance))?;
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
        let code = code.ok_or_else(|| cannot(ModesLack::PathMode { mode: control.mode }))?;
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
        let code = code.ok_or_else(|| cannot(CompensationLack::Compensation))?;
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
                return Err(cannot(CompensationLack::Radius));
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
            return Err(cannot(ModesLack::Advice { kind: advice.kind }));
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
        let code = code.ok_or_else(|| cannot(WordsLack::MachineFunction { name: (*name).into() }))?;
        if !self.block.is_empty() {
            self.flush(false, sink);
            self.split = true;
        }
        self.admit(&Need::new(Rank::Alone).code(Some(code)), sink)?;
        self.block.code(Part::Tail, &code);
        Ok(())
    }

    pub(crate) fn feed_rate(&mut self, feed: &Expr, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let letter = self.codes.feed_word.ok_or_else(|| cannot(FeedsLack::Feed))?;
        let value = self.value(&letter, feed, span, sink)?;
        if matches!(value, WordValue::Number(Shaped { mantissa: 0, rounded: true, .. })) {
            return Err(cannot(FeedsLack::TooSmall));
        }
        self.feed_apart(sink);
        self.admit(&Need::new(Rank::Feed).letter(letter.letter), sink)?;
        self.block.word(Part::Feed, letter.letter, value);
        self.active.feed = feed.literal();
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

    /// A word without effect: its own code, or a comment.
    fn no_effect(&mut self, name: &str, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let Some(code) = self.codes.code_without_effect(name) else {
            self.comment(name, span, sink);
            return Ok(());
        };
        self.admit(&Need::new(Rank::Setting).code(Some(code)), sink)?;
        self.block.code(Part::Mode, &code);
        Ok(())
    }
}

/// Reports a number that lost digits.
pub(crate) fn rounded(letter: u8, n: Num, to: Shaped, span: Span, sink: &mut Sink) {
    let mut written = vec![letter];
    number::append(&mut written, to);
    let written = String::from_utf8_lossy(&written).into_owned().into();
    sink.report(Fault::Rounded { word: number::spell(letter, n), written }, span);
}
