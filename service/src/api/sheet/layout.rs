//! The page of a setup sheet: A4, black on white on paper, without scripts.

use std::fmt::Write;

use serde_json::Value;

use super::gathered::{Facts, GUESS, Translated, mm};
use super::tools;
use crate::api::page::escaped;
use crate::facts::duration;

/// Findings that a sheet lists.
const FINDINGS: usize = 40;

const STYLE: &str = "@page{size:A4;margin:12mm}\
:root{color-scheme:light dark;--line:#999;--soft:#f1f1f1;--grey:#555;--mark:#ffe9a8;--on:#3d2f00;--bad:#9b1c1c}\
@media screen and (prefers-color-scheme:dark){:root{--line:#666;--soft:#26292c;--grey:#aaa;--mark:#5a4708;--on:#ffe9a8;--bad:#f2a097}\
body{background:#16181a;color:#e4e4e4}}\
body{font:10.5pt/1.35 system-ui,sans-serif;margin:0 auto;max-width:186mm;padding:4mm}\
h1{font-size:15pt;margin:0 0 2mm;overflow-wrap:anywhere}h2{font-size:11.5pt;margin:5mm 0 1.5mm;break-after:avoid}\
table{border-collapse:collapse;width:100%}td,th{border:1px solid var(--line);padding:1mm 1.6mm;text-align:left;\
vertical-align:top;overflow-wrap:anywhere}th{background:var(--soft);font-weight:600}tr{break-inside:avoid}\
.tools{font-size:9pt}.tools th,.tools td{overflow-wrap:normal}.tools td:nth-child(2){min-width:25mm}.facts th{width:33mm}.n{text-align:right;white-space:nowrap}\
small{color:var(--grey);font-size:85%}\
code{font:9pt ui-monospace,monospace;overflow-wrap:anywhere}mark{background:var(--mark);color:var(--on);padding:0 .3em;\
border-radius:2px;font-size:85%}.bad{color:var(--bad);font-weight:600}ul{margin:0;padding-left:5mm}li{break-inside:avoid}\
figure{margin:0;break-inside:avoid}figure svg{width:100%;height:auto;background:#fff;display:block}\
footer{margin-top:4mm;color:var(--grey);font-size:8.5pt}\
@media print{body{padding:0;max-width:none;background:#fff;color:#000}\
th,mark{-webkit-print-color-adjust:exact;print-color-adjust:exact}mark{outline:1px solid #000}}";

/// The page.
pub(super) fn page(facts: &Facts) -> String {
    let name = escaped(&facts.name);
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" \
         content=\"width=device-width\"><title>{name}, revision {}: setup sheet</title><style>{STYLE}</style></head><body>\n\
         <h1>Setup sheet: {name}</h1>\n",
        facts.revision
    );
    about(&mut out, facts);
    out.push_str("<h2>Tools</h2>\n");
    tools::table(&mut out, facts);
    set_up(&mut out, facts);
    times(&mut out, facts);
    warnings(&mut out, facts);
    picture(&mut out, facts);
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "<footer>Lengths in mm, program coordinates. {GUESS} marks what neither the program, the machine nor the request \
         states: check it before the first cut. ncc {}</footer></body></html>",
        env!("CARGO_PKG_VERSION")
    );
    out
}

/// A row of a table of facts; the value is HTML.
fn fact(out: &mut String, name: &str, value: &str) {
    let _ = writeln!(out, "<tr><th>{name}</th><td>{value}</td></tr>");
}

