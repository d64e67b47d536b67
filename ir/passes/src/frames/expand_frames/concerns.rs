//! Which statements of a program, and which programs, are this pass's business.

use ncc_ir::caps::Caps;
use ncc_ir::program::{FrameSlot, Op, Program, Slot, Stmt};

/// Whether a statement is this pass's business: a change of frames, unless all that the target has is a
/// chain and this is one of its steps.
pub(crate) fn concerns(op: &Op, caps: &Caps) -> bool {
    match op {
        _ if tilts(op) => false,
        Op::SetFrame(_) | Op::ClearFrame(FrameSlot::Chain) => !caps.frames.chain,
        Op::SetSlot(_) | Op::SetPosition(_) => true,
        Op::UseOriginShift(_) => !caps.frames.suspends_shift,
        Op::ClearFrame(slot) => *slot != FrameSlot::Shift,
        _ => false,
    }
}

/// Whether a statement is about a tilted plane, which is another pass's business.
pub(super) fn tilts(op: &Op) -> bool {
    match op {
        Op::SetSlot(slot) => matches!(**slot, Slot::Tilt(_)),
        Op::ClearFrame(slot) => *slot == FrameSlot::Tilt,
        _ => false,
    }
}

/// Whether any procedure of a program sets a frame that the target cannot say as it is.
pub(crate) fn has_frames(program: &Program, caps: &Caps) -> bool {
    let sets = |op: &Op| {
        let frame = matches!(op, Op::SetFrame(_) | Op::SetSlot(_) | Op::SetPosition(_));
        frame && !tilts(op) || *op == Op::UseOriginShift(true)
    };
    let unsaid = |s: &Stmt| sets(&s.op) && !caps.says_frame(&s.op);
    program.procedures.iter().flat_map(|p| &p.body).any(unsaid) || takes_origin_back(program, caps)
}

/// Whether a subprogram sets or ends a G92 shift that the target ends by the present point only:
/// where that is, and whether a shift is active, is known without calls.
pub(crate) fn shifts_origin_in_calls(program: &Program, caps: &Caps) -> bool {
    let shifts = |op: &Op| sets_origin(op) || ends_origin(op);
    takes_origin_back(program, caps)
        && program.procedures.iter().skip(1).flat_map(|p| &p.body).any(|s| shifts(&s.op))
}

/// Whether a program ends a G92 shift for which the target has no word.
fn takes_origin_back(program: &Program, caps: &Caps) -> bool {
    let any = |of: fn(&Op) -> bool| program.procedures.iter().flat_map(|p| &p.body).any(|s| of(&s.op));
    caps.frames.origin_shift && !caps.frames.clears_shift && any(sets_origin) && any(ends_origin)
}

/// Whether no G92 shift is active after a statement.
fn ends_origin(op: &Op) -> bool {
    matches!(op, Op::ClearFrame(FrameSlot::Shift) | Op::UseOriginShift(false))
}

/// Whether a statement shifts the origin.
fn sets_origin(op: &Op) -> bool {
    match op {
        Op::SetPosition(_) | Op::UseOriginShift(true) => true,
        Op::SetSlot(slot) => matches!(**slot, Slot::Shift { origin: true, .. }),
        _ => false,
    }
}
