//! The simplest decimals: parameters of patterns with as few digits as the holes allow.
//!
//! All lengths here are floats in the unit in which the program writes (millimetres or inches), all
//! angles degrees. Whatever is found is tried on the exact positions before it is taken.

use ncc_ir::expr::num::{Num, POW10, Unit};

/// A decimal: `mantissa × 10^-scale`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Decimal {
    pub(super) mantissa: i64,
    pub(super) scale: u8,
}

impl Decimal {
    pub(super) const ZERO: Decimal = Decimal { mantissa: 0, scale: 0 };

    /// The decimal with so many digits after the point that is nearest to a value.
    pub(super) fn near(value: f64, scale: u8) -> Decimal {
        let mut mantissa = (value * POW10[scale as usize] as f64).round() as i64;
        let mut scale = scale;
        while scale > 0 && mantissa % 10 == 0 {
            mantissa /= 10;
            scale -= 1;
        }
        Decimal { mantissa, scale }
    }

    /// Without its sign.
    pub(super) fn positive(self) -> Decimal {
        Decimal { mantissa: self.mantissa.abs(), ..self }
    }

    pub(super) fn value(self) -> f64 {
        self.mantissa as f64 / POW10[self.scale as usize] as f64
    }

    /// As a literal of a unit.
    pub(super) fn literal(self, unit: Unit) -> Num {
        Num { mantissa: self.mantissa, scale: self.scale, point: true, unit }
    }

    /// How many digits it takes to write.
    pub(super) fn digits(self) -> u32 {
        self.mantissa.unsigned_abs().checked_ilog10().map_or(1, |n| n + 1)
    }
}

/// A range of values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Range {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Range {
    /// Every value.
    pub(super) const ALL: Range = Range { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// Keeps what lies within `by` of a value as well.
    pub(super) fn keep(&mut self, value: f64, by: f64) {
        self.low = self.low.max(value - by);
        self.high = self.high.min(value + by);
    }

    /// Keeps what lies between two values as well.
    pub(super) fn between(&mut self, a: f64, b: f64) {
        self.low = self.low.max(a.min(b));
        self.high = self.high.min(a.max(b));
    }

    /// The same range elsewhere.
    pub(super) fn shifted(self, by: f64) -> Range {
        Range { low: self.low + by, high: self.high + by }
    }

    pub(super) fn is_empty(self) -> bool {
        self.low > self.high
    }

    fn middle(self) -> f64 {
        f64::midpoint(self.low, self.high)
    }

    /// The decimals with at most `most` digits after the point that lie within, one for each number
    /// of digits, simplest first.
    pub(super) fn decimals(self, most: u8) -> impl Iterator<Item = Decimal> {
        let mut last = None;
        (0..=most).filter_map(move |scale| {
            if self.is_empty() || !self.middle().is_finite() {
                return None;
            }
            let found = Decimal::near(self.middle(), scale);
            let within = self.low <= found.value() && found.value() <= self.high;
            (within && last.replace(found) != Some(found)).then_some(found)
        })
    }

    /// The simplest of them.
    pub(super) fn simplest(self, most: u8) -> Option<Decimal> {
        self.decimals(most).next()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fewest_digits_first() {
        let range = Range { low: 17.9996, high: 18.0004 };
        assert_eq!(range.simplest(3), Some(Decimal { mantissa: 18, scale: 0 }));
        let range = Range { low: 51.4281, high: 51.4289 };
        assert_eq!(range.simplest(1), None);
        assert_eq!(range.simplest(4), Some(Decimal { mantissa: 514_285, scale: 4 }));
        assert_eq!(Decimal::near(100.0, 3).digits(), 3);
    }
}
