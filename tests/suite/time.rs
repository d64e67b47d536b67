//! `ncc time`: the case study's figures, sessions whose output somebody has read, and what must hold
//! of every program. What is told of wrong programs is tested in `cli/tests`.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

use clap::Parser;
use codespan_reporting::term::termcolor::NoColor;
use ncc::args::{Cli, Verb};
use ncc::registry::DialectRegistry;
use ncc_driver::problem::Exit;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::{self, Failures};

use crate::shared::beside;

/// The case study's machine, and its way to book a tool change.
const STUDY: [&str; 4] = ["--machine", "romi-discovery-4022", "--tool-change-on", "select"];

/// Runs `ncc time`; the output, if the program is not refused.
pub(crate) fn time(arguments: &[&str], files: &[&Path]) -> Result<Vec<u8>, Exit> {
    let folder = Folder::new();
    let output = folder.0.join("output");
    let mut all: Vec<OsString> = ["ncc", "time", "--quiet", "-o"].map(OsString::from).into();
    all.push(output.clone().into());
    all.extend(arguments.iter().map(OsString::from));
    all.extend(files.iter().map(|path| path.as_os_str().to_owned()));
    let Verb::Time(asked) = Cli::try_parse_from(all).expect("arguments").verb else { panic!("another verb") };
    // What is told is not for whoever runs the tests.
    let mut told = NoColor::new(Vec::new());
    match ncc::time::run(&asked, &DialectRegistry::built_in(), &mut told) {
        Ok(Exit::Done) => Ok(fs::read(output).expect("an output")),
        Ok(other) => Err(other),
        Err(problem) => Err(problem.exit),
    }
}

/// A folder that goes with the test.
pub(crate) struct Folder(pub(crate) PathBuf);

