//! Parts of which geometry says the heights and the volume.

use std::f64::consts::{PI, TAU};

use ncc_simulate::{AlarmKind, Cutter, Fixture, HeightMap, Move, Setup, Shape, Simulation, Stock, Tool, Way};

/// Most that a height may be off at the centre of a cell, mm.
const MICRON: f64 = 0.001;

fn tool(shape: &Shape, diameter: f64) -> Tool {
    let cutter = Cutter::new(shape, diameter, 30.0).expect("a tool");
    Tool { number: 1, cutter, flute: None, shank: None, holder: None, guessed: false }
}

/// A block 40 × 30 × 20 mm whose top is at Z0.
fn setup(tool: Tool) -> Setup {
    Setup {
        stock: Stock::Block { low: [0.0, 0.0, -20.0], high: [40.0, 30.0, 0.0] },
        guessed: false,
        cells: 400,
        tools: vec![tool],
        fixtures: Vec::new(),
        table: None,
        start: [0.0, 0.0, 10.0],
        tilts: Vec::new(),
    }
}

fn go(way: Way, end: [f64; 3]) -> Move {
    Move { way, end, tool: 0, tilt: 0, turns: true, time: 0.0, line: 0 }
}

/// What is left after moves at feed, the first of them from above.
fn cut(shape: &Shape, diameter: f64, moves: &[(Way, [f64; 3])]) -> Simulation {
    let mut simulation = Simulation::new(setup(tool(shape, diameter)));
    let (_, first) = moves[0];
    simulation.push(go(Way::Rapid, [first[0], first[1], 10.0]));
    moves.iter().for_each(|(way, end)| simulation.push(go(*way, *end)));
    simulation
}

/// Holds every cell against a formula; `None` where the formula says nothing.
fn holds(map: &HeightMap, height: impl Fn(f64, f64) -> Option<f64>) {
    let [width, rows] = map.grid.cells;
    for row in 0..rows {
        for column in 0..width {
            let (x, y) = (map.grid.centre(0, column), map.grid.centre(1, row));
            let Some(expected) = height(x, y) else { continue };
            let found = f64::from(map.heights[map.grid.index([column, row])]);
            assert!((found - expected).abs() <= MICRON, "X{x} Y{y}: {found}, not {expected}");
        }
    }
}

/// Holds the volume that was removed against a formula, within 0.1 % and half a cell along the border.
fn removes(simulation: &Simulation, volume: f64, border: f64, depth: f64) {
    let removed: f64 = simulation.removed().iter().map(|removed| f64::from(removed.volume)).sum();
    let within = volume * 0.001 + border * depth * simulation.map().grid.cell / 2.0;
    assert!((removed - volume).abs() <= within, "{removed} mm³, not {volume} ± {within}");
    let left = 40.0 * 30.0 * 20.0 - simulation.map().volume_above(-20.0);
    assert!(
        (left - removed).abs() <= 0.001 * removed.max(1.0),
        "{left} mm³ are missing, {removed} were removed"
    );
}

#[test]
fn a_slot() {
    let done = cut(&Shape::Flat, 8.0, &[(Way::Feed, [10.0, 15.0, -3.0]), (Way::Feed, [30.0, 15.0, -3.0])]);
    holds(done.map(), |x, y| {
        let distance = (y - 15.0).hypot(x - x.clamp(10.0, 30.0));
        Some(if distance <= 4.0 { -3.0 } else { 0.0 })
    });
    removes(&done, (20.0 * 8.0 + PI * 16.0) * 3.0, 40.0 + TAU * 4.0, 3.0);
}

