//! A whole text laid out, line by line in constant memory, each line judged as it is written.
//!
//! Not here: how a line looks (`layout`), and what the program does (`events`).

use std::io::{self, BufRead, BufReader, BufWriter, Read, SeekFrom, Write};

use ncc_dialects::{Family, Settings};
use ncc_frontends::pieces::{LineIs, Lines, MOST_PLAIN, Piece, PlainWord};

use super::same::{Taken, same};
use super::{calls, layout};
use crate::source::Readable;

/// Longest line in bytes; no text of a program has a longer one.
const LONGEST: u64 = 1 << 20;

/// What became of a text.
#[derive(Debug, Default)]
pub struct LaidOut {
    /// Lines.
    pub lines: u32,
    /// Lines that look otherwise now.
    pub changed: u32,
    /// Numbers of the first lines that could not be taken apart, and how many there are.
    pub unread: (Vec<u32>, u32),
    /// Why it cannot be laid out.
    pub refused: Option<Refused>,
}

/// Why a text is not laid out.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Refused {
    /// It is none: a byte 0, or a line without end.
    NotText(u32),
    /// A line, read again, does not say the same: a fault of ours.
    NotSame(u32),
}

/// So many lines are named.
const NAMED: usize = 5;

/// Lays a text out. The result is empty or unfinished, and not to be used, if it is refused.
///
/// # Errors
/// Reading or writing.
pub fn text(
    settings: &Settings,
    eol: &[u8],
    from: &mut dyn Readable,
    to: &mut dyn Write,
) -> io::Result<LaidOut> {
    from.seek(SeekFrom::Start(0))?;
    let mut from = BufReader::with_capacity(1 << 16, from);
    let mut to = BufWriter::with_capacity(1 << 16, to);
    let mut found = LaidOut::default();
    let mut lines = Both::new(settings);
    let (mut read, mut written) = (Vec::new(), Vec::new());
    loop {
        read.clear();
        written.clear();
        if from.by_ref().take(LONGEST).read_until(b'\n', &mut read)? == 0 {
            break;
        }
        found.lines += 1;
        if read.len() as u64 == LONGEST || memchr::memchr(0, &read).is_some() {
            found.refused = Some(Refused::NotText(found.lines));
            return Ok(found);
        }
        let ended = read.last() == Some(&b'\n');
        let mut line = read.strip_suffix(b"\n").unwrap_or(&read);
        while let Some(shorter) = line.strip_suffix(b"\r") {
            line = shorter;
        }
        let mark: &[u8] = match line.strip_prefix(b"\xEF\xBB\xBF") {
            Some(rest) if found.lines == 1 => {
                line = rest;
                b"\xEF\xBB\xBF"
            }
            Some(_) | None => b"",
        };
        let (is, says_same) = lines.lay_out(line, &mut written);
        if is == LineIs::Unread {
            found.unread.1 += 1;
            if found.unread.0.len() < NAMED {
                found.unread.0.push(found.lines);
            }
        }
        if !says_same {
            found.refused = Some(Refused::NotSame(found.lines));
            return Ok(found);
        }
        // A line's end is put behind the last block, but not behind the end of an old text file, nor
        // behind a text that was cut off where nothing is known of it.
        if ended || is == LineIs::Blocks || (is == LineIs::Frame && !line.is_empty()) {
            written.extend_from_slice(eol);
        }
        found.changed += u32::from(mark.len() + written.len() != read.len() || !read.ends_with(&written));
        to.write_all(mark)?;
        to.write_all(&written)?;
    }
    to.flush()?;
    Ok(found)
}

/// The text as it is read, and as it is read again once it is laid out.
struct Both<'s> {
    settings: &'s Settings,
    lines: Lines,
    again: Lines,
    pieces: [Vec<Piece>; 2],
    words: [PlainWord; MOST_PLAIN],
}

impl Both<'_> {
    fn new(settings: &Settings) -> Both<'_> {
        let lines = Lines::new(settings.clone());
        let (pieces, words) = ([Vec::new(), Vec::new()], [PlainWord::default(); MOST_PLAIN]);
        Both { settings, again: lines.clone(), lines, pieces, words }
    }

    /// Writes the next line again; gives what it is, and whether the result says the same.
    fn lay_out(&mut self, line: &[u8], written: &mut Vec<u8>) -> (LineIs, bool) {
        let alike = self.lines.stands_as(&self.again);
        if alike
            && let Some(words) = self.lines.plain(line, &mut self.words)
            && layout::is_laid_out(self.settings.dialect, line, words)
        {
            self.again.follow(&self.lines);
            written.extend_from_slice(line);
            return (LineIs::Blocks, true);
        }
        let [pieces, pieces_again] = &mut self.pieces;
        let mut is = self.lines.line(line, pieces);
        let family = self.settings.dialect.family;
        let is_calls = matches!(family, Family::Canon | Family::Ir);
        if is_calls && calls::line(line, family == Family::Ir, written) {
            is = LineIs::Blocks;
        }
        match is {
            LineIs::Blocks if is_calls => {}
            LineIs::Blocks => layout::line(self.settings.dialect, line, pieces, written),
            LineIs::Frame | LineIs::Outside | LineIs::Unread => written.extend_from_slice(line),
        }
        if is_calls {
            return (is, calls::same(line, written));
        }
        if alike && written == line {
            // The same bytes are taken apart in the same way.
            self.again.follow(&self.lines);
            return (is, true);
        }
        let is_again = self.again.line(written, pieces_again);
        let a = Taken { is, line, pieces };
        (is, same(a, Taken { is: is_again, line: written, pieces: pieces_again }))
    }
}
