//! The moves of a program, in coordinates of the part: where the tip of the tool is, from the zero of the work offset in
//! which the program cuts first.
//!
//! A work offset that no profile states lies at the machine's zero, so that a place of the machine says nothing of the part:
//! after a move to one (`G28`, `G53`) ncc does not know the height of the tool, as at the start. Until the next move along Z it
//! stands as high as the program ever goes, and cuts nothing.

use std::collections::BTreeMap;
use std::io;

use ncc_exec::world::Tables;
use ncc_exec::{Event, Kind, Movement};
use ncc_ir::canon::{AXES, Spindle, Turn};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::source::Span;
use ncc_simulate::{Axes, Move, Way, turned_back};
use ncc_time::{Timed, path};

use super::comments;
use super::described::Described;
use super::planes::{Placed, Planes, mm};
use super::unsimulated::Unsimulated;
use crate::time::drive::{Said, Sink};

const Z: usize = 2;

/// What a program does with a tool.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Used {
    /// Its number; -1 is the one in the spindle at the start, less than that one with a name.
    pub number: i64,
    /// Moves at feed across Z.
    pub across: u64,
    /// Moves at feed along Z alone.
    pub along: u64,
    /// Whether it cuts threads.
    pub threads: bool,
}

/// What a comment says of a tool.
#[derive(Clone, Debug, PartialEq)]
pub struct Remark {
    /// The tool, in mm.
    pub described: Described,
    /// The line of the comment.
    pub line: u32,
    /// Whether it is the heading of a tool change, which names no tool.
    pub heading: bool,
}

/// The moves of a program.
#[derive(Clone, Debug, Default)]
pub struct Path {
    /// Where the tip is before the first one, X Y Z in mm.
    pub start: [f64; 3],
    /// Axes of the tilted planes on which an upright tool moves.
    pub tilts: Vec<Axes>,
    /// Whether a plane without angles is assumed to have turned all rotary axes back to zero.
    pub straightened: bool,
    /// The moves; their tools are places in [`Path::tools`].
    pub moves: Vec<Move>,
    /// When each begins, seconds.
    pub begins: Vec<f64>,
    /// Feed of each, mm/min; 0 in rapids.
    pub feeds: Vec<f32>,
    /// Speed of the spindle in each, rev/min; 0 while it stands.
    pub speeds: Vec<f32>,
    /// Block of each.
    pub spans: Vec<Span>,
    /// The tools, in the order in which they come.
    pub tools: Vec<Used>,
    /// What comments say of tools, by their numbers.
    pub remarks: BTreeMap<i64, Remark>,
    /// The work offsets in which it moves.
    pub offsets: Vec<u16>,
    /// Where the zeros of these lie, machine coordinates in mm, axis by axis; `None` where it is not stated.
    pub zeros: Vec<[Option<f64>; 3]>,
    /// The place in these of the one in which it cuts first.
    pub datum: usize,
    /// Whether it cuts in inches.
    pub inch: bool,
    /// Whether it moves at unknown heights.
    pub has_unknown_heights: bool,
    /// Seconds on the clock at the end.
    pub end: f64,
    /// Why it cannot be simulated, and where.
    pub unsimulated: Option<(Unsimulated, Span)>,
}

/// Takes the functions of a program.
#[derive(Debug)]
pub struct Recorder<'t> {
    tables: &'t Tables,
    path: Path,
    /// Where the tip was last, machine coordinates.
    at: [f64; 3],
    /// Whether it is not known how high it is.
    high: bool,
    /// Moves that end at a height that is not known.
    highs: Vec<usize>,
    /// The greatest height that is known.
    top: f64,
    /// The active work offset at the first cut, or else at the first move.
    offset: Option<u16>,
    has_cut: bool,
    /// Where the rotary axes stood in the first cut without a plane.
    turned: Option<[Nanos; 3]>,
    planes: Planes,
    inch: bool,
    /// What comments say, in the program's unit.
    said: BTreeMap<i64, (Described, u32)>,
    /// The heading of what comes.
    heading: Option<(Described, u32)>,
}

