//! Model `trapezoidal` against formulae of textbooks, written out here.

mod shop;

use ncc_ir::canon::{Axis, Plane, Turn};
use ncc_time::{Fact, Machine, Model};
use shop::{Way, machine, run, same, seconds};
use std::f64::consts::{PI, TAU};

const TRAPEZOIDAL: Model = Model::Trapezoidal;

/// Seconds of a line: from one speed to another, at most `most`; mm, mm/s, mm/s².
fn line(length: f64, most: f64, a: f64, from: f64, to: f64) -> f64 {
    let peak = ((from * from + to * to) / 2.0 + a * length).sqrt();
    if peak <= most {
        return (2.0 * peak - from - to) / a;
    }
    let ramps = (2.0 * most * most - from * from - to * to) / (2.0 * a);
    (2.0 * most - from - to) / a + (length - ramps) / most
}

/// 1000 mm/s², 0.01 mm, 30 m/min.
fn plain() -> Machine {
    machine(30_000.0, 1000.0, 1e6, 0.01)
}

#[test]
fn single_moves() {
    // Feed mm/min, length: a trapezoid takes s/v + v/a, a triangle 2√(s/a).
    for (feed, length) in [(600.0, 0.001), (600.0, 0.05), (600.0, 50.0), (6000.0, 9.9), (6000.0, 10.1)] {
        let v: f64 = feed / 60.0;
        let want =
            if length > v * v / 1000.0 { length / v + v / 1000.0 } else { 2.0 * f64::sqrt(length / 1000.0) };
        same(seconds(TRAPEZOIDAL, &plain(), Way::new().feed(feed, &[length])), want, 1e-12);
    }
}

#[test]
fn each_axis_bears_its_share() {
    let mut m = plain();
    m.axes[1].acceleration = Some(200.0);
    m.axes[1].rapid_rate = Some(3_000.0);
    m.axes[2].rapid_rate = Some(60_000.0);
    // 3-4-5: Y has 0.8 of the move. 50 mm/s on Y are 62.5 along; 200 mm/s² are 250.
    let got = run(TRAPEZOIDAL, &m, &Way::new().rapid(&[30.0, 40.0]).acts);
    same(got.seconds, 50.0 / 62.5 + 62.5 / 250.0, 1e-12);
    same(got.timed[0].profile.peak, 62.5, 1e-12);
    // Z alone is faster than X.
    same(seconds(TRAPEZOIDAL, &m, Way::new().rapid(&[0.0, 0.0, 2000.0])), 2000.0 / 1000.0 + 1.0, 1e-12);
    // At feed an axis is no faster than in a rapid, nor than its own highest feed.
    same(run(TRAPEZOIDAL, &m, &Way::new().feed(9e4, &[0.0, 100.0]).acts).timed[0].profile.peak, 50.0, 1e-12);
    m.axes[1].max_feed = Some(1_200.0);
    same(run(TRAPEZOIDAL, &m, &Way::new().feed(9e4, &[0.0, 100.0]).acts).timed[0].profile.peak, 20.0, 1e-12);
    same(run(TRAPEZOIDAL, &m, &Way::new().rapid(&[0.0, 100.0]).acts).timed[0].profile.peak, 50.0, 1e-12);
}

#[test]
fn corners() {
    // Turn in degrees; its inner angle is θ = 180° − turn. The axes allow more than 1000 mm/s² where a
    // corner pushes obliquely: 1000 over the larger component of the direction of the push.
    for turn in [1.0, 10.0, 45.0, 90.0, 135.0, 179.0] {
        let radians: f64 = f64::to_radians(turn);
        let half = ((180.0 - turn) / 2.0f64).to_radians();
        let push = [-(radians / 2.0).sin(), (radians / 2.0).cos()];
        let a = 1000.0 / push[0].abs().max(push[1].abs());
        let v = (a * 0.01 * half.sin() / (1.0 - half.sin())).sqrt();
        let (s, feed) = (400.0, 18_000.0);
        let way = Way::new().feed(feed, &[s]).feed(feed, &[s + s * radians.cos(), s * radians.sin()]).clone();
        let got = run(TRAPEZOIDAL, &plain(), &way.acts);
        let v = v.min(300.0);
        same(got.timed[1].profile.entry, v, 1e-7);
        let oblique = 1000.0 / radians.cos().abs().max(radians.sin().abs());
        let want = line(s, 300.0, 1000.0, 0.0, v) + line(s, 300.0, oblique, v, 0.0);
        same(got.seconds, want, 1e-8);
    }
    // The figure itself once: a right angle at 1414 mm/s² and 0.01 mm is taken at 5.843 mm/s.
    let right = Way::new().feed(6e3, &[100.0]).feed(6e3, &[100.0, 100.0]).clone();
    same(run(TRAPEZOIDAL, &plain(), &right.acts).timed[1].profile.entry, 5.843, 1e-4);
}

