//! What a target cannot compute when the program runs: the reasons, as data.
//!
//! `WHILE` within three others, for a control that takes three, is `RunTime::Flow(RunTimeFlow::LoopDepth)`. The driver
//! alone has the words (`messages/`).

mod flow;
mod values;
mod words;

use crate::reason::wings;

pub use flow::RunTimeFlow;
pub use values::RunTimeValue;
pub use words::{ComputedFrame, RunTimeWord};

wings! {
    /// What a target cannot compute when the program runs.
    #[derive(Clone, Debug, PartialEq, Eq)]
    pub enum RunTime {
        /// Variables, expressions and their rounding.
        Value(RunTimeValue),
        /// Loops, branches, jumps and calls.
        Flow(RunTimeFlow),
        /// Blocks, messages, frames and cycles with run-time values.
        Word(RunTimeWord),
    }
}