impl Folder {
    pub(crate) fn new() -> Folder {
        use std::sync::atomic::{AtomicU32, Ordering};
        static COUNT: AtomicU32 = AtomicU32::new(0);
        let name = format!("ncc-time-{}-{}", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).expect("a folder");
        Folder(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Rows of CSV without quotes, the header first.
fn rows(text: &[u8]) -> Vec<Vec<String>> {
    let text = String::from_utf8_lossy(text);
    text.lines().map(|line| line.trim_end_matches('\r').split(',').map(str::to_owned).collect()).collect()
}

/// Rows of a program as functions of the case study's machine.
fn study(arguments: &[&str], file: &Path) -> Vec<Vec<String>> {
    let all = [&STUDY[..], &["--as", "csv"], arguments].concat();
    rows(&time(&all, &[file]).expect("the program is executed"))
}

fn teste() -> PathBuf {
    corpus::root().join("corpus/mach9/teste.cn")
}

const NAME: usize = 2;
const STAMP: usize = 10;

/// The figures that the case study prints for its first tool, in seconds.
#[test]
fn the_first_tool_has_the_printed_stamps() {
    let rows = study(&[], &teste());
    for (name, stamp) in [
        ("CHANGE_TOOL", "7"),
        ("START_SPINDLE_CLOCKWISE", "9"),
        ("STRAIGHT_TRAVERSE", "9.432"),
        ("STRAIGHT_TRAVERSE", "9.452"),
        ("STRAIGHT_FEED", "35.828"),
        ("STOP_SPINDLE_TURNING", "37.828"),
    ] {
        let printed = |row: &&Vec<String>| row[NAME] == name && same(&row[STAMP], stamp);
        assert!(rows.iter().skip(1).any(|row| printed(&row)), "{name} at {stamp}");
    }
}

/// Whether a computed value, rounded to the digits of a printed one, is that.
fn same(computed: &str, printed: &str) -> bool {
    let digits = printed.split_once('.').map_or(0, |(_, part)| part.len());
    let (a, b): (f64, f64) = match (computed.parse(), printed.parse()) {
        (Ok(a), Ok(b)) => (a, b),
        (_, _) => return computed == printed,
    };
    // Printed zeros at the end are left away: 0.12 is 0.120.
    let scale = 10f64.powi(digits.max(3) as i32);
    (a * scale).round() == (b * scale).round()
}

/// Table 11: every row, every column, from the state that it begins in.
#[test]
fn table_11_is_reproduced() {
    let Some(folder) = beside("cases/mach9") else { return };
    is_table_11(&study(&FROM_TABLE_9, &folder.join("table9.cn")), &folder);
}

/// The same with the machine file of table 10, which names no control.
#[test]
fn table_11_comes_out_with_the_machine_file() {
    let Some(folder) = beside("cases/mach9") else { return };
    let own = Folder::new();
    let machine = own.0.join("machine.json");
    let table_10 = r#"{ "name": "romi", "tool_change_time": 7, "max_feed": 15000, "start_spindle_time": 2 }"#;
    fs::write(&machine, table_10).expect("a file");
    let machine = machine.to_string_lossy();
    let options = ["--machine", &*machine, "--tool-change-on", "select", "--from", "mach9", "--as", "csv"];
    let all = [&options[..], &FROM_TABLE_9].concat();
    let ours = time(&all, &[&folder.join("table9.cn")]).expect("the program is executed");
    is_table_11(&rows(&ours), &folder);
}

/// The state in which table 9 begins.
const FROM_TABLE_9: [&str; 4] = ["--start", "X-9,Y15.588,Z3", "--start-time", "84.191448"];

fn is_table_11(ours: &[Vec<String>], folder: &Path) {
    let printed = rows(&fs::read(folder.join("table11.csv")).expect("the table"));
    assert_eq!(printed.len(), 24);
    assert_eq!(ours.len(), printed.len());
    for (k, (ours, printed)) in ours.iter().zip(&printed).enumerate().skip(1) {
        for (column, value) in printed.iter().enumerate() {
            let own = &ours[column + 2];
            // Positions are printed to two digits.
            let good = match column {
                1..=3 => (own.parse::<f64>().unwrap() - value.parse::<f64>().unwrap()).abs() < 0.005,
                _ => same(own, value),
            };
            assert!(good, "row {k}, {}: {own} is not {value}", printed[0]);
        }
    }
}

/// The blocks that the case study prints of its document (ch. 5): G81, G25 and G80 of the third tool. Its G81 has the
/// parameters of the second tool, z -6 and f 191, which is a slip: the block says Z-8 and F186.
#[test]
fn the_printed_form_is_the_case_studys() {
    let printed = [
        r#""cut_offset":0,"feed":186,"speed":1857,"tool":3,"dx":0.0,"dy":0.0,"dz":0.0,"distance":0.0,"time":0.0,"timestamp":0.0,"parameters":[{"z":-8.0,"r":3.0,"f":186}]}"#,
        r#""cut_offset":0,"feed":0,"speed":0,"tool":3,"dx":0.0,"dy":0.0,"dz":0.0,"distance":0.0,"time":0.0,"timestamp":0.0,"parameters":[{"x":30.0,"y":130.0,"i":2,"j":2}]}"#,
        r#""cut_offset":0,"feed":0,"speed":1857,"tool":3,"dx":0.0,"dy":0.0,"dz":0.0,"distance":0.0,"time":0.0,"timestamp":0.0,"parameters":[{}]}"#,
    ];
    let names = [("G81", "START_CYCLE"), ("G25", "RECTANGULAR_LAYOUT"), ("G80", "END_CYCLE")]
        .map(|(gcode, name)| format!(r#"{{"gcode":"{gcode}","function_name":"{name}","x0":"#));
    let machine = ["--machine", "romi-discovery-4022", "--as", "payload-printed", "--stage", "before"];
    let all = [&machine[..], &["--from-option", "o_word=ignore"]].concat();
    let text =
        time(&all, &[&corpus::root().join("corpus/mach9/table9.cn")]).expect("the program is executed");
    let text = String::from_utf8(text).expect("text");
    assert!(text.contains(r#""machine_name": "romi-discovery-4022""#), "{text}");
    for (name, printed) in names.iter().zip(printed) {
        let block = text.lines().find(|line| line.trim().starts_with(name)).expect("the block");
        assert!(block.trim().trim_end_matches(',').ends_with(printed), "{block}");
    }
}

/// The whole program executed literally, row by row; it was computed by another program.
#[test]
fn the_literal_run_is_reproduced() {
    let Some(folder) = beside("cases/mach9") else { return };
    let ours = study(&["--from-option", "cycle_approach=retract"], &folder.join("teste.cn"));
    let literal = rows(&fs::read(folder.join("timeline_literal.csv")).expect("the table"));
    assert_eq!(literal.len(), 119);
    let mut failures = Failures::default();
    for (ours, literal) in ours.iter().zip(&literal) {
        let cycle = literal[1].contains(" / ");
        // The other program writes `GZ5` for the source's `GZ5.`.
        let block = ours[1].trim_end_matches('.') == literal[1].trim_end_matches('.');
        if !(cycle || block) || ours[0] != literal[0] || ours[2..] != literal[2..] {
            failures.add(&literal[0], format!("{}\n{}", literal.join(","), ours.join(",")));
        }
    }
    assert_eq!(ours.len(), literal.len());
    failures.finish();
}

/// Sessions: the file in `tests/time`, the arguments, the programs of the corpus.
const SESSIONS: &[(&str, &[&str], &[&str])] = &[
    ("teste.txt", &["--machine", "romi-discovery-4022"], &["mach9/teste.cn"]),
    ("teste.csv", &["--machine", "romi-discovery-4022", "--as", "csv"], &["mach9/teste.cn"]),
    (
        "teste-before.json",
        &["--machine", "romi-discovery-4022", "--as", "payload", "--stage", "before"],
        &["mach9/teste.cn"],
    ),
    (
        "table9-printed-before.json",
        &[
            "--machine",
            "romi-discovery-4022",
            "--as",
            "payload-printed",
            "--stage",
            "before",
            "--start",
            "X-9,Y15.588,Z3",
            "--from-option",
            "o_word=ignore",
        ],
        &["mach9/table9.cn"],
    ),
    (
        "table9-printed.json",
        &["--machine", "romi-discovery-4022", "--as", "payload-printed", "--start", "X-9,Y15.588,Z3"],
        &["mach9/table9.cn"],
    ),
    ("teste.canon", &["--machine", "romi-discovery-4022", "--as", "canon"], &["mach9/teste.cn"]),
    (
        "table9.ndjson",
        &["--machine", "romi-discovery-4022", "--as", "ndjson", "--start", "X-9,Y15.588,Z3"],
        &["mach9/table9.cn"],
    ),
    ("calls.txt", &["--machine", "fanuc-vmc"], &["fanuc/calls.nc"]),
    ("calls.csv", &["--machine", "fanuc-vmc", "--as", "csv"], &["fanuc/calls.nc"]),
    ("calls-trapezoidal.txt", &["--machine", "fanuc-vmc", "--model", "trapezoidal"], &["fanuc/calls.nc"]),
    ("skip-off.csv", &["--machine", "fanuc-vmc", "--as", "csv"], &["fanuc/skip.nc"]),
    ("skip-on.csv", &["--machine", "fanuc-vmc", "--as", "csv", "--skip", "1,2"], &["fanuc/skip.nc"]),
    ("arcs-zx.json", &["--from", "fanuc", "--as", "payload"], &["fanuc/arcs-zx.nc"]),
    ("inch.txt", &["--machine", "fanuc-vmc"], &["fanuc/inch.nc"]),
    ("rotary.txt", &["--machine", "fanuc-vmc"], &["fanuc/rotary.nc"]),
    ("rotary.ndjson", &["--machine", "fanuc-vmc", "--as", "ndjson"], &["fanuc/rotary.nc"]),
    ("pecks.csv", &["--machine", "fanuc-vmc", "--as", "csv"], &["fanuc/g83.nc"]),
    ("repeat.csv", &["--machine", "sinumerik-vmc", "--as", "csv"], &["siemens/repeat.mpf"]),
    (
        "holes2-before.json",
        &["--machine", "sinumerik-vmc", "--as", "payload", "--stage", "before"],
        &["siemens/holes2.mpf"],
    ),
    (
        "positions-before.ndjson",
        &["--machine", "sinumerik-vmc", "--as", "ndjson", "--stage", "before"],
        &["siemens/positions.mpf"],
    ),
    ("rotation.txt", &["--machine", "sinumerik-vmc"], &["siemens/rotation.mpf"]),
    ("coolant.csv", &["--from", "mach9", "--as", "csv"], &["mach9/dwell-coolant.cn"]),
    ("stops.txt", &["--from", "fanuc"], &["fanuc/stops.nc"]),
    ("tools.csv", &["--machine", "fanuc-vmc", "--as", "tools"], &["fanuc/tools.nc", "fanuc/g81.nc"]),
    ("several.md", &["--machine", "fanuc-vmc", "--as", "markdown"], &["fanuc/tools.nc", "fanuc/arcs-xy.nc"]),
    (
        "several.json",
        &["--machine", "fanuc-vmc", "--as", "json", "--model", "jerk-limited"],
        &["fanuc/tools.nc", "fanuc/arcs-xy.nc"],
    ),
    (
        "several.txt",
        &["--from", "auto", "--machine", "fanuc-vmc"],
        &["fanuc/tools.nc", "canon/arcs-xy.canon", "ir/calls.ir"],
    ),
];

#[test]
fn sessions_are_as_read() {
    let mut failures = Failures::default();
    for (name, arguments, programs) in SESSIONS {
        let files: Vec<PathBuf> = programs.iter().map(|p| corpus::root().join("corpus").join(p)).collect();
        let files: Vec<&Path> = files.iter().map(PathBuf::as_path).collect();
        match time(arguments, &files) {
            Ok(output) => {
                failures.check(name, expect::file(&corpus::root().join("tests/time").join(name), &output));
            }
            Err(exit) => failures.add(name, format!("refused: {exit:?}")),
        }
    }
    failures.finish();
}

/// Every program of the corpus is timed in every form, by every model; times add up, and bounds hold.
#[test]
fn every_program_of_the_corpus_is_timed() {
    let mut failures = Failures::default();
    let mut timed = 0;
    for dialect in DIALECTS {
        let folder = corpus::root().join("corpus").join(dialect);
        for program in corpus::of(dialect) {
            let path = folder.join(&program.file);
            for model in ["ideal", "trapezoidal", "jerk-limited"] {
                let arguments = ["--from", dialect, "--machine", "fanuc-vmc", "--model", model];
                let what = format!("{dialect}/{} {model}", program.file);
                let summary = time(&[&arguments[..], &["--as", "json"]].concat(), &[&path]);
                let rows = time(&[&arguments[..], &["--as", "csv"]].concat(), &[&path]);
                let (summary, rows) = match (summary, rows) {
                    (Ok(summary), Ok(table)) => (summary, rows_of(&table)),
                    (Err(Exit::Refused), Err(Exit::Refused)) if REFUSED.contains(&&*program.file) => continue,
                    (summary, rows) => {
                        failures.add(&what, format!("{:?}, {:?}", summary.err(), rows.err()));
                        continue;
                    }
                };
                if let Err(fault) = adds_up(&summary, &rows) {
                    failures.add(&what, fault);
                }
                timed += 1;
            }
        }
    }
    assert!(timed > 400, "{timed}");
    failures.finish();
}

/// Programs of the corpus that cannot be executed.
const REFUSED: &[&str] = &["pecks.ir", "positions.ir"];

/// Stamp and duration of each function.
fn rows_of(table: &[u8]) -> Vec<(f64, f64)> {
    let text = String::from_utf8_lossy(table);
    let figures = |line: &str| {
        let mut from_the_end = line.trim_end().rsplit(',');
        let stamp = from_the_end.next()?.parse().ok()?;
        Some((stamp, from_the_end.next()?.parse().ok()?))
    };
    text.lines().skip(1).filter_map(figures).collect()
}

fn adds_up(summary: &[u8], rows: &[(f64, f64)]) -> Result<(), String> {
    let json: serde_json::Value = serde_json::from_slice(summary).map_err(|e| e.to_string())?;
    let program = &json["programs"][0];
    let number = |value: &serde_json::Value| value.as_f64().ok_or_else(|| format!("{value} is no number"));
    let near = |a: f64, b: f64, what: &str| match (a - b).abs() < 1e-4 {
        true => Ok(()),
        false => Err(format!("{what}: {a} and {b}")),
    };
    let total = number(&program["total"]["time"])?;
    near(total, rows.last().map_or(0.0, |r| r.0), "the last stamp")?;
    near(total, rows.iter().map(|r| r.1).sum(), "all durations")?;
    near(total, number(&program["clock"][1])?, "the clock")?;
    for list in ["tools", "operations"] {
        let of = program[list].as_array().ok_or("no list")?;
        near(total, of.iter().filter_map(|t| t["time"].as_f64()).sum(), list)?;
    }
    let parts = ["cutting", "rapid", "idle"].map(|part| number(&program["total"][part]));
    near(total, parts.into_iter().sum::<Result<f64, String>>()?, "cutting, rapid and idle")?;
    let bounds = [number(&program["bounds"][0])?, number(&program["bounds"][1])?];
    if bounds[0] > total + 1e-4 || bounds[1] < total - 1e-4 {
        return Err(format!("{total} is not within {bounds:?}"));
    }
    let mut before = 0.0;
    for (stamp, duration) in rows {
        if *duration < 0.0 || *stamp < before {
            return Err(format!("time goes back at {stamp}"));
        }
        before = *stamp;
    }
    Ok(())
}
