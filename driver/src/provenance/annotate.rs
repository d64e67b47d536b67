//! `--annotate`: the source beside the text, as a comment at the end of each line whose source is another
//! than that of the line before.
//!
//! It is done before the text is verified, so that a comment that were none would be found. Lines that are
//! comments themselves, and lines that no line of the source says, stay as they are.

use std::io::{self, Read, Seek, SeekFrom, Write};

use ncc_backends::{Origin, Writer};
use ncc_dialects::{Dialect, Family};
use ncc_ir::source::Span;

use super::text::readable;
use crate::source::spool::Spool;

/// Most characters of a comment.
const LONGEST: usize = 100;

/// Most source lines named for one line of the output.
const MOST_LINES: usize = 3;

/// Fewest characters that are worth a comment.
const FEWEST: usize = 6;

/// Bytes of the source that are kept in memory.
const WINDOW: usize = 1 << 17;

/// Whether a dialect has comments that can stand at the end of a line.
pub fn can(dialect: &Dialect) -> bool {
    match dialect.family {
        Family::Word | Family::Sinumerik => !dialect.comment.open.is_empty(),
        Family::Ir => true,
        Family::Canon => false,
    }
}

/// Puts the source beside the text.
#[derive(Debug)]
pub struct Annotator {
    dialect: &'static Dialect,
    source: Recall,
    /// Lines of the source that were reported last.
    last_lines: Vec<(usize, usize)>,
    /// Whether the text handed over so far ends amid a line.
    open: bool,
}

impl Annotator {
    pub(crate) fn new(to: &'static Dialect) -> Annotator {
        Annotator { dialect: to, source: Recall::new(), last_lines: Vec::new(), open: false }
    }

    /// Further text of the source, from this place on.
    ///
    /// # Errors
    /// The temporary file cannot be written.
    pub fn source(&mut self, text: &[u8], base: u32) -> io::Result<()> {
        self.source.push(text, base)
    }

    /// A piece of emitted text, with comments.
    ///
    /// # Errors
    /// The temporary file cannot be read.
    pub fn apply(&mut self, text: &[u8], origins: &[Origin], writer: &mut Writer) -> io::Result<Vec<u8>> {
        let mut out = Vec::with_capacity(text.len() * 2);
        let mut lines =
            origins.iter().flat_map(|o| std::iter::repeat_n(o.spans.as_slice(), o.lines as usize));
        for line in text.split_inclusive(|b| *b == b'\n') {
            let Some(whole) = line.strip_suffix(b"\n") else {
                out.extend_from_slice(line);
                self.open = true;
                continue;
            };
            let said = whole.strip_suffix(b"\r").unwrap_or(whole);
            out.extend_from_slice(said);
            let spans = lines.next().unwrap_or_default();
            let open = std::mem::take(&mut self.open);
            if open || !self.is_comment(said) && !self.has_text(said) {
                self.beside(spans, said.len(), writer, &mut out)?;
            }
            out.extend_from_slice(&line[said.len()..]);
        }
        Ok(out)
    }

    /// Whether a comment of a line may be the text of what is set there, an alarm's: no other stands beside it.
    fn has_text(&self, line: &[u8]) -> bool {
        let rules = &self.dialect.formula;
        let comment = self.dialect.comment.open.as_bytes();
        rules.alarm_text > 0
            && line.contains(&b'=')
            && memchr::memmem::find(line, comment).is_some()
            && memchr::memmem::find(line, rules.variable.as_bytes()).is_some()
    }

    /// Whether a line is nothing, or nothing but a comment.
    fn is_comment(&self, line: &[u8]) -> bool {
        let open = match self.dialect.family {
            Family::Ir => "COMMENT(",
            Family::Word | Family::Sinumerik | Family::Canon => self.dialect.comment.open.trim_end(),
        };
        let line = line.trim_ascii();
        line.is_empty() || (!open.is_empty() && line.starts_with(open.as_bytes()))
    }

    fn beside(
        &mut self,
        spans: &[Span],
        len: usize,
        writer: &mut Writer,
        out: &mut Vec<u8>,
    ) -> io::Result<()> {
        let mut lines: Vec<(usize, usize)> = Vec::new();
        for span in spans {
            let place = (self.source.line_of(span.start), self.source.line_of(span.end.max(1) - 1));
            if !lines.contains(&place) {
                lines.push(place);
            }
        }
        if lines.is_empty() || lines == self.last_lines {
            return Ok(());
        }
        let left = match self.dialect.block.longest as usize {
            0 => LONGEST,
            most => most.saturating_sub(len + 2 * self.dialect.comment.open.len() + 4).min(LONGEST),
        };
        if left < FEWEST {
            return Ok(());
        }
        let mut text = String::new();
        for (first, last) in &lines[lines.len().saturating_sub(MOST_LINES)..] {
            if !text.is_empty() {
                text.push_str(" | ");
            }
            text.push_str(&match last > first {
                true => format!("{first}-{last}: "),
                false => format!("{first}: "),
            });
            text.push_str(self.source.line(*first)?.trim());
        }
        if let Some((at, _)) = text.char_indices().nth(left) {
            text.truncate(at);
        }
        writer.beside(text.trim_end(), out);
        self.last_lines = lines;
        Ok(())
    }
}

/// The source as far as it was read, of which any line can be read again.
#[derive(Debug)]
struct Recall {
    file: Spool,
    /// Where lines begin.
    starts: Vec<u32>,
    /// The last bytes.
    window: Vec<u8>,
    window_at: u32,
    bytes: u32,
}

impl Recall {
    fn new() -> Recall {
        Recall { file: Spool::default(), starts: vec![0], window: Vec::new(), window_at: 0, bytes: 0 }
    }

    fn push(&mut self, text: &[u8], base: u32) -> io::Result<()> {
        self.file.seek(SeekFrom::Start(u64::from(base)))?;
        self.file.write_all(text)?;
        self.starts.extend(memchr::memchr_iter(b'\n', text).map(|at| base + at as u32 + 1));
        if base != self.bytes || self.window.len() > WINDOW {
            let keep = if base == self.bytes { self.window.len() - WINDOW / 2 } else { self.window.len() };
            self.window.drain(..keep);
            self.window_at = base - self.window.len() as u32;
        }
        self.window.extend_from_slice(text);
        self.bytes = base + text.len() as u32;
        Ok(())
    }

    fn line_of(&self, place: u32) -> usize {
        self.starts.partition_point(|start| *start <= place)
    }

    fn line(&mut self, number: usize) -> io::Result<String> {
        let start = self.starts.get(number - 1).copied().unwrap_or(self.bytes);
        let end = self.starts.get(number).copied().unwrap_or(self.bytes);
        if let Some(from) = start.checked_sub(self.window_at) {
            let to = (end - self.window_at) as usize;
            return Ok(readable(self.window.get(from as usize..to).unwrap_or_default(), LONGEST));
        }
        self.file.seek(SeekFrom::Start(u64::from(start)))?;
        let mut bytes = Vec::new();
        (&mut self.file).take(u64::from(end - start).min(4 * LONGEST as u64)).read_to_end(&mut bytes)?;
        Ok(readable(&bytes, LONGEST))
    }
}
