//! Side effects of codes: stops, tool changes, the end of the program.
//!
//! The test set-up holds the side effects of each control ([`Behaviours`](ncc_ir::behaviour::Behaviours)). Events record
//! that the control caused them, and not the program ([`by_control`]).
//!
//! Not here: the effects that a code is named for.

use super::{Event, Exec, Kind, Length, Z, by_control};
use ncc_ir::behaviour::{Behaviour, Behaviours};
use ncc_ir::canon::{AXES, Distance, FeedMode, Spindle};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::program::{Coord, Op, Point, ReferencePoint, Stmt};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::{CompensationUnexecuted, CycleUnexecuted};

impl Exec {
    /// Whether the control has this side effect; records that it was asked for.
    pub(super) fn does(&mut self, behaviour: Behaviour) -> bool {
        self.asked |= behaviour.bit();
        self.world.behaviours.does(behaviour)
    }

    /// Behaviours that the program has met so far, a bit each.
    pub fn asked(&self) -> u64 {
        self.asked
    }

    /// Resets this record.
    pub fn ask_anew(&mut self) {
        self.asked = 0;
    }

    /// The side effects of this control.
    pub fn behaviours(&self) -> &Behaviours {
        &self.world.behaviours
    }

    /// Behaviours that these statements meet from the current state, a bit each; those that they meet in any
    /// state are in [`touched`].
    #[inline]
    pub fn comes_to(&self, stmts: &[Stmt]) -> u64 {
        match stmts {
            [stmt] if self.comes_to_none(stmt) => 0,
            // Each begins in the state of the first one, as far as that counts here. (Before others a jump may lead to a
            // label.)
            _ if stmts.iter().all(|stmt| self.comes_to_none(stmt) && !matches!(stmt.op, Op::Label(_))) => 0,
            _ => self.comes_to_at_length(stmts),
        }
    }

    /// Whether a statement is so plain that it meets none: the short way.
    fn comes_to_none(&self, stmt: &Stmt) -> bool {
        match &stmt.op {
            Op::Label(_) | Op::Comment(_) | Op::Blank | Op::SetFeedRate(_) => true,
            Op::StraightFeed(m) | Op::StraightTraverse(m) | Op::Hole(m) => {
                let absolute = |word: &Coord| word.distance.or(Distance::Absolute) == Distance::Absolute;
                self.modes.distance == Distance::Absolute
                    && !Exec::turns(&m.to)
                    && m.to.axes[..3].iter().flatten().all(absolute)
            }
            _ => false,
        }
    }

    fn comes_to_at_length(&self, stmts: &[Stmt]) -> u64 {
        let bit = |comes: bool, behaviour: Behaviour| if comes { behaviour.bit() } else { 0 };
        let in_mode = |mode: FeedMode, counted: fn(&Op) -> bool| {
            stmts.iter().any(|stmt| counted(&stmt.op))
                && (self.state.feed_mode == mode
                    || stmts.iter().any(|stmt| matches!(stmt.op, Op::SetFeedMode(set) if set == mode)))
        };
        let dwells = in_mode(FeedMode::PerRevolution, |op| matches!(op, Op::Dwell(_)));
        let arcs = in_mode(FeedMode::InverseTime, |op| matches!(op, Op::ArcFeed(_)));
        bit(self.includes_in(stmts), Behaviour::FrameOffsetIncremental)
            | bit(self.turns_far_in(stmts), Behaviour::RotaryTurn)
            | bit(self.feeds_turns_in(stmts), Behaviour::RotaryFeed)
            | bit(dwells, Behaviour::DwellPerRevolution)
            | bit(arcs, Behaviour::ArcByTime)
            | bit(self.is_fine_in(stmts), Behaviour::FineDigits)
            | bit(self.feeds_arcs_in(stmts), Behaviour::FeedOnArcs)
            | self.lengths_aside_in(stmts)
            | self.by_blocks(stmts)
    }

    /// Changes a behaviour from now on.
    pub fn behave(&mut self, behaviour: Behaviour, value: u8) {
        self.world.behaviours = self.world.behaviours.with(behaviour, value);
    }

    /// Sets the operator's switch for optional stops.
    pub fn set_optional_stop(&mut self, on: bool) {
        self.world.optional_stop = on;
    }

    /// The control stops the spindle or switches coolant off, if it has this side effect.
    fn switch_off(&mut self, spindle: Behaviour, coolant: Behaviour) {
        if self.state.spindle != Spindle::Stopped && self.does(spindle) {
            self.state.spindle = Spindle::Stopped;
            self.state.by_control |= by_control::SPINDLE;
        }
        if (self.state.flood || self.state.mist) && self.does(coolant) {
            (self.state.flood, self.state.mist) = (false, false);
            self.state.by_control |= by_control::COOLANT;
        }
    }

