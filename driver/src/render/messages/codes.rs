//! What a message may say of a code by its row in the dictionary.
//!
//! ```text
//! M46 on a fanuc    open: the machine builder defines it, and the user may state what it does
//! ```

use ncc_dialects::{CodeRow, Dialect, Family, Meaning, NameMeaning};
use ncc_ir::canon::Units;

/// Whether a code is an M code that the user may say something of: the dialect does not have it, or refuses it.
pub(super) fn is_open(code: &str, dialect: &Dialect) -> bool {
    let number = code.strip_prefix('M').and_then(|number| number.parse::<u32>().ok());
    number.is_some_and(|number| may_be_stated(dialect.code_row(b'M', number.saturating_mul(10))))
}

/// Whether what a code does may be stated by the user: the dialect does not have it, or refuses it, and it does not name
/// blocks to go on at.
pub fn may_be_stated(row: Option<&CodeRow>) -> bool {
    row.is_none_or(|row| row.means.is_none() && row.blocks.is_empty())
}

/// Whether a code returns to a reference point, by way of a point that its axis words name: `G28`, `G30`.
pub(super) fn is_return(code: &str, from: &Dialect) -> bool {
    let means = from.code.iter().find(|row| row.code == code).and_then(|row| row.means);
    matches!(means, Some(Meaning::GoToReference { .. })) && from.family == Family::Word
}

/// The code by which programs of this dialect say something, as a help shows it: `G21`, `MCALL`, or the function of the
/// text forms.
pub(super) fn code_for(meaning: Meaning, from: &Dialect) -> String {
    if let Some(row) = from.code_for(meaning) {
        return row.code.to_string();
    }
    let modal = from.name.iter().find(|row| row.means == Some(NameMeaning::CallModal));
    match (meaning, modal) {
        // A modal call without a name ends it.
        (Meaning::EndCycle, Some(row)) => row.name.clone(),
        _ => meaning.to_string(),
    }
}

/// Codes of the source's control that the helps of reasons show, by the names of their values.
pub(super) fn typed(from: &Dialect) -> [(&'static str, String); 3] {
    [
        ("mm", code_for(Meaning::UseLengthUnits(Units::Mm), from)),
        ("inch", code_for(Meaning::UseLengthUnits(Units::Inch), from)),
        ("cancel_cycle", code_for(Meaning::EndCycle, from)),
    ]
}
