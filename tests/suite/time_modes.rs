//! Times that depend on what is in force: the path mode, the tool's radius, the control's look-ahead, a canned
//! cycle. Each kind with inputs in the languages that have it.

use std::fs;

use serde_json::Value;

use crate::time::{Folder, time};

/// A machine without times of its own: 1000 mm/s², rapids at 12 m/min.
const AXES: &str = r#"
[times]
m_function = 0
block = 0
tool_change = 0
spindle_start = 0
spindle_stop = 0
[[axis]]
letter = "X"
rapid = 12000
acceleration = 1000
jerk = 100000
[[axis]]
letter = "Y"
rapid = 12000
acceleration = 1000
jerk = 100000
[[axis]]
letter = "Z"
rapid = 12000
acceleration = 1000
jerk = 100000
"#;

/// Seconds of a program, and what its timing takes for granted.
struct Timing {
    seconds: f64,
    assumed: Vec<String>,
}

impl Timing {
    fn says(&self, text: &str) -> bool {
        self.assumed.iter().any(|line| line.contains(text))
    }
}

/// Times a program on a machine: keys of its rates, and its tools.
fn timing(dialect: &str, rates: &str, tools: &str, program: &str) -> Timing {
    let folder = Folder::new();
    let (machine, file) = (folder.0.join("machine.toml"), folder.0.join("program"));
    let head = format!("id = \"shop\"\ntitle = \"Shop\"\ndialect = \"{dialect}\"\n[rates]\n{rates}\n");
    fs::write(&machine, format!("{head}{AXES}{tools}")).expect("a machine");
    fs::write(&file, program.replace(" / ", "\n") + "\n").expect("a program");
    let machine = machine.to_str().expect("a name");
    let arguments = ["--machine", machine, "--model", "trapezoidal", "--as", "json"];
    let output = time(&arguments, &[&file]).unwrap_or_else(|exit| panic!("{dialect} {program}: {exit:?}"));
    let report: Value = serde_json::from_slice(&output).expect("JSON");
    let program = &report["programs"][0];
    let clock: Vec<f64> =
        program["clock"].as_array().expect("a clock").iter().filter_map(Value::as_f64).collect();
    let assumed = program["assumed"].as_array().expect("a list").iter();
    Timing {
        seconds: clock[1] - clock[0],
        assumed: assumed.filter_map(Value::as_str).map(str::to_owned).collect(),
    }
}

/// A program round a square of 40 mm at 6 m/min, with words at its beginning and in each block.
fn square(dialect: &str, mode: &str, each: &str) -> String {
    let (head, end) = match dialect {
        "fanuc" => ("O1 / G21 G17 G90 G94 G54", "M30"),
        "siemens" => ("G710 G17 G90 G94 G54", "M30"),
        _ => ("G21 G17 G90 G94 G54", "M2"),
    };
    format!("{head} / {mode} / {each} G1 X40. F6000. / {each} Y40. / {each} X0. / {each} Y0. / {end}")
}

const TOLERANCE: &str = "path_tolerance = 0.02\nexact_stop = false\nlook_ahead = 1000";
/// Seconds of a side from rest to rest: 100 mm/s at 1000 mm/s².
const SIDE: f64 = 0.5;

#[test]
fn the_programs_path_mode_counts() {
    let same = |a: f64, b: f64, what: &str| assert!((a - b).abs() < 2e-6, "{what}: {a} is not {b}");
    for (dialect, stops, rounds, far) in [
        ("linuxcnc", &["G61.1", "G61"][..], "G64", "G64 P1"),
        ("siemens", &["G60"], "G64", "G641 ADIS=1"),
        ("fanuc", &["G61"], "G64", "G63"),
    ] {
        let seconds =
            |rates: &str, mode: &str| timing(dialect, rates, "", &square(dialect, mode, "")).seconds;
        let by_machine = seconds(TOLERANCE, "");
        assert!(by_machine < 4.0 * SIDE, "{dialect}");
        for mode in stops {
            same(seconds(TOLERANCE, mode), 4.0 * SIDE, mode);
        }
        // A machine that always stops, and a program that says that it shall not.
        let always = TOLERANCE.replace("false", "true");
        same(seconds(&always, ""), 4.0 * SIDE, dialect);
        same(seconds(&always, rounds), by_machine, rounds);
        same(seconds(TOLERANCE, rounds), by_machine, rounds);
        match far {
            "G63" => same(seconds(TOLERANCE, far), by_machine, far),
            far => assert!(seconds(TOLERANCE, far) < by_machine - 0.01, "{far}"),
        }
    }
    // Of one block alone.
    for (dialect, code) in [("fanuc", "G09"), ("siemens", "G9")] {
        let seconds = timing(dialect, TOLERANCE, "", &square(dialect, "G64", code)).seconds;
        same(seconds, 4.0 * SIDE, code);
    }
}

