//! What ncc does not translate: moves, machine coordinates, probing, threads and compensation.

use crate::reason::reasons;

reasons! {
    /// What ncc does not translate: moves, machine coordinates, probing, threads and compensation.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum MoveUnsupported {
        /// This code while a canned cycle may be active.
        MachineInCycle,
        /// Its rapid move comes while a cycle may be active.
        DetourInCycle,
        /// Probing while a canned cycle may be active.
        ProbingInCycle,
        /// This code without an axis word.
        MachineNoAxis,
        /// An incremental word in machine coordinates.
        MachineIncrement,
        /// Machine coordinates at feed.
        MachineFeed,
        /// This code without G00 or G01.
        MachineNoMotion,
        /// This code while a thread code is active.
        MachineInThread,
        /// The reference point is not machine zero.
        ReferenceElsewhere,
        /// A rapid move with cutter compensation active.
        DetourCompensated,
        /// A rapid move while a thread code is active.
        DetourInThread,
        /// Incremental words.
        IntermediateIncrement,
        /// Probing with cutter compensation active.
        ProbingCompensated,
        /// Probing while a thread code is active.
        ProbingInThread,
        /// This code without `letter`: the active entry is not known.
        EntryOfBefore {
            /// The letter of the word.
            letter: char,
        },
        /// This code without `letter`: the active entry is not known.
        RadiusEntryOfBefore {
            /// The letter of the word.
            letter: char,
        },
        /// This code after a block that was read as compensation without it.
        RadiusAfterNone,
        /// Another radius while compensation may be active.
        RadiusInCompensation,
        /// A rounded corner by a word after a comma.
        CommaRounding,
        /// A chamfer by a word after a comma.
        CommaChamfer,
        /// A line by its angle.
        CommaAngle,
        /// Ncc does not know this word after a comma.
        CommaWord,
        /// A corner in polar coordinates.
        CornerPolar,
        /// A hole of the caller's cycle after another return level.
        HoleAfterLevel,
        /// Tool length offset without a Z move in G90.
        LengthWithoutZ,
        /// An arc with a third axis.
        HelixAxis,
        /// The lead of a thread without a decimal point.
        ThreadLead,
        /// A thread in polar coordinates.
        ThreadPolar,
        /// A thread along several axes, or about a rotary axis.
        ThreadAxes,
        /// A thread and another motion code in one block.
        ThreadBesideMotion,
        /// A thread while a modal call may be active.
        ThreadInModal,
        /// A feed move while the caller's cycle may be active.
        FeedInCallersCycle,
        /// A hole position at feed.
        PositionAtFeed,
        /// A feed or Z move to a tap with its own speed.
        TapPosition,
        /// This move is no hole position.
        NoPosition,
        /// Polar words in machine coordinates.
        MachinePolar,
        /// An arc in machine coordinates.
        MachineArc,
        /// An incremental word in machine coordinates.
        MachineIncrementWord,
        /// A direction in machine coordinates or polar words.
        RotaryMachine,
        /// A direction in a move that is no line.
        RotaryNoLine,
        /// No move has used this motion code yet.
        MotionUnderCycle,
        /// No move has used this motion code yet.
        MotionUnused,
        /// Axis words without a motion code.
        MotionUnknown,
        /// A call or a jump between this code and its tapping cycle.
        RigidTappingFlow,
        /// A move or a speed between this code and its tapping cycle.
        RigidTappingMove,
        /// Modal rounding in a block with block skip.
        RoundingSkipped,
        /// A label, call or return while this code rounds every corner.
        RoundingFlow,
        /// This code while a canned cycle is active.
        PlaneInCycle,
        /// A feed while the caller's cycle may be active.
        FeedInCallersCycleWord,
        /// Absolute or from the start of the arc?
        CentreOfOtherBlocks,
    }
}
