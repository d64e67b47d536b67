//! Moves, machine coordinates and the spindle that ncc does not execute.

use crate::reason::reasons;

reasons! {
    /// Moves, machine coordinates and the spindle that ncc does not execute.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum MoveUnexecuted {
        /// A detour of anything but a rapid move in the program's coordinates.
        DetourNotRapid,
        /// Incremental words of a return by the intermediate point.
        IncrementalReturn,
        /// A return by an intermediate point that is not set.
        IntermediatePointUnset,
        /// A return by an intermediate point that was set in other coordinates.
        OtherCoordinatesPoint,
        /// Probing by rapid.
        RapidProbing,
        /// Probing without motion.
        ProbingNowhere,
        /// An incremental word in machine coordinates.
        IncrementInMachine,
        /// Polar words in machine coordinates.
        PolarInMachine,
        /// Polar words of this function.
        PolarFunction,
        /// A circle in space.
        CircleInSpace,
        /// An arc along Z on which a length is activated.
        ArcTakesLength,
        /// A point of an arc that includes a change of frame.
        ArcInFrameChange,
        /// An arc as a probing move, or by a detour.
        ArcProbing,
        /// An arc in a frame that does not leave it an arc of its plane.
        ArcNotInPlane,
        /// A direction of a rotary axis in a move that is no line.
        RotaryDirectionOfArc,
        /// A direction of a rotary axis that does not move.
        RotaryDirectionUnmoved,
        /// A direction of a rotary axis with an incremental angle.
        RotaryDirectionIncrement,
        /// The shortest path of half a turn.
        RotaryHalfTurn,
        /// A thread in machine coordinates, as a probing move or by a detour.
        ThreadInMachine,
        /// A thread with a spindle that is stopped.
        ThreadSpindleStopped,
        /// A thread on which a length is activated.
        ThreadTakesLength,
        /// A thread at a constant surface speed.
        ThreadSurfaceSpeed,
        /// A stop at an angle under a constant surface speed.
        OrientedStopSurface,
        /// A speed in turns above the limit of the spindle.
        SpeedAboveLimit,
        /// A spindle that turns without a speed of its mode.
        NoSpeedOfMode,
        /// A constant surface speed in a frame of the program.
        SurfaceInFrame,
        /// A constant surface speed beside a contour whose tool centre path ncc computes.
        SurfaceOnContour,
    }
}
