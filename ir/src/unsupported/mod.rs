//! What ncc reads and does not translate: the reasons of NC0202, as data.
//!
//! `G81` in a program with `G91`, where ncc does not know which depth is meant, is refused as
//! `Unsupported::Cycle(CycleUnsupported::Increments)`. The driver alone has the words (`messages/NC0202`).
//! Only a name from a dictionary is text: `CodeUnsupported::Named`.

mod call;
mod code;
mod cycle;
mod flow;
mod frame;
mod function;
pub mod left_out;
mod moves;
mod polar;
mod save;
mod spindle;
mod table;
mod text;
mod value;

use crate::reason::wings;

pub use call::CallUnsupported;
pub use code::CodeUnsupported;
pub use cycle::CycleUnsupported;
pub use flow::FlowUnsupported;
pub use frame::FrameUnsupported;
pub use function::{FunctionFailure, FunctionUnsupported};
pub use moves::MoveUnsupported;
pub use polar::PolarUnsupported;
pub use save::SaveUnsupported;
pub use spindle::SpindleUnsupported;
pub use table::TableUnsupported;
pub use text::TextUnsupported;
pub use value::ValueUnsupported;

wings! {
    /// What ncc reads and does not translate.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum Unsupported {
        /// Codes, words and the form of a block.
        Code(CodeUnsupported),
        /// Messages, comments, and the form of a program.
        Text(TextUnsupported),
        /// Polar coordinates, poles and lines by their angle.
        Polar(PolarUnsupported),
        /// Shifts, rotations, scaling, mirrors and tilted planes.
        Frame(FrameUnsupported),
        /// Canned cycles, their arguments, dwells and hole patterns.
        Cycle(CycleUnsupported),
        /// The spindle and its speed.
        Spindle(SpindleUnsupported),
        /// Moves, machine coordinates, probing, threads and compensation.
        Move(MoveUnsupported),
        /// Tool tables, offsets and stored positions.
        Table(TableUnsupported),
        /// Calls, returns and what they give.
        Call(CallUnsupported),
        /// Jumps, loops, branches and O words.
        Flow(FlowUnsupported),
        /// Variables, values, expressions and texts.
        Value(ValueUnsupported),
        /// Modes that a subprogram saves and restores.
        Save(SaveUnsupported),
        /// Custom functions of a user's program.
        Function(FunctionUnsupported),
    }
}

impl Unsupported {
    /// A code that the dictionary names, by its name there.
    pub fn named(name: impl Into<Box<str>>) -> Unsupported {
        CodeUnsupported::Named { name: name.into() }.into()
    }

    /// Whether the dictionary refuses a code or an argument by this name: `DTB: dwell at the bottom` is an argument's.
    pub fn is_named(&self, name: &str) -> bool {
        match self {
            Unsupported::Code(CodeUnsupported::Named { name: own }) => **own == *name,
            Unsupported::Cycle(CycleUnsupported::RefusedArgument { parameter, name: own }) => {
                name.strip_prefix(&**parameter).and_then(|rest| rest.strip_prefix(": ")) == Some(own)
            }
            _ => false,
        }
    }
}
