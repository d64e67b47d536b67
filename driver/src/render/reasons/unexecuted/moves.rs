//! The words of reasons: moves, machine coordinates and the spindle.

use ncc_ir::unexecuted::MoveUnexecuted as R;

pub(super) fn text(reason: &R) -> &'static str {
    match reason {
        R::DetourNotRapid => "a detour of anything but a rapid move in the program's coordinates",
        R::IncrementalReturn => "incremental words of a return by the intermediate point",
        R::IntermediatePointUnset => "a return by an intermediate point that nothing has said",
        R::OtherCoordinatesPoint => "a return by a point that other coordinates have said",
        R::RapidProbing => "probing by rapid",
        R::ProbingNowhere => "probing that goes nowhere",
        R::IncrementInMachine => "an incremental word in machine coordinates",
        R::PolarInMachine => "polar words in machine coordinates",
        R::PolarFunction => "polar words of this function",
        R::CircleInSpace => "a circle in space",
        R::ArcTakesLength => "an arc along Z on which a length is taken up",
        R::ArcInFrameChange => "a point of an arc that includes a change of frame",
        R::ArcProbing => "an arc as a probing move, or by a detour",
        R::ArcNotInPlane => "an arc in a frame that does not leave it an arc of its plane",
        R::RotaryDirectionOfArc => "a way round of a rotary axis in anything but a line",
        R::RotaryDirectionUnmoved => "a way round of an axis that does not move",
        R::RotaryDirectionIncrement => "a way round to an angle from where the axis stands",
        R::RotaryHalfTurn => "the shortest way of half a turn",
        R::ThreadInMachine => "a thread in machine coordinates, as a probing move or by a detour",
        R::ThreadSpindleStopped => "a thread with a spindle that stands",
        R::ThreadTakesLength => "a thread on which a length is taken up",
        R::ThreadSurfaceSpeed => "a thread at a constant surface speed",
        R::OrientedStopSurface => "a stop at an angle under a constant surface speed",
        R::SpeedAboveLimit => "a speed in turns above the limit of the spindle",
        R::NoSpeedOfMode => "a spindle that turns without a speed of its mode",
        R::SurfaceInFrame => "a constant surface speed in a frame of the program",
        R::SurfaceOnContour => "a constant surface speed beside a contour that is worked out",
    }
}
