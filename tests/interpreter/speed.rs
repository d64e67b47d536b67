//! What the speed of the spindle counts.

use super::Machine;

impl Machine {
    /// From here on a speed is a surface's, or turns. The number before means nothing then.
    pub fn count_speed(&mut self, surface: bool) {
        if surface != self.surface {
            self.speed = None;
        }
        self.surface = surface;
    }

    /// A speed as it is written: turns, metres of a surface, or feet of it.
    pub fn say_speed(&mut self, number: f64) {
        let metres = if self.surface && self.inch { 12.0 * 0.0254 } else { 1.0 };
        self.speed = Some(number * metres);
    }
}
