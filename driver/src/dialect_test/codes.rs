//! G and M codes, the canned cycles and patterns that they activate, and their letters.

use ncc_dialects::{CodeRow, DataKind, DataRow, Meaning, NameMeaning, Quantity, ValueName, ValueWord};
use ncc_ir::canon::{AdviceKind, FeedMode, SpindleMode};
use ncc_ir::program::CentreFrom;

use super::cycles::{cycle, pattern};
use super::local_call;
use super::proof::{Bench, Said, Tried, in_place, must_show, refusal};
use super::row::Row;
use super::statements::{arc, feed_mode, said};
use crate::render::dictionary::dictionary;

/// The rows of the codes.
pub fn rows(bench: &Bench, rows: &mut Vec<Row>) {
    let d = bench.dialect;
    for row in &d.code {
        if let Some(name) = &row.refuse {
            let texts = [(row.code.clone(), ""), (format!("{} X1. Y1. Z1.", row.code), "")];
            rows.push(refusal(bench, "code", &row.code, &texts, name, row.sure));
            continue;
        }
        let Some(meaning) = row.means else { continue };
        match meaning {
            Meaning::StartCycle => {}
            Meaning::SetCentreMode(from) => centre(bench, row, from, rows),
            Meaning::Pattern => {}
            Meaning::Dwell => dwells(bench, row, rows),
            Meaning::SetData => {
                let first = d.tables_of(&row.code).next().map(stored_by).unwrap_or_default();
                let said = Said::new(first.first().map_or("", String::as_str));
                rows.push(must_show(bench.both_ways(&said), &row.code).row("code", &row.code, row.sure));
            }
            Meaning::SetOriginOffsets(first) if row.count.is_some() => counted(bench, row, first, rows),
            Meaning::SetSpindleMode(mode) if row.feed_mode.is_some() => {
                rows.push(speed_and_feed(bench, row, mode).row("code", row.code.clone(), row.sure));
            }
            Meaning::Overrides(_) => {
                for said in said(d, meaning, &row.code) {
                    rows.push(overrides(bench, row, &said).row("code", row.code.clone(), row.sure));
                }
            }
            _ => {
                for said in said(d, meaning, &row.code) {
                    rows.push(code(bench, row, meaning, &said).row("code", row.code.clone(), row.sure));
                }
            }
        }
    }
    for row in &d.cycle {
        cycle(bench, row, rows);
    }
    for row in &d.pattern {
        pattern(bench, row, rows);
    }
    for row in &d.data {
        stored(bench, row, rows);
    }
}

/// Work offsets of which a word of the block says one: the first and the last of them. One that has a code
/// of its own is not written so.
fn counted(bench: &Bench, row: &CodeRow, first: u16, rows: &mut Vec<Row>) {
    let d = bench.dialect;
    for number in [first, first + row.count.unwrap_or(1) - 1] {
        let own = d.code_for(Meaning::SetOriginOffsets(number)).is_some_and(|code| code.code != row.code);
        let said = Said::new(format!("SET_ORIGIN_OFFSETS({number})"));
        let letter = row.words.chars().next().unwrap_or(' ');
        let name = format!("{} {letter}{}", row.code, number - first + 1);
        if !own {
            let tried = must_show(bench.both_ways(&said), &row.code);
            rows.push(tried.row("code", name, row.sure));
        }
    }
}

/// Statements that put values into the last entry of a table.
fn stored_by(row: &DataRow) -> Vec<String> {
    let added: &[&str] = if row.adds { &["", "added "] } else { &[""] };
    match row.kind {
        DataKind::Offset | DataKind::OffsetHere => {
            let last = row.first + row.count - 1;
            let here = if row.kind == DataKind::OffsetHere { "here, " } else { "" };
            let mode = |added: &&str| if added.is_empty() { here } else { "added, " };
            let words = "X 12.345mm, Y -6.7mm";
            added.iter().map(|a| format!("SET_OFFSET_DATA({last}, {}{words})", mode(a))).collect()
        }
        DataKind::ToolHere => {
            let offset =
                if row.in_offset == 0 { String::new() } else { format!("offset {}, ", row.in_offset) };
            vec![format!("MEASURE_TOOL({}, {offset}X 12.345mm, Z -6.7mm)", row.count)]
        }
        DataKind::Tool => {
            let name = |of| match of {
                ValueName::Length => "length",
                ValueName::LengthWear => "length-wear",
                ValueName::Radius => "tool-radius",
                ValueName::RadiusWear => "tool-radius-wear",
                ValueName::OffsetX => "x-offset",
                ValueName::OffsetY => "y-offset",
            };
            let each = |v: &ValueWord| {
                let of = name(v.of);
                let radius = matches!(v.of, ValueName::Radius | ValueName::RadiusWear);
                let kept = if row.kept && !radius { "kept " } else { "" };
                added.iter().map(move |a| format!("SET_TOOL_DATA({}, {of}, {a}{kept}6.15mm)", row.count))
            };
            row.values.iter().flat_map(each).collect()
        }
    }
}

/// A table that values are put into.
fn stored(bench: &Bench, row: &DataRow, rows: &mut Vec<Row>) {
    let select = match row.is_variable() {
        true => row.name.split('[').next().unwrap_or_default(),
        false => row.name.split(' ').nth(1).unwrap_or_default(),
    };
    for say in stored_by(row) {
        let tried = must_show(bench.both_ways(&Said::new(say)), select);
        let code = bench.dialect.code.iter().any(|code| row.name.starts_with(&code.code) && code.sure);
        let sure = code || row.is_variable();
        rows.push(tried.row("data", row.name.clone(), sure));
    }
}

