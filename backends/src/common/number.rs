//! Numbers as a control writes them: digits, the point, the range.
//!
//! A number keeps its digits if the control resolves them; else it is rounded half away from zero.
//! All digits come from a table. No binary float is used.
//! Not here: the meaning of a number, and the rounding errors of incremental words.

use ncc_dialects::{NumberRules, PointRule, Quantity};
use ncc_ir::expr::num::{Num, ONE, POW10, Unit};

/// Most significant digits of a word, unless a dictionary says otherwise (FANUC 16-C, ranges of IS-B:
/// X ±99999.999 mm, P and T 8 digits).
const DIGITS: u8 = 8;

/// Most digits in any dialect.
const MOST_DIGITS: u8 = 9;

/// Longest number in bytes: sign, nine digits or a zero and nine places, the point.
pub(crate) const LONGEST: usize = 12;

/// Bytes that [`write`] may overwrite from its start; it writes four at a time.
pub(crate) const ROOM: usize = 20;

/// How numbers of one quantity are written.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Format {
    /// Digits after the point, in mm (or degrees, seconds, …) and in inches.
    pub decimals: [u8; 2],
    /// Most significant digits.
    pub digits: u8,
    pub point: PointRule,
    /// Whether the control takes no negative value.
    pub unsigned: bool,
    /// Whether it counts something: rounding would change its meaning.
    pub counts: bool,
    /// Digits to which the control rounds a computed value, in mm (or degrees, seconds, …) and in inches;
    /// `None` if a machine parameter decides.
    pub rounds: Option<[u8; 2]>,
}

impl Format {
    pub(crate) fn new(rules: NumberRules, counts: bool) -> Format {
        Format {
            decimals: [rules.decimals.min(9), rules.decimals_inch.unwrap_or(rules.decimals).min(9)],
            digits: rules.digits.unwrap_or(DIGITS).min(MOST_DIGITS),
            point: rules.point,
            unsigned: rules.unsigned,
            counts,
            rounds: None,
        }
    }

    /// The same format, for a quantity whose computed values the control rounds.
    pub(crate) fn rounding(self, rules: NumberRules, quantity: Quantity) -> Format {
        let rounds = match quantity {
            Quantity::Length => Some([rules.increment, rules.increment_inch.unwrap_or(rules.increment)]),
            Quantity::Angle | Quantity::Seconds => Some([rules.increment; 2]),
            Quantity::Speed | Quantity::Integer | Quantity::Milliseconds => Some([0; 2]),
            Quantity::Feed | Quantity::Factor => None,
        };
        Format { rounds, ..self }
    }

    /// Digits after the point for a literal's unit.
    #[inline]
    pub(crate) fn decimals_for(&self, unit: Unit) -> u8 {
        match unit {
            Unit::Inch => self.decimals[1],
            Unit::Entry => self.decimals[0].max(self.decimals[1]),
            Unit::One | Unit::Mm | Unit::Degree | Unit::Second => self.decimals[0],
        }
    }
}

/// A number ready to be written: `mantissa × 10^-scale`, below 10^9 without its point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shaped {
    pub mantissa: i32,
    pub scale: u8,
    pub point: bool,
    /// Whether digits were lost.
    pub rounded: bool,
}

impl Shaped {
    /// The value as written, in `unit`.
    pub(crate) fn num(self, unit: Unit) -> Num {
        Num { mantissa: i64::from(self.mantissa), scale: self.scale, point: self.point, unit }
    }
}

/// The value after a letter.
#[derive(Clone, Copy, Debug)]
pub(crate) enum WordValue {
    /// A number.
    Number(Shaped),
    /// A run-time value: its index among the formulas of the block.
    Formula(u16),
}

impl From<Shaped> for WordValue {
    fn from(shaped: Shaped) -> WordValue {
        WordValue::Number(shaped)
    }
}

/// Why a number cannot be written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unwritable {
    /// Too large, or negative without a sign.
    Range,
    /// A count with a fraction.
    NotWhole,
    /// Finer than the control resolves, in an unknown unit: it cannot be rounded.
    Fineness,
}

/// Whether the point is written.
#[inline(always)]
fn point(rule: PointRule, mantissa: i64, scale: u8, written: bool) -> bool {
    match rule {
        PointRule::Always => true,
        PointRule::ExceptZero => written || mantissa != 0,
        PointRule::WhereNeeded | PointRule::Never => scale > 0,
    }
}

