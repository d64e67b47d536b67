//! System variables, from section 7.3 of `reference/fanuc.md`: where the last block ended (#5001), where the skip signal
//! came (#5061 to #5063: the last one with the length of the tool counted in, on a Haas without), work offsets (#5221 and
//! on, 20 apart; #7001 and on for G54.1), codes and words in force (#4001 to #4003, #4005, #4006, #4010, #4109, #4119,
//! #4120). Of the tables: #2001 and #2201 are wear and geometry of lengths (memory C), which a Haas has the other way
//! round; #10001 and #11001 are the same on a Fanuc. Where the axes are (#5021, #5041 with the length counted
//! in as in #5063) and the length in force (#5083), the work
//! offset (#4014, on a Haas #4012), H (#4111), counts of parts, on a Haas those of tools (#5401 to #5799). Any other stops.

use super::super::Per;
use super::super::setup::Counted;
use super::{Control, Halt};

impl Control {
    fn unit(&self) -> f64 {
        if self.m.inch { 25.4 } else { 1.0 }
    }

    /// What a system variable is worth now.
    pub(super) fn own(&self, number: u32) -> Option<f64> {
        let n = |number: u32| Some(f64::from(number));
        match number {
            5001..=5003 => {
                let axis = (number - 5001) as usize;
                let plain = self.m.beside.is_none() && !self.m.tip && !self.m.plane_set;
                (plain && self.m.settled[axis]).then(|| (self.m.at[axis] - self.m.shift(axis)) / self.unit())
            }
            5021..=5023 => {
                let axis = (number - 5021) as usize;
                let plain = self.m.beside.is_none() && !self.m.tip && !self.m.plane_set;
                (plain && self.m.settled[axis]).then(|| self.m.at[axis] / self.unit())
            }
            5041..=5043 => {
                let axis = (number - 5041) as usize;
                let turned = self.m.beside.is_some() || self.m.tip || self.m.plane_set;
                let above = if axis == 2 && !self.haas { self.m.length_of(self.m.entry) } else { 0.0 };
                let plain = !turned && self.m.settled[axis];
                plain.then(|| (self.m.at[axis] - self.m.shift(axis) + above) / self.unit())
            }
            5063 if self.haas => self.m.touched.map(|at| at[2] / self.unit()),
            5063 => self.m.touched_above.map(|z| z / self.unit()),
            5083 => Some(self.m.length_of(self.m.entry) / self.unit()),
            2001..=2400 => {
                let (entry, later) = ((number - 2001) % 200 + 1, number > 2200);
                Some(self.table_length(entry, later != self.haas) / self.unit())
            }
            10_001..=10_400 if !self.haas => Some(self.table_length(number - 10_000, false) / self.unit()),
            11_001..=11_400 if !self.haas => Some(self.table_length(number - 11_000, true) / self.unit()),
            3901 => Some((self.m.setup.counted)(Counted::Made, 0)),
            3902 if self.haas => Some((self.m.setup.counted)(Counted::Second, 0)),
            3902 => Some((self.m.setup.counted)(Counted::Wanted, 0)),
            5401..=5500 if self.haas => Some((self.m.setup.counted)(Counted::Fed, number - 5400)),
            5501..=5600 if self.haas => Some((self.m.setup.counted)(Counted::InSpindle, number - 5500)),
            5601..=5699 if self.haas => Some((self.m.setup.counted)(Counted::Limit, number - 5600)),
            5701..=5799 if self.haas => Some((self.m.setup.counted)(Counted::Used, number - 5700)),
            4012 if self.haas => (self.m.offset <= 6).then(|| f64::from(53 + self.m.offset)),
            4014 if !self.haas => (self.m.offset <= 6).then(|| f64::from(53 + self.m.offset)),
            4111 => (self.m.entry > 0).then(|| f64::from(self.m.entry)),
            5061 | 5062 => self.m.touched.map(|at| at[(number - 5061) as usize] / self.unit()),
            // What is in force of an arc, or of nothing that was said, is not asked here.
            4001 => (self.motion < 2).then(|| f64::from(self.motion)),
            4002 => n(self.m.plane),
            4003 => n(if self.m.absolute { 90 } else { 91 }),
            4005 => n(match self.m.per {
                Per::Minute => 94,
                Per::Turn => 95,
                Per::Move => 93,
            }),
            4006 => n(if self.m.inch { 20 } else { 21 }),
            4010 => n(if self.return_initial { 98 } else { 99 }),
            4109 => self.m.feed.map(|feed| feed / self.unit()),
            4119 => self.m.speed.filter(|_| !self.m.surface),
            4120 => self.m.selected.map(f64::from),
            // What counts in all work offsets is nothing in the worlds in which it runs, but for the zero of Z that the
            // operator has moved; a Haas's G52 is among it.
            5201..=5203 => (!self.haas || self.m.slots.shift() == [0.0; 6]).then_some(if number == 5203 {
                self.m.zero_moved / self.unit()
            } else {
                0.0
            }),
            _ => {
                let (offset, axis) = zero(number)?;
                Some(self.m.zero_of(offset)[axis] / self.unit())
            }
        }
    }

    /// A length in the table of tools, or its wear.
    fn table_length(&self, entry: u32, bare: bool) -> f64 {
        let wear = self.m.wear_of(entry);
        if bare { self.m.length_of(entry) - wear } else { wear }
    }

    /// Sets the zero of a work offset along an axis, or a length of a tool.
    pub(super) fn set_own(&mut self, number: u32, value: Option<f64>) -> Result<(), Halt> {
        // Single block, with functions waited for.
        if number == 3003 && [Some(0.0), Some(1.0)].contains(&value) {
            return Ok(());
        }
        let table = match number {
            2001..=2400 => Some(((number - 2001) % 200 + 1, (number > 2200) == self.haas)),
            10_001..=10_400 if !self.haas => Some((number - 10_000, true)),
            11_001..=11_400 if !self.haas => Some((number - 11_000, false)),
            _ => None,
        };
        if let (Some((entry, wear)), Some(value)) = (table, value) {
            let steps = if self.m.inch { 10_000.0 } else { 1000.0 };
            let value = (value * steps).round() / steps * self.unit();
            return self.m.store_length(entry, value, wear, false);
        }
        let (Some((offset, axis)), Some(value)) = (zero(number), value) else {
            return self.m.halt(format!("#{number} is set"));
        };
        let steps = if self.m.inch { 10_000.0 } else { 1000.0 };
        let mut values = [None; 6];
        values[axis] = Some((value * steps).round() / steps * self.unit());
        self.m.store_zero(offset, values, false);
        Ok(())
    }
}

/// The work offset and the axis of a variable.
fn zero(number: u32) -> Option<(u32, usize)> {
    let (first, from) = match number {
        5221..=5333 => (1, 5221),
        7001..=7953 => (7, 7001),
        _ => return None,
    };
    let (row, axis) = ((number - from) / 20, (number - from) % 20);
    (axis < 3).then_some((first + row, axis as usize))
}
