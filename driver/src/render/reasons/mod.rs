//! The words of reasons that are data in `ncc_ir`: a folder for each kind of refusal, and the small ones here.

pub(crate) mod lacks;
pub(crate) mod run_time;
pub(crate) mod unexecuted;

use std::borrow::Cow;

use ncc_ir::compensated::kind::{CompensationRefusal, Kind};
use ncc_ir::diag::NoValue;
use ncc_ir::expr::value::Wrong;

/// Why an expression has no value.
pub(in crate::render) fn no_value(why: NoValue) -> &'static str {
    match why {
        NoValue::Wrong(Wrong::DivisionByZero) => "a division by zero",
        NoValue::Wrong(Wrong::NotDefined) => "a function of a number for which it is not defined",
        NoValue::Wrong(Wrong::TooLarge) => "a number that is too large",
        NoValue::Wrong(Wrong::Arguments) => "a function of another number of arguments",
        NoValue::Wrong(Wrong::NothingGiven) => "a variable that has no value here",
        NoValue::Index => "an index that no element has",
    }
}

/// What the source's control refuses under cutter compensation.
pub(in crate::render) fn refused(what: &CompensationRefusal) -> Cow<'_, str> {
    match what {
        CompensationRefusal::Code { code } => code.as_ref().into(),
        CompensationRefusal::Kind(own) => kind(*own).into(),
    }
}

/// A kind of statement that some controls refuse there.
pub(in crate::render) fn kind(kind: Kind) -> &'static str {
    match kind {
        Kind::Path => "a path mode",
        Kind::ReturnLevel => "a return level of cycles",
        Kind::WorkOffset => "a work offset",
        Kind::Length => "a tool length offset",
        Kind::LocalShift => "a local shift",
        Kind::Overrides => "a code of the operator's override switches",
    }
}
