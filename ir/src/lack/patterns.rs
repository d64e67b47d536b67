//! Hole patterns, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Hole patterns that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum PatternsLack {
        /// A pattern of holes.
        Pattern,
        /// A bolt circle whose first hole is stated by radius and angle.
        CircleByRadius,
        /// A line of holes.
        Line,
        /// A list of positions.
        List,
        /// A list of more than {most} positions.
        ListLength {
            /// The most that the target takes.
            most: usize,
        },
        /// A grid from a stated position.
        GridFromPosition,
        /// A bolt circle.
        Circle,
        /// A bolt circle about where the tool is.
        CircleAboutTool,
        /// A bolt circle by its first hole.
        CircleByFirstHole,
        /// A bolt circle whose holes are in one place.
        CircleInOnePlace,
        /// A grid of holes.
        Grid,
        /// A grid in this order.
        GridOrder,
        /// A grid with all its rows in one direction.
        GridOneDirection,
        /// A grid whose rows do not stand square to the left of its columns.
        GridNotSquare,
        /// A line of holes that begins after its start.
        LineAwayFromStart,
        /// A row along another axis than those of the plane.
        RowAxis,
    }
}
