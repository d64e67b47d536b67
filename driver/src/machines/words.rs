//! Chooses the entry of `messages/` for a fault of a profile, with its values.

use ncc_machines::{Lacks, Needs, PatternFault, Takes, Twice, Wrong};

use crate::render::messages::message::{Help, Message, Part};
use crate::render::text::quoted;

/// A fault of a profile in words.
pub struct Words {
    /// The headline.
    pub message: String,
    /// Why this place.
    pub label: String,
    /// Why the other place, if it is not the first of two.
    pub related: Option<String>,
    /// What to do.
    pub help: Option<String>,
}

/// The words of a fault. `schemas` names the command that lists every key of the file.
pub fn words(wrong: &Wrong, schemas: &str) -> Words {
    let message = message(wrong);
    let help = match wrong {
        Wrong::Form { .. } | Wrong::Kind { .. } => Some(Help::Words(schemas.to_owned())),
        Wrong::UnknownOption { has, .. } if !has.is_empty() => {
            Some(Help::new("help-has").text("has", has.join(", ")))
        }
        _ => None,
    };
    Words {
        message: message.headline(),
        label: message.label(),
        related: message.related(),
        help: message.helps(help.map(|help| vec![help])).pop(),
    }
}

fn message(wrong: &Wrong) -> Message {
    let m = Message::new(wrong.code());
    match wrong {
        Wrong::Form { message } => m.text("message", message.lines().next().unwrap_or_default()),
        Wrong::Kind { found, takes } => {
            m.form("kind").text("found", quoted(found)).text("takes", takes_words(*takes))
        }
        Wrong::UnknownDialect { name } | Wrong::NoFolder { name } => m.text("name", name.as_str()),
        Wrong::NoBody { text, is_range } => {
            let m = if *is_range { m.form("range") } else { m };
            m.text("text", text.as_str())
        }
        Wrong::UnknownOption { option, has } => {
            let m = if has.is_empty() { m.form("none") } else { m };
            m.text("option", option.as_str())
        }
        Wrong::OptionValue { option, value, takes } => {
            let m = if takes.is_empty() { m.form("number") } else { m.text("takes", takes.join(", ")) };
            m.text("option", option.as_str()).text("value", value.as_str())
        }
        Wrong::UnknownRow { row } => m.text("row", row.as_str()),
        Wrong::Twice { what } => twice(what, m),
        Wrong::UpsideDown | Wrong::NoRows => m,
        Wrong::Takes { key, takes } => m.text("key", key.to_string()).text("takes", takes_words(*takes)),
        Wrong::Missing { key, needs } => m.form(needs_form(*needs)).text("key", key.to_string()),
        Wrong::CodeKnown { code, means } => m.text("code", code.to_string()).text("means", means.to_string()),
        Wrong::NotOneToOne { function } => m.text("function", function.to_string()),
        Wrong::TooFine { key, most } => m.text("key", key.to_string()).text("most", most.to_string()),
        Wrong::NoForm { key, lacks } => m.form(lacks_form(*lacks)).text("key", key.to_string()),
        Wrong::UnusedSource { tag, nearest } => m.text("tag", tag.as_str()).text("nearest", nearest.as_str()),
        Wrong::NoMachine { name, is_dialect: true, .. } => {
            let table = format!("{{ dialect = {name:?} }}");
            m.form("dialect").text("name", name.as_str()).text("table", table)
        }
        Wrong::NoMachine { name, has, .. } => m.text("name", name.as_str()).text("has", has.join(", ")),
        Wrong::Pattern { why } => pattern(why, m),
        Wrong::TwoRows { program } => m.text("program", program.to_string()),
        Wrong::NoFile { pattern } => m.text("pattern", pattern.as_str()),
    }
}

