//! The surface of a sweep against the tool itself, put to many places of the way: what is computed in closed form must be
//! the lowest of them.

use std::f64::consts::FRAC_PI_2;

use ncc_simulate::{Cutter, Move, Setup, Shape, Simulation, Stock, Tool, Way};
use proptest::prelude::*;

fn shapes() -> impl Strategy<Value = (Shape, f64)> {
    let shape = prop_oneof![
        Just(Shape::Flat),
        Just(Shape::Ball),
        (0.05..0.999_f64).prop_map(|corner| Shape::BullNose { corner }),
        (30.0..170.0_f64).prop_map(|point| Shape::Drill { point }),
        (0.0..0.9_f64, 30.0..150.0_f64).prop_map(|(tip, angle)| Shape::Chamfer { tip, angle }),
        (0.0..0.9_f64, 1.0..30.0_f64).prop_map(|(corner, angle)| Shape::Taper { corner, angle }),
        Just(Shape::Profile(vec![[0.1, 0.0], [0.4, 0.2], [0.4, 0.9], [0.7, 0.9], [1.0, 2.0]])),
    ];
    (shape, 1.0..6.0_f64).prop_map(|(shape, radius)| {
        // Lengths of a shape are parts of the radius.
        let sized = match shape {
            Shape::BullNose { corner } => Shape::BullNose { corner: corner * radius },
            Shape::Chamfer { tip, angle } => Shape::Chamfer { tip: tip * 2.0 * radius, angle },
            Shape::Taper { corner, angle } => Shape::Taper { corner: corner * radius, angle },
            Shape::Profile(points) => Shape::Profile(points.iter().map(|[r, z]| [r * radius, *z]).collect()),
            other => other,
        };
        (sized, 2.0 * radius)
    })
}

fn point() -> impl Strategy<Value = [f64; 3]> {
    [2.0..18.0_f64, 2.0..18.0_f64, -8.0..0.0_f64]
}

/// Where the tip is after a part of a move.
fn place(from: [f64; 3], own: &Move, part: f64) -> [f64; 3] {
    let straight: [f64; 3] = std::array::from_fn(|axis| from[axis] + part * (own.end[axis] - from[axis]));
    let Way::Arc { plane, centre, sweep } = own.way else { return straight };
    let [f, s, _] = plane.map(usize::from);
    let arm = [from[f] - centre[0], from[s] - centre[1]];
    let (sin, cos) = (sweep * part).sin_cos();
    let mut at = straight;
    at[f] = centre[0] + arm[0] * cos - arm[1] * sin;
    at[s] = centre[1] + arm[0] * sin + arm[1] * cos;
    at
}

/// Holds a move against its places: a cell must lie between what a tool leaves there that is half a micrometre thinner, and
/// one that is as much thicker, to a micrometre.
fn judge(shape: &Shape, diameter: f64, from: [f64; 3], own: Move) -> Result<(), TestCaseError> {
    let cutter = Cutter::new(shape, diameter, 10.0).expect("a tool");
    let tool =
        Tool { number: 1, cutter: cutter.clone(), flute: None, shank: None, holder: None, guessed: false };
    let mut simulation = Simulation::new(Setup {
        stock: Stock::Block { low: [0.0; 3], high: [20.0, 20.0, 30.0] },
        guessed: false,
        cells: 12,
        tools: vec![tool],
        fixtures: Vec::new(),
        table: None,
        start: from,
        tilts: Vec::new(),
    });
    simulation.push(own);
    let grid = simulation.map().grid;
    for row in 0..grid.cells[1] {
        for column in 0..grid.cells[0] {
            let (x, y) = (grid.centre(0, column), grid.centre(1, row));
            let found = f64::from(simulation.map().heights[grid.index([column, row])]);
            let [high, low] = [0.000_5, -0.000_5].map(|off| {
                lowest(|part| {
                    let at = place(from, &own, part);
                    let distance = ((x - at[0]).hypot(y - at[1]) + off).max(0.0);
                    cutter.height(distance).map(|height| at[2] + height)
                })
            });
            prop_assert!(
                (low - 0.001..=high + 0.001).contains(&found),
                "X{x} Y{y}: {found}, the tool comes to {low} to {high}"
            );
        }
    }
    Ok(())
}

/// The lowest that a tool comes over a cell, 30 where it does not: the best of many places,
/// and of each that is better than those beside it, the best of many around it.
fn lowest(over: impl Fn(f64) -> Option<f64>) -> f64 {
    let least = |low: f64, high: f64| {
        let places = (0..=20).map(|n| low + (high - low) * f64::from(n) / 20.0);
        let heights = places.map(|part| [over(part).unwrap_or(30.0), part]);
        heights.min_by(|a, b| a[0].total_cmp(&b[0])).unwrap_or([30.0, 0.0])
    };
    let all: Vec<f64> = (0..=100).map(|n| over(f64::from(n) / 100.0).unwrap_or(30.0)).collect();
    let mut best = 30.0_f64.min(all[0]);
    for n in 0..=100_usize {
        let [before, behind] = [n.saturating_sub(1), (n + 1).min(100)];
        // A tool may touch a cell between two places only.
        if all[n] > all[before] || all[n] > all[behind] {
            continue;
        }
        let (mut around, mut wide) = (n as f64 / 100.0, 1.0 / 100.0);
        for _ in 0..5 {
            let found = least((around - wide).max(0.0), (around + wide).min(1.0));
            best = best.min(found[0]);
            around = found[1];
            wide /= 8.0;
        }
    }
    best
}

