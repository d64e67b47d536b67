//! Tools on a thinner neck, which cut under what stays.

use ncc_simulate::{
    AlarmKind, Cutter, Hollows, Look, Move, Picture, Setup, Shape, Side, Simulation, Stock, Tool, Triangle,
    Way, covered, draw, faces, mesh,
};

/// Most that a height may be off at the centre of a cell, mm.
const MICRON: f32 = 0.001;

fn tool(shape: &Shape, diameter: f64, thick: f64, neck: Option<f64>) -> Tool {
    let cutter = Cutter::new(shape, diameter, thick).expect("a tool");
    let shank = neck.map(|neck| neck / 2.0);
    Tool { number: 1, cutter, flute: Some(thick), shank, holder: None, guessed: false }
}

/// A slot along Y in the middle of a block of 40 × 30 × 20 mm, 8 mm wide and 12 mm deep, and a second tool that stands in
/// it on its bottom.
fn slotted(second: Tool, cells: usize) -> Simulation {
    let mut simulation = Simulation::new(Setup {
        stock: Stock::Block { low: [0.0, 0.0, -20.0], high: [40.0, 30.0, 0.0] },
        guessed: false,
        cells,
        tools: vec![tool(&Shape::Flat, 8.0, 30.0, None), second],
        fixtures: Vec::new(),
        table: None,
        start: [20.0, -20.0, 50.0],
        tilts: Vec::new(),
    });
    let slot = |way, end, tool| Move { way, end, tool, tilt: 0, turns: true, time: 0.0, line: 0 };
    simulation.push(slot(Way::Rapid, [20.0, -20.0, -12.0], 0));
    simulation.push(slot(Way::Feed, [20.0, 50.0, -12.0], 0));
    simulation.push(slot(Way::Rapid, [20.0, 50.0, 50.0], 0));
    simulation.push(slot(Way::Rapid, [20.0, 50.0, -12.0], 1));
    simulation
}

fn go(way: Way, end: [f64; 3]) -> Move {
    Move { way, end, tool: 1, tilt: 0, turns: true, time: 0.0, line: 0 }
}

fn kinds(simulation: &Simulation) -> Vec<(AlarmKind, u32)> {
    simulation.alarms().iter().map(|alarm| (alarm.kind, alarm.first)).collect()
}

#[test]
fn a_t_slot() {
    let mut done = slotted(tool(&Shape::TSlot, 16.0, 5.0, Some(7.0)), 400);
    done.push(go(Way::Feed, [20.0, -20.0, -12.0]));
    // Back where all is free.
    done.push(go(Way::Rapid, [20.0, 50.0, -12.0]));
    assert_eq!(kinds(&done), []);
    let map = done.map();
    for cell in map.grid.rows().flatten() {
        let (height, off) = (map.heights[cell], (map.grid.centre_of(cell)[0] - 20.0).abs());
        let hollow: &[[f32; 2]] = if off > 4.0 && off <= 8.0 { &[[-12.0, -7.0]] } else { &[] };
        assert_eq!((height, map.hollows.of(cell)), (if off <= 4.0 { -12.0 } else { 0.0 }, hollow), "{off}");
    }
    let volumes: Vec<f32> = done.removed().iter().map(|removed| removed.volume).collect();
    assert!((volumes[4] - 2.0 * 4.0 * 30.0 * 5.0).abs() < 0.5 && volumes[5] == 0.0, "{volumes:?}");
    assert!((map.volume_above(-20.0) - (24_000.0 - 8.0 * 30.0 * 12.0 - 1_200.0)).abs() < 0.5);

    // Upwards in rapid the disc takes what is above it along.
    done.push(go(Way::Rapid, [20.0, 15.0, -12.0]));
    done.push(go(Way::Rapid, [20.0, 15.0, -2.0]));
    assert_eq!(kinds(&done), [(AlarmKind::Rapid, 8)]);
    // What a mill takes down to a hollow is as low as that.
    done.push(Move { tool: 0, ..go(Way::Feed, [27.0, 15.0, -8.0]) });
    let at = |x, y| done.map().height_at(x, y);
    assert_eq!((at(26.0, 15.0), at(27.9, 12.0), at(30.0, 15.0)), (Some(-12.0), Some(-12.0), Some(-8.0)));
}

