//! What a control can be asked between two statements, in the program's own terms.
//!
//! For those who tell what happens (tables, time). Nothing here changes anything.

use super::{Exec, Length, SHIFT_STORED, SHIFT_TAKEN_UP, State};
use crate::frames::chain::Chain;
use crate::moves::holes::ActiveCycle;
use ncc_ir::canon::{AXES, Axis, Distance, FeedMode, Motion, Plane, Spindle, SpindleMode, Turn, Units};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::expr::system::System;
use ncc_ir::program::{Coord, ToolValue};
use ncc_ir::source::Span;

impl Exec {
    /// Whether cutter radius compensation is on, or the move that leaves the contour has not come yet.
    pub fn is_on_contour(&self) -> bool {
        self.contour.watched
    }

    /// A reference point in the program's coordinates, as the frames are now.
    pub fn in_program(&self, machine: &[Nanos; AXES]) -> [Nanos; AXES] {
        self.unplace(machine)
    }

    /// What the tool adds to where its tip is, for where the machine is: X Y Z in nanos of a millimetre.
    pub fn tool_adds(&self) -> [Nanos; 3] {
        let [x, y, z, ..] = self.tool_offset();
        [x, y, z]
    }

    /// Entry of the tool-length table active; `None` is an edge of a tool.
    pub fn length_entry(&self) -> Option<u32> {
        match self.waiting.unwrap_or(self.modes.length) {
            Length::Entry(entry) => Some(entry),
            Length::Edge(..) | Length::Value(_) => None,
        }
    }

    /// Tool and edge whose length is active, where that is no entry of the tool-length table; the tool
    /// is -1 where none was named.
    pub fn length_edge(&self) -> Option<(i64, u32)> {
        match self.waiting.unwrap_or(self.modes.length) {
            Length::Entry(_) | Length::Value(_) => None,
            Length::Edge(tool, edge) => Some((tool, edge)),
        }
    }

    /// Work offset active, whoever named it; 1 is the first.
    pub fn offset_in_force(&self) -> u16 {
        self.modes.work_offset
    }

    /// Position in the coordinates that the program speaks in, nanos of a millimetre or degree.
    pub fn position(&self) -> [Nanos; AXES] {
        self.position
    }

    /// A literal in nanos of a millimetre, a degree or a second, as units are active; `None` is
    /// what is not known without execution.
    pub fn nanos(&self, value: &Expr) -> Option<Nanos> {
        self.value(value, Span::default()).ok()
    }

    /// Where a word puts an axis that stands at `from`, in the program's coordinates.
    pub fn word(&self, word: &Coord, from: Nanos) -> Option<Nanos> {
        self.target(word, from, Span::default()).ok()
    }

    /// Plane of the active cycle, its retract plane and the bottom of its holes, in the program's
    /// coordinates.
    pub fn cycle_levels(&self) -> Option<(Plane, Nanos, Nanos)> {
        self.cycle.as_ref().map(ActiveCycle::levels)
    }

    /// Feed active, mm/min in nanos; 0 where none was stated.
    pub fn feed(&self) -> Nanos {
        self.feed
    }

    /// What is on.
    pub fn state(&self) -> State {
        self.state
    }

    /// From where words without a distance of their own are measured.
    pub fn distance(&self) -> Distance {
        self.modes.distance
    }

    /// Motion that axis words alone do.
    pub fn motion(&self) -> Motion {
        self.modes.motion
    }

    /// Whether frames are chained between the program and its work offset.
    pub fn has_frames(&self) -> bool {
        self.chain.is_some() || self.state.tilted
    }

    /// Whether any of them is the program's: a work offset may be turned by itself.
    pub fn has_program_frames(&self) -> bool {
        match self.offset_turned {
            true => {
                self.slots.as_ref().is_some_and(|slots| slots.chain() != Chain::NONE) || self.state.tilted
            }
            false => self.has_frames(),
        }
    }

    /// Whether points are those of the tool tip, or of a tilted plane: where the linear axes then are,
    /// the machine alone knows.
    pub fn is_tilted(&self) -> bool {
        self.state.tip || self.state.tilted
    }

    /// Plane of arcs and hole positions active.
    pub fn plane(&self) -> Plane {
        self.modes.plane
    }

