//! Pieces of messages that are spelled from values: characters, what was found, radii, the path of a return.

use ncc_ir::behaviour::{Behaviour, Kept};

use super::numbers::millimetres;
use super::words::{plain, plain_upto, quoted};

/// What was found, in quotes if it is text of the source.
pub fn found_words(found: &str) -> String {
    match found {
        "end of line" | "end of text" => format!("the {found}"),
        "a line" | "too many words" => found.to_owned(),
        _ if found.starts_with('`') => plain(found),
        _ => quoted(found),
    }
}

pub(crate) fn character(c: char) -> String {
    if c.is_control() || c as u32 > 0x7e {
        format!("`{}` (U+{:04X})", super::source::visible(c), c as u32)
    } else {
        format!("`{c}`")
    }
}

/// Both radii of an arc.
pub fn radii_of([start, end]: [i64; 2]) -> String {
    format!("radius {} mm at the start, {} mm at the end", millimetres(start), millimetres(end))
}

/// The path of a return to a reference point: by its words, which are places of the part, or counted from where the
/// axes stand; `zero`: all of them are nothing.
pub fn return_path(words: &str, zero: bool, absolute: bool) -> String {
    let words = plain_upto(words, 24);
    match (absolute, zero) {
        (true, _) => format!("by way of {words} of the part"),
        (false, true) => "from where it stands".to_owned(),
        (false, false) => format!("by {words} from where it stands"),
    }
}

/// What begins otherwise in the next run, where an open fact of the program's end decides it.
pub fn next_run(behaviour: Behaviour) -> &'static str {
    match behaviour {
        Behaviour::VariablesAtEnd | Behaviour::VariablesWhenOff => "the next run reads other values",
        _ => "the next run begins in another place",
    }
}

/// How long a variable is kept.
pub fn kept(kept: Kept) -> &'static str {
    match kept {
        Kept::UntilEnd => "until the program ends",
        Kept::UntilOff => "until it is switched off",
        Kept::Always => "for ever",
    }
}

/// Variables by their names.
pub fn variables(names: &[Box<str>]) -> String {
    format!("{} {}", super::words::plural(names.len() as u64, "variable"), names.join(", "))
}
