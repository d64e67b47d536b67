//! `ncc why OUT:LINE`: where a line of an emitted program comes from, by which rows of the dictionaries, and
//! what is active before and after it.

use std::io::{self, Write};

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::provenance::state::{Around, State, WHAT, around};
use ncc_driver::provenance::text::Text;
use ncc_driver::source::Source;
use ncc_driver::source::called_files::Called;
use serde::Serialize;

use super::args::Why;
use super::find::{Found, find};
use super::read::{Events, Place, Row, own_settings};
use crate::args::typed::Format;
use crate::files;
use crate::registry::DialectRegistry;

/// The version of the answer's form.
const VERSION: u32 = 1;

/// The form of the answer as JSON.
pub const SCHEMA: &str = include_str!("../../../driver/schema/why.schema.json");

/// Most characters of a line that are shown.
const LONGEST: usize = 160;

/// What is known of a line.
#[derive(Debug, Serialize)]
struct Answer {
    version: u32,
    file: String,
    line: usize,
    text: String,
    from: String,
    source: Vec<Origin>,
    /// Further places of which the line makes the events.
    also: Vec<Origin>,
    events: Vec<Events>,
    more_events: u64,
    rows: Vec<Row>,
    source_rows: Vec<Row>,
    /// `known`, `not executed` or `unknown`.
    state: &'static str,
    modal: Vec<Modal>,
}

/// A line of the source.
#[derive(Debug, Serialize)]
struct Origin {
    file: String,
    line: usize,
    column: usize,
    start: u32,
    end: u32,
    text: String,
}

/// An active fact; `null` is what the program has not said.
#[derive(Debug, Serialize)]
struct Modal {
    what: &'static str,
    before: Option<String>,
    after: Option<String>,
}

/// Runs the verb.
///
/// # Errors
/// Wrong usage, a file that cannot be read, or one that is not what the map was made of.
pub fn run(args: &Why, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    let answer = ask(args, known, err)?;
    let to_stdout = match args.format {
        Format::Json => files::data_to_stdout,
        Format::Human => files::to_stdout,
    };
    to_stdout(&mut |out| match args.format {
        Format::Json => {
            serde_json::to_writer_pretty(&mut *out, &answer)?;
            out.write_all(b"\n")
        }
        Format::Human => tell(out, &answer),
    })?;
    Ok(Exit::Done)
}

