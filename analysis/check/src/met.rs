//! What each rule remembers of the program so far.

use std::collections::VecDeque;

use ncc_ir::canon::AXES;
use ncc_ir::expr::num::{Nanos, Num};
use ncc_ir::source::Span;

use crate::limits::Unchecked;

/// Findings by axis and side, and what was noted as not checked.
#[derive(Debug, Default)]
pub(crate) struct TravelMet {
    pub(crate) at: [[Option<usize>; 2]; AXES],
    /// The last reason of each axis.
    pub(crate) noted: [Option<Unchecked>; AXES],
}

/// Findings by axis, and the feed of moves without one.
#[derive(Debug, Default)]
pub(crate) struct FeedMet {
    pub(crate) axes: [Option<usize>; AXES],
    /// Whether the active feed is made up by the check.
    pub(crate) made_up: bool,
}

/// What the rules of the spindle remember.
#[derive(Debug, Default)]
pub(crate) struct SpindleMet {
    /// Whether NC0805 has been reported since the spindle was last switched.
    pub(crate) reported: bool,
    /// Where a feed move with a stopped spindle has been reported.
    pub(crate) stopped_at: Option<Span>,
    /// Whether the tool in it probes.
    pub(crate) probes: bool,
    /// The block that stopped it.
    pub(crate) stop: Option<Span>,
}

impl SpindleMet {
    /// The program has stopped it in a block.
    pub(crate) fn stopped(block: Span) -> SpindleMet {
        SpindleMet { stop: Some(block), ..SpindleMet::default() }
    }

    /// Another speed or tool: a stopped spindle still stands.
    pub(crate) fn renewed(&self) -> SpindleMet {
        SpindleMet { stop: self.stop, ..SpindleMet::default() }
    }

    /// The program has stopped it at an angle.
    pub(crate) fn held() -> SpindleMet {
        SpindleMet { reported: true, ..SpindleMet::default() }
    }
}

/// Pitches of no standard since the last tool change: the pitch, its last place, and its finding.
#[derive(Debug, Default)]
pub(crate) struct ThreadMet {
    pub(crate) reported: Vec<(Nanos, [Nanos; AXES], usize)>,
}

/// Numbers that were met.
#[derive(Debug, Default)]
pub(crate) struct PointsMet {
    pub(crate) bare: Vec<(Span, Num, Num)>,
    /// How many more there are.
    pub(crate) more: usize,
    pub(crate) last: VecDeque<Span>,
    /// Whether any length has a point.
    pub(crate) pointed: bool,
}
