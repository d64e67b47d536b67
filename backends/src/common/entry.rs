//! Numbers of places in the control's tables.

use ncc_ir::computed::computed_entry::Place;
use ncc_ir::expr::{Binary, Expr};

/// The control's own number of a place.
pub(crate) fn number_of(place: &Place, number: &Expr) -> Expr {
    // Counted from the first one, where the numbers begin far from zero: `#[5221 + [#1 - 54] * 20]`.
    if place.step != 1 && !(0..10).contains(&place.from) {
        let (base, first) = (place.base + place.step * place.from, place.from);
        let from_first = match first < 0 {
            true => Expr::binary(Binary::Add, number.clone(), Expr::int(-first)),
            false => Expr::binary(Binary::Subtract, number.clone(), Expr::int(first)),
        };
        return number_of(&Place { base, from: 0, ..place.clone() }, &from_first);
    }
    let times = match place.step {
        1 => number.clone(),
        step => Expr::binary(Binary::Multiply, number.clone(), Expr::int(step)),
    };
    match place.base {
        0 => times,
        base if base < 0 => Expr::binary(Binary::Subtract, times, Expr::int(-base)),
        base => Expr::binary(Binary::Add, Expr::int(base), times),
    }
}
