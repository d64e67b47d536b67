//! One canonical function with its place, before it has a time.

use ncc_ir::canon::AXES;
use ncc_ir::exec::{Event, Exec};
use ncc_ir::num::Nanos;
use ncc_ir::source::Span;

/// Where in the source a function comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Line, the first is 1; 0 if not known.
    pub line: u32,
    /// Bytes of the block.
    pub span: Span,
}

/// A canonical function that the machine carries out.
#[derive(Clone, Debug, PartialEq)]
pub struct Act {
    /// What it is; its end is in machine coordinates.
    pub event: Event,
    /// Where the axes stand before it, machine coordinates in nanos of a millimetre or degree.
    pub from: [Nanos; AXES],
    /// Where they stand before it, in the coordinates that the program speaks in when it is over.
    pub program_from: [Nanos; AXES],
    /// Where they stand after it, in the program's coordinates.
    pub program_to: [Nanos; AXES],
    /// Entry of the tool-length table in force; `None` where it is an edge of a tool.
    pub cut_offset: Option<u32>,
    /// Where it comes from.
    pub place: Place,
}

impl Act {
    /// Of an event that a control has just made; `from` is where the axes stood before it.
    pub fn of(event: Event, from: [Nanos; AXES], exec: &Exec, place: Place) -> Act {
        Act {
            program_from: exec.in_program(&from),
            program_to: exec.in_program(&event.end),
            cut_offset: exec.length_entry(),
            from,
            event,
            place,
        }
    }
}
