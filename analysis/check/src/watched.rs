//! The data that all rules of a program share: limits, what the program has done, findings.

use std::collections::BTreeSet;

use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::Stmt;
use ncc_ir::source::Span;

use crate::finding::{Finding, Findings, What};
use crate::limits::{Limits, Unchecked};
use crate::met::{FeedMet, PointsMet, SpindleMet, ThreadMet, TravelMet};
use crate::seen::Seen;

/// The data that the rules share while one program is checked.
#[derive(Debug)]
pub(crate) struct Watched {
    pub(crate) limits: Limits,
    pub(crate) seen: Seen,
    pub(crate) findings: Findings,
    pub(crate) unchecked: BTreeSet<Unchecked>,
    pub(crate) travel: TravelMet,
    pub(crate) feed: FeedMet,
    pub(crate) spindle: SpindleMet,
    pub(crate) thread: ThreadMet,
    pub(crate) points: PointsMet,
    /// Work offset and length that `seen.base` was found out for.
    pub(crate) based: Option<Based>,
    /// Whether the program has cancelled a length offset.
    pub(crate) cancels_length: bool,
}

/// Work offset active, entry of the length table, and edge where the length is no entry.
pub(crate) type Based = (u16, Option<u32>, Option<(i64, u32)>);

/// The statement that a rule looks at, and the state before it.
pub(crate) struct Step<'s> {
    pub(crate) stmt: &'s Stmt,
    /// Positions of the axes before the statement: program coordinates, nanos of a millimetre or of a degree.
    pub(crate) from: [Nanos; AXES],
    /// Axes whose position was known.
    pub(crate) from_known: [bool; AXES],
    /// Whether its words are machine coordinates.
    pub(crate) raw: bool,
    /// Whether points were those of the tool tip, or of a tilted plane.
    pub(crate) tilted: bool,
}

impl Watched {
    /// Nothing has been seen yet.
    pub(crate) fn new(limits: Limits, unchecked: BTreeSet<Unchecked>) -> Watched {
        Watched {
            limits,
            seen: Seen::default(),
            findings: Findings::default(),
            unchecked,
            travel: TravelMet::default(),
            feed: FeedMet::default(),
            spindle: SpindleMet::default(),
            thread: ThreadMet::default(),
            points: PointsMet::default(),
            based: None,
            cancels_length: false,
        }
    }

    /// Why the place of an axis is not known in machine coordinates.
    pub(crate) fn why_unknown(&self, axis: usize) -> Unchecked {
        let (offset, entry, edge) = self.based.unwrap_or((0, None, None));
        let row = self.limits.tables.work_offsets.get(&offset);
        if self.seen.frame_lost {
            Unchecked::Frame(axis as u8)
        } else if row.is_none_or(|row| row[axis].is_none()) {
            Unchecked::Offset(offset, axis as u8)
        } else if !self.seen.base[axis] {
            let tool = edge.map(|(tool, _)| tool);
            Unchecked::Length(entry.map(i64::from).or(tool).unwrap_or(-1))
        } else {
            Unchecked::Start(axis as u8)
        }
    }

    pub(crate) fn find(&mut self, what: What, span: Span) -> Option<usize> {
        self.findings.add(Finding::new(what, span))
    }
}