#[test]
fn a_corner_within_a_tolerance_has_the_speed_of_the_rule() {
    // The circle that comes no further from a right angle than 1 mm, at √2·1000 mm/s², and the ramps to it.
    let half = 45f64.to_radians();
    let corner = (2f64.sqrt() * 1000.0 * half.sin() / (1.0 - half.sin())).sqrt();
    let ramps = |from: f64, to: f64| {
        let lost = |v: f64| (100.0 - v).powi(2) / (2.0 * 1000.0 * 100.0);
        0.4 + lost(from) + lost(to)
    };
    let want = 2.0 * ramps(0.0, corner) + 2.0 * ramps(corner, corner);
    let got = timing("linuxcnc", TOLERANCE, "", &square("linuxcnc", "G64 P1", "")).seconds;
    assert!((got - want).abs() < 2e-6, "{got} {want}");
}

#[test]
fn what_nobody_says_of_corners_is_told_and_nothing_else() {
    let square = |mode| square("linuxcnc", mode, "");
    let open = timing("linuxcnc", "look_ahead = 1000", "", &square("G64"));
    assert!(
        open.says("where the program states none: 0.01 mm") && !open.says("exact stop"),
        "{:?}",
        open.assumed
    );
    let stated = timing("linuxcnc", "look_ahead = 1000", "", &square("G64 P0.1"));
    assert!(!stated.says("path tolerance"), "{:?}", stated.assumed);
    let unsaid = timing("linuxcnc", "look_ahead = 1000", "", &square(""));
    assert!(unsaid.says("path tolerance = 0.01 mm") && unsaid.says("exact stop"), "{:?}", unsaid.assumed);
}

/// A contour of 40 mm, gone round outside; the tool comes from 20 mm beside it.
fn contour(dialect: &str) -> String {
    let (head, end) = match dialect {
        "fanuc" => ("O1 / G21 G17 G90 G94 G54", "M30"),
        "haas" => ("% / O00001 / G21 G17 G90 G94 G54", "M30 / %"),
        _ => ("G21 G17 G90 G94 G54", "M2"),
    };
    format!("{head} / G0 X-20. Y-20. / G41 D1 G1 X0. F1200. / Y40. / X40. / Y0. / X0. / G40 X-20. / {end}")
}

#[test]
fn a_contour_takes_the_time_of_the_tools_centre() {
    let tool = "[[tool]]\nnumber = 1\ndiameter = 10\n";
    for dialect in ["linuxcnc", "fanuc", "haas"] {
        let contour = contour(dialect);
        let along = timing(dialect, TOLERANCE, "", &contour);
        let words = "timed as programmed: no radius is stated for D1";
        assert!(along.says(words), "{dialect}: {:?}", along.assumed);
        let centre = timing(dialect, TOLERANCE, tool, &contour);
        assert!(!centre.says("timed as programmed"), "{dialect}: {:?}", centre.assumed);
        // Three outer corners by quarter circles of 5 mm at 20 mm/s, and less on the way there and back.
        assert!(centre.seconds > along.seconds + 0.5, "{dialect}: {} {}", centre.seconds, along.seconds);
        // A tool of nothing is the contour.
        let none = timing(dialect, TOLERANCE, "[[tool]]\nnumber = 1\ndiameter = 0\n", &contour);
        assert!((none.seconds - along.seconds).abs() < 2e-6, "{dialect}");
        assert!(!none.says("timed as programmed"), "{dialect}: {:?}", none.assumed);
    }
}

#[test]
fn a_longer_radius_makes_a_longer_way_by_its_arcs() {
    // Round a square outside, corners and all: the contour, and a whole circle of the radius.
    let seconds = |diameter: f64| {
        let tool = format!("[[tool]]\nnumber = 1\ndiameter = {diameter}\n");
        let program = "G21 G17 G90 G94 G54 / G0 X-20 Y20 / G41 D1 G1 X0 F1200 / Y40 / X40 / Y0 / X0 / Y20 / \
                       G40 X-20 / M2";
        // All corners at full speed: nothing counts but the way.
        timing("linuxcnc", "path_tolerance = 100\nlook_ahead = 1000", &tool, program).seconds
    };
    let way = |radius: f64| 160.0 + std::f64::consts::TAU * radius;
    let (small, large) = (seconds(4.0), seconds(10.0));
    // Ways to the contour and from it get shorter by the radius.
    let want = (way(5.0) - way(2.0) - 2.0 * 3.0) / 20.0;
    assert!((large - small - want).abs() < 0.15, "{} {want}", large - small);
}

#[test]
fn a_contour_that_the_tool_does_not_fit_into_is_timed_as_programmed() {
    let tool = "[[tool]]\nnumber = 1\ndiameter = 10\n";
    // Inside a slot of 6 mm.
    let slot = "G21 G17 G90 G94 G54 / G0 X-20 Y-20 / G42 D1 G1 X0 F1200 / Y40 / X6 / Y0 / G40 X-20 / M2";
    let timed = timing("linuxcnc", TOLERANCE, tool, slot);
    assert!(timed.says("from line 6 on, contours are timed as programmed"), "{:?}", timed.assumed);
    let plain = timing("linuxcnc", TOLERANCE, "", slot);
    assert!((timed.seconds - plain.seconds).abs() < 1.0, "{} {}", timed.seconds, plain.seconds);
}

