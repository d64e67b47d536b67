//! Words of a block: a letter and what follows it, before any meaning.

use ncc_ir::source::Span;

/// An unsigned decimal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Digits {
    /// All the digits.
    pub(crate) mantissa: i64,
    /// Digits after the point.
    pub(crate) scale: u8,
    /// Whether a point was written.
    pub(crate) point: bool,
}

impl Digits {
    /// Digits with at most one point among them; `None` for more than 18 digits that count.
    pub(crate) fn parse(text: &[u8]) -> Option<Digits> {
        let mut digits = Digits { mantissa: 0, scale: 0, point: false };
        for &byte in text {
            if byte == b'.' {
                digits.point = true;
                continue;
            }
            digits.mantissa = digits.mantissa.checked_mul(10)?.checked_add(i64::from(byte - b'0'))?;
            digits.scale += u8::from(digits.point);
            if digits.mantissa > MOST || digits.scale > 18 {
                return None;
            }
        }
        Some(digits)
    }

    /// As a whole number without a point.
    pub(crate) fn to_whole(self) -> Option<u32> {
        u32::try_from(self.mantissa).ok().filter(|_| !self.point)
    }
}

/// Eighteen nines.
pub(crate) const MOST: i64 = 999_999_999_999_999_999;

/// What follows a letter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Value {
    /// Nothing.
    None,
    /// A number, with its sign in the mantissa.
    Number(Digits),
    /// What is computed: its place in the block's expressions.
    Computed(u16),
}

/// A word: a letter and what follows it. Its span is in the source.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Word {
    /// A capital, `:`, or a small letter where it stands after a comma.
    pub(crate) letter: u8,
    pub(crate) value: Value,
    pub(crate) span: Span,
}

/// Ten times a number, if that is a whole number.
pub(crate) fn tenths(digits: Digits) -> Option<u32> {
    match digits.scale {
        0 => digits.mantissa.checked_mul(10),
        1 => Some(digits.mantissa),
        _ => None,
    }
    .and_then(|tenths| u32::try_from(tenths).ok())
}

impl Word {
    /// The whole number of a word that has one, written without a point.
    pub(crate) fn to_whole(self) -> Option<u32> {
        match self.value {
            Value::Number(digits) if digits.scale == 0 => u32::try_from(digits.mantissa).ok(),
            Value::Number(_) | Value::Computed(_) | Value::None => None,
        }
    }
}
