//! An event kept small: where the machine stands after it, what it is, and with what it is done.
//!
//! A program is executed in several worlds at once. The first is plain, so that its coordinates are the
//! program's own: they are kept. Of the others only the way that their coordinates are apart from the
//! plain ones is kept, with everything else that seldom changes, as a [`Style`] that many records share.

use std::collections::HashMap;

use ncc_exec::verify::{Part, part};
use ncc_exec::{Attribute, Compensation, Coolant, Event, Exec, Kind, State};
use ncc_ir::canon::{AXES, Axis, Plane, Turn, same_point};
use ncc_ir::expr::num::Nanos;

/// Generated worlds beside the plain one.
pub const WORLDS: usize = 2;

/// Kinds of records.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[allow(missing_docs)] // As the kinds of events.
pub enum What {
    Traverse,
    Feed,
    Thread,
    Arc,
    Dwell,
    Orient,
    ToolChange,
    Function,
    Stop,
    OptionalStop,
    End,
    BeginAgain,
    TextEnd,
    Message,
    Alarm,
}

impl What {
    /// Whether the tool goes somewhere.
    pub fn moves(self) -> bool {
        matches!(self, What::Traverse | What::Feed | What::Thread | What::Arc)
    }
}

/// One event.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Record {
    /// Where X Y Z stand after it in the plain world, nanos.
    pub end: [Nanos; 3],
    /// Of a straight move, where A B C stand; of an arc, its centre in its plane; of a dwell, its
    /// seconds; of an orientation, its degrees; of a text, its hash and its place in the list of kept events.
    pub more: [Nanos; 3],
    /// Which [`Style`].
    pub style: u32,
    /// First byte of the block that it comes from.
    pub at: u32,
    /// Number of the hole that it belongs to, counted from 1; 0 is none.
    pub hole: u32,
    /// What it is.
    pub what: What,
    /// Of an arc: plane, sense, and whether it is a whole circle; of a thread, whether it has a chuck.
    form: u8,
    /// In which world alone it happens; 0 is in all.
    pub world: u8,
    flags: u8,
}

const INCH: u8 = 1;
const INCREMENTAL: u8 = 2;

// Bits of the form of an arc, behind plane, sense and whether it is whole.
const LITTLE: u8 = 16;
const NEARLY: u8 = 32;

impl Record {
    /// End point of all axes, 10⁻⁹ mm or degrees. The style of an arc holds its rotary axes.
    pub fn place(&self, style: &Style) -> [Nanos; AXES] {
        let [x, y, z] = self.end;
        let [a, b, c] = if self.what == What::Arc || !self.what.moves() { style.turned } else { self.more };
        [x, y, z, a, b, c]
    }

    /// Whether the program was in inches.
    pub fn inch(&self) -> bool {
        self.flags & INCH != 0
    }

    /// Whether its block measures from where the tool is.
    pub fn incremental(&self) -> bool {
        self.flags & INCREMENTAL != 0
    }

    /// Plane, sense, and whether it is a whole circle; of an arc.
    pub fn arc(&self) -> (Plane, Turn, bool) {
        let plane = match self.form & 3 {
            0 => Plane::Xy,
            1 => Plane::Zx,
            _ => Plane::Yz,
        };
        let turn = if self.form & 4 == 0 { Turn::Clockwise } else { Turn::Counterclockwise };
        (plane, turn, self.form & 8 != 0)
    }

    /// Whether two arcs have one plane, sense and form, and not one goes hardly any of the circle and the
    /// other nearly all; true of anything else.
    pub fn same_form(&self, other: &Record) -> bool {
        let parts = LITTLE | NEARLY;
        (self.form ^ other.form) & !parts == 0 && (self.form | other.form) & parts != parts
    }
}

/// Whose length is active.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Length {
    /// An entry of the length table; 0 is none.
    Entry(u32),
    /// An edge of a tool.
    Edge(i64, u32),
}

/// With what a record is done, and how the worlds are apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Style {
    /// What is on.
    pub state: Still,
    /// Feed of a cutting move, mm/min in nanos; 0 of others.
    pub rate: Nanos,
    /// Work offset active; 1 is the first.
    pub offset: u16,
    /// Length active.
    pub length: Length,
    /// Where A B C stand; only of what is no straight move.
    pub turned: [Nanos; 3],
    /// Coordinates of the other worlds less those of the plain one.
    pub apart: [[Nanos; AXES]; WORLDS],
}

