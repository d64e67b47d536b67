//! Program flow that ncc does not execute.

use crate::reason::reasons;

reasons! {
    /// Program flow that ncc does not execute.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum FlowUnexecuted {
        /// A call in the midst of a stream.
        CallInStream,
        /// A return of the main program.
        MainReturn,
        /// A repetition in the midst of a stream.
        RepetitionInStream,
        /// A variable.
        Variable,
        /// Control of the program's flow.
        Control,
        /// A jump.
        Jump,
        /// A word that leaves a loop, outside of any.
        LeaveOutsideLoop,
        /// A jump out of blocks that are executed again.
        JumpOutOfRepetition,
        /// A control-flow path that depends on the machine's own values.
        MachineDecides,
    }
}