/// The program, its revision and its machine.
fn about(out: &mut String, facts: &Facts) {
    let timing = facts.timing();
    out.push_str("<table class=\"facts\">");
    let folder = match facts.folder.as_str() {
        "" => String::new(),
        folder => format!("{}/", escaped(folder)),
    };
    fact(out, "Program", &format!("{folder}{}, revision {}", escaped(&facts.name), facts.revision));
    fact(out, "SHA-256", &format!("<code>{}</code>", escaped(&facts.sha256)));
    let message = match facts.message.as_str() {
        "" => String::new(),
        message => format!("<br><small>{}</small>", escaped(message)),
    };
    fact(out, "Author", &format!("{}, {}{message}", escaped(&facts.author), escaped(&facts.made)));
    let machine = match facts.summary["machine_name"].as_str() {
        None | Some("") => "none stated".to_owned(),
        Some(name) => {
            let id = facts.summary["machine"].as_str().unwrap_or_default();
            format!("{} <small>{}</small>", escaped(name), escaped(id))
        }
    };
    fact(out, "Machine", &machine);
    let (dialect, is_recognised) = &facts.dialect;
    let recognised = if *is_recognised {
        format!(" {GUESS} <small>recognised by its text</small>")
    } else {
        String::new()
    };
    fact(out, "Dialect", &format!("{}{recognised}", escaped(dialect)));
    let total = duration(timing["total"]["time"].as_f64().unwrap_or_default());
    fact(out, "Total time", &format!("<b>{total}</b> <small>computed, h:mm:ss</small>"));
    let mut translations: Vec<String> = facts.translations.iter().map(translation).collect();
    if facts.has_more {
        translations.push("and further ones".to_owned());
    }
    let none = || "none".to_owned();
    let translations = if translations.is_empty() { none() } else { translations.join("<br>") };
    fact(out, "Translations", &translations);
    out.push_str("</table>\n");
}

fn translation(own: &Translated) -> String {
    let stale = match own.stale.is_empty() {
        true => String::new(),
        false => format!(" <span class=\"bad\">stale: {} changed</span>", own.stale.join(", ")),
    };
    format!("{}: {}, of revision {}{stale}", escaped(&own.target), own.state, own.revision)
}

