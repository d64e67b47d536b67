//! What a statement is to those who write what codes do besides their name: whether it switches, cuts, commands Z.

use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::Axis;
use ncc_ir::expr::Expr;
use ncc_ir::program::kinds::{drilling, flow, moves, polar};
use ncc_ir::program::{FrameSlot, Op};

/// What decides whether a control keeps what is in a slot at the end of the program.
pub(super) fn at_end(slot: FrameSlot) -> Option<Behaviour> {
    match slot {
        FrameSlot::Local | FrameSlot::Chain => Some(Behaviour::ShiftAtEnd),
        FrameSlot::Shift => Some(Behaviour::OriginAtEnd),
        FrameSlot::Rotation | FrameSlot::Scale | FrameSlot::Mirror => Some(Behaviour::RotationAtEnd),
        FrameSlot::Polar | FrameSlot::Tilt => None,
    }
}

/// Whether an operation switches spindle or coolant, or may.
pub(super) fn switches(op: &Op) -> bool {
    match op {
        Op::Control(control) => control.bodies().any(|body| body.iter().any(|stmt| switches(&stmt.op))),
        Op::StartCycle(cycle) => cycle.kind.drives_spindle(),
        Op::StartSpindleClockwise
        | Op::StartSpindleCounterclockwise
        | Op::StopSpindleTurning
        | Op::OrientSpindle(_)
        | Op::FloodOn
        | Op::MistOn
        | Op::CoolantOff => true,
        op => is_code(op) || matches!(op, flow!()),
    }
}

/// Whether a code does something besides its name on some control.
pub(super) fn is_code(op: &Op) -> bool {
    match op {
        Op::ProgramStop
        | Op::OptionalProgramStop
        | Op::ChangeTool
        | Op::ProgramEnd
        | Op::BeginAgain
        | Op::GoToReference(_)
        | Op::UseMachineCoordinates { .. } => true,
        Op::Control(control) => control.bodies().any(|body| body.iter().any(|stmt| is_code(&stmt.op))),
        _ => false,
    }
}

/// Whether a statement cuts, or may.
pub(super) fn cuts(op: &Op) -> bool {
    !matches!(op, Op::StraightTraverse(_) | Op::SetPole(_))
        && matches!(op, Op::Position(_) | drilling!() | moves!() | polar!() | flow!())
}

pub(super) fn is_zero(entry: &Expr) -> bool {
    entry.literal().is_some_and(|n| n.mantissa == 0)
}

/// Whether a statement commands Z, or may.
pub(super) fn commands_z(op: &Op) -> bool {
    match op {
        Op::StraightTraverse(to) | Op::StraightFeed(to) | Op::Position(to) => to.to.get(Axis::Z).is_some(),
        Op::GoToReference(to) => to.axes[Axis::Z as usize] || to.via.get(Axis::Z).is_some(),
        op => cuts(op),
    }
}

/// Whether a statement may start the spindle.
pub(super) fn starts_spindle(op: &Op) -> bool {
    match op {
        Op::StartSpindleClockwise | Op::StartSpindleCounterclockwise => true,
        Op::OrientSpindle(_) | Op::SynchronisedFeed(_) => true,
        Op::StartCycle(cycle) => cycle.kind.drives_spindle(),
        flow!() => true,
        _ => false,
    }
}