impl<'t> Recorder<'t> {
    /// One that has nothing yet. `start` says whether it is stated how high the tool is at the start.
    pub fn new(tables: &'t Tables, start: bool) -> Recorder<'t> {
        Recorder {
            tables,
            path: Path::default(),
            at: [0.0; 3],
            high: !start,
            highs: Vec::new(),
            top: f64::NEG_INFINITY,
            offset: None,
            has_cut: false,
            turned: None,
            planes: Planes::default(),
            inch: false,
            said: BTreeMap::new(),
            heading: None,
        }
    }

    /// How many moves there are so far.
    pub fn moves(&self) -> usize {
        self.path.moves.len()
    }

    /// The work offset whose zero is that of the part.
    pub fn offset(&self) -> Option<u16> {
        self.offset
    }

    /// All moves, in coordinates of the part.
    pub fn finish(self) -> Path {
        let Recorder { mut path, tables, highs, top, offset, inch, said, mut planes, .. } = self;
        planes.clear(&mut path.moves);
        path.straightened = planes.straightened;
        path.tilts = planes.tilts;
        let top = if top.is_finite() { top } else { 0.0 };
        path.has_unknown_heights |= !highs.is_empty();
        for n in highs {
            path.moves[n].end[Z] = top;
        }
        let zero = offset.and_then(|offset| tables.work_offsets.get(&offset)).copied().unwrap_or_default();
        let zero = [0, 1, 2].map(|axis| mm(zero[axis].unwrap_or(0)));
        if !path.start[Z].is_finite() {
            path.start[Z] = top;
        }
        for (axis, zero) in zero.into_iter().enumerate() {
            path.start[axis] -= zero;
        }
        for own in &mut path.moves {
            for (axis, zero) in zero.into_iter().enumerate() {
                own.end[axis] -= zero;
            }
            if let Way::Arc { plane, centre, .. } = &mut own.way {
                let axes = usize::from(own.tilt).checked_sub(1).map(|n| &path.tilts[n]);
                let zero = axes.map_or(zero, |axes| turned_back(axes, zero));
                centre[0] -= zero[usize::from(plane[0])];
                centre[1] -= zero[usize::from(plane[1])];
            }
        }
        path.zeros = path
            .offsets
            .iter()
            .map(|number| match tables.work_offsets.get(number) {
                Some(zero) => [0, 1, 2].map(|axis| zero[axis].map(mm)),
                None => [None; 3],
            })
            .collect();
        path.datum = path.offsets.iter().position(|number| Some(*number) == offset).unwrap_or(0);
        path.inch = inch;
        let unit = if inch { 25.4 } else { 1.0 };
        let said = said
            .into_iter()
            .map(|(tool, (own, line))| (tool, Remark { described: own.times(unit), line, heading: false }));
        path.remarks.extend(said);
        path
    }

    fn tool(&mut self, number: i64) -> usize {
        let known = self.path.tools.iter().rposition(|tool| tool.number == number);
        known.unwrap_or_else(|| {
            self.path.tools.push(Used { number, ..Used::default() });
            self.path.tools.len() - 1
        })
    }

    /// What a tool adds to where its tip is, for where the machine is.
    fn adds(&self, said: &Said, tool: i64) -> [Nanos; 3] {
        let mut adds = said.tip.tool;
        if adds[Z] == 0 {
            // Nobody measures with its length now, and it is as long all the same.
            let length = u32::try_from(tool).ok().and_then(|tool| {
                let entry = self.tables.edge_entries.get(&tool).copied().unwrap_or(tool);
                self.tables.lengths.get(&entry)
            });
            adds[Z] = length.copied().unwrap_or(0);
        }
        adds
    }

    /// Whether a place of the machine along an axis is one of the part, too.
    pub(super) fn is_placed(&self, offset: u16, axis: usize) -> bool {
        self.tables.work_offsets.get(&offset).is_some_and(|zero| zero[axis].is_some())
    }

    /// Notes what only a cut tells; `why` is why a cut on a tilted plane cannot be simulated.
    fn cuts(&mut self, timed: &Timed, said: &Said, tool: usize, why: Option<Unsimulated>) {
        let event = &timed.act.event;
        if !self.has_cut {
            (self.has_cut, self.offset) = (true, Some(said.tip.offset));
        }
        self.inch |= event.inch;
        let why = if event.state.tilted { why } else { self.refuses(timed) };
        if let (Some(why), None) = (why, self.path.unsimulated) {
            self.path.unsimulated = Some((why, event.span));
        }
        let used = &mut self.path.tools[tool];
        used.threads |= matches!(event.kind, Kind::Synchronised { .. });
        match (0..2).any(|axis| timed.act.from[axis] != event.end[axis])
            || matches!(event.kind, Kind::Arc { .. })
        {
            true => used.across += 1,
            false => used.along += 1,
        }
    }
}

impl Recorder<'_> {
    /// Why a cut without a tilted plane cannot be simulated.
    fn refuses(&mut self, timed: &Timed) -> Option<Unsimulated> {
        let (from, end) = (&timed.act.from, &timed.act.event.end);
        let [before, rotary] = [from, end].map(|at| [at[3], at[4], at[5]]);
        let turned = *self.turned.get_or_insert(before);
        match rotary != turned || before != turned {
            true => Some(Unsimulated::Rotary),
            false => self.planes.refuses_beside(),
        }
    }

