//! Spindle and coolant, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Spindle and coolant that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum SpindleLack {
        /// A spindle speed.
        Speed,
        /// A clockwise spindle.
        Clockwise,
        /// A counter-clockwise spindle.
        Counterclockwise,
        /// A spindle stop.
        Stop,
        /// Flood coolant.
        Flood,
        /// Mist coolant.
        Mist,
        /// Coolant off.
        CoolantOff,
        /// A limit of the spindle speed.
        SpeedLimit,
        /// A limit of the spindle after the surface speed that it is for.
        LimitAfterSurfaceSpeed,
        /// A limit of the spindle under a speed in rev/min.
        LimitUnderTurns,
        /// A limit that is not known to be active.
        LimitUnknown,
        /// A constant surface speed.
        SurfaceSpeed,
        /// The end of a constant surface speed, with this feed.
        SurfaceSpeedEnd,
        /// A constant surface speed without its speed in the block.
        SurfaceWithoutSpeed,
        /// A surface speed in other units.
        SurfaceOtherUnits,
        /// An oriented spindle stop.
        OrientedStop,
        /// An oriented spindle stop while a cycle is active.
        OrientedStopInCycle,
        /// A stop of the spindle at the control's own angle.
        OwnAngle,
        /// An optional stop that may stop a turning spindle.
        OptionalStopTurning,
    }
}
