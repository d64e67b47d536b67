//! The short way for plain moves: from a line straight to a row of a table, or to its statements, without the words and
//! the block between. Taken by a block of at most a block number, the code of the motion that is active,
//! X, Y and Z, and a feed, while every fact that it depends on is settled. Nearly every
//! block of a long program is one.
//!
//! It gives what the long way gives; a test holds both to the same result. Whatever is not settled,
//! not plain, or would change more than the position and the feed, is left to the long way.

use ncc_dialects::{Bare, CodeRow, Dialect, Meaning, NumberRules};
use ncc_ir::canon::{Distance, Fact, Units};
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::line_table::{Row, StatedFeed};
use ncc_ir::source::Span;

use super::fast_parse;
use super::words::Digits;

/// What a plain move needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FastLower {
    pub(crate) unit: Unit,
    pub(crate) distance: Fact<Distance>,
    /// Whether the active motion is at feed.
    pub(crate) feed: bool,
    /// Letter of the block number.
    pub(crate) number: u8,
    /// Whether a number means the same with and without a point.
    pub(crate) bare: bool,
    /// Number of the G code that says the active motion once more, and changes nothing else.
    pub(crate) repeated_motion: Option<u8>,
    /// Number of the G code that says the other straight motion, where it changes nothing but which of the two is active.
    pub(crate) other_motion: Option<u8>,
    /// What a feed word needs, if it would change no more than the feed.
    pub(crate) feed_word: Option<FeedWord>,
}

/// What a feed word needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FeedWord {
    pub(crate) letter: u8,
    pub(crate) unit: Unit,
    /// Whether a number means the same with and without a point.
    pub(crate) bare: bool,
}

/// The number of the G code that says a straight motion, if its row is confirmed.
pub(crate) fn repeated_motion_code(dialect: &Dialect, feed: bool) -> Option<u8> {
    let meaning = if feed { Meaning::StraightFeed } else { Meaning::StraightTraverse };
    let says = |row: &CodeRow| row.means == Some(meaning) && row.sure;
    [0, 1].into_iter().find(|&code| dialect.code_row(b'G', 10 * u32::from(code)).is_some_and(says))
}

/// Whether a feed without a point surely counts whole units.
pub(crate) fn counts_units(rules: &NumberRules, units: Fact<Units>) -> bool {
    match rules.bare {
        Bare::Units => true,
        Bare::UnitsUnsure => false,
        Bare::Increments => match (rules.increment_inch, units) {
            (Some(inch), Fact::Known(Units::Inch)) => inch == 0,
            (Some(inch), Fact::Entry) => inch == 0 && rules.increment == 0,
            (Some(_) | None, _) => rules.increment == 0,
        },
    }
}

