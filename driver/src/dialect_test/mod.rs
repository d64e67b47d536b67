//! `ncc dialects test`: proof that every word of a dictionary reads back to the meaning it was written
//! for.
//!
//! For every row a statement with its meaning is written by the dialect's own writer, read by its own
//! reader, and must come back as the same statement; a row that is never written is read in the place
//! of the one that is; a refused row is read, and must be refused by its name. A dictionary can say
//! only what both sides can do, so a row that nothing reads or writes fails too.
//!
//! ```text
//! row G83    START_CYCLE(drill-peck …)    `G99 G83 X1. Z-5. R2. Q1.`    START_CYCLE(drill-peck …): passed
//! ```
//!
//! Not here: whether a row is true of the control. That is for its source, and for the machine.

pub mod calls;
pub mod codes;
pub mod cycles;
pub mod form;
pub mod local_call;
pub mod names;
pub mod proof;
pub mod row;
pub mod statements;
pub mod words;

use ncc_dialects::{Dialect, Family};

use self::proof::Bench;
use crate::render::dictionary::dictionary;

pub use self::row::Row;

/// Tests every row of a dictionary, and every row of its variants under the options of these.
pub fn test(dialect: &'static Dialect) -> Vec<Row> {
    let mut rows = rows(dialect);
    for (variant, with) in dialect.variants() {
        let own = |row: &Row| {
            let code = row.row.split(' ').next().unwrap_or_default();
            match row.table {
                "address" => variant.address.iter().any(|own| code == own.letter.to_string()),
                "code" => variant.code.iter().any(|own| own.code == code),
                "cycle" => variant.cycle.iter().any(|own| own.code == code),
                "name" => variant.name.iter().any(|own| own.name == code),
                "data" => variant.data.iter().any(|own| row.row.starts_with(&own.name)),
                _ => false,
            }
        };
        let when: Vec<String> =
            variant.when.iter().map(|(option, value)| format!("{option}={value}")).collect();
        let named = |row: Row| Row { row: format!("{} ({})", row.row, when.join(", ")), ..row };
        rows.extend(self::rows(with).into_iter().filter(own).map(named));
    }
    rows
}

/// The rows of one dictionary as it stands.
fn rows(dialect: &'static Dialect) -> Vec<Row> {
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

/// The failures, with `all` every row; how many rows were tested and failed; and the rows that no source confirms.
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
    let tested = dictionary("tested").text("tables", counts.join(", "));
    let tested = tested.count("rows", rows.len() as u64).count("failed", failed.len() as u64);
    out.push_str(&tested.headline());
    out.push('\n');
    if !unsure.is_empty() {
        let message = dictionary("unsure").count("count", unsure.len() as u64);
        out.push_str(&message.text("rows", unsure.join(", ")).headline());
        out.push('\n');
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
