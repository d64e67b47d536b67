//! Editor requests: lay out a program, list its names, find a called program, rename.
//!
//! Lines count from 1. Columns count UTF-16 units from 0.
//! Not here: the work on the text (`ncc_driver::fmt`, `ncc_driver::names`).

use std::io::{self, Read, Seek};

use codespan_reporting::term::termcolor::Buffer;
use ncc_backends::Numbering;
use ncc_driver::fmt::whole;
use ncc_driver::names::{self, rename};
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::side::Side;
use ncc_driver::source::called_files::CalledFile;
use serde_json::{Value, json};

use crate::colours::column;
use crate::program::{Files, Outputs, side, side_alone};
use crate::request::{Called, Layout, One, Rename};

fn all(side: &mut Side, name: &str) -> Result<Vec<u8>, Problem> {
    let mut text = Vec::new();
    let done = side.source.file.rewind().and_then(|()| side.source.file.read_to_end(&mut text).map(drop));
    done.map_err(|e: io::Error| Problem::file("read", name, &e))?;
    Ok(text)
}

/// Lays out a program and renumbers its blocks if the request asks for it. Gives the text as `output`.
pub(crate) fn layout(
    asked: &Layout,
    files: &Files,
    messages: &mut Buffer,
) -> Result<(Exit, Outputs), Problem> {
    let one = asked.one();
    let cannot = |e: io::Error| Problem::file("read", &one.file, &e);
    let Side { mut source, mut job } = side_alone(&one, files, messages)?;
    job.layout.crlf = source.is_crlf()?;
    job.layout.numbering = match asked.number {
        Some([first, step]) => Numbering::Every { first, step },
        None => whole::numbering(&job),
    };
    source.rewind()?;
    let mut done = whole::lay_out(&job, &mut source)?;
    let mut text = Vec::new();
    done.file.rewind().and_then(|()| done.file.read_to_end(&mut text).map(drop)).map_err(cannot)?;
    Ok((Exit::Done, vec![("output", text)]))
}

/// Lists the names of a program as JSON `document`: sort, text, and whether other files may use it.
///
/// `places` holds five numbers for each use: index of the name, line, first column, end column (exclusive), and 1 if
/// the use defines the name.
pub(crate) fn names(one: &One, files: &Files, messages: &mut Buffer) -> Result<(Exit, Outputs), Problem> {
    let mut side = side_alone(one, files, messages)?;
    let text = all(&mut side, &one.file)?;
    let found = names::find(&side.job.from, &text);
    let lines = Lines::of(&text);
    let mut places: Vec<usize> = Vec::new();
    for (number, name) in found.names.iter().enumerate() {
        for place in &name.places {
            let at = |byte| lines.column(&text, place.line as usize, byte);
            places.extend([number, place.line as usize, at(place.range.start), at(place.range.end)]);
            places.push(usize::from(place.defines));
        }
    }
    let about =
        |name: &names::Name| json!({ "sort": name.sort, "text": name.text, "shared": name.is_shared() });
    let names: Vec<Value> = found.names.iter().map(about).collect();
    let document = json!({ "names": names, "places": places });
    Ok((Exit::Done, vec![("document", serde_json::to_vec(&document).unwrap_or_default())]))
}

/// Finds the start of the program called at a position. Gives its file and line; no output if none is found.
pub(crate) fn called(
    asked: &Called,
    files: &Files,
    messages: &mut Buffer,
) -> Result<(Exit, Outputs), Problem> {
    let one = asked.one();
    let mut side = side(&one, files, messages)?;
    let text = all(&mut side, &one.file)?;
    let found = names::find(&side.job.from, &text);
    let byte = Lines::of(&text).byte(&text, asked.line, asked.column);
    let programs: Vec<_> = found.names.iter().filter(|name| name.sort == names::Sort::Program).collect();
    let calls: Vec<_> = programs
        .iter()
        .flat_map(|name| name.places.iter().map(move |place| (*name, place)))
        .filter(|(_, place)| place.line as usize == asked.line && !place.defines)
        .collect();
    // A position on the character before a name also selects the name.
    let is_there =
        |(_, place): &&(_, &names::Place)| place.range.start <= byte + 1 && byte <= place.range.end;
    let here = calls.iter().find(is_there).or(calls.first().filter(|_| calls.len() == 1));
    let place = here.and_then(|(name, _)| name.places.iter().find(|place| place.defines));
    let Some(place) = place else { return Ok((Exit::Done, Vec::new())) };
    let start = place.range.start;
    let behind = side.source.called.as_ref().map_or(&[][..], |called| &called.files);
    // A program named only by its file has a heading line before the text of the file.
    let heads = |file: &&CalledFile| {
        let (from, to) = (file.places.0 as usize, file.places.1 as usize);
        start < to && (start >= from || text[start..from].iter().filter(|byte| **byte == b'\n').count() == 1)
    };
    let line = u64::from(place.line);
    let (file, line) = match behind.iter().find(heads) {
        Some(file) => (file.name.as_str(), line.saturating_sub(file.lines_before).max(1)),
        None => (one.file.as_str(), line),
    };
    let document = json!({ "file": file, "line": line });
    Ok((Exit::Done, vec![("document", serde_json::to_vec(&document).unwrap_or_default())]))
}

/// Renames the name at a position in the whole program. Gives the text as `output`.
pub(crate) fn renamed(
    asked: &Rename,
    files: &Files,
    messages: &mut Buffer,
) -> Result<(Exit, Outputs), Problem> {
    let one = asked.one();
    let mut side = side_alone(&one, files, messages)?;
    let text = all(&mut side, &one.file)?;
    let place = Lines::of(&text).byte(&text, asked.line, asked.column);
    let written = rename::rename(&side.job, &text, place, &asked.to)?;
    Ok((Exit::Done, vec![("output", written)]))
}

/// Byte offsets of the line starts of a text.
struct Lines(Vec<usize>);

impl Lines {
    fn of(text: &[u8]) -> Lines {
        let ends = text.iter().enumerate().filter(|(_, byte)| **byte == b'\n').map(|(at, _)| at + 1);
        Lines(std::iter::once(0).chain(ends).collect())
    }

    /// Byte offset of a line, and its bytes. `line` counts from 1.
    fn line<'t>(&self, text: &'t [u8], line: usize) -> (usize, &'t [u8]) {
        let start = self.0.get(line.saturating_sub(1)).copied().unwrap_or(text.len());
        let end = self.0.get(line).copied().unwrap_or(text.len());
        (start, &text[start..end])
    }

    fn column(&self, text: &[u8], line: usize, byte: usize) -> usize {
        let (start, own) = self.line(text, line);
        column(own, byte.saturating_sub(start))
    }

    fn byte(&self, text: &[u8], line: usize, wanted: usize) -> usize {
        let (start, own) = self.line(text, line);
        start + (0..own.len()).find(|byte| column(own, *byte) >= wanted).unwrap_or(own.len())
    }
}
