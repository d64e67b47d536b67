//! Programs made for the tests: functions with times, without a reader or a clock.

use ncc_exec::{Attribute, Event, Kind, State};
use ncc_ir::canon::{AXES, Plane, Spindle, Turn};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::source::Span;
use ncc_plot::Record;
use ncc_time::{Act, Place, Profile, Timed};

/// A program that is being made.
pub(crate) struct Made {
    pub(crate) record: Record,
    pub(crate) state: State,
    pub(crate) line: u32,
    pub(crate) now: f64,
    at: [Nanos; AXES],
    n: u64,
}

impl Made {
    pub(crate) fn new() -> Made {
        let record = Record::new("made.nc");
        Made { record, state: State::default(), line: 1, now: 0.0, at: [0; AXES], n: 0 }
    }

    fn event(&mut self, kind: Kind, to: [f64; 3], seconds: f64) {
        let mut end = self.at;
        for (axis, value) in to.into_iter().enumerate() {
            end[axis] = (value * ONE as f64).round() as Nanos;
        }
        self.go(kind, end, seconds);
    }

    fn go(&mut self, kind: Kind, end: [Nanos; AXES], seconds: f64) {
        let span = Span::new(self.line * 10, self.line * 10 + 5);
        let event = Event { kind, end, rate: 0, state: self.state, inch: false, span };
        let place = Place { line: self.line, span };
        let act =
            Act { event, from: self.at, program_from: self.at, program_to: end, cut_offset: Some(0), place };
        self.n += 1;
        let timed = Timed { act, n: self.n, start: self.now, duration: seconds, profile: Profile::default() };
        self.record.push(&timed, None);
        self.at = end;
        self.now += seconds;
    }

    fn here(&self) -> [f64; 3] {
        [0, 1, 2].map(|i| self.at[i] as f64 / ONE as f64)
    }

    pub(crate) fn rapid(&mut self, to: [f64; 3], seconds: f64) {
        self.event(Kind::Traverse, to, seconds);
    }

    /// A rapid of the first rotary axis alone, degrees.
    pub(crate) fn turn(&mut self, to: f64, seconds: f64) {
        let mut end = self.at;
        end[3] = (to * ONE as f64).round() as Nanos;
        self.go(Kind::Traverse, end, seconds);
    }

    pub(crate) fn feed(&mut self, to: [f64; 3], seconds: f64) {
        self.event(Kind::Feed, to, seconds);
    }

    pub(crate) fn circle(&mut self, centre: [f64; 2], seconds: f64) {
        let centre = centre.map(|c| (c * ONE as f64).round() as Nanos);
        let kind = Kind::Arc { plane: Plane::Xy, turn: Turn::Counterclockwise, full: true, centre };
        self.event(kind, self.here(), seconds);
    }

    pub(crate) fn dwell(&mut self, seconds: f64) {
        self.event(Kind::Dwell((seconds * ONE as f64) as Nanos), self.here(), seconds);
    }

    pub(crate) fn tool(&mut self, tool: i64, seconds: f64) {
        self.state.tool = tool;
        self.event(Kind::ToolChange, self.here(), seconds);
    }

    pub(crate) fn spindle(&mut self, speed: i64, seconds: f64) {
        self.state.speed = speed * ONE;
        self.state.spindle = if speed == 0 { Spindle::Stopped } else { Spindle::Clockwise };
        let attribute = match speed {
            0 => Attribute::StopSpindle,
            _ => Attribute::StartSpindle(Spindle::Clockwise),
        };
        self.event(Kind::Attribute(attribute), self.here(), seconds);
    }

    pub(crate) fn hole(&mut self, [x, y]: [f64; 2], depth: f64) {
        self.rapid([x, y, 3.0], 0.1);
        self.event(Kind::Attribute(Attribute::Hole), [x, y, 3.0], 0.0);
        self.feed([x, y, depth], 2.0);
        self.rapid([x, y, 3.0], 0.1);
    }

    pub(crate) fn finish(mut self) -> Record {
        self.record.finish();
        self.record
    }
}

/// A program with a bit of everything: two tools, a line, a circle, three holes.
pub(crate) fn part() -> Record {
    let mut made = Made::new();
    made.tool(1, 7.0);
    made.line = 2;
    made.spindle(1263, 2.0);
    made.line = 3;
    made.rapid([0.0, 20.0, 5.0], 0.5);
    made.line = 4;
    made.feed([40.0, 20.0, -1.0], 4.0);
    made.line = 5;
    made.circle([30.0, 20.0], 6.0);
    made.line = 6;
    made.dwell(1.5);
    made.tool(12, 7.0);
    for (i, x) in [10.0, 20.0, 30.0].into_iter().enumerate() {
        made.line = 7 + i as u32;
        made.hole([x, 5.0], -8.0);
    }
    made.line = 10;
    made.spindle(0, 2.0);
    made.finish()
}