    /// What the program gets that asks for a value of the control's own; `None` is what is not known here, or not
    /// the same on every control at this place: where the tool is beside a contour or at a corner that is not
    /// made yet, or along Z while a length waits to take effect; a feed that was stated in the other unit.
    pub fn answer(&self, asked: &System) -> Option<f64> {
        let holds = |holds: bool| Some(f64::from(u8::from(holds)));
        match asked {
            System::EndPoint(axis) => {
                let at = *axis as usize;
                let settled = self.stands() && !(at == self.along && self.waiting.is_some());
                settled.then(|| self.counted(self.position[at], *axis, None))
            }
            System::TouchPoint(axis) => {
                let [touched, _] = &**self.touched.as_ref()?;
                (!self.is_tilted()).then(|| self.counted(touched[*axis as usize], *axis, None))
            }
            System::TouchWithOffsets(axis) => {
                let [touched, offsets] = &**self.touched.as_ref()?;
                let at = touched[*axis as usize].checked_add(offsets[*axis as usize])?;
                let plain = !self.is_tilted() && !self.has_program_frames();
                plain.then(|| self.counted(at, *axis, None))
            }
            System::SpindlePoint(axis) => {
                let at = *axis as usize;
                let plain = self.stands() && !self.has_program_frames();
                let settled = plain && !(at == self.along && self.waiting.is_some());
                let above = self.position[at].checked_add(self.tool_offset()[at])?;
                settled.then(|| self.counted(above, *axis, None))
            }
            System::MachinePoint(axis) => {
                self.stands().then(|| self.counted(self.machine()[*axis as usize], *axis, None))
            }
            System::WorkOffset { number, axis, unit } => {
                Some(self.counted(self.world.work_offset(*number)[*axis as usize], *axis, *unit))
            }
            System::ExternalOffset(axis) => {
                // A control may count a shift of the program's own among it.
                let own = self.slots.is_some() || self.modes.shifted || self.has_program_frames();
                (!own).then(|| self.counted(self.external()[*axis as usize], *axis, None))
            }
            System::WorkTurn(number) => Some(self.counted(self.world.work_turn(*number), Axis::C, None)),
            System::WorkOffsetNumber => Some(f64::from(self.modes.work_offset)),
            System::OriginShift { axis, unit } => {
                let kept = self.kept_shift(*axis as usize)?;
                Some(self.counted(kept, *axis, *unit))
            }
            System::OriginShifted => {
                holds(self.modes.shifted || self.said & SHIFT_TAKEN_UP != 0 || self.is_shifted())
            }
            System::ToolLength if self.waiting.is_some() => None,
            System::ToolLength => Some(self.counted(self.length_of(self.modes.length), Axis::Z, None)),
            System::TableOffset { axis, unit } => {
                let stated = self.stated_offset(*axis as usize)?;
                Some(self.counted(stated, *axis, *unit))
            }
            System::TableDiameter { unit } => {
                let tool = u32::try_from(self.state.tool).ok()?;
                let radius = self.world.tool_radius(tool)?;
                Some(self.counted(radius.checked_mul(2)?, Axis::X, *unit))
            }
            System::ToolTable { value, entry } => {
                let (entry, wear) = (u32::from(*entry), self.world.length_wear(u32::from(*entry)));
                let worth = match value {
                    ToolValue::Length => self.world.tool_length(entry).checked_sub(wear)?,
                    ToolValue::LengthWear => wear,
                    ToolValue::Radius | ToolValue::RadiusWear | ToolValue::OffsetX | ToolValue::OffsetY => {
                        return None;
                    }
                };
                Some(self.counted(worth, Axis::Z, None))
            }
            System::LengthEntry => match self.waiting.unwrap_or(self.modes.length) {
                Length::Entry(entry) if entry > 0 => Some(f64::from(self.world.entry_number(entry))),
                Length::Entry(_) | Length::Edge(..) | Length::Value(_) => None,
            },
            System::FirstWorkOffset => {
                let number = self.modes.work_offset;
                (1..=6).contains(&number).then_some(f64::from(number))
            }
            System::Kept(what, of) => Some(f64::from(self.world.kept(*what, *of))),
            System::Tool => (self.state.tool >= 0).then_some(self.state.tool as f64),
            System::SelectedTool => (self.selected >= 0).then_some(self.selected as f64),
            System::Feed if self.state.feed_mode == FeedMode::InverseTime => None,
            System::Feed => {
                (self.feed_inch == Some(self.modes.inch)).then(|| self.counted(self.feed, Axis::X, None))
            }
            System::Speed if self.state.spindle_mode == SpindleMode::Surface => None,
            System::Speed => Some(self.state.speed as f64 / ONE as f64),
            System::Units(units) => holds((*units == Units::Inch) == self.modes.inch),
            System::Distance(distance) => holds(*distance == self.modes.distance),
            System::Plane(plane) => holds(*plane == self.modes.plane),
            System::FeedMode(mode) => holds(*mode == self.state.feed_mode),
            System::ReturnLevel(level) => holds(*level == self.modes.return_level),
            System::Motion(motion) => match self.modes.motion {
                own @ (Motion::Traverse | Motion::Feed) => holds(*motion == own),
                Motion::Arc(_) | Motion::Cycle => None,
            },
            System::Turning(turn) => holds(
                self.state.spindle
                    == match turn {
                        Turn::Clockwise => Spindle::Clockwise,
                        Turn::Counterclockwise => Spindle::Counterclockwise,
                    },
            ),
            System::SurfaceSpeed => holds(self.state.spindle_mode == SpindleMode::Surface),
            System::Flood => holds(self.state.flood),
            System::Mist => holds(self.state.mist),
            System::Other(_) => None,
        }
    }

    /// Whether the tool stands where the last move has said.
    fn stands(&self) -> bool {
        !self.contour.watched && self.corner.is_none() && !self.is_tilted()
    }

    /// A length in the active unit, or in another; an angle in degrees.
    fn counted(&self, nanos: Nanos, axis: Axis, unit: Option<Units>) -> f64 {
        let inch = unit.map_or(self.modes.inch, |unit| unit == Units::Inch);
        let one = if inch && !axis.is_rotary() { 25.4 * ONE as f64 } else { ONE as f64 };
        nanos as f64 / one
    }

    /// The number kept of the G92 shift along an axis; `None` where an earlier program may have left it.
    fn kept_shift(&self, axis: usize) -> Option<Nanos> {
        if self.said & SHIFT_STORED == 0 && self.world.seed != 0 {
            return None;
        }
        let kept = self.slots.as_ref().and_then(|slots| slots.suspended_shift(axis));
        Some(kept.unwrap_or_else(|| self.origin_shift()[axis]))
    }

    fn is_shifted(&self) -> bool {
        self.slots.as_ref().is_some_and(|slots| slots.origin.iter().any(Option::is_some))
    }
}
