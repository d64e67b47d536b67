//! The path mode that the program has active, and how far a control looks ahead.

mod shop;

use ncc_ir::canon::PathMode;
use ncc_time::{Machine, Model};
use shop::{Way, machine, run, same, seconds};

const TRAPEZOIDAL: Model = Model::Trapezoidal;

/// 1000 mm/s², corners within 0.01 mm where the program says nothing.
fn plain() -> Machine {
    machine(30_000.0, 1000.0, 1e6, 0.01)
}

/// Seconds of a straight line from rest to rest.
fn alone(s: f64, v: f64) -> f64 {
    if s >= v * v / 1000.0 { s / v + v / 1000.0 } else { 2.0 * (s / 1000.0).sqrt() }
}

/// A square, its corners by a mode; lengths of the mode in mm.
fn square(mode: Option<PathMode>, within: f64) -> Way {
    let mut way = Way::new();
    way.state.path = mode;
    way.state.within = [(within * 1e4).round() as i32; 5];
    way.feed(6e3, &[40.0]).feed(6e3, &[40.0, 40.0]).feed(6e3, &[0.0, 40.0]).feed(6e3, &[0.0, 0.0]).clone()
}

#[test]
fn the_programs_mode_wins_over_the_machines() {
    let side = alone(40.0, 100.0);
    let by_machine = seconds(TRAPEZOIDAL, &plain(), &square(None, 0.0));
    let stops = Machine { exact_stop: Some(true), ..plain() };
    for machine in [plain(), stops] {
        let time = |mode, within| seconds(TRAPEZOIDAL, &machine, &square(Some(mode), within));
        same(time(PathMode::ExactStop, 0.0), 4.0 * side, 1e-12);
        same(time(PathMode::ExactPath, 0.0), 4.0 * side, 1e-12);
        // Without a length, as far as the machine rounds.
        same(time(PathMode::Continuous, 0.0), by_machine, 1e-12);
        same(time(PathMode::AxisTolerances, 0.0), by_machine, 1e-12);
        same(time(PathMode::Tolerance, 0.01), by_machine, 1e-9);
        assert!(time(PathMode::Tolerance, 1.0) < by_machine);
        assert!(time(PathMode::Distance, 1.0) < by_machine);
    }
}

#[test]
fn a_tolerance_and_a_distance_give_the_speed_in_the_corner() {
    let entry =
        |mode, within| run(TRAPEZOIDAL, &plain(), &square(Some(mode), within).acts).timed[1].profile.entry;
    // In a right angle the push is oblique: √2·1000 mm/s².
    let a = 2f64.sqrt() * 1000.0;
    let half = (45f64).to_radians();
    for tolerance in [0.05, 0.2, 1.0] {
        let want = (a * tolerance * half.sin() / (1.0 - half.sin())).sqrt();
        same(entry(PathMode::Tolerance, tolerance), want, 1e-7);
    }
    // A circle that touches both sides a distance from a right angle has that radius.
    for distance in [0.5, 1.0, 3.0] {
        same(entry(PathMode::Distance, distance), (a * distance).sqrt().min(100.0), 1e-7);
    }
    // A distance of nothing goes through the corner.
    same(entry(PathMode::Distance, 0.0), 0.0, 1e-12);
}

#[test]
fn a_mode_counts_for_the_end_of_its_move() {
    let mut way = Way::new();
    way.state.path = Some(PathMode::Continuous);
    way.feed(6e3, &[40.0]);
    way.state.path = Some(PathMode::ExactStop);
    way.feed(6e3, &[80.0]);
    way.state.path = Some(PathMode::Continuous);
    let way = way.feed(6e3, &[120.0]).clone();
    // Straight on: the first end is passed at full speed, at the second the axes stand.
    let got = run(TRAPEZOIDAL, &plain(), &way.acts);
    same(got.timed[1].profile.entry, 100.0, 1e-12);
    same(got.timed[1].profile.exit, 0.0, 1e-12);
    same(got.seconds, alone(80.0, 100.0) + alone(40.0, 100.0), 1e-12);
}

#[test]
fn rapids_have_a_length_of_their_own() {
    let mut way = Way::new();
    way.state.path = Some(PathMode::Distance);
    way.state.within = [0, 20_000, 0, 0, 0];
    let way =
        way.rapid(&[100.0]).rapid(&[100.0, 100.0]).feed(6e3, &[0.0, 100.0]).feed(6e3, &[0.0, 0.0]).clone();
    let got = run(TRAPEZOIDAL, &plain(), &way.acts);
    same(got.timed[1].profile.entry, (2f64.sqrt() * 1000.0 * 2.0).sqrt(), 1e-7);
    same(got.timed[3].profile.entry, 0.0, 1e-12);
}

