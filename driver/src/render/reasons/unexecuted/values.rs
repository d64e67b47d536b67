//! The words of reasons: values of words and expressions.

use std::borrow::Cow;

use ncc_ir::unexecuted::ValueUnexecuted as R;

pub(super) fn text(reason: &R) -> Cow<'static, str> {
    Cow::Borrowed(match reason {
        R::Expression => "an expression",
        R::PositionWithoutValue => "a position of which no word has a value",
        R::NotPositive => "a feed, a speed, a time or a number that is not positive",
        R::WordWithoutValue => "a word without a value that cannot be left out",
        R::ControlVariableSet => "a variable of the control's own that is set",
        R::SystemVariable { name } => return format!("the system variable {name}").into(),
        R::SystemVariableUnknown { asked } => {
            return format!("the system variable {asked}, which is not known here").into();
        }
        R::LiteralUnit => "a literal with a unit of its own in an expression",
        R::MessageValue => "a value in a message",
        R::WrittenValue => "a value in what is written",
        R::PeckClearanceUnknown => "an unknown clearance of peck drilling",
        R::BreakLiftUnknown => "an unknown lift of chip-breaking drilling",
    })
}