    /// Notes what changes where the tip is, besides moves.
    fn turns(&mut self, event: &Event, said: &Said) {
        match &event.kind {
            Kind::Tilt(Some(plane)) => self.planes.set(plane, &said.tip, self.at, &mut self.path.moves),
            Kind::Tilt(None) => {
                self.planes.clear(&mut self.path.moves);
                self.high = true;
            }
            Kind::OrientToolAxis(_) => self.planes.orient(event),
            _ => self.planes.note(&said.tip, event, self.turned.unwrap_or_default()),
        }
    }

    /// Where a move goes without a tilted plane.
    fn upright(
        &mut self,
        timed: &Timed,
        (said, adds, offset): (&Said, [Nanos; 3], u16),
        (movement, sweep, feeds): (Movement, f64, bool),
    ) -> Placed {
        let (act, event) = (&timed.act, &timed.act.event);
        let mut end = [0, 1, 2].map(|axis| mm(event.end[axis] - adds[axis]));
        let (was_high, was_lost) = (self.high, self.planes.lost);
        let is_beside = !self.planes.find(&said.tip);
        let lost = self.planes.lost;
        if said.tip.of_machine[Z] && !self.is_placed(offset, Z) || lost[Z] {
            self.high = true;
        } else if feeds || act.from[Z] != event.end[Z] || was_lost[Z] {
            self.high = false;
        }
        let way = match movement {
            _ if is_beside => Way::Away,
            // A cut at a place of the machine is one beside the part: a wheel is dressed there.
            Movement::Feed if self.high => Way::Away,
            Movement::Rapid if was_high && self.high => Way::Away,
            Movement::Rapid => Way::Rapid,
            Movement::Feed | Movement::Arc { .. } if !feeds => Way::Away,
            Movement::Feed => Way::Feed,
            Movement::Arc { plane, turn, centre, .. } => {
                let (first, second, normal) = plane.axes();
                let plane = [first, second, normal].map(|axis| axis as usize);
                let sense = if turn == Turn::Counterclockwise { 1.0 } else { -1.0 };
                let centre = [0, 1].map(|n| mm(centre[n] - adds[plane[n]]));
                Way::Arc { plane: plane.map(|axis| axis as u8), centre, sweep: sense * sweep }
            }
        };
        for axis in 0..2 {
            if lost[axis] {
                end[axis] = self.at[axis];
            }
        }
        match self.high {
            true => self.highs.push(self.path.moves.len()),
            false => self.top = self.top.max(end[Z]),
        }
        if self.high {
            end[Z] = self.at[Z];
        }
        Placed { way, end, tilt: 0, why: None, high: false }
    }
}

