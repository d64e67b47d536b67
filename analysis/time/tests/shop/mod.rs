//! Machines and paths for tests, made by hand.
#![allow(dead_code)] // Each test file uses some.

use ncc_exec::{Attribute, Event, Kind, State};
use ncc_ir::canon::{AXES, Plane, Spindle, Turn};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::source::Span;
use ncc_time::{Act, AxisFacts, Clock, Machine, Model, Place, Timed, WHOLE_PATH};

/// Nanos of a number.
pub(crate) fn nanos(x: f64) -> Nanos {
    (x * ONE as f64).round() as Nanos
}

/// A machine whose linear axes are alike: mm/min, mm/s², mm/s³; rotary axes are fast.
pub(crate) fn machine(rapid: f64, acceleration: f64, jerk: f64, tolerance: f64) -> Machine {
    let axis = |k: f64| AxisFacts {
        rapid_rate: Some(rapid * k),
        acceleration: Some(acceleration * k),
        jerk: Some(jerk * k),
        ..AxisFacts::default()
    };
    Machine {
        axes: [axis(1.0), axis(1.0), axis(1.0), axis(10.0), axis(10.0), axis(10.0)],
        path_tolerance: Some(tolerance),
        exact_stop: Some(false),
        look_ahead: Some(WHOLE_PATH),
        tool_change: Some(5.0),
        spindle_start: Some(2.0),
        spindle_stop: Some(2.0),
        m_function: Some(0.0),
        block: Some(0.0),
        ..Machine::default()
    }
}

/// A path that is being made.
#[derive(Clone)]
pub(crate) struct Way {
    pub(crate) acts: Vec<Act>,
    pub(crate) at: [Nanos; AXES],
    pub(crate) state: State,
}

impl std::fmt::Debug for Way {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        for act in &self.acts {
            let end = act.event.end.map(|x| x as f64 / ONE as f64);
            write!(f, "{:?} F{} {:?}; ", act.event.kind, act.event.rate as f64 / ONE as f64, &end[..3])?;
        }
        Ok(())
    }
}

impl Way {
    pub(crate) fn new() -> Way {
        Way { acts: Vec::new(), at: [0; AXES], state: State::default() }
    }

    fn put(&mut self, kind: Kind, end: [Nanos; AXES], rate: f64) -> &mut Way {
        let span = Span::default();
        let event = Event { kind, end, rate: nanos(rate), state: self.state, inch: false, span };
        self.acts.push(Act {
            event,
            from: self.at,
            program_from: self.at,
            program_to: end,
            cut_offset: None,
            place: Place::default(),
        });
        self.at = end;
        self
    }

    fn target(&self, to: &[f64]) -> [Nanos; AXES] {
        let mut end = self.at;
        for (end, to) in end.iter_mut().zip(to) {
            *end = nanos(*to);
        }
        end
    }

    /// Straight at a feed, mm/min, to X Y Z A B C as many as are given.
    pub(crate) fn feed(&mut self, rate: f64, to: &[f64]) -> &mut Way {
        let end = self.target(to);
        self.put(Kind::Feed, end, rate)
    }

    pub(crate) fn rapid(&mut self, to: &[f64]) -> &mut Way {
        let end = self.target(to);
        self.put(Kind::Traverse, end, 0.0)
    }

    /// Counter-clockwise in X Y about a centre, to X Y Z; where it ends in its start, a whole circle.
    pub(crate) fn arc(&mut self, rate: f64, centre: [f64; 2], to: &[f64]) -> &mut Way {
        self.turn(rate, Turn::Counterclockwise, Plane::Xy, centre, to)
    }

    pub(crate) fn turn(
        &mut self,
        rate: f64,
        turn: Turn,
        plane: Plane,
        centre: [f64; 2],
        to: &[f64],
    ) -> &mut Way {
        let end = self.target(to);
        let (f, s, _) = plane.axes();
        let same = |axis: usize| end[axis] == self.at[axis];
        let full = same(f as usize) && same(s as usize);
        let centre = centre.map(nanos);
        self.put(Kind::Arc { plane, turn, full, centre }, end, rate)
    }

    /// Something that is no move.
    pub(crate) fn say(&mut self, kind: Kind) -> &mut Way {
        let at = self.at;
        self.put(kind, at, 0.0)
    }

    pub(crate) fn dwell(&mut self, seconds: f64) -> &mut Way {
        self.say(Kind::Dwell(nanos(seconds)))
    }

    pub(crate) fn spindle(&mut self, spindle: Spindle) -> &mut Way {
        self.state.spindle = spindle;
        self.say(Kind::Attribute(match spindle {
            Spindle::Stopped => Attribute::StopSpindle,
            turning => Attribute::StartSpindle(turning),
        }))
    }

    pub(crate) fn speed(&mut self, speed: f64) -> &mut Way {
        self.state.speed = nanos(speed);
        self.say(Kind::Attribute(Attribute::SpindleSpeed(nanos(speed))))
    }

    /// The same places, from the end to the start; of straight moves.
    pub(crate) fn reversed(&self) -> Way {
        let mut back = Way { acts: Vec::new(), at: self.at, state: self.state };
        for act in self.acts.iter().rev() {
            let (kind, end) = (act.event.kind.clone(), act.from);
            let rate = act.event.rate as f64 / ONE as f64;
            back.put(kind, end, rate);
        }
        back
    }
}

/// What became of a path.
pub(crate) struct Run {
    pub(crate) timed: Vec<Timed>,
    pub(crate) seconds: f64,
    pub(crate) bounds: (f64, f64),
    pub(crate) most_waiting: usize,
}

pub(crate) fn run(model: Model, machine: &Machine, acts: &[Act]) -> Run {
    let mut clock = Clock::new(model, machine.clone());
    let mut timed = Vec::new();
    for act in acts {
        clock.push(act.clone());
        timed.extend_from_slice(clock.certain());
        clock.forget();
    }
    clock.finish();
    timed.extend_from_slice(clock.certain());
    assert_eq!(timed.len(), acts.len(), "every function comes out once");
    let mut now = 0.0;
    for (i, (timed, act)) in timed.iter().zip(acts).enumerate() {
        assert_eq!((&timed.act, timed.n), (act, i as u64 + 1), "in order");
        assert!(close(timed.start, now, 1e-12), "{} starts when the last one ends", timed.n);
        now = timed.end();
    }
    Run { seconds: clock.now(), bounds: clock.bounds(), most_waiting: clock.most_waiting(), timed }
}

pub(crate) fn seconds(model: Model, machine: &Machine, way: &Way) -> f64 {
    run(model, machine, &way.acts).seconds
}

/// Whether two numbers are the same to so much of them.
pub(crate) fn close(a: f64, b: f64, relative: f64) -> bool {
    (a - b).abs() <= relative * a.abs().max(b.abs()).max(1e-9)
}

#[track_caller]
pub(crate) fn same(a: f64, b: f64, relative: f64) {
    assert!(close(a, b, relative), "{a} is not {b} to {relative:e}");
}
