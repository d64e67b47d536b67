//! The words of reasons: polar coordinates.

use ncc_ir::lack::PolarLack as L;

pub(super) fn text(lack: &L) -> &'static str {
    match lack {
        L::Point => "a point by radius and angle",
        L::PointSkipped => "a point by radius and angle in a block that can be skipped",
        L::PointPlaneUnknown => "a point by radius and angle in a plane that is not known",
        L::PointsEnd => "the end of points by radius and angle",
        L::FunctionToPoint => "this function to a polar point",
        L::Pole => "a pole",
        L::PolePlaneUnknown => "a pole in a plane that is not known",
        L::HoleOutsidePlane => "a hole position outside the plane",
        L::Move => "this move",
        L::AngleIncrement => "an increment of a line's angle",
        L::RadiusIncrement => "an increment of a polar radius",
        L::Word => "a polar word",
    }
}
