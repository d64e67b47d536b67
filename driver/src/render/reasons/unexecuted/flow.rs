//! The words of reasons: program flow.

use ncc_ir::unexecuted::FlowUnexecuted as R;

pub(super) fn text(reason: &R) -> &'static str {
    match reason {
        R::CallInStream => "a call in the midst of a stream",
        R::MainReturn => "a return of the main program",
        R::RepetitionInStream => "a repetition in the midst of a stream",
        R::Variable => "a variable",
        R::Control => "control of the program's flow",
        R::Jump => "a jump",
        R::LeaveOutsideLoop => "a word that leaves a loop, outside of any",
        R::JumpOutOfRepetition => "a jump out of blocks that are executed again",
        R::MachineDecides => "a way that depends on the machine's own values",
    }
}
