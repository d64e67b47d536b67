//! Arcs, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Arcs that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ArcsLack {
        /// An arc.
        Arc,
        /// A helix.
        Helix,
        /// A circle in space.
        CircleInSpace,
        /// An arc of this radius.
        Radius,
        /// A computed radius below half the distance from start to end.
        ComputedRadiusShort,
        /// An arc with a computed value.
        ComputedValue,
        /// A tangent arc after a move that is not known.
        TangentAfterUnknown,
        /// An arc of several turns with a rotary axis.
        TurnsWithRotaryAxis,
        /// A helix of several turns that activates a length.
        TurnsWithLength,
        /// An arc of more than one turn.
        SeveralTurns,
        /// An arc with a third axis.
        ThirdAxis,
        /// A full circle where the distance mode is not known.
        CircleModeUnknown,
        /// A full circle in a unit that is not known.
        CircleUnitUnknown,
        /// An arc in a plane that is not known.
        PlaneUnknown,
        /// An arc's centre in a unit that is not known.
        CentreUnitUnknown,
        /// A centre this far away.
        CentreTooFar,
        /// An arc's centre.
        Centre,
        /// A centre of which one word is missing.
        CentreWordMissing,
        /// A centre in a distance mode that is not known.
        CentreModeUnknown,
        /// An arc in this form.
        Form,
        /// An arc without a plane.
        NoPlane,
        /// A centre that is not known.
        CentreUnknown,
        /// A radius that is not known.
        RadiusUnknown,
        /// An arc so short that its start and end round to one point.
        ShortAfterRounding,
        /// A point in polar coordinates whose place is known only when the program runs.
        PolarRunTime,
    }
}