/// Work offsets, extents, raw part.
fn set_up(out: &mut String, facts: &Facts) {
    let timing = facts.timing();
    out.push_str("<h2>Set-up</h2>\n<table class=\"facts\">");
    let offsets = facts.used["offsets"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let offsets: Vec<String> = offsets.map(escaped).collect();
    let offsets = if offsets.is_empty() { "none".to_owned() } else { offsets.join(", ") };
    fact(out, "Work offsets", &offsets);
    let extents = &timing["total"]["extents"];
    let axes = ["X", "Y", "Z"].iter().enumerate().filter_map(|(at, axis)| {
        let ends = [extents[at][0].as_f64()?, extents[at][1].as_f64()?].map(mm);
        Some(format!("{axis} {} … {}", ends[0], ends[1]))
    });
    let axes: Vec<String> = axes.collect();
    let axes = if axes.is_empty() { "no feed moves".to_owned() } else { axes.join("<br>") };
    fact(out, "Extents of the feed moves", &axes);
    if let Ok((document, _)) = &facts.part {
        let raw = &document["programs"][0]["raw"];
        let guess = if raw["guessed"] == true { format!(" {GUESS}") } else { String::new() };
        let ends = (0..3).filter_map(|at| {
            let [low, high] = [raw["low"][at].as_f64()?, raw["high"][at].as_f64()?].map(mm);
            Some(format!("{} {low} … {high}", ["X", "Y", "Z"][at]))
        });
        let ends: Vec<String> = ends.collect();
        let form = escaped(raw["form"].as_str().unwrap_or_default());
        fact(out, "Raw part", &format!("{form}{guess}<br>{}", ends.join("<br>")));
    }
    out.push_str("</table>\n");
}

/// Total time, and what it rests on.
fn times(out: &mut String, facts: &Facts) {
    let timing = facts.timing();
    let total = &timing["total"];
    out.push_str("<h2>Time</h2>\n<table class=\"facts\">");
    let seconds = |field: &str| duration(total[field].as_f64().unwrap_or_default());
    let parts = format!(
        "<b>{}</b>: cutting {}, rapid {}, idle {} <small>(tool changes {})</small>",
        seconds("time"),
        seconds("cutting"),
        seconds("rapid"),
        seconds("idle"),
        seconds("tool_change")
    );
    fact(out, "Total", &parts);
    if let [Some(least), Some(most)] = [0, 1].map(|at: usize| timing["bounds"][at].as_f64()) {
        fact(out, "Bounds", &format!("at least {}, at most {}", duration(least), duration(most)));
    }
    fact(out, "Model", &escaped(facts.summary["model"].as_str().unwrap_or_default()));
    let assumed = timing["assumed"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let mut assumed: Vec<&str> = assumed.collect();
    if let Ok((document, _)) = &facts.part {
        let more =
            document["programs"][0]["assumed"].as_array().into_iter().flatten().filter_map(Value::as_str);
        for line in more {
            if !assumed.contains(&line) {
                assumed.push(line);
            }
        }
    }
    let lines: String = assumed.iter().map(|line| format!("<li>{}</li>", escaped(line))).collect();
    let lines = if lines.is_empty() { "nothing".to_owned() } else { format!("<ul>{lines}</ul>") };
    fact(out, "Assumed", &lines);
    out.push_str("</table>\n");
}

/// Alarms of the part, and findings of the check.
fn warnings(out: &mut String, facts: &Facts) {
    out.push_str("<h2>Alarms and warnings</h2>\n");
    let mut lines = Vec::new();
    match &facts.part {
        Ok((document, _)) => {
            let alarms = document["programs"][0]["alarms"].as_array().into_iter().flatten();
            lines.extend(alarms.map(|alarm| {
                let guess = if alarm["guessed"] == true { format!(" {GUESS}") } else { String::new() };
                finding(alarm, &guess)
            }));
        }
        Err(reason) => lines.push(format!("The part was not cut: {}", escaped(reason))),
    }
    match &facts.check {
        Ok(document) => {
            let program = &document["programs"][0];
            let findings = program["findings"].as_array().into_iter().flatten();
            lines.extend(findings.filter(|own| own["severity"] != "note").map(|own| finding(own, "")));
            if lines.is_empty() {
                lines.push("None found.".to_owned());
            }
            let skipped = program["not_checked"].as_array().into_iter().flatten();
            lines.extend(skipped.map(|own| {
                let [what, why] = ["what", "why"].map(|name| escaped(own[name].as_str().unwrap_or_default()));
                format!("<small>Not checked: {what} ({why})</small>")
            }));
        }
        Err(reason) => lines.push(format!("The program was not checked: {}", escaped(reason))),
    }
    let more = lines.len().saturating_sub(FINDINGS);
    let listed: String = lines.iter().take(FINDINGS).map(|line| format!("<li>{line}</li>\n")).collect();
    let _ = writeln!(out, "<ul>{listed}</ul>");
    if more > 0 {
        let _ = writeln!(out, "<p class=\"bad\">And {more} further ones.</p>");
    }
}

/// A finding or an alarm, in a line.
fn finding(own: &Value, guess: &str) -> String {
    let text = |value: &Value| escaped(value.as_str().unwrap_or_default());
    let class = if own["severity"] == "error" { " class=\"bad\"" } else { "" };
    let line = own["place"]["line"].as_u64().map(|line| format!(", line {line}")).unwrap_or_default();
    format!(
        "<span{class}>{}</span>{guess} <small>{} {}{line}</small>",
        text(&own["message"]),
        text(&own["severity"]),
        text(&own["id"])
    )
}

/// The part after the program.
fn picture(out: &mut String, facts: &Facts) {
    let Ok((document, drawing)) = &facts.part else { return };
    let guess = if document["programs"][0]["raw"]["guessed"] == true {
        format!(" <small>from a raw part that is a {GUESS}</small>")
    } else {
        String::new()
    };
    let _ = writeln!(out, "<h2>The part after the program{guess}</h2>\n<figure>{drawing}</figure>");
}
