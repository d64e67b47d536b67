//! A fault of a dictionary with its place in the file: as data, and as a box with the offending row.
//!
//! ```text
//! error: has no [[cycle]] row
//!   ┌─ shop.toml:5:8
//! ```
//!
//! A row that a dictionary has from its base can be at fault too: the place is then in the base's text.

use std::io;

use codespan_reporting::diagnostic::{Diagnostic, Label};
use codespan_reporting::files::SimpleFiles;
use codespan_reporting::term::termcolor::WriteColor;
use codespan_reporting::term::{self, Config};
use ncc_dialects::{DialectError, Place, Text, builtin_text};

use super::{BaseRow, Words, dictionary, words};

/// A fault in words, and its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fault {
    /// File, line and column, the latter from 1; none of a fault without a place.
    pub place: Option<(String, usize, usize)>,
    /// The file of the dictionary that has the row from its base.
    pub inherited_by: Option<String>,
    /// The problem, and what to do.
    pub words: Words,
}

/// A fault of one of these texts, which have these names.
pub fn fault(error: &DialectError, names: &[String], texts: &[&str]) -> Fault {
    let place = error.place.as_ref().map(|place| {
        let (name, text) = file(place.text, names, texts);
        let before = text.get(..place.span.start).unwrap_or_default();
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        (name, line, column)
    });
    let inherited_by = error.inherited_by.as_ref().map(|place| file(place.text, names, texts).0);
    Fault { place, inherited_by, words: worded(error, names, texts) }
}

/// Writes a box with the offending row; `false` where the fault has no place.
///
/// # Errors
/// Writing to `out`.
pub fn boxed(
    error: &DialectError,
    names: &[String],
    texts: &[&str],
    out: &mut dyn WriteColor,
) -> io::Result<bool> {
    let Some(place) = &error.place else { return Ok(false) };
    let words = worded(error, names, texts);
    let mut files = SimpleFiles::new();
    let mut label = |place: &Place, primary: bool| {
        let (name, text) = file(place.text, names, texts);
        let at = files.add(name, text);
        match primary {
            true => Label::primary(at, place.span.clone()),
            false => {
                Label::secondary(at, place.span.clone()).with_message(dictionary("this-base").headline())
            }
        }
    };
    let labels: Vec<_> = std::iter::once(label(place, true))
        .chain(error.inherited_by.iter().map(|place| label(place, false)))
        .collect();
    let diagnostic = Diagnostic::error()
        .with_message(&words.headline)
        .with_labels(labels)
        .with_notes(words.helps.iter().map(|line| format!("help: {line}")).collect());
    term::emit_to_write_style(out, &Config::default(), &files, &diagnostic).map_err(io::Error::other)?;
    Ok(true)
}

/// The name and the text of a file.
fn file<'t>(which: Text, names: &[String], texts: &[&'t str]) -> (String, &'t str) {
    match which {
        Text::File(at) => (names.get(at).cloned().unwrap_or_default(), texts.get(at).copied().unwrap_or("")),
        Text::BuiltIn(at) => {
            builtin_text(at).map_or((String::new(), ""), |(id, text)| (format!("{id} (built in)"), text))
        }
    }
}

/// The words about a fault. In a row of the base, they name that row.
fn worded(error: &DialectError, names: &[String], texts: &[&str]) -> Words {
    let place = error.place.as_ref().filter(|_| error.inherited_by.is_some());
    let base_row = place.and_then(|place| {
        let (_, text) = file(place.text, names, texts);
        let (before, at) = (text.get(..place.span.start)?, text.get(place.span.clone())?);
        let table = before.get(before.rfind("[[")? + 2..)?.split("]]").next()?;
        let line = before.rsplit('\n').next()?;
        Some((table.to_owned(), format!("{line}{at}")))
    });
    let base_row = base_row.as_ref().map(|(table, key)| BaseRow { table, key });
    words(&error.fault, base_row)
}
