//! The columns of the case study's tables: what a function is called, and what feed, speed and tool
//! stand beside it (Aguiar 2023, table 11).

use ncc_exec::{Attribute, Kind, State};
use ncc_ir::canon::{AXES, Spindle, SpindleMode};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_time::{Machine, Timed, path};

/// What is beside a function in a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// Its number, from 1; marks are not counted.
    pub n: u64,
    /// Its canonical name.
    pub name: &'static str,
    /// Feed, mm/min: of a rapid the machine's rate, of a feed move and of `SET_FEED_RATE` its own, of
    /// others 0.
    pub feed: f64,
    /// Speed that was set, rev/min; 0 after a stop of the spindle, until a speed is set or it starts.
    pub speed: f64,
    /// Tool in the spindle, of `SELECT_TOOL` the one selected; 0 where none is known.
    pub tool: i64,
    /// Length of the way, mm; of rotary axes alone, degrees.
    pub distance: f64,
}

/// What has been set so far.
#[derive(Clone, Debug, Default)]
pub struct Columns {
    n: u64,
    speed: Nanos,
    before: State,
}

/// Millimetres, degrees, seconds and the like of nanos.
pub fn units(nanos: Nanos) -> f64 {
    nanos as f64 / ONE as f64
}

impl Columns {
    /// The row of a function; marks and the end of a text have none.
    pub fn row(&mut self, timed: &Timed, machine: &Machine) -> Option<Row> {
        let event = &timed.act.event;
        let way = path(event, &timed.act.from);
        let before = std::mem::replace(&mut self.before, event.state);
        if event.state.spindle_mode == SpindleMode::Surface && event.state.spindle != Spindle::Stopped {
            self.speed = event.state.turns(event.end[0]);
        }
        let mut tool = event.state.tool;
        let mut feed = units(event.rate);
        let name = match &event.kind {
            Kind::Traverse => {
                feed = rapid_rate(way.length, &way.change, machine);
                "STRAIGHT_TRAVERSE"
            }
            Kind::Feed => "STRAIGHT_FEED",
            Kind::Probe { .. } => "STRAIGHT_PROBE",
            Kind::Synchronised { .. } => "SYNCHRONISED_FEED",
            Kind::Arc { .. } => "ARC_FEED",
            Kind::Dwell(_) => "DWELL",
            Kind::ToolChange => "CHANGE_TOOL",
            Kind::Coolant => match event.state {
                State { flood: true, .. } if !before.flood => "FLOOD_ON",
                State { mist: true, .. } if !before.mist => "MIST_ON",
                State { .. } => "COOLANT_OFF",
            },
            Kind::Orient(_) => {
                self.speed = 0;
                "ORIENT_SPINDLE"
            }
            Kind::ProgramStop => "PROGRAM_STOP",
            Kind::OptionalProgramStop => "OPTIONAL_PROGRAM_STOP",
            Kind::ProgramEnd => "PROGRAM_END",
            Kind::BeginAgain => "BEGIN_AGAIN",
            Kind::Message(_) => "MESSAGE",
            Kind::Output(_) => "OUTPUT",
            Kind::Alarm(..) => "ALARM",
            Kind::MachineFunction(_) => "MACHINE_FUNCTION",
            Kind::Data(_) => "SET_DATA",
            Kind::Tilt(Some(_)) => "SET_TILT",
            Kind::Tilt(None) => "CLEAR_FRAME",
            Kind::OrientToolAxis(_) => "ORIENT_TOOL_AXIS",
            Kind::Attribute(Attribute::SelectTool(selected)) => {
                tool = *selected;
                "SELECT_TOOL"
            }
            Kind::Attribute(Attribute::SpindleSpeed(speed)) => {
                self.speed = *speed;
                "SET_SPINDLE_SPEED"
            }
            Kind::Attribute(Attribute::StartSpindle(sense)) => {
                self.speed = event.state.turns(event.end[0]);
                match sense {
                    Spindle::Clockwise => "START_SPINDLE_CLOCKWISE",
                    Spindle::Counterclockwise => "START_SPINDLE_COUNTERCLOCKWISE",
                    Spindle::Stopped => "STOP_SPINDLE_TURNING",
                }
            }
            Kind::Attribute(Attribute::StopSpindle) => {
                self.speed = 0;
                "STOP_SPINDLE_TURNING"
            }
            Kind::Attribute(Attribute::FeedRate(rate)) => {
                feed = units(*rate);
                "SET_FEED_RATE"
            }
            Kind::TextEnd | Kind::Attribute(Attribute::Hole | Attribute::Remark) => return None,
        };
        self.n += 1;
        let (speed, tool) = (units(self.speed), tool.max(0));
        Some(Row { n: self.n, name, feed, speed, tool, distance: way.length })
    }

    /// The row of a statement that is reported at its call.
    pub fn called(&mut self, name: &'static str, feed: f64) -> Row {
        self.n += 1;
        let (speed, tool) = (units(self.speed), self.before.tool.max(0));
        Row { n: self.n, name, feed, speed, tool, distance: 0.0 }
    }
}

/// Rate along the way of a rapid, mm/min: the machine's, or what its slowest axis allows; 0 where
/// neither is known.
fn rapid_rate(length: f64, change: &[f64; AXES], machine: &Machine) -> f64 {
    let axes = machine.axes.iter().zip(change).filter_map(|(axis, change)| {
        let time = change.abs() / axis.rapid_rate?;
        (time > 0.0).then(|| length / time)
    });
    // The rate along the line says nothing of rotary axes.
    let moves = |axes: &[f64]| axes.iter().any(|change| *change != 0.0);
    let line = machine.rapid_rate.filter(|_| moves(&change[..3]) || !moves(&change[3..]));
    axes.fold(line, |least, rate| Some(least.map_or(rate, |l| l.min(rate)))).unwrap_or(0.0)
}

/// To six digits after the point, which is what is shown of anything.
pub fn micro(value: f64) -> f64 {
    let rounded = (value * 1e6).round() / 1e6;
    // No minus zero.
    if rounded == 0.0 { 0.0 } else { rounded }
}
