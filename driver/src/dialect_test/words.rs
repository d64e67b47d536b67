//! Address letters: a statement for what each is, and its refusal where it is nothing by itself.

use ncc_dialects::{Address, Dialect, Family, PatternRow, Quantity, Role};
use ncc_ir::canon::CornerShape;

use super::proof::{Bench, Said, Tried, refusal};
use super::row::Row;
use super::statements::{arc, corner, with_procedure};
use crate::render::dictionary::dictionary;

/// The rows of the address letters.
pub fn rows(bench: &Bench, rows: &mut Vec<Row>) {
    for (shape, word) in bench.dialect.corner.words() {
        let function = match shape {
            CornerShape::Round => "ROUND_CORNER",
            CornerShape::Leg => "CHAMFER_CORNER",
            CornerShape::Length => "CHAMFER_CORNER_BY_LENGTH",
        };
        let mut tried = bench.both_ways(&corner(function));
        let comma = if word.comma { "," } else { "" };
        let sign = if word.negative { "-" } else { "" };
        let text = format!("{comma}{}{sign}", word.letter);
        if tried.failed.is_none() && !tried.written.iter().any(|line| line.contains(&text)) {
            tried.failed = Some(dictionary("not-written").text("word", text.as_str()).headline());
        }
        let row = bench.dialect.address_row(word.letter as u8);
        let sure = word.comma || row.is_none_or(|row| row.sure);
        rows.push(tried.row("corner", format!("{text} {function}"), sure));
    }
    if let Some([first, last, times]) = bench.dialect.repeat.letters().map(|l| l.map(char::from)) {
        let said = Said::new("REPEAT_BLOCKS(\"BLOCK10\" to \"BLOCK20\", times 4)").after(
            "N10 LABEL(\"BLOCK10\") & said STRAIGHT_TRAVERSE(X 1mm)\nN20 LABEL(\"BLOCK20\") & said STRAIGHT_TRAVERSE(X 2mm)",
        );
        let mut tried = bench.both_ways(&said);
        let text = format!("{first}10{last}20{times}");
        if tried.failed.is_none() && !tried.written.iter().any(|line| line.replace(' ', "").contains(&text)) {
            tried.failed = Some(dictionary("not-written").text("word", text.as_str()).headline());
        }
        rows.push(tried.row("repeat", format!("{first} {last} {times} REPEAT_BLOCKS"), true));
    }
    for row in &bench.dialect.address {
        let letter = row.letter.to_string();
        for said in said(bench.dialect, row) {
            let mut tried = bench.both_ways(&said);
            if tried.failed.is_none() && !tried.written.iter().any(|line| line.contains(&letter)) {
                tried.failed = Some(dictionary("other-written").text("word", letter.as_str()).headline());
            }
            rows.push(tried.row("address", format!("{letter} {}", name(row)), row.sure));
        }
        if row.role == Role::Corrector {
            let tried = bench.both_ways(&Said::new("USE_TOOL_LENGTH_OFFSET(0)"));
            rows.push(tried.row("address", format!("{letter}0"), row.sure && row.zero_sure));
        }
        if let Some(name) = &row.refuse {
            let value = if row.quantity == Quantity::Integer { "1" } else { "1." };
            let texts = [
                (format!("{letter}{value}"), ""),
                (format!("{letter}1={value}"), ""),
                (format!("{letter}1"), ""),
            ];
            rows.push(refusal(bench, "address", &format!("{letter} alone"), &texts, name, row.sure));
        }
        if row.role == Role::Parameter {
            let users = users(bench.dialect, row.letter);
            let failed = (users.is_empty() && row.refuse.is_none() && bench.dialect.family == Family::Word)
                .then(|| dictionary("not-used").headline());
            let tried =
                Tried { written: Vec::new(), read: vec![format!("a word of {}", users.join(", "))], failed };
            if !users.is_empty() || tried.failed.is_some() {
                rows.push(tried.row("address", format!("{letter} parameter"), row.sure));
            }
        }
    }
}

