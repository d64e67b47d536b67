//! What ncc does not translate: shifts, rotations, scaling, mirrors and tilted planes.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: shifts, rotations, scaling, mirrors and tilted planes.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum FrameUnsupported {
        /// This code with G91 active.
        ShiftInIncrements,
        /// This code with G91 active.
        PositionInIncrements,
        /// A rotation with G91 active.
        RotationInIncrements,
        /// A tilted plane with G91 active.
        TiltInIncrements,
        /// A mirror with G91 active.
        MirrorInIncrements,
        /// Scaling with G91 active.
        ScaleInIncrements,
        /// This code while a canned cycle is active.
        InCycle,
        /// This code while a rotation or scaling is active.
        MirrorUnderFrame,
        /// This code while a rotation, scaling or mirror is active.
        ZeroUnderFrame,
        /// First move after this code: it needs both axes in G90.
        FirstMove,
        /// This code and another function in one block.
        BesideFunctions,
        /// This code without an axis word.
        AppendedNothing,
        /// A rotation about an axis of the plane.
        RotationAboutPlaneAxis,
        /// AC or IC in a frame.
        FrameDistance,
        /// This code in a block with axis words.
        AxisWords,
        /// A transformation in a block with axis words.
        TransformationAxisWords,
        /// A transformation with parameters.
        TransformationParameters,
        /// A shift that an earlier program set.
        OriginOfBefore,
        /// This code and a rotary axis in one block.
        TcpAxes,
        /// TCP may still be active here.
        TcpAgain,
        /// This code without brackets.
        SwivelBrackets,
        /// This code while a canned cycle is active.
        SwivelInCycle,
        /// The swivel data record is not known.
        SwivelKinematics,
        /// Ncc does not know this kind of angles.
        SwivelAngles,
        /// No direction is stated.
        SwivelDirection,
        /// The status and the direction disagree.
        SwivelOtherStatus,
        /// Another side than the stated one.
        SwivelOtherSide,
        /// This code retracts along the tool.
        SwivelRetractTool,
        /// This code retracts but turns no axis.
        SwivelRetractOnly,
        /// A tilted plane may be active already.
        SwivelAgain,
        /// This code does not retract to machine zero.
        SwivelRetractElsewhere,
        /// A tilted plane of another working plane.
        SwivelPlane,
        /// The retract is computed.
        SwivelRetractComputed,
        /// This code adds to a tilted plane, or follows the tool tip.
        SwivelAdded,
        /// A shift after the rotation.
        SwivelShift,
    }
}
