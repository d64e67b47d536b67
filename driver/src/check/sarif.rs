//! The result as a SARIF 2.1.0 log, for viewers and code review: one run, a result for each finding.
//! Lines and columns count from 1, columns are characters; bytes are those of the file.

use std::collections::BTreeSet;
use std::io::{self, Write};

use ncc_check::Severity;
use serde_json::{Value, json};

use super::told::{Item, Program, name, rule};
use crate::render::Place;

/// The schema that the log names.
const SCHEMA: &str = "https://json.schemastore.org/sarif-2.1.0.json";

/// Writes the log.
///
/// # Errors
/// Writing.
pub fn write(out: &mut dyn Write, programs: &[Program]) -> io::Result<()> {
    let codes: BTreeSet<u16> = ncc_check::Rule::CODES
        .iter()
        .copied()
        .chain(programs.iter().flat_map(|program| program.items.iter().map(|item| item.code)))
        .collect();
    let codes: Vec<u16> = codes.into_iter().collect();
    let results: Vec<Value> = programs
        .iter()
        .flat_map(|program| program.items.iter().map(|item| result(item, &uri(&program.shown), &codes)))
        .collect();
    let notifications: Vec<Value> = programs.iter().flat_map(notifications).collect();
    let log = json!({
        "$schema": SCHEMA,
        "version": "2.1.0",
        "runs": [{
            "tool": { "driver": {
                "name": "ncc",
                "version": env!("CARGO_PKG_VERSION"),
                "rules": codes.iter().map(|code| descriptor(*code)).collect::<Vec<_>>(),
            }},
            "columnKind": "unicodeCodePoints",
            "artifacts": programs
                .iter()
                .map(|program| json!({ "location": { "uri": uri(&program.shown) } }))
                .collect::<Vec<_>>(),
            "invocations": [{
                "executionSuccessful": true,
                "toolExecutionNotifications": notifications,
            }],
            "results": results,
        }],
    });
    serde_json::to_writer_pretty(&mut *out, &log)?;
    out.write_all(b"\n")
}

/// What was not checked.
fn notifications(program: &Program) -> Vec<Value> {
    let uri = uri(&program.shown);
    let one = |(what, why): &(String, String)| {
        json!({
            "level": "note",
            "message": { "text": format!("not checked: {what}: {why}") },
            "locations": [{ "physicalLocation": { "artifactLocation": { "uri": uri } } }],
        })
    };
    program.not_checked.iter().map(one).collect()
}

fn descriptor(code: u16) -> Value {
    let id = format!("NC{code:04}");
    let page = crate::render::explain::page(&id).unwrap_or_default();
    let title = page.lines().next().and_then(|line| line.split_once(": ")).map_or("", |(_, title)| title);
    let level = rule(code).map_or("note", |rule| level(rule.severity()));
    let mut descriptor = json!({
        "id": id,
        "shortDescription": { "text": rule(code).map_or(title, |rule| rule.about()) },
        "help": { "text": page, "markdown": page },
        "defaultConfiguration": { "level": level },
    });
    if let Some(rule) = rule(code) {
        descriptor["name"] = json!(rule.name());
    }
    descriptor
}

fn level(severity: Severity) -> &'static str {
    name(severity)
}

fn result(item: &Item, uri: &str, codes: &[u16]) -> Value {
    let told = &item.reported;
    let mut result = json!({
        "ruleId": told.code,
        "ruleIndex": codes.iter().position(|code| *code == item.code),
        "level": level(item.severity),
        "message": { "text": match told.place.label.is_empty() {
            true => told.message.clone(),
            false => format!("{}: {}", told.message, told.place.label),
        }},
        "locations": [{ "physicalLocation": location(&told.place, uri) }],
    });
    if !told.related.is_empty() {
        let related = |(id, place): (usize, &Place)| {
            json!({
                "id": id,
                "message": { "text": place.label },
                "physicalLocation": location(place, uri),
            })
        };
        result["relatedLocations"] = told.related.iter().enumerate().map(related).collect();
    }
    result
}

fn location(place: &Place, uri: &str) -> Value {
    json!({
        "artifactLocation": { "uri": uri },
        "region": {
            "startLine": place.start.0,
            "startColumn": place.start.1,
            "endLine": place.end.0,
            "endColumn": place.end.1,
            "byteOffset": place.span.start,
            "byteLength": place.span.end.saturating_sub(place.span.start),
        },
    })
}

/// A path as a relative or file URI: what is no plain character of one is written in percent.
fn uri(shown: &str) -> String {
    let mut uri = String::new();
    if shown.starts_with('/') {
        uri.push_str("file://");
    }
    for byte in shown.bytes() {
        match byte {
            b'\\' => uri.push('/'),
            b'A'..=b'Z' | b'a'..=b'z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' | b'/' => {
                uri.push(char::from(byte))
            }
            other => uri.push_str(&format!("%{other:02X}")),
        }
    }
    uri
}
