//! Tests of the cycles and patterns of a dictionary, each as a program.

use ncc_dialects::{CycleRow, Dialect, Family, Hand, PatternRow};
use ncc_ir::canon::ReturnLevel;
use ncc_ir::program::cycle::Approach;

use crate::render::dictionary::dictionary;

use super::proof::{Bench, Said, Tried, in_place, must_show};
use super::row::Row;

/// Values of a cycle's words, in mm and seconds.
#[derive(Clone, Debug)]
pub(super) struct Values {
    retract: &'static str,
    depth: &'static str,
    dwell: &'static str,
    pub(super) peck: &'static str,
}

impl Default for Values {
    fn default() -> Values {
        Values { retract: "3", depth: "-12", dwell: "0.5", peck: "5" }
    }
}

/// A cycle's call in the text form.
pub(super) fn cycle_text(d: &Dialect, row: &CycleRow, values: &Values) -> String {
    let dwell = format!("dwell {}s", values.dwell);
    if row.kind.starts_with("tap") {
        return tap_text(d, row, values);
    }
    let own: Vec<String> = match row.kind.as_str() {
        "bore" if row.feed_to_level => vec!["to-level".to_owned()],
        "bore-fine" => vec![format!("shift parameter {}mm, after clockwise", values.peck)],
        "bore-stop" if row.turns_on => vec!["after as-before".to_owned()],
        "bore-stop" => vec!["after clockwise".to_owned()],
        "drill-peck" => vec![pecks_text(row, "clearance", values)],
        "drill-break" => vec![pecks_text(row, "lift", values)],
        _ => Vec::new(),
    };
    let last = if row.kind == "bore" { 0 } else { own.len() };
    let mut own = own;
    own.splice(last..last, row.dwell.map(|_| dwell));
    let own = if own.is_empty() { String::new() } else { format!("({})", own.join(", ")) };
    let level = match d.cycles.return_level.map(ReturnLevel::from) {
        Some(ReturnLevel::Retract) => "retract",
        Some(ReturnLevel::Initial) | None => "initial",
    };
    format!(
        "START_CYCLE({}{own}, XY, retract {}mm, depth {}mm, return {level}, {}, feed 120mm)",
        row.kind,
        values.retract,
        values.depth,
        approach(d)
    )
}

/// How the control goes to a hole, in the text form.
pub(super) fn approach(d: &Dialect) -> &'static str {
    match Approach::from(d.cycles.approach) {
        Approach::PlaneFirst => "plane-first",
        Approach::RaiseFirst => "raise-first",
        Approach::ClearFirst => "clear-first",
        Approach::RetractFirst => "retract-first",
    }
}

/// A tapping cycle's call in the text form.
fn tap_text(d: &Dialect, row: &CycleRow, values: &Values) -> String {
    let drill = CycleRow { kind: "drill".into(), dwell: None, ..row.clone() };
    let turn = match row.hand {
        Some(Hand::Left) => "counterclockwise",
        Some(Hand::Right) | None => "clockwise",
    };
    let dwells = match row.dwell {
        Some(_) if row.dwells_turned => format!(", back {}s", values.dwell),
        Some(_) => format!(", dwell {0}s, settle {0}s", values.dwell),
        None => String::new(),
    };
    let after = if row.kind == "tap" { turn } else { "stopped" };
    let level = if row.feed_to_level { ", to-level" } else { "" };
    let tap = format!("{}({turn}, pitch feed{dwells}, after {after}{level})", row.kind);
    cycle_text(d, &drill, values).replacen("drill", &tap, 1)
}

/// Whether a cycle is the one that is written for its kind.
pub(super) fn writes(d: &Dialect, row: &CycleRow) -> bool {
    let same =
        |c: &&CycleRow| c.kind == row.kind && c.dwell.is_some() == row.dwell.is_some() && c.hand == row.hand;
    let code = d.code.iter().find(|c| c.code == row.code);
    code.is_some_and(|c| c.write)
        && d.cycle.iter().find(same).is_some_and(|first| std::ptr::eq(first, row))
        && d.family == Family::Word
}