#[test]
fn a_slot_across_the_grid_and_longer_than_a_piece() {
    let (from, to) = ([3.0, 4.0], [37.0, 26.0]);
    let done =
        cut(&Shape::Ball, 6.0, &[(Way::Feed, [from[0], from[1], -1.0]), (Way::Feed, [to[0], to[1], -1.0])]);
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    let along = [(to[0] - from[0]) / length, (to[1] - from[1]) / length];
    holds(done.map(), |x, y| {
        let part = ((x - from[0]) * along[0] + (y - from[1]) * along[1]).clamp(0.0, length);
        let distance = (x - from[0] - part * along[0]).hypot(y - from[1] - part * along[1]);
        // At its rim a ball stands upright.
        (!(2.99..=3.0).contains(&distance)).then(|| match distance < 3.0 {
            true => (-1.0 + 3.0 - (9.0 - distance * distance).sqrt()).min(0.0),
            false => 0.0,
        })
    });
}

#[test]
fn a_pocket() {
    let mut moves = vec![(Way::Feed, [10.0, 10.0, -2.0])];
    for n in 0..=5 {
        let y = 10.0 + f64::from(n) * 2.0;
        let [from, to] = if n % 2 == 0 { [10.0, 30.0] } else { [30.0, 10.0] };
        moves.extend([(Way::Feed, [from, y, -2.0]), (Way::Feed, [to, y, -2.0])]);
    }
    let done = cut(&Shape::Flat, 6.0, &moves);
    holds(done.map(), |x, y| {
        // Between the rows of its short sides the pocket ends in arcs.
        let inside = (10.0..=30.0).contains(&x) && (7.0..=23.0).contains(&y);
        let outside = !(7.0..=33.0).contains(&x) || !(7.0..=23.0).contains(&y);
        inside.then_some(-2.0).or(outside.then_some(0.0))
    });
}

#[test]
fn a_drilled_cone() {
    let done = cut(&Shape::Drill { point: 118.0 }, 10.0, &[(Way::Feed, [20.0, 15.0, -6.0])]);
    let point = 5.0 / 59.0_f64.to_radians().tan();
    holds(done.map(), |x, y| {
        let distance = (x - 20.0).hypot(y - 15.0);
        Some(if distance <= 5.0 { -6.0 + distance / 59.0_f64.to_radians().tan() } else { 0.0 })
    });
    removes(&done, PI * 25.0 * (6.0 - point) + PI * 25.0 * point / 3.0, TAU * 5.0, 6.0 - point);
}

#[test]
fn scallops_of_a_ball() {
    let (radius, step) = (4.0, 1.0);
    let mut moves = vec![(Way::Feed, [-10.0, 5.0, -3.0])];
    for n in 0..=20 {
        let y = 5.0 + f64::from(n) * step;
        let [from, to] = if n % 2 == 0 { [-10.0, 50.0] } else { [50.0, -10.0] };
        moves.extend([(Way::Feed, [from, y, -3.0]), (Way::Feed, [to, y, -3.0])]);
    }
    let done = cut(&Shape::Ball, 2.0 * radius, &moves);
    let scallop = radius - (radius * radius - step * step / 4.0_f64).sqrt();
    let mut highest = f64::NEG_INFINITY;
    holds(done.map(), |_, y| {
        (5.0..=25.0).contains(&y).then(|| {
            let off = (y - 5.0 - ((y - 5.0) / step).round() * step).abs();
            -3.0 + radius - (radius * radius - off * off).sqrt()
        })
    });
    for row in 60..240 {
        highest = highest.max(f64::from(done.map().heights[done.map().grid.index([200, row])]));
    }
    // The top of a scallop lies between cells: its slope there, over half a cell.
    let slope = step / 2.0 / (radius * radius - step * step / 4.0_f64).sqrt();
    assert!((highest - (-3.0 + scallop)).abs() <= slope * 0.05 + MICRON, "{highest}");
}

