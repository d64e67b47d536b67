//! NC0809 and NC0810: what is still on when the program ends.

use ncc_ir::source::Span;

use crate::finding::{Finding, LeftOn, What};
use crate::watched::Watched;

/// The program ends here.
pub(crate) fn on(checker: &mut Watched, end: Span) {
    for (mode, at) in checker.seen.on().to_vec() {
        // Where a program never cancels a length, the next one is not meant to find none.
        if mode == LeftOn::Length && !checker.cancels_length {
            continue;
        }
        checker.findings.add(Finding::new(What::Left(mode), at).with([end]));
    }
}