pub(super) fn cycle(bench: &Bench, row: &CycleRow, rows: &mut Vec<Row>) {
    let d = bench.dialect;
    let code = d.code.iter().find(|c| c.code == row.code);
    let sure = row.sure && code.is_some_and(|c| c.sure);
    let usual = Values::default();
    // A word that an option may make its dwell is one where that is the working choice.
    let said = CycleRow { dwell: bench.settings.dwell(row), ..row.clone() };
    let mut tries = vec![
        (row.code.clone(), usual.clone()),
        (format!("{} {}", row.code, row.depth), Values { depth: "-7.891", ..usual.clone() }),
        (format!("{} {}", row.code, row.retract), Values { retract: "-2.345", ..usual.clone() }),
    ];
    if let Some(word) = said.dwell {
        tries.push((format!("{} {}", row.code, word.letter), Values { dwell: "0.123", ..usual.clone() }));
    }
    if let Some(letter) = row.peck.or(row.shift) {
        tries.push((format!("{} {letter}", row.code), Values { peck: "1.234", ..usual.clone() }));
    }
    let primary = d.cycle.iter().find(|c| {
        let same = c.kind == row.kind && c.dwell.is_some() == row.dwell.is_some() && c.hand == row.hand;
        same && writes(d, c)
    });
    for (name, values) in tries {
        let say = format!("{}\nHOLE(X 10mm, Y 20mm)", cycle_text(d, &said, &values));
        let said = Said { after: "END_CYCLE()".to_owned(), ..Said::new(say) };
        let tried = match primary {
            Some(first) if first.code == row.code => must_show(bench.both_ways(&said), &row.code),
            Some(first) => {
                let put = |text: String| in_place(&text, &first.code, &row.code).unwrap_or(text);
                must_show(bench.reads(&said, &said.say, put), &row.code).read_only()
            }
            None => Tried::failure(dictionary("no-cycle-written").text("kind", row.kind.as_str())),
        };
        rows.push(tried.row("cycle", name, sure));
    }
    if let (Some([first, less, least]), Some(first_row)) =
        (row.shrinking, primary.filter(|p| p.code == row.code))
    {
        let usual = cycle_text(d, &CycleRow { dwell: None, ..first_row.clone() }, &usual);
        let shrinks = usual.replace("(peck 5mm", "(peck 2mm").replacen(
            "parameter",
            "parameter, first 5mm, less 1.5mm",
            1,
        );
        let said =
            Said { after: "END_CYCLE()".to_owned(), ..Said::new(format!("{shrinks}\nHOLE(X 10mm, Y 20mm)")) };
        let tried = must_show(bench.both_ways(&said), &row.code);
        rows.push(tried.row("cycle", format!("{} {first}{less}{least}", row.code), sure));
    }
    if let (Some(letter), true) = (d.cycles.repeat, primary.is_some_and(|p| p.code == row.code)) {
        // Written with one hole, and read with the word behind it.
        let start = cycle_text(d, &said, &usual);
        let hole = "\nHOLE(X 10mm, Y 20mm)";
        let one = Said { after: "END_CYCLE()".to_owned(), ..Said::new(format!("{start}{hole}")) };
        let least = usize::from(d.cycles.repeat_once);
        for times in [least, 3] {
            let put = |text: String| {
                let line = |l: &str| match in_place(l, &row.code, "") {
                    Some(_) => format!("{l} {letter}{times}\n"),
                    None => format!("{l}\n"),
                };
                text.lines().map(line).collect::<String>()
            };
            let tried = bench.reads(&one, &format!("{start}{}", hole.repeat(times)), put).read_only();
            rows.push(tried.row("cycle", format!("{} {letter}{times}", row.code), sure));
        }
    }
}

pub(super) fn pattern(bench: &Bench, row: &PatternRow, rows: &mut Vec<Row>) {
    let d = bench.dialect;
    let Some(cycle) = d.cycle.iter().find(|row| writes(d, row)) else {
        rows.push(Tried::failure(dictionary("no-hole-cycle")).row("pattern", row.code(), true));
        return;
    };
    let start = cycle_text(d, cycle, &Values::default());
    let patterns: Vec<String> = match row {
        PatternRow::Circle { .. } => vec![
            "CIRCLE_PATTERN(centre here, first (18mm, 0mm), step 30deg, count 12)".to_owned(),
            "CIRCLE_PATTERN(centre here, first (0mm, -12.5mm), step -22.5deg, count 3)".to_owned(),
        ],
        PatternRow::Grid { serpentine, .. } => {
            let order = if *serpentine { ", serpentine" } else { "" };
            vec![
                format!("RECTANGULAR_LAYOUT(columns (X, 15mm, 2), rows (Y, 20mm, 2){order})"),
                format!("RECTANGULAR_LAYOUT(columns (X, -7.5mm, 2), rows (Y, 2.25mm, 2){order})"),
            ]
        }
    };
    let code = d.code.iter().find(|c| c.code == row.code());
    for say in patterns {
        let before = format!("said STRAIGHT_TRAVERSE(X 0mm, Y 0mm)\n{start}");
        let said = Said { before, after: "END_CYCLE()".to_owned(), ..Said::new(say) };
        let tried = must_show(bench.both_ways(&said), row.code());
        rows.push(tried.row("pattern", row.code(), code.is_some_and(|c| c.sure)));
    }
}

/// The pecks of a cycle in the text form; `by` is what the control has a parameter for.
fn pecks_text(row: &CycleRow, by: &str, values: &Values) -> String {
    let by = if row.from_return { format!("{by} return") } else { format!("{by} parameter") };
    let pause =
        row.own_pause().map(|pause| f64::from(pause.mantissa as i32) / 10f64.powi(pause.scale.into()));
    let dwells = pause.map_or_else(String::new, |pause| format!(", pause {pause}s, dwell {pause}s"));
    format!("peck {}mm, {by}{dwells}", values.peck)
}
