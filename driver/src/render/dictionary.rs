//! The words for a fault of a dictionary: a headline and helps.
//!
//! ```text
//! means = "FLOD_ON"    no meaning: FLOD_ON    did you mean `FLOOD_ON`?
//! ```
//!
//! Not here: the place in the file ([`fault`]).

pub mod fault;

use ncc_dialects::{DialectFault, UnknownKind, UnknownWord, Unreadable, builtin_ids, near};

use super::messages::message::{Help, Message, Part};

/// The words for a fault.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Words {
    /// The problem, in one line.
    pub headline: String,
    /// Actions, one each.
    pub helps: Vec<String>,
}

/// The row of the base that a fault is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BaseRow<'t> {
    /// Its table.
    pub table: &'t str,
    /// The field that names it, as its file has it.
    pub key: &'t str,
}

/// The words for a fault, which may be in a row of the base.
pub fn words(fault: &DialectFault, base_row: Option<BaseRow<'_>>) -> Words {
    if let Some(unknown) = fault.unknown() {
        return of_unknown(fault, &unknown);
    }
    if let Some(field) = fault.missing() {
        let help = if field == "source" { "help-source" } else { "help" };
        return in_words(dictionary("missing-field").text("field", field), vec![Help::new(help)]);
    }
    let message = match fault {
        DialectFault::NotInBase { row, among } => {
            let near = near(row, among.iter().map(String::as_str));
            let message = dictionary("not-in-base").text("row", &**row);
            return in_words(message, vec![of_near(&near)]);
        }
        DialectFault::Unreadable { row, why } => {
            let (form, letter) = match why {
                Unreadable::Code => ("code", None),
                Unreadable::Number => ("number", None),
                Unreadable::Letter => ("letter", None),
                Unreadable::Taken => ("taken", None),
                Unreadable::Axis => ("axis", None),
                Unreadable::Word(letter) => ("word", Some(letter.to_string())),
                Unreadable::Name => ("name", None),
            };
            let message = dictionary(form).text("row", row);
            let message = letter.into_iter().fold(message, |message, letter| message.text("letter", letter));
            let help = match (why, base_row) {
                (Unreadable::Word(_) | Unreadable::Taken, Some(row)) => of_base(row),
                _ => Help::new("help"),
            };
            return in_words(message, vec![help]);
        }
        DialectFault::NoBase { base } => {
            let near = near(base, builtin_ids());
            let help = match near.first() {
                Some(near) => Help::new("help-one").text("near", *near),
                None => Help::new("help"),
            };
            return in_words(dictionary("no-base").text("base", base), vec![help]);
        }
        DialectFault::Row { row, wrong } => {
            let wrong = dictionary("").reason(wrong).headline();
            let help = base_row.map_or_else(|| Help::new("help"), of_base);
            return in_words(dictionary("row").text("row", row).text("wrong", wrong), vec![help]);
        }
        DialectFault::Form(text) => dictionary("form").text("fault", text),
        DialectFault::NoCycleKind { row, kind } => dictionary("form").text("fault", format!("{row}: {kind}")),
        DialectFault::BaseNoText => dictionary("base-no-text"),
        DialectFault::NoDefaultValue { name, among } => {
            dictionary("value").text("name", &**name).text("among", among.join(", "))
        }
        DialectFault::Missing { field } => dictionary("missing").text("field", *field),
        DialectFault::BadId { id } => dictionary("no-id").text("name", id),
        DialectFault::BuiltInId { id } => dictionary("built-in").text("name", id),
        DialectFault::IdTwice { id } => dictionary("name-twice").text("name", id),
        DialectFault::BaseCycle { chain } => dictionary("base-cycle").text("chain", chain.join(", on ")),
        DialectFault::OtherFamily => dictionary("other-family"),
        DialectFault::NoKey { table, key } => dictionary("no-key").text("table", table).text("key", *key),
        DialectFault::RowTwice { row } => dictionary("row-twice").text("row", row),
        DialectFault::NothingThere { row, word } => {
            dictionary("nothing-there").text("row", row).text("word", *word)
        }
    };
    in_words(message, vec![Help::new("help")])
}

fn of_unknown(fault: &DialectFault, unknown: &UnknownWord<'_>) -> Words {
    let message = match (unknown.kind, fault) {
        (UnknownKind::CycleKind, DialectFault::NoCycleKind { row, .. }) => {
            dictionary("cycle-kind").text("row", &**row)
        }
        (UnknownKind::Meaning, _) => dictionary("meaning"),
        (UnknownKind::Field, _) => dictionary("field"),
        (UnknownKind::Value | UnknownKind::CycleKind, _) => dictionary("value"),
    };
    let message = message.text("name", unknown.name).text("among", quoted(&unknown.among));
    in_words(message, vec![of_near(&unknown.near())])
}

/// The help that names the row of the base.
fn of_base(row: BaseRow<'_>) -> Help {
    Help::new("help-base").text("table", row.table).text("key", row.key)
}

/// The help that names the words nearest to an unknown one.
fn of_near(near: &[&str]) -> Help {
    match near {
        [] => Help::new("help"),
        [one] => Help::new("help-one").text("near", *one),
        several => Help::new("help-several").text("near", quoted(several)),
    }
}

fn quoted(words: &[&str]) -> String {
    words.iter().map(|word| format!("`{word}`")).collect::<Vec<_>>().join(", ")
}

fn in_words(message: Message, helps: Vec<Help>) -> Words {
    Words { headline: message.headline(), helps: message.helps(Some(helps)) }
}

/// An entry about dictionaries.
pub(crate) fn dictionary(form: &'static str) -> Message {
    Message::part(Part::Dictionary, form)
}

#[cfg(test)]
mod tests {
    use ncc_dialects::RowFault;

    use super::*;

    #[test]
    fn every_row_fault_has_words() {
        for wrong in RowFault::ALL {
            let words = words(&DialectFault::Row { row: "Q1".to_owned(), wrong: *wrong }, None);
            assert!(words.headline.len() > "row Q1: ".len() && words.headline.len() <= 90, "{words:?}");
        }
    }

    #[test]
    fn every_kind_of_fault_has_words_that_name_the_row() {
        let row = "Q1".to_owned();
        for why in [
            Unreadable::Code,
            Unreadable::Number,
            Unreadable::Letter,
            Unreadable::Taken,
            Unreadable::Axis,
            Unreadable::Word('@'),
            Unreadable::Name,
        ] {
            let words = words(&DialectFault::Unreadable { row: row.clone(), why }, None);
            assert!(words.headline.starts_with("row Q1: never read") && words.helps.len() == 1, "{words:?}");
        }
        let says = |message: &str| words(&DialectFault::Form(message.to_owned()), None);
        assert_eq!(says("no meaning: FLOD_ON").helps, ["did you mean `FLOOD_ON`?"]);
        assert_eq!(says("no meaning: FLOOD_OFF").helps, ["near it are `FLOOD_ON`, `COOLANT_OFF`"]);
        let value = says("unknown variant `zz`, expected one of `length`, `angle`");
        assert_eq!(
            (value.headline.as_str(), value.helps[0].as_str()),
            ("unknown value `zz`", "it is one of `length`, `angle`")
        );
        assert_eq!(says("missing field `source`").helps[0].get(..6), Some("add `s"));
        let in_base = DialectFault::Row { row, wrong: RowFault::NoDataRow };
        let help = words(&in_base, Some(BaseRow { table: "data", key: "name = \"G10 L2\"" })).helps;
        assert!(help[0].contains("`[[data]]`, `name = \"G10 L2\"`, `remove = true`"), "{help:?}");
    }
}
