//! Why a run of both programs against each other ends.
//!
//! ```text
//! source: G2 X1 R0 | nothing to compare      Ended::Source
//! source: G0 X10   | output: G0 X11          Ended::Target
//! ```

use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::source::Span;

use super::verifier::{Run, Stop};

/// Events that are made on each side before they are compared.
pub(super) const PIECE: usize = 4096;

/// Why a run ends before its end.
pub enum Ended {
    /// The source cannot be executed.
    Source(Diagnostic),
    /// The output does something else.
    Target(Diagnostic),
    /// It does, for what it assumes of the source's numbers is not so.
    NotSo(Diagnostic),
    /// It is long enough.
    Enough(Span),
}

impl Ended {
    pub(crate) fn target(stop: Stop) -> Ended {
        match stop {
            Stop::Source(fault) => Ended::Source(fault),
            Stop::Target(fault) => Ended::Target(fault),
        }
    }
}

/// Whether a run with another fact has shown anything that is to be judged.
pub(super) fn tells(ended: &Result<(), Ended>, run: &Run) -> bool {
    match ended {
        Ok(()) => run.fed_otherwise().is_some(),
        Err(Ended::Source(fault)) => by_target(&fault.fault),
        Err(Ended::Enough(_)) => false,
        Err(Ended::Target(_) | Ended::NotSo(_)) => true,
    }
}

/// Whether a difference is reported of the source: it leaves open what the target's control does.
pub(super) fn by_target(fault: &Fault) -> bool {
    matches!(
        fault,
        Fault::DoneByTarget { .. }
            | Fault::ModeNotSet { .. }
            | Fault::SpindleForCycle { by_target: true, .. }
    )
}
