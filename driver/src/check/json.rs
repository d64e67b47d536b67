//! The result as one JSON document; its form is in `driver/schema/check.schema.json`.

use std::collections::BTreeMap;
use std::io::{self, Write};

use serde::Serialize;

use super::told::{Item, Program, name};
use crate::render::json::JsonPlace;
use crate::render::messages::message::Value;

/// The version of the document's form.
const VERSION: u32 = 1;

/// The JSON Schema of the document.
pub const SCHEMA: &str = include_str!("../../schema/check.schema.json");

#[derive(Serialize)]
struct Document {
    version: u32,
    tool: Tool,
    programs: Vec<Entry>,
}

#[derive(Serialize)]
struct Tool {
    name: &'static str,
    version: &'static str,
}

#[derive(Serialize)]
struct Entry {
    source: String,
    dialect: &'static str,
    errors: usize,
    warnings: usize,
    notes: usize,
    allowed: usize,
    findings: Vec<Found>,
    not_checked: Vec<NotChecked>,
}

#[derive(Serialize)]
struct Found {
    id: String,
    rule: Option<&'static str>,
    severity: &'static str,
    message: String,
    entry: String,
    values: BTreeMap<&'static str, Value>,
    place: JsonPlace,
    related: Vec<JsonPlace>,
    advice: Vec<String>,
}

#[derive(Serialize)]
struct NotChecked {
    what: String,
    why: String,
}

/// Writes the document.
///
/// # Errors
/// Writing.
pub fn write(out: &mut dyn Write, programs: Vec<Program>) -> io::Result<()> {
    let document = Document {
        version: VERSION,
        tool: Tool { name: "ncc", version: env!("CARGO_PKG_VERSION") },
        programs: programs.into_iter().map(entry).collect(),
    };
    serde_json::to_writer_pretty(&mut *out, &document)?;
    out.write_all(b"\n")
}

fn entry(program: Program) -> Entry {
    let [errors, warnings, notes] = program.counts;
    Entry {
        source: program.shown,
        dialect: program.dialect,
        errors,
        warnings,
        notes,
        allowed: program.allowed,
        findings: program.items.into_iter().map(found).collect(),
        not_checked: program.not_checked.into_iter().map(|(what, why)| NotChecked { what, why }).collect(),
    }
}

fn found(item: Item) -> Found {
    Found {
        id: item.reported.code,
        rule: item.name,
        severity: name(item.severity),
        message: item.reported.message,
        entry: item.reported.entry,
        values: item.reported.values,
        place: item.reported.place.into(),
        related: item.reported.related.into_iter().map(JsonPlace::from).collect(),
        advice: item.reported.advice,
    }
}
