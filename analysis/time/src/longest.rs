//! The longest time of a program: with a full stop after every move.
//!
//! It is the upper one of [`Clock::bounds`](crate::Clock::bounds), for somebody whose own clock knows no acceleration:
//! nothing has to wait for what follows, and no speed in corners is found.

use crate::act::Act;
use crate::fixed::{fixed, turning};
use crate::limits::Limits;
use crate::machine::Machine;
use crate::model::Model;
use crate::ramp::stop_to_stop;

/// Counts the longest time.
#[derive(Clone, Debug)]
pub struct Longest {
    machine: Machine,
    limits: Limits,
    /// Speed of the spindle, rev/min, signed.
    spindle: f64,
    seconds: f64,
}

impl Longest {
    /// On a machine, with the values of [`Machine::assumed`] for what it does not state.
    pub fn new(machine: Machine) -> Longest {
        let machine = machine.assumed(Model::Trapezoidal).0;
        Longest { limits: Limits::new(&machine, false), machine, spindle: 0.0, seconds: 0.0 }
    }

    /// Takes the next function.
    pub fn push(&mut self, act: &Act) {
        if let Some(movement) = self.limits.movement(act) {
            self.seconds += stop_to_stop(&movement.leg);
            return;
        }
        self.seconds += fixed(act, &self.machine, self.spindle).seconds;
        self.spindle = turning(&act.event, &self.machine);
    }

    /// Seconds of all functions that went in.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }
}
