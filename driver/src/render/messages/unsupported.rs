//! What to type where a code is not supported.

use ncc_dialects::{
    CodeRow, DWELL_REFUSED, Dialect, MACHINE_WITHOUT_AXIS, Meaning, NO_RADIUS, NOTHING, RADIUS_UNSAID,
    RefusalHelp, Role,
};
use ncc_ir::expr::system::System;
use ncc_ir::unsupported::{
    CallUnsupported, CodeUnsupported, CycleUnsupported, MoveUnsupported, SpindleUnsupported,
    TableUnsupported, Unsupported, ValueUnsupported,
};

use super::message::Help;

/// The helps of NC0202 where they depend on the dialect, or are several; `code` is the text of what is refused. `None`:
/// the help of the entry itself.
pub(super) fn helps(code: &str, what: &Unsupported, from: &Dialect) -> Option<Vec<Help>> {
    use Unsupported::{Call, Code, Cycle, Move, Spindle, Table, Value};
    let has = |option: &str| from.option.iter().any(|row| row.name == option);
    if let Some(typed) = variant(code, from) {
        return Some(vec![typed]);
    }
    let all = match what {
        Code(CodeUnsupported::Named { name }) => vec![Help::new(of_refusal(from.refusal_help(name)?))],
        Call(CallUnsupported::MainReturn) => vec![Help::new("help-run-once"), Help::new("help-subprogram")],
        Cycle(CycleUnsupported::DwellByOption { option, .. })
        | Spindle(SpindleUnsupported::AngleByOption { option, .. }) => vec![of_option(option, from)?],
        Move(MoveUnsupported::MachineNoAxis) => {
            let nothing = || option_help("help-nothing", MACHINE_WITHOUT_AXIS, NOTHING);
            let nothing = has(MACHINE_WITHOUT_AXIS).then(nothing);
            [Help::new("help")].into_iter().chain(nothing).collect()
        }
        Move(MoveUnsupported::RadiusEntryOfBefore { .. }) => {
            let without = has(RADIUS_UNSAID).then(without_radius);
            [Help::new("help-radius-entry")].into_iter().chain(without).collect()
        }
        Table(TableUnsupported::EntryAtStart) => {
            let variable = code.rsplit_once('#').map_or("", |(_, number)| number);
            vec![Help::new("help-entry-at-start").text("variable", variable), Help::new("help-or-entry")]
        }
        Table(TableUnsupported::AnyEntry) if code.starts_with('#') => vec![Help::new("help-table-entry")],
        Value(ValueUnsupported::Undefined) => {
            vec![Help::new("help-definition"), Help::new("help-assignments")]
        }
        _ => return None,
    };
    Some(all)
}

/// The entry of a help that a dictionary names.
fn of_refusal(help: RefusalHelp) -> &'static str {
    match help {
        RefusalHelp::Pocket => "help-pocket",
        RefusalHelp::Timer => "help-timer",
        RefusalHelp::Probe => "help-probe",
    }
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

/// What to type where an option decides what a word is.
fn of_option(option: &str, from: &Dialect) -> Option<Help> {
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
