//! Reads the source in pieces of whole lines. Their size is bounded, also for a large file.

use std::io::{self, Read, SeekFrom};
use std::ops::Range;

use sha2::{Digest, Sha256};

use crate::source::{Readable, halted};

/// Bytes of a piece. Its statements must fit into the second-level cache.
pub const PIECE: usize = 16 * 1024;

/// Longest source: a span has 32 bits.
const LONGEST: u64 = u32::MAX as u64;

/// Reads a source piece by piece, and computes its hash on request.
pub struct Chunks<'r> {
    from: &'r mut dyn Read,
    buffer: Vec<u8>,
    /// Bytes of the buffer that hold text.
    filled: usize,
    /// Bytes of the buffer that were returned.
    used: usize,
    /// Offset of the buffer's first byte in the source.
    base: u64,
    over: bool,
    /// `None` if no hash was requested.
    hash: Option<Sha256>,
    /// Line ends in the returned pieces.
    lines: u64,
}

/// A piece of the source.
pub enum Chunk {
    /// Whole lines, or the last line without its end; with their offset in the source.
    Lines(u32, Range<usize>),
    /// The span of a line that is longer than any control takes.
    TooLong(u32, u32),
    /// The end.
    End,
}

/// Whether the last block of a text that is longer than one piece says M99.
///
/// # Errors
/// Reading failed.
pub(crate) fn ends_by_return(source: &mut dyn Readable) -> io::Result<bool> {
    let length = source.seek(SeekFrom::End(0))?;
    let mut last = Vec::new();
    if length > PIECE as u64 {
        source.seek(SeekFrom::Start(length - PIECE as u64))?;
        source.read_to_end(&mut last)?;
    }
    source.rewind()?;
    let mut blocks = last.rsplit(|byte| *byte == b'\n').map(<[u8]>::trim_ascii);
    let block = blocks.find(|block| !block.is_empty() && !block.starts_with(b"%"));
    Ok(block.is_some_and(|block| block.windows(3).any(|word| word.eq_ignore_ascii_case(b"M99"))))
}

impl<'r> Chunks<'r> {
    pub(crate) fn new(from: &'r mut dyn Read) -> Chunks<'r> {
        Chunks::of_bytes(from, PIECE)
    }

    /// A reader with pieces of this size.
    pub(crate) fn of_bytes(from: &'r mut dyn Read, piece: usize) -> Chunks<'r> {
        Chunks {
            from,
            buffer: vec![0; piece],
            filled: 0,
            used: 0,
            base: 0,
            over: false,
            hash: None,
            lines: 0,
        }
    }

    /// A reader that computes the hash.
    pub(crate) fn hashed(from: &'r mut dyn Read, piece: usize) -> Chunks<'r> {
        Chunks { hash: Some(Sha256::new()), ..Chunks::of_bytes(from, piece) }
    }

    /// Text of a [`Chunk::Lines`].
    pub fn text(&self, range: Range<usize>) -> &[u8] {
        &self.buffer[range]
    }

    /// The next piece.
    ///
    /// # Errors
    /// Reading failed, the source is longer than 4 GiB, or ncc was interrupted.
    pub fn take(&mut self) -> io::Result<Chunk> {
        self.lines += memchr::memchr_iter(b'\n', &self.buffer[..self.used]).count() as u64;
        halted::heed(Some(self.lines + 1))?;
        self.buffer.copy_within(self.used..self.filled, 0);
        self.base += self.used as u64;
        self.filled -= self.used;
        self.used = 0;
        self.fill()?;
        if self.filled == 0 {
            return Ok(Chunk::End);
        }
        let text = &self.buffer[..self.filled];
        let whole = if self.over { Some(self.filled) } else { last_line_end(text) };
        let start = self.base as u32;
        match whole {
            Some(end) => {
                self.used = end;
                Ok(Chunk::Lines(start, 0..end))
            }
            None => self.too_long(start),
        }
    }

    fn too_long(&mut self, start: u32) -> io::Result<Chunk> {
        loop {
            // Drop the rest of this line, up to its end.
            if let Some(end) = self.buffer[..self.filled].iter().position(|&b| b == b'\n') {
                self.used = end;
                return Ok(Chunk::TooLong(start, (self.base + end as u64) as u32));
            }
            self.base += self.filled as u64;
            self.filled = 0;
            self.fill()?;
            if self.filled == 0 {
                return Ok(Chunk::TooLong(start, self.base as u32));
            }
        }
    }

    fn fill(&mut self) -> io::Result<()> {
        while self.filled < self.buffer.len() && !self.over {
            let n = match self.from.read(&mut self.buffer[self.filled..]) {
                Ok(n) => n,
                Err(e) if e.kind() == io::ErrorKind::Interrupted => continue,
                Err(e) => return Err(e),
            };
            self.over = n == 0;
            if let Some(hash) = &mut self.hash {
                hash.update(&self.buffer[self.filled..self.filled + n]);
            }
            self.filled += n;
            if self.base + self.filled as u64 > LONGEST {
                return Err(io::Error::new(io::ErrorKind::FileTooLarge, "longer than 4 GiB"));
            }
        }
        Ok(())
    }

    /// Hash and length of the source so far.
    pub fn finish(self) -> ([u8; 32], u64) {
        let hash = self.hash.unwrap_or_default();
        (hash.finalize().into(), self.base + self.filled as u64)
    }
}

fn last_line_end(text: &[u8]) -> Option<usize> {
    text.iter().rposition(|&b| b == b'\n').map(|at| at + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pieces(text: &[u8]) -> Vec<(u32, usize, bool)> {
        let mut from = text;
        let mut chunks = Chunks::new(&mut from);
        let mut found = Vec::new();
        loop {
            match chunks.take().unwrap() {
                Chunk::Lines(at, range) => found.push((at, range.len(), true)),
                Chunk::TooLong(at, end) => found.push((at, (end - at) as usize, false)),
                Chunk::End => break,
            }
        }
        assert_eq!(chunks.finish().1, text.len() as u64);
        found
    }

    #[test]
    fn every_byte_comes_once_and_lines_are_whole() {
        let text = b"G1 X1.\n".repeat(30_000);
        let found = pieces(&text);
        assert!(found.len() > 2 && found.iter().all(|p| p.2 && p.1 % 7 == 0));
        assert_eq!(found.iter().map(|p| p.1).sum::<usize>(), text.len());
    }

    #[test]
    fn a_line_without_end_is_let_go() {
        let mut text = b"G0\n".to_vec();
        text.extend(b"X".repeat(200_000));
        text.extend(b"\nM30\n");
        assert_eq!(pieces(&text), [(0, 3, true), (3, 200_000, false), (200_003, 5, true)]);
        assert_eq!(pieces(b""), []);
        assert_eq!(pieces(b"M30"), [(0, 3, true)]);
    }
}
