//! Reference points, and values that a program puts into the control's tables.
//!
//! A reference point is where the world has it; axes go there by a rapid move like any other.
//! The world states where a probe triggers.
//! What is put into a table counts from then on, and is an event: a value that this program does not
//! use may be another's.

use super::{Exec, Kind, Stored};
use crate::Event;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AXES, Distance, Motion, same_point};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::program::{Coord, Data, DataMode, Detour, Point, Reference, ReferencePoint};
use ncc_ir::source::Span;
use ncc_ir::syntax::Ranged;
use ncc_ir::unexecuted::{CycleUnexecuted, FrameUnexecuted, MoveUnexecuted};

impl Exec {
    #[cold]
    pub(super) fn go_to_reference(
        &mut self,
        to: &Reference,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if self.cycle.is_some() {
            return self.not_executed(CycleUnexecuted::ReturnInCycle, span);
        }
        if !to.via.is_empty() {
            self.set_axes(&to.via, span)?;
            self.emit_move(false, span, out)?;
        }
        let point = self.world.reference(to.point);
        let mut machine = self.machine();
        for (axis, goes) in to.axes.iter().enumerate() {
            if *goes {
                self.intermediate[axis] = Some([self.position[axis], machine[axis]]);
                machine[axis] = point[axis];
                self.stop_carrying(axis);
            }
        }
        self.position = self.unplace(&machine);
        self.heading = super::Heading::None;
        self.emit_move(false, span, out)?;
        if to.axes[self.along] {
            self.goes_to_place();
        }
        if to.axes[self.along] && !to.keeps_length {
            self.cancel_length(Behaviour::LengthAfterReturn);
        }
        Ok(())
    }

    /// A rapid straight move that goes another way than straight. By the intermediate point it goes where that is
    /// the same place of the work and of the machine as when it was stated: which of them a control keeps is not
    /// relied on.
    #[cold]
    pub(super) fn go_by_detour(
        &mut self,
        to: &Point,
        feed: bool,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let Some(detour) = self.detour.take() else { return Ok(()) };
        if feed || self.raw.is_some() || self.probing.is_some() || self.state.tilted {
            return self.not_executed(MoveUnexecuted::DetourNotRapid, span);
        }
        if self.cycle.is_some() {
            return self.not_executed(CycleUnexecuted::DetourInCycle, span);
        }
        let named: [bool; AXES] = std::array::from_fn(|axis| to.axes[axis].is_some());
        match detour {
            Detour::Intermediate => {
                let counts = |word: &Coord| word.distance.or(self.modes.distance) == Distance::Incremental;
                if to.axes.iter().flatten().any(counts) {
                    return self.not_executed(MoveUnexecuted::IncrementalReturn, span);
                }
                if named[self.along] {
                    self.take_up_length();
                }
                let axes = || named.iter().enumerate().filter(|(_, named)| **named).map(|(axis, _)| axis);
                for axis in axes() {
                    let Some([at, _]) = self.intermediate[axis] else {
                        return self.not_executed(MoveUnexecuted::IntermediatePointUnset, span);
                    };
                    self.position[axis] = at;
                }
                let machine = self.machine();
                if axes().any(|axis| self.intermediate[axis].is_some_and(|[_, place]| place != machine[axis]))
                {
                    return self.not_executed(MoveUnexecuted::OtherCoordinatesPoint, span);
                }
                self.emit_move(false, span, out)?;
                let own = self.modes.motion;
                self.straight(to, false, span, out)?;
                if own != Motion::Traverse {
                    self.modes.motion = Motion::Cycle;
                }
                Ok(())
            }
            Detour::OneSide => {
                let before = self.position;
                self.set_axes(to, span)?;
                if before != self.position {
                    self.heading = super::Heading::From(before);
                }
                if self.modes.motion != Motion::Traverse {
                    // Its code may hold for its block alone.
                    self.modes.motion = Motion::Cycle;
                }
                self.said |= super::MOTION;
                self.cycle = None;
                self.last = self.machine();
                self.state.one_side = named.iter().rev().fold(0, |bits, named| bits << 1 | u8::from(*named));
                let done = self.emit(Kind::Traverse, span, out);
                self.state.one_side = 0;
                done
            }
        }
    }

    /// Whether a straight move is one with a code of its own, for which no cycle may be active.
    pub(super) fn has_own_code(&self, span: Span) -> Result<bool, Diagnostic> {
        let own_code = self.raw.is_some() || self.probing.is_some();
        if own_code && self.cycle.is_some() {
            self.not_executed(CycleUnexecuted::MachineMoveInCycle, span)?;
        }
        Ok(own_code)
    }

