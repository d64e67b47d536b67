//! Exact decimals: what a word's number is worth, and how it was written.
//!
//! A number is never a binary float: `X15.588` is the integer 15588 with three digits after the
//! point. Conversions of units are rationals. Arithmetic on positions is done in [`Nanos`].

/// A length, angle or time in billionths of its base unit: 1e-9 mm, 1e-9 degree, 1e-9 s; for a
/// feed, 1e-9 mm/min; for a spindle speed, 1e-9 rev/min. Range about ±9.2e9 of the base unit.
pub type Nanos = i64;

/// Nanos in one base unit.
pub const ONE: Nanos = 1_000_000_000;

/// The unit of a literal.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Unit {
    /// A pure number: a count, a tool number, a spindle speed in rev/min.
    #[default]
    One,
    /// Millimetres; as a feed, millimetres a minute.
    Mm,
    /// Inches; as a feed, inches a minute.
    Inch,
    /// A length whose unit is the active one when the statement runs.
    Entry,
    /// Degrees; as the feed of a rotary axis, degrees a minute.
    Degree,
    /// Seconds.
    Second,
}

/// A decimal literal: `mantissa × 10^-scale` of its unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Num {
    /// All the digits, with the sign.
    pub mantissa: i64,
    /// Digits after the point, 0 to 18.
    pub scale: u8,
    /// Whether a decimal point was written. `false` only where `scale` is 0.
    pub point: bool,
    /// What it counts.
    pub unit: Unit,
}

/// Powers of ten that fit an `i64`.
pub const POW10: [i64; 19] = {
    let mut table = [1i64; 19];
    let mut i = 1;
    while i < 19 {
        table[i] = table[i - 1] * 10;
        i += 1;
    }
    table
};

impl Num {
    /// A whole number without a point.
    pub const fn int(value: i64, unit: Unit) -> Num {
        Num { mantissa: value, scale: 0, point: false, unit }
    }

    /// The literal nearest to `nanos` with `decimals` (0 to 9) digits after the point, half away
    /// from zero, trailing zeros removed.
    pub fn from_nanos(nanos: Nanos, decimals: u8, unit: Unit) -> Num {
        let step = POW10[9 - decimals.min(9) as usize];
        let half = if nanos < 0 { -(step / 2) } else { step / 2 };
        let rounded = (i128::from(nanos) + i128::from(half)) / i128::from(step);
        Num { mantissa: rounded as i64, scale: decimals.min(9), point: true, unit }.trimmed()
    }

    /// The nearest literal with at most so many digits after the point, half away from zero.
    pub fn rounded(self, digits: u8) -> Num {
        let Some(excess) = self.scale.checked_sub(digits).filter(|excess| *excess > 0) else { return self };
        let by = i128::from(POW10[usize::from(excess).min(POW10.len() - 1)]);
        let half = if self.mantissa < 0 { -by / 2 } else { by / 2 };
        let mantissa = ((i128::from(self.mantissa) + half) / by) as i64;
        Num { mantissa, scale: digits, ..self }
    }

    /// The same value without trailing zeros after the point.
    pub fn trimmed(mut self) -> Num {
        while self.scale > 0 && self.mantissa % 10 == 0 {
            self.mantissa /= 10;
            self.scale -= 1;
        }
        self
    }

    /// The exact sum of two numbers of one unit, with no more digits than needed; `None` if it is out of range, or the
    /// units differ. Nothing has any unit.
    pub fn plus(self, other: Num) -> Option<Num> {
        if other.is_zero() {
            return Some(self);
        }
        if self.is_zero() {
            return Some(other);
        }
        if self.unit != other.unit {
            return None;
        }
        let scale = self.scale.max(other.scale);
        let wide = |n: Num| n.mantissa.checked_mul(*POW10.get(usize::from(scale - n.scale))?);
        let mantissa = wide(self)?.checked_add(wide(other)?)?;
        let sum = Num { mantissa, scale, point: self.point || other.point, unit: self.unit };
        // A sum of two numbers in range may not be.
        sum.nanos(true)?;
        Some(sum)
    }

