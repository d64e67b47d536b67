//! Tools that stand upright on tilted planes.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use ncc_simulate::{
    AlarmKind, Axes, Cutter, Fixture, HeightMap, Look, Move, Setup, Shape, Simulation, Stock, Tool, Way,
    draw, turned, turned_back,
};

/// Most that a height may be off at the centre of a cell, mm.
const MICRON: f64 = 0.001;

/// A plane turned about X, then about the Z that it had, degrees.
fn plane(about_x: f64, about_z: f64) -> Axes {
    let ((s, c), (sz, cz)) = (about_x.to_radians().sin_cos(), about_z.to_radians().sin_cos());
    [[cz, -sz * c, sz * s], [sz, cz * c, -cz * s], [0.0, s, c]]
}

fn tool(shape: &Shape, diameter: f64) -> Tool {
    let cutter = Cutter::new(shape, diameter, 30.0).expect("a tool");
    Tool { number: 1, cutter, flute: None, shank: None, holder: None, guessed: false }
}

/// A block 40 × 40 × 20 mm whose top is at Z0.
fn setup(tool: Tool, tilts: &[Axes], start: [f64; 3]) -> Setup {
    Setup {
        stock: Stock::Block { low: [0.0, 0.0, -20.0], high: [40.0, 40.0, 0.0] },
        guessed: false,
        cells: 200,
        tools: vec![tool],
        fixtures: Vec::new(),
        table: None,
        start,
        tilts: tilts.to_vec(),
    }
}

fn go(way: Way, end: [f64; 3], tilt: u16) -> Move {
    Move { way, end, tool: 0, tilt, turns: true, time: 0.0, line: 0 }
}

/// One move at feed on a plane.
fn cut(tool: Tool, axes: Axes, from: [f64; 3], to: [f64; 3]) -> Simulation {
    let mut simulation = Simulation::new(setup(tool, &[axes], from));
    simulation.push(go(Way::Feed, to, 1));
    simulation
}

fn removed(simulation: &Simulation) -> f64 {
    simulation.removed().iter().map(|removed| f64::from(removed.volume)).sum()
}

fn kinds(simulation: &Simulation) -> Vec<AlarmKind> {
    simulation.alarms().iter().map(|alarm| alarm.kind).collect()
}

/// Shows each cell: its centre and the spaces in the block over it, the lowest first.
fn each(map: &HeightMap, mut shown: impl FnMut([f64; 2], Vec<[f64; 2]>)) {
    for cell in map.grid.rows().flatten() {
        let height = map.heights[cell];
        let own = map.hollows.of(cell).iter().map(|own| own.map(f64::from));
        let open = (height < 0.0).then_some([f64::from(height), 0.0]);
        let spaces = own.chain(open).collect();
        shown(map.grid.centre_of(cell), spaces);
    }
}

fn same(one: &[[f64; 2]], other: &[[f64; 2]], within: f64) -> bool {
    let near = |(a, b): (&f64, &f64)| (a - b).abs() <= within;
    one.len() == other.len() && one.as_flattened().iter().zip(other.as_flattened()).all(near)
}

/// A bore from the left: over each cell a chord of its circle.
#[test]
fn a_level_bore() {
    let axes = plane(90.0, -90.0);
    assert!(
        axes.map(|row| row[2]).iter().zip([-1.0, 0.0, 0.0]).all(|(a, b)| (a - b).abs() < 1e-12),
        "{axes:?}"
    );
    for (end, length) in [(25.0, 25.0), (45.0, 40.0)] {
        let done = cut(tool(&Shape::Flat, 8.0), axes, [-5.0, 15.02, -9.0], [end, 15.02, -9.0]);
        each(done.map(), |[x, y], spaces| {
            let half = (16.0 - (y - 15.02_f64).powi(2)).sqrt();
            let expected = if x < end && half > 0.0 { vec![[-9.0 - half, -9.0 + half]] } else { Vec::new() };
            assert!(same(&spaces, &expected, MICRON), "X{x} Y{y}: {spaces:?}, not {expected:?}");
        });
        let volume = PI * 16.0 * length;
        assert!((removed(&done) - volume).abs() < volume * 0.002, "{}, not {volume}", removed(&done));
        let hollows = done.map().hollows_above(-20.0);
        assert!((hollows - volume).abs() < volume * 0.002, "{hollows}");
    }
}

