//! The moves of programs with machine coordinates and with tilted planes.

use std::collections::BTreeMap;
use std::io::Cursor;

use ncc_dialects::{Settings, builtin};
use ncc_time::{Machine, Model};

use super::*;
use crate::job::Job;
use crate::source::Source;
use crate::time::drive::{Plan, Stage, Unwatched, drive};

/// The path of blocks of a Fanuc behind the usual head.
fn path(tables: Tables, blocks: &str) -> Path {
    let settings = Settings::new(builtin("fanuc").expect("a built-in dialect"));
    let job = Job::new(settings.clone(), settings, "a.nc");
    let plan = Plan {
        job: &job,
        machine: Machine::default(),
        tables,
        parameters: [None; 2],
        model: Model::Ideal,
        skip: 0,
        start_time: 0.0,
        stage: Stage::After,
        centre: false,
    };
    let text = format!("%\nO1\nG21 G17 G90 G94 G40 G49 G80 G54\n{blocks}M30\n%\n");
    let mut source = Source::of(Cursor::new(text), "a.nc");
    let mut recorder = Recorder::new(&plan.tables, false);
    let course = drive(&plan, &mut source, &mut recorder, &mut Unwatched).expect("memory");
    assert!(!course.refused, "{:?}", course.diagnostics);
    recorder.finish()
}

fn heights(path: &Path) -> Vec<(Way, f64)> {
    path.moves.iter().map(|own| (own.way, own.end[Z])).collect()
}

const BLOCKS: &str =
    "T1 M6\nS100 M3\nG0 X1. Y1.\nG43 H11 Z5.\nG1 Z-1. F100.\nG0 G49 Z5.\nG53 Z0.\nX9.\nG43 H11 Z2.\n";

/// Where work offset and length are stated, the tip is where it is; the length is that of the tool's own entry.
#[test]
fn a_place_of_the_machine_is_one_of_the_part_where_both_are_stated() {
    let length = 100 * ONE;
    let tables = Tables {
        work_offsets: BTreeMap::from([(1, [Some(0), Some(0), Some(-400 * ONE), None, None, None])]),
        lengths: BTreeMap::from([(11, length)]),
        edge_entries: BTreeMap::from([(1, 11)]),
        ..Tables::default()
    };
    let path = path(tables, BLOCKS);
    let all: Vec<f64> = heights(&path).iter().map(|own| own.1).collect();
    // The machine's zero is 400 mm above the part's, and the tool hangs 100 mm down from there. With G49 it is as long.
    assert_eq!(all, [300.0, 5.0, -1.0, -95.0, 300.0, 300.0, 2.0]);
    assert!(path.has_unknown_heights);
}

/// Without them the height of the tool is unknown there, and at the start.
#[test]
fn a_place_of_the_machine_says_nothing_of_the_part_where_nothing_is_stated() {
    let path = path(Tables::default(), BLOCKS);
    use Way::{Away, Feed, Rapid};
    let all =
        [(Away, 5.0), (Rapid, 5.0), (Feed, -1.0), (Rapid, 5.0), (Rapid, 5.0), (Away, 5.0), (Rapid, 2.0)];
    assert_eq!(heights(&path), all);
    assert!(path.has_unknown_heights && path.tools[0].number == 1);
}

const HEAD: &str = "T1 M6\nS900 M3\nG0 X0 Y0\nG43 H1 Z90.\n";

fn on_plane(blocks: &str) -> Path {
    path(Tables::default(), &format!("{HEAD}G68.2 X20. Y0 Z-5. I0 J30. K0\n{blocks}"))
}

fn why(path: &Path) -> Option<Unsimulated> {
    path.unsimulated.map(|(why, _)| why)
}

fn near(one: [f64; 3], other: [f64; 3]) -> bool {
    one.iter().zip(&other).all(|(a, b)| (a - b).abs() < 1e-9)
}

/// The place of the plane's X6 Y8 Z`z` on the part.
fn place(z: f64) -> [f64; 3] {
    let (sin, cos) = 30.0_f64.to_radians().sin_cos();
    [26.0, 8.0 * cos - z * sin, -5.0 + 8.0 * sin + z * cos]
}

