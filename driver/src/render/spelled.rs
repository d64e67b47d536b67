//! Pieces of messages that are spelled from values: characters, what was found, radii, modes, the path of a return.

use ncc_dialects::{CycleRow, Dialect, Meaning};
use ncc_ir::alarms::{AlarmMapped, AlarmName};
use ncc_ir::behaviour::{Behaviour, Kept};
use ncc_ir::canon::ReturnLevel;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::ModeName;
use ncc_ir::syntax::{Expected, Found};

use super::messages::message::{Message, Part};
use super::numbers::millimetres;
use super::text::{plain, plain_upto, quoted};

/// An entry for a value.
fn spelled(form: &'static str) -> Message {
    Message::part(Part::Spelled, form)
}

/// The text that was found, in quotes if it is text of the source.
pub fn found_words(found: &Found) -> String {
    match found {
        Found::Text(text) if text.starts_with('`') => plain(text),
        Found::Text(text) => quoted(text),
        Found::EndOfLine => spelled("end-of-line").headline(),
        Found::EndOfBlock => spelled("end-of-block").headline(),
        Found::EndOfText => spelled("end-of-text").headline(),
        Found::Line => spelled("line").headline(),
        Found::ManyWords => spelled("many-words").headline(),
    }
}

/// The text that was expected.
pub fn expected_words(expected: &Expected) -> String {
    let form = match expected {
        Expected::Text(text) => return plain(text),
        Expected::OneOf(names) => return spelled("one-of").text("names", plain(names)).headline(),
        Expected::Words { most } => return spelled("most-words").text("most", most.to_string()).headline(),
        Expected::Bodies { most } => return spelled("most-bodies").text("most", most.to_string()).headline(),
        Expected::Word => "word",
        Expected::WordOrNumber => "word-or-number",
        Expected::Number => "number",
        Expected::NumberOrNothing => "number-or-nothing",
        Expected::WholeNumber => "whole-number",
        Expected::QuotedText => "text",
        Expected::PlainEscapes => "plain-escapes",
        Expected::Name => "name",
        Expected::Path => "path",
        Expected::Type => "type",
        Expected::Jump => "jump",
        Expected::Expression => "expression",
        Expected::Statement => "statement",
        Expected::Block => "block",
        Expected::OperatorOrEnd => "operator-or-end",
        Expected::EndOfBlock => "end-of-block",
        Expected::EndOfLine => "end-of-line",
        Expected::BodyAtEnd => "body-at-end",
        Expected::EndOfBody => "end-of-body",
        Expected::EndOfBodyAlone => "end-of-body-alone",
        Expected::PointOfPlane => "point-of-plane",
        Expected::RotaryAxis => "rotary-axis",
        Expected::StraightMove => "straight-move",
    };
    spelled(form).headline()
}

pub(crate) fn character(c: char) -> String {
    if c.is_control() || c as u32 > 0x7e {
        format!("`{}` (U+{:04X})", super::text::visible(c), c as u32)
    } else {
        format!("`{c}`")
    }
}

/// Both radii of an arc.
pub fn radii_of([start, end]: [i64; 2]) -> String {
    spelled("radii").text("start", millimetres(start)).text("end", millimetres(end)).headline()
}

/// How the words of a return to a reference point count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Counted {
    /// They are places of the part.
    OfPart,
    /// From where the axes stand.
    FromHere,
}

/// The path of a return to a reference point; `zero`: all of its words are nothing.
pub fn return_path(words: &str, zero: bool, counted: Counted) -> String {
    let words = plain_upto(words, 24);
    let path = |form| Message::part(Part::Question, form).text("words", words.as_str()).headline();
    match counted {
        Counted::OfPart => path("path-of-part"),
        Counted::FromHere if zero => path("path-from-here"),
        Counted::FromHere => path("path-by-words"),
    }
}

/// What an unconfirmed row means, in words of the trade; of a row in a user's dictionary that has none, its own text.
pub(crate) fn row_meaning(code: &str, meaning: &str, dialects: [&Dialect; 2]) -> String {
    let kind = dialects.into_iter().filter(|_| meaning == "START_CYCLE").find_map(|dialect| {
        let unsure = |row: &&CycleRow| row.code == code && !row.sure;
        let of_code = dialect.cycle.iter().find(unsure).map(|row| row.kind.as_str());
        let of_name = || dialect.call.iter().find(|row| row.name == code)?.kind.cycles().first().copied();
        of_code.or_else(of_name)
    });
    let row = kind.map_or_else(|| meaning.replace(' ', "-"), |kind| format!("{meaning}-{kind}"));
    entry_or_text(row, meaning)
}

/// The meaning of an unconfirmed row, without its dictionary.
pub(crate) fn meaning_words(meaning: &str) -> String {
    entry_or_text(meaning.replace(' ', "-"), meaning)
}

fn entry_or_text(row: String, meaning: &str) -> String {
    let words = Message::meaning(row).headline();
    if words.is_empty() { plain(meaning) } else { words }
}

/// A fact that ncc assumes of a control, and its value: `clearance of peck drilling`, `1 mm`.
pub(crate) fn assumed_fact(fact: &ControlFact) -> [String; 2] {
    let entry = Message::part(Part::ControlFact, "").reason(fact);
    [entry.headline(), entry.attribute("value")]
}

/// What begins otherwise in the next run, where an open fact of the program's end decides it.
pub fn next_run(behaviour: Behaviour) -> String {
    let form = match behaviour {
        Behaviour::VariablesAtEnd | Behaviour::VariablesWhenOff => "next-run-values",
        _ => "next-run-place",
    };
    spelled(form).headline()
}

