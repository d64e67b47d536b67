//! One statement: which words say it.

use ncc_dialects::{Meaning, NameMeaning, NameRole, Quantity};
use ncc_ir::canon::{AdviceKind, CornerShape, Units};
use ncc_ir::diag::Fault;
use ncc_ir::lack::{
    FeedsLack, FlowLack, FramesLack, HolesLack, LengthsLack, MachineLack, ModesLack, OperatorLack,
    ThreadsLack, ToolsLack,
};
use ncc_ir::program::{Advice, FrameSlot, Op, PathControl, Stmt};
use ncc_ir::source::Span;

use ncc_ir::expr::Expr;

use super::{Modal, Sink, Writer};
use crate::common::block::{Need, Part, Rank};
use crate::common::fault::cannot;

/// Longest text of a message.
pub(super) const LONGEST_MESSAGE: usize = 200;

impl Writer {
    /// Puts a statement into the block at hand, or into a new one if it does not fit. `with` is how
    /// many statements of its block it says: with a cycle's call, the hole where the tool is and
    /// the end.
    ///
    /// # Errors
    /// The control cannot say it.
    pub(super) fn statement(&mut self, stmt: &Stmt, with: usize, sink: &mut Sink) -> Result<(), Fault> {
        self.words.says_distance = self.computing.word_distance.contains(&stmt.span.start);
        self.before_statement(stmt, sink)?;
        if self.words.preamble.is_some() && !matches!(stmt.op, Op::Declare(_)) {
            // No edge is no length, which belongs to the start.
            let none = Op::UseToolLengthOffset(Expr::int(0));
            let absorbed = match no_edge(&stmt.op) {
                true => self.words.absorb(&Stmt { op: none, ..stmt.clone() }, sink)?,
                false => self.words.absorb(stmt, sink)?,
            };
            if absorbed {
                return Ok(());
            }
        }
        let span = stmt.span;
        self.inches |= matches!(stmt.op, Op::UseLengthUnits(Units::Inch));
        if self.stale {
            self.called_up(&stmt.op)?;
        }
        match &stmt.op {
            Op::Comment(_)
            | Op::Blank
            | Op::Lines(_)
            | Op::SetDistanceMode(_)
            | Op::SelectPlane(_)
            | Op::SetFeedMode(_)
            | Op::StartCutterRadiusCompensation { .. }
            | Op::StopCutterRadiusCompensation
            | Op::ExactStop
            | Op::SetSpindleMode(_)
            | Op::SelectTool(_)
            | Op::StartSpindleClockwise
            | Op::StartSpindleCounterclockwise
            | Op::OrientSpindle(None)
            | Op::MachineFunction(_)
            | Op::FloodOn
            | Op::MistOn
            | Op::ProgramStop
            | Op::OptionalProgramStop
            | Op::ProgramEnd => self.words.statement(stmt, sink),
            Op::BeginAgain => {
                let row = self.dialect.name_for(NameMeaning::Code(Meaning::BeginAgain));
                let row = row.ok_or_else(|| cannot(FlowLack::ProgramBeginsAgain))?;
                self.alone(&row.name, sink)
            }
            Op::SetOriginOffsets(number) => {
                self.settable_frame(*number, span, sink)?;
                self.words.statement(stmt, sink)
            }
            Op::Return => {
                self.before_return(sink)?;
                self.words.restore_distance(false, sink)?;
                self.words.statement(stmt, sink)
            }
            Op::TurnRotaryAxes(ways) => {
                self.words.ways = *ways;
                Ok(())
            }
            Op::SynchronisedFeed(m) => {
                if std::mem::replace(&mut self.raw, false) {
                    return Err(cannot(ThreadsLack::MachineCoordinates));
                }
                self.before_move(&m.to, m.chuck, span, sink)?;
                self.words.statement(stmt, sink)
            }
            // Beside a move, machine data decide whether it is off before or after.
            Op::StopSpindleTurning | Op::CoolantOff => {
                if b"XYZABCIJK".iter().any(|letter| self.words.block.has(*letter)) {
                    self.words.flush(false, sink);
                    self.words.split = true;
                }
                self.words.statement(stmt, sink)
            }
            // Every call of a cycle says its return plane.
            Op::SetReturnLevel(_) => Ok(()),
            Op::UseLengthUnits(_) => {
                self.basic_feed = false;
                self.words.statement(stmt, sink)
            }
            Op::SetMotionControlMode(control) => {
                let plain = PathControl::plain(control.mode);
                let words: [(NameRole, &Option<Expr>); 2] =
                    [(NameRole::Rounding, &control.within), (NameRole::RoundingInRapids, &control.rapids)];
                let words: Vec<String> = words
                    .into_iter()
                    .filter_map(|(role, value)| Some((role, value.as_ref()?)))
                    .map(|(role, value)| self.named(role, value, None, span, sink))
                    .collect::<Result<_, _>>()?;
                let op = Op::SetMotionControlMode(Box::new(plain));
                self.words.statement(&Stmt { op, ..stmt.clone() }, sink)?;
                words.iter().for_each(|word| self.words.block.text(Part::Mode, word));
                Ok(())
            }
            Op::Corner { shape, size } => {
                let role = match shape {
                    CornerShape::Round => NameRole::RoundCorner,
                    CornerShape::Leg => NameRole::ChamferCorner,
                    CornerShape::Length => NameRole::ChamferCornerByLength,
                };
                self.words.corner = Some(self.named(role, size, None, span, sink)?);
                Ok(())
            }
            Op::Advise(advice) if advice.kind == AdviceKind::PathTolerance => {
                self.path_tolerance(advice, span, sink)
            }
            Op::Advise(advice) => {
                let meaning = NameMeaning::Code(Meaning::Advise(advice.kind, Some(advice.value)));
                match self.dialect.name_for(meaning) {
                    Some(row) if advice.amount.is_none() => {
                        self.words.admit(&Need::new(Rank::Setting), sink)?;
                        self.words.block.text(Part::Mode, &row.name);
                        Ok(())
                    }
                    _ => self.words.statement(stmt, sink),
                }
            }
            Op::LimitSpindleSpeed(speed) => {
                let word = self.named(NameRole::SpindleLimit, speed, None, span, sink)?;
                self.words.admit(&Need::new(Rank::Setting), sink)?;
                self.words.block.text(Part::Tail, &word);
                Ok(())
            }
            Op::OrientSpindle(Some(angle)) => {
                self.words.turned_in = None;
                self.named_alone(NameRole::SpindleAngle, angle, span, sink)
            }
            Op::NoEffect(name) => self.no_effect(name, stmt, sink),
            Op::UseToolCentrePoint(on) => {
                let row = self.dialect.name_for(NameMeaning::Code(Meaning::UseToolCentrePoint(*on)));
                let row = row.ok_or_else(|| cannot(ToolsLack::TipControl))?;
                self.alone(&row.name, sink)
            }
            // It is stated with the plane that it belongs to.
            Op::OrientToolAxis(_) => Err(cannot(FramesLack::AxisApartFromTilt)),
            Op::ClearFrame(FrameSlot::Tilt) => {
                let row = self.dialect.name_for(NameMeaning::Code(Meaning::SetTilt));
                let row = row.ok_or_else(|| cannot(FramesLack::TiltEnd))?;
                self.alone(&format!("{}()", row.name), sink)
            }
            Op::ClearFrame(FrameSlot::Chain) => self.clear_frames(sink),
            Op::ClearFrame(_) | Op::SetSlot(_) | Op::SetPosition(_) | Op::UseOriginShift(_) => {
                self.words.statement(stmt, sink)
            }
            Op::SetFrame(frame) => self.frame(frame, span, sink),
            Op::UseMachineCoordinates { length } => self.in_machine(*length),
            Op::SetSpindleSpeed(speed) => {
                self.standing.speed = speed.literal();
                self.words.statement(stmt, sink)
            }
            Op::Probe(_) => Err(cannot(MachineLack::Probing)),
            Op::Detour(_) => Err(cannot(MachineLack::Detour)),
            Op::GoToReference(_) => Err(cannot(MachineLack::ReferencePoint)),
            Op::SetData(data) => self.data(data, span, sink),
            Op::UseToolLength(_) => Err(cannot(LengthsLack::ByValue)),
            Op::SetFeedRate(feed) => {
                self.feed(feed, span, sink)?;
                self.standing.feed = feed.literal();
                self.standing.feed_said = true;
                Ok(())
            }
            Op::SelectToolByName(name) => self.tool_by_name(name, sink),
            Op::ChangeTool => self.change_tool(stmt, sink),
            Op::UseToolLengthOffset(entry) => self.length_offset(entry, span, sink),
            Op::UseToolEdge { edge, said } => self.edge(edge, *said, span, sink),
            Op::Dwell(seconds) => self.dwell(seconds, span, sink),
            Op::StraightTraverse(to) => self.straight(&to.to, false, stmt, sink),
            Op::StraightFeed(to) => self.straight(&to.to, true, stmt, sink),
            Op::ArcFeed(arc) => self.arc(arc, span, sink),
            Op::ArcForm(arc) => self.arc_form(arc, span, sink),
            Op::SetPole(set) => self.pole(set, span, sink),
            Op::Polar(polar) => self.polar(polar, span, sink),
            Op::Position(_) => {
                self.pay_call(sink)?;
                let open = self.words.active.motion.is_none() && stmt.skip.is_none();
                if self.cycled && self.standing.modal == Modal::Off && open {
                    return Err(cannot(HolesLack::OpenMotionAfterCycle));
                }
                self.words.statement(stmt, sink)
            }
            Op::StartCycle(cycle) => self.start_cycle(cycle, with, stmt, sink),
            Op::Hole(to) => self.hole(&to.to, span, sink),
            Op::Pattern(pattern) => self.pattern(pattern, stmt, sink),
            Op::EndCycle => self.end_modal(sink),
            Op::Message(text) => self.message(text, sink),
            Op::Call(call) => self.call(call, span, sink),
            Op::RepeatBlocks(repeat) => self.repeat_blocks(repeat, span, sink),
            Op::Label(name) if self.is_idle_label(name) => Ok(()),
            Op::Label(name) => self.label(name, span, sink),
            Op::Control(control) => self.control(control, stmt, sink),
            Op::MessageOf(pieces) => self.message_of(pieces, span, sink),
            Op::Output(_) => Err(cannot(OperatorLack::DeviceText)),
            Op::Alarm(alarm) => self.alarm(alarm, span, sink),
            Op::Assign(to, value) => self.assign(to, value, span, sink),
            // With those of its block.
            Op::Declare(_) => self.declare(std::slice::from_ref(stmt), sink),
            Op::Goto(label) => self.go_to(label, span, sink),
            Op::Leave | Op::NextTurn => Err(cannot(FlowLack::LoopLeft)),
        }
    }

