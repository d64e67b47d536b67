//! G16: radius and angle in place of the coordinates of the plane.

use super::super::{Halt, Place};
use super::{Control, Word};

impl Control {
    /// Where axis words lead. Under G16 those of the plane are a radius about the zero of the work
    /// offset, with its slots, and an angle; an angle under G91 is added to that of the point before.
    pub(super) fn place(&mut self, axes: [Option<f64>; 6], words: &[Word]) -> Result<Place, Halt> {
        let (first, second, _) = self.m.axes();
        let Some(last) = self.polar else { return self.m.target(axes) };
        let radius = axes[first];
        let angle = self.angle(words, ['X', 'Y', 'Z'][second]);
        if radius.is_none() && angle.is_none() {
            return self.m.target(axes);
        }
        let absolute = self.m.absolute;
        let others = (0..6).any(|axis| axis != first && axis != second && axes[axis].is_some());
        if !absolute && (radius.is_some() || others) {
            return self.m.halt("a polar radius, or another axis, under G91");
        }
        let (radius, angle) = match (radius, angle, last) {
            (Some(radius), Some(angle), _) => (radius, angle),
            (radius, Some(angle), Some(last)) => {
                (radius.unwrap_or(last.0), if absolute { angle } else { last.1 + angle })
            }
            (Some(radius), None, Some(last)) => (radius, last.1),
            _ => return self.m.halt("a polar word that counts from where the tool stands"),
        };
        if radius < 0.0 {
            return self.m.halt("a negative polar radius");
        }
        self.polar = Some(Some((radius, angle)));
        let mut axes = axes;
        axes[first] = Some(radius * angle.to_radians().cos());
        axes[second] = Some(radius * angle.to_radians().sin());
        self.m.absolute = true;
        let to = self.m.target(axes);
        self.m.absolute = absolute;
        to
    }
}
