//! What is wrong with a profile, in words.

use ncc_machines::Wrong;

/// The words beside a place.
pub struct Words {
    /// Why this place.
    pub label: String,
    /// What to do.
    pub help: Option<String>,
}

/// What is wrong, in a line.
pub fn message(wrong: &Wrong) -> String {
    match wrong {
        Wrong::Form { message } => {
            let first = message.lines().next().unwrap_or("it is no profile");
            first
                .replace("expected f64", "expected a number")
                .replace("expected u32", "expected a whole number")
        }
        Wrong::UnknownDialect { name } => format!("there is no dialect `{name}`"),
        Wrong::UnknownOption { option, .. } => format!("the dialect has no option `{option}`"),
        Wrong::OptionValue { option, value, .. } => format!("`{value}` is no value of {option}"),
        Wrong::UnknownRow { row } => format!("the dialect has no row `{row}`"),
        Wrong::Twice { what } => format!("{what} twice"),
        Wrong::UpsideDown => "travel upside down".to_owned(),
        Wrong::Takes { key, .. } => format!("this is no value of {key}"),
        Wrong::Missing { key, .. } => format!("{key} is missing"),
        Wrong::CodeKnown { code, .. } => format!("{code} is in the dialect's dictionary already"),
        Wrong::NotOneToOne { function } => format!("two codes for {function}"),
        Wrong::TooFine { key, .. } => format!("{key}: finer than the control"),
        Wrong::NoForm { key, lacks } => format!("{key}: the dialect has no {lacks}"),
        Wrong::NoMachine { name, .. } => format!("there is no machine `{name}`"),
        Wrong::Pattern { .. } => "no file can match this pattern".to_owned(),
        Wrong::TwoRows { program } => format!("two rows of [[programs]] match {program}"),
        Wrong::NoFile { pattern } => format!("no file matches `{pattern}`"),
        Wrong::NoRows => "no [[programs]] in the project file".to_owned(),
        Wrong::NoFolder { name } => format!("there is no folder `{name}`"),
    }
}

/// The words at its place.
pub fn words(wrong: &Wrong, schemas: &str) -> Words {
    let list = |words: &[String]| words.join(", ");
    let (label, help): (String, Option<String>) = match wrong {
        Wrong::Form { .. } => ("here".into(), Some(schemas.to_owned())),
        Wrong::UnknownDialect { .. } => {
            ("not one of the dictionaries".into(), Some("`ncc dialects` lists them".into()))
        }
        Wrong::UnknownOption { has, .. } if has.is_empty() => ("it has no options at all".into(), None),
        Wrong::UnknownOption { has, .. } => ("no such option".into(), Some(format!("it has: {}", list(has)))),
        Wrong::OptionValue { takes, .. } if takes.is_empty() => ("it takes a number from 0".into(), None),
        Wrong::OptionValue { takes, .. } => (format!("it takes: {}", list(takes)), None),
        Wrong::UnknownRow { .. } => (
            "nothing to confirm".into(),
            Some(
                "`ncc dialects show` lists the rows; `ncc doctor` writes the keys that a program needs"
                    .into(),
            ),
        ),
        Wrong::Twice { .. } => ("again".into(), Some("keep one of the two".into())),
        Wrong::UpsideDown => ("the lower end comes first".into(), None),
        Wrong::Takes { takes, .. } => (format!("it takes {takes}"), None),
        Wrong::Missing { why, .. } => ((*why).into(), None),
        Wrong::CodeKnown { means, .. } => (
            format!("there it is {means}"),
            Some("leave it out: what a dictionary says holds for every machine of the dialect".into()),
        ),
        Wrong::NotOneToOne { .. } => (
            "the second one".into(),
            Some("which of them would be written? keep one, or give them two names".into()),
        ),
        Wrong::TooFine { most, .. } => (format!("it has {most} digits after the point"), None),
        Wrong::NoForm { .. } => ("cannot be written so".into(), None),
        Wrong::NoMachine { name, is_dialect: true, .. } => {
            (format!("{name} is a dialect"), Some(format!("write `{{ dialect = {name:?} }}`")))
        }
        Wrong::NoMachine { has, .. } => (
            "neither a shipped machine nor a file".into(),
            Some(format!("name the file of a profile, or one of {}", list(has))),
        ),
        Wrong::Pattern { message } => (
            message.clone(),
            Some("write a path from the folder of this file, such as `*.nc` or `old/**/*.nc`".into()),
        ),
        Wrong::TwoRows { .. } => {
            ("which machine is it for?".into(), Some("let one of the patterns match fewer files".into()))
        }
        Wrong::NoFile { .. } => (
            "below the folder of this file".into(),
            Some(
                "patterns begin in the folder of this file; `*` stays in one folder, `**/` goes down".into(),
            ),
        ),
        Wrong::NoRows => {
            ("the file has no rows".into(), Some("`ncc init PROGRAM --to DIALECT` writes one".into()))
        }
        Wrong::NoFolder { .. } => {
            ("seen from the folder of this file".into(), Some("make it, or correct its name".into()))
        }
    };
    Words { label, help }
}
