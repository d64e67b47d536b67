//! The words at the further places of a fault.

use ncc_ir::diag::Fault;

/// What the further places of a fault are. Most faults have none.
pub(super) fn related(fault: &Fault) -> &'static str {
    match fault {
        Fault::WordTwice { .. } | Fault::ProgramTwice { .. } | Fault::SecondWorkOffset { .. } => "first here",
        Fault::CodesExclude { .. } => "the other one",
        Fault::TextAfterEnd => "the program ends here",
        Fault::LabelTwice { .. } => "one of them",
        Fault::CallRecursive { .. } => "by way of this call",
        Fault::CycleUpsideDown | Fault::NoCycle => "the cycle's block",
        _ => "belongs to it",
    }
}
