//! Model `jerk-limited` against formulae of the S-curve, written out here.

mod shop;

use ncc_time::{Machine, Model};
use shop::{Way, machine, run, same, seconds};

const JERK: Model = Model::JerkLimited;

/// 1000 mm/s², 20 000 mm/s³: acceleration is there after 50 ms and 25 mm/s, gone after 50 mm/s.
fn soft() -> Machine {
    machine(30_000.0, 1000.0, 20_000.0, 0.01)
}

#[test]
fn single_moves() {
    let (a, j): (f64, f64) = (1000.0, 20_000.0);
    // With full acceleration and the whole speed: s/v + v/a + a/j.
    same(seconds(JERK, &soft(), Way::new().feed(6e3, &[100.0])), 1.0 + 0.1 + 0.05, 1e-12);
    // The whole speed without full acceleration (30 mm/s are less than 50): s/v + 2√(v/j).
    let v: f64 = 30.0;
    same(seconds(JERK, &soft(), Way::new().feed(1.8e3, &[100.0])), 100.0 / v + 2.0 * (v / j).sqrt(), 1e-12);
    // Neither: four equal parts, s = 2·j·t³.
    let s: f64 = 0.4;
    same(seconds(JERK, &soft(), Way::new().feed(18e3, &[s])), 4.0 * (s / (2.0 * j)).cbrt(), 1e-9);
    // Full acceleration, not the whole speed: v² + v·a²/j = a·s.
    let s: f64 = 40.0;
    let w = a * a / j;
    let v = ((w * w + 4.0 * a * s).sqrt() - w) / 2.0;
    let got = run(JERK, &soft(), &Way::new().feed(18e3, &[s]).acts);
    same(got.timed[0].profile.peak, v, 1e-9);
    same(got.seconds, 2.0 * (v / a + a / j), 1e-9);
}

#[test]
fn each_axis_bears_its_share_of_jerk() {
    let mut m = soft();
    m.axes[1].jerk = Some(5_000.0);
    // 3-4-5: Y has 0.8 of the move; acceleration is 1000/0.8 and takes Y's 0.2 s to build up.
    let got = seconds(JERK, &m, Way::new().feed(18e3, &[48.0, 64.0]));
    let (a, build, s): (f64, f64, f64) = (1250.0, 0.2, 80.0);
    let w = a * build;
    let v = ((w * w + 4.0 * a * s).sqrt() - w) / 2.0;
    // 250 mm/s are what is lost; the peak is below, so acceleration is never full.
    assert!(v < w);
    let j = a / build;
    same(got, 4.0 * (s / (2.0 * j)).cbrt(), 1e-9);
}

#[test]
fn a_corner_is_two_ramps() {
    let way = Way::new().feed(6e3, &[100.0]).feed(6e3, &[100.0, 100.0]).clone();
    let got = run(JERK, &soft(), &way.acts);
    let v = got.timed[1].profile.entry;
    same(v, run(Model::Trapezoidal, &soft(), &way.acts).timed[1].profile.entry, 1e-12);
    // From 100 mm/s to the corner's speed: Δ/a + a/j, over the mean of both speeds.
    let ramp = (100.0 - v) / 1000.0 + 0.05;
    let start = 0.1 + 0.05;
    let level = 100.0 - 50.0 * start - (100.0 + v) / 2.0 * ramp;
    same(got.timed[0].duration, start + level / 100.0 + ramp, 1e-9);
    same(got.timed[0].profile.t_decel, ramp, 1e-9);
    same(got.seconds, 2.0 * got.timed[0].duration, 1e-9);
}

#[test]
fn a_ramp_goes_on_over_short_moves() {
    // A gentle curve of 0.2 mm chords: as if it were a line, but for the direction of the acceleration.
    let mut curve = Way::new();
    let mut line = Way::new();
    let (mut x, mut y) = (0.0, 0.0);
    for i in 0..1000 {
        let angle = f64::from(i) * 2e-4;
        (x, y) = (x + 0.2 * angle.cos(), y + 0.2 * angle.sin());
        curve.feed(6e3, &[x, y]);
        line.feed(6e3, &[0.2 * f64::from(i + 1)]);
    }
    let (curve, line) = (seconds(JERK, &soft(), &curve), seconds(JERK, &soft(), &line));
    same(curve, line, 2e-3);
}

#[test]
fn as_jerk_grows_it_becomes_the_trapezoidal_model() {
    let mut way = Way::new();
    way.rapid(&[40.0, 30.0, 5.0]).feed(3e3, &[40.0, 30.0, 0.0]).arc(3e3, [30.0, 30.0], &[40.0, 30.0]);
    for i in 1..200 {
        let t = f64::from(i) / 20.0;
        way.feed(6e3, &[40.0 + t, 30.0 + t.sin() * 3.0, t.cos() - 1.0]);
    }
    way.rapid(&[0.0, 0.0, 50.0]);
    let at = |jerk: f64| machine(30_000.0, 1000.0, jerk, 0.01);
    let trapezoidal = seconds(Model::Trapezoidal, &at(1.0), &way);
    let errors: Vec<f64> =
        (4..=9).map(|k| seconds(JERK, &at(10f64.powi(k)), &way) / trapezoidal - 1.0).collect();
    assert!(errors.windows(2).all(|e| e[1] < e[0]), "{errors:?}");
    assert!(errors[0] > 0.05 && errors[5] >= 0.0 && errors[5] < 1e-4, "{errors:?}");
}