/// Reads the line that begins at `from` of `text` into an empty row, and the feed that it states, if it is a plain move of
/// at most `longest` bytes; gives the index of its `\n`, or the end of the text. The row is filled where it stays: parts
/// of it that were just written are read slowly as a whole.
pub(crate) fn line(
    fast: &FastLower,
    text: &[u8],
    from: usize,
    base: u32,
    longest: usize,
    (row, feed): (&mut Row, &mut Option<StatedFeed>),
) -> Option<usize> {
    // Words that have been met: a bit for each axis, the code, the feed, the block number.
    let (code_bit, feed_bit, number_bit) = (8u8, 16u8, 32u8);
    let (mut seen, mut said, mut at_feed) = (0u8, false, fast.feed);
    let (mut first, mut last) = (from, from);
    let mut at = from;
    // After a word a blank is passed over without a branch: whether one follows or the line's end is hard to guess.
    let end = loop {
        let beyond;
        let here = match text.get(at..).and_then(<[u8]>::first_chunk::<WINDOW>) {
            Some(here) => here,
            None => {
                beyond = last_window(text, at);
                &beyond
            }
        };
        let byte = here[0];
        let letter = byte & 0xDF;
        let place = letter.wrapping_sub(b'X');
        if place <= 2 {
            let (digits, len, after) = value(here, text, at)?;
            if seen >> place & 1 == 1 || !is_plain(digits, fast.bare) {
                return None;
            }
            if seen == 0 {
                first = at;
            }
            seen |= 1 << place;
            row.set_word(usize::from(place), digits.mantissa as i32, digits.scale, digits.point);
            last = at + len;
            at = last + usize::from(after == b' ');
        } else if byte == b'\n' {
            break at;
        } else if byte <= b' ' {
            // Seldom: a single blank after a word is passed over with it.
            match blank(here)? {
                Blank::Space => at += 1,
                Blank::End => break at + 1,
            }
        } else {
            // All of them begin with a digit: a sign would mean something else, or nothing.
            let (digits, len, after) = value(here, text, at).filter(|_| here[1].is_ascii_digit())?;
            if letter == fast.number {
                if seen != 0 || digits.point || !row.set_number(u32::try_from(digits.mantissa).ok()?) {
                    return None;
                }
                seen |= number_bit;
                first = at;
            } else if letter == b'G' {
                let says = |code: Option<u8>| code.map(i64::from) == Some(digits.mantissa);
                let other = says(fast.other_motion);
                if seen & code_bit != 0 || digits.point || !(other || says(fast.repeated_motion)) {
                    return None;
                }
                at_feed = fast.feed != other;
                if seen == 0 {
                    first = at;
                }
                seen |= code_bit;
                said = true;
            } else {
                let word = fast.feed_word.filter(|word| word.letter == letter)?;
                if seen & feed_bit != 0 || !is_plain(digits, word.bare) {
                    return None;
                }
                if seen == 0 {
                    first = at;
                }
                seen |= feed_bit;
                let span = Span::new(base + at as u32, base + (at + len) as u32);
                *feed = Some((literal(digits, word.unit), span));
            }
            last = at + len;
            at = last + usize::from(after == b' ');
        }
    };
    row.set_motion(at_feed);
    row.set_said(said);
    let fits = row.set_span(Span::new(base + first as u32, base + last as u32)) && end - from <= longest;
    // Without an axis there is no move.
    (fits && seen & 7 != 0).then_some(end)
}

/// Bytes of a word that are looked at together: its letter, a sign, and eight of its number.
pub(super) const WINDOW: usize = 10;

/// The last bytes of a text, and after its end, as if its last line ended there.
#[cold]
pub(super) fn last_window(text: &[u8], at: usize) -> [u8; WINDOW] {
    let mut window = [b'\n'; WINDOW];
    let rest = text.get(at..).unwrap_or_default();
    window.iter_mut().zip(rest).for_each(|(to, byte)| *to = *byte);
    window
}

/// What is between words.
enum Blank {
    /// A blank.
    Space,
    /// A line's end of two bytes.
    End,
}

#[cold]
#[inline(never)]
fn blank(here: &[u8; WINDOW]) -> Option<Blank> {
    match here {
        [b' ' | b'\t', ..] => Some(Blank::Space),
        [b'\r', b'\n', ..] => Some(Blank::End),
        _ => None,
    }
}

/// The number of the word at `at`, of which `here` is the window, the length of the word, and the byte after it (that of a
/// line's end where the text ends).
#[inline(always)]
pub(super) fn value(here: &[u8; WINDOW], text: &[u8], at: usize) -> Option<(Digits, usize, u8)> {
    let negative = here[1] == b'-';
    let number = if negative { &here[2..] } else { &here[1..9] };
    match number.first_chunk::<8>().and_then(|eight| fast_parse::short(*eight)) {
        Some((digits, len, after)) => {
            let mantissa = if negative { -digits.mantissa } else { digits.mantissa };
            Some((Digits { mantissa, ..digits }, 1 + usize::from(negative) + len, after))
        }
        None => long_value(text, at),
    }
}

#[cold]
#[inline(never)]
fn long_value(text: &[u8], at: usize) -> Option<(Digits, usize, u8)> {
    let (digits, end) = fast_parse::number(text, at + 1)?;
    Some((digits, end - at, text.get(end).copied().unwrap_or(b'\n')))
}

/// Whether a number is in range, and needs no rule of the dictionary to be understood.
#[inline(always)]
fn is_plain(digits: Digits, bare: bool) -> bool {
    let understood = digits.point || bare || digits.mantissa == 0;
    understood && digits.scale <= 8 && digits.mantissa.unsigned_abs() < 10_000_000
}

#[inline(always)]
pub(super) fn literal(digits: Digits, unit: Unit) -> Num {
    let Digits { mantissa, scale, point } = digits;
    Num { mantissa, scale, point, unit }
}
