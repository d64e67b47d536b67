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
        last: None,
        last_rows: Vec::new(),
        found: Vec::new(),
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
    last: Option<Vec<Span>>,
    last_rows: Vec<usize>,
    found: Vec<usize>,
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
        let comma = if self.number > 1 { "," } else { "" };
        let (number, start) = (self.number, self.start);
        write!(self.out, "{comma}\n{{\"line\":{number},\"start\":{start},\"from\":\"{from}\"")?;
        self.places()?;
        if !self.row.also.is_empty() {
            write!(self.out, ",\"also\":[")?;
            let places = by_line(&self.row.also, &self.source);
            self.list(&places)?;
        }
        if !self.row.stretches.is_empty() {
            write!(self.out, ",\"events\":[")?;
            for (at, stretch) in self.row.stretches.iter().enumerate() {
                let comma = if at > 0 { "," } else { "" };
                let (first, last) = (stretch.first, stretch.last);
                write!(self.out, "{comma}{{\"first\":{first},\"last\":{last},\"kinds\":[")?;
                let kinds = KINDS.iter().enumerate().filter(|(bit, _)| stretch.kinds >> bit & 1 == 1);
                for (at, (_, kind)) in kinds.enumerate() {
                    write!(self.out, "{}\"{kind}\"", if at > 0 { "," } else { "" })?;
                }
                write!(self.out, "]}}")?;
            }
            write!(self.out, "]")?;
        }
        if self.row.more > 0 {
            write!(self.out, ",\"more_events\":{}", self.row.more)?;
        }
        self.to.line(&self.line, &mut self.found);
        numbers(self.out, "rows", &self.found)?;
        numbers(self.out, "source_rows", &self.last_rows)?;
        self.start += self.line.len() as u64;
        self.line.clear();
        write!(self.out, "}}")
    }

    /// The places of the line in the source; finds the rows of what stands there.
    fn places(&mut self) -> io::Result<()> {
        let fresh = self.last.as_ref() != Some(&self.row.spans);
        if fresh {
            self.last_rows.clear();
        }
        if self.row.spans.is_empty() {
            self.last = None;
            return Ok(());
        }
        write!(self.out, ",\"source\":[")?;
        let places = by_line(&self.row.spans, &self.source);
        if fresh {
            for span in &places {
                let end = span.end.min(span.start.saturating_add(LONGEST));
                let text = self.source.stretch(span.start, end)?;
                for line in text.split(|b| *b == b'\n') {
                    self.from.line(line, &mut self.found);
                    for row in &self.found {
                        if !self.last_rows.contains(row) {
                            self.last_rows.push(*row);
                        }
                    }
                }
            }
            self.last = Some(self.row.spans.clone());
        }
        self.list(&places)
    }

    /// Places, and the end of their list.
    fn list(&mut self, places: &[Span]) -> io::Result<()> {
        for (at, span) in places.iter().enumerate() {
            let (line, column) = (self.source.line_of(span.start), self.source.column_of(span.start)?);
            let comma = if at > 0 { "," } else { "" };
            let (start, end) = (span.start, span.end);
            write!(
                self.out,
                "{comma}{{\"start\":{start},\"end\":{end},\"line\":{line},\"column\":{column}}}"
            )?;
        }
        write!(self.out, "]")
    }
}

/// Stretches of one line of the source as one, in their order.
fn by_line(spans: &[Span], source: &Text) -> Vec<Span> {
    let mut places: Vec<Span> = Vec::with_capacity(spans.len());
    for span in spans {
        let line = source.line_of(span.start);
        match places.iter_mut().find(|place| source.line_of(place.start) == line) {
            Some(place) => *place = place.to(*span),
            None => places.push(*span),
        }
    }
    places
}

fn numbers(out: &mut impl Write, name: &str, numbers: &[usize]) -> io::Result<()> {
    if numbers.is_empty() {
        return Ok(());
    }
    write!(out, ",\"{name}\":[")?;
    for (at, number) in numbers.iter().enumerate() {
        write!(out, "{}{number}", if at > 0 { "," } else { "" })?;
    }
    write!(out, "]")
}