/// A code by the statement that it is written for; read only, if another word is written.
fn code(bench: &Bench, row: &CodeRow, meaning: Meaning, said: &Said) -> Tried {
    let d = bench.dialect;
    let named = d.name_for(NameMeaning::Code(meaning)).map(|n| n.name.as_str());
    let written = match meaning {
        // Each has a name of its own.
        Meaning::NoEffect => Some(row.code.as_str()),
        _ => d.code_for(meaning).map(|first| first.code.as_str()).or(named),
    };
    match written {
        Some(code) if code == row.code => must_show(bench.both_ways(said), &row.code),
        Some(other) if meaning == Meaning::Call && !row.blocks.is_empty() => {
            must_show(local_call::read(bench, said, other, &row.code), &row.code).read_only()
        }
        Some(other) => {
            let put = |text: String| in_place(&text, other, &row.code).unwrap_or(text);
            must_show(bench.reads(said, &said.say, put), &row.code).read_only()
        }
        None if meaning == Meaning::SetSpindleMode(SpindleMode::Turns) => {
            // Where there is no other way, nothing needs to be written.
            let (speed, code) = ("SET_SPINDLE_SPEED(1234)", &row.code);
            let put = |text: String| text.replace("S1234", &format!("{code} S1234"));
            let meant = format!("SET_SPINDLE_MODE(\"turns\") & {speed}");
            must_show(bench.reads(&Said::new(speed), &meant, put), code).read_only()
        }
        None => Tried::failure(dictionary("none-written").text("meaning", meaning.to_string())),
    }
}

/// A code that says what a speed counts, and what a feed counts.
fn speed_and_feed(bench: &Bench, row: &CodeRow, mode: SpindleMode) -> Tried {
    let feed = row.feed_mode.map(FeedMode::from).map_or("", feed_mode);
    let (mode, speed) = match mode {
        SpindleMode::Turns => ("turns", ""),
        SpindleMode::Surface => ("surface", " & SET_SPINDLE_SPEED(180)"),
    };
    let said = Said::new(format!("SET_FEED_MODE({feed}) & SET_SPINDLE_MODE(\"{mode}\"){speed}"));
    must_show(bench.both_ways(&said), &row.code)
}

/// A code that says at once what is written by two.
fn overrides(bench: &Bench, row: &CodeRow, said: &Said) -> Tried {
    let own = |kind| bench.dialect.code_for(Meaning::Advise(kind, None)).map(|code| code.code.clone());
    let both = own(AdviceKind::FeedOverride).zip(own(AdviceKind::SpeedOverride));
    let Some((feed, speed)) = both else {
        return Tried::failure(dictionary("no-override-words"));
    };
    let change = |text: String| {
        let one = |line: &str| match line {
            line if line.starts_with(&feed) => Some(row.code.clone()),
            line if line.starts_with(&speed) => None,
            line => Some(line.to_owned()),
        };
        text.lines().filter_map(one).map(|line| line + "\n").collect()
    };
    must_show(bench.reads(said, &said.say, change), &row.code).read_only()
}

/// From where a centre is measured: shown by an arc, which is read only.
fn centre(bench: &Bench, row: &CodeRow, from: CentreFrom, rows: &mut Vec<Row>) {
    let said = arc(bench.dialect, "XY", "clockwise");
    // The writer's own words, from the start point, and what they would be from program zero.
    let (meant, i, j) = match from {
        CentreFrom::Start => (said.say.clone(), "I6", "J8"),
        CentreFrom::Zero => (said.say.replace("start, I 6mm, J 8mm", "zero, I 9mm, J 12mm"), "I9", "J12"),
    };
    let put = |text: String| text.replace("I6", &format!("{} {i}", row.code)).replace("J8", j);
    let tried = must_show(bench.reads(&said, &meant, put), &row.code);
    rows.push(tried.read_only().row("code", row.code.clone(), row.sure));
}

fn dwells(bench: &Bench, row: &CodeRow, rows: &mut Vec<Row>) {
    let said = Said::new("DWELL(1.5s)");
    for (at, word) in row.dwell.iter().enumerate() {
        let name = format!("{} {}", row.code, word.letter);
        if at == 0 {
            rows.push(code(bench, row, Meaning::Dwell, &said).row("code", name, row.sure));
            continue;
        }
        let first = row.dwell[0].letter;
        // One and a half seconds in the word's own form.
        let value = if word.quantity == Quantity::Milliseconds { "1500" } else { "1.5" };
        let put = |text: String| {
            let code_at = text.find(&row.code).unwrap_or(0);
            let (head, rest) = text.split_at(code_at);
            let at = rest.find(first).unwrap_or(0);
            let end =
                at + 1 + rest[at + 1..].bytes().take_while(|b| b.is_ascii_digit() || *b == b'.').count();
            format!("{head}{}{}{value}{}", &rest[..at], word.letter, &rest[end..])
        };
        rows.push(bench.reads(&said, &said.say, put).read_only().row("code", name, row.sure));
    }
    if row.dwell.is_empty() {
        rows.push(Tried::failure(dictionary("no-dwell-word")).row("code", row.code.clone(), row.sure));
    }
}