fn name(row: &Address) -> String {
    let name = format!("{:?}", row.role);
    let mut text = String::new();
    for c in name.chars() {
        if c.is_ascii_uppercase() && !text.is_empty() {
            text.push(' ');
        }
        text.push(c.to_ascii_lowercase());
    }
    text
}

/// Statements that need the letter.
fn said(d: &Dialect, row: &Address) -> Vec<Said> {
    let letter = row.letter;
    let one = |text: String| vec![Said::new(text)];
    match row.role {
        Role::Axis => {
            let unit = if row.quantity == Quantity::Angle { "deg" } else { "mm" };
            ["12.345", "-0.5"]
                .map(|v| Said::new(format!("said STRAIGHT_TRAVERSE({letter} {v}{unit})")))
                .into()
        }
        Role::CentreX | Role::CentreY => vec![arc(d, "XY", "clockwise")],
        Role::CentreZ => vec![arc(d, "ZX", "clockwise"), arc(d, "YZ", "counterclockwise")],
        Role::Radius => ["10", "-10"]
            .map(|r| Said::new(format!("said ARC_FEED(XY, clockwise, X 13mm, Y 14mm, radius {r}mm)")))
            .into(),
        Role::Feed => one("SET_FEED_RATE(123mm) & said STRAIGHT_FEED(X 10mm)".to_owned()),
        Role::Speed => one("SET_SPINDLE_SPEED(1234)".to_owned()),
        Role::Tool => one("SELECT_TOOL(12)".to_owned()),
        Role::LengthEntry | Role::Corrector => ["7", "21"]
            .map(|n| Said::new(format!("USE_TOOL_LENGTH_OFFSET({n}) & said STRAIGHT_TRAVERSE(Z 30mm)")))
            .into(),
        Role::ToolEdge => ["2", "0"].map(|n| Said::new(format!("said USE_TOOL_EDGE({n})"))).into(),
        Role::Call => vec![with_procedure(7, Said::new("CALL(7)"))],
        Role::RadiusEntry if d.caps.compensation.radii.entry => {
            one("START_CUTTER_RADIUS_COMPENSATION(right, 21) & said STRAIGHT_TRAVERSE(X 10mm)".to_owned())
        }
        // Where nothing reads it, it has to be refused.
        Role::RadiusEntry if row.refuse.is_none() => one(format!("NO_EFFECT(\"{letter}\")")),
        Role::RadiusEntry | Role::Parameter => Vec::new(),
    }
}

/// Rows of which a letter is a word.
fn users(d: &Dialect, letter: char) -> Vec<String> {
    let mut users: Vec<String> = Vec::new();
    for row in &d.code {
        if row.words.contains(letter) || row.dwell.iter().any(|w| w.letter == letter) {
            users.push(row.code.clone());
        }
    }
    for row in &d.cycle {
        let of = row.depth == letter
            || row.retract == letter
            || row.peck == Some(letter)
            || row.shift == Some(letter);
        if (of || row.dwell.is_some_and(|w| w.letter == letter)) && !users.contains(&row.code) {
            users.push(row.code.clone());
        }
    }
    for row in &d.pattern {
        let of = match row {
            PatternRow::Circle { first, centre, step, count, .. } => {
                first.contains(&letter) || centre.contains(&letter) || [*step, *count].contains(&letter)
            }
            PatternRow::Grid { pitch, counts, .. } => pitch.contains(&letter) || counts.contains(&letter),
        };
        if of {
            users.push(row.code().to_owned());
        }
    }
    if d.repeat.letters().is_some_and(|letters| letters.contains(&(letter as u8))) {
        users.push(dictionary("row-repeat").headline());
    }
    if d.polar.letters().is_some_and(|letters| letters.contains(&(letter as u8))) {
        users.push(dictionary("row-polar").headline());
    }
    if d.cycles.repeat == Some(letter) {
        users.push("cycles (repetition)".to_owned());
    }
    users
}