const HOLE: &str = "G0 X6. Y8.\nG43 H1 Z50.\nZ2.\nG1 Z-12. F100.\nG0 Z50.\n";

/// Whatever is stated of the machine, points of a plane are those of the part.
#[test]
fn points_of_a_plane_are_places_of_the_part() {
    let tables = Tables {
        work_offsets: BTreeMap::from([(
            1,
            [Some(3 * ONE), Some(-7 * ONE), Some(-400 * ONE), None, None, None],
        )]),
        lengths: BTreeMap::from([(1, 100 * ONE)]),
        ..Tables::default()
    };
    for tables in [Tables::default(), tables] {
        let path = path(tables, &format!("{HEAD}G68.2 X20. Y0 Z-5. I0 J30. K0\nG53.1\n{HOLE}"));
        assert_eq!(why(&path), None);
        let moves = &path.moves[path.moves.len() - 5..];
        let ways = [Way::Away, Way::Rapid, Way::Rapid, Way::Feed, Way::Rapid];
        // Until Z is stated, it is as high as it ever is.
        for (own, (z, way)) in moves.iter().zip([50.0, 50.0, 2.0, -12.0, 50.0].into_iter().zip(ways)) {
            assert!(near(own.end, place(z)) && own.tilt == 1 && own.way == way, "{own:?}");
        }
        let axis = path.tilts[0].map(|row| row[2]);
        assert!(near(axis, [0.0, -0.5, 0.75_f64.sqrt()]) && path.tilts.len() == 1, "{axis:?}");
        assert!(path.has_unknown_heights);
    }
}

/// An arc on a plane keeps its centre and its sense along the plane's axes.
#[test]
fn arcs_are_those_of_the_plane() {
    let path = on_plane("G53.1\nG0 X6. Y8. Z2.\nG1 Z-12. F100.\nG2 X16. Y18. I10. J0.\n");
    assert_eq!(why(&path), None);
    let (from, own) = (path.moves[path.moves.len() - 2], path.moves[path.moves.len() - 1]);
    let Way::Arc { plane: [0, 1, 2], centre, sweep } = own.way else { panic!("{own:?}") };
    for at in [from.end, own.end].map(|at| turned_back(&path.tilts[0], at)) {
        let radius = (at[0] - centre[0]).hypot(at[1] - centre[1]);
        assert!((radius - 10.0).abs() < 1e-9 && (sweep + std::f64::consts::FRAC_PI_2).abs() < 1e-9, "{at:?}");
    }
}

#[test]
fn a_tool_that_is_not_upright_on_the_plane_is_refused() {
    assert_eq!(why(&on_plane(HOLE)), Some(Unsimulated::Tilted));
    let turned = format!("G53.1\nG0 B12.\n{HOLE}");
    assert_eq!(why(&on_plane(&turned)), Some(Unsimulated::Rotary));
}

/// Before the tool is upright on a plane, and while it is not, no move is one of a tool that leans as the plane does.
#[test]
fn rapids_are_those_of_a_tool_that_is_upright_on_the_plane() {
    let path = on_plane("G0 X6. Y8. Z50.\nG0 Z2.\nG53.1\nG0 X6. Y8. Z50.\nG0 Z2.\nG0 B12.\nG0 Z50.\n");
    assert_eq!(why(&path), None);
    let ways: Vec<_> = path.moves[path.moves.len() - 6..].iter().map(|own| (own.way, own.tilt)).collect();
    let away = (Way::Away, 0);
    assert_eq!(ways, [away, away, (Way::Away, 1), (Way::Rapid, 1), away, away]);
    // No tool moves upright on this plane.
    assert_eq!(on_plane("G0 X6. Y8. Z50.\nG0 Z2.\n").tilts.len(), 0);
}