    /// A named word in a block of its own.
    fn named_alone(
        &mut self,
        role: NameRole,
        value: &Expr,
        span: Span,
        sink: &mut Sink,
    ) -> Result<(), Fault> {
        let word = self.named(role, value, None, span, sink)?;
        self.alone(&word, sink)
    }

    /// The tolerance of the path, with the stage of machining as a number.
    fn path_tolerance(&mut self, advice: &Advice, span: Span, sink: &mut Sink) -> Result<(), Fault> {
        let row = self.dialect.name_for(NameMeaning::Code(Meaning::Advise(advice.kind, None)));
        let row = row.ok_or_else(|| cannot(ModesLack::PathTolerance))?;
        let stage = match advice.value_name() {
            "finishing" => 1,
            "semi-finishing" => 2,
            "roughing" => 3,
            _ => return self.alone(&format!("{}(0,0,1)", row.name), sink),
        };
        let amount = advice.amount.as_ref().ok_or_else(|| cannot(ModesLack::PathToleranceValue))?;
        let letter = self.letter("X", Quantity::Length);
        let amount = self.value(&letter, amount, span, sink)?;
        self.alone(&format!("{}({amount},{stage},1)", row.name), sink)
    }

    fn no_effect(&mut self, name: &str, stmt: &Stmt, sink: &mut Sink) -> Result<(), Fault> {
        let (word, arguments) = name.split_at(name.find('(').unwrap_or(name.len()));
        let row = self.dialect.name_row(&word.trim_end().to_ascii_uppercase());
        let row = row.filter(|row| row.means == Some(NameMeaning::Code(Meaning::NoEffect)));
        let Some(row) = row.filter(|row| arguments.is_empty() || row.arguments) else {
            return self.words.statement(stmt, sink);
        };
        if row.arguments {
            return self.alone(name, sink);
        }
        self.words.admit(&Need::new(Rank::Setting), sink)?;
        self.words.block.text(Part::Mode, name);
        Ok(())
    }

