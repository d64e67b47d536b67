//! How a control conducts its moves: corners, exact stops, advice, what a speed counts and its limit,
//! spindle and coolant; and when two controls are in one state.
//!
//! Not here: moves themselves.

use super::{Attribute, Coolant, Event, Exec, InModes, Kind, RETURN, State, by_control};
use crate::world::Sideways;
use ncc_ir::canon::{Axis, Distance, PathMode, Spindle};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::program::kinds::{moves, polar};
use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;
use ncc_ir::syntax::Ranged;
use ncc_ir::unexecuted::MoveUnexecuted;

impl Exec {
    /// Sets the control's own clearance of the peck-drilling cycle, in nanos of a millimetre.
    pub fn set_peck_clearance(&mut self, clearance: Nanos) {
        self.world.peck_clearance = clearance;
    }

    /// Sets the control's own lift of the chip-breaking cycle, in nanos of a millimetre.
    pub fn set_break_lift(&mut self, lift: Nanos) {
        self.world.break_lift = lift;
    }

    /// Sets the angle at which the control stops the spindle where nothing else is stated, degrees in nanos.
    pub fn set_orientation(&mut self, angle: Nanos) {
        self.world.orientation = angle;
    }

    /// Sets the direction in which the control shifts a tool off the wall of a bore.
    pub fn set_bore_shift(&mut self, direction: Sideways) {
        self.world.bore_shift = direction;
    }

    /// Sets what an operation says of conduct; any other says nothing of it.
    pub(super) fn set_motion_mode(&mut self, op: &Op, span: Span) -> Result<(), Diagnostic> {
        match op {
            Op::SetMotionControlMode(control) => {
                let within =
                    [self.length_within(&control.within, span)?, self.length_within(&control.rapids, span)?];
                self.state.within[..2].copy_from_slice(&within);
                self.state.within[3] = match &control.merged {
                    None => within[0],
                    merged => self.length_within(merged, span)?,
                };
                match &mut self.after_stop {
                    Some(after) => *after = Some(control.mode),
                    None => self.state.path = Some(control.mode),
                }
            }
            Op::ExactStop if self.after_stop.is_none() => {
                self.after_stop = Some(self.state.path);
                self.state.path = Some(PathMode::ExactStop);
            }
            Op::TurnRotaryAxes(ways) => self.ways = Some(*ways),
            Op::Advise(advice) => {
                let bits = advice.kind.bits();
                self.state.advice &= !(7 << bits);
                self.state.advice |= u64::from(advice.value.min(6) + 1) << bits;
                if advice.kind.has_amount() {
                    let of = if advice.kind == ncc_ir::canon::AdviceKind::Smoothness { 4 } else { 2 };
                    self.state.within[of] = self.length_within(&advice.amount, span)?;
                }
            }
            Op::SetSpindleMode(mode) if self.state.spindle_mode != *mode => {
                self.state.spindle_mode = *mode;
                self.state.speed = 0;
                self.state.centre = 0;
                self.speed_watched = true;
            }
            Op::LimitSpindleSpeed(limit) => {
                let limit = u32::try_from(self.value(limit, span)? / (ONE / 1000));
                let Some(limit) = limit.ok().filter(|limit| *limit > 0) else {
                    return self.fault(Fault::OutOfRange { word: Ranged::HighestSpeed }, span);
                };
                self.state.limit = limit;
                self.within_limit(span)?;
            }
            _ => {}
        }
        Ok(())
    }

    /// Executes a statement; if it is a straight move, its rotary axes go the way that was stated before it.
    #[cold]
    pub(super) fn step_turning(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let (Op::StraightFeed(m) | Op::StraightTraverse(m)) = &stmt.op else {
            let moves =
                matches!(stmt.op, moves!() | polar!() | Op::Position(_) | Op::Hole(_) | Op::Pattern(_));
            if moves || matches!(stmt.op, Op::UseMachineCoordinates { .. } | Op::GoToReference(_)) {
                return self.not_executed(MoveUnexecuted::RotaryDirectionOfArc, stmt.span);
            }
            return self.step_by_stop(stmt, out);
        };
        let to = &m.to;
        let Some(ways) = self.ways.take() else { return self.step_by_stop(stmt, out) };
        for (place, (axis, way)) in [Axis::A, Axis::B, Axis::C].into_iter().zip(ways).enumerate() {
            let Some(way) = way else { continue };
            let Some(word) = to.get(axis) else {
                return self.not_executed(MoveUnexecuted::RotaryDirectionUnmoved, stmt.span);
            };
            if word.distance.or(self.modes.distance) != Distance::Absolute {
                return self.not_executed(MoveUnexecuted::RotaryDirectionIncrement, stmt.span);
            }
            let (from, to) = (self.position[axis as usize], self.value(&word.value, stmt.span)?);
            if !(0..360 * ONE).contains(&to) {
                return self.fault(Fault::OutOfRange { word: Ranged::TurnAngle }, stmt.span);
            }
            let sense = match way.turn(from, to) {
                None => return self.not_executed(MoveUnexecuted::RotaryHalfTurn, stmt.span),
                Some(_) if way.is_direct(from, to) => 0,
                Some(turn) => 1 + u8::from(turn < 0),
            };
            self.state.turned |= sense << (2 * place);
        }
        self.own_way = true;
        let done = self.step_by_stop(stmt, out);
        self.own_way = false;
        self.state.turned = 0;
        done
    }

