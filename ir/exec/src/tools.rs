//! Values of the table of tools, and the offsets of the active tool: its length, and what it is put aside along
//! X and Y.
//!
//! Offsets along X and Y count as soon as they are activated, and move nothing. They are along the machine's axes,
//! outside all frames. Nothing of an active entry changes by another value in its table where the program's control
//! keeps it; where nobody knows, that is not executed.

use super::{Exec, Kind, Stored, Z};
use crate::Event;
use crate::frames::frame::Length;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::{AXES, Plane};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::{Op, Stmt, ToolValue};
use ncc_ir::source::Span;
use ncc_ir::unexecuted::ToolUnexecuted;

impl Exec {
    /// Offsets of the active tool, in the machine's directions.
    pub(super) fn tool_offset(&self) -> [Nanos; AXES] {
        let [x, y] = self.aside;
        let mut offset = [x, y, 0, 0, 0, 0];
        offset[self.along] += self.length_of(self.modes.length);
        offset
    }

    /// The axis along which lengths lie in the active plane, on this control.
    pub(super) fn length_axis(&self) -> usize {
        match self.world.behaviours.does(Behaviour::LengthAxisInPlane) {
            true => self.modes.plane.axes().2 as usize,
            false => Z,
        }
    }

    /// Another plane: lengths may lie along another axis from here on; nothing moves.
    pub(super) fn turn_length(&mut self) {
        if self.length_of(self.waiting.unwrap_or(self.modes.length)) != 0 {
            self.asked |= Behaviour::LengthAxisInPlane.bit();
        }
        if self.world.behaviours.does(Behaviour::LengthAxisInPlane) {
            self.lie_along(self.length_axis());
        }
    }

    fn lie_along(&mut self, axis: usize) {
        if axis != self.along {
            let here = self.machine();
            self.along = axis;
            self.reframe(here);
        }
    }

    /// A length is activated that may lie along another axis than Z; one that lies along another than that is over.
    fn call_up_along(&mut self) {
        let normal = self.modes.plane.axes().2 as usize;
        if normal != Z {
            self.asked |= Behaviour::LengthAxisAtCall.bit();
        }
        if self.world.behaviours.does(Behaviour::LengthAxisAtCall) && normal != self.along {
            let here = self.machine();
            (self.modes.length, self.along) = (Length::Entry(0), normal);
            self.reframe(here);
        }
    }

    /// Behaviours about lengths that these statements reach in another plane than that of X and Y.
    pub fn lengths_aside_in(&self, stmts: &[Stmt]) -> u64 {
        let mut aside = self.modes.plane != Plane::Xy;
        let mut bits = 0;
        for stmt in stmts {
            match &stmt.op {
                Op::SelectPlane(plane) => {
                    aside |= *plane != Plane::Xy;
                    if aside {
                        bits |= Behaviour::LengthAxisInPlane.bit();
                    }
                }
                op if aside && op.calls_length() => bits |= Behaviour::LengthAxisAtCall.bit(),
                _ => {}
            }
        }
        bits
    }

    /// Offsets of the tool as the program has called them up, whether Z has applied its length or not.
    pub fn called_up(&self) -> [Nanos; 3] {
        let [x, y] = self.aside;
        [x, y, self.length_of(self.waiting.unwrap_or(self.modes.length))]
    }

    /// Lets a length count at once that waits for Z, as some controls do.
    pub fn take_up_at_once(&mut self) {
        if let Some(length) = self.waiting.take() {
            let here = self.machine();
            self.modes.length = length;
            self.reframe(here);
        }
    }

    /// Values of an entry that the program itself has put into the table: the offsets along X, Y and Z; `None` where
    /// one of them is not the program's.
    pub fn stated_entry(&self, entry: u32) -> Option<[Nanos; 3]> {
        let [x, y] = *self.world.tables.offsets.get(&entry)?;
        Some([x, y, *self.world.tables.lengths.get(&entry)?])
    }

    /// The same along one axis of the tool in the spindle. In the plain world, what nobody has said is zero.
    pub(super) fn stated_offset(&self, axis: usize) -> Option<Nanos> {
        let entry = u32::try_from(self.state.tool).ok().filter(|tool| *tool != 0)?;
        match axis {
            Z => self.world.tables.lengths.get(&entry).copied(),
            side => self.world.tables.offsets.get(&entry).and_then(|offsets| offsets.get(side)).copied(),
        }
    }

