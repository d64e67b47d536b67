//! Cutter compensation, as reasons of a refusal.

use crate::reason::reasons;

reasons! {
    /// Cutter compensation that a target lacks.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum CompensationLack {
        /// Cutter compensation.
        Compensation,
        /// Compensation by a computed entry.
        ComputedEntry,
        /// Cutter compensation with the radius of an unknown tool.
        ToolUnknown,
        /// Cutter compensation with the radius of an edge that is no entry.
        EdgeWithoutEntry,
        /// Compensation by a diameter that the program states.
        StatedDiameter,
        /// The radius of entry {entry} with the length of entry {length}.
        EntryWithLength {
            /// The entry of the table.
            entry: u32,
            /// The entry of the length table.
            length: u32,
        },
        /// The radius of entry {entry} with a length that is not known.
        EntryWithUnknownLength {
            /// The entry of the table.
            entry: u32,
        },
        /// Compensation by this radius.
        Radius,
        /// A compensated contour with a block without motion.
        WithoutMotion,
        /// A compensated contour with two blocks without motion in a row.
        TwoWithoutMotion,
        /// Cutter compensation switched on again without G40.
        OnAgain,
        /// A stop in a compensated contour, with M05 or M03 beside it.
        StopBeside,
        /// The end of the text under cutter compensation.
        EndOfText,
        /// A rotary axis along a contour whose tool centre path ncc computes.
        RotaryAxis,
        /// Inverse-time feeds along a contour whose tool centre path ncc computes.
        FeedByTime,
        /// An arc under cutter compensation whose tool centre path ncc computes, where what F counts on it is not known.
        ArcFeedUnknown,
        /// Something in a contour of which ncc computes the tool centre path.
        Expanded {
            /// What it is.
            what: ExpandedContour,
        },
        /// A function in a contour that is listed by its tool centre path.
        Listed {
            /// The name.
            function: &'static str,
        },
        /// A feed mode in a contour that is listed by its tool centre path.
        FeedModeListed,
    }

    /// Something that ncc does not compute in a tool centre path.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ExpandedContour {
        /// A block that may be skipped.
        SkippedBlock,
        /// Another start of the compensation.
        OtherStart,
        /// A frame of the program.
        Frame,
        /// A motion that is neither a line nor an arc.
        Motion,
        /// Inverse time feed, or a point in machine coordinates.
        FeedByTime,
        /// A contour without a radius before the contour before it is left.
        NoRadius,
        /// An arc as lead-in.
        ArcLeadIn,
        /// An arc with an unknown feed along the contour.
        ArcFeedUnknown,
        /// An arc whose feed at the tool centre has too few digits.
        ArcFeedDigits,
        /// An arc as lead-out.
        ArcLeadOut,
        /// A lead-out in a block that may be skipped.
        SkippedLeadOut,
        /// An arc in another plane.
        OtherPlane,
        /// A word of a rotary axis.
        RotaryAxis,
        /// A canonical function, by its name.
        Function {
            /// The name.
            function: &'static str,
        },
        /// A canonical function between the contour and its lead-out, by its name.
        BeforeLeadOut {
            /// The name.
            function: &'static str,
        },
    }
}
