//! Look-ahead against a planner that knows the whole path, and the laws that every model keeps.

mod shop;

use ncc_exec::Kind;
use ncc_ir::expr::num::ONE;
use ncc_time::{Act, Machine, Model};
use proptest::prelude::*;
use shop::{Way, close, machine, nanos, run, seconds};

/// Plans a path of straight moves in X Y Z, known as a whole, and gives entry speeds and seconds.
/// It shares nothing with the crate: angles by arc tangent, then two passes over all junctions.
fn whole(acts: &[Act], m: &Machine) -> (Vec<f64>, f64) {
    struct Line {
        unit: [f64; 3],
        length: f64,
        speed: f64,
        a: f64,
    }
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let along = |u: [f64; 3], limit: &dyn Fn(usize) -> f64| {
        (0..3).filter(|i| u[*i] != 0.0).map(|i| limit(i) / u[i].abs()).fold(f64::INFINITY, f64::min)
    };
    let accelerations = |i: usize| m.axes[i].acceleration.unwrap();
    let rates = |i: usize| m.axes[i].rapid_rate.unwrap() / 60.0;
    let lines: Vec<Line> = acts
        .iter()
        .map(|act| {
            let d: [f64; 3] = std::array::from_fn(|i| (act.event.end[i] - act.from[i]) as f64 / ONE as f64);
            let length = dot(d, d).sqrt();
            let unit = d.map(|x| x / length);
            let feed = match act.event.kind {
                Kind::Feed => act.event.rate as f64 / ONE as f64 / 60.0,
                _ => f64::INFINITY,
            };
            Line { unit, length, speed: feed.min(along(unit, &rates)), a: along(unit, &accelerations) }
        })
        .collect();
    let n = lines.len();
    let angle = |i: usize| {
        let (a, b) = (lines[i - 1].unit, lines[i].unit);
        let cross = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        dot(cross, cross).sqrt().atan2(dot(a, b))
    };
    let turns: Vec<f64> = (0..n).map(|i| if i == 0 { 0.0 } else { angle(i) }).collect();
    let straight = |i: usize| turns[i] <= 2e-6;
    let mut caps = vec![0.0; n + 1];
    for i in 1..n {
        let mut cap = lines[i - 1].speed.min(lines[i].speed);
        if !straight(i) {
            let half = turns[i] / 2.0;
            // Lengths of the straight lines before and after.
            let mut before = lines[i - 1].length;
            for j in (1..i).rev().take_while(|j| straight(*j)) {
                before += lines[j - 1].length;
            }
            let mut after = lines[i].length;
            for j in (i + 1..n).take_while(|j| straight(*j)) {
                after += lines[j].length;
            }
            let push: [f64; 3] = std::array::from_fn(|k| lines[i].unit[k] - lines[i - 1].unit[k]);
            let size = dot(push, push).sqrt();
            let a = along(push.map(|x| x / size), &accelerations);
            let by_tolerance = m.path_tolerance.unwrap() * half.cos() / (2.0 * (half / 2.0).sin().powi(2));
            let by_length = before.min(after) / 2.0 / half.tan();
            cap = cap.min((a * by_tolerance.min(by_length)).sqrt());
        }
        caps[i] = cap;
    }
    let mut v = caps;
    for i in 0..n {
        v[i + 1] = v[i + 1].min((v[i] * v[i] + 2.0 * lines[i].a * lines[i].length).sqrt());
    }
    for i in (0..n).rev() {
        v[i] = v[i].min((v[i + 1] * v[i + 1] + 2.0 * lines[i].a * lines[i].length).sqrt());
    }
    let mut time = 0.0;
    for (i, line) in lines.iter().enumerate() {
        let (from, to) = (v[i], v[i + 1]);
        let top = ((from * from + to * to) / 2.0 + line.a * line.length).sqrt().min(line.speed);
        let ramps = (2.0 * top * top - from * from - to * to) / (2.0 * line.a);
        time += (2.0 * top - from - to) / line.a + (line.length - ramps).max(0.0) / top;
    }
    v.pop();
    (v, time)
}

/// How a path goes on.
#[derive(Clone, Debug)]
enum Step {
    /// Straight on, in thousandths of the last move.
    On(u32),
    Back,
    /// By micrometres.
    By([i32; 3]),
    /// Chords of a curve: how many, micrometres each, turn in thousandths of a degree.
    Curve(usize, i32, i32),
    Feed(u32),
    Rapid,
}

