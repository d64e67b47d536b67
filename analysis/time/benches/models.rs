//! Time of each model for 64 moves, on one thread, for three kinds of paths. Compare figures of one run
//! only: the ratio of two rows says more than either. Ahead of them stands how many functions had to
//! wait for what followed, at most.
#![allow(clippy::print_stdout)] // A benchmark tells its figures.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use ncc_exec::{Event, Kind, State};
use ncc_ir::canon::{AXES, Plane, Turn};
use ncc_ir::expr::num::{Nanos, ONE};
use ncc_ir::source::Span;
use ncc_time::{Act, AxisFacts, Clock, Machine, Model, Place};

/// Moves of a path, which is driven again and again.
const MOVES: usize = 1024;
/// Moves that are timed at once: as in use, a move is in the cache when it comes.
const BATCH: usize = 64;

/// Paths.
#[derive(Clone, Copy, Debug)]
enum Path {
    /// Chords of 0.2 mm over a wavy surface, to and fro, at 6 m/min; ends of lines are corners.
    Surface,
    /// Straight moves of 5 mm, right angles.
    Corners,
    /// Arcs of a quarter, radius 2 to 12 mm, in tangents.
    Arcs,
}

const PATHS: [Path; 3] = [Path::Surface, Path::Corners, Path::Arcs];

fn main() {
    println!("longest queue");
    for path in PATHS {
        let acts = acts(path);
        for model in Model::ALL {
            let clock = run(model, &acts);
            println!("{path:?} {}: {}", model.name(), clock.most_waiting());
        }
    }
    divan::main();
}

fn machine() -> Machine {
    let axis = |k: f64| AxisFacts {
        rapid_rate: Some(30_000.0 * k),
        acceleration: Some(3_000.0 * k),
        jerk: Some(50_000.0),
        ..AxisFacts::default()
    };
    Machine {
        axes: [1.0, 0.9, 0.7, 1.0, 1.0, 1.0].map(axis),
        path_tolerance: Some(0.01),
        ..Machine::default()
    }
}

/// A path in the making.
struct Maker {
    acts: Vec<Act>,
    at: [Nanos; AXES],
}

impl Maker {
    fn put(&mut self, kind: Kind, [x, y, z]: [Nanos; 3]) {
        let (from, end) = (self.at, [x, y, z, 0, 0, 0]);
        let (rate, state) = (6_000 * ONE, State::default());
        self.acts.push(Act {
            event: Event { kind, end, rate, state, inch: false, span: Span::default() },
            from,
            program_from: from,
            program_to: end,
            cut_offset: None,
            place: Place::default(),
        });
        self.at = end;
    }
}

fn acts(path: Path) -> Vec<Act> {
    let mut maker = Maker { acts: Vec::with_capacity(MOVES), at: [0; AXES] };
    let mut random = fastrand::Rng::with_seed(4);
    for i in 0..MOVES {
        match path {
            Path::Surface => {
                let (line, point) = (i / 500, i % 500);
                let x = 0.2 * if line % 2 == 0 { point } else { 499 - point } as f64;
                let y = 0.2 * line as f64;
                let z = (x / 7.0).sin() * 5.0 + (y / 11.0).cos() * 3.0;
                maker.put(Kind::Feed, [x, y, z].map(|x| (x * ONE as f64).round() as Nanos));
            }
            Path::Corners => {
                let (x, y) = (i.div_ceil(2) % 200, i / 2 % 200);
                maker.put(Kind::Feed, [x as Nanos * 5 * ONE, y as Nanos * 5 * ONE, 0]);
            }
            Path::Arcs => {
                // They wind along a diagonal.
                let r = random.i64(2_000..12_000) * (ONE / 1000);
                let [x, y, ..] = maker.at;
                let (turn, centre) = match i % 2 {
                    0 => (Turn::Counterclockwise, [x, y + r]),
                    _ => (Turn::Clockwise, [x + r, y]),
                };
                maker.put(Kind::Arc { plane: Plane::Xy, turn, full: false, centre }, [x + r, y + r, 0]);
            }
        }
    }
    maker.acts
}

fn run(model: Model, acts: &[Act]) -> Clock {
    let mut clock = Clock::new(model, machine());
    for act in acts {
        clock.push(act.clone());
        clock.forget();
    }
    clock.finish();
    clock
}

/// The clock runs on from batch to batch. A caller makes each function just before it goes in, and looks at
/// what has its time where it is: so making them is not measured, nor are they taken away.
fn measure(bencher: Bencher<'_, '_>, model: Model, path: Path) {
    let acts = acts(path);
    let mut clock = Clock::new(model, machine());
    let mut batches = acts.chunks(BATCH).cycle();
    bencher
        .counter(ItemsCount::new(BATCH))
        .with_inputs(|| batches.next().unwrap_or_default().to_vec())
        .bench_local_values(|acts| {
            for act in acts {
                clock.push(act);
                black_box(clock.certain());
                clock.forget();
            }
        });
}

#[divan::bench(args = PATHS, sample_count = 10_000, sample_size = 1)]
fn ideal(bencher: Bencher<'_, '_>, path: Path) {
    measure(bencher, Model::Ideal, path);
}

#[divan::bench(args = PATHS, sample_count = 10_000, sample_size = 1)]
fn trapezoidal(bencher: Bencher<'_, '_>, path: Path) {
    measure(bencher, Model::Trapezoidal, path);
}

#[divan::bench(args = PATHS, sample_count = 10_000, sample_size = 1)]
fn jerk_limited(bencher: Bencher<'_, '_>, path: Path) {
    measure(bencher, Model::JerkLimited, path);
}