#[test]
fn a_neck_that_is_too_thick_for_the_slot() {
    let mut done = slotted(tool(&Shape::TSlot, 16.0, 5.0, Some(9.0)), 200);
    done.push(go(Way::Feed, [20.0, -20.0, -12.0]));
    assert_eq!(kinds(&done), [(AlarmKind::Shank, 5)]);
    assert!((done.alarms()[0].depth - 7.0).abs() < 0.001);
}

#[test]
fn a_lollipop() {
    let mut done = slotted(tool(&Shape::Lollipop, 10.0, 9.0, None), 400);
    // 2 mm beside the slot, its centre 6 mm below the top.
    done.push(go(Way::Rapid, [22.0, 50.0, -11.0]));
    done.push(go(Way::Feed, [22.0, -20.0, -11.0]));
    assert_eq!(kinds(&done), []);
    let map = done.map();
    for cell in map.grid.rows().flatten() {
        let (height, x) = (map.heights[cell], map.grid.centre_of(cell)[0]);
        let half = (25.0 - (x - 22.0_f64).powi(2)).sqrt() as f32;
        match map.hollows.of(cell) {
            [] => assert!(half.is_nan() || (16.0..=24.0).contains(&x) && height <= -12.0, "X{x}: {height}"),
            [[low, high]] => {
                assert!(x > 24.0 && height == 0.0, "X{x}: {height}");
                assert!((low + 6.0 + half).abs() < MICRON && (high + 6.0 - half).abs() < MICRON, "X{x}");
            }
            all => panic!("X{x}: {all:?}"),
        }
    }
    // A helix that goes down, one turn over the other with material between.
    let mut helix = slotted(tool(&Shape::TSlot, 12.0, 1.0, None), 200);
    let way = Way::Arc { plane: [0, 1, 2], centre: [20.0, 15.0], sweep: 2.0 * std::f64::consts::TAU };
    helix.push(go(Way::Rapid, [22.0, 50.0, -2.0]));
    helix.push(go(Way::Feed, [22.0, 15.0, -2.0]));
    helix.push(go(way, [22.0, 15.0, -10.0]));
    let two = helix.map().hollows.iter().filter(|(_, own)| own.len() == 2).count();
    assert!(two > 100, "{two} cells");
}

#[test]
fn any_state_can_be_shown_again() {
    let mut rng = fastrand::Rng::with_seed(9);
    let mut done = slotted(tool(&Shape::TSlot, 6.0, 1.0, None), 60);
    let mut states = Vec::new();
    for n in 5..=17_000 {
        let end = [rng.f64() * 40.0, rng.f64() * 30.0, -15.0 + rng.f64() * 13.0];
        let mill = n % 40 == 0;
        done.push(Move {
            tool: usize::from(!mill),
            ..go(Way::Feed, if mill { [end[0], end[1], end[2] / 4.0] } else { end })
        });
        if n % 700 == 0 || n % 5_000 == 0 {
            states.push((n, done.map().clone()));
        }
    }
    assert!(states.iter().any(|(_, map)| !map.hollows.is_empty()));
    for _ in 0..60 {
        let (moves, map) = &states[rng.usize(0..states.len())];
        done.seek(*moves);
        assert!(done.map() == map, "after {moves} moves");
    }
}

#[test]
fn a_body_with_hollows_is_closed() {
    let mut done = slotted(tool(&Shape::TSlot, 16.0, 5.0, None), 80);
    done.push(go(Way::Feed, [20.0, 10.0, -12.0]));
    for step in [1, 3] {
        let (mut volume, mut sums, mut walls) = (0.0, [0.0_f64; 3], 0.0);
        mesh(done.map(), -20.0, step, &mut |[a, b, c]: Triangle| {
            let [a, b, c] = [a, b, c].map(|corner| corner.map(f64::from));
            let cross = |p: [f64; 3], q: [f64; 3]| {
                [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]
            };
            let normal = cross([0, 1, 2].map(|n| b[n] - a[n]), [0, 1, 2].map(|n| c[n] - a[n]));
            (0..3).for_each(|n| sums[n] += normal[n] / 2.0);
            walls += normal[0].abs() / 2.0;
            let of = cross(b, c);
            volume += (0..3).map(|n| a[n] * of[n]).sum::<f64>() / 6.0;
        });
        // Sides of the block, of the slot, and of the round end of the hollow: no walls within the body.
        assert!(walls < 2.0 * 30.0 * 20.0 + 2.0 * 30.0 * 12.0 + 200.0, "{walls} mm²");
        // The sum of what a closed body shows to each side is none.
        assert!(sums.iter().all(|sum| sum.abs() < 0.01), "{sums:?}");
        let expected = done.map().volume_above(-20.0);
        assert!(
            (volume - expected).abs() < if step == 1 { 0.1 } else { expected * 0.02 },
            "{volume}, not {expected}"
        );
    }
}

