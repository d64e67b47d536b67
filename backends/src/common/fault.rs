//! Faults of what a target cannot say.

use ncc_ir::diag::Fault;
use ncc_ir::expr::num::Num;
use ncc_ir::lack::{Lack, WordsLack};
use ncc_ir::run_time::RunTime;

use super::number::{self, Unwritable};

/// A fault for what there is no word for.
pub(crate) fn cannot(lack: impl Into<Lack>) -> Fault {
    Fault::lacks(lack)
}

/// The fault of what the control cannot compute.
pub(crate) fn cannot_compute(what: impl Into<RunTime>) -> Fault {
    Fault::computes(what)
}

/// The fault of a number that cannot be written.
pub(crate) fn unwritable(why: Unwritable, letter: u8, n: Num) -> Fault {
    let word = number::spell(letter, n);
    match why {
        Unwritable::Range => Fault::TargetRange { word },
        Unwritable::NotWhole => cannot(WordsLack::NotWhole { word }),
        Unwritable::Fineness => cannot(WordsLack::TooFine { word }),
    }
}