    /// A dwell, which stands alone because its F is no feed.
    fn dwell(&mut self, seconds: &Expr, span: ncc_ir::source::Span, sink: &mut Sink) -> Result<(), Fault> {
        let (code, dwell) = self.words.codes.dwell.ok_or_else(|| cannot(FeedsLack::Dwell))?;
        let name = (dwell.word.letter as char).to_string();
        let word = self.lettered(&name, &dwell.word, seconds, span, sink)?;
        let code = String::from_utf8_lossy(code.text()).into_owned();
        self.alone(&format!("{code} {word}"), sink)
    }

    fn message(&mut self, text: &str, sink: &mut Sink) -> Result<(), Fault> {
        let row = self.dialect.name_for(NameMeaning::Message).ok_or_else(|| cannot(OperatorLack::Message))?;
        if text.contains('"') || text.chars().any(char::is_control) {
            return Err(cannot(OperatorLack::MessageQuotation));
        }
        if text.chars().count() > LONGEST_MESSAGE {
            return Err(cannot(OperatorLack::MessageLength));
        }
        let text = if text.is_empty() { String::new() } else { format!("\"{text}\"") };
        self.alone(&format!("{}({text})", row.name), sink)
    }
}

/// Whether a statement says that no edge of a tool counts.
fn no_edge(op: &Op) -> bool {
    matches!(op, Op::UseToolEdge { edge, .. } if edge.literal().is_some_and(|n| n.is_zero()))
}
