//! Rows that no reader ever reaches: refused where a dictionary is loaded.
//!
//! ```text
//! code = "Q52"         Q52 is no G or M code
//! letter = "N"         N begins a block number
//! words = "@"          no word has the letter @
//! ```
//!
//! Not here: whether a row reads back as its meaning, which `ncc dialects test` shows.

use ncc_ir::canon::Axis;

use crate::codes::{CodeRow, tenths};
use crate::cycles::{CycleRow, PatternRow};
use crate::fault::Unreadable;
use crate::schema::{Dialect, Family};
use crate::words::{Address, Role};

/// Whether a reader reaches a code and its words.
pub(crate) fn code(dialect: &Dialect, row: &CodeRow) -> Result<(), Unreadable> {
    let letter = row.code.bytes().next();
    if !matches!(letter, Some(b'G' | b'M')) {
        return Err(Unreadable::Code);
    }
    if tenths(&row.code).is_none() {
        return Err(Unreadable::Number);
    }
    letters(dialect, row.words.chars().chain(row.dwell.iter().map(|word| word.letter)))
}

/// Whether a reader reaches the words of a cycle.
pub(crate) fn cycle(dialect: &Dialect, row: &CycleRow) -> Result<(), Unreadable> {
    let dwell = row.dwell.map(|word| word.letter);
    let shrinking = row.shrinking.into_iter().flatten();
    letters(
        dialect,
        [row.depth, row.retract].into_iter().chain(row.peck).chain(row.shift).chain(dwell).chain(shrinking),
    )
}

/// Whether a reader reaches the words of a pattern.
pub(crate) fn pattern(dialect: &Dialect, row: &PatternRow) -> Result<(), Unreadable> {
    match row {
        PatternRow::Circle { first, centre, step, count, .. } => {
            letters(dialect, first.iter().chain(centre).copied().chain([*step, *count]))
        }
        PatternRow::Grid { pitch, counts, .. } => letters(dialect, pitch.iter().chain(counts).copied()),
    }
}

/// Whether a reader reaches a letter.
pub(crate) fn address(dialect: &Dialect, row: &Address) -> Result<(), Unreadable> {
    let letter = row.letter;
    if !letter.is_ascii_uppercase() {
        return Err(Unreadable::Letter);
    }
    if matches!(letter, 'G' | 'M') || dialect.block.number == Some(letter) {
        return Err(Unreadable::Taken);
    }
    if row.role == Role::Axis && Axis::from_letter(letter as u8).is_none() {
        return Err(Unreadable::Axis);
    }
    Ok(())
}

/// Whether a reader reaches words of several letters.
pub(crate) fn name(dialect: &Dialect) -> Result<(), Unreadable> {
    match dialect.family {
        Family::Word => Err(Unreadable::Name),
        _ => Ok(()),
    }
}

/// Words have letters of the dictionary.
fn letters(dialect: &Dialect, mut words: impl Iterator<Item = char>) -> Result<(), Unreadable> {
    let has = |letter: char| dialect.address.iter().any(|row| row.letter == letter);
    match words.find(|letter| dialect.family == Family::Word && !has(*letter)) {
        Some(letter) => Err(Unreadable::Word(letter)),
        None => Ok(()),
    }
}