/// The end of a mill on a face of 45°: the edge becomes a level chamfer.
#[test]
fn a_chamfer() {
    let axes = plane(45.0, 0.0);
    assert!((axes[1][2] + FRAC_1_SQRT_2).abs() < 1e-12 && (axes[2][2] - FRAC_1_SQRT_2).abs() < 1e-12);
    // Z = Y - 3 goes through the tip; the mill is 12 mm wide, the chamfer 4.2 mm.
    for (shape, wide) in [(Shape::Flat, 12.0), (Shape::BullNose { corner: 1.0 }, 14.0)] {
        let done = cut(tool(&shape, wide), axes, [-10.0, 1.5, -1.5], [50.0, 1.5, -1.5]);
        each(done.map(), |[x, y], spaces| {
            let expected = if y < 3.0 { vec![[y - 3.0, 0.0]] } else { Vec::new() };
            assert!(same(&spaces, &expected, MICRON), "{shape:?} X{x} Y{y}: {spaces:?}");
        });
        let volume = 3.0 * 3.0 / 2.0 * 40.0;
        assert!((removed(&done) - volume).abs() < volume * 0.001, "{}, not {volume}", removed(&done));
    }
}

/// A hole with its point, leaning by 30°: as much as along the axis, a third of that in the cone.
#[test]
fn a_leaning_hole() {
    let axes = plane(30.0, 50.0);
    let axis = axes.map(|row| row[2]);
    let tip = [20.0, 20.0, -13.0];
    let out = [0, 1, 2].map(|n: usize| tip[n] + 40.0 * axis[n]);
    let done = cut(tool(&Shape::Drill { point: 118.0 }, 6.0), axes, out, tip);
    let point = 3.0 / 59.0_f64.to_radians().tan();
    let length = 13.0 / axis[2];
    let volume = PI * 9.0 * (length - point + point / 3.0);
    assert!((removed(&done) - volume).abs() < volume * 0.002, "{}, not {volume}", removed(&done));
    // Straight above the tip it is as high as the tool is there: the wall.
    let wall = 3.0 / 30.0_f64.to_radians().sin();
    let at = done.map().grid.cell_at(20.05, 20.05).expect("a cell");
    let spaces = done.map().material(done.map().grid.index(at), -20.0);
    // The centre of that cell is 0.1 mm off along X and Y.
    assert!(
        (f64::from(spaces[0][1]) + 13.0).abs() < 0.3 && (f64::from(spaces[1][0]) + 13.0 - wall).abs() < 0.3
    );
    assert_eq!(kinds(&done), []);
    assert!(!done.map().hollows.is_empty());
}

/// Below the part there is nothing to take.
#[test]
fn a_hole_through_the_bottom() {
    for angle in [20.0_f64, 70.0] {
        let axes = plane(angle, 90.0);
        let axis = axes.map(|row| row[2]);
        let at = |along: f64| [0, 1, 2].map(|n: usize| [20.0, 20.0, -10.0][n] + along * axis[n]);
        let done = cut(tool(&Shape::Ball, 2.0), axes, at(80.0), at(-60.0));
        let long = if angle < 45.0 { 20.0 / axis[2] } else { 40.0 / axis[0] };
        assert!((removed(&done) - PI * long).abs() < PI * long * 0.02, "{angle}°: {}", removed(&done));
        assert!((removed(&done) - (32_000.0 - done.map().volume_above(-20.0))).abs() < 0.1);
    }
}

/// The top of a part under which a tool has cut is as it was.
#[test]
fn what_is_above_a_bore_is_untouched() {
    let done = cut(tool(&Shape::Flat, 8.0), plane(90.0, -90.0), [-5.0, 20.0, -9.0], [25.0, 20.0, -9.0]);
    let map = done.map();
    assert!(map.last.iter().all(|last| *last == 0));
    assert!(
        map.hollows.iter().count() > 1000 && map.hollows.iter().all(|(cell, _)| map.hollows.last(cell) == 1)
    );
}

