//! What a message may say of a code by its row in the dictionary.
//!
//! ```text
//! M46 on a fanuc    open: the machine builder defines it, and the user may state what it does
//! ```

use ncc_dialects::{CodeRow, Dialect, Family, Meaning};

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