/// Short blocks in a line.
fn short(count: u32, step: f64, feed: f64) -> Way {
    let mut way = Way::new();
    for i in 1..=count {
        way.feed(feed, &[f64::from(i) * step]);
    }
    way
}

#[test]
fn a_control_that_sees_few_blocks_is_no_faster_than_they_let_it_stop() {
    let whole = Machine { axes: machine(30_000.0, 300.0, 1e6, 0.01).axes, ..plain() };
    let limited = |blocks| Machine { look_ahead: Some(blocks), ..whole.clone() };
    let way = short(3000, 0.1, 9000.0);
    // v² = 2·a·s, s being the blocks that the control knows.
    for (blocks, step) in [(16u32, 0.1), (1, 0.1), (50, 0.02)] {
        let way = short(3000, step, 9000.0);
        let got = run(TRAPEZOIDAL, &limited(blocks), &way.acts);
        let v = (2.0 * 300.0 * f64::from(blocks) * step).sqrt();
        same(got.timed[1500].profile.entry, v, 1e-9);
        same(got.seconds, step_by_step(&way, 300.0, blocks as usize), 1e-9);
    }
    // Nothing is lost where all is seen, and less is never faster.
    let free = seconds(TRAPEZOIDAL, &whole, &way);
    same(seconds(TRAPEZOIDAL, &limited(3000), &way), free, 1e-12);
    same(free, 300.0 / 150.0 + 150.0 / 300.0, 1e-9);
    let mut last = f64::INFINITY;
    for blocks in [1, 2, 5, 16, 100, 500, 3000] {
        let time = seconds(TRAPEZOIDAL, &limited(blocks), &way);
        assert!(time <= last * (1.0 + 1e-12) && time >= free * (1.0 - 1e-12), "{blocks}");
        last = time;
    }
}

/// The plan of a control that knows so many blocks, block by block: each time the path ends with the last block known.
fn step_by_step(way: &Way, a: f64, blocks: usize) -> f64 {
    let length = |i: usize| {
        let act = &way.acts[i];
        act.event.end[0].abs_diff(act.from[0]) as f64 / 1e9
    };
    let feed = |i: usize| way.acts[i].event.rate as f64 / 60e9;
    let n = way.acts.len();
    let (mut v, mut time) = (0.0f64, 0.0);
    for i in 0..n {
        // The end of block i: from the stop behind the last block that is known, backwards.
        let last = (i + blocks).min(n - 1);
        let mut back = 0.0f64;
        for k in (i + 1..=last).rev() {
            let cap = feed(k - 1).min(feed(k));
            back = (back * back + 2.0 * a * length(k)).sqrt().min(cap);
        }
        let exit = back.min((v * v + 2.0 * a * length(i)).sqrt());
        let top = ((v * v + exit * exit) / 2.0 + a * length(i)).sqrt().min(feed(i));
        let ramps = (2.0 * top * top - v * v - exit * exit) / (2.0 * a);
        time += (2.0 * top - v - exit) / a + (length(i) - ramps).max(0.0) / top;
        v = exit;
    }
    time
}

#[test]
fn it_is_the_plan_of_a_control_that_forgets() {
    let mut random = fastrand::Rng::with_seed(5);
    for _ in 0..60 {
        let mut way = Way::new();
        let mut at = 0.0;
        for _ in 0..random.usize(2..80) {
            at += f64::from(random.u32(1..4000)) / 1000.0;
            way.feed(f64::from(random.u32(1..90) * 100), &[at]);
        }
        let blocks = random.u32(1..12);
        let machine = Machine { look_ahead: Some(blocks), ..plain() };
        let want = step_by_step(&way, 1000.0, blocks as usize);
        same(seconds(TRAPEZOIDAL, &machine, &way), want, 1e-9);
    }
}

#[test]
fn jerk_makes_it_slower_still() {
    for blocks in [1, 4, 16] {
        let machine = Machine { look_ahead: Some(blocks), ..machine(30_000.0, 1000.0, 10_000.0, 0.01) };
        let way = short(400, 0.5, 9000.0);
        let soft = seconds(Model::JerkLimited, &machine, &way);
        let hard = seconds(TRAPEZOIDAL, &machine, &way);
        assert!(soft > hard * 1.01, "{blocks}: {soft} {hard}");
        // Without any jerk worth the name, both are one.
        let stiff = Machine { axes: shop::machine(30_000.0, 1000.0, 1e12, 0.01).axes, ..machine };
        same(seconds(Model::JerkLimited, &stiff, &way), hard, 1e-4);
    }
}
