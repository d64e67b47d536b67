//! How the speed goes along one move.

/// Speed over time of a move: it goes from `entry` to `peak`, stays, and goes to `exit`. All zero for
/// what is no move. A ramp is straight, or a part of an S that may go on in the moves beside it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Profile {
    /// Speed at its start, mm/s (degrees a second of rotary axes alone).
    pub entry: f64,
    /// Highest speed, mm/s.
    pub peak: f64,
    /// Speed at its end, mm/s.
    pub exit: f64,
    /// Seconds from entry to peak.
    pub t_accel: f64,
    /// Seconds at the peak.
    pub t_cruise: f64,
    /// Seconds from the peak to the exit.
    pub t_decel: f64,
}

impl Profile {
    /// Seconds of the whole.
    pub fn duration(&self) -> f64 {
        self.t_accel + self.t_cruise + self.t_decel
    }

    /// At one speed all the way.
    pub(crate) fn constant(length: f64, seconds: f64) -> Profile {
        let speed = if seconds > 0.0 { length / seconds } else { 0.0 };
        Profile { entry: speed, peak: speed, exit: speed, t_accel: 0.0, t_cruise: seconds, t_decel: 0.0 }
    }
}
