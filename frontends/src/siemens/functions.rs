//! Lowering of a block of words: modes, feed, speed and tool, edges, spindle and coolant, dwell,
//! stops and ends, in the order in which they happen.
//!
//! Moves and frames have files of their own.

use ncc_dialects::{AFTER_MOTION, CHANGE_IN_BLOCK, Meaning, NameMeaning, NameRole, Quantity, Role, Thread};
use ncc_ir::canon::{Fact, FeedMode, PathMode, SpindleMode, Units};
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Fault, ModeName};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Unit;
use ncc_ir::program::{CutterRadius, Op, PathControl};
use ncc_ir::unsupported::left_out::LeftOut;
use ncc_ir::unsupported::{
    CodeUnsupported, FrameUnsupported, MoveUnsupported, SpindleUnsupported, TableUnsupported, Unsupported,
};

use super::block_words::{Code, Words};
use super::lower::{Head, Lower};
use super::program::repeated_blocks::{DISTANCE, MOTION, PLANE, SCALED, UNITS};
use super::siemens_state::{ModalCall, Motion};
use super::text::unit::Kind;
use crate::batch::Batch;
use crate::common::Source;
use crate::common::known::Know;
use crate::common::number::unit_of;
use crate::common::setting::setting;
use crate::common::sort::{RANK_AFTER, RANK_WORDS, rank};

/// The motion of a code or word.
pub(super) fn motion_of(meaning: NameMeaning) -> Option<Motion> {
    match meaning {
        NameMeaning::Code(Meaning::StraightTraverse) => Some(Motion::Traverse),
        NameMeaning::Code(Meaning::StraightFeed) => Some(Motion::Feed),
        NameMeaning::Code(Meaning::ArcFeed(turn)) => Some(Motion::Arc(turn)),
        // The chuck's is for one block.
        NameMeaning::Code(Meaning::SynchronisedFeed(Thread::Chuck)) => None,
        NameMeaning::Code(Meaning::SynchronisedFeed(thread)) => Some(Motion::Thread(thread)),
        NameMeaning::ArcThrough => Some(Motion::Through),
        NameMeaning::ArcTangent => Some(Motion::Tangent),
        _ => None,
    }
}

impl Lower {
    /// A block of words and codes.
    pub(super) fn words(&mut self, words: &mut Words, head: &Head, src: Source, out: &mut Batch) {
        if self.now.refused {
            // The modes that it says still count.
            for at in 0..words.codes.len() {
                self.set_mode(words.codes[at], out);
            }
            return;
        }
        let frame = words.find(|m| matches!(m, NameMeaning::SetFrame(_) | NameMeaning::AddFrame(_)));
        let dwell = words.find(|m| m == NameMeaning::Code(Meaning::Dwell));
        let pole = words.codes.iter().find_map(|code| match code.meaning {
            NameMeaning::Code(Meaning::SetPole(from)) => Some((*code, from)),
            _ => None,
        });
        if let Some((code, from)) = pole {
            self.pole(code, from, words, src, out);
        } else if let Some(code) = frame {
            self.state.pole.lose();
            self.frame(code, words, src, out);
        } else if let Some(code) = dwell {
            self.dwell(code, words, src, out);
        } else {
            self.functions(words, head, src, out);
        }
        if !self.now.failed {
            self.check_unused(words, src, out);
        }
    }