    /// The exact difference of two numbers of one unit, as [`Num::plus`].
    pub fn minus(self, other: Num) -> Option<Num> {
        self.plus(Num { mantissa: other.mantissa.checked_neg()?, ..other })
    }

    /// So many of it; `None` if that is out of range.
    pub fn times(self, count: i64) -> Option<Num> {
        let product = Num { mantissa: self.mantissa.checked_mul(count)?, ..self };
        product.nanos(true)?;
        Some(product)
    }

    /// Whether the value is zero.
    pub fn is_zero(self) -> bool {
        self.mantissa == 0
    }

    /// The value as a whole number, if it is one.
    pub fn whole_number(self) -> Option<i64> {
        let t = self.trimmed();
        (t.scale == 0).then_some(t.mantissa)
    }

    /// The value in base units (inches become millimetres), in nanos: exact, or `None` if it is
    /// out of range or has digits finer than a nano. `inch` says what [`Unit::Entry`] means.
    #[inline]
    pub fn nanos(self, inch: bool) -> Option<Nanos> {
        let factor = match self.unit {
            Unit::Inch => 254,
            Unit::Entry if inch => 254,
            Unit::One | Unit::Mm | Unit::Entry | Unit::Degree | Unit::Second => {
                return match 9u8.checked_sub(self.scale) {
                    Some(up) => self.mantissa.checked_mul(POW10[up as usize]),
                    None => exact_div(self.mantissa, self.scale - 9),
                };
            }
        };
        // An inch is 254e-1 mm, so one digit after the point is used up by the factor.
        let tenth = self.mantissa.checked_mul(factor)?;
        match 8u8.checked_sub(self.scale) {
            Some(up) => tenth.checked_mul(POW10[up as usize]),
            None => exact_div(tenth, self.scale - 8),
        }
    }
}

fn exact_div(value: i64, digits: u8) -> Option<Nanos> {
    let by = *POW10.get(digits as usize)?;
    (value % by == 0).then_some(value / by)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_inch_is_exactly_25_4_mm() {
        let n = Num { mantissa: 15, scale: 1, point: true, unit: Unit::Inch };
        assert_eq!(n.nanos(false), Some(38_100_000_000));
        let fine = Num { mantissa: 1, scale: 8, point: true, unit: Unit::Inch };
        assert_eq!(fine.nanos(false), Some(254));
        let finer = Num { mantissa: 1, scale: 10, point: true, unit: Unit::Inch };
        assert_eq!(finer.nanos(false), None);
    }

    #[test]
    fn sums_stay_in_their_unit() {
        let inch = |mantissa, scale| Num { mantissa, scale, point: true, unit: Unit::Inch };
        assert_eq!(inch(25, 2).plus(inch(5, 1)), Some(inch(75, 2)));
        assert_eq!(inch(25, 2).minus(inch(5, 1)), Some(inch(-25, 2)));
        assert_eq!(inch(5, 1).times(3), Some(inch(15, 1)));
        assert_eq!(inch(5, 1).plus(Num::int(1, Unit::Mm)), None);
        assert_eq!(Num::int(0, Unit::One).plus(inch(5, 1)), Some(inch(5, 1)));
        assert_eq!(inch(i64::MAX, 0).times(2), None);
    }

    #[test]
    fn rounding_is_half_away_from_zero() {
        assert_eq!(Num::from_nanos(1_000_500_000, 3, Unit::Mm).mantissa, 1001);
        assert_eq!(Num::from_nanos(-1_000_500_000, 3, Unit::Mm).mantissa, -1001);
        assert_eq!(Num::from_nanos(15_588_457_268, 3, Unit::Mm).mantissa, 15588);
        let written = |mantissa, scale| Num { mantissa, scale, point: true, unit: Unit::Inch };
        assert_eq!(written(48_915, 4).rounded(3), written(4892, 3));
        assert_eq!(written(-48_915, 4).rounded(3), written(-4892, 3));
        assert_eq!(written(48_914, 4).rounded(3), written(4891, 3));
        assert_eq!(written(48_915, 4).rounded(4), written(48_915, 4));
    }
}
