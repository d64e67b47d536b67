//! The letter O where a zero is meant: `GO X5`, `X1O`.
//!
//! Looked for only where something is wrong already.

use ncc_ir::source::Span;

use crate::common::Source;

/// The first letter O that stands in a number, if everything around it up to the next blanks reads
/// as words of one letter and a number.
pub(in crate::siemens) fn letter_for_zero(src: Source, within: Span) -> Option<Span> {
    let text = src.bytes(within);
    let end = text.iter().position(|&b| b == b';' || b == b'"').unwrap_or(text.len());
    let mut at = 0;
    while at < end {
        let len = text[at..end].iter().take_while(|b| !b.is_ascii_whitespace()).count();
        if let Some(place) = in_words(&text[at..at + len]) {
            let start = within.start + (at + place) as u32;
            return Some(Span::new(start, start + 1));
        }
        at += len.max(1);
    }
    None
}

/// The place of one letter O in a run of words without blanks.
fn in_words(run: &[u8]) -> Option<usize> {
    let is_o = |b: u8| b.eq_ignore_ascii_case(&b'O');
    let mut found = None;
    let mut at = 0;
    while at < run.len() {
        if !run[at].is_ascii_alphabetic() || is_o(run[at]) {
            return None;
        }
        at += 1;
        at += usize::from(matches!(run.get(at), Some(b'+' | b'-' | b'=')));
        let number = run[at..].iter().take_while(|&&b| b.is_ascii_digit() || b == b'.' || is_o(b)).count();
        let mut letters = (at..at + number).filter(|&i| is_o(run[i]));
        if let Some(place) = letters.next() {
            // Two of them are a name.
            if letters.next().is_some() {
                return None;
            }
            found = found.or(Some(place));
        }
        if number == 0 {
            return None;
        }
        at += number;
    }
    found
}
