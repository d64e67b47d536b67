//! The words of `ncc_ir::unexecuted`, one file a wing.

mod compensation;
mod corners;
mod cycles;
mod flow;
mod frames;
mod moves;
mod tools;
mod values;

use std::borrow::Cow;

use ncc_ir::unexecuted::Unexecuted;

pub(crate) use corners::no_corner;

/// What ncc does not execute.
pub(crate) fn text(reason: &Unexecuted) -> Cow<'static, str> {
    match reason {
        Unexecuted::Flow(reason) => flow::text(reason).into(),
        Unexecuted::Value(reason) => values::text(reason),
        Unexecuted::Cycle(reason) => cycles::text(reason).into(),
        Unexecuted::Compensation(reason) => compensation::text(reason).into(),
        Unexecuted::Frame(reason) => frames::text(reason).into(),
        Unexecuted::Move(reason) => moves::text(reason).into(),
        Unexecuted::Tool(reason) => tools::text(reason).into(),
        Unexecuted::Corner(reason) => corners::text(reason).into(),
    }
}
