//! What pictures show of a program, gathered as its functions go by.
//!
//! Functions come in one by one and are not kept: values over time go into [`Series`], legs of the
//! tool into a [`Way`]. Nothing is drawn here.

use std::collections::HashSet;

use ncc_exec::{Attribute, Kind, Movement};
use ncc_ir::canon::{AXES, Spindle};
use ncc_ir::expr::num::ONE;
use ncc_time::{Place, Timed, path};

use crate::chord::{Turned, chords, place};
use crate::series::{Course, Series};
use crate::way::{Leg, Stroke, Way};

/// Stretches of tools that are kept at most.
const STRETCHES: usize = 4096;
/// Holes that are kept at most; then those are left out that a picture draws at one place.
const HOLES: usize = 20_000;
/// Times of moves that are kept at most.
const STAMPS: usize = 4096;

/// A tool in the spindle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stretch {
    /// Its number.
    pub tool: i64,
    /// When it is in, seconds.
    pub start: f64,
    /// When it is out.
    pub end: f64,
}

/// A hole of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// The retract plane over it, X Y Z in mm.
    pub at: [f64; 3],
    /// When it begins, seconds.
    pub time: f64,
    /// Line of the source; 0 if not known.
    pub line: u32,
}

/// Seconds and mm of a program.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sums {
    /// Seconds of moves at feed.
    pub cutting: f64,
    /// Seconds of rapids.
    pub rapid: f64,
    /// Seconds of all else.
    pub idle: f64,
    /// Way at feed, mm.
    pub cutting_way: f64,
    /// Way in rapids, mm.
    pub rapid_way: f64,
    /// Moves that go somewhere.
    pub moves: u64,
    /// Holes of cycles.
    pub holes: u64,
    /// Tools put in.
    pub changes: u64,
}

/// When every so many moves are over, to compare two programs by.
#[derive(Clone, Debug)]
pub struct Stamps {
    /// From one time to the next, so many moves.
    pub every: u64,
    /// Seconds.
    pub times: Vec<f64>,
}

impl Stamps {
    fn push(&mut self, n: u64, time: f64) {
        if !n.is_multiple_of(self.every) {
            return;
        }
        self.times.push(time);
        if self.times.len() >= STAMPS {
            self.widen();
        }
    }

    /// Leaves every second out.
    pub fn widen(&mut self) {
        self.times = self.times.iter().step_by(2).copied().collect();
        self.every *= 2;
    }
}

/// What pictures show of a program.
#[derive(Clone, Debug)]
pub struct Record {
    /// Its name.
    pub name: String,
    /// Speed of the spindle, rev/min; 0 while it is stopped.
    pub speed: Series,
    /// Rate along the path, mm/min, and of rotary axes alone degrees a minute; 0 while nothing moves.
    pub feed: Series,
    /// Positions in the program's coordinates, mm and degrees.
    pub axes: [Series; AXES],
    /// Which axes move.
    pub moved: [bool; AXES],
    /// Whether there are moves of linear axes, and moves of rotary axes alone, whose rate is in degrees.
    pub rates: [bool; 2],
    /// The tools.
    pub tools: Vec<Stretch>,
    /// The holes.
    pub holes: Vec<Hole>,
    /// The tool path.
    pub way: Way,
    /// When moves are over; of move 0, 1, 2 … where not every one is kept, of every second, fourth …
    pub stamps: Stamps,
    /// Seconds and mm.
    pub sums: Sums,
    /// When the first function begins, seconds.
    pub begin: f64,
    /// When the last one is over.
    pub end: f64,
    hole: Option<Place>,
    empty: bool,
}

impl Record {
    /// Of a program of which nothing has been done.
    pub fn new(name: &str) -> Record {
        Record {
            name: name.to_owned(),
            speed: Series::new(Course::Step),
            feed: Series::new(Course::Line),
            axes: std::array::from_fn(|_| Series::new(Course::Line)),
            moved: [false; AXES],
            rates: [false; 2],
            tools: Vec::new(),
            holes: Vec::new(),
            way: Way::default(),
            stamps: Stamps { every: 1, times: Vec::new() },
            sums: Sums::default(),
            begin: 0.0,
            end: 0.0,
            hole: None,
            empty: true,
        }
    }

    /// The next function; of an arc, how the frames of the program turn its plane, where they do.
    pub fn push(&mut self, timed: &Timed, turned: Option<&Turned>) {
        let (act, start, end) = (&timed.act, timed.start, timed.end());
        if std::mem::replace(&mut self.empty, false) {
            self.begin = start;
            self.stamps.push(0, start);
            self.speed.push(start, 0.0);
            self.feed.push(start, 0.0);
            for (axis, at) in self.axes.iter_mut().zip(&act.program_from) {
                axis.push(start, *at as f64 / ONE as f64);
            }
        }
        if act.event.kind == Kind::Attribute(Attribute::Hole) {
            self.hole(timed);
            return;
        }
        let stroke = match act.event.kind.moves() {
            Some(Movement::Rapid) => Stroke::Rapid,
            // All that a block makes of a hole has its place.
            Some(Movement::Feed) if self.hole == Some(act.place) => Stroke::Hole,
            Some(Movement::Feed) => Stroke::Feed,
            Some(Movement::Arc { .. }) => Stroke::Arc,
            None => Stroke::Still,
        };
        if stroke == Stroke::Still {
            self.still(timed);
        } else {
            self.go(timed, stroke, turned);
        }
        self.turns(timed, stroke);
        self.sums.changes += u64::from(act.event.kind == Kind::ToolChange);
        self.end = self.end.max(end);
    }

