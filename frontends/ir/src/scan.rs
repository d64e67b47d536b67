//! Words of the text form that are more than themselves: numbers, texts, variables.

use ncc_ir::expr::Var;
use ncc_ir::expr::num::Unit;
use ncc_ir::expr::system::System;
use ncc_ir::program::Text;

use crate::quoted::unquote;
use crate::word::{LexFault, Literal};

/// A number with its unit.
pub(super) fn number(text: &str) -> Result<Literal, LexFault> {
    let digits_end = text.find(|c: char| c.is_ascii_lowercase()).unwrap_or(text.len());
    let unit = match &text[digits_end..] {
        "mm" => Unit::Mm,
        "in" => Unit::Inch,
        "deg" => Unit::Degree,
        "s" => Unit::Second,
        "u" => Unit::Entry,
        _ => Unit::One,
    };
    let (mut magnitude, mut scale, mut point) = (0u64, 0u8, false);
    for byte in text[..digits_end].bytes() {
        if byte == b'.' {
            point = true;
            continue;
        }
        let shifted = magnitude.checked_mul(10).and_then(|m| m.checked_add(u64::from(byte - b'0')));
        magnitude = shifted.ok_or(LexFault::Number)?;
        scale += u8::from(point);
        if scale > 18 {
            return Err(LexFault::Number);
        }
    }
    if magnitude > i64::MIN.unsigned_abs() {
        return Err(LexFault::Number);
    }
    Ok(Literal { magnitude, scale, point, unit })
}

/// A text.
pub(super) fn quoted(text: &str) -> Result<Text, LexFault> {
    unquote(text).ok_or(LexFault::Escape)
}

/// The number of a block.
pub(super) fn block_number(text: &str) -> Result<u32, LexFault> {
    text[1..].parse().map_err(|_| LexFault::Number)
}

/// A variable by its kind and name.
pub(super) fn variable(text: &str) -> Result<Var, LexFault> {
    let (kind, name) = text.split_once(':').unwrap_or_default();
    let name = match name.starts_with('"') {
        true => unquote(name).ok_or(LexFault::Escape)?,
        false => Box::from(name),
    };
    Ok(match kind {
        "local" => Var::Local(name),
        "common" => Var::Common(name),
        "retentive" => Var::Retentive(name),
        _ => Var::System(System::named(&name)),
    })
}