    /// A change of units: the control may convert the active F. An inverse-time feed has no unit of length.
    #[cold]
    pub(super) fn feed_at_units(&mut self, inch: bool) {
        if self.state.feed_mode == FeedMode::InverseTime || !self.does(Behaviour::FeedAtUnits) {
            return;
        }
        let scaled = |feed: i128| if inch { feed * 127 / 5 } else { feed * 5 / 127 };
        match Nanos::try_from(scaled(i128::from(self.feed))) {
            Ok(feed) => (self.feed, self.feed_inch) = (feed, self.feed_inch.map(|_| inch)),
            // Above every feed: the next cut needs another.
            Err(_) => self.feed = 0,
        }
    }

    /// A dwell in seconds, or in revolutions of the spindle if the control counts them under feed per revolution.
    ///
    /// # Errors
    /// Revolutions of a spindle without a speed.
    #[cold]
    pub(super) fn dwell_code(
        &mut self,
        amount: &Expr,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let mut seconds = self.value(amount, span)?;
        if self.state.feed_mode == FeedMode::PerRevolution && self.does(Behaviour::DwellPerRevolution) {
            let turns = self.state.turns(self.last[0]);
            if turns <= 0 {
                return self.fault(Fault::NoSpeed, span);
            }
            let counted = i128::from(seconds) * 60 * i128::from(ONE) / i128::from(turns);
            seconds = Nanos::try_from(counted).unwrap_or(Nanos::MAX);
        }
        self.emit(Kind::Dwell(seconds), span, out)
    }

    /// A stop, or the end of the program.
    ///
    /// # Errors
    /// A block that ncc cannot execute.
    #[cold]
    pub(super) fn stop(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let span = stmt.span;
        match &stmt.op {
            Op::ProgramStop => {
                if let Some((text, at)) = self.shown.at_stop(stmt.skip) {
                    self.emit(Kind::Message(text), at, out)?;
                }
                self.switch_off(Behaviour::SpindleAtStop, Behaviour::CoolantAtStop);
                self.emit(Kind::ProgramStop, span, out)
            }
            Op::OptionalProgramStop => {
                if self.world.optional_stop {
                    self.switch_off(Behaviour::SpindleAtStop, Behaviour::CoolantAtStop);
                }
                self.emit(Kind::OptionalProgramStop, span, out)
            }
            Op::BeginAgain => self.begin_again(span, out),
            _ => {
                self.switch_off(Behaviour::SpindleAtEnd, Behaviour::CoolantAtEnd);
                self.emit(Kind::ProgramEnd, span, out)?;
                self.ends_by_code();
                self.ended = true;
                Ok(())
            }
        }
    }

    /// The program starts again: nothing is switched off, and all modes stay active.
    ///
    /// # Errors
    /// A cycle or a compensation that would stay active in the first blocks.
    fn begin_again(&mut self, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        if self.cycle.is_some() {
            return self.not_executed(CycleUnexecuted::BeginsAgainInCycle, span);
        }
        if self.state.compensation.side.is_some() {
            return self.not_executed(CompensationUnexecuted::BeginsAgain, span);
        }
        self.emit(Kind::BeginAgain, span, out)?;
        self.begins_again(span);
        self.ended = true;
        Ok(())
    }

    /// The control has moved to a position in machine coordinates along Z: it may cancel the active length.
    #[cold]
    pub(super) fn cancel_length(&mut self, behaviour: Behaviour) {
        let standing = self.waiting.unwrap_or(self.modes.length);
        if standing != Length::Entry(0) && self.does(behaviour) {
            self.waiting = Some(Length::Entry(0));
        }
    }

    /// The end of the text; an event only if the program has not ended before.
    pub fn end_of_text(&mut self, out: &mut Vec<Event>) {
        if !self.ended {
            // A comparison cannot use a last move that ncc cannot execute.
            let _ = self.end_block(out);
            self.ended = true;
            if self.centre_path.is_some() {
                self.end_open_path(out);
            }
            out.push(Event {
                kind: Kind::TextEnd,
                end: self.last,
                rate: 0,
                state: self.state,
                inch: self.modes.inch,
                span: Span::default(),
            });
        }
    }