#[test]
fn ramps() {
    let (from, to) = ([8.0, 15.0, 0.0], [32.0, 15.0, -6.0]);
    let slope = -6.0 / 24.0;
    let flat = cut(&Shape::Flat, 8.0, &[(Way::Feed, from), (Way::Feed, to)]);
    holds(flat.map(), |x, y| {
        let half = 16.0 - (y - 15.0) * (y - 15.0);
        let on = half >= 0.0 && x >= 8.0 - half.sqrt() && x <= 32.0 + half.sqrt();
        Some(if on { ((x + half.sqrt()).min(32.0) - 8.0) * slope } else { 0.0 })
    });
    let ball = cut(&Shape::Ball, 8.0, &[(Way::Feed, from), (Way::Feed, to)]);
    // The lower surface of a ball that goes along a slope is a cylinder, which lies askew.
    let tilt = slope.atan();
    holds(ball.map(), |x, y| {
        let off = y - 15.0;
        let across = (16.0 - off * off).max(0.0).sqrt();
        let middle = x - across * tilt.sin();
        (off.abs() < 3.9 && (10.0..=30.0).contains(&middle))
            .then(|| (4.0 + (x - 8.0) * slope - across / tilt.cos()).min(0.0))
    });
}

#[test]
fn a_helix() {
    // Three turns about X20 Y15, 2 mm each, and one at the bottom.
    let way = |sweep| Way::Arc { plane: [0, 1, 2], centre: [20.0, 15.0], sweep };
    let done = cut(
        &Shape::Flat,
        6.0,
        &[
            (Way::Feed, [26.0, 15.0, 0.0]),
            (way(3.0 * TAU), [26.0, 15.0, -6.0]),
            (way(TAU), [26.0, 15.0, -6.0]),
        ],
    );
    holds(done.map(), |x, y| {
        let distance = (x - 20.0).hypot(y - 15.0);
        let near = (distance - 3.0).abs() < 0.000_6 || (distance - 9.0).abs() < 0.000_6;
        (!near).then(|| if (3.0..=9.0).contains(&distance) { -6.0 } else { 0.0 })
    });
    removes(&done, PI * (81.0 - 9.0) * 6.0, TAU * 12.0, 6.0);
    // One turn alone: at each place the end of the contact that is lowest.
    let turn = cut(&Shape::Flat, 6.0, &[(Way::Feed, [26.0, 15.0, 0.0]), (way(PI), [14.0, 15.0, -4.0])]);
    holds(turn.map(), |x, y| {
        let angle = (y - 15.0).atan2(x - 20.0);
        // On the middle of the way the tip has been half the angle of the tool further.
        let on = ((x - 20.0).hypot(y - 15.0) - 6.0).abs() < 1e-9 && (0.0..=2.0).contains(&angle);
        on.then(|| -4.0 * (angle + 2.0 * (3.0_f64 / 12.0).asin()) / PI)
    });
}

#[test]
fn an_arc_in_each_plane() {
    // A quarter in X and Z with a ball: the surface is that of a torus at its lowest.
    let way = Way::Arc { plane: [2, 0, 1], centre: [0.0, 10.0], sweep: -PI / 2.0 };
    let done = cut(&Shape::Ball, 4.0, &[(Way::Feed, [20.0, 15.0, 0.0]), (way, [10.0, 15.0, -10.0])]);
    assert!(done.map().height_at(10.05, 15.05).is_some_and(|height| height <= 0.0));
    let level = Way::Arc { plane: [0, 1, 2], centre: [20.0, 15.0], sweep: PI };
    let done = cut(&Shape::Ball, 4.0, &[(Way::Feed, [28.0, 15.0, -1.5]), (level, [12.0, 15.0, -1.5])]);
    holds(done.map(), |x, y| {
        let [x, y] = [x - 20.0, y - 15.0];
        let end = |at: f64| (x - at).hypot(y);
        let distance = if y >= 0.0 { (x.hypot(y) - 8.0).abs() } else { end(8.0).min(end(-8.0)) };
        (!(1.99..=2.0).contains(&distance)).then(|| match distance < 2.0 {
            true => (-1.5 + 2.0 - (4.0 - distance * distance).sqrt()).min(0.0),
            false => 0.0,
        })
    });
}

