//! What a control does where a frame or a length changes.
//!
//! ```text
//! SET_FRAME(rotate, XY, 90deg)    the tool stays; its position is counted in the new frame from here on
//! ```
//!
//! Not here: the matrix of a chain of frames (`chain`), the slots (`slots`).

use crate::Exec;
use crate::frames::chain::Chain;
use crate::frames::slots::{Frames, Present};
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AXES, Distance, Fact, Plane};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::geometry;
use ncc_ir::program::{Coord, Frame, FrameSlot, Point, Slot, ToolLength};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::{FrameUnexecuted, MoveUnexecuted};

/// Which length of a tool is active.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Length {
    /// An entry of the table; 0 is none.
    Entry(u32),
    /// An edge of a tool, where that is not an entry.
    Edge(i64, u32),
    /// This one, whatever the table says.
    Value(Nanos),
}

/// A vector turned about Z by degrees in nanos.
pub(crate) fn turned(p: &[Nanos; AXES], angle: Nanos) -> [Nanos; AXES] {
    if angle == 0 {
        return *p;
    }
    let (sin, cos) = geometry::sin_cos(angle);
    let (x, y) = (p[0] as f64, p[1] as f64);
    let mut out = *p;
    (out[0], out[1]) = ((cos * x - sin * y).round() as Nanos, (sin * x + cos * y).round() as Nanos);
    out
}

/// What a control knows where a frame changes.
struct Now<'e> {
    exec: &'e Exec,
    span: Span,
}

impl Present for Now<'_> {
    type Unknown = Diagnostic;

    fn plane(&self, plane: Fact<Plane>) -> Result<Plane, Diagnostic> {
        Ok(self.exec.plane_of(plane))
    }

    fn value(&self, value: &Expr) -> Result<Nanos, Diagnostic> {
        self.exec.value(value, self.span)
    }

    fn distance(&self, word: &Coord) -> Result<Distance, Diagnostic> {
        Ok(word.distance.or(self.exec.modes.distance))
    }

    fn work(&self, axis: usize) -> Result<Nanos, Diagnostic> {
        if self.exec.offset_turned {
            return Err(Diagnostic::new(
                Fault::not_executed(FrameUnexecuted::TurnedOffsetPosition),
                self.span,
            ));
        }
        Ok(self.exec.machine()[axis].wrapping_sub(self.exec.frame[axis]))
    }

    fn out_of_range(&self) -> Diagnostic {
        Diagnostic::new(Fault::OutOfRange { word: "factor".into() }, self.span)
    }
}

impl Exec {
    /// Whether the next command of Z applies a length other than the active one.
    pub(crate) fn another_length_waits(&self) -> bool {
        self.waiting.is_some_and(|length| self.length_of(length) != self.length_of(self.modes.length))
    }

    pub(crate) fn set_frame(&mut self, frame: &Frame, span: Span) -> Result<(), Diagnostic> {
        let mut frames = self.slots();
        if !frame.added {
            frames.steps = Chain::NONE;
        }
        frames.steps.add(
            &frame.step,
            |plane| Ok(self.plane_of(plane)),
            |value| self.value(value, span),
            || Diagnostic::new(Fault::OutOfRange { word: "factor".into() }, span),
        )?;
        if !frame.added {
            self.fills_shift(None, span);
        }
        self.use_slots(frames);
        Ok(())
    }

    /// Fills a slot.
    pub(crate) fn set_slot(&mut self, slot: &Slot, span: Span) -> Result<(), Diagnostic> {
        let mut frames = self.slots();
        if matches!(slot, Slot::Shift { origin: true, .. }) && frames.suspended.is_some() {
            // What becomes of the numbers kept for the other axes, no source tells.
            self.said &= !crate::SHIFT_STORED;
        }
        frames.set(slot, &Now { exec: self, span })?;
        self.fills(slot, span);
        self.use_slots(frames);
        Ok(())
    }

