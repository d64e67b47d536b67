//! Frames of programs that compute: each statement says, in the target's own form, all that is active after it.
//!
//! Which frame is active where a block of a loop is executed, the run alone knows, so that none is worked into
//! coordinates, and none is stated by what has changed since the one before.
//!
//! Where the target chains frames, a shift and a rotation are one chain: what is active of the other one is known from
//! the stretch of blocks at hand, and that nothing is turned where a stretch begins if none ends so (`Held`).
//!
//! Refused: a frame that the target has no form of its own for, a shift or a rotation beside another one that is
//! not known there, a rotation about the place where the tool is, steps that add up but for translations of one
//! stretch of blocks, and a move after a rotation that does not name both axes of its plane (controls do not agree about
//! it).

mod chained;

use chained::{Held, as_chain};

use crate::frames::expand_frames::ExpandFramesState;
use crate::pass::{KeptProgram, Pass, ProgramMoment, ProgramStep, Shared};
use crate::support::mode_analysis::Known;
use crate::support::needs::FRAME;
use crate::support::write::{Rebuild, is_absolute, rebuild};
use crate::values::variables::{round, rounded};
use ncc_ir::canon::{AXES, Axis, Distance, Fact, Plane};
use ncc_ir::caps::Caps;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::{Num, Unit};
use ncc_ir::program::arguments;
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Coord, Frame, FrameSlot, FrameStep, Op, Program, Slot, Stmt};
use ncc_ir::run_time::{ComputedFrame, RunTimeWord};
use ncc_ir::source::Span;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "computed-frames",
    about: "states all active frames after each statement, where a program computes",
    alone: None,
    step: None,
    program: &[ProgramStep {
        moment: ProgramMoment::Frames,
        needed: |_, p| behind_control(p.program),
        run: in_shared,
    }],
    parametric: None,
};

/// What the legaliser runs: the target lacks no frames after it.
fn in_shared(shared: &mut Shared, kept: &mut KeptProgram) {
    let Some(known) = kept.known else { return };
    if let Err(refusal) = run(kept.program, &shared.target.caps, known) {
        return kept.refuse(refusal);
    }
    if shared.states.ask(ExpandFramesState::is_busy) {
        let at = kept.program.procedures.first().and_then(|main| main.body.first());
        let at = at.map_or_else(Span::default, |stmt| stmt.span);
        return kept.refuse(Diagnostic::new(Fault::computes(RunTimeWord::OtherFrames), at));
    }
    shared.lacks &= !FRAME;
}

/// Whether a program has frames after its first statement of control, or computed ones, so that every block has to say by itself from
/// where its words are measured.
pub fn behind_control(program: &Program) -> bool {
    let mut used = Used::default();
    for (at, procedure) in program.procedures.iter().enumerate() {
        used.look(&procedure.body, at == 0, &Caps::default());
    }
    used.behind
}

/// Says the frames of a program so, which has frames after its first statement of control. `known` is what holds where
/// stretches of its blocks begin.
///
/// # Errors
/// The first one that cannot be stated, at its place.
fn run(program: &mut Program, caps: &Caps, known: &Known) -> Result<(), Diagnostic> {
    let mut used = Used::default();
    for (at, procedure) in program.procedures.iter().enumerate() {
        used.look(&procedure.body, at == 0, caps);
    }
    if used.increments {
        program.procedures.iter().try_for_each(|procedure| absolute(&procedure.body, known))?;
    }
    if used.unsaid {
        for (at, procedure) in program.procedures.iter_mut().enumerate() {
            state_frames(&mut procedure.body, &used, caps, Held::at_start(&used, at == 0))?;
        }
    }
    Ok(())
}

/// Whether a statement changes a frame.
fn is_frame(op: &Op) -> bool {
    match op {
        Op::SetSlot(slot) => !matches!(**slot, Slot::Tilt(_)),
        Op::ClearFrame(slot) => *slot != FrameSlot::Tilt,
        Op::SetFrame(_) | Op::SetPosition(_) | Op::UseOriginShift(_) => true,
        _ => false,
    }
}

/// The frames of a whole program.
#[derive(Clone, Debug, Default)]
struct Used {
    /// Whether there are any after the first statement of control, or computed ones before it.
    behind: bool,
    /// Whether there is one that the target does not say as it stands.
    unsaid: bool,
    /// Axes that are shifted, and those that are not by 0 alone.
    shifted: [bool; AXES],
    moved: [bool; AXES],
    /// Slots that are filled.
    slots: Vec<FrameSlot>,
    /// Whether a chain is turned.
    turns: bool,
    /// Whether a rotation that fills a slot may be active where a stretch of blocks begins.
    turned_between: bool,
    /// Whether words are measured from where the tool is anywhere.
    increments: bool,
}

