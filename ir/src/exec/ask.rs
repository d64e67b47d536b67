//! What a control can be asked between two statements, in the program's own terms.
//!
//! For those who tell what happens (tables, time). Nothing here changes anything.

use super::frame::Chain;
use super::holes::InForce;
use super::{Exec, Length, State};
use crate::canon::{AXES, Distance, Motion, Plane};
use crate::expr::Expr;
use crate::num::Nanos;
use crate::program::Coord;
use crate::source::Span;

impl Exec {
    /// A point of the machine in the program's coordinates, as the frames are now.
    pub fn in_program(&self, machine: &[Nanos; AXES]) -> [Nanos; AXES] {
        self.unplace(machine)
    }

    /// Entry of the tool-length table in force; `None` is an edge of a tool.
    pub fn length_entry(&self) -> Option<u32> {
        match self.waiting.unwrap_or(self.modes.length) {
            Length::Entry(entry) => Some(entry),
            Length::Edge(..) | Length::Value(_) | Length::Left => None,
        }
    }

    /// Tool and edge whose length is in force, where that is no entry of the tool-length table; the tool
    /// is -1 where none was named.
    pub fn length_edge(&self) -> Option<(i64, u32)> {
        match self.waiting.unwrap_or(self.modes.length) {
            Length::Entry(_) | Length::Value(_) | Length::Left => None,
            Length::Edge(tool, edge) => Some((tool, edge)),
        }
    }

    /// Work offset in force, whoever named it; 1 is the first.
    pub fn offset_in_force(&self) -> u16 {
        self.modes.work_offset
    }

    /// Position in the coordinates that the program speaks in, nanos of a millimetre or degree.
    pub fn position(&self) -> [Nanos; AXES] {
        self.position
    }

    /// A literal in nanos of a millimetre, a degree or a second, as units are in force; `None` is
    /// what is not known without execution.
    pub fn nanos(&self, value: &Expr) -> Option<Nanos> {
        self.value(value, Span::default()).ok()
    }

    /// Where a word puts an axis that stands at `from`, in the program's coordinates.
    pub fn word(&self, word: &Coord, from: Nanos) -> Option<Nanos> {
        self.target(word, from, Span::default()).ok()
    }

    /// Plane of the cycle in force, its retract plane and the bottom of its holes, in the program's
    /// coordinates.
    pub fn cycle_levels(&self) -> Option<(Plane, Nanos, Nanos)> {
        self.cycle.as_ref().map(InForce::levels)
    }

    /// Feed in force, mm/min in nanos; 0 where none was said.
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

    /// Whether points are those of the tool's tip, or of a tilted plane: where the linear axes then are,
    /// the machine alone knows.
    pub fn is_tilted(&self) -> bool {
        self.state.tip || self.state.tilted
    }

    /// Plane of arcs and hole positions in force.
    pub fn plane(&self) -> Plane {
        self.modes.plane
    }
}
