//! Local shifts in blocks that can be skipped.
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

use super::{Frames, Now, Slots, cannot, frame_forms};
use crate::canon::{AXES, Axis};
use crate::diag::Fault;
use crate::exec::Chain;
use crate::expr::Expr;
use crate::num::Nanos;
use crate::passes::write::{exact, unit_of};
use crate::program::{FrameSlot, Op, Slot, Stmt};

/// A local shift, in nanometres and nanodegrees by axis.
type Shift = [Nanos; AXES];

impl Frames<'_> {
    /// The statements that say another local shift, where a block-skip switch decides about this one or one before.
    ///
    /// # Errors
    /// The target has no words that are right in each case.
    pub(super) fn change_in_doubt(&mut self, stmt: &Stmt) -> Result<Vec<Op>, Fault> {
        let refused = || cannot("a frame in a block that can be skipped");
        let shift_alone = |slots: &Slots| Slots { local: [0; AXES], ..slots.clone() } == Slots::NONE;
        let (caps, at) = (&self.target.caps, &self.inner.at);
        let pure = shift_alone(&self.set.slots) && self.set.chain == Chain::NONE && !self.chained;
        if !pure || self.set.lost || at.cycle.is_some() || at.cycle_in_doubt {
            return Err(refused());
        }
        let before: Vec<Shift> =
            std::iter::once(self.set.slots.local).chain(self.set.others.iter().copied()).collect();
        let here = std::array::from_fn(|axis| {
            let one = before.iter().all(|shift| shift[axis] == before[0][axis]);
            at.position[axis].map(|at| at.wrapping_add(before[0][axis])).filter(|_| one)
        });
        let now = Now { at, work: here, shift: [0; AXES] };
        let mut after: Vec<Shift> = Vec::new();
        for shift in &before {
            let mut slots = Slots { local: *shift, ..Slots::NONE };
            match &stmt.op {
                Op::SetSlot(slot) if matches!(**slot, Slot::Shift { origin: false, .. }) => {
                    slots.set(slot, &now)?;
                }
                Op::ClearFrame(FrameSlot::Local) => slots.clear(FrameSlot::Local),
                _ => return Err(refused()),
            }
            if !after.contains(&slots.local) {
                after.push(slots.local);
            }
        }
        let unit = self.inner.unit();
        let ops = if caps.frames {
            // Words that replace the whole of it.
            let [one] = after[..] else { return Err(refused()) };
            frame_forms::as_chain(&Slots { local: one, ..Slots::NONE }, true, unit).ok_or_else(refused)?
        } else if caps.stated_shift {
            let named = |axis: usize| match &stmt.op {
                Op::SetSlot(slot) => match &**slot {
                    Slot::Shift { axes, .. } => axes[axis].is_some(),
                    _ => false,
                },
                _ => before.iter().any(|shift| shift[axis] != 0),
            };
            let word = |axis: Axis| {
                let value = || Expr::Num(exact(after[0][axis as usize], unit_of(axis, unit)));
                named(axis as usize).then(value)
            };
            let axes = Axis::ALL.map(word);
            if axes.iter().all(Option::is_none) {
                Vec::new()
            } else {
                vec![Op::SetSlot(Box::new(Slot::Shift { origin: true, axes: Box::new(axes) }))]
            }
        } else {
            return Err(refused());
        };
        if stmt.skip.is_some() {
            let kept: Vec<Shift> = before.iter().filter(|shift| !after.contains(shift)).copied().collect();
            after.extend(kept);
        }
        let known = std::array::from_fn(|axis| {
            let one = after.iter().all(|shift| shift[axis] == after[0][axis]);
            here[axis].map(|at: Nanos| at.wrapping_sub(after[0][axis])).filter(|_| one)
        });
        let mut after = after.into_iter();
        self.set.slots = Slots { local: after.next().unwrap_or_default(), ..Slots::NONE };
        self.set.others = after.collect();
        self.set.whole = frame_forms::shifted(&self.set.slots);
        self.set.said = self.set.slots.clone();
        self.set.said_chain = caps.frames;
        self.arcs.step(stmt, &mut self.inner);
        self.inner.at.position = known;
        Ok(ops)
    }
}
