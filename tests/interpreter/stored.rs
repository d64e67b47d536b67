//! What a program puts into the tables of a control: zeros of work offsets, lengths and radii of tools,
//! from `reference/fanuc.md` section 3 (G10).

use std::collections::BTreeMap;

use super::{Halt, Machine, Place, What};

/// Values that stand in the place of those that were there at the start.
#[derive(Clone, Debug, Default)]
pub(super) struct Stored {
    zeros: BTreeMap<u32, Place>,
    /// Degrees about Z.
    turns: BTreeMap<u32, f64>,
    positions: BTreeMap<u32, Place>,
    /// Length without wear, and wear.
    lengths: BTreeMap<u32, (f64, f64)>,
    /// What tools are put aside along X and Y (LinuxCNC, G10 L1), and how much of it is in force.
    asides: BTreeMap<u32, [f64; 2]>,
    /// Radii that the program has put into the table; `None` is what nobody knows any more.
    radii: BTreeMap<u32, Option<f64>>,
    aside: [f64; 2],
    /// Values of variables with a number that all programs share, as far as they are known.
    pub(super) variables: BTreeMap<u32, f64>,
}

impl Stored {
    /// The tool is out of the spindle.
    pub(super) fn nothing_in_force(&mut self) {
        self.aside = [0.0; 2];
    }

    /// Whether a program has put anything into the tables.
    pub(super) fn holds(&self) -> bool {
        let tables = self.zeros.len() + self.turns.len() + self.lengths.len() + self.radii.len();
        tables + self.variables.len() != 0
    }

    /// What an entry puts a tool aside; none where no program has said so.
    pub(super) fn aside_of(&self, entry: u32) -> [f64; 2] {
        self.asides.get(&entry).copied().unwrap_or_default()
    }
}

impl Machine {
    /// Zero of a work offset.
    pub(super) fn zero_of(&self, offset: u32) -> Place {
        self.stored.zeros.get(&offset).copied().unwrap_or_else(|| (self.setup.work_offset)(offset))
    }

    /// Degrees by which a work offset is turned about Z, with what G92 shifts in it (LinuxCNC, G10 L2 R).
    pub(super) fn turn_of(&self, offset: u32) -> f64 {
        self.stored.turns.get(&offset).copied().unwrap_or(0.0)
    }

    /// Turns a work offset and puts its zero into its table, for the axes with a value.
    pub(super) fn store_turned_zero(&mut self, offset: u32, values: [Option<f64>; 6], turn: f64) {
        let mut zero = self.zero_of(offset);
        for (axis, value) in values.into_iter().enumerate() {
            zero[axis] = value.unwrap_or(zero[axis]);
            self.settled[axis] &= offset != self.offset || value.is_none() && axis > 1;
        }
        self.stored.zeros.insert(offset, zero);
        self.stored.turns.insert(offset, turn);
        let mut shown = zero;
        if turn != 0.0 {
            shown[5] = turn;
        }
        let what = if turn == 0.0 { "zero" } else { "turned zero" };
        self.record(What::Data(what, offset, shown));
    }

    /// A length that is in no table, in place of the one in force or added to it (LinuxCNC, G43.1 and G43.2). It
    /// stands under one of two numbers that no table has.
    pub(super) fn use_stated_length(&mut self, value: f64, added: bool) {
        let sum = value + if added { self.length_of(self.entry) } else { 0.0 };
        let (under, aside) = (self.nameless(), self.stored.aside);
        self.stored.lengths.insert(under, (sum, 0.0));
        self.stored.asides.insert(under, aside);
        self.use_length(under);
    }

    fn nameless(&self) -> u32 {
        if self.entry == u32::MAX - 1 { u32::MAX - 2 } else { u32::MAX - 1 }
    }

    /// What the tool in force is put aside along X or Y.
    pub(super) fn aside(&self, axis: usize) -> f64 {
        self.stored.aside.get(axis).copied().unwrap_or(0.0)
    }

    /// It is put aside so from here on, and nothing moves.
    pub(super) fn use_aside(&mut self, aside: [f64; 2]) {
        if aside != self.stored.aside {
            self.settled[..2].fill(false);
        }
        self.stored.aside = aside;
    }

    /// Offsets along X, Y and Z in place of those in force, or added to them; the others stay (LinuxCNC, G43.1 and
    /// G43.2).
    pub(super) fn use_stated_offsets(&mut self, values: [Option<f64>; 3], added: bool) {
        let now = [self.aside(0), self.aside(1), self.length_of(self.entry)];
        let sum = |axis: usize| match values[axis] {
            None => now[axis],
            Some(value) if added => now[axis] + value,
            Some(value) => value,
        };
        let under = self.nameless();
        self.stored.lengths.insert(under, (sum(2), 0.0));
        self.stored.asides.insert(under, [sum(0), sum(1)]);
        self.use_length(under);
    }

    /// What is in force of an entry stays what it is, whatever its table says from here on (LinuxCNC, G10 L1).
    pub(super) fn hold_entry(&mut self, entry: u32) {
        if entry == self.entry {
            let under = self.nameless();
            self.stored.lengths.insert(under, (self.length_of(entry), 0.0));
            self.stored.asides.insert(under, self.stored.aside);
            self.entry = under;
        }
    }

