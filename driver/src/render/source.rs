//! Looking at the source again: the few lines that diagnostics point at.
//!
//! The source is not kept in memory. One pass over it finds the lines of all the places asked for;
//! then only those lines are read, decoded (UTF-8, else Latin-1), and cut where they are long.

use std::collections::BTreeMap;
use std::io::{self, Read, SeekFrom};
use std::ops::Range;

use codespan_reporting::files::{Error, Files, Location};
use ncc_ir::source::Span;

use super::text::visible;
use crate::source::Readable;
use crate::source::called_files::Called;

/// Longest line that is shown whole, in bytes.
const LONGEST: u64 = 160;
/// Of a longer line, so much is shown before the place that a diagnostic points at.
const BEFORE: u64 = 60;

/// A line of the source: its number, counted from 1, and its bytes without the line end.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line {
    /// Its number.
    pub number: u64,
    /// Its first byte.
    pub start: u64,
    /// One past its last byte.
    pub end: u64,
}

/// The lines of places in a source.
#[derive(Debug, Default)]
pub struct Lines {
    /// By first byte.
    by_start: BTreeMap<u64, Line>,
}

impl Lines {
    /// Finds the lines of the given places, and of the lines between two that are next but one.
    ///
    /// # Errors
    /// Reading the source.
    pub fn find(source: &mut dyn Readable, mut places: Vec<u32>) -> io::Result<Lines> {
        places.sort_unstable();
        places.dedup();
        let mut wanted = places.into_iter().map(u64::from).peekable();
        let mut lines = Lines::default();
        let mut line = Line { number: 1, start: 0, end: 0 };
        // The line before, while it is not known whether a line on either side is wanted.
        let mut skipped: Option<Line> = None;
        let mut taken: Option<u64> = None;
        source.seek(SeekFrom::Start(0))?;
        let mut piece = vec![0; 1 << 16];
        let mut at = 0u64;
        let mut last_byte = 0u8;
        loop {
            if wanted.peek().is_none() {
                return Ok(lines);
            }
            let n = source.read(&mut piece)?;
            let text = &piece[..n];
            let mut ends = memchr::memchr_iter(b'\n', text);
            loop {
                let (end, past) = match ends.next() {
                    Some(i) => {
                        let before = if i > 0 { text[i - 1] } else { last_byte };
                        let end = at + i as u64;
                        (end - u64::from(before == b'\r' && end > line.start), end + 1)
                    }
                    None if n == 0 => (at, u64::MAX),
                    None => break,
                };
                line.end = end;
                let mut here = false;
                while wanted.next_if(|&w| w < past).is_some() {
                    here = true;
                }
                if here {
                    if let (Some(between), Some(number)) = (skipped, taken)
                        && number + 2 == line.number
                    {
                        lines.by_start.insert(between.start, between);
                    }
                    lines.by_start.insert(line.start, line);
                    taken = Some(line.number);
                }
                skipped = (!here).then_some(line);
                if past == u64::MAX {
                    return Ok(lines);
                }
                line = Line { number: line.number + 1, start: past, end: past };
            }
            last_byte = text.last().copied().unwrap_or(last_byte);
            at += n as u64;
        }
    }

    /// Counts the lines of called programs as their own files do.
    pub fn own_numbers(&mut self, called: Option<&Called>) {
        let Some(called) = called else { return };
        for line in self.by_start.values_mut() {
            if let Some(file) = called.file(line.start as u32) {
                line.number = line.number.saturating_sub(file.lines_before).max(1);
            }
        }
    }

    /// The line of a place that was asked for.
    pub fn line(&self, place: u32) -> Option<Line> {
        self.by_start.range(..=u64::from(place)).next_back().map(|(_, line)| *line)
    }
}

/// The lines that one diagnostic shows, as a text of its own in which every line keeps its number.
#[derive(Debug)]
pub struct Excerpt {
    name: String,
    text: String,
    /// By line number.
    lines: BTreeMap<usize, Shown>,
}