    /// A length is activated by its place in the tables; of one by which the operator has set the zero of Z, the radius
    /// alone counts.
    pub(super) fn call_up_zeroed(&mut self, length: Length, span: Span) -> Result<(), Diagnostic> {
        let counts = self.as_zeroed(length);
        self.zeroed = (counts != length).then_some(length);
        self.call_up(counts, span)
    }

    /// The length that is activated, whether it counts along Z or not: its place has the radius.
    pub(super) fn length_in_force(&self) -> Length {
        match self.waiting.unwrap_or(self.modes.length) {
            Length::Entry(0) => self.zeroed.unwrap_or(Length::Entry(0)),
            length => length,
        }
    }

    /// A length is activated, which the next Z applies; offsets along X and Y count at once.
    pub(super) fn call_up(&mut self, length: Length, span: Span) -> Result<(), Diagnostic> {
        let aside = match length {
            Length::Entry(entry) => self.world.tool_offsets(entry),
            Length::Edge(..) | Length::Value(_) => [0; 2],
        };
        self.said |= super::LENGTH;
        self.call_up_along();
        self.waiting = Some(length);
        self.called_in_block(span);
        self.use_aside(aside, span)
    }

    /// Offsets along X and Y count from here on.
    pub(super) fn use_aside(&mut self, aside: [Nanos; 2], span: Span) -> Result<(), Diagnostic> {
        if aside == self.aside {
            return Ok(());
        }
        if self.cycle.is_some() || self.contour.watched || self.corner.is_some() || self.is_tilted() {
            return self.not_executed(ToolUnexecuted::OffsetInCycle, span);
        }
        let here = self.machine();
        self.aside = aside;
        self.reframe(here);
        Ok(())
    }

    /// Offsets that are stated along X, Y and Z, or added to the active ones.
    pub(super) fn offsets_of(
        &self,
        words: &[Option<Expr>; AXES],
        added: bool,
        span: Span,
    ) -> Result<[Nanos; 3], Diagnostic> {
        let mut offsets = self.called_up();
        for (offset, word) in offsets.iter_mut().zip(words) {
            let Some(word) = word else { continue };
            let value = self.value(word, span)?;
            *offset = if added { offset.wrapping_add(value) } else { value };
        }
        Ok(offsets)
    }

    /// Puts a value into the table.
    pub(super) fn set_tool(
        &mut self,
        entry: u32,
        which: ToolValue,
        [added, kept]: [bool; 2],
        value: Nanos,
        span: Span,
    ) -> Result<Stored, Diagnostic> {
        let number = self.world.entry_number(entry);
        if entry == 0 {
            return self.fault(Fault::OutOfRange { word: "entry".into() }, span);
        }
        // A radius takes effect with its edge.
        let edge = is_edge_of(entry, self.waiting.unwrap_or(self.modes.length));
        if edge && matches!(which, ToolValue::Radius | ToolValue::RadiusWear) {
            self.not_executed(ToolUnexecuted::RadiusInUse, span)?;
        }
        if which.is_offset() {
            self.hold_entry(entry, kept, span)?;
        }
        Ok(match which {
            ToolValue::Length | ToolValue::LengthWear => {
                Stored::Length(number, self.set_length(entry, which, added, value))
            }
            ToolValue::OffsetX | ToolValue::OffsetY => {
                let side = usize::from(which == ToolValue::OffsetY);
                let mut offsets = self.world.tool_offsets(entry);
                offsets[side] = if added { offsets[side].wrapping_add(value) } else { value };
                self.world.tables.offsets.insert(entry, offsets);
                Stored::Value(number, which, false, offsets[side])
            }
            ToolValue::Radius | ToolValue::RadiusWear => {
                self.world.tables.set_radius(entry, which, added, value);
                Stored::Value(number, which, added, value)
            }
        })
    }

    /// What is active of an entry stays as it is. An entry that another has replaced, or a cancellation, is active no
    /// more, whether Z has been commanded since or not.
    fn hold_entry(&mut self, entry: u32, kept: bool, span: Span) -> Result<(), Diagnostic> {
        let counts = |length: Length| length == Length::Entry(entry) || is_edge_of(entry, length);
        let length = Length::Value(self.world.tool_length(entry));
        if !kept && counts(self.waiting.unwrap_or(self.modes.length)) {
            return self.not_executed(ToolUnexecuted::LengthInUse, span);
        }
        if counts(self.modes.length) {
            self.modes.length = length;
        }
        self.waiting = self.waiting.map(|waiting| if counts(waiting) { length } else { waiting });
        Ok(())
    }