    /// The program is over.
    pub fn finish(&mut self) {
        self.feed.push(self.end, 0.0);
        for series in [&mut self.speed].into_iter().chain(&mut self.axes) {
            series.push(self.end, series.value());
        }
        if let Some(last) = self.tools.last_mut() {
            last.end = self.end;
        }
        self.way.finish();
    }

    fn hole(&mut self, timed: &Timed) {
        let at = place(&timed.act.program_to);
        self.hole = Some(timed.act.place);
        self.sums.holes += 1;
        self.holes.push(Hole { at, time: timed.start, line: timed.act.place.line });
        if self.holes.len() >= 2 * HOLES {
            self.thin_holes();
        }
    }

    /// Leaves out holes that a picture of the whole draws at one place.
    fn thin_holes(&mut self) {
        let extent = &self.way.extent;
        let side = (0..3).map(|i| extent.high[i] - extent.low[i]).fold(1e-3, f64::max);
        let mut pixel = side / 1600.0;
        while self.holes.len() > HOLES {
            let mut seen = HashSet::new();
            self.holes.retain(|hole| seen.insert(hole.at.map(|at| (at / pixel).floor() as i64)));
            pixel *= 2.0;
        }
    }

    fn still(&mut self, timed: &Timed) {
        self.sums.idle += timed.duration;
        if timed.duration > 0.0 {
            self.feed.push(timed.start, 0.0);
            self.feed.push(timed.end(), 0.0);
            let (at, line) = (place(&timed.act.program_to), timed.act.place.line);
            self.way.stand(at, timed.start, line);
            self.way.add(Leg { stroke: Stroke::Still, to: at, end: timed.end(), lines: [line; 2] });
        }
    }

    fn go(&mut self, timed: &Timed, stroke: Stroke, turned: Option<&Turned>) {
        let (act, line) = (&timed.act, timed.act.place.line);
        let from = place(&act.program_from);
        let way = path(&act.event, &act.from);
        if way.change == [0.0; AXES] && way.sweep == 0.0 {
            return;
        }
        for (i, axis) in self.axes.iter_mut().enumerate() {
            self.moved[i] |= way.change[i] != 0.0;
            axis.push(timed.start, act.program_from[i] as f64 / ONE as f64);
        }
        self.way.stand(from, timed.start, line);
        let mut leg = |to: [f64; 3], part: f64| {
            let end = timed.start + part * timed.duration;
            self.way.add(Leg { stroke, to, end, lines: [line; 2] });
            for (axis, at) in self.axes.iter_mut().zip(to) {
                axis.push(end, at);
            }
        };
        let chords = chords(act, turned);
        if chords.is_empty() {
            leg(place(&act.program_to), 1.0);
        }
        for (to, part) in chords {
            leg(to, part);
        }
        for (i, axis) in self.axes.iter_mut().enumerate().skip(3) {
            axis.push(timed.end(), act.program_to[i] as f64 / ONE as f64);
        }
        self.rate(timed, way.length);
        let (time, length) = match stroke {
            Stroke::Rapid => (&mut self.sums.rapid, &mut self.sums.rapid_way),
            Stroke::Feed | Stroke::Arc | Stroke::Hole | Stroke::Still | Stroke::Unseen => {
                (&mut self.sums.cutting, &mut self.sums.cutting_way)
            }
        };
        *time += timed.duration;
        // Degrees are no way of the tool.
        let linear = way.sweep > 0.0 || way.change[..3].iter().any(|change| *change != 0.0);
        if linear {
            *length += way.length;
        }
        self.rates[usize::from(!linear)] = true;
        self.sums.moves += 1;
        self.stamps.push(self.sums.moves, timed.end());
    }

    /// Whether the tool never leaves its place.
    pub fn stands_still(&self) -> bool {
        let extent = &self.way.extent;
        extent.is_empty() || extent.low == extent.high
    }

    /// The rate of a move: its ramps where the model has some, else its mean.
    fn rate(&mut self, timed: &Timed, length: f64) {
        let (profile, start, end) = (&timed.profile, timed.start, timed.end());
        if timed.duration <= 0.0 {
            return;
        }
        let mean = length / timed.duration;
        let ramps = profile.t_accel > 0.0 || profile.t_decel > 0.0;
        let (entry, peak, exit) =
            if ramps { (profile.entry, profile.peak, profile.exit) } else { (mean, mean, mean) };
        let (top, fall) = if ramps { (start + profile.t_accel, end - profile.t_decel) } else { (start, end) };
        for (time, rate) in
            [(start, entry), (top.min(end), peak), (fall.max(top).min(end), peak), (end, exit)]
        {
            self.feed.push(time, rate * 60.0);
        }
    }

    /// Spindle and tool: what a move finds is so from its start; what another function sets, from its
    /// end.
    fn turns(&mut self, timed: &Timed, stroke: Stroke) {
        let since = if stroke == Stroke::Still { timed.end() } else { timed.start };
        let state = &timed.act.event.state;
        let turns = state.turns(timed.act.event.end[0]);
        let speed = if state.spindle == Spindle::Stopped { 0.0 } else { turns as f64 / ONE as f64 };
        self.speed.push(since, speed);
        let same = self.tools.last().is_some_and(|last| last.tool == state.tool);
        if same || (self.tools.is_empty() && state.tool < 0) {
            return;
        }
        if let Some(last) = self.tools.last_mut() {
            last.end = timed.start.max(last.start);
        }
        self.tools.push(Stretch { tool: state.tool, start: since, end: since });
        if self.tools.len() > 2 * STRETCHES {
            // Shorter than a picture of the whole could show.
            let least = (since - self.begin) / STRETCHES as f64;
            let newest = self.tools.len() - 1;
            let mut at = 0;
            self.tools.retain(|one| {
                at += 1;
                at > newest || one.end - one.start > least
            });
        }
    }
}
