//! Maps of numbers from one machine to another: tools, length table entries, work offsets, programs.
//!
//! With tool 4 mapped to 10, `T4 M6` becomes `T10 M6`. A map is plain data without knowledge of the machines.
//! [`Maps`] goes from source numbers to target numbers; a pass writes by it. [`Renaming`] goes back;
//! verification judges by it. The two are separate, so that verification does not rely on the pass.
//!
//! Not here: the origin of the numbers (profiles), and the report of a number without a row.

use std::collections::{BTreeMap, BTreeSet};

use ncc_ir::canon::Modes;
use ncc_ir::program::Text;
use ncc_ir::program::numbered::Numbered;

/// Source numbers to target numbers. A map that is `None` keeps every number. In a map that is `Some`, the target
/// lacks each number without a row.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Maps {
    /// Tool numbers.
    pub tools: Option<BTreeMap<u32, u32>>,
    /// Tool names of the source to tool numbers of the target.
    pub tool_names: BTreeMap<Text, u32>,
    /// Entries of the length table. Entry 0 means no offset; it stays 0 and has no row.
    pub entries: Option<BTreeMap<u32, u32>>,
    /// Work offsets; 1 is the first (G54).
    pub offsets: Option<BTreeMap<u16, u16>>,
    /// Programs, by number or by name. Keys are in capitals.
    pub programs: BTreeMap<Text, Text>,
    /// If true, the target lacks a program number without a row; else that number stays.
    pub programs_in_force: bool,
    /// Program numbers that the target's machine already uses for named programs.
    pub program_numbers: BTreeSet<u32>,
    /// Names in the source's profile of numbers without a row. The target's profile lacks these names.
    pub unmatched: BTreeMap<(Numbered, u32), Text>,
    /// Target tool number to the target's length table entry, for tools whose entry has another number than the
    /// tool.
    pub edge_entries: BTreeMap<u32, u32>,
    /// Target tool number and edge to the target's length table entry, for edges other than the first.
    pub further_edges: BTreeMap<(u32, u32), u32>,
}

impl Maps {
    /// Whether every number stays as it is.
    pub fn is_empty(&self) -> bool {
        self.tools.is_none()
            && self.tool_names.is_empty()
            && self.entries.is_none()
            && self.offsets.is_none()
            && self.programs.is_empty()
            && !self.programs_in_force
    }

    /// The target's tool number; `None` if the target lacks the tool.
    pub fn tool(&self, number: u32) -> Option<u32> {
        self.tools.as_ref().map_or(Some(number), |map| map.get(&number).copied())
    }

    /// The target's length table entry; 0 stays 0. `None` if the target lacks it.
    pub fn entry(&self, number: u32) -> Option<u32> {
        self.entries.as_ref().filter(|_| number > 0).map_or(Some(number), |map| map.get(&number).copied())
    }

    /// The target's work offset number; `None` if the target lacks it.
    pub fn offset(&self, number: u16) -> Option<u16> {
        self.offsets.as_ref().map_or(Some(number), |map| map.get(&number).copied())
    }

    /// The target's name of a program; `None` if it has no row. Case does not matter.
    pub fn program(&self, name: &str) -> Option<&Text> {
        self.programs.get(name.to_ascii_uppercase().as_str())
    }

    /// Modes with the target's numbers. A number without a row stays.
    pub fn modes(&self, source: &Modes) -> Modes {
        Modes {
            work_offset: source.work_offset.map(|n| self.offset(n).unwrap_or(n)),
            length_offset: source.length_offset.map(|n| self.entry(n).unwrap_or(n)),
            ..*source
        }
    }
}

/// Target numbers back to source numbers. A map that is `None` keeps every number. In a map that is `Some`, the source
/// lacks each number without a row.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Renaming {
    /// Tool numbers.
    pub tools: Option<BTreeMap<u32, u32>>,
    /// Target tool numbers to tool names of the source.
    pub tool_names: BTreeMap<u32, Text>,
    /// Entries of the length table, without 0.
    pub entries: Option<BTreeMap<u32, u32>>,
    /// Work offsets; 1 is the first (G54).
    pub offsets: Option<BTreeMap<u16, u16>>,
    /// Target tool number to the target's length table entry of edge 1, for tools whose entry has another number.
    pub edge_entries: BTreeMap<u32, u32>,
}

impl Renaming {
    /// Whether every number stays as it is. Tool names do not count.
    pub fn is_empty(&self) -> bool {
        self.tools.is_none() && self.entries.is_none() && self.offsets.is_none()
    }
}