    fn functions(&mut self, words: &mut Words, head: &Head, src: Source, out: &mut Batch) {
        let codes = std::mem::take(&mut words.codes);
        let coded = codes.iter().filter_map(|c| match c.meaning {
            NameMeaning::Code(meaning) => Some((c, meaning)),
            _ => None,
        });
        let has_speed = words.get(self.role_letter(Role::Speed)).is_some();
        self.speed_limit(words, src, out);
        for (code, meaning) in coded.clone() {
            if rank(meaning) < RANK_WORDS {
                match meaning {
                    Meaning::SetMotionControlMode(mode) => self.path_control(code, mode, words, src, out),
                    _ => self.setting(code, meaning, has_speed, out),
                }
            }
        }
        self.feed_and_speed(words, src, out);
        let change = coded.clone().find(|(_, m)| *m == Meaning::ChangeTool);
        let change = change.map(|(code, _)| code);
        let moves = words.has_point();
        let late =
            change.filter(|change| moves && self.option(CHANGE_IN_BLOCK, change.span, out) == AFTER_MOTION);
        if let (Some(change), Some(edge)) = (late, words.get(self.role_letter(Role::ToolEdge))) {
            let (what, at) = (TableUnsupported::EdgeBeforeChange, edge.span);
            self.not_supported(change.name, what, at, out);
        }
        self.select_tool(words, src, out);
        if late.is_none() {
            self.change_tool(change, words, src, out);
        }
        for (code, meaning) in coded.clone() {
            let op = match meaning {
                Meaning::UseToolCentrePoint(_) if words.has_point() => {
                    let what = FrameUnsupported::TransformationAxisWords;
                    self.not_supported(code.name, what, code.span, out);
                    continue;
                }
                Meaning::UseToolCentrePoint(on) => {
                    self.stand.forget();
                    Op::UseToolCentrePoint(on)
                }
                Meaning::SetTilt => {
                    let what = FrameUnsupported::SwivelBrackets;
                    self.not_supported(code.name, what, code.span, out);
                    continue;
                }
                Meaning::StartSpindleClockwise => Op::StartSpindleClockwise,
                Meaning::StartSpindleCounterclockwise => Op::StartSpindleCounterclockwise,
                Meaning::MachineFunction(_) if words.has_point() => {
                    // Whether it comes before or after the move is a matter of the machine.
                    let what = CodeUnsupported::AxisWords;
                    self.not_supported(code.name, what, code.span, out);
                    continue;
                }
                Meaning::OrientSpindle if words.has_point() => {
                    let what = SpindleUnsupported::StopWithAxes;
                    self.not_supported(code.name, what, code.span, out);
                    continue;
                }
                Meaning::OrientSpindle => Op::OrientSpindle(None),
                // Without a move there is nothing to stop.
                Meaning::ExactStop if words.has_point() => Op::ExactStop,
                Meaning::MachineFunction(name) => Op::MachineFunction(name.into()),
                Meaning::LeftOut => {
                    if self.first_time(code.name) {
                        out.report(Fault::CodeLeftOut { what: LeftOut::code(code.name) }, code.span);
                    }
                    continue;
                }
                Meaning::FloodOn => Op::FloodOn,
                Meaning::MistOn => Op::MistOn,
                // By the radius of the active edge.
                Meaning::StartCutterRadiusCompensation(side) => {
                    Op::StartCutterRadiusCompensation { side, radius: CutterRadius::InForce }
                }
                _ => continue,
            };
            self.push(code.span, op, out);
        }
        let machine =
            coded.clone().find(|(_, m)| matches!(m, Meaning::UseMachineCoordinates { .. })).map(|(c, _)| *c);
        let motion = codes.iter().find_map(|c| Some((*c, motion_of(c.meaning)?)));
        self.modal_rounding(words, src, out);
        let chuck = coded.clone().find(|(_, m)| *m == Meaning::SynchronisedFeed(Thread::Chuck));
        match chuck {
            Some((code, _)) => {
                self.chuck_thread(code, motion.is_some() || machine.is_some(), words, src, out)
            }
            None => self.motion_words(motion, machine, head.span, words, src, out),
        }
        if late.is_some() {
            self.change_tool(late, words, src, out);
        }
        for (code, meaning) in coded {
            if rank(meaning) >= RANK_AFTER {
                if moves && matches!(meaning, Meaning::StopSpindleTurning | Meaning::CoolantOff) {
                    self.after_the_move(code, out);
                }
                self.ending(code, meaning, out);
            }
        }
        words.codes = codes;
    }

    /// Sets a mode; also for a block that is refused.
    pub(super) fn set_mode(&mut self, code: Code, out: &mut Batch) {
        if let Some(motion) = motion_of(code.meaning) {
            self.state.modes.motion = Know::Said(motion);
            self.repeated_blocks.say(MOTION);
        }
        let NameMeaning::Code(meaning) = code.meaning else {
            return;
        };
        match meaning {
            Meaning::UseLengthUnits(units) => self.set_units(code, units, out),
            Meaning::SelectPlane(plane) => {
                if self.state.modes.plane.value() != Some(plane) {
                    self.state.pole.lose();
                }
                self.state.modes.plane = Know::Said(plane);
                self.repeated_blocks.say(PLANE);
                if let Some(at) = self.only_plane.see(plane) {
                    out.report(Fault::EntryFactNeeded { fact: ModeName::Plane }, at);
                }
            }
            Meaning::SetDistanceMode(distance) => {
                self.state.modes.distance = Know::Said(distance);
                self.repeated_blocks.say(DISTANCE);
            }
            Meaning::SetFeedMode(mode) => {
                self.count_feed(mode);
                self.state.surface = Know::Said(false);
            }
            Meaning::SetSpindleMode(mode) => {
                code.feed_mode.into_iter().for_each(|mode| self.count_feed(mode));
                self.state.surface = Know::Said(mode == SpindleMode::Surface);
            }
            Meaning::SetOriginOffsets(offset) => {
                self.state.modes.work_offset = Know::Said(offset);
                self.stale = false;
                self.state.pole.lose();
                self.stand.forget();
            }
            _ => {}
        }
    }

