//! How LinuxCNC reads points by distance and angle: `@` and `^`.

use super::{Control, Words};
use crate::Halt;

impl Control {
    /// Axis words with X and Y in place of @ and ^, distance and angle about the zero in force: as they are,
    /// or added to those of where the tool stands. A missing one is as there.
    pub(super) fn with_polar(
        &self,
        words: &Words,
        mut axes: [Option<f64>; 6],
        machine: bool,
    ) -> Result<[Option<f64>; 6], Halt> {
        let (length, angle) = (words.get('@').map(|length| length * self.unit()), words.get('^'));
        if length.is_none() && angle.is_none() {
            return Ok(axes);
        }
        if self.m.plane != 17 || machine || axes[0].is_some() || axes[1].is_some() {
            return self.m.halt("@ or ^ in another plane, with G53, or beside X or Y");
        }
        let [x, y, ..] = self.here();
        let (now_length, now_angle) = (x.hypot(y), y.atan2(x).to_degrees());
        if now_length < 1e-9 && (!self.m.absolute || length.is_none() || angle.is_none()) {
            return self.m.halt("@ or ^ counted from the zero itself");
        }
        let (length, angle) = match self.m.absolute {
            true => (length.unwrap_or(now_length), angle.unwrap_or(now_angle)),
            false => (now_length + length.unwrap_or(0.0), now_angle + angle.unwrap_or(0.0)),
        };
        let (sin, cos) = angle.to_radians().sin_cos();
        let to = [length * cos, length * sin];
        axes[0] = Some(if self.m.absolute { to[0] } else { to[0] - x });
        axes[1] = Some(if self.m.absolute { to[1] } else { to[1] - y });
        Ok(axes)
    }
}
