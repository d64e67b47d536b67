//! The account as one page that stands by itself.

use std::io::{self, Write};

use super::tell::{Account, Block, Difference};
use crate::render::messages::message::{Message, Part};

const STYLE: &str = "body{font:15px/1.5 system-ui,sans-serif;margin:2em auto;max-width:76em;padding:0 1em;\
color:#1c1c1c;background:#fff}h1{font-size:1.3em}h2{font-size:1em;margin:1.6em 0 .3em}\
table{border-collapse:collapse;width:100%;table-layout:fixed}td,th{vertical-align:top;padding:.1em .5em;\
text-align:left;font:13px/1.5 ui-monospace,monospace;overflow-wrap:anywhere;white-space:pre-wrap}\
td.n{width:4.5em;text-align:right;color:#666}td.a{background:#fdecea}td.b{background:#e9f6ec}\
td.x{background:#f4f4f4;color:#666}.same{color:#17692e}.other{color:#9b1c1c}small{color:#555}\
@media(prefers-color-scheme:dark){body{background:#16181a;color:#e4e4e4}td.a{background:#3b2020}\
td.b{background:#1d3324}td.x{background:#222}td.n,small,td.x{color:#aaa}.same{color:#7fd493}.other{color:#f2a097}}";

/// Writes it.
///
/// # Errors
/// Writing.
pub fn write(out: &mut dyn Write, account: &Account) -> io::Result<()> {
    let [a, b] = [0, 1].map(|side: usize| escaped(&account.names[side]));
    let [x, y] = [0, 1].map(|side: usize| escaped(&account.dialects[side]));
    let class = if account.equal { "same" } else { "other" };
    writeln!(
        out,
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width\"><title>{a} and {b}</title>\
         <style>{STYLE}</style></head><body>\n<h1>{a} <small>({x})</small> and {b} <small>({y})</small></h1>\n\
         <p class=\"{class}\">{}{}</p>",
        if account.equal { "" } else { "Different: " },
        escaped(&account.summary)
    )?;
    if account.level == "motion" {
        let compared = Message::part(Part::Difference, "page-compared")
            .text("same", account.same.to_string())
            .text("first", account.unmatched[0].to_string())
            .text("second", account.unmatched[1].to_string())
            .text("set-ups", account.worlds.to_string())
            .text("settings", account.settings.to_string())
            .text("within", account.tolerance.to_string());
        writeln!(out, "<p><small>{}</small></p>", escaped(&compared.headline()))?;
    }
    for note in &account.notes {
        writeln!(out, "<p><small>Note: {}</small></p>", escaped(note))?;
    }
    for difference in &account.differences {
        one(out, difference)?;
    }
    if account.left_out > 0 {
        let left_out =
            Message::part(Part::Difference, "page-left-out").text("more", account.left_out.to_string());
        writeln!(out, "<p>{}</p>", escaped(&left_out.headline()))?;
    }
    writeln!(out, "<p><small>ncc {}</small></p></body></html>", env!("CARGO_PKG_VERSION"))
}

fn one(out: &mut dyn Write, difference: &Difference) -> io::Result<()> {
    let levels: Vec<String> = difference.skip.iter().map(u8::to_string).collect();
    let skip = match levels.is_empty() {
        true => String::new(),
        false => format!(" <small>(with block skip {} on)</small>", levels.join(", ")),
    };
    writeln!(out, "<h2>{}{skip}</h2>\n<table>", escaped(&difference.title))?;
    let [a, b] = &difference.blocks;
    let rows = a.len().max(b.len()).max(1);
    for i in 0..rows {
        let cell = |side: usize, class: &str| {
            let beside = difference.beside[side].as_ref().filter(|_| i == 0);
            match (difference.blocks[side].get(i), beside) {
                (Some(block), _) => cells(block, class, ""),
                (None, Some(block)) => cells(block, "x", "after "),
                (None, None) => "<td class=\"n\"></td><td class=\"x\"></td>".to_owned(),
            }
        };
        writeln!(out, "<tr>{}{}</tr>", cell(0, "a"), cell(1, "b"))?;
    }
    writeln!(out, "</table>")?;
    if difference.more != [false; 2] {
        writeln!(out, "<p><small>… and further blocks</small></p>")?;
    }
    Ok(())
}

fn cells(block: &Block, class: &str, before: &str) -> String {
    format!("<td class=\"n\">{}</td><td class=\"{class}\">{before}{}</td>", block.line, escaped(&block.text))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
