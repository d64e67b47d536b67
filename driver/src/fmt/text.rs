//! A whole text laid out, line by line in constant memory, each line judged as it is written.
//!
//! Not here: how a line looks (`layout`), and what the program does (`events`).

use std::io::{self, BufRead, BufReader, BufWriter, Read, SeekFrom, Write};

use ncc_dialects::{Family, Settings};
use ncc_frontends::pieces::{LineIs, Lines};

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
    let (mut lines, mut again) = (Lines::new(settings.clone()), Lines::new(settings.clone()));
    let (mut read, mut written) = (Vec::new(), Vec::new());
    let (mut pieces, mut pieces_again) = (Vec::new(), Vec::new());
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
        let mut is = lines.line(line, &mut pieces);
        let family = settings.dialect.family;
        let is_calls = matches!(family, Family::Canon | Family::Ir);
        if is_calls && calls::line(line, family == Family::Ir, &mut written) {
            is = LineIs::Blocks;
        }
        match is {
            LineIs::Blocks if is_calls => {}
            LineIs::Blocks => layout::line(settings.dialect, line, &pieces, &mut written),
            LineIs::Frame | LineIs::Outside => written.extend_from_slice(line),
            LineIs::Unread => {
                written.extend_from_slice(line);
                found.unread.1 += 1;
                if found.unread.0.len() < NAMED {
                    found.unread.0.push(found.lines);
                }
            }
        }
        let says_same = if is_calls {
            calls::same(line, &written)
        } else {
            let is_again = again.line(&written, &mut pieces_again);
            let a = Taken { is, line, pieces: &pieces };
            same(a, Taken { is: is_again, line: &written, pieces: &pieces_again })
        };
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
