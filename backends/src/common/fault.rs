//! Faults of what a target cannot say.

use ncc_ir::diag::Fault;
use ncc_ir::expr::num::Num;

use super::number::{self, Unwritable};

/// Moves that are packed, which the writer of all dialects unpacks for those of each.
pub(crate) const PACKED: &str = "moves that are packed";

/// A fault for what there is no word for.
pub(crate) fn cannot(what: impl Into<Box<str>>) -> Fault {
    Fault::TargetLacks { what: what.into() }
}

/// The fault of what the control cannot compute.
pub(crate) fn cannot_compute(what: impl Into<Box<str>>) -> Fault {
    Fault::Computes { what: what.into() }
}

/// The fault of a number that cannot be written.
pub(crate) fn unwritable(why: Unwritable, letter: u8, n: Num) -> Fault {
    let word = number::spell(letter, n);
    match why {
        Unwritable::Range => Fault::TargetRange { word },
        Unwritable::NotWhole => cannot(format!("{word}, which is not a whole number")),
        Unwritable::Fineness => cannot(format!("{word}, which is too fine in a unit that is not known")),
    }
}
