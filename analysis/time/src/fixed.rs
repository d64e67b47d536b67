//! What takes its time while the axes stand.
//!
//! A function that moves nothing ends the path: the axes have stopped before it begins. Those that
//! only set what later moves say (the feed, the next tool, a message, marks for tables) are carried
//! out on the fly, unless a time of their own makes them wait. A program stop takes no time: how long
//! the operator waits is not known; nor does a message.

use ncc_exec::{Attribute, Event, Kind};
use ncc_ir::canon::Spindle;

use crate::act::Act;
use crate::machine::{Machine, ToolChangeOn};
use crate::path::units;

/// A function that is no move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Fixed {
    /// Seconds that it takes.
    pub(crate) seconds: f64,
    /// Whether the axes stop for it.
    pub(crate) stops: bool,
}

/// Speed of the spindle behind an event, rev/min; negative counter-clockwise.
pub(crate) fn turning(event: &Event, machine: &Machine) -> f64 {
    let state = &event.state;
    let speed = units(state.turns(event.end[0]));
    let speed = machine.spindle_max.map_or(speed, |most| speed.min(most));
    match state.spindle {
        Spindle::Stopped => 0.0,
        Spindle::Clockwise => speed,
        Spindle::Counterclockwise => -speed,
    }
}

/// Of a function; `before` is the spindle's speed before it. A move that goes nowhere is nothing.
pub(crate) fn fixed(act: &Act, machine: &Machine, before: f64) -> Fixed {
    let known = |time: Option<f64>| time.unwrap_or(0.0);
    let m = known(machine.m_function);
    let stop = |seconds: f64| Fixed { seconds, stops: true };
    let on_the_fly = |seconds: f64| Fixed { seconds, stops: seconds > 0.0 };
    // From one speed to another, where the time depends on it.
    let by_speed = |to: f64| machine.spindle_acceleration.map(|rate| (to - before).abs() / rate);
    let after = turning(&act.event, machine);
    match &act.event.kind {
        Kind::Synchronised { .. } | Kind::Probe { .. } => stop(0.0),
        Kind::Orient(_) => stop(by_speed(0.0).unwrap_or(known(machine.spindle_stop)) + m),
        Kind::Traverse | Kind::Feed | Kind::Arc { .. } | Kind::TextEnd => on_the_fly(0.0),
        Kind::Message(_) | Kind::Output(_) => on_the_fly(0.0),
        // How far the rotary axes go, no program says.
        Kind::Tilt(_) | Kind::OrientToolAxis(_) => stop(0.0),
        Kind::Dwell(seconds) => stop(units(*seconds)),
        Kind::ToolChange if machine.tool_change_on == ToolChangeOn::Change => {
            stop(known(machine.tool_change) + m)
        }
        Kind::MachineFunction(name) => stop(machine.function(name).unwrap_or(m)),
        Kind::ToolChange
        | Kind::Data(_)
        | Kind::Coolant
        | Kind::ProgramStop
        | Kind::OptionalProgramStop
        | Kind::ProgramEnd
        | Kind::BeginAgain
        | Kind::Alarm(..) => stop(m),
        Kind::Attribute(attribute) => match attribute {
            Attribute::SelectTool(_) if machine.tool_change_on == ToolChangeOn::Select => {
                on_the_fly(known(machine.tool_change))
            }
            Attribute::SelectTool(_) | Attribute::FeedRate(_) | Attribute::Hole | Attribute::Remark => {
                on_the_fly(0.0)
            }
            Attribute::SpindleSpeed(_) => match by_speed(after) {
                // Nothing changes: it stands, or has this speed already.
                _ if after == before => on_the_fly(0.0),
                time => stop(known(time)),
            },
            Attribute::StartSpindle(_) => stop(by_speed(after).unwrap_or(known(machine.spindle_start)) + m),
            Attribute::StopSpindle => stop(by_speed(0.0).unwrap_or(known(machine.spindle_stop)) + m),
        },
    }
}