/// Seen from a corner, a bore from the left is an ellipse of its tool's colour, as large as geometry says; from above there is
/// none.
#[test]
fn a_picture_shows_a_bore_from_a_corner() {
    let done = cut(tool(&Shape::Flat, 8.0), plane(90.0, -90.0), [-5.0, 20.0, -9.0], [25.0, 20.0, -9.0]);
    let coloured = |look| {
        let picture = draw(done.map(), -20.0, look, 1000, &|_| 0);
        let pixels = picture.pixels.chunks(4).filter(|pixel| i32::from(pixel[2]) - i32::from(pixel[0]) > 20);
        (pixels.count() as f64, picture.width.max(picture.height) as f64)
    };
    let cos = 30.0_f64.to_radians().cos();
    let (pixels, across) = coloured(Look::Corner);
    let expected = PI * 16.0 * cos * (across / (80.0 * cos)).powi(2);
    assert!((pixels - expected).abs() < 0.03 * expected, "{pixels} pixels, not {expected}");
    assert_eq!(coloured(Look::Plan).0, 0.0);
}

/// A ball that leans cuts as one that does not, as long as only the ball touches.
#[test]
fn a_ball_that_leans() {
    let ways = [[8.0, 9.0, 1.0], [8.0, 9.0, -1.5], [30.0, 25.0, -0.5], [12.0, 31.0, -1.4]];
    let mut upright = Simulation::new(setup(tool(&Shape::Ball, 10.0), &[], ways[0]));
    let axes = plane(25.0, 70.0);
    // The tip is below the centre, along the axis.
    let tip =
        |at: [f64; 3]| [at[0] - 5.0 * axes[0][2], at[1] - 5.0 * axes[1][2], at[2] + 5.0 - 5.0 * axes[2][2]];
    let mut leaning = Simulation::new(setup(tool(&Shape::Ball, 10.0), &[axes], tip(ways[0])));
    for at in &ways[1..] {
        upright.push(go(Way::Feed, *at, 0));
        leaning.push(go(Way::Feed, tip(*at), 1));
    }
    assert!(leaning.map().hollows.is_empty() && removed(&leaning) > 200.0);
    for cell in upright.map().grid.rows().flatten() {
        let [one, other] = [&upright, &leaning].map(|own| own.map().heights[cell]);
        assert!((one - other).abs() < 1e-3, "{one}, {other}");
    }
}

/// A tool that stands up from a plane has not cut what is below it then.
#[test]
fn a_move_after_one_on_a_plane() {
    let mut done = Simulation::new(setup(tool(&Shape::Flat, 10.0), &[plane(30.0, 0.0)], [20.0, 20.0, 10.0]));
    done.push(go(Way::Feed, [20.0, 20.0, -4.0], 1));
    done.push(go(Way::Feed, [22.0, 20.0, -4.0], 0));
    // The disc where it stood.
    let within = |at: &[f64; 2]| (at[0] - 20.0).hypot(at[1] - 20.0) < 4.9;
    let map = done.map();
    for cell in map.grid.rows().flatten().filter(|cell| within(&map.grid.centre_of(*cell))) {
        assert!(map.heights[cell] <= -4.0, "{:?}: {}", map.grid.centre_of(cell), map.heights[cell]);
    }
}

fn shapes() -> Vec<Shape> {
    vec![
        Shape::Flat,
        Shape::Ball,
        Shape::BullNose { corner: 1.3 },
        Shape::Drill { point: 118.0 },
        Shape::Chamfer { tip: 2.0, angle: 90.0 },
        Shape::Taper { corner: 0.0, angle: 10.0 },
        Shape::Taper { corner: 1.0, angle: 10.0 },
        Shape::Taper { corner: 4.0, angle: 10.0 },
        Shape::Profile(vec![[0.0, 0.0], [2.0, 0.5], [2.0, 3.0], [4.0, 4.0]]),
        Shape::Lollipop,
        Shape::TSlot,
    ]
}

/// A shape of 8 mm; a T-slot cutter is as thick as its flutes are long.
fn cutter(shape: &Shape) -> Cutter {
    Cutter::new(shape, 8.0, if *shape == Shape::TSlot { 4.0 } else { 30.0 }).expect("a tool")
}

