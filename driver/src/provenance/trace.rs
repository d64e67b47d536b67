//! The record of a translation: for every line of the output's body the places of the source that it was
//! written from and the events that the verification has paired in it.
//!
//! A line waits until nothing further can happen in it, then goes to the [`Written`]. In a program that
//! streams, that is as soon as its events have met those of the source; one that is kept whole waits for
//! the end of its execution.

use std::collections::VecDeque;
use std::io;

use ncc_backends::Origin;
use ncc_exec::Kind;
use ncc_exec::verify::Pair;
use ncc_ir::source::Span;

use super::spool::{Row, Stretch, Written};
use crate::problem::BrokenOff;

/// What is asked of a translation besides its text.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Asked {
    /// The map.
    pub map: bool,
    /// The source's lines as comments.
    pub annotate: bool,
}

impl Asked {
    /// Whether anything is.
    pub fn anything(self) -> bool {
        self.map || self.annotate
    }
}

/// Stretches of events of one line that are kept; of a line executed more often than that, the others
/// are counted.
const MOST_STRETCHES: usize = 1000;

/// Places of events of one line that are kept, besides those that it was written from.
const MOST_PLACES: usize = 1000;

/// Names of the kinds of events, as NIST has them; a set of them is a number with a bit for each.
pub const KINDS: [&str; 21] = [
    "STRAIGHT_TRAVERSE",
    "STRAIGHT_FEED",
    "ARC_FEED",
    "DWELL",
    "CHANGE_TOOL",
    "COOLANT",
    "MACHINE_FUNCTION",
    "PROGRAM_STOP",
    "OPTIONAL_PROGRAM_STOP",
    "PROGRAM_END",
    "TEXT_END",
    "MESSAGE",
    "SYNCHRONISED_FEED",
    "ORIENT_SPINDLE",
    "SET_DATA",
    "SET_TILT",
    "ORIENT_TOOL_AXIS",
    "STRAIGHT_PROBE",
    "ALARM",
    "OUTPUT",
    "BEGIN_AGAIN",
];

/// A kind's place in [`KINDS`]; `None` is no event of a comparison.
fn place_of(kind: &Kind) -> Option<u8> {
    Some(match kind {
        Kind::Traverse => 0,
        Kind::Feed => 1,
        Kind::Arc { .. } => 2,
        Kind::Dwell(_) => 3,
        Kind::ToolChange => 4,
        Kind::Coolant => 5,
        Kind::MachineFunction(_) => 6,
        Kind::ProgramStop => 7,
        Kind::OptionalProgramStop => 8,
        Kind::ProgramEnd => 9,
        Kind::TextEnd => 10,
        Kind::Message(_) => 11,
        Kind::Synchronised { .. } => 12,
        Kind::Orient(_) => 13,
        Kind::Data(_) => 14,
        Kind::Tilt(_) => 15,
        Kind::OrientToolAxis(_) => 16,
        Kind::Probe { .. } => 17,
        Kind::Alarm(..) => 18,
        Kind::Output(_) => 19,
        Kind::BeginAgain => 20,
        Kind::Attribute(_) => return None,
    })
}

/// The record while it is made.
#[derive(Debug)]
pub struct Trace {
    /// Lines that wait, the first of them at `first`.
    waiting: VecDeque<Waiting>,
    /// The one of them in which an event was noted last.
    near: usize,
    /// Places of lines that are not there yet: a text may be handed over with its last line open.
    origins: VecDeque<Origin>,
    /// Events of the line that is still open: their number, kind and place in the source.
    ahead: Vec<(u64, u32, Span)>,
    /// Where the open line begins in the body.
    open: u64,
    /// Bytes of the body so far.
    bytes: u64,
    /// Events so far.
    events: u64,
    /// The end of the text is an event of no line.
    pub text_end: Option<u64>,
    spool: Written,
    /// Rows that were written: their memory serves the next ones.
    spare: Vec<Row>,
}

#[derive(Debug)]
struct Waiting {
    start: u64,
    row: Row,
}

impl Trace {
    pub(crate) fn new() -> Trace {
        Trace {
            waiting: VecDeque::new(),
            near: 0,
            origins: VecDeque::new(),
            ahead: Vec::new(),
            open: 0,
            bytes: 0,
            events: 0,
            text_end: None,
            spool: Written::new(),
            spare: Vec::new(),
        }
    }

    /// Further text of the body, and where its lines come from.
    ///
    /// # Errors
    /// The body is longer than places in it can be stored.
    pub fn text(&mut self, text: &[u8], origins: Vec<Origin>) -> io::Result<()> {
        self.origins.extend(origins);
        for end in memchr::memchr_iter(b'\n', text) {
            let start = self.open;
            self.open = self.bytes + end as u64 + 1;
            self.line(start);
        }
        self.bytes += text.len() as u64;
        match u32::try_from(self.bytes) {
            Ok(_) => Ok(()),
            Err(_) => Err(io::Error::new(io::ErrorKind::FileTooLarge, BrokenOff::LongMap)),
        }
    }