    fn count_feed(&mut self, mode: FeedMode) {
        // A feed that was stated before does not count any more.
        let other = self.state.modes.feed_mode.value().is_some_and(|before| before != mode);
        if other || mode == FeedMode::InverseTime {
            (self.state.modes.feed, self.state.spent) = (Know::Unsaid, true);
        }
        self.state.modes.feed_mode = Know::Said(mode);
    }

    fn set_units(&mut self, code: Code, units: Units, out: &mut Batch) {
        let scaled = !code.feed_stays;
        let counts = |scaled: Know<bool>, units: Know<Units>| match (scaled, units) {
            (Know::Said(true), Know::Said(units)) => Some(unit_of(Fact::Known(units))),
            (Know::Lost, _) => None,
            _ => Some(Unit::One),
        };
        let before = counts(self.state.scaled, self.state.modes.units);
        let basic = if self.settings.get("feed_unit") == "inch" { Unit::Inch } else { Unit::Mm };
        self.state.modes.units = Know::Said(units);
        self.state.scaled = Know::Said(scaled);
        self.repeated_blocks.say(UNITS);
        self.repeated_blocks.say(SCALED);
        let after = counts(self.state.scaled, self.state.modes.units);
        let real = |unit: Option<Unit>| unit.map(|u| if u == Unit::One { basic } else { u });
        if before.is_some() && real(before) != real(after) && self.state.modes.feed == Know::Said(()) {
            // What a feed counts that was stated before is not known.
            self.state.modes.feed = Know::Unsaid;
        }
        let relied = [self.only_units.see(units), self.only_scaled.see(scaled)];
        for at in relied.into_iter().flatten() {
            out.report(Fault::EntryFactNeeded { fact: ModeName::Units }, at);
        }
    }

    fn setting(&mut self, code: &Code, meaning: Meaning, has_speed: bool, out: &mut Batch) {
        if let (Meaning::SelectPlane(plane), ModalCall::Active(cycle)) = (meaning, &self.state.cycle)
            && cycle.plane.known() != Some(plane)
        {
            let what = MoveUnsupported::PlaneInCycle;
            self.not_supported(code.name, what, code.span, out);
        }
        let ends_surface = self.before_spindle_mode(code, meaning, has_speed, out);
        // Said once more, it says what the feed counts.
        let again = meaning == Meaning::SetSpindleMode(SpindleMode::Surface)
            && self.state.surface == Know::Said(true)
            && !has_speed;
        self.set_mode(*code, out);
        if let (Meaning::SetSpindleMode(_), Some(mode)) = (meaning, code.feed_mode) {
            self.push(code.span, Op::SetFeedMode(mode), out);
        }
        if again {
            return;
        }
        if ends_surface && matches!(meaning, Meaning::SetFeedMode(_)) {
            setting(meaning).into_iter().for_each(|op| self.push(code.span, op, out));
            return self.push(code.span, Op::SetSpindleMode(SpindleMode::Turns), out);
        }
        let op = match meaning {
            Meaning::NoEffect => {
                if self.first_time(code.name) {
                    out.report(Fault::AssumedNoEffect { code: code.name.into() }, code.span);
                }
                Op::NoEffect(code.name.into())
            }
            meaning => match setting(meaning) {
                Some(op) => op,
                None => return,
            },
        };
        self.push(code.span, op, out);
    }

    /// A way of taking corners, with the distances that stand in its block.
    fn path_control(&mut self, code: &Code, mode: PathMode, words: &mut Words, src: Source, out: &mut Batch) {
        let mut lengths = [None, None];
        if mode.is_rounding() {
            for (role, length) in
                [NameRole::Rounding, NameRole::RoundingInRapids].into_iter().zip(&mut lengths)
            {
                if let Some(given) = words.take_named(role) {
                    *length = self.number(given, Quantity::Length, src, out).map(Expr::Num);
                }
            }
        }
        let [within, rapids] = lengths;
        if mode == PathMode::Distance && within.is_none() {
            // One that was stated before stays active; what that is, is not followed.
            let what = CodeUnsupported::RoundingDistance;
            return self.not_supported(code.name, what, code.span, out);
        }
        let within = within.or_else(|| rapids.is_some().then(|| Expr::int(0)));
        let control = PathControl { mode, within, rapids, merged: None };
        self.push(code.span, Op::SetMotionControlMode(Box::new(control)), out);
    }

