//! The recogniser of plain blocks, in front of the grammar: letters with numbers, blanks, the
//! line's end. Nearly every block of a long program is one.
//!
//! It leaves everything else alone: on any other sign the block goes to the grammar, untouched.
//! A test holds both to the same result.

use ncc_ir::source::Span;

use super::words::{Digits, Value, Word};

/// Most words of a plain block.
const MOST_WORDS: usize = 32;

/// Reads the block that begins at `from` of `text`. Fills `words` and gives where the line's end
/// is (the index of its `\n`, or the end of the text); `None` if the block is not plain.
#[inline]
pub(crate) fn read(text: &[u8], from: usize, base: u32, words: &mut Vec<Word>) -> Option<usize> {
    words.clear();
    let mut at = from;
    loop {
        let letter = match text.get(at) {
            Some(b) if b.is_ascii_alphabetic() => b & 0xDF,
            Some(b' ' | b'\t') => {
                at += 1;
                continue;
            }
            Some(b'\n') => break,
            Some(b'\r') if text.get(at + 1) == Some(&b'\n') => {
                at += 1;
                break;
            }
            Some(_) => return None,
            None => break,
        };
        let start = at;
        let (digits, end) = number(text, at + 1)?;
        at = end;
        if words.len() == MOST_WORDS {
            return None;
        }
        words.push(Word {
            letter,
            value: Value::Number(digits),
            span: Span::new(base + start as u32, base + at as u32),
        });
    }
    // An empty line is no block of words.
    if words.is_empty() { None } else { Some(at) }
}

/// The number that begins at `at`: a minus sign or none, up to 18 digits with at most one point
/// among them. Gives its digits and where it ends; `None` if there is none, or one of more digits.
#[inline(always)]
pub(crate) fn number(text: &[u8], at: usize) -> Option<(Digits, usize)> {
    let rest = text.get(at..)?;
    let negative = rest.first() == Some(&b'-');
    let first = at + usize::from(negative);
    let eight = rest.get(usize::from(negative)..).and_then(<[u8]>::first_chunk::<8>);
    let (mut digits, len) = match eight.and_then(|eight| short(*eight)) {
        Some((digits, len, _)) => (digits, len),
        None => long(text, first)?,
    };
    if negative {
        digits.mantissa = -digits.mantissa;
    }
    Some((digits, first + len))
}

/// A byte in each of eight places.
const fn eight(byte: u8) -> u64 {
    u64::from_le_bytes([byte; 8])
}

/// An unsigned number that ends within eight bytes, its length, and the byte after it; all its digits at once, because
/// one by one the processor would have to guess how many there are. `None` leaves it to [`long`].
#[inline(always)]
pub(crate) fn short(bytes: [u8; 8]) -> Option<(Digits, usize, u8)> {
    // A digit becomes its value, everything else is at least ten.
    let bytes = u64::from_le_bytes(bytes);
    let values = bytes ^ eight(b'0');
    // The highest bit of each place that is no digit. A carry out of a place with the highest bit
    // set can falsify only places after it, which lie beyond the number's end.
    let others = (values.wrapping_add(eight(0x76)) | values) & eight(0x80);
    if others == 0 {
        return None;
    }
    let before = others.trailing_zeros() & !7;
    let point = (values >> before) as u8 == b'.' ^ b'0';
    let (packed, count, scale, end) = if point {
        let others = others & (others - 1);
        if others == 0 {
            return None;
        }
        // The places after the point move up to those before it.
        let (whole, end) = ((1u64 << before) - 1, others.trailing_zeros() & !7);
        let count = end / 8 - 1;
        (values & whole | values >> 8 & !whole, count, count - before / 8, end)
    } else {
        (values, before / 8, 0, before)
    };
    if count == 0 {
        return None;
    }
    // The last digit goes to the last place, zeros before the first: pairs, then fours, then all.
    let ones = packed << (64 - 8 * count);
    let pairs = (ones * 10 + (ones >> 8)) & 0x00FF_00FF_00FF_00FF;
    let fours = (pairs * 100 + (pairs >> 16)) & 0x0000_FFFF_0000_FFFF;
    let all = (fours * 10_000 + (fours >> 32)) & 0xFFFF_FFFF;
    let digits = Digits { mantissa: all as i64, scale: scale as u8, point };
    Some((digits, (end / 8) as usize, (bytes >> end) as u8))
}

/// An unsigned number of any length, one digit after the other.
fn long(text: &[u8], first: usize) -> Option<(Digits, usize)> {
    let mut digits = Digits { mantissa: 0, scale: 0, point: false };
    let mut count = 0;
    let mut at = first;
    loop {
        match text.get(at) {
            Some(b'.') if !digits.point => digits.point = true,
            Some(&byte @ b'0'..=b'9') => {
                count += 1;
                if count > 18 {
                    return None;
                }
                digits.mantissa = digits.mantissa * 10 + i64::from(byte - b'0');
                digits.scale += u8::from(digits.point);
            }
            Some(_) | None => break,
        }
        at += 1;
    }
    (count > 0).then_some((digits, at - first))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn all_digits_at_once_and_one_by_one_are_the_same(
            number in "-?[0-9]{0,6}\\.?[0-9]{0,6}",
            rest in prop::collection::vec(any::<u8>(), 0..12),
        ) {
            let mut text = b"X".to_vec();
            text.extend(number.bytes());
            text.extend(rest);
            let sign = usize::from(text.get(1) == Some(&b'-'));
            let one_by_one = long(&text, 1 + sign).map(|(d, len)| {
                let mantissa = if sign == 1 { -d.mantissa } else { d.mantissa };
                (Digits { mantissa, ..d }, 1 + sign + len)
            });
            prop_assert_eq!(super::number(&text, 1), one_by_one);
        }
    }

    #[test]
    fn short_numbers_are_read_at_once() {
        for (text, mantissa, scale, len) in [
            ("0 ......", 0, 0, 1),
            ("12.345Y1", 12345, 3, 6),
            ("1234.\n..", 1234, 0, 5),
            (".5\nN10 X", 5, 1, 2),
        ] {
            let read = short(text.as_bytes().try_into().expect("eight bytes"));
            let point = text[..len].contains('.');
            let after = text.as_bytes()[len];
            assert_eq!(read, Some((Digits { mantissa, scale, point }, len, after)), "{text}");
        }
        for left in ["........", "12345678", "1234.567", ". X10   ", "X1234567"] {
            assert_eq!(short(left.as_bytes().try_into().expect("eight bytes")), None, "{left}");
        }
    }
}
