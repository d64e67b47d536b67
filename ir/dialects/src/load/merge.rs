//! Merges a dictionary into its base, before any field is parsed.
//!
//! - A plain value, or a list of plain values, replaces the base's.
//! - A table is merged field by field, to any depth.
//! - A list of rows is merged row by row. Rows are distinguished by their key: `code` in `[[code]]`,
//!   `[[cycle]]` and `[[pattern]]` (`G1` is `G01`), `letter` in `[[address]]`, `name` in `[[name]]`,
//!   `[[call]]`, `[[option]]`, `[[behaviour]]` and `[[data]]`, `number` or else `name` in `[[system]]`, the options of
//!   `when` in `[[variant]]`. A row of a key that the base has is merged over the base's row field by field and keeps its
//!   place; any other is added at the end. Lists inside a row are replaced, but for the rows of a variant.
//! - A row of another key that lacks what a new row needs is refused: its name is most likely misspelt.
//! - In `[[code]]` and `[[name]]`, `means`, `role` and `refuse` exclude each other: a row that says one
//!   of them takes away the base's others.
//! - `remove = true` in a row or table takes the base's away; `replace = true` puts the row or table in
//!   its place as a whole: nothing of the base's remains.
//!
//! Not here: the fields themselves, and whether rows fit together.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use crate::fault::DialectFault;

/// A fault of a tree, with its span in the concatenated texts.
pub(crate) type Fault = (DialectFault, std::ops::Range<usize>);

/// Removes the base's row or table.
const REMOVE: &str = "remove";
/// Replaces the base's row or table.
const REPLACE: &str = "replace";

/// The key of system variables; a row without it has a name.
const NUMBER: &str = "number";

/// The key of variants: options and their values.
const WHEN: &str = "when";

/// Fields of a row that exclude each other.
const EXCLUSIVE: [&str; 3] = ["means", "role", "refuse"];

/// The field of a row that goes with `refuse`.
const HELP: &str = "help";

/// Fields that a dictionary does not inherit.
pub(crate) const OWN: [&str; 3] = ["id", "title", "base"];

/// The key field of a table's rows.
pub(crate) fn row_key(table: &str) -> Option<&'static str> {
    match table {
        "code" | "cycle" | "pattern" => Some("code"),
        "name" | "call" | "option" | "data" | "behaviour" => Some("name"),
        "address" => Some("letter"),
        "system" => Some(NUMBER),
        "variant" => Some(WHEN),
        _ => None,
    }
}

/// A field that a new row of a table has: a row without it is one of the base, with another name there.
fn needed(table: &str) -> Option<&'static str> {
    match table {
        "option" => Some("doc"),
        "behaviour" => Some("sure"),
        "cycle" | "call" | "data" => Some("kind"),
        "address" => Some("role"),
        _ => None,
    }
}

/// Shifts all spans of a tree by an offset.
pub(crate) fn shift(table: DeTable<'_>, by: usize) -> DeTable<'_> {
    table
        .into_iter()
        .map(|(key, value)| {
            let at = key.span();
            (Spanned::new(at.start + by..at.end + by, key.into_inner()), shift_value(value, by))
        })
        .collect()
}

fn shift_value(value: Spanned<DeValue<'_>>, by: usize) -> Spanned<DeValue<'_>> {
    let at = value.span();
    let moved = match value.into_inner() {
        DeValue::Table(table) => DeValue::Table(shift(table, by)),
        DeValue::Array(array) => DeValue::Array(array.into_iter().map(|v| shift_value(v, by)).collect()),
        plain => plain,
    };
    Spanned::new(at.start + by..at.end + by, moved)
}

/// Merges a dictionary into its base.
///
/// # Errors
/// A row without its key, a duplicate key, or a `remove` or `replace` of a missing row.
pub(crate) fn merge<'i>(base: &mut DeTable<'i>, over: DeTable<'i>) -> Result<(), Fault> {
    for (key, value) in over {
        let at = value.span();
        let name = key.get_ref().to_string();
        match (row_key(&name), value.into_inner()) {
            (Some(field), DeValue::Array(rows)) => {
                let there = match base.remove(name.as_str()).map(Spanned::into_inner) {
                    Some(DeValue::Array(there)) => there,
                    Some(_) | None => DeArray::new(),
                };
                let merged = merge_rows(&name, field, there, rows)?;
                base.insert(key, Spanned::new(at, DeValue::Array(merged)));
            }
            (_, value) => merge_field(base, key, Spanned::new(at, value))?,
        }
    }
    Ok(())
}

/// Merges the fields of a table.
fn merge_fields<'i>(base: &mut DeTable<'i>, over: DeTable<'i>) -> Result<(), Fault> {
    for (key, value) in over {
        merge_field(base, key, value)?;
    }
    Ok(())
}

