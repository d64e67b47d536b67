//! The words of reasons: arcs.

use ncc_ir::lack::ArcsLack as L;

pub(super) fn text(lack: &L) -> &'static str {
    match lack {
        L::Arc => "an arc",
        L::Helix => "a helix",
        L::CircleInSpace => "a circle in space",
        L::Radius => "an arc of this radius",
        L::ComputedRadiusShort => "a computed radius below half the distance from start to end",
        L::ComputedValue => "an arc with a computed value",
        L::TangentAfterUnknown => "a tangent arc after a move that is not known",
        L::TurnsWithRotaryAxis => "an arc of several turns with a rotary axis",
        L::TurnsWithLength => "a helix of several turns that takes a length up",
        L::SeveralTurns => "an arc of more than one turn",
        L::ThirdAxis => "an arc with a third axis",
        L::CircleModeUnknown => "a full circle where the distance mode is not known",
        L::CircleUnitUnknown => "a full circle in a unit that is not known",
        L::PlaneUnknown => "an arc in a plane that is not known",
        L::CentreUnitUnknown => "an arc's centre in a unit that is not known",
        L::CentreTooFar => "a centre this far away",
        L::Centre => "an arc's centre",
        L::CentreWordMissing => "a centre of which one word is missing",
        L::CentreModeUnknown => "a centre in a distance mode that is not known",
        L::Form => "an arc in this form",
        L::NoPlane => "an arc without a plane",
        L::CentreUnknown => "this centre",
        L::RadiusUnknown => "this radius",
        L::ShortAfterRounding => "an arc so short that its start and end round to one point",
        L::PolarRunTime => "a point by radius and angle whose place is known only when the program runs",
    }
}