#[test]
fn a_tolerance_of_nothing_stops_in_corners_only_and_exact_stop_everywhere() {
    let way = Way::new().feed(6e3, &[50.0]).feed(6e3, &[100.0]).feed(6e3, &[100.0, 50.0]).clone();
    let mut m = machine(30_000.0, 1000.0, 1e6, 0.0);
    same(
        seconds(TRAPEZOIDAL, &m, &way),
        line(100.0, 100.0, 1000.0, 0.0, 0.0) + line(50.0, 100.0, 1000.0, 0.0, 0.0),
        1e-12,
    );
    m.exact_stop = Some(true);
    same(seconds(TRAPEZOIDAL, &m, &way), 3.0 * line(50.0, 100.0, 1000.0, 0.0, 0.0), 1e-12);
}

#[test]
fn reversal_is_a_full_stop() {
    let way = Way::new().feed(6e3, &[50.0]).feed(6e3, &[20.0]).clone();
    let got = run(TRAPEZOIDAL, &plain(), &way.acts);
    same(got.seconds, line(50.0, 100.0, 1000.0, 0.0, 0.0) + line(30.0, 100.0, 1000.0, 0.0, 0.0), 1e-12);
    assert_eq!(got.timed[0].profile.exit, 0.0);
}

#[test]
fn a_change_of_feed_is_made_by_the_slower_side() {
    let way = Way::new().feed(6e3, &[50.0]).feed(1.2e3, &[100.0]).feed(6e3, &[150.0]).clone();
    let got = run(TRAPEZOIDAL, &plain(), &way.acts);
    let want = line(50.0, 100.0, 1000.0, 0.0, 20.0) + 50.0 / 20.0 + line(50.0, 100.0, 1000.0, 20.0, 0.0);
    same(got.seconds, want, 1e-12);
    same(got.timed[1].profile.t_cruise, 2.5, 1e-12);
}

#[test]
fn circles() {
    // Radius, feed mm/min, the speed that counts: √(1000·r), or the feed.
    for (r, feed, v) in [(10.0, 30_000.0, 100.0), (0.1, 30_000.0, 10.0), (10.0, 3_000.0, 50.0)] {
        let way = Way::new().feed(feed, &[r]).arc(feed, [0.0, 0.0], &[r]).clone();
        let got = run(TRAPEZOIDAL, &plain(), &way.acts);
        // It begins at the speed of the corner between the radius and the circle, and ends in a stop.
        let entry = got.timed[1].profile.entry;
        same(got.timed[1].profile.peak, v, 1e-12);
        same(got.timed[1].duration, line(TAU * r, v, 1000.0, entry, 0.0), 1e-9);
    }
    // From a tangent: nothing brakes at the junction but the arc's own speed.
    let r = 10.0;
    let way = Way::new()
        .feed(18e3, &[100.0])
        .arc(18e3, [100.0, r], &[100.0, 2.0 * r])
        .feed(18e3, &[0.0, 2.0 * r])
        .clone();
    let want = 2.0 * line(100.0, 300.0, 1000.0, 0.0, 100.0) + PI * r / 100.0;
    same(seconds(TRAPEZOIDAL, &plain(), &way), want, 1e-8);
}