/// Answers as JSON, without printing it.
///
/// # Errors
/// As of [`run`].
pub fn document(
    args: &Why,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<serde_json::Value, Problem> {
    let answer = ask(args, known, err)?;
    serde_json::to_value(&answer).map_err(|e| Problem::file("write", "the answer", &e.into()))
}

fn ask(args: &Why, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Answer, Problem> {
    let (path, line) = &args.place;
    let mut output = files::open(path)?;
    let wrong = |e: io::Error| Problem::file("read", &path.display().to_string(), &e);
    let (lines, sha256) = {
        let (text, sha256) = Text::hashed(&mut output.file).map_err(wrong)?;
        (text.lines(), sha256)
    };
    if *line > lines {
        let counted = match lines {
            0 => "is empty".to_owned(),
            1 => "has one line".to_owned(),
            n => format!("has {n} lines"),
        };
        let help = "name one of its lines".to_owned();
        return Err(Problem::usage(format!("{} {counted}, there is no line {line}", path.display()), help));
    }
    let found = find(args, &mut output, &sha256, known, err)?;
    answer(args, found, &mut output, known)
}

fn answer(args: &Why, found: Found, output: &mut Source, known: &DialectRegistry) -> Result<Answer, Problem> {
    let (path, line) = &args.place;
    let Found { document, mut source } = found;
    let wrong = |e: io::Error| Problem::file("read", &path.display().to_string(), &e);
    let entry = document.entry.ok_or_else(|| Problem {
        exit: Exit::File,
        message: format!("the map of {} has no line {line}", path.display()),
        help: vec!["translate again, with --map".to_owned()],
    })?;
    let (text, bounds) = {
        let mut text = Text::new(&mut output.file).map_err(wrong)?;
        let start = text.line(*line).map_err(wrong)?.unwrap_or_default().0;
        let next = text.line(line + 1).map_err(wrong)?.map_or(u32::MAX, |next| next.0);
        (text.shown(*line, LONGEST).map_err(wrong)?.unwrap_or_default(), (start, next))
    };
    let shown = source.shown.clone();
    let called = source.called.clone();
    let no_source = |e: io::Error| Problem::file("read", &shown, &e);
    let mut from = Text::new(&mut source.file).map_err(no_source)?;
    let origins = places(&entry.source, &mut from, &shown, called.as_ref()).map_err(no_source)?;
    let also = places(&entry.also, &mut from, &shown, called.as_ref()).map_err(no_source)?;
    let rows = |all: &[Row], some: &[usize]| some.iter().filter_map(|at| all.get(*at).cloned()).collect();
    let around = match own_settings(&document.output, known) {
        Some(settings) => {
            output.rewind()?;
            around(&settings, &mut output.file, bounds).map_err(wrong)?
        }
        None => Around::Unknown,
    };
    let (state, modal) = match around {
        Around::Known(states) => ("known", modal(*states)),
        Around::NotExecuted => ("not executed", Vec::new()),
        Around::Unknown => ("unknown", Vec::new()),
    };
    Ok(Answer {
        version: VERSION,
        file: path.display().to_string(),
        line: *line,
        text,
        from: entry.from,
        source: origins,
        also,
        events: entry.events,
        more_events: entry.more_events,
        rows: rows(&document.rows, &entry.rows),
        source_rows: rows(&document.source_rows, &entry.source_rows),
        state,
        modal,
    })
}

fn places(
    places: &[Place],
    source: &mut Text,
    shown: &str,
    called: Option<&Called>,
) -> io::Result<Vec<Origin>> {
    let mut origins = Vec::with_capacity(places.len());
    for place in places {
        let line = source.line_of(place.start);
        let file = called.and_then(|called| called.file(place.start));
        let before = file.map_or(0, |file| file.lines_before as usize);
        origins.push(Origin {
            file: file.map_or(shown, |file| &file.name).to_owned(),
            line: line.saturating_sub(before).max(1),
            column: source.column_of(place.start)?,
            start: place.start,
            end: place.end,
            text: source.shown(line, LONGEST)?.unwrap_or_default(),
        });
    }
    Ok(origins)
}

fn modal([before, after]: [State; 2]) -> Vec<Modal> {
    let both = before.into_iter().zip(after);
    WHAT.iter().zip(both).map(|(what, (before, after))| Modal { what, before, after }).collect()
}

fn tell(out: &mut dyn Write, answer: &Answer) -> io::Result<()> {
    writeln!(out, "{}:{}: {}", answer.file, answer.line, answer.text)?;
    match answer.from.as_str() {
        "head" => writeln!(out, "  in the head: the program's name and the comment that ncc has written")?,
        "frame" => writeln!(
            out,
            "  no line of the source says it: a mark, a header, a fact taken for granted, the shop's own line"
        )?,
        _ => {}
    }
    for origin in &answer.source {
        writeln!(out, "  from {}:{}: {}", origin.file, origin.line, origin.text.trim())?;
    }
    for origin in &answer.also {
        writeln!(out, "   and {}:{}: {}", origin.file, origin.line, origin.text.trim())?;
    }
    for events in &answer.events {
        let which = match events.first == events.last {
            true => format!("event {}", events.first),
            false => format!("events {} to {}", events.first, events.last),
        };
        writeln!(out, "  does {} ({which})", events.kinds.join(", "))?;
    }
    if answer.more_events > 0 {
        writeln!(out, "  and {} events more", answer.more_events)?;
    }
    rows(out, "Its words", &answer.rows)?;
    rows(out, "Words of the source", &answer.source_rows)?;
    match answer.state {
        "known" => {}
        "not executed" => return writeln!(out, "\nThe program does not reach this line."),
        _ => return writeln!(out, "\nWhat is active there could not be found out."),
    }
    let said: Vec<&Modal> = answer.modal.iter().filter(|m| m.before.is_some() || m.after.is_some()).collect();
    let shown = |value: &Option<String>| value.clone().unwrap_or_else(|| "not said".to_owned());
    let wide = said.iter().map(|m| shown(&m.before).chars().count()).max().unwrap_or(0).max(6);
    writeln!(out, "\nIn force         {:wide$}  after", "before")?;
    for modal in said {
        let (before, after) = (shown(&modal.before), shown(&modal.after));
        let after = if before == after { "=" } else { &after };
        writeln!(out, "  {:15}{before:wide$}  {after}", modal.what)?;
    }
    Ok(())
}

fn rows(out: &mut dyn Write, title: &str, rows: &[Row]) -> io::Result<()> {
    let Some(first) = rows.first() else { return Ok(()) };
    writeln!(out, "\n{title} in the dictionary {} (? is not confirmed)", first.dialect)?;
    let wide = rows.iter().map(|row| row.id.chars().count()).max().unwrap_or(0);
    let meaning = rows.iter().map(|row| row.meaning.chars().count()).max().unwrap_or(0);
    for row in rows {
        let mark = if row.sure { ' ' } else { '?' };
        writeln!(out, "{mark} {:wide$}  {:meaning$}  {}", row.id, row.meaning, row.source)?;
    }
    Ok(())
}
