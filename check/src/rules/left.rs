//! NC0809 and NC0810: what is still on when the program ends.

use ncc_ir::source::Span;

use crate::finding::{Finding, What};
use crate::watch::Checker;

/// The program ends here.
pub(crate) fn on(checker: &mut Checker, end: Span) {
    for (mode, at) in checker.seen.on().to_vec() {
        checker.findings.add(Finding::new(What::Left(mode), at).with([end]));
    }
}