fn merge_field<'i>(
    base: &mut DeTable<'i>,
    key: Spanned<Cow<'i, str>>,
    value: Spanned<DeValue<'i>>,
) -> Result<(), Fault> {
    let at = value.span();
    let name = key.get_ref().to_string();
    let mut over = match value.into_inner() {
        DeValue::Table(over) => over,
        plain => {
            // The span of the key is replaced together with the value.
            base.remove(name.as_str());
            base.insert(key, Spanned::new(at, plain));
            return Ok(());
        }
    };
    let word = word(&mut over);
    match (word, base.get_mut(name.as_str())) {
        (Some((word, place)), None) => Err((DialectFault::NothingThere { row: name, word }, place)),
        (Some((REMOVE, _)), Some(_)) => {
            base.remove(name.as_str());
            Ok(())
        }
        (None, Some(there)) if there.get_ref().is_table() => match there.get_mut() {
            DeValue::Table(there) => merge_fields(there, over),
            _ => Ok(()),
        },
        (_, _) => {
            base.remove(name.as_str());
            base.insert(key, Spanned::new(at, DeValue::Table(over)));
            Ok(())
        }
    }
}

/// Takes `remove = true` or `replace = true` out of a row or table.
fn word(table: &mut DeTable<'_>) -> Option<(&'static str, std::ops::Range<usize>)> {
    let mut found = None;
    for word in [REMOVE, REPLACE] {
        if table.get(word).is_some_and(|v| v.get_ref().is_bool())
            && let Some(said) = table.remove(word)
            && said.get_ref().as_bool() == Some(true)
        {
            found = found.or(Some((word, said.span())));
        }
    }
    found
}

fn merge_rows<'i>(
    table: &str,
    field: &'static str,
    base: DeArray<'i>,
    over: DeArray<'i>,
) -> Result<DeArray<'i>, Fault> {
    let mut rows: Vec<Option<Spanned<DeValue<'i>>>> = base.into_iter().map(Some).collect();
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    for (at, row) in rows.iter().enumerate() {
        let row = row.as_ref().and_then(|row| row.get_ref().as_table());
        if let Some((key, _)) = row.and_then(|row| key_of(row, field)) {
            places.entry(same(&key)).or_insert(at);
        }
    }
    let mut seen = BTreeSet::new();
    for row in over {
        let at = row.span();
        let DeValue::Table(mut over) = row.into_inner() else {
            return Err((DialectFault::NoKey { table: table.to_owned(), key: field }, at));
        };
        let Some((key, place)) = key_of(&over, field) else {
            return Err((DialectFault::NoKey { table: table.to_owned(), key: field }, at));
        };
        let found = places.get(&same(&key)).and_then(|at| rows.get_mut(*at));
        if !seen.insert(same(&key)) {
            return Err((DialectFault::RowTwice { row: key }, place));
        }
        match (word(&mut over), found) {
            (Some((word, place)), None) => {
                return Err((DialectFault::NothingThere { row: key, word }, place));
            }
            (None, None) => {
                if needed(table).is_some_and(|needs| !places.is_empty() && !over.contains_key(needs)) {
                    let among = places.into_keys().collect();
                    return Err((DialectFault::NotInBase { row: key.into(), among }, place));
                }
                rows.push(Some(Spanned::new(at, DeValue::Table(over))));
            }
            (Some((REMOVE, _)), Some(found)) => *found = None,
            (Some(_), Some(found)) => *found = Some(Spanned::new(at, DeValue::Table(over))),
            (None, Some(found)) => {
                let mut merged = match found.take().map(Spanned::into_inner) {
                    Some(DeValue::Table(there)) => there,
                    Some(_) | None => DeTable::new(),
                };
                if EXCLUSIVE.iter().any(|word| over.contains_key(*word))
                    && matches!(table, "code" | "name" | "system")
                {
                    for word in EXCLUSIVE.into_iter().chain([HELP]) {
                        merged.remove(word);
                    }
                }
                if field == WHEN {
                    // A variant has rows as a dictionary has. Its faults are reported with its own span.
                    merged.remove(WHEN);
                    merge(&mut merged, over)?;
                } else {
                    merge_fields(&mut merged, over)?;
                }
                *found = Some(Spanned::new(at, DeValue::Table(merged)));
            }
        }
    }
    Ok(rows.into_iter().flatten().collect())
}

/// The key of a row, and its span.
pub(crate) fn key_of(row: &DeTable<'_>, field: &str) -> Option<(String, std::ops::Range<usize>)> {
    let Some(value) = row.get(field) else {
        // A system variable has a number, or else a name.
        return if field == NUMBER { key_of(row, "name") } else { None };
    };
    if field == WHEN {
        let options = value.get_ref().as_table()?;
        let said = |(option, own): (&Spanned<Cow<str>>, &Spanned<DeValue>)| {
            Some(format!("{} = {}", option.get_ref(), own.get_ref().as_str()?))
        };
        let mut said: Vec<String> = options.iter().map(said).collect::<Option<_>>()?;
        said.sort();
        return Some((said.join(", "), value.span()));
    }
    if field == NUMBER {
        // A number may have several rows: one for each choice of an option.
        let when = row.get(WHEN).and_then(|when| when.get_ref().as_str()).unwrap_or_default();
        return Some((format!("{} {when}", value.get_ref().as_integer()?), value.span()));
    }
    Some((value.get_ref().as_str()?.to_owned(), value.span()))
}

/// The normalised key: `G1` becomes `G01`'s.
pub(crate) fn same(key: &str) -> String {
    let letters = key.bytes().take_while(u8::is_ascii_alphabetic).count();
    let (letters, number) = key.split_at(letters);
    match number.trim_start_matches('0') {
        "" if !number.is_empty() => format!("{letters}0"),
        rest if rest.starts_with('.') => format!("{letters}0{rest}"),
        rest => format!("{letters}{rest}"),
    }
}