#[test]
fn an_arc_goes_the_way_that_it_turns() {
    // A quarter one way is three quarters the other way.
    let r = 20.0;
    for plane in [Plane::Xy, Plane::Zx, Plane::Yz] {
        let (f, s, _) = plane.axes();
        for (turn, quarters) in [(Turn::Counterclockwise, 1.0), (Turn::Clockwise, 3.0)] {
            let (mut from, mut to) = ([0.0; 3], [0.0; 3]);
            (from[f as usize], to[s as usize]) = (r, r);
            let mut way = Way::new();
            way.rapid(&from).dwell(1.0).turn(3e3, turn, plane, [0.0, 0.0], &to);
            let got = run(TRAPEZOIDAL, &plain(), &way.acts).timed[2].duration;
            same(got, line(quarters * PI / 2.0 * r, 50.0, 1000.0, 0.0, 0.0), 1e-9);
        }
    }
}

#[test]
fn the_weaker_axis_of_the_plane_counts_on_an_arc_and_a_helix_is_as_curved_as_it_is() {
    let mut m = plain();
    m.axes[2].acceleration = Some(250.0);
    let r = 10.0;
    let arc = |plane: Plane, m: &Machine| {
        let (f, _, _) = plane.axes();
        let mut from = [0.0; 3];
        from[f as usize] = r;
        let mut way = Way::new();
        way.rapid(&from).dwell(1.0).turn(30e3, Turn::Clockwise, plane, [0.0, 0.0], &from);
        run(TRAPEZOIDAL, m, &way.acts).timed[2].profile.peak
    };
    same(arc(Plane::Xy, &m), 100.0, 1e-12);
    same(arc(Plane::Zx, &m), 50.0, 1e-12);
    same(arc(Plane::Yz, &m), 50.0, 1e-12);
    // A helix that rises as much as it goes round: the speed in the plane is 1/√2 of the path's.
    let mut way = Way::new();
    way.rapid(&[r]).dwell(1.0).arc(30e3, [0.0, 0.0], &[r, 0.0, TAU * r]);
    same(run(TRAPEZOIDAL, &plain(), &way.acts).timed[2].profile.peak, 100.0 * 2.0f64.sqrt(), 1e-9);
}

#[test]
fn a_train_of_short_chords_is_the_line() {
    let length = 100.0;
    let way = |n: usize| {
        let mut way = Way::new();
        for i in 1..=n {
            let x = length * i as f64 / n as f64;
            way.feed(12e3, &[x, x / 2.0, x / 4.0]);
        }
        way
    };
    for model in [TRAPEZOIDAL, Model::JerkLimited] {
        let one = seconds(model, &plain(), &way(1));
        for n in [2, 10, 10_000] {
            same(seconds(model, &plain(), &way(n)), one, 1e-9);
        }
    }
}

#[test]
fn chords_of_a_circle_take_the_time_of_the_arc() {
    let r = 5.0;
    for (feed, n) in [(30e3, 360), (30e3, 3600), (1.2e3, 360)] {
        let mut chords = Way::new();
        chords.rapid(&[r]).dwell(1.0);
        let mut arc = chords.clone();
        for i in 1..=n {
            let angle = TAU * f64::from(i) / f64::from(n);
            chords.feed(feed, &[r * angle.cos(), r * angle.sin()]);
        }
        arc.arc(feed, [0.0, 0.0], &[r]);
        let (chords, arc) = (seconds(TRAPEZOIDAL, &plain(), &chords), seconds(TRAPEZOIDAL, &plain(), &arc));
        // Where a chord lies obliquely to the axes they allow it up to √2 of the acceleration.
        assert!(chords <= arc * 1.01 && chords > arc * 0.8, "{chords} {arc}");
        if feed < 2e3 {
            same(chords, arc, 1e-3);
        }
    }
}