/// On a plane that is not tilted at all, a tool cuts what it cuts upright.
#[test]
fn a_plane_that_is_not_tilted() {
    let mut rng = fastrand::Rng::with_seed(5);
    for shape in shapes() {
        for turn in [0.0, 37.0] {
            let axes = plane(0.0, turn);
            let own = || Tool { cutter: cutter(&shape), ..tool(&Shape::Flat, 8.0) };
            let start = [20.0, 20.0, 2.0];
            let mut both =
                [0, 1].map(|_| Simulation::new(Setup { cells: 90, ..setup(own(), &[axes], start) }));
            let mut at = start;
            for n in 0..12 {
                let mut end = [rng.f64() * 40.0, rng.f64() * 40.0, -rng.f64() * 10.0];
                let mut ways = [Way::Feed; 2];
                if n % 3 == 2 {
                    // An arc, level or a helix, or in the plane of X and Z.
                    let plane = if n % 2 == 0 || turn != 0.0 { [0_u8, 1, 2] } else { [2, 0, 1] };
                    let [f, s, normal] = plane.map(usize::from);
                    let centre = [0, 1].map(|n| at[[f, s][n]] + rng.f64() * 4.0 - 2.0);
                    let arm = [at[f] - centre[0], at[s] - centre[1]];
                    let sweep = rng.f64() * 6.0 - 3.0;
                    let (sin, cos) = sweep.sin_cos();
                    end[f] = centre[0] + arm[0] * cos - arm[1] * sin;
                    end[s] = centre[1] + arm[0] * sin + arm[1] * cos;
                    end[normal] = if n == 5 { at[normal] } else { at[normal] + 1.0 };
                    let back = |centre: [f64; 2]| {
                        let mut whole = [0.0; 3];
                        (whole[f], whole[s]) = (centre[0], centre[1]);
                        let back = turned_back(&axes, whole);
                        [back[f], back[s]]
                    };
                    ways = [centre, back(centre)].map(|centre| Way::Arc { plane, centre, sweep });
                }
                both[0].push(go(ways[0], end, 0));
                both[1].push(go(ways[1], end, 1));
                at = end;
            }
            let [one, other] = both.each_ref().map(Simulation::map);
            for cell in one.grid.rows().flatten() {
                let last =
                    both[0].map().last[cell].checked_sub(1).map(|last| both[0].moves()[last as usize].way);
                // Chords leave an arc by a little, which is more along Z where the tool is steep.
                let within = if matches!(last, Some(Way::Arc { .. })) { 0.02 } else { MICRON as f32 };
                let [one, other] = [one, other].map(|map| map.material(cell, -20.0));
                let flat = |all: &[[f32; 2]]| all.iter().map(|own| own[1] - own[0]).sum::<f32>();
                let by = (flat(&one) - flat(&other)).abs();
                assert!(by < within, "{shape:?} {turn}° {cell}: {one:?}, {other:?}");
            }
        }
    }
}

/// The part turned by 90° about Z with its plane and its moves is the same part turned.
#[test]
fn a_part_that_is_turned() {
    let quarter = |[x, y, z]: [f64; 3]| [40.0 - y, x, z];
    let mut rng = fastrand::Rng::with_seed(8);
    for shape in shapes() {
        let [axes, other_axes] = [plane(35.0, 20.0), plane(35.0, 110.0)];
        let own = || Tool { cutter: cutter(&shape), ..tool(&Shape::Flat, 8.0) };
        let start = [20.0, 20.0, 20.0];
        let mut one = Simulation::new(Setup { cells: 90, ..setup(own(), &[axes], start) });
        let mut other = Simulation::new(Setup { cells: 90, ..setup(own(), &[other_axes], quarter(start)) });
        for _ in 0..6 {
            let end = [rng.f64() * 40.0, rng.f64() * 40.0, -rng.f64() * 15.0];
            one.push(go(Way::Feed, end, 1));
            other.push(go(Way::Feed, quarter(end), 1));
        }
        let grid = one.map().grid;
        for cell in grid.rows().flatten() {
            let [column, row] = grid.place(cell);
            let [own, its] = [
                one.map().material(cell, -20.0),
                other.map().material(grid.index([grid.cells[0] - 1 - row, column]), -20.0),
            ];
            let [own, its] = [own, its].map(|all| all.iter().map(|own| own[1] - own[0]).sum::<f32>());
            assert!((own - its).abs() < 2e-3, "{shape:?} {column} {row}: {own}, {its}");
        }
    }
}

