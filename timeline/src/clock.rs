//! The clock: functions go in, and come out with their time.

use std::collections::VecDeque;
use std::str::FromStr;

use ncc_ir::exec::Kind;

use crate::act::Act;
use crate::fixed::{fixed, turning};
use crate::ideal;
use crate::junction::Junctions;
use crate::limits::{Leg, Limits};
use crate::machine::Machine;
use crate::path::path;
use crate::plan::Plan;
use crate::profile::Profile;
use crate::ramp::stop_to_stop;
use crate::smooth::Smooth;

/// A model of how long things take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Model {
    /// The case study's: rates and fixed times, no acceleration.
    #[default]
    Ideal,
    /// Rates and accelerations of each axis, speed in corners by the path tolerance, look-ahead over
    /// the whole path.
    Trapezoidal,
    /// The same, with acceleration built up by each axis' jerk.
    JerkLimited,
}

impl Model {
    /// All models.
    pub const ALL: [Model; 3] = [Model::Ideal, Model::Trapezoidal, Model::JerkLimited];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Model::Ideal => "ideal",
            Model::Trapezoidal => "trapezoidal",
            Model::JerkLimited => "jerk-limited",
        }
    }
}

/// No model has this name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownModel(pub String);

impl std::fmt::Display for UnknownModel {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let names = Model::ALL.map(Model::name).join(", ");
        write!(f, "no model is called {:?}; there are {names}", self.0)
    }
}

impl std::error::Error for UnknownModel {}

impl FromStr for Model {
    type Err = UnknownModel;

    fn from_str(name: &str) -> Result<Model, UnknownModel> {
        let found = Model::ALL.into_iter().find(|model| model.name() == name);
        found.ok_or_else(|| UnknownModel(name.to_owned()))
    }
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
    /// How the speed goes, where it is a move.
    pub profile: Profile,
}

impl Timed {
    /// Seconds from the program's start to its end: the stamp of the case study.
    pub fn end(&self) -> f64 {
        self.start + self.duration
    }
}

/// The look-ahead of a model.
#[derive(Clone, Debug)]
enum Planner {
    /// None.
    Ideal,
    Trapezoidal(Plan),
    JerkLimited(Smooth),
}

impl Planner {
    fn push(&mut self, leg: Leg, out: &mut impl FnMut(Profile)) {
        match self {
            Planner::Ideal => {}
            Planner::Trapezoidal(plan) => plan.push(leg, out),
            Planner::JerkLimited(plan) => plan.push(leg, out),
        }
    }

    fn stop(&mut self, out: &mut impl FnMut(Profile)) {
        match self {
            Planner::Ideal => {}
            Planner::Trapezoidal(plan) => plan.stop(out),
            Planner::JerkLimited(plan) => plan.stop(out),
        }
    }
}

/// Gives functions their times, in order.
#[derive(Clone, Debug)]
struct Stamp {
    now: f64,
    n: u64,
}

impl Stamp {
    fn put(&mut self, act: Act, duration: f64, profile: Profile, out: &mut Vec<Timed>) {
        self.n += 1;
        let start = self.now;
        self.now += duration;
        out.push(Timed { act, n: self.n, start, duration, profile });
    }
}

/// A clock that runs with a program.
#[derive(Clone, Debug)]
pub struct Clock {
    machine: Machine,
    limits: Limits,
    junctions: Junctions,
    planner: Planner,
    /// Functions of the path whose time is not certain yet.
    waiting: VecDeque<Act>,
    most_waiting: usize,
    stamp: Stamp,
    /// Speed of the spindle, rev/min, signed.
    spindle: f64,
    lower: f64,
    upper: f64,
}

