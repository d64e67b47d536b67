//! Whether the rows of `[functions]` can be used: each is a code of its own, and has a program.
//!
//! Not here: whether the program is there, which is seen where it is started.

use crate::codes::{CodeIndex, tenths};
use crate::fault::{DialectFault, RowFault, Unreadable};
use crate::functions::{BLOCKS, TIME_LIMITS};
use crate::schema::{Dialect, Family};

/// Checks all rows of `[functions]`.
///
/// # Errors
/// The name of a row, and what is wrong with it.
pub(super) fn check<'d>(dialect: &'d Dialect, index: &CodeIndex) -> Result<(), (&'d str, DialectFault)> {
    for (name, row) in &dialect.functions {
        let wrong = |code: &str, wrong| (name.as_str(), DialectFault::Row { row: code.to_owned(), wrong });
        let unreadable =
            |code: &str, why| (name.as_str(), DialectFault::Unreadable { row: code.to_owned(), why });
        if dialect.family != Family::Word {
            return Err(wrong(name, RowFault::FunctionOfWords));
        }
        for code in std::iter::once(name).chain(&row.until) {
            let Some((letter, number)) = tenths(code) else { return Err(unreadable(code, Unreadable::Code)) };
            let table = match letter {
                b'G' => &index.g,
                b'M' => &index.m,
                _ => return Err(unreadable(code, Unreadable::Code)),
            };
            if table.get(number).copied().flatten().is_some() {
                return Err(wrong(code, RowFault::FunctionOfCode));
            }
            let same = |other: &str| tenths(other) == Some((letter, number));
            let uses =
                dialect.functions.iter().flat_map(|(name, row)| std::iter::once(name).chain(&row.until));
            if uses.filter(|other| same(other)).count() > 1 {
                return Err(wrong(code, RowFault::Twice));
            }
        }
        if row.command.first().is_none_or(String::is_empty)
            || row.command.iter().any(|word| word.contains('\0'))
        {
            return Err(wrong(name, RowFault::NoCommand));
        }
        if !TIME_LIMITS.contains(&row.time_limit) || !BLOCKS.contains(&row.most_blocks) {
            return Err(wrong(name, RowFault::FunctionLimits));
        }
    }
    Ok(())
}
