//! What ncc does not execute: the reasons, as data.
//!
//! `G41` in a canned cycle is not executed, as `Unexecuted::Cycle(CycleUnexecuted::CompensationInCycle)`: controls differ
//! about it, or no manual describes it. The driver alone has the words (`messages/`).

mod compensation;
mod corners;
mod cycles;
mod flow;
mod frames;
mod moves;
mod tools;
mod values;

use crate::reason::wings;

pub use compensation::CompensationUnexecuted;
pub use corners::{CornerUnexecuted, NoCorner};
pub use cycles::CycleUnexecuted;
pub use flow::FlowUnexecuted;
pub use frames::FrameUnexecuted;
pub use moves::MoveUnexecuted;
pub use tools::ToolUnexecuted;
pub use values::ValueUnexecuted;

wings! {
    /// What ncc does not execute.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum Unexecuted {
        /// Program flow.
        Flow(FlowUnexecuted),
        /// Values of words and expressions.
        Value(ValueUnexecuted),
        /// Canned cycles and holes.
        Cycle(CycleUnexecuted),
        /// Cutter compensation.
        Compensation(CompensationUnexecuted),
        /// Frames, tilted planes and tool centre point control.
        Frame(FrameUnexecuted),
        /// Moves, machine coordinates and the spindle.
        Move(MoveUnexecuted),
        /// Tools and their tables.
        Tool(ToolUnexecuted),
        /// Rounded and chamfered corners.
        Corner(CornerUnexecuted),
    }
}