/// F along the contour takes the time of the contour, whatever the tool's radius; F at the tool centre that of its path.
#[test]
fn a_compensated_arc_takes_the_time_of_what_f_counts() {
    // Ten times round: inside of a circle of 20 mm, and outside of one of 10 mm.
    let circles = |code: &str, side: &str, x: u32| {
        let circle = format!("G3 I-{x} / ").repeat(10);
        format!(
            "G710 G17 G90 G94 G54 {code} / T1 M6 / D1 / G0 X0 Y0 / G1 F1200 / {side} G1 X{x} Y0 / {circle}G40 G1 X0 Y0 / M30"
        )
    };
    let fast = "path_tolerance = 100\nexact_stop = false\nlook_ahead = 1000";
    let seconds = |code: &str, side: &str, x: u32, diameter: u32| {
        let tool = format!("[[tool]]\nnumber = 1\ndiameter = {diameter}\n");
        timing("siemens", fast, &tool, &circles(code, side, x)).seconds
    };
    // Circles at 20 mm/s; ways to them and from them, and slower starts, take less than this.
    let near = |seconds: f64, radius: f64| {
        let want = 10.0 * std::f64::consts::TAU * radius / 20.0;
        assert!(seconds > want && seconds < want + 4.0, "{seconds} {want}");
    };
    for code in ["CFC", ""] {
        near(seconds(code, "G41", 20, 10), 20.0);
        near(seconds(code, "G42", 20, 10), 20.0);
    }
    near(seconds("CFTCP", "G41", 20, 10), 15.0);
    near(seconds("CFTCP", "G42", 20, 10), 25.0);
    near(seconds("CFIN", "G41", 20, 10), 20.0);
    near(seconds("CFIN", "G42", 20, 10), 25.0);
}

/// 600 blocks of 0.1 mm at 9 m/min.
fn short_blocks(dialect: &str) -> String {
    let head =
        if dialect == "fanuc" { "O1 / G21 G17 G90 G94 G54 F9000." } else { "G21 G17 G90 G94 G54 F9000." };
    let blocks: Vec<String> = (1..=600).map(|i| format!("G1 X{}.{}", i / 10, i % 10)).collect();
    let end = if dialect == "linuxcnc" { "M2" } else { "M30" };
    format!("{head} / {} / {end}", blocks.join(" / "))
}

#[test]
fn a_control_that_sees_few_blocks_is_slower() {
    for dialect in ["linuxcnc", "fanuc", "haas"] {
        let program = match dialect {
            "haas" => format!("% / O00001 / {} / %", short_blocks("haas")),
            other => short_blocks(other),
        };
        let free = timing(dialect, "", "", &program);
        assert!(free.says("look-ahead = the whole path"), "{:?}", free.assumed);
        let mut last = free.seconds;
        for blocks in [200, 16, 3] {
            let rates = format!("look_ahead = {blocks}");
            let limited = timing(dialect, &rates, "", &program);
            assert!(!limited.says("look-ahead"), "{:?}", limited.assumed);
            assert!(limited.seconds >= last, "{dialect} {blocks}: {} {last}", limited.seconds);
            last = limited.seconds;
        }
        // v² = 2·1000·1.6 mm: 56.6 mm/s instead of 150.
        let sixteen = timing(dialect, "look_ahead = 16", "", &program).seconds;
        assert!((sixteen - (60.0 / 56.57 + 56.57 / 1000.0)).abs() < 0.02, "{dialect}: {sixteen}");
    }
}

#[test]
fn cycles_of_linuxcnc_are_driven_through_every_point() {
    let program = |mode: &str, holes: &str| {
        format!("G21 G17 G90 G94 G54 G99 / {mode} / S1000 M3 / G0 X0 Y0 Z5 / {holes} / G80 / M2")
    };
    for holes in [
        "G81 X0 Y0 Z-3 R2 F300 / X3 / X6 / X9",
        "G82 X0 Y0 Z-3 R2 P0.1 F300 / Y4 / Y8",
        "G83 X0 Y0 Z-3 R2 Q1 F300 / X2 Y2 / X4 Y4",
    ] {
        let wide = timing("linuxcnc", TOLERANCE, "", &program("G64 P5", holes)).seconds;
        let exact = timing("linuxcnc", TOLERANCE, "", &program("G61", holes)).seconds;
        assert!((wide - exact).abs() < 2e-6, "{holes}: {wide} {exact}");
    }
    // The same moves, written out, are blended.
    let moves = "G0 Z2 / G1 Z-3 F300 / G0 Z2 / X3 / G1 Z-3 / G0 Z2 / X6 / G1 Z-3 / G0 Z2";
    let cycle = "G81 X0 Y0 Z-3 R2 F300 / X3 / X6";
    let by_cycle = timing("linuxcnc", TOLERANCE, "", &program("G64 P5", cycle)).seconds;
    let by_moves = timing("linuxcnc", TOLERANCE, "", &program("G64 P5", moves)).seconds;
    assert!(by_moves < by_cycle - 0.02, "{by_moves} {by_cycle}");
}
