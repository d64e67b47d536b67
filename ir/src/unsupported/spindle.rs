//! What ncc does not translate: the spindle and its speed.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: the spindle and its speed.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum SpindleUnsupported {
        /// Constant surface speed of another axis than X.
        SurfaceAxis,
        /// Some blocks have a speed limit, others not.
        SurfaceLimits,
        /// This code and a surface speed in one block.
        SurfaceUnits,
        /// Axis words and a speed limit in one block.
        LimitAndAxes,
        /// Is `letter` the angle of the spindle?
        AngleByOption {
            /// The letter of the word.
            letter: char,
            /// The option that decides.
            option: Box<str>,
        },
        /// `letter` while a canned cycle may be active.
        AngleInCycle {
            /// The letter of the word.
            letter: char,
        },
        /// A direction of an oriented stop.
        Direction,
        /// An oriented stop in a block with axis words.
        StopWithAxes,
        /// This code after a subprogram that changes the feed mode.
        SurfaceAfterCall,
        /// Constant surface speed of another axis than X.
        SurfaceOtherAxis,
        /// Another speed while a tapping cycle is active.
        SpeedInTap,
        /// Another master spindle.
        MasterSpindle,
    }
}
