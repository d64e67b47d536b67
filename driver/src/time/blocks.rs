//! The line of the source that a statement stands in: its number and its text.
//!
//! Lines are counted while the source streams by; nothing of a piece is kept but the last line that
//! was asked for. A source that is kept whole is indexed, because calls go back and forth in it.

use std::ops::Range;
use std::rc::Rc;

/// The lines of a piece of the source.
#[derive(Debug)]
pub struct Blocks {
    /// Place of the piece's first byte in the source.
    base: u32,
    /// Number of its first line.
    number: u32,
    /// Where each line of a whole source begins; empty while it streams.
    starts: Vec<u32>,
    last: Option<Line>,
}

/// A line.
#[derive(Clone, Debug)]
struct Line {
    /// Its bytes in the source, line end included.
    span: Range<u32>,
    /// Its number, counted from 1.
    number: u32,
    /// Its text, once somebody has asked for it.
    text: Option<Rc<str>>,
}

impl Blocks {
    pub(crate) fn new() -> Blocks {
        Blocks { base: 0, number: 1, starts: Vec::new(), last: None }
    }

    /// The blocks of a source that is kept in memory.
    pub fn of_text(text: &[u8]) -> Blocks {
        let mut starts = vec![0];
        starts.extend(memchr::memchr_iter(b'\n', text).map(|end| end as u32 + 1));
        Blocks { starts, ..Blocks::new() }
    }

    /// A further piece begins.
    pub fn begin(&mut self, base: u32) {
        self.base = base;
        self.last = None;
    }

    /// The piece is over.
    pub fn end(&mut self, text: &[u8]) {
        self.number += memchr::memchr_iter(b'\n', text).count() as u32;
    }

    /// Number of the line of a place in the piece, counted from 1; `None` if it is not in it.
    pub fn number_of(&mut self, text: &[u8], place: u32) -> Option<u32> {
        self.find(text, place).map(|line| line.number)
    }

    /// Text of that line without blanks around it.
    pub fn text_of(&mut self, text: &[u8], place: u32) -> Option<Rc<str>> {
        let base = self.base;
        let line = self.find(text, place)?;
        if line.text.is_none() {
            let bytes = (line.span.start - base) as usize..(line.span.end - base) as usize;
            line.text = Some(decode(text.get(bytes).unwrap_or_default()).trim().into());
        }
        line.text.clone()
    }

    fn find(&mut self, text: &[u8], place: u32) -> Option<&mut Line> {
        let fresh = !matches!(&self.last, Some(line) if line.span.contains(&place));
        if fresh {
            let at = place.checked_sub(self.base).map(|at| at as usize).filter(|at| *at < text.len())?;
            let start = memchr::memrchr(b'\n', &text[..at]).map_or(0, |end| end + 1);
            let end = memchr::memchr(b'\n', &text[at..]).map_or(text.len(), |len| at + len + 1);
            self.last = Some(Line {
                span: self.base + start as u32..self.base + end as u32,
                number: self.number(text, start),
                text: None,
            });
        }
        self.last.as_mut()
    }

    /// Number of the line that begins at a byte of the piece.
    fn number(&self, text: &[u8], start: usize) -> u32 {
        if !self.starts.is_empty() {
            return self.starts.partition_point(|s| *s as usize <= start) as u32;
        }
        // From the last line on, if it is not behind.
        let (from, before) = match &self.last {
            Some(line) if (line.span.end - self.base) as usize <= start => {
                ((line.span.end - self.base) as usize, line.number + 1)
            }
            Some(_) | None => (0, self.number),
        };
        before + text.get(from..start).map_or(0, |lines| memchr::memchr_iter(b'\n', lines).count()) as u32
    }
}

/// UTF-8, else Latin-1.
fn decode(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(blocks: &mut Blocks, text: &[u8], place: u32) -> Option<(u32, String)> {
        let number = blocks.number_of(text, place)?;
        Some((number, blocks.text_of(text, place)?.to_string()))
    }

    #[test]
    fn lines_are_counted_across_pieces_and_backwards() {
        let (first, second) = (&b"G0\n\nG1 X1\n"[..], &b"M5\r\n\xDCber"[..]);
        let mut blocks = Blocks::new();
        blocks.begin(0);
        assert_eq!(said(&mut blocks, first, 4), Some((3, "G1 X1".to_owned())));
        assert_eq!(said(&mut blocks, first, 9), Some((3, "G1 X1".to_owned())));
        assert_eq!(said(&mut blocks, first, 1), Some((1, "G0".to_owned())));
        assert_eq!(said(&mut blocks, first, 3), Some((2, String::new())));
        assert_eq!(said(&mut blocks, first, 10), None);
        blocks.end(first);
        blocks.begin(10);
        assert_eq!(said(&mut blocks, second, 15), Some((5, "Über".to_owned())));
        assert_eq!(said(&mut blocks, second, 10), Some((4, "M5".to_owned())));
        assert_eq!(said(&mut blocks, second, 3), None);
    }

    #[test]
    fn a_whole_source_is_indexed() {
        let text = b"G0\n\nG1 X1\nM30";
        let mut blocks = Blocks::of_text(text);
        for (place, line) in [(10, (4, "M30")), (0, (1, "G0")), (3, (2, "")), (4, (3, "G1 X1"))] {
            assert_eq!(said(&mut blocks, text, place), Some((line.0, line.1.to_owned())));
        }
    }
}