fn step() -> impl Strategy<Value = Step> {
    let size =
        || prop_oneof![1 => Just(0i32), 2 => -30i32..30, 2 => -2_000i32..2_000, 2 => -80_000i32..80_000];
    prop_oneof![
        2 => (1u32..3000).prop_map(Step::On),
        1 => Just(Step::Back),
        6 => [size(), size(), size()].prop_map(Step::By),
        3 => (2usize..150, 1i32..400, -20_000i32..20_000).prop_map(|(n, s, t)| Step::Curve(n, s, t)),
        2 => prop_oneof![30u32..500, 500u32..15_000].prop_map(Step::Feed),
        1 => Just(Step::Rapid),
    ]
}

/// A path of moves in whole micrometres, none of which goes nowhere.
fn lay(steps: &[Step]) -> Way {
    let mut way = Way::new();
    let mut at = [0i64; 3];
    let mut last = [1000i64, 0, 0];
    let mut feed = Some(3000);
    let mut go = |way: &mut Way, by: [i64; 3], feed: Option<u32>| {
        if by == [0; 3] {
            return;
        }
        at = std::array::from_fn(|i| at[i] + by[i]);
        let to = at.map(|x| x as f64 / 1000.0);
        match feed {
            Some(feed) => way.feed(f64::from(feed), &to),
            None => way.rapid(&to),
        };
    };
    for step in steps {
        match step {
            Step::On(k) => {
                // Whole multiples stay on the line.
                let by = last.map(|x| x * i64::from(1 + k % 3));
                go(&mut way, by, feed);
            }
            Step::Back => {
                last = last.map(|x| -x);
                go(&mut way, last, feed);
            }
            Step::By(by) => {
                if *by != [0; 3] {
                    last = by.map(i64::from);
                }
                go(&mut way, by.map(i64::from), feed);
            }
            Step::Curve(n, size, turn) => {
                let mut angle = (last[1] as f64).atan2(last[0] as f64);
                for _ in 0..*n {
                    angle += f64::from(*turn).to_radians() / 1000.0;
                    let by = [angle.cos(), angle.sin()].map(|x| (x * f64::from(*size)).round() as i64);
                    if by != [0; 2] {
                        last = [by[0], by[1], 0];
                    }
                    go(&mut way, [by[0], by[1], 0], feed);
                }
            }
            Step::Feed(rate) => feed = Some(*rate),
            Step::Rapid => feed = None,
        }
    }
    way
}

fn ways() -> impl Strategy<Value = Way> {
    let way = proptest::collection::vec(step(), 1..40).prop_map(|steps| lay(&steps));
    way.prop_filter("moves", |way| !way.acts.is_empty())
}

fn machines() -> impl Strategy<Value = Machine> {
    (3_000u32..60_000, [100u32..9_000, 100u32..9_000, 100u32..9_000], 0u32..60).prop_map(
        |(rapid, a, tolerance)| {
            let mut m = machine(f64::from(rapid), 1000.0, 1e5, f64::from(tolerance) / 1000.0);
            for (axis, a) in m.axes.iter_mut().zip(a) {
                axis.acceleration = Some(f64::from(a));
            }
            m
        },
    )
}

const MODELS: [Model; 2] = [Model::Trapezoidal, Model::JerkLimited];