#[derive(Debug)]
struct Shown {
    /// Place in the excerpt's text.
    range: Range<usize>,
    /// First byte of the source that is shown.
    first: u64,
    /// Place in the excerpt's text for every byte of the source that is shown, and one past it.
    places: Vec<usize>,
    /// Characters of the line before those shown.
    columns_before: usize,
    /// Bytes of the excerpt's text before the first character of the source (a cut mark).
    mark: usize,
}

impl Excerpt {
    /// Reads the lines of the places given; the first place matters most where a line is cut.
    ///
    /// # Errors
    /// Reading the source.
    pub fn read(source: &mut dyn Readable, lines: &Lines, name: &str, spans: &[Span]) -> io::Result<Excerpt> {
        let mut excerpt = Excerpt { name: name.to_owned(), text: String::new(), lines: BTreeMap::new() };
        let mut wanted: BTreeMap<u64, (Line, u64)> = BTreeMap::new();
        for span in spans {
            if let Some(line) = lines.line(span.start) {
                wanted.entry(line.number).or_insert((line, u64::from(span.start)));
            }
        }
        let numbers: Vec<u64> = wanted.keys().copied().collect();
        for pair in numbers.windows(2) {
            if pair[0] + 2 == pair[1]
                && let Some(line) = lines.by_start.values().find(|l| l.number == pair[0] + 1)
            {
                wanted.insert(line.number, (*line, line.start));
            }
        }
        for (line, place) in wanted.into_values() {
            excerpt.add(source, line, place)?;
        }
        Ok(excerpt)
    }

    fn add(&mut self, source: &mut dyn Readable, line: Line, place: u64) -> io::Result<()> {
        let (mut first, mut end) = (line.start, line.end);
        if end - first > LONGEST {
            first = place.min(end).saturating_sub(BEFORE).max(first);
            end = end.min(first + LONGEST);
        }
        source.seek(SeekFrom::Start(first))?;
        let mut bytes = Vec::new();
        source.take(end - first).read_to_end(&mut bytes)?;
        // A cut may fall into a character.
        if first > line.start {
            let broken = bytes.iter().take(3).take_while(|b| (0x80..0xc0).contains(*b)).count();
            if std::str::from_utf8(bytes.get(broken..).unwrap_or_default()).is_ok_or_cut() {
                first += broken as u64;
                bytes.drain(..broken);
            }
        }
        let latin1 = !std::str::from_utf8(&bytes).is_ok_or_cut();
        let columns_before = characters(source, line.start, first, latin1)?;

        let start = self.text.len();
        if first > line.start {
            self.text.push('…');
        }
        let mark = self.text.len() - start;
        let mut places = Vec::with_capacity(bytes.len() + 1);
        if latin1 {
            for &byte in &bytes {
                places.push(self.text.len());
                self.text.push(visible(char::from(byte)));
            }
        } else {
            for c in String::from_utf8_lossy(&bytes).trim_end_matches(char::REPLACEMENT_CHARACTER).chars() {
                places.extend(std::iter::repeat_n(self.text.len(), c.len_utf8()));
                self.text.push(visible(c));
            }
        }
        places.push(self.text.len());
        if end < line.end {
            self.text.push('…');
        }
        let range = start..self.text.len();
        self.text.push('\n');
        self.lines.insert(line.number as usize, Shown { range, first, places, columns_before, mark });
        Ok(())
    }

    /// The line of a place as it is shown.
    pub fn line(&self, lines: &Lines, place: u32) -> &str {
        let shown = lines.line(place).and_then(|line| self.lines.get(&(line.number as usize)));
        shown.and_then(|shown| self.text.get(shown.range.clone())).unwrap_or("")
    }

