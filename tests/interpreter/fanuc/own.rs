//! System variables, from section 7.3 of `reference/fanuc.md`: where the last block ended (#5001), where the skip signal
//! came (#5061, #5062: what of a tool's length is in #5063 is left open), work offsets (#5221 and
//! on, 20 apart; #7001 and on for G54.1), codes and words in force (#4002, #4003, #4005, #4006, #4010, #4109, #4119,
//! #4120). Any other stops.

use super::super::Per;
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
            5061 | 5062 => self.m.touched.map(|at| at[(number - 5061) as usize] / self.unit()),
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
            _ => {
                let (offset, axis) = zero(number)?;
                Some(self.m.zero_of(offset)[axis] / self.unit())
            }
        }
    }

    /// Sets the zero of a work offset along an axis.
    pub(super) fn set_own(&mut self, number: u32, value: Option<f64>) -> Result<(), Halt> {
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