/// A number whose digits can all stay; `None` sends it to [`shape`].
#[inline(always)]
pub(crate) fn plain(n: Num, f: &Format) -> Option<Shaped> {
    let decimals = f.decimals_for(n.unit);
    if n.scale > decimals {
        return None;
    }
    let limit = POW10[usize::from(f.digits.saturating_sub(decimals - n.scale))];
    if n.mantissa >= limit || n.mantissa <= -limit || (n.mantissa < 0 && f.unsigned) {
        return None;
    }
    Some(Shaped {
        mantissa: n.mantissa as i32,
        scale: n.scale,
        point: point(f.point, n.mantissa, n.scale, n.point),
        rounded: false,
    })
}

/// A number in the control's digits.
///
/// # Errors
/// It is out of range, a count that is not whole, or too fine and of unknown unit.
pub(crate) fn shape(n: Num, f: &Format) -> Result<Shaped, Unwritable> {
    if let Some(shaped) = plain(n, f) {
        return Ok(shaped);
    }
    let decimals = f.decimals_for(n.unit);
    let Some(excess) = n.scale.checked_sub(decimals).filter(|e| *e > 0) else {
        return Err(Unwritable::Range);
    };
    let by = POW10.get(usize::from(excess)).copied().unwrap_or(i64::MAX);
    let (whole, rest) = (n.mantissa / by, n.mantissa % by);
    let lost = rest != 0;
    if lost && f.counts {
        return Err(Unwritable::NotWhole);
    }
    if lost && n.unit == Unit::Entry {
        return Err(Unwritable::Fineness);
    }
    // `by` is even, so that half of it is exact.
    let away = i64::from(rest.abs() >= by - by / 2) * n.mantissa.signum();
    let mut kept = Num { mantissa: whole + away, scale: decimals, point: true, unit: n.unit };
    if lost {
        kept = kept.trimmed();
    }
    let shaped = plain(kept, f).ok_or(Unwritable::Range)?;
    Ok(Shaped { rounded: lost, ..shaped })
}

/// The number of the unit nearest to `nanos` of base units.
pub(crate) fn from_nanos(nanos: i64, f: &Format, unit: Unit) -> Num {
    let decimals = f.decimals_for(unit);
    if unit != Unit::Inch {
        return Num::from_nanos(nanos, decimals, unit);
    }
    // An inch is 254e-1 mm.
    let up = i128::from(nanos) * i128::from(POW10[usize::from(decimals)]) * 10;
    let step = 254 * i128::from(ONE);
    let half = if nanos < 0 { -step / 2 } else { step / 2 };
    let mantissa = ((up + half) / step) as i64;
    Num { mantissa, scale: decimals, point: true, unit }.trimmed()
}

/// Seconds as whole milliseconds; the second value says whether digits were lost.
pub(crate) fn milliseconds(n: Num) -> Option<(Num, bool)> {
    let ms = |mantissa| Num::int(mantissa, Unit::One);
    if n.scale <= 3 {
        return Some((ms(n.mantissa.checked_mul(POW10[usize::from(3 - n.scale)])?), false));
    }
    let by = *POW10.get(usize::from(n.scale - 3))?;
    let (whole, rest) = (n.mantissa / by, n.mantissa % by);
    let away = i64::from(rest.abs() >= by - by / 2) * n.mantissa.signum();
    Some((ms(whole + away), rest != 0))
}

/// The digits of 0 to 999, and in the fourth byte how many zeros lead. Its length is a power of two
/// so that a mask bounds the index.
static GROUPS: [[u8; 4]; 1024] = {
    let mut table = [[0u8; 4]; 1024];
    let mut i = 0;
    while i < 1000 {
        let lead = if i < 10 {
            2
        } else if i < 100 {
            1
        } else {
            0
        };
        table[i] = [b'0' + (i / 100) as u8, b'0' + (i / 10 % 10) as u8, b'0' + (i % 10) as u8, lead];
        i += 1;
    }
    table
};

/// Writes the last `3 - skip` digits of a group; the byte after them is overwritten too.
#[inline(always)]
fn group<const N: usize>(to: &mut [u8; N], at: usize, value: u32, skip: u8) -> usize {
    let word = u32::from_le_bytes(GROUPS[value as usize & 1023]) >> (8 * u32::from(skip));
    to[at..at + 4].copy_from_slice(&word.to_le_bytes());
    at + 3 - usize::from(skip)
}

#[inline(always)]
fn leading<const N: usize>(to: &mut [u8; N], at: usize, value: u32) -> usize {
    group(to, at, value, GROUPS[value as usize & 1023][3])
}

