//! The tools of a setup sheet: a row for each, in the order of their first use.

use std::fmt::Write;

use serde_json::Value;

use super::gathered::{Facts, GUESS, mm};
use crate::api::page::escaped;
use crate::facts::duration;

/// Writes the table of the tools.
pub(super) fn table(out: &mut String, facts: &Facts) {
    let tools = facts.timing()["tools"].as_array().map_or(&[][..], Vec::as_slice);
    if tools.is_empty() {
        out.push_str("<p>The program uses no tool.</p>\n");
        return;
    }
    out.push_str(
        "<table class=\"tools\"><thead><tr><th>Tool</th><th>Shape</th><th>Offset</th><th>Operations</th><th>Time</th>\
         <th>Cutting</th><th>Speed<br><small>rev/min</small></th><th>Feed<br><small>mm/min</small></th><th>Coolant</th>\
         <th>Deepest Z<br><small>mm</small></th></tr></thead>\n<tbody>",
    );
    for tool in tools {
        row(out, facts, tool);
    }
    out.push_str("</tbody></table>\n");
}

/// The entry of a list of tools that is of this tool.
fn same<'v>(list: &'v Value, name: &str, tool: &Value) -> Option<&'v Value> {
    list.as_array()?.iter().find(|own| own[name] == *tool)
}

fn row(out: &mut String, facts: &Facts, tool: &Value) {
    let number = &tool["tool"];
    let name = match number.as_i64() {
        Some(number) => format!("T{number}"),
        None => "in the spindle at the start".to_owned(),
    };
    let shape = match &facts.part {
        Ok((document, _)) => same(&document["programs"][0]["tools"], "number", number).map(shape),
        Err(_) => None,
    };
    let offsets = tool["cut_offsets"].as_array().into_iter().flatten();
    let offsets: Vec<String> = offsets.map(|offset| format!("H{offset}")).collect();
    let operations = tool["operations"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let operations: Vec<String> = operations.map(escaped).collect();
    let holes = match tool["holes"].as_u64() {
        None | Some(0) => None,
        Some(1) => Some("1 hole".to_owned()),
        Some(many) => Some(format!("{many} holes")),
    };
    let operations: Vec<String> = operations.into_iter().chain(holes).collect();
    let coolants = same(&facts.used["tools"], "tool", number);
    let coolants = coolants.and_then(|own| own["coolants"].as_array()).into_iter().flatten();
    let coolants: Vec<&str> = coolants.filter_map(Value::as_str).collect();
    let dash = |text: String| if text.is_empty() { "–".to_owned() } else { text };
    let seconds = |field: &str| duration(tool[field].as_f64().unwrap_or_default());
    let deepest = tool["extents"][2][0].as_f64().map(mm).unwrap_or_default();
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "<tr><td><b>{name}</b></td><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>\
         <td class=\"n\">{}</td><td class=\"n\">{}</td><td>{}</td><td class=\"n\">{}</td></tr>",
        shape.unwrap_or_else(|| "not known".to_owned()),
        dash(offsets.join(" ")),
        dash(operations.join("<br>")),
        seconds("time"),
        seconds("cutting"),
        dash(range(&tool["speed"])),
        dash(range(&tool["feed"])),
        dash(coolants.join(", then ")),
        dash(deepest),
    );
}

/// A least and a greatest value: `186` or `186…505`.
fn range(pair: &Value) -> String {
    match [pair[0].as_f64(), pair[1].as_f64()].map(|end| end.map(mm)) {
        [Some(least), Some(most)] if least == most => least,
        [Some(least), Some(most)] => format!("{least}…{most}"),
        _ => String::new(),
    }
}

/// The shape and the diameter of a tool, and where they are known from.
fn shape(tool: &Value) -> String {
    let diameter = tool["diameter"].as_f64().map(mm).unwrap_or_default();
    let known = match tool["known"].as_str() {
        Some("stated") => "<small>stated</small>".to_owned(),
        Some("profile") => "<small>machine profile</small>".to_owned(),
        Some("comment") => format!("<small>comment, line {}</small>", tool["line"]),
        _ => GUESS.to_owned(),
    };
    let shape = escaped(tool["shape"].as_str().unwrap_or_default());
    let is_guessed = tool["shape_guessed"] == true;
    let shape_known = if is_guessed { format!(" {GUESS}") } else { String::new() };
    let angle = tool["angle"].as_f64().map(|angle| format!(", {}°", mm(angle))).unwrap_or_default();
    format!("⌀ {diameter} {known}<br>{shape}{angle}{shape_known}")
}