    fn role_letter(&self, role: Role) -> u8 {
        self.settings.dialect.letter_for(role).map_or(0, |c| c as u8)
    }

    fn feed_and_speed(&mut self, words: &mut Words, src: Source, out: &mut Batch) {
        let by_time = self.state.modes.feed_mode.value() == Some(FeedMode::InverseTime);
        if by_time {
            // A time counts for the move of its own block.
            self.state.modes.feed = Know::Unsaid;
        }
        if let Some(given) = words.take(self.role_letter(Role::Feed)) {
            self.rely_on_feed_mode(given.span, out);
            if let Some(mut feed) = self.amount(given, Quantity::Feed, src, out) {
                if let (true, Expr::Num(num)) = (by_time, &mut feed) {
                    num.unit = Unit::One;
                }
                if !feed.literal().is_some_and(ncc_ir::expr::num::Num::is_zero) {
                    (self.state.modes.feed, self.state.spent) = (Know::Said(()), false);
                }
                match &self.state.cycle {
                    ModalCall::Active(cycle) => self.recall |= cycle.feed.is_some(),
                    ModalCall::Inherited { own_feed: true } | ModalCall::Lost { own_feed: true } => {
                        let what = MoveUnsupported::FeedInCallersCycleWord;
                        self.not_supported(&src.text(given.span), what, given.span, out);
                    }
                    ModalCall::None
                    | ModalCall::Refused
                    | ModalCall::Subprogram(_)
                    | ModalCall::Inherited { .. }
                    | ModalCall::Lost { .. } => {}
                }
                self.push(given.span, Op::SetFeedRate(feed), out);
            }
        }
        if let Some(given) = words.take(self.role_letter(Role::Speed))
            && let Some(speed) = self.amount(given, Quantity::Speed, src, out)
        {
            if matches!(&self.state.cycle, ModalCall::Active(c) if c.kind.name() == "tap-rigid") {
                let what = SpindleUnsupported::SpeedInTap;
                self.not_supported(&src.text(given.span), what, given.span, out);
            }
            self.push(given.span, Op::SetSpindleSpeed(speed), out);
        }
        self.spindle_angle(words, src, out);
    }

    /// Tool word.
    fn select_tool(&mut self, words: &mut Words, src: Source, out: &mut Batch) {
        if let Some(given) = words.take(self.role_letter(Role::Tool)) {
            self.state.modes.tool = Know::Said(None);
            if given.computed.is_some() {
                if let Some(tool) = self.amount(given, Quantity::Integer, src, out) {
                    self.push(given.span, Op::SelectTool(tool), out);
                }
            } else if let Some(tool) = self.read_whole(given, src, out) {
                self.push(given.span, Op::SelectTool(Expr::int(tool.into())), out);
            }
        }
        if let Some(name) = words.tool_name.take() {
            self.select_by_name(name, src, out);
        }
    }

    /// Tool change and edge.
    fn change_tool(&mut self, change: Option<&Code>, words: &mut Words, src: Source, out: &mut Batch) {
        if let Some(change) = change {
            if self.state.modes.tool == Know::Unsaid {
                self.fault(Fault::NoToolSelected, change.span, out);
            }
            self.push(change.span, Op::ChangeTool, out);
        }
        let edge = words.take(self.role_letter(Role::ToolEdge));
        let (edge, said, span) = match (edge, change) {
            (Some(given), _) => {
                let Some(edge) = self.read_whole(given, src, out) else {
                    return;
                };
                if edge > 9 {
                    return self.fault(
                        Fault::OutOfRange { word: src.text(given.span).into() },
                        given.span,
                        out,
                    );
                }
                self.state.implied_edge = None;
                (edge, true, given.span)
            }
            (None, Some(change)) => {
                self.state.implied_edge = Some(change.span);
                let none = self.settings.get("edge_after_change") == "none";
                (u32::from(!none), false, change.span)
            }
            (None, None) => return,
        };
        self.state.modes.length = Know::Said(edge > 0);
        self.push(span, Op::UseToolEdge { edge: Expr::int(edge.into()), said }, out);
    }

