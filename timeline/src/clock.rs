//! The clock: functions go in, and come out with their time.

use crate::act::Act;
use crate::ideal;
use crate::machine::Machine;

/// A model of how long things take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// The case study's: rates and fixed times, no acceleration.
    #[default]
    Ideal,
}

/// A function with its time.
#[derive(Clone, Debug, PartialEq)]
pub struct Timed {
    /// The function.
    pub act: Act,
    /// Its number; the first is 1.
    pub n: u64,
    /// Seconds from the program's start to its own.
    pub start: f64,
    /// Seconds that it takes.
    pub duration: f64,
}

impl Timed {
    /// Seconds from the program's start to its end: the stamp of the case study.
    pub fn end(&self) -> f64 {
        self.start + self.duration
    }
}

/// A clock that runs with a program.
#[derive(Clone, Debug)]
pub struct Clock {
    machine: Machine,
    now: f64,
    n: u64,
}

impl Clock {
    /// A clock at zero.
    pub fn new(model: Model, machine: Machine) -> Clock {
        let Model::Ideal = model;
        Clock { machine, now: 0.0, n: 0 }
    }

    /// Takes the next function; those whose time is certain now are pushed to `out`, in order.
    pub fn push(&mut self, act: Act, out: &mut Vec<Timed>) {
        self.n += 1;
        let duration = ideal::duration(&act, &self.machine);
        let start = self.now;
        self.now += duration;
        out.push(Timed { act, n: self.n, start, duration });
    }

    /// The program is over: all the rest is pushed to `out`.
    pub fn finish(&mut self, _out: &mut Vec<Timed>) {}

    /// Seconds since the start.
    pub fn now(&self) -> f64 {
        self.now
    }
}