impl Clock {
    /// A clock at zero. Where a model with acceleration needs what the machine does not state, it
    /// takes the value of [`Machine::assumed`], whose list the caller tells the user.
    pub fn new(model: Model, machine: Machine) -> Clock {
        let machine = match model {
            Model::Ideal => machine,
            Model::Trapezoidal | Model::JerkLimited => machine.assumed(model).0,
        };
        let limits = Limits::new(&machine, model == Model::JerkLimited);
        let planner = match model {
            Model::Ideal => Planner::Ideal,
            Model::Trapezoidal => Planner::Trapezoidal(Plan::default()),
            Model::JerkLimited => Planner::JerkLimited(Smooth::new(limits.softest())),
        };
        Clock {
            limits,
            junctions: Junctions::new(
                machine.path_tolerance.unwrap_or(0.0),
                machine.exact_stop.unwrap_or(false),
            ),
            planner,
            machine,
            waiting: VecDeque::new(),
            most_waiting: 0,
            stamp: Stamp { now: 0.0, n: 0 },
            spindle: 0.0,
            lower: 0.0,
            upper: 0.0,
        }
    }

    /// Takes the next function; those whose time is certain now are pushed to `out`, in order.
    pub fn push(&mut self, act: Act, out: &mut Vec<Timed>) {
        if matches!(self.planner, Planner::Ideal) {
            let duration = ideal::duration(&act, &self.machine);
            let profile = match &act.event.kind {
                Kind::Traverse | Kind::Feed | Kind::Arc { .. } => {
                    Profile::constant(path(&act.event, &act.from).length, duration)
                }
                _ => Profile::default(),
            };
            self.stamp.put(act, duration, profile, out);
            return;
        }
        let Clock { limits, junctions, planner, waiting, stamp, .. } = self;
        if let Some(movement) = limits.movement(&act) {
            let leg = &movement.leg;
            self.lower += leg.length / leg.speed;
            self.upper += stop_to_stop(leg);
            waiting.push_back(act);
            let mut certain = |profile: Profile| certain(profile, waiting, stamp, out);
            junctions.push(&movement, limits, |leg| planner.push(leg, &mut certain));
            self.most_waiting = self.most_waiting.max(self.waiting.len());
            return;
        }
        let time = fixed(&act, &self.machine, self.spindle);
        self.spindle = turning(&act.event.state, &self.machine);
        self.lower += time.seconds;
        self.upper += time.seconds;
        if time.stops {
            self.finish(out);
        }
        if self.waiting.is_empty() {
            self.stamp.put(act, time.seconds, Profile::default(), out);
        } else {
            let Clock { junctions, planner, waiting, stamp, .. } = self;
            waiting.push_back(act);
            let mut certain = |profile: Profile| certain(profile, waiting, stamp, out);
            junctions.instant(|leg| planner.push(leg, &mut certain));
        }
    }

    /// The program is over: all the rest is pushed to `out`.
    pub fn finish(&mut self, out: &mut Vec<Timed>) {
        let Clock { junctions, planner, waiting, stamp, .. } = self;
        let mut certain = |profile: Profile| certain(profile, waiting, stamp, out);
        junctions.stop(|leg| planner.push(leg, &mut certain));
        planner.stop(&mut certain);
    }

    /// Seconds from the start to the end of the last function that came out.
    pub fn now(&self) -> f64 {
        self.stamp.now
    }

    /// Seconds of all functions that went in, at least and at most: at their rates without any
    /// acceleration, and with a full stop after every move; fixed times are the same in both. The
    /// `ideal` model knows no acceleration: both are its time.
    pub fn bounds(&self) -> (f64, f64) {
        match self.planner {
            Planner::Ideal => (self.stamp.now, self.stamp.now),
            Planner::Trapezoidal(_) | Planner::JerkLimited(_) => (self.lower, self.upper),
        }
    }

    /// The greatest number of functions that had to wait for what followed.
    pub fn most_waiting(&self) -> usize {
        self.most_waiting
    }
}

/// The time of the first that waits is certain.
fn certain(profile: Profile, waiting: &mut VecDeque<Act>, stamp: &mut Stamp, out: &mut Vec<Timed>) {
    if let Some(act) = waiting.pop_front() {
        stamp.put(act, profile.duration(), profile, out);
    }
}
