//! A dictionary of one's own to begin with: a commented file that builds on another dialect.
//!
//! ```text
//! scaffold("shop", fanuc)    id = "shop", base = "fanuc", a row of each kind as a comment, the options of fanuc
//! ```
//!
//! The rows are in `messages/dialect.toml`, the options are those of the base.

use std::fmt::Write;

use ncc_dialects::Dialect;
use ncc_ir::behaviour::Behaviour;

/// The file, for a dialect called `id`. It is a dialect as it stands.
pub fn scaffold(id: &str, base: &Dialect) -> String {
    let mut text =
        include_str!("../../messages/dialect.toml").replace("{id}", id).replace("{base}", &base.id);
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
