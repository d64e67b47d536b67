//! A judge from outside: the planner of grbl 1.1, by its rules as they stand in `grbl/planner.c`
//! (`plan_buffer_line`, `plan_compute_profile_parameters`, `planner_recalculate`) and `nuts_bolts.c`,
//! in words and code of our own. Its buffer is as long as the path here.
//!
//! - A block's unit vector is over all axes; rate and acceleration are the least that any axis allows:
//!   its setting over its share of the vector.
//! - The nominal speed is the programmed rate, at most that rate; of a rapid, that rate.
//! - The junction: cos θ = −(u₁·u₂). Above 0.999999 (a reversal) the speed is nothing, below −0.999999 (straight
//!   on) it is not limited; else v² = a·d·s/(1 − s), s = √((1 − cos θ)/2), d the junction deviation, a what the
//!   axes allow along u₂ − u₁ made a unit vector.
//! - The entry is at most that and both nominal speeds. It starts from rest and ends in rest.
//! - Reverse pass: entry² ≤ exit² + 2·a·length. Forward pass: exit² ≤ entry² + 2·a·length.
//!
//! Junction deviation is our path tolerance. Our rule for short moves is not grbl's: paths here have
//! moves that are long enough for it not to count.

mod shop;

use ncc_time::{Machine, Model};
use proptest::prelude::*;
use shop::{Way, close, machine, run};

/// Settings: rates in mm/min, accelerations in mm/s², junction deviation in mm.
struct Grbl {
    rate: [f64; 3],
    acceleration: [f64; 3],
    deviation: f64,
}

/// A block as the parser hands it over: by how much, and the feed; `None` is a rapid.
#[derive(Clone, Debug)]
struct Block {
    by: [f64; 3],
    feed: Option<f64>,
}

struct Planned {
    millimeters: f64,
    acceleration: f64,
    nominal: f64,
    entry_squared: f64,
}

fn limit_by_axis(most: [f64; 3], unit: [f64; 3]) -> f64 {
    let mut limit = 1e38f64;
    for (most, u) in most.iter().zip(unit) {
        if u != 0.0 {
            limit = limit.min((most / u).abs());
        }
    }
    limit
}

fn normalise(v: [f64; 3]) -> ([f64; 3], f64) {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    (v.map(|x| x / length), length)
}

impl Grbl {
    /// In mm/s; grbl reckons in minutes.
    fn plan(&self, blocks: &[Block]) -> Vec<Planned> {
        let mut planned: Vec<Planned> = Vec::new();
        let mut most_entry: Vec<f64> = Vec::new();
        let mut last: Option<([f64; 3], f64)> = None;
        for block in blocks {
            let (unit, millimeters) = normalise(block.by);
            let acceleration = limit_by_axis(self.acceleration, unit);
            let rapid = limit_by_axis(self.rate, unit) / 60.0;
            let nominal = block.feed.map_or(rapid, |feed| (feed / 60.0).min(rapid));
            let entry = match last {
                None => 0.0,
                Some((before, nominal_before)) => {
                    let cosine: f64 = -(0..3).map(|i| before[i] * unit[i]).sum::<f64>();
                    let junction = if cosine > 0.999_999 {
                        0.0
                    } else if cosine < -0.999_999 {
                        1e38
                    } else {
                        let (push, _) = normalise(std::array::from_fn(|i| unit[i] - before[i]));
                        let sine = (0.5 * (1.0 - cosine)).sqrt();
                        limit_by_axis(self.acceleration, push) * self.deviation * sine / (1.0 - sine)
                    };
                    junction.min(nominal.min(nominal_before).powi(2))
                }
            };
            most_entry.push(entry);
            planned.push(Planned { millimeters, acceleration, nominal, entry_squared: entry });
            last = Some((unit, nominal));
        }
        // Reverse: the last block is planned to a stop.
        let mut exit = 0.0;
        for (block, most) in planned.iter_mut().zip(&most_entry).rev() {
            block.entry_squared = most.min(exit + 2.0 * block.acceleration * block.millimeters);
            exit = block.entry_squared;
        }
        // Forward.
        for i in 1..planned.len() {
            let before = &planned[i - 1];
            let reached = before.entry_squared + 2.0 * before.acceleration * before.millimeters;
            planned[i].entry_squared = planned[i].entry_squared.min(reached);
        }
        planned
    }
}

/// Seconds of blocks: the trapezoids that the stepper module runs (`stepper.c`, `st_prep_buffer`).
fn time(planned: &[Planned]) -> f64 {
    let mut time = 0.0;
    for (i, block) in planned.iter().enumerate() {
        let exit = planned.get(i + 1).map_or(0.0, |next| next.entry_squared);
        let entry = block.entry_squared;
        // Where speeding up from the entry and braking to the exit would meet.
        let meet = 0.5 * (block.millimeters + (exit - entry) / (2.0 * block.acceleration));
        let top = (entry + 2.0 * block.acceleration * meet).sqrt();
        if top <= block.nominal {
            time += (2.0 * top - entry.sqrt() - exit.sqrt()) / block.acceleration;
        } else {
            let v = block.nominal;
            let up = (v * v - entry) / (2.0 * block.acceleration);
            let down = (v * v - exit) / (2.0 * block.acceleration);
            time += (2.0 * v - entry.sqrt() - exit.sqrt()) / block.acceleration;
            time += (block.millimeters - up - down) / v;
        }
    }
    time
}

