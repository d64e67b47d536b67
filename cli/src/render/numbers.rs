//! Lengths and angles in messages.

use ncc_ir::canon::Axis;
use ncc_ir::num::ONE;

/// Nanos in millimetres, to four digits after the point.
pub(super) fn millimetres(nanos: i64) -> String {
    signed(nanos.abs())
}

/// The headline of a rotary turn that controls do not make alike, by so many nanos of a degree.
pub(super) fn rotary_turn(axis: Axis, by: i64, or: i64) -> String {
    let axis = char::from(axis.letter());
    format!("{axis} turns by {} degrees here, or by {}?", signed(by), signed(or))
}

/// A length or an angle with its sign, as [`millimetres`].
pub(super) fn signed(nanos: i64) -> String {
    let text = format!("{:.4}", nanos as f64 / ONE as f64);
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}
