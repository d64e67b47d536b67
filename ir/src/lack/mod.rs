//! What a target lacks: the reasons of a refusal, as data.
//!
//! `G33 X10. Z-5. F1.` for a control that cuts threads along one axis alone is refused as
//! `Lack::Threads(ThreadsLack::AxisCount)`. Each wing has its reasons in a file. The driver alone has their words
//! (`messages/`) and chooses the help by the variant.

mod arcs;
mod compensation;
mod corners;
mod feeds;
mod flow;
mod frames;
mod holes;
mod lengths;
mod machine;
mod modes;
mod operator;
mod patterns;
mod polar;
mod spindle;
mod tables;
mod threads;
mod tools;
mod words;

use crate::reason::wings;

pub use arcs::ArcsLack;
pub use compensation::{CompensationLack, ExpandedContour};
pub use corners::CornersLack;
pub use feeds::FeedsLack;
pub use flow::FlowLack;
pub use frames::{FramesLack, OutsideFrame};
pub use holes::HolesLack;
pub use lengths::LengthsLack;
pub use machine::MachineLack;
pub use modes::ModesLack;
pub use operator::OperatorLack;
pub use patterns::PatternsLack;
pub use polar::PolarLack;
pub use spindle::SpindleLack;
pub use tables::TablesLack;
pub use threads::{TapValue, ThreadsLack};
pub use tools::ToolsLack;
pub use words::WordsLack;

wings! {
    /// What a target lacks.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum Lack {
        /// Canned cycles and holes.
        Holes(HolesLack),
        /// Hole patterns.
        Patterns(PatternsLack),
        /// Tapping cycles and spindle-synchronised moves.
        Threads(ThreadsLack),
        /// Arcs.
        Arcs(ArcsLack),
        /// Rounded and chamfered corners.
        Corners(CornersLack),
        /// Cutter compensation.
        Compensation(CompensationLack),
        /// Shifts, rotations, scales, mirrors and tilted planes.
        Frames(FramesLack),
        /// Machine coordinates, reference points and probing.
        Machine(MachineLack),
        /// Tools, tool changes and edges.
        Tools(ToolsLack),
        /// Tool length offsets.
        Lengths(LengthsLack),
        /// Values in the control's tables.
        Tables(TablesLack),
        /// Units, distance modes, planes and path modes.
        Modes(ModesLack),
        /// Feeds and dwells.
        Feeds(FeedsLack),
        /// Spindle and coolant.
        Spindle(SpindleLack),
        /// Program flow and calls.
        Flow(FlowLack),
        /// Messages, alarms and text for devices.
        Operator(OperatorLack),
        /// Blocks, axis words and numbers.
        Words(WordsLack),
        /// Polar coordinates.
        Polar(PolarLack),
    }
}
