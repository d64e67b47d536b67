//! Tool centre point control, and tilted working planes.
//!
//! Neither is worked into coordinates: the machine's kinematics are in no program. Points stay what the
//! program says, of the tip or in the plane, and that they are is an attribute of each move; the plane
//! itself is an event. How far such points lie from those of the linear axes differs from world to world,
//! so that what is left out where one is switched shows.
//!
//! What controls refuse there, or do each in a way of their own, is refused.

use crate::{Event, Exec, Kind};
use ncc_ir::canon::{Axis, Units};
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::num::Nanos;
use ncc_ir::geometry;
use ncc_ir::program::kinds::{
    conduct, drilling, flow, miscellaneous, modes, moves, polar, tooling, variables,
};
use ncc_ir::program::{Data, FrameSlot, Op, Slot, Stmt, Tilt, Toward};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::{CompensationUnexecuted, CycleUnexecuted, FrameUnexecuted, Unexecuted};

/// A working plane in space.
#[derive(Clone, Debug, PartialEq)]
pub struct TiltedPlane {
    /// Its zero, in the coordinates that it is set in.
    pub origin: [Nanos; 3],
    /// Its axes, as columns, in those coordinates.
    pub axes: [[f64; 3]; 3],
}

impl TiltedPlane {
    /// The plane that is turned about these axes, one after the other, by so many degrees in nanos.
    pub fn turned(origin: [Nanos; 3], turns: [(Axis, Nanos); 3]) -> TiltedPlane {
        let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        for (about, angle) in turns {
            let (sin, cos) = geometry::sin_cos(angle);
            let (f, s) = match about {
                Axis::X | Axis::A => (1, 2),
                Axis::Y | Axis::B => (2, 0),
                Axis::Z | Axis::C => (0, 1),
            };
            for row in &mut axes {
                (row[f], row[s]) = (row[f] * cos + row[s] * sin, row[s] * cos - row[f] * sin);
            }
        }
        TiltedPlane { origin, axes }
    }

    /// What planes have in common that are the same but for rounded angles, except where a direction happens to
    /// lie between two of a thousandth.
    pub fn rounded(&self) -> ([Nanos; 3], [[i16; 3]; 3]) {
        (self.origin, self.axes.map(|row| row.map(|part| (part * 1000.0).round() as i16)))
    }

    /// Whether it is the same plane: its zero to within `half`, its directions to within `angle` (degrees
    /// in nanos).
    pub fn is_same(&self, other: &TiltedPlane, half: Nanos, angle: Nanos) -> bool {
        // Three turns may each be off by that.
        let most = 3.0 * (angle as f64 / 1e9).to_radians() + 1e-12;
        let near = |(a, b): (&f64, &f64)| (a - b).abs() <= most;
        self.origin.iter().zip(&other.origin).all(|(a, b)| a.abs_diff(*b) <= half as u64)
            && self.axes.as_flattened().iter().zip(other.axes.as_flattened()).all(near)
    }
}

impl Exec {
    /// What kinematics put between the program's zero and that of the linear axes.
    #[cold]
    pub(crate) fn shift_by_kinematics(&mut self) {
        for (on, tip) in [(self.state.tip, true), (self.state.tilted, false)] {
            if on {
                for (frame, by) in self.frame.iter_mut().zip(self.world.kinematic_shift(tip)) {
                    *frame = frame.wrapping_add(by);
                }
            }
        }
    }

    /// Whether points are those of the tool tip from here on.
    #[cold]
    pub(crate) fn use_tip(&mut self, on: bool, span: Span) -> Result<(), Diagnostic> {
        if on == self.state.tip {
            return Ok(());
        }
        let what: Option<Unexecuted> = match () {
            () if self.state.tilted => Some(FrameUnexecuted::TipInTilt.into()),
            () if self.cycle.is_some() => Some(CycleUnexecuted::TipInCycle.into()),
            () if on && (self.chain.is_some() || self.slots.is_some()) => {
                Some(FrameUnexecuted::TipUnderFrame.into())
            }
            () if self.state.compensation.side.is_some() || self.contour.watched => {
                Some(CompensationUnexecuted::TipControl.into())
            }
            () => None,
        };
        if let Some(what) = what {
            return self.not_executed(what, span);
        }
        let here = self.machine();
        self.state.tip = on;
        self.reframe(here);
        Ok(())
    }