    /// Sets offsets of an entry so that, activated, they make the words the coordinates of where the axes stand: active,
    /// or in a work offset without the G92 shift. An axis without a word keeps its offset, as it is
    /// along that axis of the work offset.
    ///
    /// # Errors
    /// The program has turned or scaled its frames itself, or points are those of the tool tip.
    pub(super) fn measure_tool(
        &mut self,
        entry: u32,
        offset: Option<u16>,
        words: &[Option<Expr>; AXES],
        span: Span,
        out: &mut Vec<Event>,
    ) -> Result<(), Diagnostic> {
        if self.is_tilted() || self.contour.watched || self.turns_frames() {
            return self.not_executed(ToolUnexecuted::MeasuredInFrame, span);
        }
        if entry == 0 {
            return self.fault(Fault::OutOfRange { word: "entry".into() }, span);
        }
        self.hold_entry(entry, true, span)?;
        let here = self.machine();
        let tool = self.tool_offset();
        let bare = std::array::from_fn(|axis| here[axis].wrapping_add(tool[axis]));
        let (number, place) = match offset {
            // Where the axes stand without the tool's offsets, in the active coordinates.
            None => (self.modes.work_offset, self.unplace(&bare)),
            Some(number) => {
                let zero = self.world.work_offset(number);
                let external = self.external();
                let from: [Nanos; AXES] = std::array::from_fn(|axis| {
                    here[axis].wrapping_sub(zero[axis]).wrapping_sub(external[axis])
                });
                (number, crate::frames::frame::turned(&from, self.world.work_turn(number).wrapping_neg()))
            }
        };
        let turn = self.world.work_turn(number);
        let [x, y] = self.world.tool_offsets(entry);
        let mut along = crate::frames::frame::turned(&[x, y, 0, 0, 0, 0], turn.wrapping_neg());
        for axis in 0..2 {
            if let Some(word) = &words[axis] {
                along[axis] = place[axis].wrapping_sub(self.value(word, span)?);
            }
        }
        let aside = crate::frames::frame::turned(&along, turn);
        if words[..2].iter().any(Option::is_some) {
            self.world.tables.offsets.insert(entry, [aside[0], aside[1]]);
            let entry = self.world.entry_number(entry);
            for (which, value) in [(ToolValue::OffsetX, aside[0]), (ToolValue::OffsetY, aside[1])] {
                self.emit(Kind::Data(Box::new(Stored::Value(entry, which, false, value))), span, out)?;
            }
        }
        if let Some(word) = &words[Z] {
            let value = place[Z].wrapping_sub(self.value(word, span)?);
            let value = value.wrapping_sub(self.world.length_wear(entry));
            let length = self.set_length(entry, ToolValue::Length, false, value);
            let entry = self.world.entry_number(entry);
            self.emit(Kind::Data(Box::new(Stored::Length(entry, length))), span, out)?;
        }
        Ok(())
    }

    /// Puts a length into the table; the length that counts, wear included.
    fn set_length(&mut self, entry: u32, which: ToolValue, added: bool, value: Nanos) -> Nanos {
        let before = self.world.tool_length(entry);
        let wear = self.world.length_wear(entry);
        let new_wear = match (which, added) {
            (ToolValue::LengthWear, true) => wear.wrapping_add(value),
            (ToolValue::LengthWear, false) => value,
            (_, _) => wear,
        };
        let bare = match (which, added) {
            (ToolValue::Length, true) => before.wrapping_sub(wear).wrapping_add(value),
            (ToolValue::Length, false) => value,
            (_, _) => before.wrapping_sub(wear),
        };
        let length = bare.wrapping_add(new_wear);
        self.world.tables.lengths.insert(entry, length);
        self.world.tables.wears.insert(entry, new_wear);
        length
    }
}

/// Whether a length is of the first edge of the tool with an entry's number, or of one that is not known.
fn is_edge_of(entry: u32, length: Length) -> bool {
    match length {
        Length::Edge(tool, edge) => tool < 0 || edge == 1 && tool == i64::from(entry),
        _ => false,
    }
}