    /// A tool change.
    ///
    /// # Errors
    /// No tool is selected, or the control's own move cannot be executed.
    #[cold]
    pub(super) fn change_tool(&mut self, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        if self.selected == -1 {
            return self.fault(Fault::NoToolSelected, span);
        }
        self.before_change(span, out)?;
        self.state.tool = self.tool_of_change();
        self.changed_to = self.state.tool;
        let emitted = self.emit(Kind::ToolChange, span, out);
        if self.world.zeroed_by_tool {
            // The zero of Z has changed, so that a move with Z moves.
            self.reframe(self.machine());
        }
        if self.state.by_control & by_control::Z == 0 {
            if self.state.by_control & by_control::SPINDLE != 0 {
                self.state.by_control |= by_control::SPINDLE_AT_CHANGE;
            }
            // With Z where the program moved it, every move may need the spindle.
            self.said_by_program(by_control::SPINDLE);
        }
        emitted
    }

    /// How far the operator moved the zero of Z for this tool; 0 if nobody does.
    pub(super) fn put_in(&self) -> Nanos {
        match self.world.zeroed_by_tool && self.changed_to != -1 {
            true => self.world.edge_length(self.changed_to, 1),
            false => 0,
        }
    }

    /// The part of every work offset besides its own zero: the machine's external offset, and the operator's shift of
    /// the zero of Z.
    pub(super) fn external(&self) -> [Nanos; AXES] {
        let mut external = self.world.external;
        external[Z] = external[Z].wrapping_add(self.put_in());
        external
    }

    /// The moves before a tool change: the control may move Z to machine zero, where it stays.
    ///
    /// # Errors
    /// A move that cannot be executed.
    #[cold]
    fn before_change(&mut self, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        self.switch_off(Behaviour::SpindleAtChange, Behaviour::CoolantAtChange);
        if !self.does(Behaviour::ZAtChange) {
            return Ok(());
        }
        if self.cycle.is_some() {
            return self.not_executed(CycleUnexecuted::ToolChangeInCycle, span);
        }
        let mut machine = self.machine();
        machine[Z] = self.world.reference(ReferencePoint::Home)[Z];
        self.position = self.unplace(&machine);
        self.heading = super::Heading::None;
        self.goes_to_place();
        self.said_by_program(by_control::Z_COUNTED);
        self.state.by_control |= by_control::Z | by_control::MOVE;
        let moved = self.emit_move(false, span, out);
        self.state.by_control &= !by_control::MOVE;
        moved
    }

    /// Z counts before this program moves it. The other program moves Z to machine zero in words before its first tool
    /// change, and its later moves may rely on that: this program must do the same.
    pub fn counts_z_at_start(&mut self) {
        self.said_by_program(by_control::Z_AT_START);
    }

    /// A move that takes Z from where the control or the operator left it. A cut from there is reported.
    #[cold]
    pub(super) fn emit_first_of_z(
        &mut self,
        feed: bool,
        end: [Nanos; AXES],
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        self.last = end;
        let both = by_control::Z | by_control::Z_AT_START;
        let goes_home = self.state.by_control & by_control::MOVE != 0;
        if feed {
            let emitted = self.emit(Kind::Feed, span, out);
            self.said_by_program(both);
            return emitted;
        }
        if !goes_home {
            self.said_by_program(both);
        }
        self.emit(Kind::Traverse, span, out)
    }

    /// The words of a move after the control moved Z to machine zero.
    #[cold]
    pub(super) fn counts_z_of(&mut self, to: &Point) {
        if let Some(word) = &to.axes[Z] {
            self.counts_z(word.distance.or(self.modes.distance) == Distance::Incremental);
        }
    }

    /// A Z word after the control moved Z to machine zero: it counts from there, or states the position of Z.
    #[cold]
    pub(super) fn counts_z(&mut self, relative: bool) {
        match relative {
            true if self.state.by_control & by_control::Z != 0 => {
                self.state.by_control |= by_control::Z_COUNTED;
            }
            true => {}
            false => self.said_by_program(by_control::Z_COUNTED),
        }
    }

    /// The program has stated Z, spindle or coolant itself.
    #[inline]
    pub(super) fn said_by_program(&mut self, what: u8) {
        self.state.by_control &= !what;
    }
}

