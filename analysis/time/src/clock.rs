//! The clock: functions go in, and have their time as soon as it is certain.
//!
//! They stay where they were put until the caller has done with them: copying one costs as much as a
//! good part of its planning.

use crate::act::Act;
use crate::ahead::Ahead;
use crate::assumed::WHOLE_PATH;
use crate::corner::Corners;
use crate::fixed::{fixed, turning};
use crate::ideal;
use crate::junction::Junctions;
use crate::limits::{Leg, Limits};
use crate::machine::Machine;
use crate::model::Model;
use crate::path::path;
use crate::plan::Plan;
use crate::profile::Profile;
use crate::queue::Queue;
use crate::ramp::stop_to_stop;
use crate::smooth::Smooth;

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

/// Hands a leg to the planner, as far ahead as the control looks.
#[inline]
fn planned(ahead: &mut Option<Ahead>, planner: &mut Planner, leg: Leg, out: &mut impl FnMut(Profile)) {
    match ahead {
        None => planner.push(leg, out),
        Some(ahead) => ahead.push(leg, &mut |leg| planner.push(leg, out)),
    }
}

/// Functions in order; those that have their time stand first.
#[derive(Clone, Debug)]
struct Row {
    queue: Queue<Timed>,
    /// How many of them have their time.
    certain: usize,
    /// Number of the last that went in.
    n: u64,
    /// Seconds from the start to the end of the last that has its time.
    now: f64,
}

impl Row {
    /// One whose time is not known yet.
    fn push(&mut self, act: Act) {
        self.n += 1;
        self.queue.push(Timed { act, n: self.n, start: 0.0, duration: 0.0, profile: Profile::default() });
    }

    /// The time of the first that has none.
    fn settle(&mut self, duration: f64, profile: Profile) {
        if let Some(timed) = self.queue.all().get_mut(self.certain) {
            timed.start = self.now;
            timed.duration = duration;
            timed.profile = profile;
            self.now += duration;
            self.certain += 1;
        }
    }

    fn waiting(&self) -> usize {
        self.queue.len() - self.certain
    }
}

/// A clock that runs with a program.
#[derive(Clone, Debug)]
pub struct Clock {
    machine: Machine,
    limits: Limits,
    corners: Corners,
    junctions: Junctions,
    /// Where the control knows only some blocks of the path.
    ahead: Option<Ahead>,
    planner: Planner,
    row: Row,
    most_waiting: usize,
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
            corners: Corners::new(&machine),
            junctions: Junctions::default(),
            ahead: machine.look_ahead.filter(|blocks| *blocks != WHOLE_PATH).map(Ahead::new),
            planner,
            machine,
            row: Row { queue: Queue::default(), certain: 0, n: 0, now: 0.0 },
            most_waiting: 0,
            spindle: 0.0,
            lower: 0.0,
            upper: 0.0,
        }
    }

    /// Takes the next function; [`Clock::certain`] has those whose time is certain now.
    pub fn push(&mut self, act: Act) {
        let Clock { machine, limits, corners, junctions, ahead, planner, row, .. } = self;
        if matches!(planner, Planner::Ideal) {
            let way = path(&act.event, &act.from);
            let duration = ideal::duration(&act, &way, machine);
            let profile = match act.event.kind.moves() {
                Some(_) => Profile::constant(way.length, duration),
                None => Profile::default(),
            };
            row.push(act);
            row.settle(duration, profile);
            return;
        }
        if let Some(movement) = limits.movement(&act) {
            let leg = &movement.leg;
            self.lower += leg.length / leg.speed;
            self.upper += stop_to_stop(leg);
            let end = corners.of(&act.event);
            row.push(act);
            let mut settle = |profile: Profile| row.settle(profile.duration(), profile);
            junctions.push(&movement, end, limits, |leg| planned(ahead, planner, leg, &mut settle));
            self.most_waiting = self.most_waiting.max(self.row.waiting());
            return;
        }
        let time = fixed(&act, machine, self.spindle);
        self.spindle = turning(&act.event, machine);
        self.lower += time.seconds;
        self.upper += time.seconds;
        if time.stops {
            self.finish();
        }
        let Clock { junctions, ahead, planner, row, .. } = self;
        row.push(act);
        if row.waiting() == 1 {
            row.settle(time.seconds, Profile::default());
        } else {
            let mut settle = |profile: Profile| row.settle(profile.duration(), profile);
            junctions.instant(|leg| planned(ahead, planner, leg, &mut settle));
        }
    }

    /// The program is over, or stops: the time of all functions is certain.
    pub fn finish(&mut self) {
        let Clock { junctions, ahead, planner, row, .. } = self;
        let mut settle = |profile: Profile| row.settle(profile.duration(), profile);
        junctions.stop(|leg| planned(ahead, planner, leg, &mut settle));
        if let Some(ahead) = ahead {
            ahead.stop(&mut |leg| planner.push(leg, &mut settle));
        }
        planner.stop(&mut settle);
    }

    /// Functions whose time is certain, in order, and that were not forgotten yet.
    pub fn certain(&mut self) -> &mut [Timed] {
        let certain = self.row.certain;
        self.row.queue.all().get_mut(..certain).unwrap_or_default()
    }

    /// Forgets the functions whose time is certain: the caller has done with them.
    pub fn forget(&mut self) {
        self.row.queue.drop_first(self.row.certain);
        self.row.certain = 0;
    }

    /// Seconds from the start to the end of the last function whose time is certain.
    pub fn now(&self) -> f64 {
        self.row.now
    }

    /// Seconds of all functions that went in, at least and at most: at their rates without any
    /// acceleration, and with a full stop after every move; fixed times are the same in both. The
    /// `ideal` model knows no acceleration: both are its time.
    pub fn bounds(&self) -> (f64, f64) {
        match self.planner {
            Planner::Ideal => (self.row.now, self.row.now),
            Planner::Trapezoidal(_) | Planner::JerkLimited(_) => (self.lower, self.upper),
        }
    }

    /// The greatest number of functions that had to wait for what followed.
    pub fn most_waiting(&self) -> usize {
        self.most_waiting
    }
}
