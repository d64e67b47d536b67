//! The words of `ncc_ir::run_time`, one file a wing.

mod flow;
mod values;
mod words;

use std::borrow::Cow;

use ncc_ir::run_time::RunTime;

/// What a target cannot compute when the program runs.
pub(crate) fn text(reason: &RunTime) -> Cow<'static, str> {
    match reason {
        RunTime::Value(reason) => values::text(reason),
        RunTime::Flow(reason) => flow::text(reason),
        RunTime::Word(reason) => words::text(reason),
    }
}