fn faster(m: &Machine, acceleration: f64, jerk: f64) -> Machine {
    let mut m = m.clone();
    for axis in &mut m.axes {
        axis.acceleration = axis.acceleration.map(|a| a * acceleration);
        axis.jerk = axis.jerk.map(|j| j * jerk);
    }
    m
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 100, ..ProptestConfig::default() })]

    #[test]
    fn it_plans_as_if_it_knew_the_whole_path(way in ways(), m in machines()) {
        let (entries, time) = whole(&way.acts, &m);
        let got = run(Model::Trapezoidal, &m, &way.acts);
        for (timed, entry) in got.timed.iter().zip(&entries) {
            // A cap of nothing at a reversal is nothing to the last digit of an angle.
            prop_assert!((timed.profile.entry - entry).abs() <= 1e-7 * entry + 1e-5, "{} {}: {} {}", timed.n, got.timed.len(), timed.profile.entry, entry);
        }
        prop_assert!(close(got.seconds, time, 1e-7), "{} {}", got.seconds, time);
    }

    #[test]
    fn no_model_is_faster_than_a_simpler_one_and_all_are_within_their_bounds(way in ways(), m in machines()) {
        let times = [Model::Ideal, Model::Trapezoidal, Model::JerkLimited].map(|model| {
            let got = run(model, &m, &way.acts);
            assert!(got.bounds.0 <= got.seconds * (1.0 + 1e-9), "{model:?} {:?} {}", got.bounds, got.seconds);
            assert!(got.seconds <= got.bounds.1 * (1.0 + 1e-9), "{model:?} {:?} {}", got.bounds, got.seconds);
            got.seconds
        });
        prop_assert!(times[0] <= times[1] * (1.0 + 1e-9), "{:?}", times);
        prop_assert!(times[1] <= times[2] * (1.0 + 1e-9), "{:?}", times);
    }

    #[test]
    fn more_acceleration_is_never_slower(way in ways(), m in machines(), axis in 0usize..3, more in 1.01f64..3.0) {
        let mut fast = m.clone();
        fast.axes[axis].acceleration = fast.axes[axis].acceleration.map(|a| a * more);
        let (slow, fast) = (seconds(Model::Trapezoidal, &m, &way), seconds(Model::Trapezoidal, &fast, &way));
        prop_assert!(fast <= slow * (1.0 + 1e-9), "{} {}", fast, slow);
    }

    #[test]
    fn a_path_takes_the_same_time_backwards(way in ways(), m in machines()) {
        let back = way.reversed();
        let (there, back) = (seconds(Model::Trapezoidal, &m, &way), seconds(Model::Trapezoidal, &m, &back));
        prop_assert!(close(there, back, 1e-9), "{} {}", there, back);
    }

    #[test]
    fn a_line_in_pieces_takes_the_same_time(way in ways(), m in machines(), cuts in proptest::collection::vec(1i64..999, 1..30)) {
        let mut pieces = Way::new();
        for (act, cut) in way.acts.iter().zip(cuts.iter().cycle()) {
            // Moves are whole micrometres, so thousandths of them are whole nanos of a millimetre.
            let part = std::array::from_fn(|i| act.from[i] + (act.event.end[i] - act.from[i]) / 1000 * cut);
            let mut first = act.clone();
            first.event.end = part;
            let mut second = act.clone();
            second.from = part;
            pieces.acts.extend([first, second]);
        }
        // With jerk, whether a limit is reached is judged by the softest move up to it: by a cut, sooner.
        for (model, digits) in [(Model::Trapezoidal, 1e-9), (Model::JerkLimited, 5e-3)] {
            let (one, two) = (seconds(model, &m, &way), seconds(model, &m, &pieces));
            prop_assert!(close(one, two, digits), "{:?} {} {}", model, one, two);
        }
    }

    #[test]
    fn a_stop_between_is_the_sum_of_both(a in ways(), b in ways(), m in machines(), pause in 0u32..5000) {
        let pause = f64::from(pause) / 1000.0;
        let mut both = a.clone();
        both.dwell(pause);
        let shift = both.at;
        for act in &b.acts {
            let mut act = act.clone();
            act.from = std::array::from_fn(|i| act.from[i] + shift[i]);
            act.event.end = std::array::from_fn(|i| act.event.end[i] + shift[i]);
            both.acts.push(act);
        }
        for model in MODELS {
            let sum = seconds(model, &m, &a) + pause + seconds(model, &m, &b);
            prop_assert!(close(seconds(model, &m, &both), sum, 1e-9));
        }
    }

    #[test]
    fn the_jerk_limited_time_comes_down_to_the_trapezoidal(way in ways(), m in machines()) {
        let trapezoidal = seconds(Model::Trapezoidal, &m, &way);
        let errors: Vec<f64> = [1.0, 1e2, 1e4].iter().map(|k| {
            seconds(Model::JerkLimited, &faster(&m, 1.0, *k), &way) / trapezoidal - 1.0
        }).collect();
        prop_assert!(errors.iter().all(|e| *e >= -1e-9), "{:?}", errors);
        prop_assert!(errors.windows(2).all(|e| e[1] <= e[0] + 1e-9), "{:?}", errors);
        prop_assert!(errors[2] < 0.01, "{:?}", errors);
    }
}

#[test]
fn the_queue_is_no_longer_than_the_way_to_a_stop() {
    // 100 mm/s at 1000 mm/s² stop within 5 mm: 50 moves of 0.1 mm.
    let mut way = Way::new();
    for i in 1..=20_000 {
        way.feed(6e3, &[f64::from(i) * 0.1]);
    }
    let m = machine(30_000.0, 1000.0, 1e9, 0.01);
    let got = run(Model::Trapezoidal, &m, &way.acts);
    assert!(got.most_waiting <= 52, "{}", got.most_waiting);
    let got = run(Model::JerkLimited, &m, &way.acts);
    assert!(got.most_waiting <= 102, "{}", got.most_waiting);
    assert_eq!(nanos(0.1), 100_000_000);
}
