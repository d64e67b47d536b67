//! A canonical function with its position and place, before it has a time.

use ncc_exec::{Event, Exec, Kind};
use ncc_ir::canon::{AXES, FeedMode};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::source::Span;

use crate::path::path;

/// The place of a function in the source.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Line number from 1; 0 if unknown.
    pub line: u32,
    /// Span of the block.
    pub span: Span,
}

/// A canonical function that the machine carries out.
#[derive(Clone, Debug, PartialEq)]
pub struct Act {
    /// The event; its end point is in machine coordinates.
    pub event: Event,
    /// Position before it, in machine coordinates: nanos of a millimetre or degree.
    pub from: [Nanos; AXES],
    /// Position before it, in the program coordinates that are active after it.
    pub program_from: [Nanos; AXES],
    /// Position after it, in program coordinates.
    pub program_to: [Nanos; AXES],
    /// Active entry of the tool-length table; `None` for a tool edge.
    pub cut_offset: Option<u32>,
    /// Its place in the source.
    pub place: Place,
}

impl Act {
    /// An act from an event of `exec`; `from` is the position before it. Its feed becomes a feed per minute,
    /// whatever the program's feed mode.
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

/// The feed of a move in mm/min. Feed per revolution is multiplied by the spindle speed; under constant
/// surface speed, by the speed at the middle of the move. Inverse-time feed is multiplied by the length of
/// the move. With the spindle stopped, a feed per revolution stays as it is.
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
    // A rate beyond the range of `Nanos` saturates.
    (event.rate as f64 * by) as Nanos
}