/// A place of the machine says nothing of a plane.
#[test]
fn a_cut_from_a_place_that_nobody_knows_is_refused() {
    for blocks in [
        "G53.1\nG0 X6.\nZ2.\nG1 Z-12. F100.\n",
        "G53.1\nG0 X6. Y8.\nG91 Z2.\nG90 G1 Z-12. F100.\n",
        "G53.1\nG0 X6. Y8. Z2.\nG53 Z0\nG1 Z-12. F100.\n",
    ] {
        assert_eq!(why(&on_plane(blocks)), Some(Unsimulated::Unplaced), "{blocks}");
    }
    // What is stated is known, also where the numbers are those from before.
    let path = on_plane("G53.1\nG0 X0. Y0. Z90.\nG1 Z-12. F100.\n");
    assert_eq!((why(&path), path.moves.last().map(|own| own.way)), (None, Some(Way::Feed)));
}

/// After a plane the tool is upright again when all rotary axes of the program are where they were.
#[test]
fn a_plane_must_be_turned_back() {
    let after = |start: &str, blocks: &str| {
        let blocks = format!("G53.1\n{HOLE}G69\n{blocks}G1 Z-1. F100.\n");
        path(Tables::default(), &format!("{start}{HEAD}G68.2 X20. Y0 Z-5. I0 J30. K0\n{blocks}"))
    };
    let refused = |start: &str, blocks: &str| why(&after(start, blocks));
    let start = "G0 B0 C0\n";
    assert_eq!(refused(start, "G0 X1. Y1.\nG43 H1 Z5.\n"), Some(Unsimulated::Leaning));
    assert_eq!(refused(start, "G0 B0\nX1. Y1.\nG43 H1 Z5.\n"), Some(Unsimulated::Leaning));
    assert_eq!(refused(start, "G0 B0 C5.\nX1. Y1.\nG43 H1 Z5.\n"), Some(Unsimulated::Leaning));
    assert_eq!(refused(start, "G0 B0 C0\nX1. Y1.\nG43 H1 Z5.\n"), None);
    assert_eq!(refused("", "G53 Z0\nG0 B0\nX1. Y1.\nG43 H1 Z5.\n"), None);
    assert_eq!(refused(start, "G0 B0 C0\nX1.\nG43 H1 Z5.\n"), Some(Unsimulated::Unplaced));
    assert_eq!(refused(start, "G0 B0 C0\nX1. Y1.\n"), Some(Unsimulated::Unplaced));
    // A plane that is turned by nothing turns it back, too.
    let level = "G68.2 X0 Y0 Z0 I0 J0 K0\nG53.1\nG0 X1. Y1.\nG43 H1 Z5.\n";
    assert_eq!(refused(start, level), None);
    assert_eq!(refused(start, &format!("{level}G69\nG0 X2. Y2. Z5.\n")), None);
    // That is an assumption, which is reported.
    assert!(after(start, level).straightened);
    assert!(!after(start, "G0 B0 C0\nX1. Y1.\nG43 H1 Z5.\n").straightened);
}

/// Upright planes are cut as upright tools cut: moved, and turned about Z.
#[test]
fn a_plane_that_leans_by_nothing_has_no_tilt() {
    let blocks = "G53.1\nG0 X6. Y8. Z2.\nG1 Z-1. F100.\nG2 X16. Y18. I10. J0.\n";
    let path = path(Tables::default(), &format!("{HEAD}G68.2 X20. Y0 Z-5. I90. J0 K0\n{blocks}"));
    assert_eq!((why(&path), path.tilts.len()), (None, 0));
    let own = path.moves[path.moves.len() - 1];
    let Way::Arc { centre, .. } = own.way else { panic!("{own:?}") };
    // X16 Y8 of the plane, X16 Y18 of the plane.
    assert!(
        near([centre[0], centre[1], 0.0], [12.0, 16.0, 0.0]) && near(own.end, [2.0, 16.0, -6.0]),
        "{own:?}"
    );
    // An arc in another plane of it is one of its axes all the same.
    let path = self::path(
        Tables::default(),
        &format!(
            "{HEAD}G68.2 X20. Y0 Z-5. I90. J0 K0\nG53.1\nG0 X6. Y8. Z2.\nG1 Z-1. F100.\nG18 G2 X8. Z-3. R2.\n"
        ),
    );
    assert_eq!((why(&path), path.tilts.len(), path.moves.last().map(|own| own.tilt)), (None, 1, Some(1)));
}