    fn step_by_stop(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        match self.after_stop {
            Some(_) => self.step_and_stop(stmt, out),
            None => self.do_step(stmt, out),
        }
    }

    /// Executes a statement; if it moves, it ends in an exact stop.
    #[cold]
    pub(super) fn step_and_stop(&mut self, stmt: &Stmt, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let done = self.do_step(stmt, out);
        let moves = matches!(
            stmt.op,
            Op::StraightFeed(_)
                | Op::SynchronisedFeed(_)
                | Op::StraightTraverse(_)
                | Op::ArcFeed(_)
                | Op::ArcForm(_)
                | Op::Position(_)
                | Op::Hole(_)
                | Op::Polar(_)
                | Op::Pattern(_)
        );
        if moves && let Some(path) = self.after_stop.take() {
            self.state.path = path;
        }
        done
    }

    pub(super) fn turn_spindle(
        &mut self,
        to: Spindle,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        self.state.spindle = to;
        if to != Spindle::Stopped {
            self.spindle_turns();
        }
        self.said_by_program(by_control::SPINDLE | by_control::SPINDLE_AT_CHANGE);
        self.within_limit(span)?;
        let what = if to == Spindle::Stopped { Attribute::StopSpindle } else { Attribute::StartSpindle(to) };
        self.tell(what, span, out)
    }

    pub(super) fn coolant(
        &mut self,
        to: Coolant,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if to != self.state.coolant() {
            (self.state.flood, self.state.mist) = (to.flood, to.mist);
            // The event tells that it undoes what the control did.
            let emitted = self.emit(Kind::Coolant, span, out);
            self.said_by_program(by_control::COOLANT);
            return emitted;
        }
        self.said_by_program(by_control::COOLANT);
        Ok(())
    }

    /// Tells a function that moves nothing, where functions are reported.
    #[inline]
    pub(super) fn tell(
        &mut self,
        what: Attribute,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if !self.narrating {
            return Ok(());
        }
        self.emit(Kind::Attribute(what), span, out)
    }

    /// A length of the path mode or of advice; none is 0.
    fn length_within(&self, length: &Option<Expr>, span: Span) -> Result<i32, Diagnostic> {
        let nanos = length.as_ref().map_or(Ok(0), |length| self.value(length, span))?;
        match i32::try_from((nanos + 50_000) / 100_000) {
            Ok(tenths) if nanos >= 0 => Ok(tenths),
            Ok(_) | Err(_) => self.fault(Fault::OutOfRange { word: Ranged::Unnamed }, span),
        }
    }

    /// Whether two controls are in one state: whatever both execute next, both do the same. (Facts
    /// about power-on do not count any more.)
    ///
    /// An active cycle is part of the state. All that a hole takes of it is in `ActiveCycle`, the control's parameters
    /// included, but for the angle at which fine boring stops the spindle where nothing else is stated.
    pub fn agrees(&self, other: &Exec) -> bool {
        self.modes.return_level == other.modes.return_level
            && self.has_cycle_of(other)
            && self.agrees_beside_cycle(other)
    }

    /// Whether two controls are in one state as far as plain lines go: whatever lines both execute next, both do the same.
    ///
    /// Of frames a line reads their sum, the frame and the chain: not in which slot what lies, which may be
    /// another one on each control (G68 turns in one of its own, ROT in that of TRANS). Slots are read where a frame or a
    /// length is changed; so where anything waits for a line, they count. The level to which cycles return that say none
    /// no line reads or changes; but while a cycle is active, a position alone is a hole.
    pub fn agrees_on_lines(&self, other: &Exec) -> bool {
        (self.slots == other.slots || self.takes_lines())
            && self.cycle.is_none()
            && other.cycle.is_none()
            && self.agrees_in_place(other)
    }