#[test]
fn a_corner_between_short_moves_is_a_corner_of_their_lengths() {
    // Steps of 0.01 mm, right angles: a circle that touches both at 0.005 mm has that radius.
    let mut way = Way::new();
    for i in 1..=50 {
        let x = f64::from(i) * 0.01;
        way.feed(6e3, &[x, x - 0.01]).feed(6e3, &[x, x]);
    }
    let got = run(TRAPEZOIDAL, &plain(), &way.acts);
    let v: f64 = (1000.0 * 2.0f64.sqrt() * 0.005).sqrt();
    same(got.timed[50].profile.entry, v, 1e-9);
    // In pieces or not.
    let mut pieces = Way::new();
    for i in 1..=50 {
        let x = f64::from(i) * 0.01;
        for part in [0.001, 0.002, 0.01] {
            pieces.feed(6e3, &[x - 0.01 + part, x - 0.01]);
        }
        for part in [0.009, 0.01] {
            pieces.feed(6e3, &[x, x - 0.01 + part]);
        }
    }
    same(seconds(TRAPEZOIDAL, &plain(), &pieces), got.seconds, 1e-9);
}

#[test]
fn rotary_axes() {
    let mut m = plain();
    m.axes[3].rapid_rate = Some(600.0);
    m.axes[3].acceleration = Some(100.0);
    // Alone: degrees at degrees a minute.
    same(
        seconds(TRAPEZOIDAL, &m, Way::new().rapid(&[0.0, 0.0, 0.0, 90.0])),
        90.0 / 10.0 + 10.0 / 100.0,
        1e-12,
    );
    // With a line: the feed is that of the line, unless the rotary axis is too slow for it.
    let got = |feed: f64| {
        run(TRAPEZOIDAL, &m, &Way::new().feed(feed, &[10.0, 0.0, 0.0, 5.0]).acts).timed[0].profile.peak
    };
    same(got(600.0), 10.0, 1e-12);
    same(got(6000.0), 20.0, 1e-12);
    // From a line to a rotary move alone is a stop.
    let way = Way::new().feed(6e3, &[50.0]).feed(6e2, &[50.0, 0.0, 0.0, 10.0]).clone();
    assert_eq!(run(TRAPEZOIDAL, &m, &way.acts).timed[1].profile.entry, 0.0);
}

/// Without acceleration too: the rate along the line is no rate of a rotary axis, and an axis of which
/// nothing is stated has a working value, which is reported.
#[test]
fn rotary_axes_without_acceleration() {
    let alone = |m: &Machine| seconds(Model::Ideal, m, Way::new().rapid(&[0.0, 0.0, 0.0, 90.0]));
    let mut m = Machine { rapid_rate: Some(15_000.0), ..Machine::default() };
    m.axes[3].rapid_rate = Some(600.0);
    same(alone(&m), 9.0, 1e-12);
    m.axes[3].rapid_rate = None;
    let (filled, told) = m.assumed(Model::Ideal);
    same(alone(&filled), 90.0 / 7_200.0 * 60.0, 1e-12);
    assert!(told.iter().any(|f| f.axis == Some(Axis::A) && f.value == 7_200.0));
    assert!(!told.iter().any(|f| f.fact == Fact::RapidRate && f.axis == Some(Axis::X)));
    // Some linear axes stated, others not: these have a working value as well.
    let mut m = Machine::default();
    m.axes[0].rapid_rate = Some(6_000.0);
    let (filled, told) = m.assumed(Model::Ideal);
    assert_eq!((filled.rapid_rate, filled.axes[2].rapid_rate), (None, Some(30_000.0)));
    assert!(told.iter().any(|f| f.fact == Fact::RapidRate && f.axis == Some(Axis::Z)));
}

#[test]
fn a_move_is_never_shorter_than_a_block_takes() {
    let mut m = plain();
    m.block = Some(0.01);
    let mut way = Way::new();
    for i in 1..=1000 {
        way.feed(12e3, &[f64::from(i) * 0.2]);
    }
    let got = run(TRAPEZOIDAL, &m, &way.acts);
    // 0.2 mm in 10 ms are 20 mm/s, though 200 are asked for.
    assert!(got.timed.iter().all(|t| t.duration >= 0.01 * (1.0 - 1e-9)));
    same(got.seconds, 200.0 / 20.0 + 20.0 / 1000.0, 1e-9);
}
