//! The model of the case study: no acceleration at all.
//!
//! A rapid is its straight line at one rate, a feed move its length at the feed; a tool change, and a
//! start or stop of the spindle, take a fixed time. Source: Aguiar 2023, table 10 and the text to
//! figures 20 to 22.

use ncc_exec::{Attribute, Kind};
use ncc_ir::canon::{AXES, Axis};

use crate::act::Act;
use crate::machine::{Machine, ToolChangeOn};
use crate::path::{Path, units};

/// Seconds in a minute.
const MINUTE: f64 = 60.0;

/// Seconds that a function takes, whose way this is. What the machine does not know takes no time.
pub(crate) fn duration(act: &Act, path: &Path, machine: &Machine) -> f64 {
    let known = |time: Option<f64>| time.unwrap_or(0.0);
    match &act.event.kind {
        Kind::Traverse => {
            // The rate along the line says nothing of rotary axes.
            let linear = path.change[..3].iter().any(|change| *change != 0.0);
            rapid(if linear { path.length } else { 0.0 }, &path.change, machine)
        }
        Kind::Feed | Kind::Probe { .. } | Kind::Synchronised { .. } | Kind::Arc { .. } => {
            let rate = units(act.event.rate);
            match path.length {
                0.0 => 0.0,
                length => length / machine.max_feed.map_or(rate, |most| rate.min(most)) * MINUTE,
            }
        }
        Kind::Dwell(seconds) => units(*seconds),
        Kind::ToolChange if machine.tool_change_on == ToolChangeOn::Change => known(machine.tool_change),
        Kind::Attribute(Attribute::SelectTool(_)) if machine.tool_change_on == ToolChangeOn::Select => {
            known(machine.tool_change)
        }
        Kind::Attribute(Attribute::StartSpindle(_)) => known(machine.spindle_start),
        Kind::Orient(_) | Kind::Attribute(Attribute::StopSpindle) => known(machine.spindle_stop),
        Kind::MachineFunction(name) => known(machine.function(name)),
        Kind::ToolChange
        | Kind::Tilt(_)
        | Kind::OrientToolAxis(_)
        | Kind::Data(_)
        | Kind::Coolant
        | Kind::ProgramStop
        | Kind::OptionalProgramStop
        | Kind::ProgramEnd
        | Kind::BeginAgain
        | Kind::TextEnd
        | Kind::Message(_)
        | Kind::Output(_)
        | Kind::Alarm(..)
        | Kind::Attribute(
            Attribute::SelectTool(_)
            | Attribute::SpindleSpeed(_)
            | Attribute::FeedRate(_)
            | Attribute::Hole
            | Attribute::Remark,
        ) => 0.0,
    }
}

/// Seconds of a rapid: along the line at the machine's rate, or as its slowest axis allows.
fn rapid(length: f64, change: &[f64; AXES], machine: &Machine) -> f64 {
    let line = machine.rapid_rate.map_or(0.0, |rate| length / rate * MINUTE);
    let axes = Axis::ALL.into_iter().filter_map(|axis| {
        let rate = machine.axes[axis as usize].rapid_rate?;
        Some(change[axis as usize].abs() / rate * MINUTE)
    });
    axes.fold(line, f64::max)
}
