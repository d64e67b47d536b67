//! The words of reasons: units, distance modes, planes and path modes.

use std::borrow::Cow;

use ncc_ir::lack::ModesLack as L;

pub(super) fn text(lack: &L) -> Cow<'static, str> {
    Cow::Borrowed(match lack {
        L::Units => "this unit of length",
        L::Absolute => "absolute coordinates",
        L::Incremental => "incremental coordinates",
        L::Plane => "this plane",
        L::PlaneUnknown => "a plane that is not known",
        L::MixedDistances => "absolute and incremental words in one block",
        L::DistanceUnknown => "words in a distance mode that is not known",
        L::MillimetresUnknown => "millimetres where they are not known to be in force",
        L::InchesUnknown => "inches where they are not known to be in force",
        L::CallersUnit => "lengths in a unit that the caller decides",
        L::LengthUnitUnknown => "a length in a unit that is not known",
        L::UnitsAfterLabel => "units that a subprogram says behind its first label alone",
        L::CallersModes => "what its caller has in force, where this control begins otherwise",
        L::ComputedInOtherUnit => "a computed value in another unit",
        L::InexactInInches => "a pitch, a peck, a shift or a corner that is not exact in inches",
        L::ExactStop => "an exact stop of one move",
        L::ExactStopModeUnknown => "an exact stop of one move, where the mode before it is not known",
        L::PathMode { mode } => return format!("corners by {}", mode.name()).into(),
        L::PathTolerance => "a tolerance of the path",
        L::PathToleranceValue => "a tolerance of the path without its value",
        L::MergedMovesTolerance => "a tolerance for moves that are made one",
        L::Advice { kind } => return format!("advice on {}", kind.name()).into(),
    })
}