/// A [`State`] that can be distinguished from others quickly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[allow(missing_docs)] // As in `State`.
pub struct Still {
    pub tool: i64,
    pub speed: Nanos,
    pub limit: u32,
    pub spindle: ncc_ir::canon::Spindle,
    pub spindle_mode: ncc_ir::canon::SpindleMode,
    pub flood: bool,
    pub mist: bool,
    pub compensation: Compensation,
    pub tip: bool,
    pub tilted: bool,
    pub turned: u8,
    pub one_side: u8,
}

impl Still {
    /// The coolants that are on.
    pub fn coolant(&self) -> Coolant {
        Coolant { flood: self.flood, mist: self.mist }
    }

    /// By whose points, and on which ways, axes go.
    pub fn ways(&self) -> (bool, bool, u8, u8) {
        (self.tip, self.tilted, self.turned, self.one_side)
    }
}

impl From<State> for Still {
    fn from(s: State) -> Still {
        // How blocks stand between moves is a matter of the text.
        let compensation = Compensation { gap: false, ..s.compensation };
        let State {
            tool,
            speed,
            limit,
            spindle,
            spindle_mode,
            flood,
            mist,
            tip,
            tilted,
            turned,
            one_side,
            ..
        } = s;
        Still {
            tool,
            speed,
            limit,
            spindle,
            spindle_mode,
            flood,
            mist,
            compensation,
            tip,
            tilted,
            turned,
            one_side,
        }
    }
}

/// A stretch of a stream, with what is new in its lists.
#[derive(Clone, Debug, Default)]
pub struct Batch {
    /// Records.
    pub records: Vec<Record>,
    /// Further styles, after those of earlier batches.
    pub styles: Vec<Style>,
    /// Further events that a record tells by their place in this list.
    pub kept: Vec<Kind>,
}

/// Makes records of events.
#[derive(Debug)]
pub struct Recorder {
    batch: Batch,
    styles: HashMap<Style, u32>,
    last: Option<(Style, u32)>,
    kept: u32,
    /// Where the axes stood after the last record, world by world.
    stood: [[Nanos; AXES]; 1 + WORLDS],
    hole: u32,
    /// The last record, if it is a straight line that all worlds made.
    line: Option<Record>,
}

impl Recorder {
    /// Of controls that stand at these places.
    pub fn new(stand: [[Nanos; AXES]; 1 + WORLDS]) -> Recorder {
        Recorder {
            batch: Batch::default(),
            styles: HashMap::new(),
            last: None,
            kept: 0,
            stood: stand,
            hole: 0,
            line: None,
        }
    }

    /// Keeps an event that its record tells by its hash and its place.
    fn keep(&mut self, hash: u64, kind: &Kind) -> [Nanos; 3] {
        let place = i64::from(self.kept);
        self.kept += 1;
        self.batch.kept.push(kind.clone());
        [hash as i64, place, 0]
    }

    /// Where the controls stand, before the first event.
    pub fn stand(&mut self, stand: [[Nanos; AXES]; 1 + WORLDS]) {
        self.stood = stand;
    }

