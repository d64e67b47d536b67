//! What has no word: comments, skip marks, block and program numbers, and the forms of numbers.

use ncc_dialects::{Dialect, Quantity, Role};
use ncc_ir::program::ProgramName;

use super::proof::{Bench, Said, Tried};
use super::row::Row;
use crate::render::dictionary::dictionary;

/// The rows of a dictionary's rules.
pub fn rows(bench: &Bench, rows: &mut Vec<Row>) {
    comments(bench, rows);
    skips(bench, rows);
    block_numbers(bench, rows);
    program_numbers(bench, rows);
    numbers(bench, rows);
}

fn comments(bench: &Bench, rows: &mut Vec<Row>) {
    let rules = &bench.dialect.comment;
    if rules.open.is_empty() {
        return;
    }
    let any_letters = dictionary("row-any-letters").headline();
    let mut texts = vec![("comment", "TEXT OF 1234567890".to_owned())];
    match rules.upper_ascii {
        true => texts.extend(rules.signs.chars().map(|c| ("comment sign", format!("A {c} B")))),
        false => texts.push((any_letters.as_str(), "Bohrung Ø8 + Fase, 45°".to_owned())),
    }
    // A comment needs its marks, and room in the longest block.
    let block = bench.dialect.block.longest;
    let marks = rules.open.len() + 2;
    let room = if block == 0 { rules.longest } else { (block as usize).saturating_sub(marks) };
    let longest = rules.longest.min(room);
    if longest > 0 {
        texts.push(("longest comment", "LONG ".chars().cycle().take(longest - 1).collect::<String>() + "X"));
    }
    for (row, text) in texts {
        let text = text.replace('\\', "\\\\").replace('"', "\\\"");
        let row = if row == "comment sign" {
            format!("{row} {}", text.chars().nth(2).unwrap_or(' '))
        } else {
            row.to_owned()
        };
        rows.push(bench.both_ways(&Said::new(format!("COMMENT(\"{text}\")"))).row("form", row.clone(), true));
    }
    let beside = Said::new("said STRAIGHT_TRAVERSE(X 10mm) \"BESIDE A BLOCK\"");
    rows.push(bench.both_ways(&beside).row("form", "comment in a block", true));
}

fn skips(bench: &Bench, rows: &mut Vec<Row>) {
    let rules = &bench.dialect.block;
    if rules.skip.is_empty() {
        return;
    }
    for level in 1..=rules.skip_levels.min(10) {
        let said = Said::new(format!("/{level} said STRAIGHT_TRAVERSE(X 10mm)"));
        rows.push(bench.both_ways(&said).row("form", format!("block skip {level}"), !rules.skip_unsure));
    }
}

fn block_numbers(bench: &Bench, rows: &mut Vec<Row>) {
    if bench.dialect.block.number.is_none() {
        return;
    }
    for number in [10, 99_999] {
        let said = Said::new(format!("N{number} said STRAIGHT_TRAVERSE(X 10mm)"));
        rows.push(bench.both_ways(&said).row("form", format!("block number {number}"), true));
    }
}

fn program_numbers(bench: &Bench, rows: &mut Vec<Row>) {
    let rules = &bench.dialect.program;
    let Some(letter) = rules.main_number() else { return };
    let digits = u32::try_from(rules.number_digits.clamp(1, 8)).unwrap_or(4);
    let highest = 10u32.pow(digits) - 1;
    let mut tries = vec![
        ("program number 1".to_owned(), ProgramName { number: Some(1), title: None }, letter),
        (format!("program number {highest}"), ProgramName { number: Some(highest), title: None }, letter),
    ];
    if rules.title {
        let title = Some("TITLE 12".into());
        tries.push(("program title".to_owned(), ProgramName { number: Some(12), title }, letter));
    }
    if let Some(also) = rules.number_also {
        let row = dictionary("row-number-by").text("letter", also.to_string()).headline();
        tries.push((row, ProgramName { number: Some(7), title: None }, also));
    }
    for (row, name, sign) in tries {
        let (written, read) = bench.name(&name, |text| match sign == letter {
            true => text,
            false => text.replacen(letter, &sign.to_string(), 1),
        });
        let failed = (read != name).then(|| dictionary("other-number").headline());
        let number = read.number.map(|n| n.to_string()).unwrap_or_default();
        let title = read.title.map(|t| format!(" {t:?}")).unwrap_or_default();
        let read = format!("program {number}{title}");
        let tried = Tried { written: vec![written], read: vec![read], failed };
        rows.push(match sign == letter {
            true => tried.row("form", row, true),
            false => tried.read_only().row("form", row, true),
        });
    }
}