/// As wide as arcs are cut as such: single precision is fine enough.
#[test]
fn a_wide_level_arc() {
    let (centre, radius) = ([20.0, 913.0], 899.0);
    let place = |angle: f64| [centre[0] + radius * angle.sin(), centre[1] - radius * angle.cos(), -6.0];
    let way = Way::Arc { plane: [0, 1, 2], centre, sweep: 0.12 };
    let done = cut(&Shape::Drill { point: 90.0 }, 10.0, &[(Way::Feed, place(-0.06)), (way, place(0.06))]);
    holds(done.map(), |x, y| {
        let off = ((x - centre[0]).hypot(y - centre[1]) - radius).abs();
        match off {
            off if off < 4.999 => Some(-6.0 + off),
            off if off > 5.001 => Some(0.0),
            _ => None,
        }
    });
}

/// Only what the same tool has cut where a move starts is not cut again.
#[test]
fn a_wider_tool_goes_on_where_another_one_stood() {
    let tools = [4.0, 12.0].map(|diameter| tool(&Shape::Flat, diameter)).to_vec();
    let mut simulation = Simulation::new(Setup { tools, ..setup(tool(&Shape::Flat, 4.0)) });
    simulation.push(go(Way::Rapid, [16.0, 15.0, 10.0]));
    simulation.push(go(Way::Feed, [16.0, 15.0, -5.0]));
    simulation.push(Move { tool: 1, ..go(Way::Feed, [24.0, 15.0, -5.0]) });
    holds(simulation.map(), |x, y| {
        let off = (x - x.clamp(16.0, 24.0)).hypot(y - 15.0);
        match off {
            off if off < 5.999 => Some(-5.0),
            off if off > 6.001 => Some(0.0),
            _ => None,
        }
    });
}

/// Memory between the rows of cells holds no material, before and after a cut.
#[test]
fn cuts_beyond_the_border_stay_in_their_row() {
    for cells in [9, 10, 15, 16, 17, 100, 400] {
        let mut done = Simulation::new(Setup { cells, ..setup(tool(&Shape::Flat, 12.0)) });
        done.push(go(Way::Rapid, [38.0, -10.0, 10.0]));
        done.push(go(Way::Feed, [38.0, -10.0, -5.0]));
        done.push(go(Way::Feed, [38.0, 33.0, -5.0]));
        done.push(go(Way::Feed, [43.0, 15.0, -5.0]));
        let map = done.map();
        let rows: Vec<usize> = map.grid.rows().flatten().collect();
        assert_eq!(rows.len(), map.grid.cells[0] * map.grid.cells[1]);
        for cell in (0..map.grid.len()).filter(|cell| rows.binary_search(cell).is_err()) {
            assert_eq!((map.heights[cell], map.last[cell]), (HeightMap::NOTHING, 0));
        }
        holds(map, |x, y| match y < 30.0 {
            true if x < 31.9 => Some(0.0),
            true if x > 32.1 => Some(-5.0),
            _ => None,
        });
    }
}

#[test]
fn any_state_can_be_shown_again() {
    let mut rng = fastrand::Rng::with_seed(7);
    let mut simulation = Simulation::new(Setup { cells: 120, ..setup(tool(&Shape::Ball, 5.0)) });
    let mut states = vec![(0, simulation.map().clone())];
    for n in 1..=170_000 {
        let at = [rng.f64() * 40.0, rng.f64() * 30.0, -rng.f64() * n as f64 / 10_000.0];
        simulation.push(go(Way::Feed, at));
        if n % 3_700 == 0 || n % 40_000 == 0 {
            states.push((n, simulation.map().clone()));
        }
    }
    for _ in 0..60 {
        let (moves, map) = &states[rng.usize(0..states.len())];
        simulation.seek(*moves);
        assert!(simulation.map() == map, "after {moves} moves");
    }
}

