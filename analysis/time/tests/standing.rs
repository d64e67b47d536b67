//! What is no move: times, what stops the path, and what is assumed.

mod shop;

use ncc_exec::{Attribute, Kind};
use ncc_ir::canon::{Axis, Spindle};
use ncc_time::{Clock, Fact, Longest, Machine, Model, ToolChangeOn};
use shop::{Way, machine, nanos, run, same, seconds};

const TRAPEZOIDAL: Model = Model::Trapezoidal;

fn plain() -> Machine {
    machine(30_000.0, 1000.0, 1e6, 0.01)
}

/// Seconds of each function.
fn durations(m: &Machine, way: &Way) -> Vec<f64> {
    run(TRAPEZOIDAL, m, &way.acts).timed.iter().map(|t| t.duration).collect()
}

#[test]
fn what_stops_the_path_and_what_is_carried_out_on_the_fly() {
    let through = |kind: Kind| {
        let mut way = Way::new();
        way.state.speed = nanos(1000.0);
        way.state.spindle = Spindle::Clockwise;
        way.spindle(Spindle::Clockwise).feed(6e3, &[50.0]).say(kind).feed(6e3, &[100.0]);
        run(TRAPEZOIDAL, &plain(), &way.acts).timed[1].profile.exit
    };
    let message = Kind::Message("x".into());
    for kind in [
        Kind::Attribute(Attribute::FeedRate(nanos(6e3))),
        Kind::Attribute(Attribute::SelectTool(2)),
        Kind::Attribute(Attribute::Hole),
        Kind::Attribute(Attribute::Remark),
        // The speed that it has.
        Kind::Attribute(Attribute::SpindleSpeed(nanos(1000.0))),
        message,
    ] {
        same(through(kind), 100.0, 1e-12);
    }
    for kind in [
        Kind::Dwell(0),
        Kind::ToolChange,
        Kind::Coolant,
        Kind::ProgramStop,
        Kind::OptionalProgramStop,
        Kind::ProgramEnd,
        Kind::Attribute(Attribute::StartSpindle(Spindle::Clockwise)),
        Kind::Attribute(Attribute::StopSpindle),
    ] {
        assert_eq!(through(kind), 0.0);
    }
}

#[test]
fn fixed_times() {
    let mut m = plain();
    m.m_function = Some(0.1);
    let mut way = Way::new();
    way.dwell(1.5)
        .say(Kind::ToolChange)
        .spindle(Spindle::Clockwise)
        .spindle(Spindle::Stopped)
        .say(Kind::Coolant)
        .say(Kind::ProgramStop)
        .say(Kind::Attribute(Attribute::SelectTool(1)))
        .say(Kind::ProgramEnd)
        .say(Kind::TextEnd);
    m.functions = vec![("clamp".to_owned(), 0.7)];
    way.say(Kind::MachineFunction("clamp".into())).say(Kind::MachineFunction("unclamp".into()));
    let want = [1.5, 5.1, 2.1, 2.1, 0.1, 0.1, 0.0, 0.1, 0.0, 0.7, 0.1];
    for (got, want) in durations(&m, &way).iter().zip(want) {
        same(*got, want, 1e-12);
    }
    m.tool_change_on = ToolChangeOn::Select;
    let got = durations(&m, &way);
    same(got[1], 0.1, 1e-12);
    same(got[6], 5.0, 1e-12);
    // Standing still, nothing is between the bounds.
    let got = run(TRAPEZOIDAL, &m, &way.acts);
    same(got.bounds.0, got.seconds, 1e-12);
    same(got.bounds.1, got.seconds, 1e-12);
}

#[test]
fn the_spindle_by_its_acceleration() {
    let mut m = plain();
    m.spindle_acceleration = Some(2000.0);
    m.spindle_max = Some(6000.0);
    let mut way = Way::new();
    way.speed(1000.0) // It stands.
        .spindle(Spindle::Clockwise)
        .speed(3000.0)
        .speed(3000.0)
        .spindle(Spindle::Counterclockwise)
        .speed(9000.0) // At most 6000.
        .spindle(Spindle::Stopped)
        .spindle(Spindle::Clockwise);
    let want = [0.0, 0.5, 1.0, 0.0, 3.0, 1.5, 3.0, 3.0];
    let got = durations(&m, &way);
    assert_eq!(got.len(), want.len());
    for (got, want) in got.iter().zip(want) {
        same(*got, want, 1e-12);
    }
}

