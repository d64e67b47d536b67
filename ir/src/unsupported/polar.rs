//! What ncc does not translate: polar coordinates, poles and lines by their angle.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: polar coordinates, poles and lines by their angle.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum PolarUnsupported {
        /// This code in a block with block skip.
        SkippedBlock,
        /// Ncc does not know the active plane.
        UnknownPlane,
        /// Polar coordinates with G91 active.
        Increments,
        /// This code while polar coordinates are active.
        WhileActive,
        /// A polar radius that counts from the tool position.
        RadiusFromTool,
        /// A polar word that counts from the tool position.
        WordFromTool,
        /// A negative polar radius.
        NegativeRadius,
        /// Polar coordinates in a hole of the caller's cycle.
        HoleOfCaller,
        /// An arc with I, J or K in polar coordinates.
        CentreArc,
        /// Polar words in another plane than XY.
        OtherPlane,
        /// Polar words as a hole of the caller's cycle.
        OfCallersCycle,
        /// Polar words beside X or Y.
        BesideXY,
        /// Polar words, but G90 or G91 is not known.
        UnknownDistance,
        /// Incremental polar words in a canned cycle.
        HoleIncrements,
        /// Polar words that count from the tool position.
        CountFromTool,
        /// Polar words with a negative radius.
        WithNegativeRadius,
        /// A pole and another code in one block.
        PoleBesideCodes,
        /// This pole counts from an unknown one.
        PoleFromUnknown,
        /// AC or IC in a pole.
        PoleDistance,
        /// A word of the pole is missing.
        PoleIncomplete,
        /// Ncc does not know the pole.
        UnknownPole,
        /// An incremental polar radius.
        RadiusIncrement,
        /// A polar angle with G91 active.
        AngleUnderG91,
        /// The angle of a line beside polar words.
        AngleBesidePolar,
        /// AC or IC in the angle of a line.
        LineAngleDistance,
        /// This code cannot have polar words.
        OfFunction,
        /// Polar words beside coordinates.
        BesideCoordinates,
        /// The pole is in another plane.
        PoleOfOtherPlane,
        /// The angle of a move that is no line.
        AngleOfNoLine,
        /// The next block ends this line.
        LineOfTwoBlocks,
        /// An angle and both coordinates.
        LineOverdefined,
        /// An arc about a pole that is not absolute.
        ArcAboutPole,
    }
}
