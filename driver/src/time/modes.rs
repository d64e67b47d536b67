//! The modes behind each block, as the program is executed.
//!
//! A mode that neither the program nor an assumption has set is not known: a control has a value for it, and nobody knows
//! which. Not here: the codes that a dialect has for them (`simulate::modes`).

use std::collections::HashMap;
use std::rc::Rc;

use ncc_exec::{Coolant, Exec, named_tool};
use ncc_ir::canon::{Modes, Motion, Side, Spindle, SpindleMode};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{CutterRadius, Op, Stmt};
use ncc_ir::track::Tracker;

/// Whose length is active.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Length {
    /// An entry of the length table, which is edge 1 of the tool with its number too; 0 is none.
    Entry(u32),
    /// An edge of a tool; -1 is a tool that nobody named.
    Edge(i64, u32),
}

/// Modes that are active behind a block; `None` is not known.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Active {
    /// Motion, plane, distance, units, feed mode, return level, work offset.
    pub modes: Modes,
    /// Kind of the canned cycle that is active.
    pub cycle: Option<&'static str>,
    /// Cutter compensation: its side, or none, and the entry that its block names.
    pub compensation: Option<Option<(Side, Option<u32>)>>,
    /// The tool length offset.
    pub length: Option<Length>,
    /// Sense of the spindle.
    pub spindle: Option<Spindle>,
    /// What its speed counts.
    pub spindle_mode: Option<SpindleMode>,
    /// Its speed in the unit of its mode, nanos.
    pub speed: Option<Nanos>,
    /// Feed in the unit of its mode, mm in nanos.
    pub feed: Option<Nanos>,
    /// Coolants.
    pub coolant: Option<Coolant>,
    /// The tool in the spindle; less than -1 is one with a name.
    pub tool: Option<i64>,
}

/// Follows the modes of a program.
#[derive(Debug, Default)]
pub struct Followed {
    /// What is active now.
    pub active: Active,
    tracker: Tracker,
    names: HashMap<i64, Rc<str>>,
    /// Blocks that were executed.
    executed: u64,
    /// Whether the last statement goes on with the block of the one before.
    pub joined: bool,
}

impl Followed {
    /// The name of the tool in the spindle, if it has one.
    pub fn tool_name(&self) -> Option<&str> {
        self.active.tool.and_then(|tool| self.names.get(&tool)).map(|name| &**name)
    }

    /// How many blocks have been executed.
    pub fn executed(&self) -> u64 {
        self.executed
    }

    /// Takes facts for granted that the program relies on.
    pub(super) fn assume(&mut self, facts: Modes) {
        self.tracker.modes = self.tracker.modes.or(facts);
    }

    /// Another line was passed that is executed as the one before.
    pub(super) fn pass(&mut self) {
        self.executed += 1;
        self.joined = false;
    }

    /// Takes a statement that was executed.
    pub(super) fn step(&mut self, stmt: &Stmt, exec: &Exec) {
        self.executed += 1;
        self.joined = stmt.joined;
        // A tracker expects other paths at a label. Here is one path, and its statements come one by one.
        if !matches!(stmt.op, flow!()) {
            self.tracker.apply(&stmt.op);
        }
        let own = &mut self.active;
        match stmt.op.unwrapped() {
            Op::StartCutterRadiusCompensation { side, radius } => {
                let entry = match radius {
                    CutterRadius::Entry(entry) => entry.literal().and_then(|number| number.whole_number()),
                    CutterRadius::Tool | CutterRadius::InForce | CutterRadius::Diameter(_) => None,
                };
                own.compensation = Some(Some((*side, entry.and_then(|entry| u32::try_from(entry).ok()))));
            }
            Op::StopCutterRadiusCompensation => own.compensation = Some(None),
            Op::SelectToolByName(name) => {
                self.names.insert(named_tool(name), Rc::from(&**name));
            }
            _ => {}
        }
        let state = exec.state();
        own.modes = self.tracker.modes;
        own.cycle = match own.modes.motion {
            Some(Motion::Cycle) => self.tracker.cycle.as_ref().map(|own| own.cycle.kind.name()),
            _ => None,
        };
        let edge = exec.length_edge().map(|(tool, edge)| Length::Edge(tool, edge));
        let entry = || own.modes.length_offset.and_then(|_| exec.length_entry()).map(Length::Entry);
        own.length = edge.or_else(entry);
        let switched = matches!(stmt.op.unwrapped(), Op::FloodOn | Op::MistOn | Op::CoolantOff);
        if switched || own.coolant.is_some() {
            own.coolant = Some(state.coolant());
        }
        if self.tracker.spindle.is_some() || state.spindle != Spindle::Stopped {
            own.spindle = Some(state.spindle);
        }
        own.spindle_mode = (state.speed != 0).then_some(state.spindle_mode);
        own.speed = (state.speed != 0).then_some(state.speed);
        own.feed = (exec.feed() != 0).then(|| exec.feed());
        own.tool = (state.tool != -1).then_some(state.tool);
    }
}