    /// A dwell, which stands alone.
    fn dwell(&mut self, code: Code, words: &mut Words, src: Source, out: &mut Batch) {
        if words.codes.len() > 1 {
            return self.not_supported(code.name, CodeUnsupported::DwellBesideOthers, code.span, out);
        }
        if words.get(self.role_letter(Role::Speed)).is_some() {
            return self.not_supported(code.name, CodeUnsupported::DwellInTurns, code.span, out);
        }
        let rows = &self.settings.dialect.code;
        let parameters = rows.iter().find(|row| row.code == code.name).map_or(&[][..], |row| &row.dwell);
        let found = parameters.iter().find_map(|d| Some((words.take(d.letter as u8)?, d.quantity)));
        let Some((given, quantity)) = found else {
            let word = parameters.first().map_or(' ', |d| d.letter).to_string().into();
            return self.fault(Fault::WordMissing { code: code.name.into(), word }, code.span, out);
        };
        if let Some(time) = self.amount(given, quantity, src, out) {
            self.push(code.span.to(given.span), Op::Dwell(time), out);
        }
    }

    /// Machine data decide whether these come before, with or after a move of their block.
    fn after_the_move(&mut self, code: &Code, out: &mut Batch) {
        if self.first_time(code.name) {
            let assumption = ControlFact::AfterMove { code: code.name.into() };
            out.report(Fault::AssumedFact { fact: assumption }, code.span);
        }
    }

    /// A function after the motion.
    fn ending(&mut self, code: &Code, meaning: Meaning, out: &mut Batch) {
        let op = match meaning {
            Meaning::StopSpindleTurning => Op::StopSpindleTurning,
            Meaning::CoolantOff => Op::CoolantOff,
            Meaning::ProgramStop => Op::ProgramStop,
            Meaning::OptionalProgramStop => Op::OptionalProgramStop,
            // The end of a subprogram by any name leads back, and that of the main program ends it.
            Meaning::ProgramEnd | Meaning::Return => {
                let last = !self.skipped();
                self.ended |= last && !self.goes_on();
                self.flow.has_end = true;
                self.flow.over |= last;
                self.idle_tap_ends(code.name, code.span, out);
                if self.sub.is_some() {
                    self.leave_motion(code.span, out);
                    self.leave(code.span, out);
                    Op::Return
                } else if self.goes_back(code, meaning, out) {
                    (out.subprogram, out.whole) = (true, true);
                    self.leave_motion(code.span, out);
                    Op::Return
                } else {
                    out.subprogram |= self.unit == Some(Kind::Sub) || meaning == Meaning::Return;
                    Op::ProgramEnd
                }
            }
            _ => return,
        };
        self.push(code.span, op, out);
    }

    /// Whether an end of the text's first unit leads back to a program that is not there (PG: M17 and RET end
    /// subprograms, M2 and M30 the program). What its caller hands over, it has from there.
    fn goes_back(&mut self, code: &Code, meaning: Meaning, out: &mut Batch) -> bool {
        let called = out.heading.as_ref().is_some_and(|heading| !heading.parameters.is_empty());
        let sub = self.unit == Some(Kind::Sub);
        match meaning {
            _ if called => true,
            // There is no other use for it.
            Meaning::Return if code.name == "RET" => {
                if !sub && self.assume && self.first_time("RET") {
                    let assumption = ControlFact::ReturnsToCaller { code: "RET" };
                    out.report(Fault::AssumedFact { fact: assumption }, code.span);
                }
                true
            }
            Meaning::Return => {
                if self.unit.is_none() && self.assume && self.first_time(code.name) {
                    let assumption = ControlFact::EndsMain { code: code.name.into() };
                    out.report(Fault::AssumedFact { fact: assumption }, code.span);
                }
                sub
            }
            _ => false,
        }
    }

    /// Words that nothing in the block has used.
    fn check_unused(&mut self, words: &mut Words, src: Source, out: &mut Batch) {
        while let Some((letter, given)) = words.first_left() {
            let row = letter.and_then(|l| self.settings.dialect.address_row(l));
            // Some words have a function of their own, which is known and not translated.
            match row.and_then(|row| row.refuse.as_deref()) {
                Some(name) => {
                    self.not_supported(&src.text(given.span), Unsupported::named(name), given.span, out);
                }
                None => self.fault(Fault::WordUnused { word: src.text(given.span) }, given.span, out),
            }
            words.drop_left(letter);
        }
    }
}