    /// Records straight lines that follow the one of the block `at` with the same motion, feed and state in all worlds. Gives
    /// a function that takes one line after the other: the place of its block, and where it ends in the plain world, in nanos.
    /// `None` if the last record is another one, or the worlds do not stand at its end. After the last line the caller states
    /// where the worlds [stand](Recorder::stand).
    pub fn goes_on(
        &mut self,
        at: u32,
        stand: [[Nanos; AXES]; 1 + WORLDS],
    ) -> Option<impl FnMut(u32, &[Nanos; AXES]) + use<'_>> {
        let line = self.line.filter(|line| line.at == at && self.stood == stand)?;
        let (records, stood) = (&mut self.batch.records, &mut self.stood);
        Some(move |at, end: &[Nanos; AXES]| {
            if same_point(end, &stood[0]) {
                return;
            }
            stood[0] = *end;
            let [x, y, z, a, b, c] = *end;
            records.push(Record { end: [x, y, z], more: [a, b, c], at, ..line });
        })
    }

    /// Records that wait to be taken.
    pub fn waiting(&self) -> usize {
        self.batch.records.len()
    }

    /// What has been recorded since the last time.
    pub fn take(&mut self) -> Batch {
        std::mem::take(&mut self.batch)
    }

    /// Records what one statement has made in every world, the plain one first; `plain` is the plain
    /// world's control after it. `incremental` says whether its words measure from where the tool is.
    pub fn record(&mut self, plain: &Exec, worlds: [&[Event]; 1 + WORLDS], incremental: bool) {
        self.line = None;
        let terms = (
            plain.offset_in_force(),
            match plain.length_edge() {
                Some((tool, edge)) => Length::Edge(tool, edge),
                None => Length::Entry(plain.length_entry().unwrap_or(0)),
            },
        );
        let alike = worlds[1..].iter().all(|events| {
            events.len() == worlds[0].len()
                && events.iter().zip(worlds[0]).all(|(a, b)| what(&a.kind) == what(&b.kind))
        });
        if !alike {
            // What a world does alone is compared by itself.
            for (world, events) in worlds.into_iter().enumerate() {
                for event in events {
                    self.alone(event, world, terms, incremental);
                }
            }
            return;
        }
        let first = worlds[0];
        let mark =
            |at: usize| matches!(first.get(at).map(|e| &e.kind), Some(Kind::Attribute(Attribute::Hole)));
        let holes =
            first.len() > 2 && first.iter().any(|e| matches!(e.kind, Kind::Attribute(Attribute::Hole)));
        if !holes {
            self.event(worlds.map(|events| events.first()), terms, incremental, 0);
            for at in 1..first.len() {
                self.event(worlds.map(|events| events.get(at)), terms, incremental, 0);
            }
            return;
        }
        for at in 0..first.len() {
            // A hole begins two moves before its mark: over it, and down to the retract plane.
            self.hole += u32::from(mark(at + 2));
            self.event(worlds.map(|events| events.get(at)), terms, incremental, self.hole);
        }
    }

    #[inline]
    fn event(
        &mut self,
        worlds: [Option<&Event>; 1 + WORLDS],
        terms: (u16, Length),
        incremental: bool,
        hole: u32,
    ) {
        self.line = None;
        let [Some(plain), Some(one), Some(two)] = worlds else { return };
        let Some(what) = what(&plain.kind) else { return };
        let ends = [&plain.end, &one.end, &two.end];
        let nowhere = ends.iter().zip(&self.stood).all(|(end, stood)| same_point(end, stood));
        if nowhere && matches!(what, What::Traverse | What::Feed | What::Thread) {
            return;
        }
        let start = std::mem::replace(&mut self.stood, [plain.end, one.end, two.end])[0];
        let apart = [one.end, two.end].map(|w| std::array::from_fn(|axis| w[axis] - plain.end[axis]));
        self.push(plain, &start, what, terms, apart, incremental, hole, 0);
        let line = matches!(what, What::Traverse | What::Feed) && hole == 0;
        self.line = if line { self.batch.records.last().copied() } else { None };
    }

    fn alone(&mut self, event: &Event, world: usize, terms: (u16, Length), incremental: bool) {
        let Some(what) = what(&event.kind) else { return };
        let stood = &mut self.stood[world];
        if same_point(stood, &event.end) && matches!(what, What::Traverse | What::Feed) {
            return;
        }
        let start = std::mem::replace(stood, event.end);
        self.push(event, &start, what, terms, [[0; AXES]; WORLDS], incremental, 0, 1 + world as u8);
    }

    #[allow(clippy::too_many_arguments)] // The fields of one record.
    fn push(
        &mut self,
        event: &Event,
        start: &[Nanos; AXES],
        what: What,
        (offset, length): (u16, Length),
        apart: [[Nanos; AXES]; WORLDS],
        incremental: bool,
        hole: u32,
        world: u8,
    ) {
        let [x, y, z, a, b, c] = event.end;
        let turned = if matches!(what, What::Traverse | What::Feed) { [0; 3] } else { [a, b, c] };
        let style = Style { state: event.state.into(), rate: event.rate, offset, length, turned, apart };
        let style = self.style(style);
        let (mut more, mut form) = ([a, b, c], 0);
        match &event.kind {
            Kind::Arc { plane, turn, full, centre } => {
                more = [centre[0], centre[1], 0];
                form = match plane {
                    Plane::Xy => 0,
                    Plane::Zx => 1,
                    Plane::Yz => 2,
                } | u8::from(*turn == Turn::Counterclockwise) << 2
                    | u8::from(*full) << 3
                    | match part(event, start) {
                        Part::Little => LITTLE,
                        Part::Nearly => NEARLY,
                        Part::Other => 0,
                    };
            }
            Kind::Synchronised { chuck, .. } => form = u8::from(*chuck),
            Kind::Orient(angle) => more = [*angle, 0, 0],
            Kind::Dwell(seconds) => more = [*seconds, 0, 0],
            Kind::Message(text) | Kind::MachineFunction(text) => {
                more = self.keep(hash(text.as_bytes()), &event.kind)
            }
            Kind::Data(_) | Kind::Output(_) | Kind::Alarm(..) | Kind::Probe { .. } => {
                more = self.keep(hash(format!("{:?}", event.kind).as_bytes()), &event.kind);
            }
            // Toward which side it turns is the control's.
            Kind::OrientToolAxis(_) => more = self.keep(0, &event.kind),
            Kind::Tilt(plane) => {
                let rounded = plane.as_ref().map(|plane| plane.rounded());
                more = self.keep(hash(format!("{rounded:?}").as_bytes()), &event.kind);
            }
            Kind::Traverse | Kind::Feed => {}
            Kind::ToolChange
            | Kind::Coolant
            | Kind::ProgramStop
            | Kind::OptionalProgramStop
            | Kind::ProgramEnd
            | Kind::BeginAgain
            | Kind::TextEnd
            | Kind::Attribute(_) => more = [0; 3],
        }
        let flags = if event.inch { INCH } else { 0 } | if incremental { INCREMENTAL } else { 0 };
        let at = event.span.start;
        self.batch.records.push(Record { end: [x, y, z], more, style, at, hole, what, form, world, flags });
    }

    #[inline]
    fn style(&mut self, style: Style) -> u32 {
        if let Some((last, id)) = &self.last
            && *last == style
        {
            return *id;
        }
        let next = self.styles.len() as u32;
        let id = *self.styles.entry(style).or_insert_with(|| {
            self.batch.styles.push(style);
            next
        });
        self.last = Some((style, id));
        id
    }
}