    /// Place of a span in the excerpt's text, cut to its first line.
    pub fn range(&self, lines: &Lines, span: Span) -> Option<Range<usize>> {
        let shown = self.lines.get(&(lines.line(span.start)?.number as usize))?;
        let place = |byte: u32| {
            let at = u64::from(byte).saturating_sub(shown.first) as usize;
            shown.places.get(at).or(shown.places.last()).copied()
        };
        Some(place(span.start)?..place(span.end)?)
    }

    /// Text of a span as it is shown, cut to its first line.
    pub fn snippet(&self, lines: &Lines, span: Span) -> &str {
        self.range(lines, span).and_then(|range| self.text.get(range)).unwrap_or("")
    }

    /// The text before and after a span, as far as no blank comes between.
    pub fn beside(&self, lines: &Lines, span: Span) -> (&str, &str) {
        let found = self.range(lines, span).and_then(|range| {
            let line = &self.lines.get(&(lines.line(span.start)?.number as usize))?.range;
            Some((self.text.get(line.start..range.start)?, self.text.get(range.end..line.end)?))
        });
        let (before, after) = found.unwrap_or(("", ""));
        let from = before.rfind(char::is_whitespace).map_or(0, |at| at + 1);
        let to = after.find(char::is_whitespace).unwrap_or(after.len());
        (before.get(from..).unwrap_or(""), &after[..to])
    }

    /// The place so many characters after a place of the excerpt's text.
    pub fn cut(&self, from: usize, characters: usize) -> usize {
        let rest = self.text.get(from..).unwrap_or("");
        rest.char_indices().nth(characters).map_or(self.text.len(), |(at, _)| from + at)
    }

    /// Line and column of a place, both counted from 1; a column is a character.
    pub fn location(&self, lines: &Lines, place: u32) -> Option<(u64, u64)> {
        let range = self.range(lines, Span::new(place, place))?;
        let number = lines.line(place)?.number;
        let column = self.column_number((), number as usize, range.start).ok()?;
        Some((number, column as u64))
    }

    fn shown(&self, line_index: usize) -> Result<&Shown, Error> {
        let max = self.lines.keys().next_back().copied().unwrap_or(0);
        self.lines.get(&line_index).ok_or(Error::LineTooLarge { given: line_index, max })
    }
}

/// codespan's index of a line is its number here.
impl<'a> Files<'a> for Excerpt {
    type FileId = ();
    type Name = &'a str;
    type Source = &'a str;

