//! `translate --map FILE`: the document that says of every emitted line where it comes from.
//!
//! One line of the document for each line of the output, written as they come: neither the document nor
//! the output is held in memory, only where the lines of the source begin. The rows of the dictionaries
//! that the lines refer to stand at its end. `docs/book/src/reference/provenance-map.md` describes the form; its schema is
//! [`SCHEMA`]. The number in `version` changes when a field changes its meaning or goes, not when one is
//! added.

use std::io::{self, BufWriter, Write};

use ncc_dialects::Settings;
use ncc_ir::source::Span;
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

use super::rows::Met;
use super::spool::{Row, Rows};
use super::text::Text;
use super::trace::{KINDS, Recorded};
use crate::job::Outcome;
use crate::render::About;
use crate::render::report::hex;
use crate::source::called_files::CalledFile;

/// The version of the form.
pub const VERSION: u64 = 1;

/// The form of the document, for machines.
pub const SCHEMA: &str = include_str!("../../schema/map.schema.json");

/// Bytes of a place in the source that are looked through for words.
const LONGEST: u32 = 1 << 13;

/// Writes the map of a released output of this name.
///
/// # Errors
/// Reading source or output again, or writing.
pub fn write(
    out: &mut dyn Write,
    about: &mut About,
    name: &str,
    outcome: &mut Outcome,
    record: Recorded,
) -> io::Result<()> {
    let mut out = BufWriter::new(out);
    let job = about.job;
    let mut hash = Hash(Sha256::new());
    outcome.output.write_to(&mut hash)?;
    let bytes = outcome.output.bytes();
    let source = Text::new(about.source)?;
    let side = |settings: &Settings, name: &str, bytes: u64, sha256: &[u8]| {
        json!({
            "name": name,
            "dialect": settings.dialect.id,
            "options": options(settings),
            "bytes": bytes,
            "sha256": hex(sha256),
        })
    };
    let mut from = side(&job.from, &job.source_name, outcome.source_bytes, &outcome.source_sha256);
    from["file"] = Value::from(about.name);
    if let Some(called) = &job.called {
        from["called"] = called.files.iter().map(account).collect();
    }
    writeln!(out, "{{\"version\": {VERSION},")?;
    writeln!(out, "\"ncc_version\": {},", json!(env!("CARGO_PKG_VERSION")))?;
    writeln!(out, "\"source\": {from},")?;
    writeln!(out, "\"output\": {},", side(&job.to, name, bytes, &hash.0.finalize()))?;
    writeln!(out, "\"events\": {},", record.events)?;
    writeln!(out, "\"text_end\": {},", record.text_end.map_or(Value::Null, Value::from))?;
    write!(out, "\"lines\": [")?;
    let mut lines = Lines {
        head: outcome.output.head_lines(),
        rows: record.rows.rows()?,
        row: Row::default(),
        source,
        from: Met::new(job.from.dialect),
        to: Met::new(job.to.dialect),
        out: &mut out,
        number: 0,
        start: 0,
        line: Vec::new(),
        last: Vec::new(),
        last_rows: Vec::new(),
        found: Vec::new(),
        spans: Vec::new(),
        text: Vec::new(),
    };
    outcome.output.write_to(&mut lines)?;
    lines.end()?;
    let (from, to) = (lines.from, lines.to);
    writeln!(out, "],")?;
    writeln!(out, "\"rows\": {},", serde_json::to_value(to.rows())?)?;
    writeln!(out, "\"source_rows\": {}}}", serde_json::to_value(from.rows())?)?;
    out.flush()
}

/// A file of a called program: its places are counted on from those of the source.
fn account(file: &CalledFile) -> Value {
    json!({
        "file": file.name,
        "bytes": file.bytes,
        "sha256": hex(&file.sha256),
        "start": file.places.0,
        "end": file.places.1,
        "lines_before": file.lines_before,
    })
}

/// Every option of a dialect with its value.
fn options(settings: &Settings) -> Value {
    let rows = settings.dialect.option.iter();
    rows.map(|row| (row.name.clone(), Value::from(settings.get(&row.name)))).collect()
}

/// Takes a text for its hash alone.
struct Hash(Sha256);

