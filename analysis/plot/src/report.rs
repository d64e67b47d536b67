//! A report for a browser: one file, nothing from elsewhere.
//!
//! The page holds what the record of a program kept, as JSON, and a script that draws it. Text of the
//! program never becomes markup: the page gets it escaped, the script as data.

use std::fmt::Write;

use serde_json::{Value, json};

use crate::charts::{feed_unit, later, tool_name};
use crate::ink::{self, Ink};
use crate::listing::Listing;
use crate::record::Record;
use crate::series::Series;
use crate::ticks::{clock, duration, in_seconds, number};
use crate::way::Stroke;

const STYLE: &str = include_str!("report.css");
/// The second program takes less time than the first.
const SHORTER: &str = include_str!("shorter.html");
/// The second program takes more time than the first.
const LONGER: &str = include_str!("longer.html");
/// The programs do not make the same moves, so that no curve compares them.
const OTHER_MOVES: &str = include_str!("other_moves.html");
const SCRIPT: [&str; 2] = [include_str!("reading.js"), include_str!("page.js")];

/// A program in a report.
#[derive(Clone, Debug)]
pub struct Page {
    /// What it does.
    pub record: Record,
    /// What is to be known of it, by name: the dialect, the machine, the model …
    pub facts: Vec<(String, String)>,
    /// Facts of machine and control that the times assume, a line each.
    pub assumed: Vec<String>,
    /// Its source.
    pub listing: Listing,
}

/// The report of one program, or of two to compare.
pub fn report(pages: &[Page], version: &str) -> String {
    let names: Vec<&str> = pages.iter().map(|page| page.record.name.as_str()).collect();
    let title = escape(&names.join(" and "));
    let mut html = String::new();
    let _ = write!(
        html,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width\">\n\
         <meta name=\"generator\" content=\"ncc {}\">\n<title>{title}</title>\n<style>\n{STYLE}</style>\n\
         </head>\n<body>\n<header>\n<h1>{title}</h1>\n",
        escape(version)
    );
    html.push_str("<div class=\"summaries\">\n");
    for page in pages {
        summary(page, pages.len() > 1, &mut html);
    }
    html.push_str("</div>\n");
    if let [a, b] = pages {
        let (a, b) = (&a.record, &b.record);
        let off = (b.end - b.begin) - (a.end - a.begin);
        let compared = if off < 0.0 { SHORTER } else { LONGER };
        let words =
            [("{first}", escape(&a.name)), ("{second}", escape(&b.name)), ("{time}", duration(off.abs()))];
        let fill = |text: &str, (place, word): &(&str, String)| text.replace(place, word);
        html.push_str(&words.iter().fold(compared.to_owned(), |text, word| fill(&text, word)));
        if later(a, b).is_none() {
            html.push_str(OTHER_MOVES);
        }
    }
    html.push_str(BODY);
    let data = json!({
        "inks": inks(),
        "feed": feed_unit(pages.iter().map(|page| &page.record)),
        "programs": pages.iter().map(program).collect::<Vec<_>>(),
        "later": match pages {
            [a, b] => later(&a.record, &b.record).map(|line| curve(&line)),
            _ => None,
        },
    });
    // In a script, `<` could end it.
    let data = data.to_string().replace('<', "\\u003c");
    let _ = write!(
        html,
        "<script type=\"application/json\" id=\"data\">{data}</script>\n<script>\n{}{}</script>\n\
         </body>\n</html>\n",
        SCRIPT[0], SCRIPT[1]
    );
    html
}

/// The page below its head.
const BODY: &str = include_str!("body.html");

fn summary(page: &Page, named: bool, html: &mut String) {
    let (record, sums) = (&page.record, &page.record.sums);
    let all = record.end - record.begin;
    let part = |time: f64| {
        let percent = if all > 0.0 { time / all * 100.0 } else { 0.0 };
        format!("{} ({percent:.0} %)", duration(time))
    };
    let way = |mm: f64| format!("{} mm", number(mm, 1.0));
    let mut rows: Vec<(String, String)> = page.facts.clone();
    let time = match in_seconds(all) {
        true => format!("{} ({})", duration(all), clock(all.round(), 1.0, f64::INFINITY)),
        false => duration(all),
    };
    rows.push(("Time".to_owned(), time));
    rows.push(("Cutting".to_owned(), format!("{}, {}", part(sums.cutting), way(sums.cutting_way))));
    rows.push(("Rapid".to_owned(), format!("{}, {}", part(sums.rapid), way(sums.rapid_way))));
    rows.push(("Other".to_owned(), part(sums.idle)));
    rows.push(("Moves".to_owned(), number(sums.moves as f64, 1.0)));
    rows.push(("Holes of cycles".to_owned(), number(sums.holes as f64, 1.0)));
    rows.push(("Tool changes".to_owned(), sums.changes.to_string()));
    let extent = &record.way.extent;
    if !extent.is_empty() {
        let of = |i: usize| {
            let end = |v: f64| number(v, 0.001);
            format!("{} {} \u{2026} {}", ["X", "Y", "Z"][i], end(extent.low[i]), end(extent.high[i]))
        };
        rows.push(("Extent (mm)".to_owned(), [of(0), of(1), of(2)].join(", ")));
    }
    if record.way.off > 0.0 {
        let off = number(record.way.off, record.way.off / 10.0);
        rows.push(("Views".to_owned(), format!("true to {off} mm, {} lines", record.way.legs.len())));
    }
    html.push_str("<div class=\"summary\">\n");
    if named {
        let _ = writeln!(html, "<h2>{}</h2>", escape(&record.name));
    }
    html.push_str("<table>\n");
    for (name, value) in rows {
        let _ = writeln!(html, "<tr><th>{}</th><td>{}</td></tr>", escape(&name), escape(&value));
    }
    html.push_str("</table>\n");
    if !page.assumed.is_empty() {
        let open = if named { "" } else { " open" };
        let _ = writeln!(html, "<details{open}><summary>Assumed</summary><ul>");
        for line in &page.assumed {
            let _ = writeln!(html, "<li>{}</li>", escape(line));
        }
        html.push_str("</ul></details>\n");
    }
    html.push_str("</div>\n");
}