    /// A line is there, with the events that came before its end.
    fn line(&mut self, start: u64) {
        let mut row = self.spare.pop().unwrap_or_default();
        row.spans = self.next_origin();
        for (event, kind, place) in self.ahead.drain(..) {
            row.add(event, kind, place);
        }
        self.waiting.push_back(Waiting { start, row });
    }

    fn next_origin(&mut self) -> Vec<Span> {
        let Some(origin) = self.origins.front_mut() else { return Vec::new() };
        origin.lines = origin.lines.saturating_sub(1);
        if origin.lines > 0 {
            return origin.spans.clone();
        }
        self.origins.pop_front().map(|origin| origin.spans).unwrap_or_default()
    }

    /// Pairs of events that the verification has found, in their order.
    pub fn pairs(&mut self, pairs: &[Pair]) {
        for pair in pairs {
            let Some(kind) = place_of(&pair.kind) else { continue };
            let event = self.events;
            self.events += 1;
            if matches!(pair.kind, Kind::TextEnd) {
                self.text_end = Some(event);
                continue;
            }
            let at = u64::from(pair.target.start);
            if at >= self.open {
                self.ahead.push((event, 1 << kind, pair.source));
                continue;
            }
            let Some(line) = self.line_at(at).and_then(|line| self.waiting.get_mut(line)) else { continue };
            line.row.add(event, 1 << kind, pair.source);
        }
    }

    /// Which of the lines that wait holds a place.
    fn line_at(&mut self, place: u64) -> Option<usize> {
        let starts = |line: usize| self.waiting.get(line).map(|line| line.start);
        // Most pairs come in the order of the lines.
        let holds = |line: &usize| {
            starts(*line).is_some_and(|start| start <= place)
                && starts(line + 1).is_none_or(|next| place < next)
        };
        let found = [self.near, self.near + 1].into_iter().find(holds);
        let searched = || self.waiting.partition_point(|line| line.start <= place).checked_sub(1);
        let line = found.or_else(searched)?;
        self.near = line;
        Some(line)
    }

    /// Closes the rows of lines that end before this place of the body: no further events come before it.
    ///
    /// # Errors
    /// The temporary file cannot be written.
    pub fn close_rows_before(&mut self, place: u64) -> io::Result<()> {
        // A line is over where the next one begins.
        while self.waiting.get(1).map_or(self.open, |next| next.start) <= place {
            let Some(Waiting { mut row, .. }) = self.waiting.pop_front() else { break };
            self.near = self.near.saturating_sub(1);
            self.spool.push(&row)?;
            row.clear();
            self.spare.push(row);
        }
        Ok(())
    }

    /// The body's length so far.
    pub fn bytes(&self) -> u64 {
        self.bytes
    }

    /// All rows, once the body is whole.
    ///
    /// # Errors
    /// The temporary file cannot be written.
    pub fn finish(mut self) -> io::Result<Recorded> {
        if self.open < self.bytes {
            // A last line without its end.
            self.line(self.open);
        }
        for line in std::mem::take(&mut self.waiting) {
            self.spool.push(&line.row)?;
        }
        Ok(Recorded { rows: self.spool, events: self.events, text_end: self.text_end })
    }
}

impl Row {
    fn clear(&mut self) {
        self.spans.clear();
        self.also.clear();
        self.stretches.clear();
        self.more = 0;
    }

    fn add(&mut self, event: u64, kind: u32, place: Span) {
        let own = |span: &Span| span.start < place.end && place.start < span.end;
        if place.start < place.end
            && !self.spans.iter().any(own)
            && self.also.last() != Some(&place)
            && self.also.len() < MOST_PLACES
            && !self.also.contains(&place)
        {
            self.also.push(place);
        }
        let full = self.stretches.len() >= MOST_STRETCHES;
        match self.stretches.last_mut() {
            Some(stretch) if stretch.last + 1 == event && self.more == 0 => {
                stretch.last = event;
                stretch.kinds |= kind;
            }
            Some(_) if full => self.more += 1,
            Some(_) | None => self.stretches.push(Stretch { first: event, last: event, kinds: kind }),
        }
    }
}

/// The record of a whole output.
#[derive(Debug)]
pub struct Recorded {
    /// A row for each line of the body.
    pub rows: Written,
    /// How many events source and output have.
    pub events: u64,
    /// The event of a text that ends without saying so.
    pub text_end: Option<u64>,
}
