//! Times by operation and tool, for an ERP.
//!
//! ```text
//! program,revision,sha256,…,operation,tool,line,start,time,cutting_time,…
//! part.nc,3,90884…,1,DRILL 6.8,4,12,7.5,42.1,30.2,…
//! ```

use serde_json::{Value, json};

use super::executed::Found;
use crate::http::Problem;

/// Columns, and the fields of an operation that they have. Seconds, mm, mm/min, rev/min.
const COLUMNS: [(&str, &str); 13] = [
    ("operation", "name"),
    ("tool", "tool"),
    ("line", "line"),
    ("start", "start"),
    ("time", "time"),
    ("cutting_time", "cutting"),
    ("rapid_time", "rapid"),
    ("idle_time", "idle"),
    ("tool_change_time", "tool_change"),
    ("dwell_time", "dwell"),
    ("cutting_distance", "cutting_distance"),
    ("rapid_distance", "rapid_distance"),
    ("holes", "holes"),
];

/// Columns of a least and a greatest value.
const RANGES: [&str; 2] = ["feed", "speed"];

/// Makes the output from the summary of a program.
pub(super) fn of(summary: &Value, found: &Found, is_csv: bool) -> Result<Vec<u8>, Problem> {
    let timing = &summary["programs"][0];
    let mut about = json!({
        "program": found.of.details.name,
        "id": found.of.program,
        "revision": found.of.number,
        "sha256": found.of.content.sha256,
        "dialect": timing["dialect"],
        "machine": summary["machine"],
        "model": summary["model"],
    });
    let rows = timing["operations"].as_array().into_iter().flatten();
    let rows: Vec<Value> = rows.enumerate().map(|(at, operation)| row(at + 1, operation)).collect();
    if is_csv {
        let assumed = timing["assumed"].as_array().into_iter().flatten().filter_map(Value::as_str);
        about["assumed"] = assumed.collect::<Vec<_>>().join("; ").into();
        return table(&about, &rows).map_err(|_| Problem::fault());
    }
    let mut document = about;
    document["assumed"] = timing["assumed"].clone();
    document["total"] = timing["total"].clone();
    document["operations"] = rows.into();
    document["tools"] = timing["tools"].clone();
    let mut bytes = serde_json::to_vec_pretty(&document).unwrap_or_default();
    bytes.push(b'\n');
    Ok(bytes)
}

/// An operation, with its place in the order of the program.
fn row(position: usize, operation: &Value) -> Value {
    let mut row = json!({ "position": position });
    for (column, field) in COLUMNS {
        row[column] = operation[field].clone();
    }
    for range in RANGES {
        row[format!("{range}_min")] = operation[range][0].clone();
        row[format!("{range}_max")] = operation[range][1].clone();
    }
    row
}

/// A table, a row for each operation.
fn table(about: &Value, rows: &[Value]) -> Result<Vec<u8>, csv::Error> {
    let first = ["program", "revision", "sha256", "dialect", "machine", "model"];
    let ranges = RANGES.iter().flat_map(|range| ["min", "max"].map(|end| format!("{range}_{end}")));
    let columns = COLUMNS.iter().map(|(column, _)| (*column).to_owned());
    let rest: Vec<String> = std::iter::once("position".to_owned()).chain(columns).chain(ranges).collect();
    // A table has no other place for what its times rest on.
    let last = ["assumed"];
    let mut out = csv::WriterBuilder::new().terminator(csv::Terminator::CRLF).from_writer(Vec::new());
    out.write_record(first.iter().copied().chain(rest.iter().map(String::as_str)).chain(last))?;
    for row in rows {
        let cells =
            first.iter().map(|name| cell(&about[name])).chain(rest.iter().map(|name| cell(&row[name])));
        out.write_record(cells.chain(last.map(|name| cell(&about[name]))))?;
    }
    out.into_inner().map_err(|error| csv::Error::from(error.into_error()))
}

/// A value as a cell; none is an empty one.
fn cell(value: &Value) -> String {
    match value {
        Value::Null => String::new(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
