//! Tests of the Sinumerik's grammar: a line in, a short rendering of its tree or its fault out.
//!
//! Parts of a block are set apart by `|`; an expression is in full parentheses.

mod expressions;
mod faults;
mod laws;
mod lowering;
mod pitfalls;
mod show;
mod statements;

use super::text::parse::parse;
use super::text::unit;

/// What a line says, or its fault with the very text that it points at.
fn read(line: impl AsRef<[u8]>) -> String {
    let line = line.as_ref();
    // Not zero, so that a place that forgets the base is seen.
    let base = 1000;
    match parse(line, base) {
        Ok(block) => show::Show { line, base }.block(&block),
        Err((fault, span)) => {
            let at = String::from_utf8_lossy(&line[(span.start - base) as usize..(span.end - base) as usize]);
            format!("{fault:?} at {at:?}").replace('"', "'")
        }
    }
}

/// Lines and what they say, in turn.
fn check(table: &[(&str, &str)]) {
    let wrong: Vec<String> = table
        .iter()
        .filter(|(line, said)| read(line) != *said)
        .map(|(line, said)| format!("\n{line}\n  want {said}\n  got  {}", read(line)))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.concat());
}