/// Writes a whole number below 10^9 without sign.
#[inline(always)]
pub(crate) fn write_digits<const N: usize>(to: &mut [u8; N], at: usize, value: u32) -> usize {
    if value < 1000 {
        leading(to, at, value)
    } else if value < 1_000_000 {
        let at = leading(to, at, value / 1000);
        group(to, at, value % 1000, 0)
    } else {
        let at = leading(to, at, value / 1_000_000);
        let at = group(to, at, value / 1000 % 1000, 0);
        group(to, at, value % 1000, 0)
    }
}

/// Writes a number from `at` on and returns where it ends. At most [`LONGEST`] bytes, and it
/// touches at most [`ROOM`].
#[inline(always)]
pub(crate) fn write<const N: usize>(to: &mut [u8; N], mut at: usize, n: Shaped) -> usize {
    let value = n.mantissa.unsigned_abs();
    // A zero has no sign, so that `-0.` cannot come about.
    to[at] = b'-';
    at += usize::from(n.mantissa < 0);
    let scale = usize::from(n.scale);
    if let Some(up) = THOUSANDTHS.get(scale) {
        let thousandths = u64::from(value) * up;
        at = write_digits(to, at, (thousandths / 1000) as u32);
        to[at] = b'.';
        group(to, at + 1, (thousandths % 1000) as u32, 0);
        return at + usize::from(n.point || scale > 0) + scale;
    }
    let scale = scale.min(9);
    let by = POW10[scale] as u32;
    at = write_digits(to, at, value / by);
    to[at] = b'.';
    let mut rest = value % by;
    let end = at + 1 + scale;
    for place in (at + 1..end).rev() {
        to[place] = b'0' + (rest % 10) as u8;
        rest /= 10;
    }
    end
}

/// Thousandths in one least increment, by digits after the point.
static THOUSANDTHS: [u64; 4] = [1000, 100, 10, 1];

/// A number as text, for diagnostics and for words off the hot path.
pub(crate) fn append(to: &mut Vec<u8>, n: Shaped) {
    let mut room = [0; ROOM];
    let end = write(&mut room, 0, n);
    to.extend_from_slice(&room[..end]);
}

/// A word that says by itself from where it is measured: `X=IC(5)`.
pub(crate) fn qualified(address: impl std::fmt::Display, qualifier: &str, n: Shaped) -> String {
    let mut digits = Vec::new();
    append(&mut digits, n);
    format!("{address}={qualifier}({})", String::from_utf8_lossy(&digits))
}