/// A value of `digits` after the point.
fn least(digits: u8) -> String {
    match digits {
        0 => "1".to_owned(),
        _ => format!("0.{}1", "0".repeat(usize::from(digits) - 1)),
    }
}

/// Numbers of every kind that a word of the dialect carries.
fn numbers(bench: &Bench, rows: &mut Vec<Row>) {
    let d = bench.dialect;
    for (quantity, unit) in [
        (Quantity::Length, "mm"),
        (Quantity::Length, "in"),
        (Quantity::Feed, "mm"),
        (Quantity::Feed, "in"),
        (Quantity::Angle, "deg"),
        (Quantity::Speed, ""),
        (Quantity::Seconds, "s"),
        (Quantity::Milliseconds, "s"),
        (Quantity::Integer, ""),
    ] {
        let rules = d.numbers(quantity);
        let decimals =
            if unit == "in" { rules.decimals_inch.unwrap_or(rules.decimals) } else { rules.decimals };
        let mut values: Vec<String> = match quantity {
            Quantity::Integer => ["0", "1", "10", "250"].map(str::to_owned).into(),
            Quantity::Milliseconds => ["0.25", "1.", "12.5"].map(str::to_owned).into(),
            // Words have eight digits, those after the point included.
            _ => {
                let large = if decimals <= 4 { "1234" } else { "123" };
                ["1", "1.", "100", large].into_iter().map(str::to_owned).chain([least(decimals)]).collect()
            }
        };
        if !matches!(quantity, Quantity::Integer | Quantity::Milliseconds) && decimals > 0 {
            values.push("12.5".to_owned());
        }
        if matches!(quantity, Quantity::Length | Quantity::Angle) {
            values.extend(["0", "0.", "-1", "-12.5"].map(str::to_owned));
            values.push(format!("-{}", least(decimals)));
        }
        for value in values {
            let Some(said) = carried(d, quantity, &format!("{value}{unit}")) else { continue };
            let said = match unit {
                "in" => said.after("USE_LENGTH_UNITS(inch)\nsaid STRAIGHT_TRAVERSE(X 2in, Y 2in)"),
                _ => said,
            };
            let kind = format!("{quantity:?}").to_lowercase();
            rows.push(bench.both_ways(&said).row("number", format!("{kind} {value} {unit}"), true));
        }
    }
}

/// A statement that carries a number of a kind; `None` if no word of the dialect does.
fn carried(d: &Dialect, quantity: Quantity, value: &str) -> Option<Said> {
    let axis = |angle: bool| {
        let letter =
            d.address.iter().find(|a| a.role == Role::Axis && (a.quantity == Quantity::Angle) == angle);
        letter.map(|a| Said::new(format!("said STRAIGHT_TRAVERSE({} {value})", a.letter)))
    };
    let writes_dwell = |q: Quantity| {
        let row = d.code_for(ncc_dialects::Meaning::Dwell)?;
        (row.dwell.first()?.quantity == q).then(|| Said::new(format!("DWELL({value})")))
    };
    match quantity {
        Quantity::Length => axis(false),
        Quantity::Angle => axis(true),
        Quantity::Feed => {
            d.letter_for(Role::Feed)?;
            let unit = if value.ends_with("in") { "in" } else { "mm" };
            Some(Said::new(format!("SET_FEED_RATE({value}) & said STRAIGHT_FEED(X 10{unit})")))
        }
        Quantity::Speed => {
            d.letter_for(Role::Speed).map(|_| Said::new(format!("SET_SPINDLE_SPEED({value})")))
        }
        Quantity::Seconds | Quantity::Milliseconds => writes_dwell(quantity),
        Quantity::Integer => d.letter_for(Role::Tool).map(|_| Said::new(format!("SELECT_TOOL({value})"))),
        Quantity::Factor => None,
    }
}