    /// Sets a tilted plane.
    #[cold]
    pub(crate) fn set_tilt(
        &mut self,
        tilt: &Tilt,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        let what: Option<Unexecuted> = match () {
            () if self.state.tip => Some(FrameUnexecuted::TiltUnderTip.into()),
            () if self.cycle.is_some() => Some(CycleUnexecuted::TiltInCycle.into()),
            () if self.chain.is_some() || self.slots.is_some() => {
                Some(FrameUnexecuted::TiltUnderFrame.into())
            }
            () if self.state.compensation.side.is_some() || self.contour.watched => {
                Some(CompensationUnexecuted::Tilt.into())
            }
            () if self.state.tilted => Some(FrameUnexecuted::TiltInTilt.into()),
            () => None,
        };
        if let Some(what) = what {
            return self.not_executed(what, span);
        }
        let mut origin = [0; 3];
        for (at, word) in origin.iter_mut().zip(&tilt.origin) {
            if let Some(word) = word {
                *at = self.value(word, span)?;
            }
        }
        let mut turns = [(Axis::X, 0); 3];
        for ((turn, about), angle) in turns.iter_mut().zip(tilt.about).zip(&tilt.angles) {
            *turn = (about, self.value(angle, span)?);
        }
        let here = self.machine();
        self.state.tilted = true;
        self.reframe(here);
        self.emit(Kind::Tilt(Some(Box::new(TiltedPlane::turned(origin, turns)))), span, out)
    }

    /// Takes the tilted plane back, if there is one.
    #[cold]
    pub(crate) fn clear_tilt(&mut self, span: Span, out: &mut Vec<Event>) -> Result<(), Diagnostic> {
        if !self.state.tilted {
            // What a control takes back with it, if anything, is its own.
            return match self.chain.is_some() || self.slots.is_some() {
                true => self.not_executed(FrameUnexecuted::TiltEndUnderFrame, span),
                false => Ok(()),
            };
        }
        if self.cycle.is_some() {
            return self.not_executed(CycleUnexecuted::TiltEndInCycle, span);
        }
        let here = self.machine();
        self.state.tilted = false;
        self.reframe(here);
        self.emit(Kind::Tilt(None), span, out)
    }

    /// Turns the tool upright on the tilted plane.
    #[cold]
    pub(crate) fn orient_tool_axis(
        &mut self,
        toward: Option<Toward>,
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if !self.state.tilted {
            return self.not_executed(FrameUnexecuted::AxisWithoutTilt, span);
        }
        if self.cycle.is_some() || self.state.compensation.side.is_some() || self.contour.watched {
            return self.not_executed(FrameUnexecuted::AxisInCycle, span);
        }
        let mut here = self.machine();
        if let Some(rotary) = self.world.oriented() {
            here[3..].copy_from_slice(&rotary);
        }
        self.position = self.unplace(&here);
        self.last = here;
        self.emit(Kind::OrientToolAxis(toward), span, out)
    }

    /// Refuses what is no matter of course under tool centre point control, or in a tilted plane.
    #[cold]
    pub(crate) fn check_tilted(&self, stmt: &Stmt) -> Result<(), Diagnostic> {
        let what = match (self.state.tip, self.sets_another_frame(&stmt.op)) {
            (true, true) => Some(FrameUnexecuted::FrameUnderTip),
            (false, true) => Some(FrameUnexecuted::FrameInTilt),
            (true, false) => self.refused_at_tip(&stmt.op),
            (false, false) => None,
        };
        what.map_or(Ok(()), |what| self.not_executed(what, stmt.span))
    }