impl Used {
    fn look(&mut self, body: &[Stmt], mut straight: bool, caps: &Caps) {
        let mut turned = false;
        for stmt in body {
            let flows = matches!(stmt.op, flow!());
            straight &= !flows;
            self.turned_between |= flows && turned;
            match &stmt.op {
                Op::SetSlot(slot) if slot_of(slot) == FrameSlot::Rotation => turned = true,
                Op::ClearFrame(FrameSlot::Rotation) if stmt.skip.is_none() => turned = false,
                Op::ProgramEnd => turned = false,
                _ => {}
            }
            if let Op::Control(control) = &stmt.op {
                control.bodies().for_each(|body| self.look(body, false, caps));
            }
            self.increments |= stmt.op == Op::SetDistanceMode(Distance::Incremental);
            if !is_frame(&stmt.op) {
                continue;
            }
            self.behind |= !straight || arguments::computed(&stmt.op);
            self.unsaid |= !caps.says_frame(&stmt.op);
            match &stmt.op {
                Op::SetSlot(slot) => {
                    if let Slot::Shift { axes, .. } = &**slot {
                        self.shifts(&axes[..]);
                    }
                    self.slots.push(slot_of(slot));
                }
                Op::SetFrame(frame) => match &frame.step {
                    FrameStep::Translate(axes) => self.shifts(&axes[..]),
                    FrameStep::Rotate { .. } => self.turns = true,
                    FrameStep::Scale(_) | FrameStep::Mirror(_) => {}
                },
                _ => {}
            }
        }
        self.turned_between |= turned;
    }

    fn shifts(&mut self, axes: &[Option<Expr>]) {
        for (axis, by) in axes.iter().enumerate() {
            self.shifted[axis] |= by.is_some();
            self.moved[axis] |= by.as_ref().is_some_and(|by| !is_zero(by));
        }
    }

    /// The one slot that shifts, if no other does, and the present point is given no coordinates.
    fn shift(&self) -> Option<FrameSlot> {
        match (self.fills(FrameSlot::Local), self.fills(FrameSlot::Shift)) {
            (true, true) => None,
            (true, false) => Some(FrameSlot::Local),
            (false, true) => Some(FrameSlot::Shift),
            (false, false) => None,
        }
    }

    fn fills(&self, slot: FrameSlot) -> bool {
        self.slots.contains(&slot)
    }
}

fn slot_of(slot: &Slot) -> FrameSlot {
    match slot {
        Slot::Shift { origin: true, .. } => FrameSlot::Shift,
        Slot::Shift { origin: false, .. } => FrameSlot::Local,
        Slot::Rotation { .. } => FrameSlot::Rotation,
        Slot::Scale { .. } => FrameSlot::Scale,
        Slot::Mirror(_) | Slot::NoMirror(_) => FrameSlot::Mirror,
        Slot::Tilt(_) => FrameSlot::Tilt,
    }
}

/// What fills a slot is absolute only where the distance mode is: that is stated before it, or known of all ways to it.
fn absolute(body: &[Stmt], known: &Known) -> Result<(), Diagnostic> {
    // Whether it is; nothing where a stretch of blocks begins.
    let mut said = None;
    for stmt in body {
        if matches!(stmt.op, flow!()) {
            said = None;
            if let Op::Control(control) = &stmt.op {
                control.bodies().try_for_each(|body| absolute(body, known))?;
            }
            continue;
        }
        let before = || known.before(stmt).and_then(|at| at.modes.distance) == Some(Distance::Absolute);
        let is = *said.get_or_insert_with(before);
        match &stmt.op {
            Op::SetDistanceMode(distance) => {
                said = Some(*distance == Distance::Absolute && (is || stmt.skip.is_none()));
            }
            Op::SetSlot(_) | Op::SetPosition(_) if !is && is_frame(&stmt.op) => {
                return Err(Diagnostic::new(Fault::computes(RunTimeWord::FrameIncremental), stmt.span));
            }
            _ => {}
        }
    }
    Ok(())
}

