//! The recogniser of plain blocks, in front of the grammar: letters with numbers, blanks, the
//! line's end. Nearly every block of a long program is one.
//!
//! It leaves everything else alone: on any other sign the block goes to the grammar, untouched.
//! A test holds both to the same result.

use ncc_ir::source::Span;

use super::block::{Digits, Value, Word};

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
        at += 1;
        let negative = text.get(at) == Some(&b'-');
        at += usize::from(negative);
        let first = at;
        let mut mantissa = 0i64;
        while let Some(digit) = text.get(at).map(|b| b.wrapping_sub(b'0')).filter(|d| *d < 10) {
            // Wraps for more than 18 digits, which are left to the grammar below.
            mantissa = mantissa.wrapping_mul(10).wrapping_add(i64::from(digit));
            at += 1;
        }
        let mut count = at - first;
        let mut scale = 0;
        let point = text.get(at) == Some(&b'.');
        if point {
            at += 1;
            let part = at;
            while let Some(digit) = text.get(at).map(|b| b.wrapping_sub(b'0')).filter(|d| *d < 10) {
                mantissa = mantissa.wrapping_mul(10).wrapping_add(i64::from(digit));
                at += 1;
            }
            scale = at - part;
            count += scale;
        }
        if count == 0 || count > 18 || words.len() == MOST_WORDS {
            return None;
        }
        let mantissa = if negative { -mantissa } else { mantissa };
        words.push(Word {
            letter,
            value: Value::Number(Digits { mantissa, scale: scale as u8, point }),
            span: Span::new(base + start as u32, base + at as u32),
        });
    }
    // An empty line is no block of words.
    if words.is_empty() { None } else { Some(at) }
}
