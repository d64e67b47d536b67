//! A dictionary of one's own to begin with: a commented file that builds on another dialect.
//!
//! ```text
//! scaffold("shop", fanuc)    id = "shop", base = "fanuc", a row of each kind as a comment, the options of fanuc
//! ```
//!
//! The rows are in `messages/dialect.toml`, the options are those of the base.

use std::fmt::Write;

use ncc_dialects::{Dialect, Meaning};
use ncc_ir::behaviour::Behaviour;

/// M codes of machine builders; the rows of the text have those that the base does not have.
const FREE: [&str; 12] =
    ["M51", "M52", "M24", "M61", "M62", "M71", "M110", "M111", "M112", "M220", "M221", "M222"];

/// The file, for a dialect called `id`. It is a dialect as it stands.
pub fn scaffold(id: &str, base: &Dialect) -> String {
    let mut text =
        include_str!("../../messages/dialect.toml").replace("{id}", id).replace("{base}", &base.id);
    // Each row of the text is one that this base can have.
    let mut free = FREE.iter().filter(|code| base.code.iter().all(|row| row.code != **code));
    for place in ["{flood}", "{off}", "{refused}"] {
        text = text.replace(place, free.next().unwrap_or(&"M999"));
    }
    let stop = base.code_for(Meaning::MistOn).or(base.code_for(Meaning::OptionalProgramStop));
    text = text.replace("{without}", stop.map_or("M01", |row| &row.code));
    text = text.replace("{other}", if base.id == "siemens" { "fanuc" } else { "siemens" });
    // What codes do besides their name has rows of its own.
    let behaves = |name: &str| Behaviour::ALL.iter().any(|behaviour| behaviour.option() == name);
    for row in base.option.iter().filter(|row| !behaves(&row.name)) {
        let values = match row.values.is_empty() {
            true => "a number".to_owned(),
            false => row.values.join(", "),
        };
        let _ = write!(
            text,
            "\n#   {} Values: {values}.\n# [[option]]\n# name = \"{}\"\n# default = \"{}\"\n",
            row.doc.replace('\n', "\n#   "),
            row.name,
            row.default
        );
    }
    text
}