/// `held` is what is active where the body begins.
fn state_frames(body: &mut Vec<Stmt>, used: &Used, caps: &Caps, mut held: Held) -> Result<(), Diagnostic> {
    if !body.iter().any(|stmt| is_frame(&stmt.op) || matches!(stmt.op, Op::Control(_))) {
        return Ok(());
    }
    let mut refused = None;
    // Whether the frame before is a translation that has begun the chain again, with nothing after it.
    let mut anew = false;
    // The translation that this stretch has stated again, while it is the whole chain and worth what it was.
    let mut shift: Option<Shift> = None;
    rebuild(body, |mut stmt, made: &mut Rebuild| {
        if !is_frame(&stmt.op) {
            if let Op::Control(control) = &mut stmt.op {
                held = held.across(control, used);
                let within = |body: &mut Vec<Stmt>| state_frames(body, used, caps, held.clone());
                refused = refused.take().or(control.bodies_mut().try_for_each(within).err());
            } else {
                held.behind(&stmt.op, used);
            }
            anew &= matches!(stmt.op, Op::Comment(_) | Op::Blank);
            shift = shift.take().filter(|axes| stays(axes, &stmt.op));
            return made.push(stmt);
        }
        if let (Some(axes), false) = (&shift, caps.frames.chain) {
            add_to(axes, &mut stmt.op);
        }
        shift = translation(&stmt.op).filter(|_| stmt.skip.is_none());
        let said = match stmt.skip {
            Some(_) => Err(ComputedFrame::Skipped),
            None if caps.frames.chain => as_chain(&stmt.op, used, &mut held),
            None => as_slots(&stmt.op, used, caps, anew),
        };
        anew = matches!(&stmt.op, Op::SetFrame(frame) if !frame.added && is_translation(&frame.step));
        match said {
            Ok(ops) => made.replace(stmt, ops.into_iter().map(|op| (false, op))),
            Err(why) => {
                let what = RunTimeWord::Frame { why };
                refused.get_or_insert(Diagnostic::new(Fault::computes(what), stmt.span));
            }
        }
    });
    match refused {
        Some(refused) => Err(refused),
        None if caps.frames.chain => Ok(()),
        None => placed(body),
    }
}

/// By how much a chain of translations moves each axis.
type Shift = [Option<Expr>; AXES];

/// Whether a translation is the same after a statement.
fn stays(axes: &Shift, op: &Op) -> bool {
    match op {
        flow!() | Op::Declare(_) => false,
        Op::Assign(to, _) => !axes.iter().flatten().any(|by| by.reads(to)),
        _ => true,
    }
}

/// A translation that begins the chain again, or none at all.
fn translation(op: &Op) -> Option<Shift> {
    match op {
        Op::ClearFrame(FrameSlot::Chain) => Some([const { None }; AXES]),
        Op::SetFrame(frame) if !frame.added => match &frame.step {
            FrameStep::Translate(axes) => Some((**axes).clone()),
            _ => None,
        },
        _ => None,
    }
}

/// Has a translation that adds to another one begin the chain again, with the sum of both.
fn add_to(before: &Shift, op: &mut Op) {
    if let Op::SetFrame(frame) = op
        && let FrameStep::Translate(axes) = &mut frame.step
        && frame.added
    {
        for (axis, before) in axes.iter_mut().zip(before) {
            let sum = match (&*axis, before) {
                (Some(by), Some(before)) => Some(sum(before, by)),
                (by, before) => by.as_ref().or(before.as_ref()).cloned(),
            };
            *axis = sum;
        }
        frame.added = false;
    }
}

/// A sum. Frames say that they are rounded where that changes nothing: so does the sum of two of which neither has more
/// digits.
fn sum(a: &Expr, b: &Expr) -> Expr {
    let own = |e: &Expr| match rounded(e) {
        Some((inner, digits)) => (inner, Some(digits)),
        None => (e.clone(), e.literal().map(|n| n.trimmed().scale)),
    };
    let ((a, of_a), (b, of_b)) = (own(a), own(b));
    let mut sum = a.plus(&b);
    if let (Some(a), Some(b)) = (of_a, of_b) {
        round(&mut sum, a.max(b));
    }
    sum
}

fn is_translation(step: &FrameStep) -> bool {
    matches!(step, FrameStep::Translate(_))
}

fn is_zero(e: &Expr) -> bool {
    e.literal().is_some_and(|n| n.is_zero())
}

fn set(added: bool, step: FrameStep) -> Op {
    Op::SetFrame(Box::new(Frame { added, step }))
}

