//! A text that is looked at again, here and there: its lines by number, and stretches of it.
//!
//! Only the places where its lines begin are kept, and one page of it.

use std::cell::Cell;
use std::io::{self, Read, SeekFrom};

use sha2::{Digest, Sha256};

use crate::source::Readable;

/// Bytes that are read at once.
const PAGE: usize = 1 << 16;

/// A text in a file.
pub struct Text<'f> {
    file: &'f mut dyn Readable,
    /// Where lines begin.
    starts: Vec<u32>,
    /// The line that was asked for last: the next one is likely to be near.
    near: Cell<usize>,
    bytes: u32,
    page: Vec<u8>,
    page_at: u32,
}

impl<'f> Text<'f> {
    /// Reads through a file.
    ///
    /// # Errors
    /// It cannot be read, or is longer than 4 GiB.
    pub fn new(file: &'f mut dyn Readable) -> io::Result<Text<'f>> {
        Text::through(file, &mut |_| {})
    }

    /// Reads through a file; gives the hash of its bytes besides.
    ///
    /// # Errors
    /// As of [`Text::new`].
    pub fn hashed(file: &'f mut dyn Readable) -> io::Result<(Text<'f>, [u8; 32])> {
        let mut hash = Sha256::new();
        let text = Text::through(file, &mut |piece| hash.update(piece))?;
        Ok((text, hash.finalize().into()))
    }

    fn through(file: &'f mut dyn Readable, take: &mut dyn FnMut(&[u8])) -> io::Result<Text<'f>> {
        file.seek(SeekFrom::Start(0))?;
        let mut starts = vec![0];
        let mut piece = vec![0; PAGE];
        let mut at = 0u64;
        loop {
            let n = match file.read(&mut piece) {
                Ok(0) => break,
                Ok(n) => n,
                Err(e) if e.kind() == io::ErrorKind::Interrupted => continue,
                Err(e) => return Err(e),
            };
            take(&piece[..n]);
            if at + n as u64 > u64::from(u32::MAX) {
                return Err(io::Error::new(io::ErrorKind::FileTooLarge, "longer than 4 GiB"));
            }
            starts.extend(memchr::memchr_iter(b'\n', &piece[..n]).map(|end| (at + end as u64 + 1) as u32));
            at += n as u64;
        }
        let bytes = at as u32;
        // What follows the last line end is a line only if there is something.
        if starts.last() == Some(&bytes) {
            starts.pop();
        }
        Ok(Text { file, starts, near: Cell::new(0), bytes, page: Vec::new(), page_at: 0 })
    }

    /// How many lines it has.
    pub fn lines(&self) -> usize {
        self.starts.len()
    }

    /// Number of the line in which a place lies, from 1.
    pub fn line_of(&self, place: u32) -> usize {
        let near = self.near.get();
        let holds = |line: usize| {
            let begun = line > 0 && self.starts.get(line - 1).is_some_and(|start| *start <= place);
            begun && self.starts.get(line).is_none_or(|next| place < *next)
        };
        let line = match [near, near + 1].into_iter().find(|line| holds(*line)) {
            Some(line) => line,
            None => self.starts.partition_point(|start| *start <= place).max(1),
        };
        self.near.set(line);
        line
    }

    /// Bytes of a line without its end: the first, and one past the last.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn line(&mut self, number: usize) -> io::Result<Option<(u32, u32)>> {
        let Some(start) = number.checked_sub(1).and_then(|at| self.starts.get(at)).copied() else {
            return Ok(None);
        };
        let next = self.starts.get(number).copied().unwrap_or(self.bytes);
        let end = self.stretch(next.saturating_sub(2).max(start), next)?;
        let cut = match end {
            [.., b'\r', b'\n'] => 2,
            [.., b'\n'] => 1,
            _ => 0,
        };
        Ok(Some((start, next - cut)))
    }

    /// Column of a place in its line, in characters from 1; characters as UTF-8 has them, else bytes.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn column_of(&mut self, place: u32) -> io::Result<usize> {
        let start = self.starts.get(self.line_of(place) - 1).copied().unwrap_or(0);
        if place == start {
            return Ok(1);
        }
        let before = self.stretch(start, place)?;
        Ok(1 + std::str::from_utf8(before).map_or(before.len(), |text| text.chars().count()))
    }

    /// A stretch of it, as far as there is one, at most a page.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn stretch(&mut self, start: u32, end: u32) -> io::Result<&[u8]> {
        let end = end.min(self.bytes).min(start.saturating_add(PAGE as u32));
        let start = start.min(end);
        let here = self.page_at as usize..self.page_at as usize + self.page.len();
        if !here.contains(&(start as usize)) || end as usize > here.end {
            self.file.seek(SeekFrom::Start(u64::from(start)))?;
            self.page.clear();
            self.page_at = start;
            (&mut *self.file).take(2 * PAGE as u64).read_to_end(&mut self.page)?;
        }
        let from = (start - self.page_at) as usize;
        Ok(self.page.get(from..from + (end - start) as usize).unwrap_or_default())
    }

    /// A line without its end, as people read it: UTF-8, else Latin-1; signs that control nothing shown
    /// as blanks. Longer than so many characters, it is cut.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn shown(&mut self, number: usize, most: usize) -> io::Result<Option<String>> {
        let Some((start, end)) = self.line(number)? else { return Ok(None) };
        Ok(Some(readable(self.stretch(start, end)?, most)))
    }
}

/// Bytes as people read them.
pub fn readable(bytes: &[u8], most: usize) -> String {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|b| char::from(*b)).collect(),
    };
    let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    match text.char_indices().nth(most) {
        Some((at, _)) => format!("{}…", &text[..at]),
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    /// Whichever line was asked for before, a place is in the line in which a search finds it.
    #[test]
    fn a_place_is_found_from_wherever_the_last_one_was() {
        let mut file = Cursor::new(b"G0\n\nX1\n\n\nM30".to_vec());
        let text = Text::new(&mut file).expect("memory");
        let starts = text.starts.clone();
        for first in 0..20 {
            for place in 0..20 {
                text.line_of(first);
                let searched = starts.partition_point(|start| *start <= place).max(1);
                assert_eq!(text.line_of(place), searched, "{place} after {first}");
            }
        }
        let mut empty = Cursor::new(Vec::new());
        assert_eq!(Text::new(&mut empty).expect("memory").line_of(0), 1);
    }
}
