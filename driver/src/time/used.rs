//! Coolants of each tool, and work offsets: what a setup sheet has besides the times.
//!
//! Not here: times and extents of the tools (`tally`), and the sheet.

use std::collections::BTreeSet;
use std::io;

use ncc_dialects::Dialect;
use ncc_exec::{Coolant, Kind};
use ncc_time::Timed;
use serde::Serialize;

use super::drive::{Said, Sink};
use super::tally::Tallier;
use crate::render::spelled;

/// The coolants of a tool while it cuts.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Cooled {
    /// Its number; `None` is the one in the spindle at the start.
    pub tool: Option<i64>,
    /// `off`, `flood`, `mist` or `flood+mist`, each once, in the order of its moves.
    pub coolants: Vec<&'static str>,
}

/// The coolants that are on, in words.
fn words(on: Coolant) -> &'static str {
    match (on.flood, on.mist) {
        (false, false) => "off",
        (true, false) => "flood",
        (false, true) => "mist",
        (true, true) => "flood+mist",
    }
}

/// Counts times, and notes coolants beside them.
pub struct Noted {
    /// Times and extents.
    pub tallier: Tallier,
    /// Coolants by tool, in the order of their first feed moves.
    pub cooled: Vec<Cooled>,
}

impl Sink for Noted {
    fn wants_reach(&self) -> bool {
        self.tallier.wants_reach()
    }

    fn wants_bounds(&self) -> bool {
        self.tallier.wants_bounds()
    }

    fn function(&mut self, timed: &Timed, said: &Said) -> io::Result<()> {
        let event = &timed.act.event;
        if matches!(event.kind, Kind::Feed | Kind::Synchronised { .. } | Kind::Arc { .. }) {
            let tool = Some(event.state.tool).filter(|tool| *tool >= 0);
            let at = self.cooled.iter().position(|own| own.tool == tool).unwrap_or_else(|| {
                self.cooled.push(Cooled { tool, coolants: Vec::new() });
                self.cooled.len() - 1
            });
            let coolant = words(event.state.coolant());
            if !self.cooled[at].coolants.contains(&coolant) {
                self.cooled[at].coolants.push(coolant);
            }
        }
        self.tallier.function(timed, said)
    }
}

/// Work offsets by the words that a dialect has for them.
pub fn offsets(numbers: &BTreeSet<u16>, dialect: &Dialect) -> Vec<String> {
    numbers.iter().map(|number| spelled::work_offset(*number, [dialect; 2])).collect()
}