#[test]
fn faces_around_hollows_close_the_part() {
    let mut done = slotted(tool(&Shape::TSlot, 16.0, 5.0, Some(7.0)), 20);
    assert!(covered(done.map()).is_empty(), "no hollow yet");
    done.push(go(Way::Feed, [20.0, 12.0, -12.0]));
    let map = done.map();
    let covered = covered(map);
    let few = map.grid.rows().flatten().filter(|cell| !covered[*cell]).count();
    // Hollows from X 12 to X 28, cells of 2 mm: two columns on each side are further away than four cells.
    assert_eq!(few, 4 * map.grid.cells[1]);
    let all = faces(map, &vec![true; map.grid.len()], -20.0);

    // The volume by the divergence theorem, along each axis.
    let (mut along, mut long) = ([0.0; 3], 0);
    let area = map.grid.cell * map.grid.cell;
    for face in &all {
        let cell = face.cell as usize;
        let place = |axis: usize, n: usize| map.grid.centre(axis, n);
        let [column, row] = map.grid.place(cell);
        let [low, high] = face.between.map(f64::from);
        let length = f64::from(face.length);
        long += usize::from(face.length > 1);
        let wall = length * map.grid.cell * (high - low);
        let half = map.grid.cell / 2.0;
        match face.side {
            Side::Up => along[2] += length * area * (high + 20.0),
            Side::Down => along[2] -= length * area * (low + 20.0),
            Side::Right => along[0] += wall * (place(0, column) + half),
            Side::Left => along[0] -= wall * (place(0, column) - half),
            Side::Back => along[1] += wall * (place(1, row) + half),
            Side::Front => along[1] -= wall * (place(1, row) - half),
        }
    }
    let volume = map.volume_above(-20.0);
    for own in along {
        assert!((own - volume).abs() < 1e-6 * volume, "{own} {volume}");
    }
    assert!(long > all.len() / 2, "{long} of {} are long", all.len());
}

#[test]
fn a_picture_from_the_corner_looks_into_hollows() {
    let mut done = slotted(tool(&Shape::TSlot, 16.0, 5.0, Some(7.0)), 400);
    done.push(go(Way::Feed, [20.0, -20.0, -12.0]));
    let open = done.map().clone();
    let mut closed = open.clone();
    closed.hollows = Hollows::default();
    let [open, closed] = [&open, &closed].map(|map| draw(map, -20.0, Look::Corner, 800, &|_| 0));
    // Along X to the right and up, along Z up: the front of the block, X 0 to 40 and Z -20 to 0.
    let scale = 800.0 / (70.0 * 0.75_f64.sqrt());
    let at = |picture: &Picture, x: f64, z: f64| {
        let column = ((x + 30.0) * 0.75_f64.sqrt() * scale) as usize;
        let line = picture.height - ((x / 2.0 + z + 20.0) * scale) as usize;
        let first = 4 * (line * picture.width + column);
        picture.pixels[first..first + 4].to_vec()
    };
    // The neck's side, the disc's on both sides, what is below it, and beside it.
    for (x, z, is_hollow) in [
        (14.0, -9.0, true),
        (26.0, -9.5, true),
        (14.0, -5.0, false),
        (14.0, -15.0, false),
        (5.0, -9.0, false),
    ] {
        assert_eq!(at(&open, x, z) != at(&closed, x, z), is_hollow, "X{x} Z{z}");
    }
}