/// What radius is not known: that of an entry of the table, or of an edge.
pub fn radius_unknown(entry: Option<u32>) -> String {
    match entry {
        Some(entry) => spelled("radius-of-entry").text("entry", entry.to_string()).headline(),
        None => spelled("radius-of-edge").headline(),
    }
}

/// How long a variable is kept.
pub fn kept(kept: Kept) -> String {
    let form = match kept {
        Kept::UntilEnd => "kept-until-end",
        Kept::UntilOff => "kept-until-off",
        Kept::Always => "kept-always",
    };
    spelled(form).headline()
}

/// Variables by their names.
pub fn variables(names: &[Box<str>]) -> String {
    spelled("variables").count("count", names.len() as u64).text("names", names.join(", ")).headline()
}

/// A modal fact's name.
pub fn mode(fact: ModeName) -> String {
    let form = match fact {
        ModeName::Motion => "motion",
        ModeName::Distance => "distance",
        ModeName::Units => "units",
        ModeName::Plane => "plane",
        ModeName::FeedMode => "feed-mode",
        ModeName::ReturnLevel => "return-level",
        ModeName::WorkOffset => "work-offset",
        ModeName::LengthOffset => "length-offset",
        ModeName::OriginShift => "origin-shift",
    };
    spelled(form).headline()
}

/// A straight move at feed.
pub fn feed_move() -> String {
    spelled("feed-move").headline()
}

/// A cycle from its R plane to its depth, and the level that it returns to.
pub fn cycle_levels(kind: &str, [retract, depth]: [String; 2], back: Option<ReturnLevel>) -> String {
    let form = match back {
        Some(ReturnLevel::Initial) => "cycle-initial",
        Some(ReturnLevel::Retract) => "cycle-retract",
        None => "cycle",
    };
    spelled(form).text("kind", kind).text("retract", retract).text("depth", depth).headline()
}

/// How a control takes corners at the start, by its name in a dictionary.
fn path_entry(name: &str) -> Option<Message> {
    match name {
        "exact-stop" => Some(spelled("path-exact-stop")),
        "rounded" => Some(spelled("path-rounded")),
        "within" => Some(spelled("path-within")),
        "blended" => Some(spelled("path-blended")),
        _ => None,
    }
}

/// How a control takes corners at the start.
pub fn path_start(name: &str) -> String {
    path_entry(name).map_or_else(|| name.to_owned(), |entry| entry.headline())
}

/// The same in at most three words.
pub fn path_start_short(name: &str) -> String {
    path_entry(name).map_or_else(|| name.to_owned(), |entry| entry.attribute("short"))
}

/// An alarm under its number, or by its text.
fn alarm(name: &AlarmName) -> String {
    match name {
        AlarmName::Number(number) => number.to_string(),
        AlarmName::Text(text) => spelled("alarm-text").text("text", plain(&format!("{text:?}"))).headline(),
    }
}

/// Alarms, and the alarms of the target in their place.
pub fn alarms_mapped(map: &[AlarmMapped]) -> String {
    let one = |AlarmMapped { from, to, text }: &AlarmMapped| {
        let form = if text.is_some() { "alarm-cut" } else { "alarm" };
        let message = spelled(form).text("from", alarm(from)).text("to", alarm(to));
        let text = text.as_ref().map_or(String::new(), |text| plain(&format!("{text:?}")));
        message.text("text", text).headline()
    };
    map.iter().map(one).collect::<Vec<_>>().join(", ")
}

/// The value of a modal fact.
pub fn mode_value(fact: ModeName, value: &str) -> String {
    match (fact, value) {
        (ModeName::Motion, "feed") => spelled("motion-feed").headline(),
        _ => plain(value),
    }
}

/// A work offset by the word that one of the dialects has for it, the first one if it has.
pub fn work_offset(number: u16, dialects: [&Dialect; 2]) -> String {
    let row = dialects.into_iter().find_map(|d| d.code_for(Meaning::SetOriginOffsets(number)));
    let unnamed = || spelled("work-offset-number").text("number", number.to_string()).headline();
    row.map_or_else(unnamed, |row| row.code.clone())
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use ncc_dialects::builtins;

    use super::row_meaning;

    #[test]
    fn every_unconfirmed_row_has_words_of_the_trade() {
        let mut used = BTreeSet::new();
        for dialect in builtins() {
            let codes = dialect.code.iter().filter(|row| !row.sure);
            let rows = codes.filter_map(|row| Some((row.code.as_str(), row.means?.to_string())));
            let cycles = dialect.cycle.iter().filter(|row| !row.sure);
            let rows = rows.chain(cycles.map(|row| (row.code.as_str(), "START_CYCLE".to_owned())));
            let calls = dialect.call.iter().filter(|row| !row.sure);
            let rows = rows.chain(calls.map(|row| {
                let cycle = !row.kind.cycles().is_empty();
                (row.name.as_str(), if cycle { "START_CYCLE" } else { "PATTERN" }.to_owned())
            }));
            for (code, meaning) in rows {
                let words = row_meaning(code, &meaning, [dialect, dialect]);
                assert!(!words.contains(char::is_uppercase) || words == "G92 shift", "{code}: {words}");
                used.insert(words);
            }
        }
        assert!(used.contains("boring with a spindle stop"), "{used:?}");
    }
}
