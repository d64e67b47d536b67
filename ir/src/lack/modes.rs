//! Units, distance modes, planes and path modes, as reasons of a refusal.

use crate::canon::{AdviceKind, PathMode};
use crate::reason::reasons;

reasons! {
    /// Units, distance modes, planes and path modes that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ModesLack {
        /// This unit of length.
        Units,
        /// Absolute coordinates.
        Absolute,
        /// Incremental coordinates.
        Incremental,
        /// This plane.
        Plane,
        /// A plane that is not known.
        PlaneUnknown,
        /// Absolute and incremental words in one block.
        MixedDistances,
        /// Words in a distance mode that is not known.
        DistanceUnknown,
        /// Millimetres where they are not known to be active.
        MillimetresUnknown,
        /// Inches where they are not known to be active.
        InchesUnknown,
        /// Lengths in a unit that the caller decides.
        CallersUnit,
        /// A length in a unit that is not known.
        LengthUnitUnknown,
        /// Units that a subprogram states only after its first label.
        UnitsAfterLabel,
        /// What its caller has active, where this control begins otherwise.
        CallersModes,
        /// A computed value in another unit.
        ComputedInOtherUnit,
        /// A pitch, a peck, a shift or a corner that is not exact in inches.
        InexactInInches,
        /// An exact stop of one move.
        ExactStop,
        /// An exact stop of one move, where the mode before it is not known.
        ExactStopModeUnknown,
        /// A path mode.
        PathMode {
            /// The mode.
            mode: PathMode,
        },
        /// A tolerance of the path.
        PathTolerance,
        /// A tolerance of the path without its value.
        PathToleranceValue,
        /// A tolerance for moves that are made one.
        MergedMovesTolerance,
        /// Advice to the control of this kind.
        Advice {
            /// The kind.
            kind: AdviceKind,
        },
    }
}