/// How far a place is outside of a tool: the tool is all that is above its surface.
fn outside(cutter: &Cutter, axes: &Axes, tip: [f64; 3], at: [f64; 3]) -> f64 {
    let [x, y, z] = turned_back(axes, [0, 1, 2].map(|n: usize| at[n] - tip[n]));
    let radius = x.hypot(y);
    match cutter.height(radius) {
        Some(height) => height - z,
        None => f64::INFINITY,
    }
}

/// Places a little within and a little outside of what was cut, held against the tool in many places of its way.
#[test]
fn what_is_cut_is_where_the_tool_was() {
    let mut rng = fastrand::Rng::with_seed(21);
    let mut held = 0;
    for shape in shapes().into_iter().filter(|shape| !matches!(shape, Shape::Lollipop | Shape::TSlot)) {
        for _ in 0..24 {
            let axes = plane(rng.f64() * 180.0, rng.f64() * 360.0);
            let mut place = || [rng.f64() * 40.0, rng.f64() * 40.0, -rng.f64() * 20.0];
            let (from, to) = (place(), place());
            let own = Tool { cutter: cutter(&shape), ..tool(&Shape::Flat, 8.0) };
            let mut done = Simulation::new(Setup { cells: 60, ..setup(own.clone(), &[axes], from) });
            done.push(go(Way::Feed, to, 1));
            let touches = |at: [f64; 3]| {
                let tip = |t: f64| [0, 1, 2].map(|n: usize| from[n] + t * (to[n] - from[n]));
                (0..=2000).any(|n| outside(&own.cutter, &axes, tip(f64::from(n) / 2000.0), at) < 0.0)
            };
            let cells: Vec<usize> = done.map().grid.rows().flatten().collect();
            for _ in 0..12 {
                let cell = cells[rng.usize(..cells.len())];
                let [x, y] = done.map().grid.centre_of(cell);
                let material = done.map().material(cell, -20.0);
                let z = -rng.f64() * 20.0;
                // Between two places of the tool there is a little that it takes as well.
                let is_material =
                    |z: f64| material.iter().any(|own| f64::from(own[0]) < z && z < f64::from(own[1]));
                let clear = [-0.02, 0.0, 0.02].map(|off| is_material(z + off));
                if clear[0] == clear[1] && clear[1] == clear[2] && z < -0.03 && z > -19.97 {
                    assert_eq!(
                        !clear[1],
                        touches([x, y, z]),
                        "{shape:?} {axes:?} {from:?} {to:?} X{x} Y{y} Z{z}"
                    );
                    held += 1;
                }
            }
        }
    }
    assert!(held > 2000, "{held}");
}

/// Rapids through material, and over what is cut already.
#[test]
fn rapids() {
    let axes = plane(50.0, 30.0);
    for shape in shapes() {
        let own = Tool { cutter: cutter(&shape), ..tool(&Shape::Flat, 8.0) };
        let at = |p: [f64; 3]| {
            let p = turned(&axes, p);
            [p[0] + 20.0, p[1] + 20.0, p[2]]
        };
        let mut done = Simulation::new(setup(own, &[axes], at([0.0, 0.0, 60.0])));
        for (way, end) in [
            (Way::Feed, [0.0, 0.0, -6.0]),
            (Way::Feed, [9.0, 0.0, -6.0]),
            (Way::Feed, [9.0, 7.0, -6.0]),
            (Way::Rapid, [9.0, 0.0, -6.0]),
            (Way::Rapid, [0.0, 0.0, -6.0]),
            (Way::Rapid, [0.0, 0.0, 60.0]),
            (Way::Rapid, [0.0, 0.0, -6.0]),
        ] {
            done.push(go(way, at(end), 1));
        }
        assert_eq!(kinds(&done), [], "{shape:?}: {:?}", done.alarms());
        done.push(go(Way::Rapid, at([0.0, 0.0, -6.1]), 1));
        assert_eq!(kinds(&done), [AlarmKind::Rapid], "{shape:?}");
        assert_eq!(done.alarms()[0].first, 8);
    }
}