/// The heights that moves leave, one behind the other.
fn heights(shape: &Shape, diameter: f64, from: [f64; 3], moves: impl Iterator<Item = Move>) -> Vec<f32> {
    let cutter = Cutter::new(shape, diameter, 10.0).expect("a tool");
    let tool = Tool { number: 1, cutter, flute: None, shank: None, holder: None, guessed: false };
    let mut simulation = Simulation::new(Setup {
        stock: Stock::Block { low: [0.0; 3], high: [20.0, 20.0, 30.0] },
        guessed: false,
        cells: 90,
        tools: vec![tool],
        fixtures: Vec::new(),
        table: None,
        start: from,
        tilts: Vec::new(),
    });
    moves.for_each(|own| simulation.push(own));
    simulation.map().heights.clone()
}

/// Steps of a few cells in all directions, each level or upwards, now and then from a new place: what the steps before have cut
/// is left out, and nothing else.
#[test]
fn short_steps_go_on_where_the_last_one_ended() {
    let mut rng = fastrand::Rng::with_seed(11);
    let shapes =
        [Shape::Flat, Shape::Ball, Shape::BullNose { corner: 0.8 }, Shape::Chamfer { tip: 1.0, angle: 90.0 }];
    for (n, shape) in shapes.iter().cycle().take(160).enumerate() {
        let diameter = 2.0 + (n % 16) as f64 * 0.4;
        let (mut at, mut on) = ([10.0, 10.0, 30.0], Vec::new());
        for step in 0..12 {
            let [x, y, z] = at;
            let angle = if rng.bool() { rng.f64() * 6.3 } else { f64::from(rng.u8(..4)) * FRAC_PI_2 };
            let by = rng.f64() * 0.9;
            let up = if rng.bool() { 0.0 } else { rng.f64() * 0.2 };
            at = match step % 6 {
                0 => [4.0 + rng.f64() * 12.0, 4.0 + rng.f64() * 12.0, 20.0 * rng.f64()],
                _ => [x + by * angle.cos(), y + by * angle.sin(), z + up],
            };
            on.push(Move { way: Way::Feed, end: at, tool: 0, tilt: 0, turns: true, time: 0.0, line: 0 });
        }
        let stops = on.iter().flat_map(|own| [*own, Move { way: Way::Away, ..*own }]);
        let from = [on[0].end[0], on[0].end[1], 30.0];
        let one = heights(shape, diameter, from, on.iter().copied());
        let other = heights(shape, diameter, from, stops);
        let off = one.iter().zip(&other).filter(|(one, other)| (*one - *other).abs() > 0.000_1).count();
        assert!(off <= 2, "{shape:?} of {diameter}: {off} cells differ");
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 16, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn lines((shape, diameter) in shapes(), from in point(), to in point()) {
        let own = Move { way: Way::Feed, end: to, tool: 0, tilt: 0, turns: true, time: 0.0, line: 0 };
        judge(&shape, diameter, from, own)?;
    }

    /// What a tool has cut where it stands is not asked again by its next move; after a move that cuts nothing, it is.
    #[test]
    fn what_a_move_goes_on_from_changes_nothing(
        (shape, diameter) in shapes(),
        // Far away, or by less than a mm.
        places in prop::collection::vec(
            ([1.0..19.0_f64, 1.0..19.0_f64], prop_oneof![Just(3.0), 0.0..8.0_f64], prop::bool::weighted(0.8)),
            2..16,
        ),
    ) {
        let mut at = [10.0; 2];
        let on: Vec<Move> = places.iter().map(|(place, z, is_near)| {
            at = if *is_near { [0, 1].map(|axis| at[axis] + (place[axis] - 10.0) * 0.1) } else { *place };
            Move { way: Way::Feed, end: [at[0], at[1], *z], tool: 0, tilt: 0, turns: true, time: 0.0, line: 0 }
        }).collect();
        let stops = on.iter().flat_map(|own| [*own, Move { way: Way::Away, ..*own }]);
        let from = [on[0].end[0], on[0].end[1], 30.0];
        let [one, other] = [heights(&shape, diameter, from, on.iter().copied()), heights(&shape, diameter, from, stops)];
        // A cell on the very border of the tool may be cut by one of them only.
        let off = one.iter().zip(&other).filter(|(one, other)| (*one - *other).abs() > 0.000_1).count();
        prop_assert!(off <= 2, "{off} cells differ");
    }

    #[test]
    fn arcs(
        (shape, diameter) in shapes(),
        from in point(),
        arm in [-6.0..6.0_f64, -6.0..6.0_f64],
        sweep in -6.2..6.2_f64,
        climb in prop_oneof![Just(0.0), -3.0..3.0_f64],
        plane in prop_oneof![Just([0_u8, 1, 2]), Just([2, 0, 1]), Just([1, 2, 0])],
    ) {
        let [f, s, n] = plane.map(usize::from);
        let centre = [from[f] + arm[0], from[s] + arm[1]];
        let way = Way::Arc { plane, centre, sweep };
        let mut own = Move { way, end: from, tool: 0, tilt: 0, turns: true, time: 0.0, line: 0 };
        own.end = place(from, &own, 1.0);
        own.end[n] += climb;
        judge(&shape, diameter, from, own)?;
    }
}