impl Sink for Recorder<'_> {
    fn wants_tip(&self) -> bool {
        true
    }

    fn function(&mut self, timed: &Timed, said: &Said) -> io::Result<()> {
        let (act, event) = (&timed.act, &timed.act.event);
        self.path.end = self.path.end.max(timed.end());
        if let Some(remark) = &said.remark {
            match comments::read(remark) {
                Some((tool, own)) => drop(self.said.entry(tool).or_insert((own, act.place.line))),
                None => self.heading = comments::heading(remark).map(|own| (own, act.place.line)),
            }
        }
        if event.kind == Kind::ToolChange
            && let Some((described, line)) = self.heading.take()
        {
            let own = Remark { described, line, heading: true };
            self.path.remarks.entry(event.state.tool).or_insert(own);
        }
        self.turns(event, said);
        let Some(movement) = event.kind.moves() else { return Ok(()) };
        let way = path(event, &act.from);
        // As the numbers are, a tool may be there already of which only that says where it is.
        if way.change == [0.0; AXES] && way.sweep == 0.0 && !self.planes.finds(&said.tip) {
            return Ok(());
        }
        let offset = *self.offset.get_or_insert(said.tip.offset);
        if !self.path.offsets.contains(&said.tip.offset) {
            self.path.offsets.push(said.tip.offset);
        }
        let heading = self.heading.take();
        if self.path.tools.is_empty()
            && let Some((described, line)) = heading
        {
            // Of the tool that is there at the start.
            let own = Remark { described, line, heading: true };
            self.path.remarks.entry(event.state.tool).or_insert(own);
        }
        let tool = self.tool(event.state.tool);
        let feeds = movement != Movement::Rapid && !matches!(event.kind, Kind::Probe { .. });
        let adds = self.adds(said, event.state.tool);
        if self.path.moves.is_empty() {
            self.at = [0, 1, 2].map(|axis| mm(act.from[axis] - adds[axis]));
            self.path.start = self.at;
            if self.high {
                self.path.start[Z] = f64::NEG_INFINITY;
            }
        }
        let number = self.path.moves.len();
        let on_plane = self.planes.place(event, movement, (&said.tip, adds), (number, way.sweep));
        if feeds {
            self.cuts(timed, said, tool, on_plane.and_then(|placed| placed.why));
        }
        let Placed { way: taken, end, tilt, high, .. } = match on_plane {
            // Probing cuts nothing.
            Some(placed) if !feeds && movement != Movement::Rapid => Placed { way: Way::Away, ..placed },
            Some(placed) => placed,
            None => self.upright(timed, (said, adds, offset), (movement, way.sweep, feeds)),
        };
        self.path.has_unknown_heights |= high;
        if tilt != 0 {
            self.top = self.top.max(end[Z]);
        }
        self.path.moves.push(Move {
            way: taken,
            end,
            tool,
            tilt,
            turns: event.state.spindle != Spindle::Stopped,
            time: timed.end(),
            line: act.place.line,
        });
        let turns = event.state.turns(event.end[0]);
        let speed = if event.state.spindle == Spindle::Stopped { 0.0 } else { turns as f64 / ONE as f64 };
        let rate = if timed.duration > 0.0 { way.length / timed.duration * 60.0 } else { 0.0 };
        self.path.begins.push(timed.start);
        self.path.feeds.push(if feeds { rate as f32 } else { 0.0 });
        self.path.speeds.push(speed as f32);
        self.path.spans.push(event.span);
        self.at = end;
        Ok(())
    }
}

#[cfg(test)]
mod tests;