    fn name(&'a self, (): ()) -> Result<&'a str, Error> {
        Ok(&self.name)
    }

    fn source(&'a self, (): ()) -> Result<&'a str, Error> {
        Ok(&self.text)
    }

    fn line_index(&'a self, (): (), byte_index: usize) -> Result<usize, Error> {
        let at = self.lines.iter().rev().find(|(_, shown)| shown.range.start <= byte_index);
        at.map(|(number, _)| *number).ok_or(Error::IndexTooLarge { given: byte_index, max: self.text.len() })
    }

    fn line_number(&'a self, (): (), line_index: usize) -> Result<usize, Error> {
        Ok(line_index)
    }

    fn column_number(&'a self, (): (), line_index: usize, byte_index: usize) -> Result<usize, Error> {
        let shown = self.shown(line_index)?;
        let from = shown.range.start + shown.mark;
        let before = self.text.get(from..byte_index.max(from)).unwrap_or("");
        Ok(shown.columns_before + before.chars().count() + 1)
    }

    fn location(&'a self, (): (), byte_index: usize) -> Result<Location, Error> {
        let line_number = self.line_index((), byte_index)?;
        Ok(Location { line_number, column_number: self.column_number((), line_number, byte_index)? })
    }

    fn line_range(&'a self, (): (), line_index: usize) -> Result<Range<usize>, Error> {
        self.shown(line_index).map(|shown| shown.range.clone())
    }
}

/// Characters between two places.
fn characters(source: &mut dyn Readable, from: u64, to: u64, latin1: bool) -> io::Result<usize> {
    if latin1 {
        return Ok((to - from) as usize);
    }
    source.seek(SeekFrom::Start(from))?;
    let mut rest = source.take(to - from);
    let mut piece = [0; 1 << 13];
    let mut count = 0;
    loop {
        match rest.read(&mut piece)? {
            0 => return Ok(count),
            n => count += piece[..n].iter().filter(|b| !(0x80..0xc0).contains(*b)).count(),
        }
    }
}

trait OkOrCut {
    /// Whether it is UTF-8, but perhaps for a character that is cut off at the end.
    fn is_ok_or_cut(&self) -> bool;
}

impl OkOrCut for Result<&str, std::str::Utf8Error> {
    fn is_ok_or_cut(&self) -> bool {
        match self {
            Ok(_) => true,
            Err(error) => error.error_len().is_none(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    fn excerpt(text: &[u8], spans: &[(u32, u32)]) -> (Lines, Excerpt) {
        let spans: Vec<Span> = spans.iter().map(|&(a, b)| Span::new(a, b)).collect();
        let mut source = Cursor::new(text);
        let lines = Lines::find(&mut source, spans.iter().map(|s| s.start).collect()).unwrap();
        let excerpt = Excerpt::read(&mut source, &lines, "p", &spans).unwrap();
        (lines, excerpt)
    }

    #[test]
    fn lines_and_columns() {
        let text = b"G0\r\nG1 X1\r\n\r\nM2";
        for (place, expected) in
            [(0, (1, 1)), (4, (2, 1)), (7, (2, 4)), (11, (3, 1)), (14, (4, 2)), (15, (4, 3))]
        {
            let (lines, excerpt) = excerpt(text, &[(place, place)]);
            assert_eq!(excerpt.location(&lines, place), Some(expected), "{place}");
        }
        let (lines, excerpt) = excerpt(b"", &[(0, 0)]);
        assert_eq!(excerpt.location(&lines, 0), Some((1, 1)));
    }

    #[test]
    fn a_span_over_the_line_end_is_cut() {
        let (lines, excerpt) = excerpt(b"G0 X1\r\nG1", &[(3, 9)]);
        assert_eq!(excerpt.snippet(&lines, Span::new(3, 9)), "X1");
    }

    #[test]
    fn latin1_and_control_characters_are_shown() {
        let (lines, excerpt) = excerpt(b";FURA\xc7\xc3O\x00\x1b[2J", &[(5, 8)]);
        assert_eq!(excerpt.text, ";FURAÇÃO␀␛[2J\n");
        assert_eq!(excerpt.snippet(&lines, Span::new(5, 8)), "ÇÃO");
        assert_eq!(excerpt.location(&lines, 8), Some((1, 9)));
    }

    #[test]
    fn utf8_columns_are_characters() {
        let text = ";FURAÇÃO X".as_bytes();
        let (lines, excerpt) = excerpt(text, &[(text.len() as u32 - 1, text.len() as u32)]);
        assert_eq!(excerpt.location(&lines, text.len() as u32 - 1), Some((1, 10)));
    }

    #[test]
    fn a_long_line_is_cut_around_the_place() {
        let text = [vec![b'A'; 100_000], b"?".to_vec(), vec![b'B'; 100_000]].concat();
        let (lines, excerpt) = excerpt(&text, &[(100_000, 100_001)]);
        assert_eq!(excerpt.snippet(&lines, Span::new(100_000, 100_001)), "?");
        assert_eq!(excerpt.location(&lines, 100_000), Some((1, 100_001)));
        assert!(excerpt.text.starts_with("…AAA") && excerpt.text.ends_with("BBB…\n"));
        assert!(excerpt.text.len() < 300);
    }

    #[test]
    fn a_cut_may_fall_into_a_character() {
        let text = "Ç".repeat(1000).into_bytes();
        for place in [500, 501, 502, 503] {
            let (_, excerpt) = excerpt(&text, &[(place, place + 1)]);
            assert!(excerpt.text.chars().all(|c| matches!(c, 'Ç' | '…' | '\n')), "{}", excerpt.text);
        }
    }
}
