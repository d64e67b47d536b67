//! The words of reasons: spindle and coolant.

use ncc_ir::lack::SpindleLack as L;

pub(super) fn text(lack: &L) -> &'static str {
    match lack {
        L::Speed => "a spindle speed",
        L::Clockwise => "a clockwise spindle",
        L::Counterclockwise => "a counter-clockwise spindle",
        L::Stop => "a spindle stop",
        L::Flood => "flood coolant",
        L::Mist => "mist coolant",
        L::CoolantOff => "coolant off",
        L::SpeedLimit => "a limit of the spindle speed",
        L::LimitAfterSurfaceSpeed => "a limit of the spindle behind the surface speed that it is for",
        L::LimitUnderTurns => "a limit of the spindle under a speed in turns",
        L::LimitUnknown => "a limit that is not known to be in force",
        L::SurfaceSpeed => "a constant surface speed",
        L::SurfaceSpeedEnd => "the end of a constant surface speed, with this feed",
        L::SurfaceWithoutSpeed => "a constant surface speed without its speed in the block",
        L::SurfaceOtherUnits => "a surface speed in other units",
        L::OrientedStop => "a spindle stopped at an angle",
        L::OrientedStopInCycle => "a spindle stopped at an angle while a cycle is in force",
        L::OwnAngle => "a stop of the spindle at the control's own angle",
        L::OptionalStopTurning => "an optional stop that may stop a turning spindle",
    }
}
