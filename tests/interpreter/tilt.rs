//! Control of the tool's tip, and planes that lie in space: where the linear axes stand then is not asked.
//! Points stay those of the program, as far from the linear axes' as the machine has it.

use super::{Halt, Machine, What};

/// What separates points of the tip, and of a tilted plane, from those of the linear axes; and where the
/// rotary axes stand when the tool stands upright on a plane, if the machine says it.
pub struct Kinematics {
    /// Of the tip.
    pub tip: [f64; 3],
    /// Of a plane.
    pub plane: [f64; 3],
    /// Rotary axes, degrees.
    pub upright: Option<[f64; 3]>,
}

/// A plane's zero, and its three axes.
pub type Plane = [[f64; 3]; 4];

/// Turns, one after the other, each about an axis (0, 1, 2) as those before have left it.
fn turned(turns: [(usize, f64); 3]) -> [[f64; 3]; 3] {
    let mut axes = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    for (about, degrees) in turns {
        let (from, to) = ((about + 1) % 3, (about + 2) % 3);
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (a, b) = (axes[from], axes[to]);
        for k in 0..3 {
            axes[from][k] = a[k] * cos + b[k] * sin;
            axes[to][k] = b[k] * cos - a[k] * sin;
        }
    }
    axes
}

impl Machine {
    /// What separates program from machine coordinates besides offsets and lengths.
    pub(super) fn apart(&self, axis: usize) -> f64 {
        let kinematics = &self.setup.kinematics;
        let of = |on: bool, by: [f64; 3]| if on && axis < 3 { by[axis] } else { 0.0 };
        let by_hand = if axis == 2 { self.zero_moved } else { 0.0 };
        of(self.tip, kinematics.tip) + of(self.plane_set, kinematics.plane) + by_hand
    }

    fn bare(&self) -> bool {
        self.turn == super::Frame::NONE && self.slots.shift() == [0.0; 6] && self.beside.is_none()
    }

    /// The tip is kept where it is while rotary axes turn, or no longer.
    pub(super) fn use_tip(&mut self, on: bool) -> Result<(), Halt> {
        if on != self.tip {
            if self.plane_set || !self.bare() {
                return self.halt("the tip in a frame, or beside a contour");
            }
            self.tip = on;
            self.settled[..3].fill(false);
        }
        Ok(())
    }

    /// A plane in space.
    pub(super) fn set_plane(&mut self, zero: [f64; 3], turns: [(usize, f64); 3]) -> Result<(), Halt> {
        if self.plane_set || self.tip || !self.bare() {
            return self.halt("a plane in a plane, in a frame, under the tip or beside a contour");
        }
        self.plane_set = true;
        self.settled[..3].fill(false);
        let [x, y, z] = turned(turns);
        self.record(What::Plane(Some([zero, x, y, z])));
        Ok(())
    }

    /// No plane any more.
    pub(super) fn leave_plane(&mut self) -> Result<(), Halt> {
        if self.plane_set {
            self.plane_set = false;
            self.settled[..3].fill(false);
            self.record(What::Plane(None));
        }
        Ok(())
    }

    /// The tool is turned upright on it.
    pub(super) fn stand_upright(&mut self) -> Result<(), Halt> {
        if !self.plane_set || self.beside.is_some() {
            return self.halt("the tool turned onto no plane, or beside a contour");
        }
        if let Some(rotary) = self.setup.kinematics.upright {
            self.at[3..].copy_from_slice(&rotary);
        }
        self.settled[3..].fill(false);
        self.record(What::Upright);
        Ok(())
    }
}
