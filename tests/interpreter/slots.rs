//! Shifts, rotation, scale and mirror as a Fanuc has them, from `reference/fanuc.md` sections 3 and 8:
//! the mirror acts first, then the scale, then the rotation, whose centre is mirrored and scaled as
//! well; the local shift and that of the origin come last. A mirror of one axis of the plane turns a
//! rotation round.

use super::siemens::frame::Frame;
use super::{Halt, Machine, Place};

/// What is in force.
#[derive(Clone, Debug, Default)]
pub(super) struct Slots {
    /// G92.
    pub(super) origin: Place,
    /// What is put aside of it.
    pub(super) aside: Option<Place>,
    /// G52.
    pub(super) local: Place,
    /// G68: axes of the plane, centre, degrees.
    pub(super) rotation: Option<([usize; 2], [f64; 3], f64)>,
    /// G51: centre, factors.
    pub(super) scale: Option<([f64; 3], [f64; 3])>,
    /// G51.1
    pub(super) mirror: [Option<f64>; 3],
}

impl Slots {
    /// Rotation, scale and mirror.
    pub(super) fn turn(&self) -> Frame {
        let inner = self.scaled();
        let Some((axes, centre, degrees)) = self.rotation else { return inner };
        let odd = self.mirror[axes[0]].is_some() != self.mirror[axes[1]].is_some();
        let about = inner.apply(centre);
        let turned = Frame::turn(if odd { -degrees } else { degrees }, axes[0], axes[1]);
        Frame::shift(about).then(&turned).then(&Frame::shift(about.map(|v| -v))).then(&inner)
    }

    /// Scale and mirror alone.
    fn scaled(&self) -> Frame {
        let mut frame = Frame::NONE;
        if let Some((centre, factors)) = self.scale {
            let back = Frame::shift(centre.map(|v| -v));
            frame = frame.then(&Frame::shift(centre)).then(&Frame::factors(factors)).then(&back);
        }
        let lines = self.mirror.map(|line| line.unwrap_or(0.0));
        let signs = self.mirror.map(|line| if line.is_some() { -1.0 } else { 1.0 });
        let back = Frame::shift(lines.map(|v| -v));
        frame.then(&Frame::shift(lines)).then(&Frame::factors(signs)).then(&back)
    }

    /// What is added on each axis.
    pub(super) fn shift(&self) -> Place {
        std::array::from_fn(|axis| self.origin[axis] + self.local[axis])
    }

    /// Another local shift of the axes named.
    pub(super) fn shift_locally(&mut self, axes: [Option<f64>; 6]) {
        for (local, value) in self.local.iter_mut().zip(axes) {
            *local = value.unwrap_or(*local);
        }
    }

    /// The place `at`, counted from the work offset, gets these coordinates.
    pub(super) fn set_position(
        &mut self,
        m: &Machine,
        at: Place,
        axes: [Option<f64>; 6],
    ) -> Result<(), Halt> {
        if self.turn() != Frame::NONE {
            return m.halt("coordinates of the present point in a frame that turns");
        }
        for (axis, value) in axes.into_iter().enumerate() {
            if let Some(value) = value {
                self.local[axis] = 0.0;
                self.origin[axis] = at[axis] - value;
            }
        }
        Ok(())
    }

    /// Where `at`, counted from the work offset, is as a rotation sees it that comes now.
    pub(super) fn before_rotation(&self, at: Place) -> [f64; 3] {
        let shift = self.shift();
        self.scaled().undo(std::array::from_fn(|axis| at[axis] - shift[axis]))
    }
}
