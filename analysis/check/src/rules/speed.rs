//! NC0803: spindle speeds above the machine's highest.

use ncc_ir::expr::num::Nanos;
use ncc_ir::source::Span;

use crate::finding::What;
use crate::limits::Unchecked;
use crate::watched::Watched;

/// A speed is stated.
pub(crate) fn said(checker: &mut Watched, speed: Nanos, at: Span) {
    match checker.limits.max_speed {
        Some(limit) if speed > limit => {
            checker.find(What::SpeedRange { speed, limit }, at);
        }
        Some(_) => {}
        None if checker.limits.machine => {
            checker.unchecked.insert(Unchecked::MaxSpeed);
        }
        None => {}
    }
}