/// The values that a key takes, in words.
pub fn takes_words(takes: Takes) -> String {
    let part = |form| Message::part(Part::Machine, form);
    let ends = |form, least: i64, most: i64| {
        part(form).text("least", least.to_string()).text("most", most.to_string()).headline()
    };
    match takes {
        Takes::OneOf(words) => words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", "),
        Takes::WholeBetween { least: 0, most } => {
            part("takes-whole-up-to").text("most", most.to_string()).headline()
        }
        Takes::WholeBetween { least, most } => ends("takes-whole-between", least.into(), most.into()),
        Takes::Between { least, most } => ends("takes-between", least, most),
        Takes::Text => part("takes-text").headline(),
        Takes::Texts => part("takes-texts").headline(),
        Takes::Number => part("takes-number").headline(),
        Takes::NumberOrWord => part("takes-number-or-word").headline(),
        Takes::Fact => part("takes-fact").headline(),
        Takes::Whole => part("takes-whole").headline(),
        Takes::WholeAboveZero => part("takes-whole-above-zero").headline(),
        Takes::FromZero => part("takes-from-zero").headline(),
        Takes::AboveZero => part("takes-above-zero").headline(),
        Takes::LowAndHigh => part("takes-low-and-high").headline(),
        Takes::ProgramName => part("takes-program-name").headline(),
        Takes::FunctionName => part("takes-function-name").headline(),
        Takes::MCode => part("takes-m-code").headline(),
        Takes::Lines => part("takes-lines").headline(),
        Takes::Extension => part("takes-extension").headline(),
        Takes::Patterns => part("takes-patterns").headline(),
        Takes::Machine => part("takes-machine").headline(),
        Takes::Folder => part("takes-folder").headline(),
        Takes::Folders => part("takes-folders").headline(),
        Takes::Body => part("takes-body").headline(),
        Takes::Bodies => part("takes-bodies").headline(),
    }
}

fn twice(what: &Twice, m: Message) -> Message {
    let number = |m: Message, number: u32| m.text("number", number.to_string());
    match what {
        Twice::Axis { letter } => m.form("axis").text("letter", letter.as_str()),
        Twice::Tool { number: n } => number(m.form("tool"), *n),
        Twice::ToolName { name } => m.form("tool-name").text("name", name.as_str()),
        Twice::Pocket { number: n } => number(m.form("pocket"), *n),
        Twice::LengthEntry { number: n } => number(m.form("length-entry"), *n),
        Twice::Edge { tool, edge } => number(m.form("edge"), *edge).text("tool", tool.to_string()),
        Twice::WorkOffset { number: n } => number(m.form("work-offset"), *n),
        Twice::WorkOffsetName { name } => m.form("work-offset-name").text("name", name.as_str()),
        Twice::Program { number: n } => number(m.form("program"), *n),
        Twice::ProgramName { name } => m.form("program-name").text("name", name.as_str()),
        Twice::Code { code } => m.form("code").text("code", code.as_str()),
    }
}

fn needs_form(needs: Needs) -> &'static str {
    match needs {
        Needs::Axis => "axis",
        Needs::Tool => "tool",
        Needs::Edge => "edge",
        Needs::WorkOffset => "work-offset",
        Needs::Program => "program",
        Needs::NewNumbers => "new-numbers",
    }
}

fn lacks_form(lacks: Lacks) -> &'static str {
    match lacks {
        Lacks::LengthTable => "length-table",
        Lacks::BlockNumbers => "block-numbers",
        Lacks::Comments => "comments",
        Lacks::ProgramNumbers => "program-numbers",
    }
}