/// Behaviours of a control that an operation may meet, a bit each.
pub fn touched(op: &Op) -> u64 {
    let bits = |all: &[Behaviour]| all.iter().fold(0, |bits, behaviour| bits | behaviour.bit());
    match op {
        Op::ProgramStop => bits(&[Behaviour::SpindleAtStop, Behaviour::CoolantAtStop]),
        Op::ChangeTool => {
            bits(&[Behaviour::SpindleAtChange, Behaviour::CoolantAtChange, Behaviour::ZAtChange])
        }
        Op::GoToReference(to) if to.axes[Z] && !to.keeps_length => bits(&[Behaviour::LengthAfterReturn]),
        Op::UseMachineCoordinates { length: false } => bits(&[Behaviour::LengthAfterMachineMove]),
        Op::ProgramEnd => bits(&[Behaviour::SpindleAtEnd, Behaviour::CoolantAtEnd]),
        Op::UseLengthUnits(_) => bits(&[Behaviour::FeedAtUnits]),
        _ => 0,
    }
}

/// Whether an event is part of a cut, where the whole state matters.
pub fn cuts(kind: &Kind) -> bool {
    matches!(kind, Kind::Feed | Kind::Synchronised { .. } | Kind::Probe { .. } | Kind::Arc { .. })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::world::World;
    use ncc_ir::canon::{Fact, Modes, Plane, Turn};
    use ncc_ir::expr::num::{Num, Unit};
    use ncc_ir::program::{Arc, Centre, Move, Point, Turns};

    /// What the short way passes over gives nothing at length either.
    #[test]
    fn plain_statements_come_to_nothing() {
        let number = Expr::Num(Num::int(5, Unit::Entry));
        let coord = |distance| Some(Coord { value: number.clone(), distance });
        let move_to = |axis: usize, distance| {
            let mut to = Point::default();
            (to.axes[0], to.axes[axis]) = (coord(Fact::Entry), coord(distance));
            Move { to, said: true }
        };
        let mut ops = vec![
            Op::Label("1".into()),
            Op::Comment("a remark".into()),
            Op::Blank,
            Op::SetFeedRate(number.clone()),
            Op::ChangeTool,
        ];
        for axis in [1, 2, 4] {
            for distance in [Fact::Entry, Fact::Known(Distance::Absolute), Fact::Known(Distance::Incremental)]
            {
                ops.push(Op::StraightFeed(move_to(axis, distance)));
                ops.push(Op::StraightTraverse(move_to(axis, distance)));
                ops.push(Op::Hole(move_to(axis, distance)));
            }
        }
        let mut world = World::generate(1, &Modes::default());
        world.behaviours = world.behaviours.with(Behaviour::FrameOffsetIncremental, 1);
        world.increments = Some(crate::Increments { mm: 0, inch: 0, degree: 0 });
        let mut none = 0;
        for distance in [Distance::Absolute, Distance::Incremental] {
            let mut exec = Exec::new(&world, 0);
            exec.modes.distance = distance;
            (exec.turned_known, exec.position[0]) = (u8::MAX, 3);
            let before = exec.before_frame();
            exec.position = [7; AXES];
            exec.carry(before);
            for op in &ops {
                let stmt = [Stmt::new(Span::default(), op.clone())];
                if exec.comes_to_none(&stmt[0]) {
                    none += 1;
                    assert_eq!(exec.comes_to_at_length(&stmt), 0, "{op:?}");
                }
                for other in &ops {
                    let both = [op, other].map(|op| Stmt::new(Span::default(), op.clone()));
                    assert_eq!(exec.comes_to(&both), exec.comes_to_at_length(&both), "{op:?}, {other:?}");
                }
            }
            let comes = |op: &Op| exec.comes_to(&[Stmt::new(Span::default(), op.clone())]) != 0;
            assert!(ops.iter().any(comes), "{distance:?}");
        }
        assert_eq!(none, 2 * 4 + 12);
    }

    /// The meaning of F on an arc is open under inverse-time feed only, set before or with the arc.
    #[test]
    fn an_arc_comes_to_its_fact_under_inverse_time() {
        let stmt = |op| Stmt::new(Span::default(), op);
        let arc = || {
            stmt(Op::ArcFeed(Box::new(Arc {
                plane: Fact::Known(Plane::Xy),
                turn: Turn::Clockwise,
                to: Point::default(),
                centre: Centre::Radius(Expr::Num(Num::int(5, Unit::Mm))),
                turns: Turns::NONE,
                said: true,
            })))
        };
        let exec = Exec::new(&World::generate(0, &Modes::default()), 0);
        let comes = |stmts: &[Stmt]| exec.comes_to(stmts) & Behaviour::ArcByTime.bit() != 0;
        assert!(!comes(&[arc()]));
        assert!(comes(&[stmt(Op::SetFeedMode(FeedMode::InverseTime)), arc()]));
        assert!(!comes(&[stmt(Op::SetFeedMode(FeedMode::InverseTime))]));
    }
}
