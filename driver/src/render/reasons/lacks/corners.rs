//! The words of reasons: rounded and chamfered corners.

use ncc_ir::lack::CornersLack as L;

pub(super) fn text(lack: &L) -> &'static str {
    match lack {
        L::Corner => "a rounded or chamfered corner",
        L::BesideSkippedBlock => "a corner beside blocks that can be skipped",
        L::PlacesAtRunTime => "a corner between moves whose places are known only when the program runs",
    }
}