fn program(page: &Page) -> Value {
    let record = &page.record;
    let letters = ["X", "Y", "Z", "A", "B", "C"];
    let axes: Vec<Value> = (0..letters.len())
        .filter(|axis| *axis < 3 || record.moved[*axis])
        .map(|axis| json!({ "name": letters[axis], "line": series(&record.axes[axis], record.end) }))
        .collect();
    let tools: Vec<Value> = record
        .tools
        .iter()
        .filter(|tool| tool.end > tool.start)
        .map(|tool| json!([tool_name(tool.tool), short(tool.start, 1e4), short(tool.end, 1e4)]))
        .collect();
    let holes: Vec<Value> = record
        .holes
        .iter()
        .map(|hole| {
            json!([short(hole.at[0], 1e4), short(hole.at[1], 1e4), short(hole.at[2], 1e4), hole.line])
        })
        .collect();
    let lines = &page.listing.lines;
    json!({
        "name": record.name,
        "begin": record.begin,
        "end": record.end,
        "speed": series(&record.speed, record.end),
        "feed": series(&record.feed, record.end),
        "axes": axes,
        "tools": tools,
        "holes": holes,
        "way": way(record),
        "source": {
            "total": page.listing.total,
            "numbers": deltas(lines.iter().map(|line| i64::from(line.0))),
            "text": lines.iter().map(|line| line.1.as_str()).collect::<Vec<_>>().join("\n"),
        },
    })
}

/// The legs, column by column, each number as the difference to the one before.
fn way(record: &Record) -> Value {
    let way = &record.way;
    let kinds: String = way.legs.iter().map(|leg| letter(leg.stroke)).collect();
    // A picture that is true to a tenth of a millimetre needs no micrometres.
    let per_mm = if way.off > 0.0 { (10.0 / way.off).clamp(1.0, 1e4).round() } else { 1e4 };
    let axis = |i: usize| deltas(way.legs.iter().map(|leg| (leg.to[i] * per_mm).round() as i64));
    json!({
        "start": way.start.map(|start| start.map(|at| short(at, 1e4))),
        "off": way.off,
        "kinds": kinds,
        "perMm": per_mm,
        "x": axis(0),
        "y": axis(1),
        "z": axis(2),
        "ends": deltas(way.legs.iter().map(|leg| (leg.end * 1e4).round() as i64)),
        "first": deltas(way.legs.iter().map(|leg| i64::from(leg.lines[0]))),
        "last": deltas(way.legs.iter().map(|leg| i64::from(leg.lines[1]))),
    })
}

fn letter(stroke: Stroke) -> char {
    match stroke {
        Stroke::Rapid => 'r',
        Stroke::Feed => 'f',
        Stroke::Arc => 'a',
        Stroke::Hole => 'h',
        Stroke::Still => '.',
        Stroke::Unseen => 'x',
    }
}

fn deltas(values: impl Iterator<Item = i64>) -> Vec<i64> {
    let mut before = 0;
    values.map(|value| value - std::mem::replace(&mut before, value)).collect()
}

fn series(series: &Series, end: f64) -> Value {
    curve(&series.polyline(end))
}

/// Times and values, each list by itself.
fn curve(line: &[(f64, f64)]) -> Value {
    let times = deltas(line.iter().map(|point| (point.0 * 1e4).round() as i64));
    let values: Vec<Value> = line.iter().map(|point| short(point.1, 1e4)).collect();
    json!({ "t": times, "v": values })
}

/// A number of few digits.
fn short(value: f64, per_unit: f64) -> Value {
    let rounded = (value * per_unit).round() / per_unit;
    if rounded.fract() == 0.0 && rounded.abs() < 1e15 { json!(rounded as i64) } else { json!(rounded) }
}

fn inks() -> Value {
    let one = |ink: Ink| json!({ "color": ink.color, "width": ink.width, "dash": ink.dash });
    let strokes = Stroke::DRAWN.map(|stroke| (letter(stroke).to_string(), one(ink::stroke(stroke))));
    json!({
        "strokes": serde_json::Map::from_iter(strokes),
        "axes": (0..3).map(|axis| one(ink::axis(axis))).collect::<Vec<_>>(),
        "curve": one(ink::CURVE),
        "pair": ink::PAIR.map(one),
    })
}

/// Text as HTML.
pub(crate) fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            other => out.push(other),
        }
    }
    out
}