/// A literal as it was written, for diagnostics.
pub(crate) fn spell(letter: u8, n: Num) -> Box<str> {
    let sign = if n.mantissa < 0 { "-" } else { "" };
    let digits = n.mantissa.unsigned_abs().to_string();
    let scale = usize::from(n.scale);
    let digits = format!("{digits:0>width$}", width = scale + 1);
    let (whole, rest) = digits.split_at(digits.len() - scale);
    let point = if n.point || scale > 0 { "." } else { "" };
    format!("{}{sign}{whole}{point}{rest}", letter as char).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn format(decimals: u8, inch: u8, point: PointRule) -> Format {
        Format {
            decimals: [decimals, inch],
            digits: DIGITS,
            point,
            unsigned: false,
            counts: false,
            rounds: None,
        }
    }

    fn num(mantissa: i64, scale: u8) -> Num {
        Num { mantissa, scale, point: scale > 0, unit: Unit::Mm }
    }

    fn text(n: Num, f: &Format) -> String {
        let mut to = Vec::new();
        append(&mut to, shape(n, f).expect("writable"));
        String::from_utf8(to).expect("digits")
    }

    #[test]
    fn digits_are_those_of_the_number() {
        let f = format(3, 4, PointRule::WhereNeeded);
        for n in [0, 1, -1, 9, 10, 99, 100, 999, 1000, 1001, 12_345, -99_999] {
            assert_eq!(text(num(n, 0), &f), n.to_string());
        }
        let fine = format(9, 9, PointRule::Always);
        for scale in 0..=7u8 {
            for m in [0i64, 1, -1, 5, 10, 12_345, -67_890, 999_999, 1_000_000, 99_999_999] {
                let Ok(s) = shape(num(m, scale), &Format { decimals: [scale, scale], ..fine }) else {
                    panic!("{m} e-{scale}")
                };
                let mut to = Vec::new();
                append(&mut to, s);
                let power = 10i64.pow(u32::from(scale));
                let expected = format!(
                    "{}{}.{}",
                    if m < 0 { "-" } else { "" },
                    m.abs() / power,
                    if scale == 0 {
                        String::new()
                    } else {
                        format!("{:0width$}", m.abs() % power, width = usize::from(scale))
                    }
                );
                assert_eq!(String::from_utf8_lossy(&to), expected);
                assert!(to.len() <= LONGEST);
            }
        }
    }

    #[test]
    fn points_follow_the_rule() {
        assert_eq!(text(num(0, 0), &format(3, 4, PointRule::Always)), "0.");
        assert_eq!(text(num(5, 0), &format(3, 4, PointRule::Always)), "5.");
        assert_eq!(text(num(0, 0), &format(3, 4, PointRule::ExceptZero)), "0");
        let pointed = Num { point: true, ..num(0, 0) };
        assert_eq!(text(pointed, &format(3, 4, PointRule::ExceptZero)), "0.");
        assert_eq!(text(num(5, 0), &format(3, 4, PointRule::ExceptZero)), "5.");
        assert_eq!(text(Num { point: true, ..num(505, 0) }, &format(3, 4, PointRule::WhereNeeded)), "505");
        assert_eq!(text(num(125, 1), &format(3, 4, PointRule::WhereNeeded)), "12.5");
        assert_eq!(text(num(-5, 1), &format(3, 4, PointRule::Always)), "-0.5");
    }

    #[test]
    fn rounding_is_half_away_from_zero_and_never_minus_zero() {
        let f = format(3, 4, PointRule::Always);
        assert_eq!(text(num(123_455, 4), &f), "12.346");
        assert_eq!(text(num(-123_455, 4), &f), "-12.346");
        assert_eq!(text(num(1_234_549, 5), &f), "12.345");
        assert_eq!(text(num(-4, 4), &f), "0.");
        assert_eq!(text(num(129_999, 4), &f), "13.");
        // Zeros beyond the resolution are no loss, and the digits before them stay.
        let s = shape(num(125_000, 4), &f).expect("writable");
        assert_eq!((s.mantissa, s.scale, s.rounded), (12_500, 3, false));
        // An inch resolves one digit more.
        assert_eq!(text(Num { unit: Unit::Inch, ..num(123_455, 4) }, &f), "12.3455");
    }

    #[test]
    fn what_cannot_be_written_is_said() {
        let f = format(3, 4, PointRule::Always);
        assert_eq!(shape(num(100_000, 0), &f), Err(Unwritable::Range));
        assert!(shape(num(99_999_999, 3), &f).is_ok());
        assert_eq!(shape(num(100_000_000, 3), &f), Err(Unwritable::Range));
        assert_eq!(
            shape(num(i64::MIN, 18), &f),
            Ok(Shaped { mantissa: -9223, scale: 3, point: true, rounded: true })
        );
        assert_eq!(shape(num(i64::MIN, 0), &f), Err(Unwritable::Range));
        assert_eq!(shape(num(-1, 0), &Format { unsigned: true, ..f }), Err(Unwritable::Range));
        let count = Format { counts: true, ..format(0, 0, PointRule::Never) };
        assert_eq!(shape(num(15, 1), &count), Err(Unwritable::NotWhole));
        assert_eq!(text(num(20, 1), &count), "2");
        assert_eq!(shape(Num { unit: Unit::Entry, ..num(1_234_567, 5) }, &f), Err(Unwritable::Fineness));
        assert_eq!(text(Num { unit: Unit::Entry, ..num(12_345, 4) }, &f), "1.2345");
    }

    #[test]
    fn inches_come_back_from_nanos() {
        let f = format(3, 4, PointRule::Always);
        assert_eq!(text(from_nanos(38_100_000_000, &f, Unit::Inch), &f), "1.5");
        assert_eq!(text(from_nanos(-1_270_000, &f, Unit::Inch), &f), "-0.0001");
    }

    #[test]
    fn milliseconds_are_whole() {
        assert_eq!(milliseconds(num(15, 1)), Some((Num::int(1500, Unit::One), false)));
        assert_eq!(milliseconds(num(15_005, 4)), Some((Num::int(1501, Unit::One), true)));
    }

    #[test]
    fn literals_are_spelt_as_written() {
        assert_eq!(&*spell(b'X', num(-5, 3)), "X-0.005");
        assert_eq!(&*spell(b'T', num(7, 0)), "T7");
    }
}
