//! The first line of the source that each line of an output comes from: what a page needs to show both side by side.

use std::io::{self, Write};

use super::spool::{Row, Rows};
use super::text::Text;
use super::trace::Recorded;
use crate::job::Outcome;
use crate::source::Readable;

/// Lines of the source, counted from 1, one for each line of a released output; 0 where the source says nothing of it.
///
/// # Errors
/// Reading source or output again.
pub fn pairs(source: &mut dyn Readable, outcome: &mut Outcome, record: Recorded) -> io::Result<Vec<u32>> {
    let mut lines = Lines {
        head: outcome.output.head_lines(),
        rows: record.rows.rows()?,
        row: Row::default(),
        source: Text::new(source)?,
        open: false,
        found: Vec::new(),
    };
    outcome.output.write_to(&mut lines)?;
    if lines.open {
        lines.entry()?;
    }
    Ok(lines.found)
}

/// Takes the output line by line.
struct Lines<'f> {
    /// Lines of the head, of which nothing is recorded.
    head: usize,
    rows: Rows,
    row: Row,
    source: Text<'f>,
    /// Whether a line has begun.
    open: bool,
    found: Vec<u32>,
}

impl Lines<'_> {
    fn entry(&mut self) -> io::Result<()> {
        self.open = false;
        let mut line = 0;
        if self.found.len() >= self.head {
            self.rows.next(&mut self.row)?;
            line = self.row.spans.first().map_or(0, |span| self.source.line_of(span.start));
        }
        self.found.push(u32::try_from(line).unwrap_or(0));
        Ok(())
    }
}

impl Write for Lines<'_> {
    fn write(&mut self, text: &[u8]) -> io::Result<usize> {
        for part in text.split_inclusive(|byte| *byte == b'\n') {
            self.open = true;
            if part.ends_with(b"\n") {
                self.entry()?;
            }
        }
        Ok(text.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
