//! Lengths and angles in messages.

use ncc_ir::expr::num::ONE;
use ncc_ir::program::numbered::Numbered;

/// Nanos in millimetres, to four digits after the point.
pub fn millimetres(nanos: i64) -> String {
    signed(nanos.abs())
}

/// A length or an angle with its sign, as [`millimetres`].
pub fn signed(nanos: i64) -> String {
    let text = format!("{:.4}", nanos as f64 / ONE as f64);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A count, by thousands.
pub fn thousands(count: u64) -> String {
    let digits = count.to_string();
    let parts = digits.as_bytes().rchunks(3).rev().map(|part| std::str::from_utf8(part).unwrap_or(""));
    parts.collect::<Vec<&str>>().join(",")
}

/// What has a number, as one or as several.
pub fn numbered(what: Numbered, count: u64) -> String {
    match what {
        Numbered::Tool => plural(count, "tool"),
        Numbered::LengthEntry if count == 1 => "length entry".to_owned(),
        Numbered::LengthEntry => "length entries".to_owned(),
        Numbered::WorkOffset => plural(count, "work offset"),
        Numbered::Program => plural(count, "program"),
    }
}

/// A noun with its plural's s.
pub fn plural(count: u64, noun: &str) -> String {
    if count == 1 { noun.to_owned() } else { format!("{noun}s") }
}