    /// Whether it puts program zero elsewhere, other than by a tilted plane.
    fn sets_another_frame(&self, op: &Op) -> bool {
        match op {
            Op::SetOriginOffsets(offset) => *offset != self.modes.work_offset,
            Op::SetFrame(_) | Op::SetPosition(_) => true,
            Op::SetSlot(slot) => !matches!(**slot, Slot::Tilt(_)),
            // One that is suspended alone is restored.
            Op::ClearFrame(FrameSlot::Shift) | Op::UseOriginShift(_) => {
                self.modes.shifted || self.slots.is_some()
            }
            Op::SetData(data) => match **data {
                Data::Offset { offset, .. } => offset == self.modes.work_offset,
                Data::Tool { .. } => self.state.tip,
                // Where the axes stand after a switch, the machine alone knows.
                Data::Position(_) | Data::Measured { .. } => true,
                Data::ToolInSpindle(_) => self.state.tip,
            },
            Op::ClearFrame(_)
            | Op::UseToolCentrePoint(_)
            | Op::OrientToolAxis(_)
            | Op::UseMachineCoordinates { .. }
            | Op::Probe(_)
            | Op::Detour(_)
            | Op::GoToReference(_)
            | Op::SetFeedRate(_)
            | Op::Position(_)
            | drilling!()
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::BeginAgain
            | variables!()
            | miscellaneous!()
            | conduct!()
            | modes!()
            | tooling!()
            | moves!()
            | polar!()
            | flow!() => false,
        }
    }

    /// What is refused under tool centre point control.
    fn refused_at_tip(&self, op: &Op) -> Option<FrameUnexecuted> {
        match op {
            Op::Polar(polar) => self.refused_at_tip(&polar.op),
            // Which of them a control takes depends on how its rotary axes are built.
            moves!() if matches!(op, Op::ArcFeed(_) | Op::ArcForm(_)) => Some(FrameUnexecuted::ArcUnderTip),
            drilling!() => Some(FrameUnexecuted::CycleUnderTip),
            moves!() if matches!(op, Op::SynchronisedFeed(_)) => Some(FrameUnexecuted::ThreadUnderTip),
            miscellaneous!() if matches!(op, Op::StartCutterRadiusCompensation { .. }) => {
                Some(FrameUnexecuted::CompensationUnderTip)
            }
            Op::UseMachineCoordinates { .. } | Op::GoToReference(_) => {
                Some(FrameUnexecuted::MachinePointUnderTip)
            }
            Op::Probe(_) => Some(FrameUnexecuted::ProbingUnderTip),
            Op::Detour(_) => Some(FrameUnexecuted::DetourUnderTip),
            Op::ChangeTool => Some(FrameUnexecuted::ToolChangeUnderTip),
            Op::UseLengthUnits(units) if (*units == Units::Inch) != self.modes.inch => {
                Some(FrameUnexecuted::UnitsUnderTip)
            }
            Op::UseToolCentrePoint(_)
            | Op::OrientToolAxis(_)
            | Op::SetOriginOffsets(_)
            | Op::ClearFrame(_)
            | Op::SetFrame(_)
            | Op::SetSlot(_)
            | Op::SetPosition(_)
            | Op::UseOriginShift(_)
            | Op::SetData(_)
            | Op::SelectTool(_)
            | Op::SelectToolByName(_)
            | Op::UseToolLengthOffset(_)
            | Op::UseToolLength(_)
            | Op::UseToolEdge { .. }
            | Op::SetFeedRate(_)
            | Op::Position(_)
            | Op::SetPole(_)
            | Op::EndCycle
            | Op::ProgramEnd
            | Op::BeginAgain
            | variables!()
            | miscellaneous!()
            | conduct!()
            | modes!()
            | moves!()
            | flow!() => None,
        }
    }
}