fn judge(blocks: &[Block], grbl: &Grbl) -> Result<(), String> {
    let mut m: Machine = machine(1.0, 1.0, 1.0, grbl.deviation);
    for i in 0..3 {
        m.axes[i].rapid_rate = Some(grbl.rate[i]);
        m.axes[i].acceleration = Some(grbl.acceleration[i]);
    }
    let mut way = Way::new();
    let mut at = [0.0; 3];
    for block in blocks {
        at = std::array::from_fn(|i| at[i] + block.by[i]);
        match block.feed {
            Some(feed) => way.feed(feed, &at),
            None => way.rapid(&at),
        };
    }
    let ours = run(Model::Trapezoidal, &m, &way.acts);
    let theirs = grbl.plan(blocks);
    for (ours, theirs) in ours.timed.iter().zip(&theirs) {
        let entry = theirs.entry_squared.sqrt();
        let apart = (ours.profile.entry - entry).abs();
        if apart.is_nan() || apart > 1e-6 * entry + 1e-3 {
            return Err(format!("block {}: entry {} and {entry}", ours.n, ours.profile.entry));
        }
    }
    let seconds = time(&theirs);
    if !close(ours.seconds, seconds, 1e-6) {
        return Err(format!("{} s and {seconds} s", ours.seconds));
    }
    Ok(())
}

/// The factory settings of grbl 1.1 (`defaults.h`, generic) but for its rates, and a router's.
const SETTINGS: [Grbl; 3] = [
    Grbl { rate: [500.0; 3], acceleration: [10.0; 3], deviation: 0.01 },
    Grbl { rate: [8000.0, 8000.0, 2000.0], acceleration: [400.0, 400.0, 100.0], deviation: 0.02 },
    Grbl { rate: [30_000.0, 20_000.0, 10_000.0], acceleration: [3000.0, 1500.0, 900.0], deviation: 0.005 },
];

fn block(by: [f64; 3], feed: f64) -> Block {
    Block { by, feed: (feed > 0.0).then_some(feed) }
}

#[test]
fn paths_by_hand() {
    let square = [[40.0, 0.0, 0.0], [0.0, 40.0, 0.0], [-40.0, 0.0, 0.0], [0.0, -40.0, 0.0]];
    let mut polygon = Vec::new();
    for i in 0..36 {
        let angle = (f64::from(i) * 10.0).to_radians();
        polygon.push([4.0 * angle.cos(), 4.0 * angle.sin(), 0.1]);
    }
    let zigzag: Vec<[f64; 3]> = (0..20).map(|i| [3.0, if i % 2 == 0 { 1.0 } else { -1.0 }, 0.0]).collect();
    let drill = [[20.0, 0.0, 0.0], [0.0, 0.0, -10.0], [0.0, 0.0, 10.0], [0.0, 15.0, 0.0], [0.0, 0.0, -10.0]];
    let paths: [&[[f64; 3]]; 4] = [&square, &polygon, &zigzag, &drill];
    for grbl in &SETTINGS {
        for path in paths {
            for feed in [100.0, 2_000.0, 9_000.0, 0.0] {
                let blocks: Vec<Block> = path.iter().map(|by| block(*by, feed)).collect();
                judge(&blocks, grbl).unwrap_or_else(|why| panic!("{why}: {path:?} {feed}"));
            }
            // Feeds that change from block to block.
            let feeds = [300.0, 4000.0, 0.0, 1200.0];
            let blocks: Vec<Block> =
                path.iter().zip(feeds.iter().cycle()).map(|(by, feed)| block(*by, *feed)).collect();
            judge(&blocks, grbl).unwrap_or_else(|why| panic!("{why}: {path:?} mixed"));
        }
    }
}

fn blocks() -> impl Strategy<Value = Vec<Block>> {
    // Whole hundredths, and long enough: with these settings a corner's circle touches within 1.5 mm of it
    // or the feed counts.
    let one = ([-300i32..300, -300i32..300, -300i32..300], prop_oneof![Just(0u32), 60u32..9_000])
        .prop_filter("long", |(by, _)| by.iter().map(|x| x * x).sum::<i32>() > 300 * 300)
        .prop_map(|(by, feed)| block(by.map(|x| f64::from(x) / 10.0), f64::from(feed)));
    proptest::collection::vec(one, 1..60)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, ..ProptestConfig::default() })]

    #[test]
    fn paths_by_chance(blocks in blocks(), which in 0usize..3) {
        judge(&blocks, &SETTINGS[which]).map_err(TestCaseError::fail)?;
    }
}
