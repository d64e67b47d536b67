//! One canonical function with its place, before it has a time.

use ncc_exec::{Event, Exec, Kind};
use ncc_ir::canon::{AXES, FeedMode};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::source::Span;

use crate::path::path;

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
    /// Its feed is one per minute, whatever the program's counts.
    pub fn of(mut event: Event, from: [Nanos; AXES], exec: &Exec, place: Place) -> Act {
        event.rate = per_minute(&event, &from);
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

/// The feed of a move in mm/min: a feed per turn goes with the speed of the spindle, of a surface speed with
/// that in the middle of the way, a time with the length of the way. A spindle that stands leaves a feed per
/// turn as it is.
fn per_minute(event: &Event, from: &[Nanos; AXES]) -> Nanos {
    let state = &event.state;
    let by = match state.feed_mode {
        _ if event.rate == 0 || matches!(event.kind, Kind::Synchronised { .. }) => return event.rate,
        FeedMode::PerMinute => return event.rate,
        FeedMode::PerRevolution => match state.turns(from[0] / 2 + event.end[0] / 2) {
            0 => return event.rate,
            turns => turns as f64 / ONE as f64,
        },
        FeedMode::InverseTime => path(event, from).length,
    };
    // A rate beyond the range of the type is none.
    (event.rate as f64 * by) as Nanos
}