    /// Gives the present point coordinates.
    pub(crate) fn set_position(&mut self, axes: &[Option<Expr>; AXES], span: Span) -> Result<(), Diagnostic> {
        let mut frames = self.slots();
        if frames.is_turned() {
            return self.not_executed(FrameUnexecuted::PresentPointTurned, span);
        }
        self.said |= crate::SHIFT_STORED;
        let named = axes.iter().enumerate().filter(|(_, word)| word.is_some());
        self.fills_shift(Some(named.fold(0, |bits, (axis, _)| bits | 1 << axis)), span);
        let shift = self.origin_shift();
        if self.offset_turned {
            if frames.chain() != Chain::NONE {
                return self.not_executed(FrameUnexecuted::PresentPointOffset, span);
            }
            for (axis, word) in axes.iter().enumerate() {
                let Some(word) = word else { continue };
                let at = self.position[axis].wrapping_sub(self.value(word, span)?);
                frames.suspended = None;
                frames.origin[axis] = Some(shift[axis].wrapping_add(at));
            }
            self.use_slots(frames);
            return Ok(());
        }
        frames.set_position(axes, &shift, &Now { exec: self, span })?;
        self.use_slots(frames);
        Ok(())
    }

    /// Whether frames of the program turn, scale or mirror.
    pub(crate) fn turns_frames(&self) -> bool {
        self.slots().is_turned()
    }

    /// Empties a slot.
    pub(crate) fn clear_slot(&mut self, slot: FrameSlot) {
        if slot == FrameSlot::Shift {
            self.modes.shifted = false;
            self.said |= crate::SHIFT | crate::SHIFT_STORED;
            self.said &= !crate::SHIFT_TAKEN_UP;
        }
        self.empties(slot);
        let mut frames = self.slots();
        frames.clear(slot);
        self.use_slots(frames);
    }

    /// Suspends the G92 shift, or restores it.
    ///
    /// # Errors
    /// Not every number of it is this program's: what an earlier one has left in store, the control alone knows.
    pub(crate) fn use_origin_shift(&mut self, on: bool, span: Span) -> Result<(), Diagnostic> {
        let mut frames = self.slots();
        if on {
            if self.said & crate::SHIFT_STORED == 0 {
                return self.not_executed(FrameUnexecuted::EarlierShift, span);
            }
            self.modes.shifted |= frames.resume();
            self.said |= crate::SHIFT_TAKEN_UP;
        } else {
            frames.suspend(self.modes.shifted);
            self.modes.shifted = false;
            self.said |= crate::SHIFT;
            self.said &= !crate::SHIFT_TAKEN_UP;
        }
        self.use_slots(frames);
        Ok(())
    }