impl Write for Hash {
    fn write(&mut self, text: &[u8]) -> io::Result<usize> {
        self.0.update(text);
        Ok(text.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Takes the output, and writes an entry for each of its lines.
struct Lines<'a, 'f, W: Write> {
    /// Lines of the head, which stand first and of which nothing is recorded.
    head: usize,
    rows: Rows,
    row: Row,
    source: Text<'f>,
    from: Met,
    to: Met,
    out: &'a mut W,
    number: usize,
    /// Where the line begins in the output.
    start: u64,
    line: Vec<u8>,
    /// The places of the line before, and their rows.
    last: Vec<Span>,
    last_rows: Vec<usize>,
    found: Vec<usize>,
    /// Memory for places, and for the entry at hand.
    spans: Vec<Span>,
    text: Vec<u8>,
}

impl<W: Write> Write for Lines<'_, '_, W> {
    fn write(&mut self, text: &[u8]) -> io::Result<usize> {
        for part in text.split_inclusive(|b| *b == b'\n') {
            self.line.extend_from_slice(part);
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

impl<W: Write> Lines<'_, '_, W> {
    /// A last line without its end.
    fn end(&mut self) -> io::Result<()> {
        if !self.line.is_empty() {
            self.entry()?;
        }
        writeln!(self.out)
    }

    fn entry(&mut self) -> io::Result<()> {
        self.number += 1;
        let head = self.number <= self.head;
        if head {
            self.row = Row::default();
        } else {
            self.rows.next(&mut self.row)?;
        }
        let from = match (head, self.row.spans.is_empty()) {
            (true, _) => "head",
            (false, true) => "frame",
            (false, false) => "source",
        };
        let mut text = std::mem::take(&mut self.text);
        text.clear();
        text.extend_from_slice((if self.number > 1 { ",\n{\"line\":" } else { "\n{\"line\":" }).as_bytes());
        digits(&mut text, self.number as u64);
        field(&mut text, "start", self.start);
        text.extend_from_slice(b",\"from\":\"");
        text.extend_from_slice(from.as_bytes());
        text.push(b'"');
        self.places(&mut text)?;
        if !self.row.also.is_empty() {
            text.extend_from_slice(b",\"also\":[");
            by_line(&self.row.also, &self.source, &mut self.spans);
            self.list(&mut text)?;
        }
        events(&mut text, &self.row);
        self.to.line(&self.line, &mut self.found);
        numbers(&mut text, "rows", &self.found);
        numbers(&mut text, "source_rows", &self.last_rows);
        text.push(b'}');
        self.start += self.line.len() as u64;
        self.line.clear();
        let written = self.out.write_all(&text);
        self.text = text;
        written
    }

    /// The places of the line in the source; finds the rows of what stands there.
    fn places(&mut self, text: &mut Vec<u8>) -> io::Result<()> {
        if self.row.spans.is_empty() {
            self.last_rows.clear();
            self.last.clear();
            return Ok(());
        }
        text.extend_from_slice(b",\"source\":[");
        by_line(&self.row.spans, &self.source, &mut self.spans);
        if self.last != self.row.spans {
            self.last_rows.clear();
            for span in &self.spans {
                let end = span.end.min(span.start.saturating_add(LONGEST));
                let said = self.source.stretch(span.start, end)?;
                for line in said.split(|b| *b == b'\n') {
                    self.from.line(line, &mut self.found);
                    for row in &self.found {
                        if !self.last_rows.contains(row) {
                            self.last_rows.push(*row);
                        }
                    }
                }
            }
            self.last.clone_from(&self.row.spans);
        }
        self.list(text)
    }

    /// The places at hand, and the end of their list.
    fn list(&mut self, text: &mut Vec<u8>) -> io::Result<()> {
        for (at, span) in self.spans.iter().enumerate() {
            let (line, column) = (self.source.line_of(span.start), self.source.column_of(span.start)?);
            text.extend_from_slice((if at > 0 { ",{\"start\":" } else { "{\"start\":" }).as_bytes());
            digits(text, u64::from(span.start));
            field(text, "end", u64::from(span.end));
            field(text, "line", line as u64);
            field(text, "column", column as u64);
            text.push(b'}');
        }
        text.push(b']');
        Ok(())
    }
}

/// The events of a line.
fn events(text: &mut Vec<u8>, row: &Row) {
    for (at, stretch) in row.stretches.iter().enumerate() {
        text.extend_from_slice((if at > 0 { ",{\"first\":" } else { ",\"events\":[{\"first\":" }).as_bytes());
        digits(text, stretch.first);
        field(text, "last", stretch.last);
        text.extend_from_slice(b",\"kinds\":[");
        let kinds = KINDS.iter().enumerate().filter(|(bit, _)| stretch.kinds >> bit & 1 == 1);
        for (at, (_, kind)) in kinds.enumerate() {
            text.extend_from_slice((if at > 0 { ",\"" } else { "\"" }).as_bytes());
            text.extend_from_slice(kind.as_bytes());
            text.push(b'"');
        }
        text.extend_from_slice(b"]}");
    }
    if !row.stretches.is_empty() {
        text.push(b']');
    }
    if row.more > 0 {
        field(text, "more_events", row.more);
    }
}

/// Stretches of one line of the source as one, in their order.
fn by_line(spans: &[Span], source: &Text, places: &mut Vec<Span>) {
    places.clear();
    for span in spans {
        if places.is_empty() {
            places.push(*span);
            continue;
        }
        let line = source.line_of(span.start);
        match places.iter_mut().find(|place| source.line_of(place.start) == line) {
            Some(place) => *place = place.to(*span),
            None => places.push(*span),
        }
    }
}

/// A further field of an object.
fn field(text: &mut Vec<u8>, name: &str, value: u64) {
    text.extend_from_slice(b",\"");
    text.extend_from_slice(name.as_bytes());
    text.extend_from_slice(b"\":");
    digits(text, value);
}

/// A number in decimal digits.
fn digits(text: &mut Vec<u8>, value: u64) {
    // Places in a text are within 32 bits, and far cheaper to divide.
    let Ok(mut value) = u32::try_from(value) else {
        return text.extend_from_slice(value.to_string().as_bytes());
    };
    let mut all = [0; 10];
    let mut from = all.len();
    loop {
        from -= 1;
        all[from] = b'0' + (value % 10) as u8;
        value /= 10;
        if value == 0 {
            return text.extend_from_slice(&all[from..]);
        }
    }
}

fn numbers(text: &mut Vec<u8>, name: &str, numbers: &[usize]) {
    for (at, number) in numbers.iter().enumerate() {
        match at {
            0 => {
                text.extend_from_slice(b",\"");
                text.extend_from_slice(name.as_bytes());
                text.extend_from_slice(b"\":[");
            }
            _ => text.push(b','),
        }
        digits(text, *number as u64);
    }
    if !numbers.is_empty() {
        text.push(b']');
    }
}

#[cfg(test)]
mod tests {
    use super::digits;

    #[test]
    fn numbers_are_written_as_they_are_shown() {
        for value in [0, 9, 10, 99, 100, 1_234_567_890, u64::from(u32::MAX), 1 << 32, u64::MAX] {
            let mut text = Vec::new();
            digits(&mut text, value);
            assert_eq!(text, value.to_string().as_bytes());
        }
    }
}
