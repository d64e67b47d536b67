//! Shifts in blocks with block skip.
//!
//! ```text
//! /G52 X2. Y0. Z0.      /TRANS X2 Y0 Z0
//! ```
//!
//! Which shift is active after such a block, the switch of the control decides. It is written where the same words
//! are right under each shift that may be active before: those that replace the whole shift, or state the axes that the
//! source states.
//!
//! Not here: targets that have the source's own statement (it stays as it is), and rotations, factors and mirrors.

use crate::frames::expand_frames::{Frames, Now, Slots, cannot, frame_forms};
use crate::support::write::{exact, unit_of};
use ncc_exec::{Chain, Present};
use ncc_ir::canon::{AXES, Axis};
use ncc_ir::diag::Fault;
use ncc_ir::expr::Expr;
use ncc_ir::expr::num::Nanos;
use ncc_ir::lack::FramesLack;
use ncc_ir::program::{FrameSlot, FrameStep, Op, Slot, Stmt};

impl Frames<'_> {
    /// The statements that say another shift, where a block-skip switch decides about this one or one before.
    ///
    /// # Errors
    /// The target has no words that are right in each case.
    pub(super) fn change_in_doubt(&mut self, stmt: &Stmt) -> Result<Vec<Op>, Fault> {
        let refused = || cannot(FramesLack::InSkippedBlock);
        let (caps, at) = (&self.target.caps, &self.inner.at);
        // A shift that stands as coordinates of the present point has another end.
        let by_local = Slots { local: [0; AXES], ..self.set.said.clone() } == Slots::NONE;
        let as_said = self.set.chain == Chain::NONE && !self.chained && !self.set.lost && by_local;
        if !as_said || at.cycle.is_some() || at.cycle_in_doubt {
            return Err(refused());
        }
        let before: Vec<Slots> = std::iter::once(&self.set.slots).chain(&self.set.others).cloned().collect();
        let from: Vec<Shift> = before.iter().map(shift_of).collect::<Option<_>>().ok_or_else(refused)?;
        let here = std::array::from_fn(|axis| {
            let known = agreed(&from, axis)?;
            at.position[axis].map(|at| at.wrapping_add(known))
        });
        let now = Now { at, work: here, shift: [0; AXES] };
        let mut after: Vec<Slots> = Vec::new();
        for mut slots in before.iter().cloned() {
            change(&mut slots, &stmt.op, &now).ok_or_else(refused)??;
            after.push(slots);
        }
        let to: Vec<Shift> = after.iter().map(shift_of).collect::<Option<_>>().ok_or_else(refused)?;
        let unit = self.inner.unit();
        let ops = if caps.frames.chain {
            // Words that replace the whole of it.
            let all: Option<Vec<Nanos>> = (0..AXES).map(|axis| agreed(&to, axis)).collect();
            let all = all.and_then(|all| Shift::try_from(all).ok()).ok_or_else(refused)?;
            frame_forms::as_chain(&Slots { local: all, ..Slots::NONE }, true, unit).ok_or_else(refused)?
        } else if caps.frames.local_shift || caps.frames.stated_shift {
            let mut axes = [const { None }; AXES];
            for axis in Axis::ALL {
                let n = axis as usize;
                if from.iter().zip(&to).any(|(from, to)| from[n] != to[n]) {
                    let place = agreed(&to, n).ok_or_else(refused)?;
                    axes[n] = Some(Expr::Num(exact(place, unit_of(axis, unit))));
                }
            }
            let slot = Slot::Shift { origin: !caps.frames.local_shift, axes: Box::new(axes) };
            let Slot::Shift { axes, .. } = &slot else { return Err(refused()) };
            if axes.iter().all(Option::is_none) { Vec::new() } else { vec![Op::SetSlot(Box::new(slot))] }
        } else {
            return Err(refused());
        };
        if stmt.skip.is_some() {
            after.extend(before);
        }
        let mut left: Vec<Slots> = Vec::new();
        for slots in after {
            if !left.contains(&slots) {
                left.push(slots);
            }
        }
        if left.len() > MOST_CASES {
            return Err(refused());
        }
        let may_be: Vec<Shift> = left.iter().filter_map(shift_of).collect();
        let known = std::array::from_fn(|axis| {
            let shift = agreed(&may_be, axis)?;
            here[axis].map(|at: Nanos| at.wrapping_sub(shift))
        });
        let mut left = left.into_iter();
        self.set.slots = left.next().unwrap_or(Slots::NONE);
        self.set.others = left.collect();
        self.set.whole = frame_forms::shifted(&self.set.slots);
        self.set.said = Slots { local: may_be.first().copied().unwrap_or_default(), ..Slots::NONE };
        self.set.said_chain = caps.frames.chain;
        self.arcs.step(stmt, &mut self.inner);
        self.inner.at.position = known;
        Ok(ops)
    }
}

/// Most shifts that may be active in one place.
const MOST_CASES: usize = 64;

/// A shift, in nanometres and nanodegrees by axis.
type Shift = [Nanos; AXES];

/// The shift that frames amount to; `None` if they turn, scale or mirror.
fn shift_of(slots: &Slots) -> Option<Shift> {
    let whole = frame_forms::shifted(slots);
    (whole.turn().is_none() && slots.suspended.is_none()).then(|| *whole.shift())
}

/// The shift of an axis, if it is one in each case.
fn agreed(shifts: &[Shift], axis: usize) -> Option<Nanos> {
    let first = shifts.first()?[axis];
    shifts.iter().all(|shift| shift[axis] == first).then_some(first)
}

/// Makes a change to frames; `None` for one that does more than to shift.
fn change(slots: &mut Slots, op: &Op, now: &Now) -> Option<Result<(), Fault>> {
    match op {
        Op::SetSlot(slot) if matches!(**slot, Slot::Shift { .. }) => Some(slots.set(slot, now)),
        Op::SetFrame(frame) if matches!(frame.step, FrameStep::Translate(_)) => {
            if !frame.added {
                slots.steps = Chain::NONE;
            }
            let range = || Fault::OutOfRange { word: "factor".into() };
            Some(slots.steps.add(&frame.step, |plane| now.plane(plane), |value| now.value(value), range))
        }
        Op::ClearFrame(slot @ (FrameSlot::Local | FrameSlot::Chain | FrameSlot::Shift)) => {
            slots.clear(*slot);
            Some(Ok(()))
        }
        _ => None,
    }
}
