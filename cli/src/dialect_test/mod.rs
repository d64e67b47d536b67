//! `ncc dialects test`: proof that every word of a dictionary reads back to the meaning it was written
//! for.
//!
//! For every row a statement with its meaning is written by the dialect's own writer, read by its own
//! reader, and must come back as the same statement; a row that is never written is read in the place
//! of the one that is; a refused row is read, and must be refused by its name. A dictionary can say
//! only what both sides can do, so a row that nothing reads or writes fails too.
//!
//! Not here: whether a row is true of the control. That is for its source, and for the machine.

mod calls;
mod codes;
mod form;
mod local_call;
mod names;
mod proof;
mod words;

use std::path::PathBuf;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_dialects::{Dialect, Family};

use crate::files;
use crate::known::Known;
use crate::problem::{Exit, Problem};
use proof::Bench;

/// Tests dictionaries, those of files and those that are known by name, and prints the tables.
///
/// # Errors
/// A file cannot be read or is no dictionary, there is no dialect of a name, or printing.
pub fn run(
    mut known: Known,
    what: &[PathBuf],
    quiet: bool,
    err: &mut dyn WriteColor,
) -> Result<Exit, Problem> {
    let named = |path: &PathBuf| path.to_str().and_then(|id| known.get(id));
    let unknown: Vec<PathBuf> = what.iter().filter(|path| named(path).is_none()).cloned().collect();
    let ids: Vec<String> = what.iter().filter_map(|path| Some(named(path)?.id.clone())).collect();
    if let Some(word) = unknown.iter().find(|f| f.extension().is_none() && !f.exists()) {
        known.dialect(&word.display().to_string())?;
    }
    let refused = |problem: Problem| match problem.exit {
        // What is no dictionary has failed its test.
        Exit::Usage => Problem { exit: Exit::Refused, ..problem },
        _ => problem,
    };
    let mut loaded = known.add(&unknown, Some(err)).map_err(refused)?.into_iter();
    let mut ids = ids.into_iter();
    let mut failed = false;
    let mut text = String::new();
    for path in what {
        let dialect = match unknown.contains(path) {
            true => loaded.next(),
            false => ids.next().and_then(|id| known.get(&id)),
        };
        let Some(dialect) = dialect else { continue };
        let rows = test(dialect);
        failed |= rows.iter().any(|row| row.failed.is_some());
        if !text.is_empty() {
            text.push('\n');
        }
        text.push_str(&table(dialect, &rows, !quiet));
    }
    files::to_stdout(&mut |out| out.write_all(text.as_bytes()))?;
    Ok(if failed { Exit::Refused } else { Exit::Done })
}

/// What was found out about a row.
#[derive(Clone, Debug)]
pub struct Row {
    /// Its table: `code`.
    pub table: &'static str,
    /// The row: `G81`, or what of it: `G81 R`.
    pub row: String,
    /// What was written, lines parted by ` ¶ `; in brackets where it was only read.
    pub written: String,
    /// What was read, in the neutral program's words; or the name of the refusal.
    pub read: String,
    /// Why it failed, if it did.
    pub failed: Option<String>,
    /// Whether its source confirms the row.
    pub sure: bool,
}

/// Tests every row of a dictionary.
pub fn test(dialect: &'static Dialect) -> Vec<Row> {
    if matches!(dialect.family, Family::Canon | Family::Ir) {
        return Vec::new();
    }
    let bench = Bench::new(dialect);
    let mut rows = Vec::new();
    form::rows(&bench, &mut rows);
    words::rows(&bench, &mut rows);
    codes::rows(&bench, &mut rows);
    names::rows(&bench, &mut rows);
    calls::rows(&bench, &mut rows);
    rows
}

/// Longest column of the table.
const WIDE: usize = 56;

/// The table, a summary, and the rows that no source confirms.
pub fn table(dialect: &Dialect, rows: &[Row], all: bool) -> String {
    let mut out = format!("{}: {}\n", dialect.id, dialect.title);
    if let Some(base) = &dialect.base {
        out.push_str(&format!("builds on: {base}\n"));
    }
    let failed: Vec<&Row> = rows.iter().filter(|r| r.failed.is_some()).collect();
    let shown: Vec<&Row> = rows.iter().filter(|r| all || r.failed.is_some()).collect();
    let width =
        |text: fn(&Row) -> &str| shown.iter().map(|r| text(r).chars().count().min(WIDE)).max().unwrap_or(0);
    let (row, written) = (width(|r| &r.row).max(3), width(|r| &r.written).max(10));
    if !shown.is_empty() {
        out.push_str(&format!(
            "\n        {:8}  {:row$}  {:written$}  read as\n",
            "table", "row", "written as"
        ));
    }
    for r in &shown {
        let verdict = if r.failed.is_some() { "failed" } else { "ok" };
        let mark = if r.sure { ' ' } else { '?' };
        let line = format!(
            "{verdict:6}{mark} {:8}  {:row$}  {:written$}  {}",
            r.table,
            cut(&r.row),
            cut(&r.written),
            r.read
        );
        out.push_str(line.trim_end());
        out.push('\n');
        if let Some(why) = &r.failed {
            out.push_str(&format!("        {why}\n"));
        }
    }
    let count = |table: &str| rows.iter().filter(|r| r.table == table).count();
    let tables =
        ["form", "number", "address", "code", "corner", "repeat", "cycle", "pattern", "data", "name", "call"];
    let counts: Vec<String> = tables
        .iter()
        .map(|t| (t, count(t)))
        .filter(|(_, n)| *n > 0)
        .map(|(t, n)| format!("{n} {t}"))
        .collect();
    let unsure: Vec<&str> = rows.iter().filter(|r| !r.sure).map(|r| r.row.as_str()).collect();
    out.push('\n');
    match rows.is_empty() {
        true => out.push_str("it has no words of its own: its form is the program's\n"),
        false => out.push_str(&format!(
            "{} of {} ok ({}), {} failed\n",
            rows.len() - failed.len(),
            rows.len(),
            counts.join(", "),
            failed.len()
        )),
    }
    if !unsure.is_empty() {
        out.push_str(&format!(
            "{} not confirmed by any source (`sure = false`, marked ?): {}\n",
            unsure.len(),
            unsure.join(", ")
        ));
    }
    out
}

/// A text no wider than a column.
fn cut(text: &str) -> String {
    match text.chars().count() > WIDE {
        true => text.chars().take(WIDE - 1).chain(['…']).collect(),
        false => text.to_owned(),
    }
}