/// What is above the flutes, on a plane that looks to the left: the tool goes in from there.
#[test]
fn what_is_above_the_flutes() {
    let axes = plane(90.0, -90.0);
    let with = |flute, shank, holder| Tool { flute, shank, holder, ..tool(&Shape::Flat, 8.0) };
    let bore = |own: Tool, end: f64| kinds(&cut(own, axes, [-5.0, 20.0, -9.0], [end, 20.0, -9.0]));
    assert_eq!(bore(with(Some(12.0), Some(3.5), Some([9.0, 30.0])), 20.0), []);
    assert_eq!(bore(with(Some(12.0), Some(3.5), Some([9.0, 15.0])), 20.0), [AlarmKind::Holder]);
    assert_eq!(bore(with(Some(12.0), Some(4.5), None), 11.9), []);
    assert_eq!(bore(with(Some(12.0), Some(4.5), None), 20.0), [AlarmKind::Shank]);
    // Down into the block from above, lying on its side: 12 mm of it cut, the rest is in material.
    let down = |flute| kinds(&cut(with(flute, None, None), axes, [20.0, 20.0, 10.0], [20.0, 20.0, -3.0]));
    assert_eq!((down(Some(12.0)), down(Some(30.0)), down(None)), (vec![AlarmKind::Flute], vec![], vec![]));
    // What the flutes do not reach stays.
    let mut done = cut(with(Some(12.0), None, None), axes, [20.0, 20.1, 10.0], [20.0, 20.1, -3.0]);
    let at = |x| done.map().height_at(x, 20.1);
    assert_eq!((at(7.9), at(8.2), at(19.9), at(20.2)), (Some(0.0), Some(-7.0), Some(-7.0), Some(0.0)));
    done.push(Move { turns: false, ..go(Way::Feed, [20.0, 20.0, -5.0], 1) });
    assert_eq!(kinds(&done), [AlarmKind::Flute, AlarmKind::Stopped]);
}

#[test]
fn fixtures_and_table() {
    let axes = plane(90.0, -90.0);
    let with = |flute: Option<f64>, [start, end]: [f64; 2], z: f64| {
        let fixtures = vec![Fixture {
            name: "jaw".into(),
            shape: Stock::Block { low: [-30.0, 0.0, -20.0], high: [-10.0, 40.0, -10.0] },
        }];
        let table = Some(-20.0);
        let own = Tool { flute, ..tool(&Shape::Flat, 8.0) };
        let mut done = Simulation::new(Setup { fixtures, table, ..setup(own, &[axes], [start, 20.0, z]) });
        done.push(go(Way::Feed, [end, 20.0, z], 1));
        kinds(&done)
    };
    let run = |end: f64, z: f64| with(None, [-50.0, end], z);
    assert_eq!(run(10.0, -5.9), []);
    assert_eq!(run(10.0, -6.1), [AlarmKind::Fixture]);
    assert_eq!(run(-35.0, -15.9), []);
    assert_eq!(run(-35.0, -16.1), [AlarmKind::Table]);
    // The flutes stay in front of the jaw, which the body above them hits.
    assert!(with(Some(12.0), [5.0, 10.0], -6.1).contains(&AlarmKind::Fixture));
    assert!(!with(Some(12.0), [5.0, 10.0], -5.9).contains(&AlarmKind::Fixture));
}

#[test]
fn any_state_can_be_shown_again() {
    let mut rng = fastrand::Rng::with_seed(4);
    let planes = [plane(90.0, -90.0), plane(40.0, 100.0)];
    let own = tool(&Shape::Ball, 4.0);
    let mut done = Simulation::new(Setup { cells: 70, ..setup(own, &planes, [20.0, 20.0, 30.0]) });
    let mut states = Vec::new();
    for n in 1..=11_000 {
        let end = [rng.f64() * 40.0, rng.f64() * 40.0, -rng.f64() * 20.0 * (n as f64 / 20_000.0)];
        done.push(go(if n % 8 == 0 { Way::Feed } else { Way::Away }, end, n as u16 / 8 % 2 + 1));
        if n % 500 == 0 {
            states.push((n, done.map().clone()));
        }
    }
    assert!(states.iter().any(|(_, map)| !map.hollows.is_empty()));
    for _ in 0..40 {
        let (moves, map) = &states[rng.usize(0..states.len())];
        done.seek(*moves);
        assert!(done.map() == map, "after {moves} moves");
    }
}
