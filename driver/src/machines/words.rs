//! Chooses the entry of `messages/` for a fault of a profile, with its values.

use ncc_machines::Wrong;

use crate::render::messages::message::{Help, Message};

/// A fault of a profile in words.
pub struct Words {
    /// The headline.
    pub message: String,
    /// Why this place.
    pub label: String,
    /// What to do.
    pub help: Option<String>,
}

/// The words of a fault. `schemas` names the command that lists every key of the file.
pub fn words(wrong: &Wrong, schemas: &str) -> Words {
    let message = message(wrong);
    let help = match wrong {
        Wrong::Form { .. } => Some(Help::Words(schemas.to_owned())),
        Wrong::UnknownOption { has, .. } if !has.is_empty() => {
            Some(Help::new("help-has").text("has", has.join(", ")))
        }
        _ => None,
    };
    Words {
        message: message.headline(),
        label: message.label(),
        help: message.helps(help.map(|help| vec![help])).pop(),
    }
}

fn message(wrong: &Wrong) -> Message {
    let m = Message::new(wrong.code());
    match wrong {
        Wrong::Form { message } => {
            let first = message.lines().next().unwrap_or("it is no profile");
            let trade = first.replace("expected f64", "expected a number");
            m.text("message", trade.replace("expected u32", "expected a whole number"))
        }
        Wrong::UnknownDialect { name } | Wrong::NoFolder { name } => m.text("name", name.as_str()),
        Wrong::UnknownOption { option, has } => {
            let m = if has.is_empty() { m.form("none") } else { m };
            m.text("option", option.as_str())
        }
        Wrong::OptionValue { option, value, takes } => {
            let m = if takes.is_empty() { m.form("number") } else { m.text("takes", takes.join(", ")) };
            m.text("option", option.as_str()).text("value", value.as_str())
        }
        Wrong::UnknownRow { row } => m.text("row", row.as_str()),
        Wrong::Twice { what } => m.text("what", what.to_string()),
        Wrong::UpsideDown | Wrong::NoRows => m,
        Wrong::Takes { key, takes } => m.text("key", key.to_string()).text("takes", takes.to_string()),
        Wrong::Missing { key, why } => m.text("key", key.to_string()).text("why", why.to_string()),
        Wrong::CodeKnown { code, means } => m.text("code", code.to_string()).text("means", means.to_string()),
        Wrong::NotOneToOne { function } => m.text("function", function.to_string()),
        Wrong::TooFine { key, most } => m.text("key", key.to_string()).text("most", most.to_string()),
        Wrong::NoForm { key, lacks } => m.text("key", key.to_string()).text("lacks", lacks.to_string()),
        Wrong::NoMachine { name, is_dialect: true, .. } => {
            let table = format!("{{ dialect = {name:?} }}");
            m.form("dialect").text("name", name.as_str()).text("table", table)
        }
        Wrong::NoMachine { name, has, .. } => m.text("name", name.as_str()).text("has", has.join(", ")),
        Wrong::Pattern { message } => m.text("message", message.as_str()),
        Wrong::TwoRows { program } => m.text("program", program.to_string()),
        Wrong::NoFile { pattern } => m.text("pattern", pattern.as_str()),
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
            Wrong::Form { message: "expected u32\nat".into() },
            Wrong::UnknownDialect { name: s() },
            Wrong::UnknownOption { option: s(), has: some() },
            Wrong::UnknownOption { option: s(), has: Vec::new() },
            Wrong::OptionValue { option: s(), value: s(), takes: some() },
            Wrong::OptionValue { option: s(), value: s(), takes: Vec::new() },
            Wrong::UnknownRow { row: s() },
            Wrong::Twice { what: s() },
            Wrong::UpsideDown,
            Wrong::Takes { key: "key", takes: "a number" },
            Wrong::Missing { key: "key", why: "it has a name" },
            Wrong::CodeKnown { code: s(), means: s() },
            Wrong::NotOneToOne { function: s() },
            Wrong::TooFine { key: "key", most: 3 },
            Wrong::NoForm { key: "key", lacks: "form" },
            Wrong::NoMachine { name: s(), has: some(), is_dialect: true },
            Wrong::NoMachine { name: s(), has: some(), is_dialect: false },
            Wrong::Pattern { message: s() },
            Wrong::TwoRows { program: s() },
            Wrong::NoFile { pattern: s() },
            Wrong::NoRows,
            Wrong::NoFolder { name: s() },
        ];
        let mut codes: Vec<u16> = all.iter().map(Wrong::code).collect();
        codes.dedup();
        assert_eq!(codes, [Wrong::CODES, Wrong::PROJECT_CODES].concat(), "a code without a sample");
        for wrong in &all {
            let words = words(wrong, "schemas");
            assert!(!words.message.is_empty() && !words.label.is_empty(), "{wrong:?}");
        }
    }
}
