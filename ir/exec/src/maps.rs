//! Maps from one machine to another: which number a tool, an entry of the length table, a work offset
//! or a program has there.
//!
//! A map is plain data: whoever makes it knows the machines, whoever uses it does not. Two forms
//! serve two sides that must not rest on each other: [`Maps`] goes from the source's numbers to the
//! target's, and a pass writes by it; [`Renaming`] maps back, and verification judges by it.
//!
//! Not here: where the numbers come from, and what is done about one that has none.

use std::collections::{BTreeMap, BTreeSet};

use ncc_ir::canon::Modes;
use ncc_ir::program::Text;
use ncc_ir::program::numbered::Numbered;

/// The target's numbers of what the source calls by its own. A map that is `None` is not active:
/// numbers stay as they are. In one that is, a number that has no row is not known to the target.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Maps {
    /// Tools.
    pub tools: Option<BTreeMap<u32, u32>>,
    /// Tools that the source calls by name, where the target calls them by number.
    pub tool_names: BTreeMap<Text, u32>,
    /// Entries of the length table; 0, which is none, is always 0 and has no row.
    pub entries: Option<BTreeMap<u32, u32>>,
    /// Work offsets; 1 is the first.
    pub offsets: Option<BTreeMap<u16, u16>>,
    /// Programs, by number or by name in capitals.
    pub programs: BTreeMap<Text, Text>,
    /// Whether a program whose number has no row is not known to the target; else it keeps it.
    pub programs_in_force: bool,
    /// Numbers of programs that the target's machine has by name already.
    pub program_numbers: BTreeSet<u32>,
    /// Names that the source's machine has for numbers without a row: the target's has none of that
    /// name.
    pub unmatched: BTreeMap<(Numbered, u32), Text>,
    /// The entry of the target's length table that has a tool's length, by the target's number of the
    /// tool, where it is not that number.
    pub edge_entries: BTreeMap<u32, u32>,
    /// The entry of the target's length table that another edge than the first of a tool has, by the target's number of
    /// the tool and the edge.
    pub further_edges: BTreeMap<(u32, u32), u32>,
}

impl Maps {
    /// Whether nothing is mapped.
    pub fn is_empty(&self) -> bool {
        self.tools.is_none()
            && self.tool_names.is_empty()
            && self.entries.is_none()
            && self.offsets.is_none()
            && self.programs.is_empty()
            && !self.programs_in_force
    }

    /// The target's number of a tool; `None` if it has none.
    pub fn tool(&self, number: u32) -> Option<u32> {
        self.tools.as_ref().map_or(Some(number), |map| map.get(&number).copied())
    }

    /// The target's entry for an entry of the length table.
    pub fn entry(&self, number: u32) -> Option<u32> {
        self.entries.as_ref().filter(|_| number > 0).map_or(Some(number), |map| map.get(&number).copied())
    }

    /// The target's number of a work offset.
    pub fn offset(&self, number: u16) -> Option<u16> {
        self.offsets.as_ref().map_or(Some(number), |map| map.get(&number).copied())
    }

    /// What the target calls a program by, if that is something else.
    pub fn program(&self, name: &str) -> Option<&Text> {
        self.programs.get(name.to_ascii_uppercase().as_str())
    }

    /// Facts in the target's numbers; one that it has none for stays.
    pub fn modes(&self, source: &Modes) -> Modes {
        Modes {
            work_offset: source.work_offset.map(|n| self.offset(n).unwrap_or(n)),
            length_offset: source.length_offset.map(|n| self.entry(n).unwrap_or(n)),
            ..*source
        }
    }
}

/// The way back: what the source calls what the target's text says. `None` is the same number; in a
/// map that is there, what has no row is something that the source has not.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Renaming {
    /// Tools.
    pub tools: Option<BTreeMap<u32, u32>>,
    /// Names by which the source may call tools, by the target's numbers.
    pub tool_names: BTreeMap<u32, Text>,
    /// Entries of the length table, without 0.
    pub entries: Option<BTreeMap<u32, u32>>,
    /// Work offsets.
    pub offsets: Option<BTreeMap<u16, u16>>,
    /// The entry of the target's length table that edge 1 of a tool has, where it is not the tool's
    /// number; both in the target's numbers.
    pub edge_entries: BTreeMap<u32, u32>,
}

impl Renaming {
    /// Whether every number is its own; a tool that the source calls by name has none.
    pub fn is_empty(&self) -> bool {
        self.tools.is_none() && self.entries.is_none() && self.offsets.is_none()
    }
}
