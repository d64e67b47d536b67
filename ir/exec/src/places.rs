//! Where the axes stand: in the program's frame and on the machine, by the words of a block.

use ncc_ir::canon::{AXES, Distance};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Nanos;
use ncc_ir::program::{Coord, Point};
use ncc_ir::source::Span;
use ncc_ir::syntax::Ranged;
use ncc_ir::unexecuted::ToolUnexecuted;

use crate::event::by_control;
use crate::moves::arcs::Heading;
use crate::{Exec, MOST_BITS};

impl Exec {
    /// Puts the machine somewhere.
    pub fn be_at(&mut self, machine: [Nanos; AXES]) {
        self.last = machine;
        self.position = self.unplace(&machine);
    }

    /// Where the axes stand, in machine coordinates.
    #[inline]
    pub fn machine(&self) -> [Nanos; AXES] {
        self.place(&self.position)
    }

    /// A point of the program in machine coordinates.
    #[inline]
    pub(super) fn place(&self, p: &[Nanos; AXES]) -> [Nanos; AXES] {
        let mut at = match &self.chain {
            None => *p,
            Some(chain) => chain.place(p),
        };
        for (at, shift) in at.iter_mut().zip(&self.frame) {
            *at = at.wrapping_add(*shift);
        }
        at
    }

    /// A reference point in program coordinates.
    pub(super) fn unplace(&self, p: &[Nanos; AXES]) -> [Nanos; AXES] {
        let mut p = *p;
        for (place, shift) in p.iter_mut().zip(&self.frame) {
            *place = place.wrapping_sub(*shift);
        }
        match &self.chain {
            None => p,
            Some(chain) => chain.unplace(&p),
        }
    }

    /// Computes the frame again; the machine stays at `here`.
    pub(super) fn reframe(&mut self, here: [Nanos; AXES]) {
        self.frame = self.world.work_offset(self.modes.work_offset);
        let external = self.external();
        for (zero, external) in self.frame.iter_mut().zip(external) {
            *zero = zero.wrapping_add(external);
        }
        let turn = self.world.work_turn(self.modes.work_offset);
        if turn != 0 || self.offset_turned {
            self.turn_offset(turn);
        }
        if !self.offset_turned && (self.modes.shifted || self.slots.is_some()) {
            let shift = self.origin_shift();
            for (f, s) in self.frame.iter_mut().zip(shift) {
                *f = f.wrapping_add(s);
            }
        }
        if self.state.tip || self.state.tilted {
            self.shift_by_kinematics();
        }
        let tool = self.tool_offset();
        self.frame = std::array::from_fn(|axis| self.frame[axis].wrapping_add(tool[axis]));
        self.position = self.unplace(&here);
        self.heading = Heading::None;
    }

    /// Applies a waiting length entry: the coming Z is measured with it.
    #[inline]
    pub(super) fn take_up_length(&mut self) {
        if let Some(length) = self.waiting.take() {
            self.frame[self.along] += self.length_of(length) - self.length_of(self.modes.length);
            self.modes.length = length;
        }
    }

    #[inline]
    pub(super) fn target(&self, word: &Coord, from: Nanos, span: Span) -> Result<Nanos, Diagnostic> {
        let value = self.value(&word.value, span)?;
        Ok(match word.distance.or(self.modes.distance) {
            Distance::Absolute => value,
            Distance::Incremental => {
                let sum = from.wrapping_add(value);
                if sum.unsigned_abs() >= 1 << MOST_BITS {
                    return self.fault(Fault::OutOfRange { word: Ranged::LengthSum }, span);
                }
                sum
            }
        })
    }

    /// Where the words put the axes; applies a waiting length with a Z word.
    #[inline]
    pub(super) fn set_axes(&mut self, to: &Point, span: Span) -> Result<(), Diagnostic> {
        let from = if self.carried.is_some() { self.counted_from(to, span)? } else { self.position };
        let mut next = self.position;
        if Exec::turns(to) {
            self.put(&to.axes, &mut next, &from, span)?;
            self.turn_rotary(to, &mut next);
        } else {
            self.put(&to.axes[..3], &mut next, &from, span)?;
        }
        if let Some(word) = &to.axes[self.along] {
            if word.distance.or(self.modes.distance) == Distance::Incremental && self.another_length_waits() {
                // Whether the way grows by the difference is a setting on some controls, told on none.
                return self.not_executed(ToolUnexecuted::IncrementTakesLength, span);
            }
            self.take_up_length();
            self.at_place = false;
        }
        if self.state.by_control & (by_control::Z | by_control::Z_COUNTED) != 0 {
            self.counts_z_of(to);
        }
        self.position = next;
        Ok(())
    }
}
