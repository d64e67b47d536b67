//! The lines of a source that stand beside its pictures.

use std::collections::HashSet;
use std::io::{self, BufRead};

use crate::record::Record;

/// Lines of a source that is shown whole.
const WHOLE: usize = 20_000;
/// Longest line that is shown, bytes.
const LONGEST: usize = 400;

/// Lines of a source with their numbers, the first is 1.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Listing {
    /// The lines that are shown.
    pub lines: Vec<(u32, String)>,
    /// How many there are.
    pub total: u32,
}

impl Listing {
    /// Reads a source: all of a short one; of a long one the lines where the legs of a record end. Text that is not UTF-8 is taken for Latin-1.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn read(record: &Record, from: &mut dyn BufRead) -> io::Result<Listing> {
        let wanted: HashSet<u32> = record.way.legs.iter().map(|leg| leg.lines[1]).collect();
        let mut listing = Listing::default();
        while let Some(line) = next(from)? {
            listing.total += 1;
            let long = listing.total as usize > WHOLE;
            if listing.total as usize == WHOLE + 1 {
                listing.lines.retain(|line| wanted.contains(&line.0));
            }
            if !long || wanted.contains(&listing.total) {
                listing.lines.push((listing.total, line));
            }
        }
        Ok(listing)
    }
}

/// The next line without its end; `None` at the end of the text.
fn next(from: &mut dyn BufRead) -> io::Result<Option<String>> {
    let mut line = Vec::new();
    let (mut any, mut cut) = (false, false);
    loop {
        let piece = from.fill_buf()?;
        if piece.is_empty() {
            break;
        }
        any = true;
        let end = piece.iter().position(|b| *b == b'\n');
        let part = &piece[..end.unwrap_or(piece.len())];
        let keep = part.len().min(LONGEST - line.len());
        cut |= keep < part.len();
        line.extend_from_slice(&part[..keep]);
        let used = end.map_or(piece.len(), |end| end + 1);
        from.consume(used);
        if end.is_some() {
            break;
        }
    }
    if line.last() == Some(&b'\r') {
        line.pop();
    }
    let mut text = match std::str::from_utf8(&line) {
        Ok(text) => text.to_owned(),
        // A character that was cut in two is not shown.
        Err(error) if cut && error.error_len().is_none() => {
            String::from_utf8_lossy(&line[..error.valid_up_to()]).into_owned()
        }
        Err(_) => line.iter().map(|b| char::from(*b)).collect(),
    };
    if cut {
        text.push('\u{2026}');
    }
    Ok(any.then_some(text))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &[u8]) -> Listing {
        Listing::read(&Record::new("a"), &mut &*text).unwrap()
    }

    #[test]
    fn lines_are_read_as_they_are_numbered() {
        let lines = read(b"a\r\n\nFURA\xc7\xc3O\nFURA\xc3\x87\xc3\x83O").lines;
        let text: Vec<&str> = lines.iter().map(|line| line.1.as_str()).collect();
        assert_eq!(text, ["a", "", "FURA\u{c7}\u{c3}O", "FURA\u{c7}\u{c3}O"]);
        assert_eq!(read(b"").total, 0);
        assert_eq!(read(b"a\n").total, 1);
    }

    #[test]
    fn long_lines_and_long_sources_are_cut() {
        let long = read(&[b'x'; 100_000]);
        assert_eq!(long.lines[0].1.chars().count(), LONGEST + 1);
        let many = read("G1\n".repeat(WHOLE + 1).as_bytes());
        assert_eq!((many.total as usize, many.lines.len()), (WHOLE + 1, 0));
        assert_eq!(read("G1\n".repeat(WHOLE).as_bytes()).lines.len(), WHOLE);
    }
}
