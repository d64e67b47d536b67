//! Polar coordinates, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Polar coordinates that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum PolarLack {
        /// A point in polar coordinates.
        Point,
        /// A point in polar coordinates in a block with block skip.
        PointSkipped,
        /// A point in polar coordinates in a plane that is not known.
        PointPlaneUnknown,
        /// The end of polar coordinates.
        PointsEnd,
        /// This function to a polar point.
        FunctionToPoint,
        /// A pole.
        Pole,
        /// A pole in a plane that is not known.
        PolePlaneUnknown,
        /// A hole position outside the plane.
        HoleOutsidePlane,
        /// A move for which the target has no polar code.
        Move,
        /// An increment of a line's angle.
        AngleIncrement,
        /// An increment of a polar radius.
        RadiusIncrement,
        /// A polar word.
        Word,
    }
}
