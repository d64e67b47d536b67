//! How both programs of a comparison are executed, whatever the switches.
//!
//! Not here: where that comes from (`pair`).

use ncc_exec::verify::{Comparison, Resolution};
use ncc_exec::world::World;
use ncc_exec::{Exec, Seen};
use ncc_ir::alarms::Alarms;
use ncc_ir::canon::AXES;
use ncc_ir::expr::num::Nanos;

use crate::review::stream::Unsaid;

/// How both sides are executed, whatever the switches.
pub(super) struct Plan {
    pub(super) worlds: Vec<[World; 2]>,
    pub(super) starts: Vec<[Nanos; AXES]>,
    /// The tool in the spindle of both, as far as the source's T code is stated.
    pub(super) tool: Option<u32>,
    pub(super) muted: bool,
    /// With how many digits values stand in messages that have none too many.
    pub(super) in_full: Option<u8>,
    /// Whether both write to devices.
    pub(super) writes: bool,
    /// Whether both show what a program stop says.
    pub(super) stops_speak: bool,
    /// One of the texts has no blocks; both are for controls of different kinds.
    pub(super) lines: bool,
    pub(super) between_controls: bool,
    pub(super) unsaid: Unsaid,
    pub(super) in_inches: bool,
    pub(super) tolerance: Nanos,
    pub(super) resolution: Resolution,
    /// What the output's own digits resolve.
    pub(super) own: Resolution,
    pub(super) tools: ncc_exec::maps::Renaming,
    pub(super) alarms: Option<Alarms>,
    /// Optional stops switch spindle and coolant off on one of the controls.
    pub(super) optional_stops: bool,
    pub(super) seen: Seen,
}

impl Plan {
    pub(super) fn controls(&self, side: usize, skip: u16) -> Vec<Exec> {
        let control = |(worlds, start): (&[World; 2], &[Nanos; AXES])| {
            let mut exec = Exec::new(&worlds[side], skip);
            if side == 1 {
                exec.be_at(*start);
            }
            self.tool.into_iter().for_each(|tool| exec.hold_tool(tool));
            if self.muted {
                exec.mute(self.stops_speak);
            }
            if !self.writes {
                exec.without_output();
            }
            if let Some(digits) = self.in_full {
                exec.values_in_full(digits);
            }
            if self.lines {
                exec.without_blocks();
            }
            if self.between_controls {
                exec.between_controls();
            }
            exec
        };
        self.worlds.iter().zip(&self.starts).map(control).collect()
    }

    pub(super) fn comparisons(&self) -> Vec<Comparison> {
        let comparison = |start: &[Nanos; AXES]| {
            let mut comparison = Comparison::new(self.resolution, *start);
            comparison.rename_tools(self.tools.tools.clone(), &self.tools.tool_names);
            comparison.measure(self.tolerance);
            comparison.see(self.seen);
            comparison.say_alarms(self.alarms.clone());
            comparison.measure_by(self.own);
            if self.optional_stops {
                comparison.optional_stops();
            }
            if self.in_inches {
                comparison.as_inches();
            }
            comparison
        };
        self.starts.iter().map(comparison).collect()
    }
}