    /// Puts into its table what a tool is put aside, for the axes with a value.
    pub(super) fn store_aside(&mut self, entry: u32, values: [Option<f64>; 2]) {
        let mut aside = self.stored.aside_of(entry);
        for (axis, value) in values.into_iter().enumerate() {
            let Some(value) = value else { continue };
            aside[axis] = value;
            self.stored.asides.insert(entry, aside);
            self.record(What::Data(["offset along X", "offset along Y"][axis], entry, alone(value)));
        }
    }

    /// Length of an entry, wear included, where a program has put it there.
    pub(super) fn stored_length(&self, entry: u32) -> Option<f64> {
        self.stored.lengths.get(&entry).map(|(bare, wear)| bare + wear)
    }

    /// Wear of an entry.
    pub(super) fn wear_of(&self, entry: u32) -> f64 {
        self.stored.lengths.get(&entry).map_or_else(|| (self.setup.wear)(entry), |(_, wear)| *wear)
    }

    /// What an entry puts a tool aside.
    pub(super) fn aside_of(&self, entry: u32) -> [f64; 2] {
        self.stored.aside_of(entry)
    }

    /// The offset of the tool in the spindle along an axis, as far as a program has put it into the table.
    pub(super) fn stored_offset(&self, axis: usize) -> Option<f64> {
        let tool = self.tool?;
        match axis {
            2 => self.stored_length(tool),
            _ => self.stored.asides.get(&tool).map(|aside| aside[axis]),
        }
    }

    /// A position that the control keeps, in machine coordinates.
    pub(super) fn position_of(&self, place: u32) -> Place {
        self.stored.positions.get(&place).copied().unwrap_or_else(|| (self.setup.stored)(place))
    }

    /// It is where the machine stands now.
    pub(super) fn store_position(&mut self, place: u32) {
        self.stored.positions.insert(place, self.at);
        self.record(What::Data("position", place, self.at));
    }

    /// The tool in the spindle has this number.
    pub(super) fn store_tool(&mut self, tool: u32) {
        self.tool = Some(tool);
        self.record(What::Data("tool", tool, [0.0; 6]));
    }

    /// Length of an entry, wear included.
    pub(super) fn length_of(&self, entry: u32) -> f64 {
        self.stored.lengths.get(&entry).map_or_else(|| (self.setup.length)(entry), |(bare, wear)| bare + wear)
    }

    /// Length of an edge of a tool; the first one is the entry with the tool's number, where a program has put
    /// something into it.
    pub(super) fn length_of_edge(&self, tool: Option<u32>, edge: u32) -> f64 {
        let stored = tool.filter(|_| edge == 1).and_then(|tool| self.stored.lengths.get(&tool));
        stored.map_or_else(|| (self.setup.edge_length)(tool, edge), |(bare, wear)| bare + wear)
    }

    /// Puts the zero of a work offset into its table, for the axes with a value.
    pub(super) fn store_zero(&mut self, offset: u32, values: [Option<f64>; 6], added: bool) {
        let mut zero = self.zero_of(offset);
        for (axis, value) in values.into_iter().enumerate() {
            let Some(value) = value else { continue };
            zero[axis] = if added { zero[axis] + value } else { value };
            // What an increment of such an axis counts from is undecided.
            self.settled[axis] &= offset != self.offset;
        }
        self.stored.zeros.insert(offset, zero);
        self.record(What::Data("zero", offset, zero));
    }

    /// Puts a length or its wear into the table of tools.
    pub(super) fn store_length(
        &mut self,
        entry: u32,
        value: f64,
        wear: bool,
        added: bool,
    ) -> Result<(), Halt> {
        if entry == self.entry {
            return self.halt("another length of the tool that is in use");
        }
        let own = (self.setup.wear)(entry);
        let there = ((self.setup.length)(entry) - own, own);
        let mut now = self.stored.lengths.get(&entry).copied().unwrap_or(there);
        let place = if wear { &mut now.1 } else { &mut now.0 };
        *place = if added { *place + value } else { value };
        self.stored.lengths.insert(entry, now);
        self.record(What::Data("length", entry, alone(now.0 + now.1)));
        Ok(())
    }

    /// The diameter of the tool in the spindle, as a program that asks is told; `None` is no tool, and what wear or
    /// an addition makes of it.
    pub(super) fn stored_diameter(&self) -> Option<f64> {
        let tool = self.tool.filter(|tool| *tool != 0)?;
        match self.stored.radii.get(&tool) {
            Some(radius) => radius.map(|radius| 2.0 * radius),
            None => Some((self.setup.diameter)(tool)),
        }
    }

    /// Puts a radius or its wear into that table.
    pub(super) fn store_radius(&mut self, entry: u32, value: f64, wear: bool, added: bool) {
        let table = match (wear, added) {
            (false, false) => "radius",
            (false, true) => "radius, added",
            (true, false) => "wear of the radius",
            (true, true) => "wear of the radius, added",
        };
        self.stored.radii.insert(entry, (!wear && !added).then_some(value));
        self.record(What::Data(table, entry, alone(value)));
    }
}

fn alone(value: f64) -> Place {
    [value, 0.0, 0.0, 0.0, 0.0, 0.0]
}