    /// Turns the active work offset, with the G92 shift and all frames in it; 0 is not turned.
    #[cold]
    pub(crate) fn turn_offset(&mut self, turn: Nanos) {
        let mut chain = Chain::NONE;
        self.offset_turned = turn != 0;
        if self.offset_turned {
            let (sin, cos) = geometry::sin_cos(turn);
            chain.append([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]]);
            chain = chain.then(&Chain::by(self.origin_shift()));
        }
        let chain = chain.then(&self.slots().chain());
        self.chain = (chain != Chain::NONE).then(|| Box::new(chain));
    }

    fn slots(&self) -> Frames {
        self.slots.as_deref().cloned().unwrap_or(Frames::NONE)
    }

    fn use_slots(&mut self, frames: Frames) {
        let (here, before) = (self.machine(), self.before_frame());
        let chain = frames.chain();
        self.chain = (chain != Chain::NONE).then(|| Box::new(chain));
        self.slots = (frames != Frames::NONE).then(|| Box::new(frames));
        self.reframe(here);
        self.carry(before);
    }

    /// The G92 shift: what was stated, and of the other axes what was left over.
    pub(crate) fn origin_shift(&self) -> [Nanos; AXES] {
        let left = if self.modes.shifted { self.world.left_over_shift() } else { [0; AXES] };
        match &self.slots {
            None => left,
            Some(slots) => std::array::from_fn(|i| slots.origin[i].unwrap_or(left[i])),
        }
    }

    /// A straight move in machine coordinates: frames and work offset are off, the length is not.
    /// A straight move in machine coordinates: frames and work offset are off, and the length where it
    /// does not stay. A length that waits takes effect at a Z that is measured with it.
    #[cold]
    pub(crate) fn place_in_machine(
        &mut self,
        to: &Point,
        length: bool,
        span: Span,
    ) -> Result<(), Diagnostic> {
        if length && to.axes[self.along].is_some() {
            self.take_up_length();
        }
        let mut machine = self.machine();
        for (axis, word) in to.axes.iter().enumerate() {
            let Some(word) = word else { continue };
            if word.distance.or(self.modes.distance) == Distance::Incremental {
                return self.fault(Fault::not_executed(MoveUnexecuted::IncrementInMachine), span);
            }
            let length = if length { self.tool_offset()[axis] } else { 0 };
            machine[axis] = self.value(&word.value, span)?.wrapping_add(length);
        }
        self.position = self.unplace(&machine);
        if !length && to.axes[self.along].is_some() {
            self.goes_to_place();
            self.cancel_length(Behaviour::LengthAfterMachineMove);
        }
        self.not_carried(to);
        Ok(())
    }

    /// A length that is no entry of the table; what is added to is the length that waits, or is active.
    pub(crate) fn use_length(&mut self, length: &ToolLength, span: Span) -> Result<(), Diagnostic> {
        let before = self.length_of(self.waiting.unwrap_or(self.modes.length));
        let sum = match length {
            ToolLength::Value(value) => Some(self.value(value, span)?),
            ToolLength::Added(value) => before.checked_add(self.value(value, span)?),
            ToolLength::AddedEntry(entry) => match u32::try_from(self.whole_number(entry, span)?) {
                Ok(entry) => before.checked_add(self.world.tool_length(entry)),
                Err(_) => None,
            },
            ToolLength::Offsets { added, words } => match self.offsets_of(words, *added, span)? {
                [x, y, z] => {
                    self.use_aside([x, y], span)?;
                    Some(z)
                }
            },
        };
        if let ToolLength::AddedEntry(entry) = length
            && let Ok(entry) = u32::try_from(self.whole_number(entry, span)?)
        {
            let [x, y] = self.world.tool_offsets(entry);
            self.use_aside([self.aside[0].wrapping_add(x), self.aside[1].wrapping_add(y)], span)?;
        }
        let Some(sum) = sum.filter(|sum| sum.unsigned_abs() < 1 << 60) else {
            return self.fault(Fault::OutOfRange { word: "length".into() }, span);
        };
        self.said |= crate::LENGTH;
        self.waiting = Some(Length::Value(sum));
        Ok(())
    }

    pub(crate) fn length_of(&self, length: Length) -> Nanos {
        match length {
            Length::Entry(entry) => self.world.tool_length(entry),
            Length::Edge(tool, edge) => self.world.edge_length(tool, edge),
            Length::Value(length) => length,
        }
    }

    /// A length that is activated: none, if it is that of the tool in the spindle and the operator has set the zero of Z
    /// by that. Of a tool that no program has named, nobody knows by what.
    pub(crate) fn as_zeroed(&self, length: Length) -> Length {
        let own = match length {
            Length::Entry(entry) => i64::from(entry) == self.state.tool,
            Length::Edge(tool, edge) => edge == 1 && tool != -1 && tool == self.state.tool,
            Length::Value(_) => false,
        };
        if self.world.zeroed_by_tool && own { Length::Entry(0) } else { length }
    }

    /// The length of an edge: one and the same thing has one name only.
    pub(crate) fn edge(&self, edge: u32) -> Length {
        let tool = if self.world.length_by_change { self.changed_to } else { self.state.tool };
        match (u32::try_from(tool), edge) {
            // No tool has no length, whatever edge is active.
            (_, 0) | (Ok(0), _) => Length::Entry(0),
            (Err(_), _) if self.world.length_by_change => Length::Entry(0),
            (Ok(tool), 1) => Length::Entry(self.world.edge_entry(tool)),
            _ => Length::Edge(tool, edge),
        }
    }
}