/// What an event is recorded as; functions that only set something are attributes of later records.
fn what(kind: &Kind) -> Option<What> {
    Some(match kind {
        Kind::Traverse => What::Traverse,
        Kind::Feed => What::Feed,
        Kind::Synchronised { .. } => What::Thread,
        Kind::Orient(_) => What::Orient,
        Kind::Arc { .. } => What::Arc,
        Kind::Dwell(_) => What::Dwell,
        Kind::ToolChange => What::ToolChange,
        Kind::MachineFunction(_)
        | Kind::Data(_)
        | Kind::Output(_)
        | Kind::Tilt(_)
        | Kind::OrientToolAxis(_) => What::Function,
        // Where it ends is another place in each world.
        Kind::Probe { .. } => What::Function,
        Kind::ProgramStop => What::Stop,
        Kind::OptionalProgramStop => What::OptionalStop,
        Kind::ProgramEnd => What::End,
        Kind::BeginAgain => What::BeginAgain,
        Kind::TextEnd => What::TextEnd,
        Kind::Message(_) => What::Message,
        Kind::Alarm(..) => What::Alarm,
        // Coolant is an attribute of what comes after.
        Kind::Coolant | Kind::Attribute(_) => return None,
    })
}

/// FNV-1a: a text that is compared with another one by its hash.
pub(crate) fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |h, b| (h ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3))
}

/// The axis of an index.
pub fn axis(index: usize) -> Axis {
    Axis::ALL[index.min(AXES - 1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_is_small() {
        assert!(size_of::<Record>() <= 64, "{}", size_of::<Record>());
    }
}