fn pattern(why: &PatternFault, m: Message) -> Message {
    match why {
        PatternFault::Empty => m.form("empty"),
        PatternFault::Backslash => m.form("backslash"),
        PatternFault::Outside => m.form("outside"),
        PatternFault::NoneInList => m.form("none"),
        PatternFault::Unread { reader } => m.text("reader", reader.as_str()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Formatting checks by itself that an entry is there, parses, and has a value for each of its variables.
    #[test]
    fn every_fault_of_a_profile_has_its_words() {
        let s = || "name".to_owned();
        let some = || vec![s()];
        let all = [
            Wrong::Form { message: "unclosed table\nat".into() },
            Wrong::Kind { found: s(), takes: Takes::Fact },
            Wrong::UnknownDialect { name: s() },
            Wrong::UnknownOption { option: s(), has: some() },
            Wrong::UnknownOption { option: s(), has: Vec::new() },
            Wrong::OptionValue { option: s(), value: s(), takes: some() },
            Wrong::OptionValue { option: s(), value: s(), takes: Vec::new() },
            Wrong::UnknownRow { row: s() },
            Wrong::Twice { what: Twice::Axis { letter: s() } },
            Wrong::Twice { what: Twice::Tool { number: 1 } },
            Wrong::Twice { what: Twice::ToolName { name: s() } },
            Wrong::Twice { what: Twice::Pocket { number: 1 } },
            Wrong::Twice { what: Twice::LengthEntry { number: 1 } },
            Wrong::Twice { what: Twice::Edge { tool: 1, edge: 2 } },
            Wrong::Twice { what: Twice::WorkOffset { number: 1 } },
            Wrong::Twice { what: Twice::WorkOffsetName { name: s() } },
            Wrong::Twice { what: Twice::Program { number: 1 } },
            Wrong::Twice { what: Twice::ProgramName { name: s() } },
            Wrong::Twice { what: Twice::Code { code: s() } },
            Wrong::UpsideDown,
            Wrong::Takes { key: "key", takes: Takes::Number },
            Wrong::Missing { key: "key", needs: Needs::Axis },
            Wrong::Missing { key: "key", needs: Needs::Tool },
            Wrong::Missing { key: "key", needs: Needs::Edge },
            Wrong::Missing { key: "key", needs: Needs::WorkOffset },
            Wrong::Missing { key: "key", needs: Needs::Program },
            Wrong::Missing { key: "key", needs: Needs::NewNumbers },
            Wrong::CodeKnown { code: s(), means: s() },
            Wrong::NotOneToOne { function: s() },
            Wrong::TooFine { key: "key", most: 3 },
            Wrong::NoForm { key: "key", lacks: Lacks::LengthTable },
            Wrong::NoForm { key: "key", lacks: Lacks::BlockNumbers },
            Wrong::NoForm { key: "key", lacks: Lacks::Comments },
            Wrong::NoForm { key: "key", lacks: Lacks::ProgramNumbers },
            Wrong::UnusedSource { tag: s(), nearest: s() },
            Wrong::NoMachine { name: s(), has: some(), is_dialect: true },
            Wrong::NoMachine { name: s(), has: some(), is_dialect: false },
            Wrong::Pattern { why: PatternFault::Empty },
            Wrong::Pattern { why: PatternFault::Backslash },
            Wrong::Pattern { why: PatternFault::Outside },
            Wrong::Pattern { why: PatternFault::NoneInList },
            Wrong::Pattern { why: PatternFault::Unread { reader: s() } },
            Wrong::TwoRows { program: s() },
            Wrong::NoFile { pattern: s() },
            Wrong::NoRows,
            Wrong::NoFolder { name: s() },
            Wrong::NoBody { text: s(), is_range: false },
            Wrong::NoBody { text: s(), is_range: true },
        ];
        let mut codes: Vec<u16> = all.iter().map(Wrong::code).collect();
        codes.dedup();
        assert_eq!(codes, [Wrong::CODES, Wrong::PROJECT_CODES].concat(), "a code without a sample");
        for wrong in &all {
            let words = words(wrong, "schemas");
            assert!(!words.message.is_empty() && !words.label.is_empty(), "{wrong:?}");
        }
    }

    #[test]
    fn every_key_has_words_for_its_values() {
        use ncc_machines::{project, schema, table::Table};
        let of_tables = [
            schema::PowerOn::KEYS,
            schema::Rates::KEYS,
            schema::Times::KEYS,
            schema::Spindle::KEYS,
            schema::AxisRow::KEYS,
            schema::ToolRow::KEYS,
            schema::EdgeRow::KEYS,
            schema::WorkOffsetRow::KEYS,
            schema::ProgramRow::KEYS,
            schema::MCodeRow::KEYS,
            schema::ValueRow::KEYS,
            schema::Emit::KEYS,
            project::KEYS,
        ];
        let keys = of_tables.into_iter().flatten().map(|key| key.takes);
        for takes in keys.chain([Takes::Number, Takes::NumberOrWord, Takes::Texts, Takes::Fact]) {
            assert!(!takes_words(takes).is_empty(), "{takes:?}");
        }
    }
}