/// Moves that are made after going back, and going back at once after moves, on a part of many tiles.
#[test]
fn moves_and_going_back_in_turn() {
    let mut rng = fastrand::Rng::with_seed(11);
    let mut simulation = Simulation::new(Setup { cells: 512, ..setup(tool(&Shape::Ball, 1.0)) });
    let mut states = vec![(0, simulation.map().clone())];
    for n in 1..=48_000 {
        // Now here, now there, and lower from time to time.
        let corner = [12.0 * (n / 4_000 % 3) as f64, 14.0 * (n / 4_000 % 2) as f64];
        let at = [corner[0] + rng.f64() * 9.0, corner[1] + rng.f64() * 9.0, -rng.f64() * n as f64 / 9_000.0];
        simulation.push(go(Way::Feed, at));
        if n % 2_300 == 0 {
            states.push((n, simulation.map().clone()));
        }
        if n % 5_900 == 0 {
            let (moves, map) = &states[states.len() - 1 - rng.usize(0..states.len().min(4))];
            simulation.seek(*moves);
            assert!(simulation.map() == map, "after {moves} of {n} moves");
        }
    }
}

#[test]
fn alarms() {
    let kinds = |simulation: &Simulation| -> Vec<_> {
        simulation.alarms().iter().map(|alarm| (alarm.kind, alarm.first, alarm.last, alarm.depth)).collect()
    };
    let flat = || tool(&Shape::Flat, 10.0);
    // In rapid through a corner of the block, twice.
    let mut rapid = Simulation::new(setup(flat()));
    rapid.push(go(Way::Rapid, [-20.0, 15.0, -2.0]));
    rapid.push(go(Way::Rapid, [20.0, 15.0, -2.0]));
    rapid.push(go(Way::Rapid, [20.0, 15.0, -3.5]));
    assert_eq!(kinds(&rapid), [(AlarmKind::Rapid, 2, 3, 2.0)]);
    // Along what is cut already nothing is stated.
    rapid.push(go(Way::Rapid, [20.0, 15.0, -1.0]));
    assert_eq!(rapid.alarms().len(), 1);

    let mut stopped = Simulation::new(setup(flat()));
    stopped.push(Move { turns: false, ..go(Way::Feed, [0.0, 0.0, -1.0]) });
    assert_eq!(kinds(&stopped), [(AlarmKind::Stopped, 1, 1, 1.0)]);
    // A rapid says it already.
    stopped.push(Move { turns: false, ..go(Way::Rapid, [20.0, 15.0, -1.0]) });
    assert_eq!(kinds(&stopped), [(AlarmKind::Stopped, 1, 1, 1.0), (AlarmKind::Rapid, 2, 2, 1.0)]);

    // Flutes of 5 mm, a shank of 12 mm and a holder of 40 mm that begins 12 mm above the tip.
    let long = Tool { flute: Some(5.0), shank: Some(6.0), holder: Some([20.0, 12.0]), ..flat() };
    let mut deep = Simulation::new(setup(long));
    deep.push(go(Way::Feed, [20.0, 15.0, 1.0]));
    deep.push(go(Way::Feed, [20.0, 15.0, -4.0]));
    assert_eq!(kinds(&deep), []);
    deep.push(go(Way::Feed, [20.0, 15.0, -13.0]));
    let found = kinds(&deep);
    assert_eq!(
        found.iter().map(|found| found.0).collect::<Vec<_>>(),
        [AlarmKind::Flute, AlarmKind::Shank, AlarmKind::Holder]
    );
    assert!((found[0].3 - 4.0).abs() < MICRON && (found[1].3 - 8.0).abs() < MICRON);
    assert!((found[2].3 - 1.0).abs() < MICRON);

    // The upper half of a circle in X and Z stays above the table; the lower half goes 2 mm below it.
    let half = |sweep| Way::Arc { plane: [2, 0, 1], centre: [3.0, 70.0], sweep };
    let mut above = Simulation::new(Setup { table: Some(0.0), start: [65.0, 70.0, 3.0], ..setup(flat()) });
    above.push(go(half(PI), [75.0, 70.0, 3.0]));
    assert_eq!(kinds(&above), []);
    above.push(go(half(PI), [65.0, 70.0, 3.0]));
    let found = kinds(&above);
    assert!(found[0].0 == AlarmKind::Table && (found[0].3 - 2.0).abs() < MICRON, "{found:?}");

    // Ends of arcs as programs have them, rounded to a thousandth of a millimetre, and straight up from there.
    let mut rng = fastrand::Rng::with_seed(11);
    for _ in 0..200 {
        let mut place = || [0, 1].map(|_| (rng.f64() * 8_000.0 - 4_000.0).round() / 1_000.0);
        let (arm, other) = (place(), place());
        let longer = arm[0].hypot(arm[1]) / other[0].hypot(other[1]);
        let end = other.map(|at| (at * longer * 1_000.0).round() / 1_000.0);
        let sweep = (arm[0] * end[1] - arm[1] * end[0]).atan2(arm[0] * end[0] + arm[1] * end[1]);
        let [from, to] = [arm, end].map(|[x, y]| [20.0 + x, 15.0 + y]);
        let mut rounded = Simulation::new(Setup { start: [from[0], from[1], 5.0], ..setup(flat()) });
        rounded.push(go(Way::Feed, [from[0], from[1], -5.0]));
        let way = Way::Arc { plane: [0, 1, 2], centre: [20.0, 15.0], sweep };
        rounded.push(go(way, [to[0], to[1], -5.0]));
        rounded.push(go(Way::Rapid, [to[0], to[1], 5.0]));
        assert_eq!(kinds(&rounded), [], "{arm:?} {end:?}");
    }

    // Back in rapid a thousandth of a millimetre beside what was cut, where that decides on a row of cells.
    let mut beside =
        Simulation::new(Setup { start: [10.0, 14.9995, 5.0], ..setup(tool(&Shape::Flat, 10.1)) });
    beside.push(go(Way::Feed, [10.0, 14.9995, -5.0]));
    beside.push(go(Way::Feed, [30.0, 14.9995, -5.0]));
    beside.push(go(Way::Rapid, [30.0, 15.0005, -5.0]));
    beside.push(go(Way::Rapid, [10.0, 15.0005, -5.0]));
    assert_eq!(kinds(&beside), []);

    // The end of an arc is farther from its centre than its start: the tool has been there, and leaves nothing.
    let mut wider = Simulation::new(Setup { start: [24.0, 15.0, 5.0], ..setup(flat()) });
    wider.push(go(Way::Feed, [24.0, 15.0, -5.0]));
    wider.push(go(Way::Arc { plane: [0, 1, 2], centre: [20.0, 15.0], sweep: PI / 2.0 }, [20.0, 19.4, -5.0]));
    wider.push(go(Way::Feed, [20.0, 19.4, 5.0]));
    assert!(wider.removed()[1].volume > 100.0 && wider.removed()[2].volume < 1e-6, "{:?}", wider.removed());

    let clamp = Stock::Block { low: [-10.0, 10.0, -20.0], high: [0.0, 20.0, 5.0] };
    let fixtures = vec![Fixture { name: "clamp".to_owned(), shape: clamp }];
    let mut held = Simulation::new(Setup { fixtures, table: Some(-20.5), ..setup(flat()) });
    held.push(go(Way::Rapid, [20.0, 25.0, 6.0]));
    held.push(go(Way::Rapid, [-5.0, 15.0, 6.0]));
    assert_eq!(kinds(&held), []);
    held.push(go(Way::Rapid, [-5.0, 15.0, 4.0]));
    held.push(go(Way::Feed, [60.0, 60.0, -21.0]));
    let found = kinds(&held);
    assert_eq!((found[0].0, found[1].0), (AlarmKind::Fixture, AlarmKind::Table));
    assert!((found[1].3 - 0.5).abs() < 1e-9, "{found:?}");
}
