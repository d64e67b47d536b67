//! What a target cannot compute when the program runs: the reasons, as data.
//!
//! `WHILE` within three others, for a control that takes three, is `RunTime::Flow(RunTimeFlow::LoopDepth)`. The driver
//! alone has the words (`render/reasons`).

mod flow;
mod values;
mod words;

pub use flow::RunTimeFlow;
pub use values::RunTimeValue;
pub use words::{ComputedFrame, RunTimeWord};

macro_rules! reasons {
    ($( $(#[$doc:meta])* $name:ident($reason:ident), )*) => {
        /// What a target cannot compute when the program runs.
        #[derive(Clone, Debug, PartialEq, Eq)]
        pub enum RunTime {
            $( $(#[$doc])* $name($reason), )*
        }

        $(
            impl From<$reason> for RunTime {
                fn from(reason: $reason) -> RunTime {
                    RunTime::$name(reason)
                }
            }
        )*
    };
}

reasons! {
    /// Variables, expressions and their rounding.
    Value(RunTimeValue),
    /// Loops, decisions, jumps and calls.
    Flow(RunTimeFlow),
    /// Blocks, messages, frames and cycles with run-time values.
    Word(RunTimeWord),
}
