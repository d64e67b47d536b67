//! Slots as one chain of frames that begins again: a shift, and a rotation about a point after it.
//!
//! Each statement says the whole chain; so it must be known what is active of the other slot. Refused: where
//! it is not.

use crate::frames::computed_frames::{Shift, Used, is_frame, is_zero, set, slot_of, stays};
use ncc_ir::canon::{AXES, Distance, Fact, Plane};
use ncc_ir::expr::num::Num;
use ncc_ir::expr::{Expr, Node, Target, Unary, Var};
use ncc_ir::program::kinds::flow;
use ncc_ir::program::{Control, Coord, FrameSlot, FrameStep, Op, Slot, Stmt};
use ncc_ir::run_time::ComputedFrame;

/// What is active of the slots that go into one chain; `None` is not known.
#[derive(Clone)]
pub(super) struct Held {
    /// By how much each axis is shifted; one that is not is 0.
    shift: Option<Shift>,
    /// The rotation, if there is one.
    turn: Option<Option<Turn>>,
}

/// A rotation about a point of its plane.
type Turn = (Fact<Plane>, [Option<Expr>; 3], Coord);

impl Held {
    pub(super) fn at_start(used: &Used, first: bool) -> Held {
        Held {
            shift: (first || !used.moved.contains(&true)).then_some([const { None }; AXES]),
            turn: (first || !used.turned_between).then_some(None),
        }
    }

    /// Where the blocks of a loop or a branch begin, and after it: the shift is the one before it, if nothing in it
    /// changes that.
    pub(super) fn across(&self, control: &Control, used: &Used) -> Held {
        let anew = Held::at_start(used, false);
        let kept = || self.shift.clone().filter(|axes| keeps_across(control, axes));
        Held { shift: anew.shift.or_else(kept), turn: anew.turn }
    }

    /// After a statement that is no frame. What is computed again is another value than the active one.
    pub(super) fn behind(&mut self, op: &Op, used: &Used) {
        match op {
            flow!() | Op::Declare(_) => *self = Held::at_start(used, false),
            Op::Assign(to, _) => {
                let reads = |e: &Expr| e.reads(to);
                self.shift = self.shift.take().filter(|axes| !axes.iter().flatten().any(reads));
                let turns =
                    |(_, centre, angle): &Turn| centre.iter().flatten().any(reads) || reads(&angle.value);
                self.turn = self.turn.take().filter(|turn| !turn.as_ref().is_some_and(turns));
            }
            _ => {}
        }
    }

    /// All of it as a chain that begins again.
    fn chain(&self, used: &Used) -> Result<Vec<Op>, ComputedFrame> {
        let nothing = [const { None }; AXES];
        let shift = match &self.shift {
            Some(shift) => shift,
            None if used.shift().is_none() => &nothing,
            None => return Err(ComputedFrame::BesideUnknownShift),
        };
        let turn = self.turn.as_ref().ok_or(ComputedFrame::BesideUnknownRotation)?;
        let mut steps = Vec::new();
        if !shift.iter().flatten().all(is_zero) {
            steps.push(FrameStep::Translate(Box::new(shift.clone())));
        }
        if let Some(turn) = turn {
            steps.extend(about(turn)?);
        }
        if steps.is_empty() {
            return Ok(vec![Op::ClearFrame(FrameSlot::Chain)]);
        }
        Ok(steps.into_iter().enumerate().map(|(at, step)| set(at > 0, step)).collect())
    }
}

/// Whether nothing in a loop or a branch changes a shift, nor what it was computed from.
fn keeps_across(control: &Control, axes: &Shift) -> bool {
    let counts = |variable: &Var| axes.iter().flatten().any(|by| by.reads(&Target::Var(variable.clone())));
    let counted = matches!(control, Control::For { variable, .. } if counts(variable));
    !counted && control.bodies().all(|body| keeps(body, axes))
}

fn keeps(body: &[Stmt], axes: &Shift) -> bool {
    body.iter().all(|stmt| match &stmt.op {
        Op::Control(control) => keeps_across(control, axes),
        Op::Leave | Op::NextTurn => true,
        Op::SetSlot(slot) => slot_of(slot) == FrameSlot::Rotation,
        Op::ClearFrame(slot) => *slot == FrameSlot::Rotation,
        op => !is_frame(op) && stays(axes, op),
    })
}

/// A slot as a chain that begins again, with what is active of the other ones.
pub(super) fn as_chain(op: &Op, used: &Used, held: &mut Held) -> Result<Vec<Op>, ComputedFrame> {
    match op {
        // What no block fills is empty.
        Op::ClearFrame(FrameSlot::Chain) => return Ok(vec![Op::ClearFrame(FrameSlot::Chain)]),
        Op::ClearFrame(slot) if !used.fills(*slot) => return Ok(Vec::new()),
        Op::ClearFrame(FrameSlot::Rotation) => held.turn = Some(None),
        Op::ClearFrame(slot) if used.shift() == Some(*slot) => held.shift = Some([const { None }; AXES]),
        Op::SetSlot(slot) => match &**slot {
            Slot::Shift { axes, .. } if used.shift().is_some() => {
                let mut to = (**axes).clone();
                if (0..AXES).any(|axis| used.moved[axis] && to[axis].is_none()) {
                    let before = held.shift.take().ok_or(ComputedFrame::AxisKept)?;
                    to.iter_mut().zip(before).for_each(|(to, before)| *to = to.take().or(before));
                }
                held.shift = Some(to);
            }
            Slot::Rotation { plane, centre, angle } => {
                held.turn = Some(Some((*plane, (**centre).clone(), angle.clone())));
            }
            _ => return Err(ComputedFrame::OtherForm),
        },
        _ => return Err(ComputedFrame::OtherForm),
    }
    held.chain(used)
}

/// A rotation about a point.
fn about((plane, centre, angle): &Turn) -> Result<Vec<FrameStep>, ComputedFrame> {
    if angle.distance != Fact::Known(Distance::Absolute) {
        return Err(ComputedFrame::RotatedFurther);
    }
    let Fact::Known(in_plane) = plane else { return Err(ComputedFrame::PlaneUnknown) };
    let (first, second, _) = in_plane.axes();
    let mut there: [Option<Expr>; AXES] = [const { None }; AXES];
    let mut back = there.clone();
    for axis in [first, second] {
        let Some(at) = &centre[axis as usize] else { return Err(ComputedFrame::AboutTool) };
        there[axis as usize] = Some(at.clone());
        back[axis as usize] = Some(negative(at));
    }
    let turn = FrameStep::Rotate { plane: *plane, angle: angle.value.clone() };
    if there.iter().flatten().all(is_zero) {
        return Ok(vec![turn]);
    }
    let [there, back] = [there, back].map(|axes| FrameStep::Translate(Box::new(axes)));
    Ok(vec![there, turn, back])
}

fn negative(e: &Expr) -> Expr {
    match e {
        Expr::Num(n) => Expr::Num(Num { mantissa: -n.mantissa, ..*n }),
        Expr::Node(_) => Expr::Node(Box::new(Node::Unary(Unary::Negate, e.clone()))),
    }
}
