//! Machine coordinates, reference points and probing, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Machine coordinates, reference points and probing that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum MachineLack {
        /// A move in machine coordinates.
        Coordinates,
        /// Machine coordinates.
        CoordinatesCode,
        /// A move in machine coordinates that is measured with the tool's length.
        WithToolLength,
        /// A move in machine coordinates without the tool's length.
        WithoutToolLength,
        /// Machine coordinates without the tool's length.
        CoordinatesWithoutLength,
        /// A probing move.
        Probing,
        /// A probing move with an error at its end point.
        ProbingWithError,
        /// A probing move away from a contact.
        ProbingAway,
        /// A probing move of this kind.
        ProbingKind,
        /// A probing move whose feed is not known.
        ProbingFeedUnknown,
        /// Positioning from one side: how far beyond is the machine's.
        OneSide,
        /// A position by the caller's motion, after a return to a reference point.
        CallersMotionAfterReturn,
        /// A return to a reference point after which Z moves by a length that is not stated again.
        LengthAfterReturn,
        /// An incremental Z after a move to a position in machine coordinates, with the tool's length.
        IncrementAfterMachineMove,
        /// A cut in machine coordinates without the offsets of the tool along X and Y.
        CutWithoutToolOffsets,
        /// A cut in machine coordinates.
        Cut,
        /// A cut in machine coordinates under a frame of the program.
        CutUnderFrame,
        /// A cut in machine coordinates after a rotation.
        CutAfterRotation,
        /// A cut in machine coordinates: its work offset is not known.
        CutOffsetUnknown,
        /// A cut in machine coordinates: the unit is not known.
        CutUnitUnknown,
        /// A cut in machine coordinates: no variable has this offset.
        CutOffsetVariable,
        /// A cut in machine coordinates with so many digits.
        CutDigits,
        /// A return by an intermediate point that is not known here.
        IntermediatePointUnknown,
        /// An intermediate point of a rotary axis.
        IntermediateRotary,
        /// A move to a position that is stored in the control.
        StoredPosition,
        /// A move to this reference point.
        FurtherPoint,
        /// A move to the machine's zero.
        MachineZero,
        /// A move to the reference point.
        ReferencePoint,
        /// A rapid move by a detour.
        Detour,
        /// Z at machine zero after a tool change.
        ZAfterToolChange,
    }
}
