//! What to type where a code is not supported.

use ncc_dialects::{
    CodeRow, DWELL_REFUSED, Dialect, MACHINE_WITHOUT_AXIS, Meaning, NO_RADIUS, NOTHING, RADIUS_UNSAID, Role,
};
use ncc_ir::expr::system::System;

use super::message::Help;

/// The helps of NC0202 for a block of which `name` says what is not supported; `code` is its text. `None`: the help of the
/// entry itself.
pub(super) fn helps(code: &str, name: &str, from: &Dialect) -> Option<Vec<Help>> {
    let has = |option: &str| from.option.iter().any(|row| row.name == option);
    if let Some(typed) = variant(code, from).or_else(|| by_option(name, from)) {
        return Some(vec![typed]);
    }
    let all = match name {
        _ if name.starts_with("return in the main program") => {
            vec![Help::new("help-run-once"), Help::new("help-subprogram")]
        }
        "machine coordinates without an axis word" => {
            let nothing = || option_help("help-no-axis-nothing", MACHINE_WITHOUT_AXIS, NOTHING);
            let nothing = has(MACHINE_WITHOUT_AXIS).then(nothing);
            [Help::new("help-no-axis")].into_iter().chain(nothing).collect()
        }
        "variable of the control" => vec![Help::new("help-system-variable")],
        _ if name.ends_with(" while a cycle is in force") => vec![Help::new("help-cancel-cycle")],
        _ if name.starts_with("computed feed that may count") => vec![Help::new("help-feed-unit")],
        "variable that the program does not define" => {
            vec![Help::new("help-definition"), Help::new("help-assignments")]
        }
        "D of a block before, of which entry is not known here" => {
            let without = has(RADIUS_UNSAID).then(without_radius);
            [Help::new("help-radius-entry")].into_iter().chain(without).collect()
        }
        "data input for the entry of a code in force that the program has not said" => {
            let variable = code.rsplit_once('#').map_or("", |(_, number)| number);
            vec![Help::new("help-entry-at-start").text("variable", variable), Help::new("help-or-entry")]
        }
        _ if name.ends_with("of a block before, of which entry is not known here") => {
            let letter = name.chars().next().unwrap_or('H');
            vec![Help::new("help-entry-word").text("letter", letter)]
        }
        "data input for an entry whose number only the running program knows" => {
            vec![Help::new("help-entry")]
        }
        "VAR, or a first value, in a subprogram without its main program" => vec![Help::new("help-main")],
        _ if name.starts_with("time that goes on while") => vec![Help::new("help-timer")],
        "whether a probe has touched" => vec![Help::new("help-probe")],
        "data input of this kind" => vec![Help::new("help-data-input")],
        _ if code.starts_with('#') && name.starts_with("place of the control's tables whose number") => {
            vec![Help::new("help-table-entry")]
        }
        "pocket milling" => vec![Help::new("help-pocket")],
        _ if name.starts_with("circular pocket") => vec![Help::new("help-pocket")],
        _ => return None,
    };
    Some(all)
}

/// A help that names an option and a value of it.
fn option_help(help: &'static str, option: &str, value: &str) -> Help {
    Help::new(help).text("option", option).text("value", value)
}

/// The helps of NC0205, for a code that lacks a word.
pub(super) fn missing(code: &str, word: &str, from: &Dialect) -> Vec<Help> {
    if word == "D" && matches!(code, "G41" | "G42") {
        let other = match from.option.iter().any(|row| row.name == RADIUS_UNSAID) {
            true => without_radius(),
            false => Help::new("help-h-is-radius"),
        };
        return vec![Help::new("help-radius-entry"), other];
    }
    let retract = from.cycle_row(code).is_some_and(|row| row.retract.to_string() == word)
        && from.cycles.retained_by_all();
    let retract = retract.then(|| Help::new("help-retract"));
    [Help::new("help-add")].into_iter().chain(retract).chain(length_in_force(code, word, from)).collect()
}

/// What to type where an option decides what a word is: its name in brackets ends the fault's.
fn by_option(name: &str, from: &Dialect) -> Option<Help> {
    let option = name.split_once("(option ")?.1.strip_suffix(')')?;
    let row = from.option.iter().find(|row| row.name == option)?;
    let values = row.values.iter().filter(|value| *value != DWELL_REFUSED);
    let typed: Vec<String> = values.map(|value| format!("`--from-option {option}={value}`")).collect();
    Some(Help::new("help-option").text("options", typed.join(" or ")))
}

/// The options under which the source's control has a code that it refuses else.
fn variant(code: &str, from: &Dialect) -> Option<Help> {
    let same = |row: &CodeRow| row.code == code && row.means.is_some();
    let variant = from.variant.iter().find(|variant| variant.code.iter().any(same))?;
    let holds =
        |option: &str, value: &str| from.option.iter().any(|row| row.name == option && row.default == value);
    let left = variant.when.iter().filter(|(option, value)| !holds(option, value));
    let options: Vec<String> =
        left.map(|(option, value)| format!("--from-option {option}={value}")).collect();
    let options = options.join(" ");
    (!options.is_empty()).then(|| Help::new("help-variant").text("options", options))
}

/// What can be said of an M code that the dialect refuses.
pub(super) fn open(code: &str, from: &Dialect) -> Vec<Help> {
    variant(code, from).into_iter().chain(m_code()).collect()
}

/// What can be said of a code that is the machine's own.
pub(super) fn m_code() -> [Help; 2] {
    [Help::new("help-m-code"), Help::new("help-m-code-target")]
}

/// The option for a control that moves without compensation where no radius is named.
fn without_radius() -> Help {
    option_help("help-no-radius", RADIUS_UNSAID, NO_RADIUS)
}

/// The help for the entry of a length that is active at the start, where a code lacks its word.
fn length_in_force(code: &str, word: &str, from: &Dialect) -> Option<Help> {
    let length =
        from.code.iter().any(|row| row.code == code && row.means == Some(Meaning::UseToolLengthOffset));
    let letter = from.letter_for(Role::LengthEntry).map(String::from);
    if !length || letter.as_deref() != Some(word) {
        return None;
    }
    let name = variable(&System::LengthEntry, from)?;
    Some(Help::new("help-entry-at-start").text("variable", name))
}

/// The number of the variable by which a program asks this of the control.
fn variable(asked: &System, from: &Dialect) -> Option<String> {
    let mut all = from.system.iter().flat_map(|row| row.says());
    all.find(|(says, _)| says == asked).map(|(_, name)| name.to_string())
}