    /// A straight move at feed to the present position, which ends where the probe triggers.
    #[cold]
    pub(super) fn probe(&mut self, feed: bool, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        let Some(probe) = self.probing.take() else { return Ok(()) };
        if !feed || self.raw.is_some() {
            return self.not_executed(MoveUnexecuted::RapidProbing, span);
        }
        let (from, to) = (self.last, self.machine());
        if same_point(&from, &to) {
            return self.not_executed(MoveUnexecuted::ProbingNowhere, span);
        }
        let share = i128::from(self.world.touched());
        self.last = std::array::from_fn(|axis| {
            let way = i128::from(to[axis]) - i128::from(from[axis]);
            from[axis].wrapping_add((way * share / i128::from(ONE)) as Nanos)
        });
        self.touched = Some(Box::new([self.unplace(&self.last), self.tool_offset()]));
        self.back_off(&from);
        self.position = self.unplace(&self.last);
        self.emit(Kind::Probe { to: Box::new(to), probe }, span, out)
    }

    /// Retracts from where the probe has touched, the way it came, as far as this machine does so by itself.
    fn back_off(&mut self, from: &[Nanos; AXES]) {
        let way: [f64; 3] = std::array::from_fn(|axis| (self.last[axis] - from[axis]) as f64);
        let long = way.iter().map(|n| n * n).sum::<f64>().sqrt();
        if self.world.backs_off == 0 || long == 0.0 {
            return;
        }
        for (axis, way) in way.into_iter().enumerate() {
            self.last[axis] -= (way / long * self.world.backs_off as f64).round() as Nanos;
        }
    }

    #[cold]
    pub(super) fn set_data(
        &mut self,
        data: &Data,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if self.cycle.is_some() && !matches!(data, Data::Position(_) | Data::ToolInSpindle(_)) {
            return self.not_executed(CycleUnexecuted::DataInCycle, span);
        }
        let stored = match data {
            Data::Position(place) => {
                let here = self.machine();
                self.world.tables.references.insert(ReferencePoint::Stored(*place), here.map(Some));
                Stored::Position(*place, here)
            }
            Data::ToolInSpindle(tool) => {
                let Ok(number) = u32::try_from(self.whole_number(tool, span)?) else {
                    return self.fault(Fault::OutOfRange { word: "tool".into() }, span);
                };
                self.state.tool = i64::from(number);
                Stored::Tool(self.world.tool_number(number))
            }
            Data::Offset { offset, mode, words, turn } => {
                let (here, before) = (self.machine(), self.before_frame());
                let mut zero = self.world.work_offset(*offset);
                let turned = self.world.work_turn(*offset);
                let is_turned = turned != 0 || self.offset_turned;
                if *mode == DataMode::Here && (self.modes.shifted || self.chain.is_some() || is_turned) {
                    return self.not_executed(FrameUnexecuted::OffsetByPosition, span);
                }
                for (axis, word) in words.iter().enumerate() {
                    let Some(word) = word else { continue };
                    let value = self.value(word, span)?;
                    let beside = self.tool_offset()[axis].wrapping_add(self.external()[axis]);
                    let sum = match mode {
                        DataMode::Set => Some(value),
                        DataMode::Add => zero[axis].checked_add(value),
                        DataMode::Here => here[axis].checked_sub(value).and_then(|v| v.checked_sub(beside)),
                    };
                    zero[axis] = match sum {
                        Some(sum) if sum.unsigned_abs() < 1 << 60 => sum,
                        Some(_) | None => {
                            return self.fault(Fault::OutOfRange { word: Ranged::Unnamed }, span);
                        }
                    };
                }
                let turned = turn.as_ref().map_or(Ok(turned), |turn| self.value(turn, span))?;
                self.world.tables.work_offsets.insert(*offset, zero.map(Some));
                self.world.tables.work_turns.insert(*offset, turned);
                if self.modes.work_offset == *offset {
                    self.reframe(here);
                    self.carry(before);
                }
                Stored::Offset(self.world.offset_number(*offset), zero, turned)
            }
            Data::Tool { entry, which, added, kept, value } => {
                let value = self.value(value, span)?;
                self.set_tool(*entry, *which, [*added, *kept], value, span)?
            }
            Data::Measured { entry, offset, words } => {
                return self.measure_tool(*entry, *offset, words, span, out);
            }
        };
        self.emit(Kind::Data(Box::new(stored)), span, out)
    }
}