/// A step of a chain as slots: a shift of all axes that are shifted anywhere, and a rotation about its zero.
fn as_slots(op: &Op, used: &Used, caps: &Caps, anew: bool) -> Result<Vec<Op>, ComputedFrame> {
    let shifts = used.shifted.contains(&true);
    let origin = !caps.frames.local_shift;
    if shifts && origin && !caps.frames.stated_shift || used.turns && !caps.frames.rotation {
        return Err(ComputedFrame::OtherForm);
    }
    let zero = |axis: usize| Expr::Num(Num::int(0, if axis < 3 { Unit::Mm } else { Unit::Degree }));
    let mut ops = Vec::new();
    // A shift is stated outside a rotation.
    let to = |axes: &[Option<Expr>], ops: &mut Vec<Op>| {
        if used.turns {
            ops.push(Op::ClearFrame(FrameSlot::Rotation));
        }
        if shifts {
            let word =
                |axis: usize| used.shifted[axis].then(|| axes[axis].clone().unwrap_or_else(|| zero(axis)));
            let axes = Box::new(std::array::from_fn(word));
            ops.push(Op::SetSlot(Box::new(Slot::Shift { origin, axes })));
        }
    };
    let nothing = [const { None }; AXES];
    match op {
        op if caps.says_frame(op) => ops.push(op.clone()),
        Op::SetSlot(slot) => match &**slot {
            Slot::Shift { origin, axes }
                if used.shift().is_some() && (caps.frames.local_shift || caps.frames.stated_shift) =>
            {
                let axes = axes.clone();
                ops.push(Op::SetSlot(Box::new(Slot::Shift { origin: !origin, axes })));
            }
            _ => return Err(ComputedFrame::OtherForm),
        },
        Op::ClearFrame(slot) if used.shift() == Some(*slot) => to(&nothing, &mut ops),
        Op::ClearFrame(FrameSlot::Chain) => to(&nothing, &mut ops),
        Op::ClearFrame(slot) if !used.fills(*slot) => {}
        Op::SetFrame(frame) => match &frame.step {
            FrameStep::Translate(axes) if !frame.added => to(&axes[..], &mut ops),
            FrameStep::Rotate { plane, angle } if !frame.added || anew => {
                if !frame.added {
                    to(&nothing, &mut ops);
                }
                let Fact::Known(in_plane) = plane else { return Err(ComputedFrame::PlaneUnknown) };
                let (first, second, _) = in_plane.axes();
                let mut centre = [const { None }; 3];
                [first, second].into_iter().for_each(|axis| centre[axis as usize] = Some(zero(0)));
                let angle = Coord { value: angle.clone(), distance: Fact::Known(Distance::Absolute) };
                let turn = Slot::Rotation { plane: *plane, centre: Box::new(centre), angle };
                ops.push(Op::SetSlot(Box::new(turn)));
            }
            FrameStep::Translate(_) | FrameStep::Rotate { .. } => return Err(ComputedFrame::Added),
            FrameStep::Scale(_) | FrameStep::Mirror(_) => return Err(ComputedFrame::OtherForm),
        },
        _ => return Err(ComputedFrame::OtherForm),
    }
    Ok(ops)
}

/// The first move in a plane after a rotation that begins or ends names both of its axes, absolutely.
fn placed(body: &[Stmt]) -> Result<(), Diagnostic> {
    let mut open: Option<(Plane, &Stmt)> = None;
    for stmt in body {
        match &stmt.op {
            Op::ClearFrame(FrameSlot::Rotation) => {
                open = open.or(Some((Plane::Xy, stmt)));
                continue;
            }
            Op::SetSlot(slot) => {
                if let Slot::Rotation { plane, .. } = &**slot {
                    open = Some((plane.or(Plane::Xy), stmt));
                }
                continue;
            }
            _ => {}
        }
        let Some((plane, from)) = open else { continue };
        let (first, second, _) = plane.axes();
        let named = match &stmt.op {
            Op::StraightTraverse(m) | Op::StraightFeed(m) | Op::Position(m) | Op::Hole(m) => {
                [first, second].map(|axis: Axis| m.to.get(axis).map(|word| is_absolute(word, None)))
            }
            Op::ProgramEnd => return Ok(()),
            flow!() | Op::BeginAgain | Op::ArcFeed(_) | Op::ArcForm(_) | Op::Polar(_) | Op::Pattern(_) => {
                [Some(false), None]
            }
            _ => [None, None],
        };
        match named {
            [None, None] => {}
            [Some(true), Some(true)] => open = None,
            _ => {
                return Err(Diagnostic::new(Fault::computes(RunTimeWord::RotationFirstMove), from.span));
            }
        }
    }
    match open {
        None => Ok(()),
        Some((_, from)) => {
            Err(Diagnostic::new(Fault::computes(RunTimeWord::RotationNotStraightOn), from.span))
        }
    }
}
