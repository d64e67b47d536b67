//! Diagnostics for programs: one JSON object a line on stderr.

use std::collections::BTreeMap;
use std::io::{self, Write};

use codespan_reporting::diagnostic::Severity;
use ncc_ir::diag::Diagnostic;
use ncc_ir::rank::Rank;
use serde::Serialize;

use super::about::{About, Loudness, Place, Told};
use super::human::{choose, reported};
use super::line::line;
use super::messages::message::Value;
use crate::job::Counted;

/// A diagnostic, as it stands in a line of `--format json` and in a report.
#[derive(Debug, Serialize)]
pub struct Entry {
    /// `NC0107`.
    pub code: String,
    /// `error`, `warning` or `note`; what stops the translation is an error.
    pub severity: &'static str,
    /// The verdict, if it is one.
    pub verdict: Option<&'static str>,
    /// What a user has to do about it, if it is no error: `dangerous`, `check-at-the-machine`, `usual-default` or
    /// `no-effect-on-the-cut`.
    pub rank: Option<&'static str>,
    /// What is wrong, or what became of the place.
    pub message: String,
    /// The entry of these words in `messages/`: `NC0225-units`.
    pub entry: String,
    /// The values in them, by their names.
    pub values: BTreeMap<&'static str, Value>,
    /// Its place.
    pub place: JsonPlace,
    /// Further places.
    pub related: Vec<JsonPlace>,
    /// Facts that are too long for a label.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub details: Vec<String>,
    /// What to do.
    pub advice: Vec<String>,
}

/// A place, with line and column counted from 1; a column is a character.
#[derive(Debug, Serialize)]
pub struct JsonPlace {
    /// First byte in the source.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
    /// Line of the start.
    pub line: u64,
    /// Column of the start.
    pub column: u64,
    /// Column of the end, or of the end of the line if the place goes on.
    pub end_column: u64,
    /// The text there, up to the end of the line.
    pub text: String,
    /// Why this place.
    pub label: String,
}

impl From<Told> for Entry {
    fn from(told: Told) -> Entry {
        Entry::of(&told)
    }
}

impl Entry {
    /// Of a diagnostic in words.
    pub fn of(told: &Told) -> Entry {
        Entry {
            code: told.code.clone(),
            severity: match told.severity {
                Severity::Bug | Severity::Error => "error",
                Severity::Warning => "warning",
                Severity::Note | Severity::Help => "note",
            },
            verdict: told.verdict.map(|v| v.name()),
            rank: told.rank.map(Rank::name),
            message: told.message.clone(),
            entry: told.entry.clone(),
            values: told.values.clone(),
            place: told.place.clone().into(),
            related: told.related.iter().cloned().map(JsonPlace::from).collect(),
            details: told.details.clone(),
            advice: told.advice.clone(),
        }
    }
}

impl From<Place> for JsonPlace {
    fn from(place: Place) -> JsonPlace {
        JsonPlace {
            start: place.span.start,
            end: place.span.end,
            line: place.start.0,
            column: place.start.1,
            end_column: place.end.1,
            text: place.text,
            label: place.label,
        }
    }
}

#[derive(Serialize)]
struct LeftOut {
    left_out: String,
    count: usize,
}

/// Prints the diagnostics that are reported at this loudness.
///
/// # Errors
/// Reading the source, or writing.
pub fn print(
    out: &mut dyn Write,
    about: &mut About,
    (diagnostics, counted): (&[Diagnostic], &[Counted]),
    loudness: Loudness,
) -> io::Result<()> {
    let (shown, left_out) = choose(about.job, diagnostics, counted, loudness);
    let lines = about.lines(shown.iter().copied())?;
    for diagnostic in shown {
        line(out, &Entry::from(about.tell_among(&lines, diagnostic, diagnostics)?))?;
    }
    for (code, count) in left_out {
        line(out, &LeftOut { left_out: format!("NC{code:04}"), count })?;
    }
    Ok(())
}

/// The diagnostics that are reported at this loudness.
///
/// # Errors
/// Reading the source.
pub fn entries(about: &mut About, diagnostics: &[Diagnostic], loudness: Loudness) -> io::Result<Vec<Entry>> {
    let shown = reported(about.job, diagnostics, loudness);
    let lines = about.lines(shown.iter().copied())?;
    shown
        .into_iter()
        .map(|diagnostic| Ok(Entry::from(about.tell_among(&lines, diagnostic, diagnostics)?)))
        .collect()
}
