//! The schema in words, from the types.

use crate::schema::{
    AxisRow, EdgeRow, Emit, MCodeRow, PowerOn, ProgramRow, Rates, Spindle, Times, ToolRow, ValueRow,
    WorkOffsetRow,
};
use crate::table::Table;

/// The tables with fixed keys, as `docs/book/src/reference/machine-profile.md` has them.
pub fn tables() -> String {
    let parts = [
        table::<PowerOn>(),
        table::<Rates>(),
        table::<Times>(),
        table::<Spindle>(),
        table::<AxisRow>(),
        table::<ToolRow>(),
        table::<EdgeRow>(),
        table::<WorkOffsetRow>(),
        table::<ProgramRow>(),
        table::<MCodeRow>(),
        table::<ValueRow>(),
        table::<Emit>(),
    ];
    parts.join("\n")
}

fn table<T: Table>() -> String {
    let mut text =
        format!("### `{}`\n\n{}\n\n| key | takes | what it is |\n|---|---|---|\n", T::HEAD, T::ABOUT.trim());
    for key in T::KEYS {
        text.push_str(&format!("| `{}` | {} | {} |\n", key.name, key.takes, key.doc.trim()));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_document_has_every_key_of_the_types() {
        let document = include_str!("../../docs/book/src/reference/machine-profile.md");
        let tables = tables();
        assert!(
            document.contains(&tables),
            "docs/book/src/reference/machine-profile.md differs from:\n{tables}"
        );
        use crate::reading::{BARE_NUMBERS, EDGE_IS_ENTRY, MOTION_AT_CYCLES, OFFSET_WITH_Z};
        for key in [BARE_NUMBERS, EDGE_IS_ENTRY, MOTION_AT_CYCLES, OFFSET_WITH_Z] {
            assert!(document.contains(&format!("| `{key}` |")), "{key}");
        }
        for key in ["id", "title", "dialect", "typical", "notes"] {
            assert!(document.contains(&format!("| `{key}` |")), "{key}");
        }
    }
}
