//! Moves a second on a map of 1024 × 1024 cells: 20,000 short moves of surfacing, each 2.6 cells long, in rows that
//! overlap, by the radius of the tool in cells. `cargo bench -p ncc-simulate`.

use divan::{Bencher, counter::ItemsCount};
use ncc_simulate::{Cutter, Move, Setup, Shape, Simulation, Stock, Tool, Way};

/// Moves of a run.
const MOVES: usize = 20_000;

/// A tool of so many cells in radius, on cells of 0.1 mm.
fn simulation(shape: &Shape, cells: f64) -> Simulation {
    let cutter = Cutter::new(shape, 2.0 * cells * 0.1, 30.0).expect("a tool");
    Simulation::new(Setup {
        stock: Stock::Block { low: [0.0, 0.0, -20.0], high: [102.4, 102.4, 0.0] },
        guessed: false,
        cells: 1024,
        tools: vec![Tool { number: 1, cutter, flute: None, shank: None, holder: None, guessed: false }],
        fixtures: Vec::new(),
        table: None,
        start: [0.0, 0.0, 5.0],
        tilts: Vec::new(),
    })
}

/// Rows along X, which rise and fall by so much at most, mm.
fn moves(by: f64) -> Vec<Move> {
    let mut rng = fastrand::Rng::with_seed(3);
    let (mut x, mut y, mut sense) = (5.0, 5.0, 1.0);
    (0..MOVES)
        .map(|_| {
            x += sense * 0.26;
            if !(5.0..97.0).contains(&x) {
                (sense, y) = (-sense, y + 0.8);
            }
            let end = [x, y, -4.0 + rng.f64() * by];
            Move { way: Way::Feed, end, tool: 0, tilt: 0, turns: true, time: 0.0, line: 0 }
        })
        .collect()
}

fn run(bencher: Bencher, shape: &Shape, cells: f64, by: f64) {
    let moves = moves(by);
    bencher
        .counter(ItemsCount::new(MOVES))
        .with_inputs(|| simulation(shape, cells))
        .bench_refs(|simulation| moves.iter().for_each(|own| simulation.push(*own)));
}

#[divan::bench(sample_count = 9, sample_size = 1, args = [2.5, 10.0, 20.0])]
fn flat(bencher: Bencher, cells: f64) {
    run(bencher, &Shape::Flat, cells, 0.1);
}

#[divan::bench(sample_count = 9, sample_size = 1, args = [2.5, 10.0, 20.0])]
fn flat_on_level_rows(bencher: Bencher, cells: f64) {
    run(bencher, &Shape::Flat, cells, 0.0);
}

#[divan::bench(sample_count = 9, sample_size = 1, args = [2.5, 10.0, 20.0])]
fn ball(bencher: Bencher, cells: f64) {
    run(bencher, &Shape::Ball, cells, 0.1);
}

#[divan::bench(sample_count = 9, sample_size = 1, args = [2.5, 10.0, 20.0])]
fn bull_nose(bencher: Bencher, cells: f64) {
    run(bencher, &Shape::BullNose { corner: cells * 0.02 }, cells, 0.1);
}

/// Circles of 3 mm radius that stay level, each beside the last one.
#[divan::bench(sample_count = 9, sample_size = 1, args = [2.5, 10.0, 20.0])]
fn flat_on_circles(bencher: Bencher, cells: f64) {
    let way =
        |x: f64, y: f64| Way::Arc { plane: [0, 1, 2], centre: [x - 3.0, y], sweep: std::f64::consts::TAU };
    let circles = |n: usize| {
        let [x, y] = [10.0 + (n % 80) as f64, 10.0 + (n / 80) as f64];
        let to =
            Move { way: Way::Feed, end: [x, y, -1.0], tool: 0, tilt: 0, turns: true, time: 0.0, line: 0 };
        [to, Move { way: way(x, y), ..to }]
    };
    let moves: Vec<Move> = (0..1_000).flat_map(circles).collect();
    bencher
        .counter(ItemsCount::new(1_000_usize))
        .with_inputs(|| simulation(&Shape::Flat, cells))
        .bench_refs(|simulation| moves.iter().for_each(|own| simulation.push(*own)));
}

/// A tool that leans by 30° along the rows, by its shape.
#[divan::bench(sample_count = 3, sample_size = 1, args = ["flat", "ball", "bull nose"])]
fn leaning(bencher: Bencher, shape: &str) {
    let shape = match shape {
        "flat" => Shape::Flat,
        "ball" => Shape::Ball,
        _ => Shape::BullNose { corner: 0.2 },
    };
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    let axes = [[cos, 0.0, sin], [0.0, 1.0, 0.0], [-sin, 0.0, cos]];
    let moves: Vec<Move> = moves(0.1).into_iter().take(2_000).map(|own| Move { tilt: 1, ..own }).collect();
    let setup = simulation(&shape, 10.0).setup().clone();
    bencher
        .counter(ItemsCount::new(moves.len()))
        .with_inputs(|| Simulation::new(Setup { tilts: vec![axes], ..setup.clone() }))
        .bench_refs(|simulation| moves.iter().for_each(|own| simulation.push(*own)));
}

/// The state after a move by chance, of 200,000 with a tool of so many cells in radius.
#[divan::bench(sample_count = 60, sample_size = 1, args = [2.5, 10.0])]
fn seek(bencher: Bencher, cells: f64) {
    let mut cut = simulation(&Shape::Flat, cells);
    let moves = moves(0.1);
    (0..10).for_each(|_| moves.iter().for_each(|own| cut.push(*own)));
    let mut rng = fastrand::Rng::with_seed(5);
    bencher.bench_local(|| cut.seek(rng.usize(..cut.moves().len())));
}

fn main() {
    divan::main();
}