#[test]
fn a_move_that_goes_nowhere_is_nothing() {
    let way = Way::new().feed(6e3, &[50.0]).feed(6e3, &[50.0]).feed(6e3, &[100.0]).clone();
    let line = Way::new().feed(6e3, &[100.0]).clone();
    same(seconds(TRAPEZOIDAL, &plain(), &way), seconds(TRAPEZOIDAL, &plain(), &line), 1e-12);
    assert_eq!(durations(&plain(), &way)[1], 0.0);
}

#[test]
fn models_have_names() {
    for model in Model::ALL {
        assert_eq!(model.name().parse(), Ok(model));
    }
    let fault = "soft".parse::<Model>().unwrap_err();
    assert!(fault.to_string().contains("jerk-limited"), "{fault}");
}

#[test]
fn what_is_taken_for_granted_is_told_and_used() {
    let nothing = Machine::default();
    let way = Way::new().rapid(&[300.0]).feed(1.2e3, &[300.0, 60.0]).say(Kind::ToolChange).clone();
    for model in Model::ALL {
        let (full, told) = nothing.assumed(model);
        assert!(!told.is_empty());
        // Told once, each with a value that counts, and then complete.
        assert_eq!(full.assumed(model), (full.clone(), Vec::new()));
        for fact in &told {
            assert!(fact.value.is_finite() && fact.value >= 0.0, "{fact:?}");
            assert!(!fact.fact.name().is_empty());
        }
        let keys: std::collections::HashSet<_> =
            told.iter().map(|t| (t.fact, t.axis.map(Axis::letter))).collect();
        assert_eq!(keys.len(), told.len());
        same(seconds(model, &full, &way), seconds(model, &full.assumed(model).0, &way), 1e-12);
        if model != Model::Ideal {
            same(seconds(model, &nothing, &way), seconds(model, &full, &way), 1e-12);
        }
    }
    let facts =
        |model: Model, fact: Fact| nothing.assumed(model).1.iter().filter(|told| told.fact == fact).count();
    assert_eq!(facts(Model::Trapezoidal, Fact::Acceleration), 6);
    assert_eq!(facts(Model::Trapezoidal, Fact::Jerk), 0);
    assert_eq!(facts(Model::JerkLimited, Fact::Jerk), 6);
    // What a machine states is not touched.
    let (full, told) = plain().assumed(Model::JerkLimited);
    assert_eq!((full, told), (plain(), Vec::new()));
}

/// The longest time is, to the last bit, the upper one of a clock with acceleration.
#[test]
fn the_longest_time_is_that_of_a_clock_with_acceleration() {
    let mut way = Way::new();
    way.state.speed = nanos(1000.0);
    way.spindle(Spindle::Clockwise).feed(6e3, &[50.0]);
    for at in 1..50 {
        let at = f64::from(at);
        way.feed(600.0 * at, &[at, at * at, 3.0 - at]).say(Kind::Dwell(nanos(at / 7.0)));
        way.spindle(if at % 2.0 == 0.0 { Spindle::Stopped } else { Spindle::Counterclockwise });
        way.say(Kind::Coolant).feed(100.0, &[at, at * at, 3.0 - at]).say(Kind::ToolChange);
    }
    let stops = Machine { spindle_start: Some(2.0), tool_change: Some(5.0), ..plain() };
    let turns = Machine { spindle_acceleration: Some(100.0), ..plain() };
    for m in [plain(), stops, turns, Machine::default()] {
        let (mut clock, mut longest) = (Clock::new(TRAPEZOIDAL, m.clone()), Longest::new(m));
        for act in &way.acts {
            clock.push(act.clone());
            longest.push(act);
        }
        assert!(longest.seconds() > 0.0);
        assert_eq!(clock.bounds().1.to_bits(), longest.seconds().to_bits());
    }
}