    /// Whether all is the same but for cycles: the active one, and the level to return to.
    pub(crate) fn agrees_beside_cycle(&self, other: &Exec) -> bool {
        self.slots == other.slots && self.agrees_in_place(other)
    }

    /// Whether all is the same that straight moves of a hole or of lines make events of: but for cycles, the active motion,
    /// and the direction of the last move, which these do not read. Nor do they slots, where nothing waits for them.
    pub(crate) fn agrees_beside_motion(&self, other: &Exec) -> bool {
        self.agrees_beside_way(other, InModes { motion: self.modes.motion, ..other.modes })
    }

    /// Whether all is the same that straight moves make events of, but for the active motion, the feed, and what it counts.
    pub(crate) fn agrees_beside_feed(&self, other: &Exec) -> bool {
        let counted = State { feed_mode: self.state.feed_mode, ..other.state };
        let modes = InModes { motion: self.modes.motion, ..other.modes };
        self.cycle.is_none()
            && other.cycle.is_none()
            && self.state == counted
            && self.agrees_beside_state(other, modes)
    }

    /// Whether the same cycle is active on both controls, if any is.
    fn has_cycle_of(&self, other: &Exec) -> bool {
        let same_parameters = self.cycle.is_none() || self.world.orientation == other.world.orientation;
        self.cycle == other.cycle && same_parameters
    }

    /// Whether two controls are in one state but for the slots of their frames, and for cycles.
    fn agrees_in_place(&self, other: &Exec) -> bool {
        self.heading == other.heading && self.agrees_beside_way(other, other.modes)
    }

    /// The same, with these modes of the other, and whatever way both have come.
    fn agrees_beside_way(&self, other: &Exec, modes: InModes) -> bool {
        self.feed == other.feed && self.state == other.state && self.agrees_beside_state(other, modes)
    }

    /// The same, whatever the feed is and what is on.
    fn agrees_beside_state(&self, other: &Exec, modes: InModes) -> bool {
        self.modes == InModes { return_level: self.modes.return_level, ..modes }
            && self.position == other.position
            && self.frame == other.frame
            && self.chain == other.chain
            && self.offset_turned == other.offset_turned
            && self.last == other.last
            && self.raw == other.raw
            && self.probing == other.probing
            && self.detour == other.detour
            && self.pole == other.pole
            && self.after_stop == other.after_stop
            && self.ways == other.ways
            && self.waiting == other.waiting
            && self.zeroed == other.zeroed
            && self.along == other.along
            && self.at_place == other.at_place
            && self.is_between_blocks()
            && other.is_between_blocks()
            && self.turned_known == other.turned_known
            && self.contour == other.contour
            && self.centre_path.is_none()
            && other.centre_path.is_none()
            && self.selected == other.selected
            && self.put_in() == other.put_in()
            && self.speed_watched == other.speed_watched
            && self.corner.is_none()
            && other.corner.is_none()
            && self.ended == other.ended
            && self.world.seed == other.world.seed
    }

    /// Takes over the state of a control that it agreed with before both executed the same lines or holes. (These put
    /// nothing into slots of frames, and leave the level to return to as it is.)
    pub fn follow(&mut self, other: &Exec) {
        self.modes = InModes { return_level: self.modes.return_level, ..other.modes };
        self.position = other.position;
        self.frame = other.frame;
        self.chain.clone_from(&other.chain);
        self.last = other.last;
        self.heading = other.heading;
        self.raw = other.raw;
        self.probing = other.probing;
        self.detour = other.detour;
        self.pole = other.pole;
        self.after_stop = other.after_stop;
        self.ways = other.ways;
        self.waiting = other.waiting;
        self.zeroed = other.zeroed;
        self.along = other.along;
        self.at_place = other.at_place;
        self.turned_known = other.turned_known;
        self.contour = other.contour;
        self.feed = other.feed;
        self.selected = other.selected;
        self.state = other.state;
        self.speed_watched = other.speed_watched;
        self.said |= other.said & !RETURN;
        self.ended = other.ended;
        if other.cycle.is_none() {
            // A cycle that goes on stays in the words of its own control.
            self.cycle = None;
        }
    }
}

/// The number by which a tool with a name is distinguished from others: less than -1, the same wherever the name
/// is met.
pub fn named_tool(name: &str) -> i64 {
    let hash = name
        .bytes()
        .fold(0xcbf2_9ce4_8422_2325u64, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3));
    -((hash >> 2) as i64) - 2
}
