//! Each text runs twice in a row in one world: what the first run leaves, the second begins with. Judged by the second
//! interpreter, which executes both runs.

use ncc_driver::job::Outcome;
use ncc_exec::world::World;
use ncc_ir::behaviour::Concern;
use ncc_ir::diag::Fault;
use ncc_tests::besides;
use ncc_tests::corpus::Program;
use ncc_tests::expect::Failures;
use ncc_tests::interpreter::next_run::Left;
use ncc_tests::interpreter::{Machine, Setup};
use ncc_tests::plain::{self, Plain, Tolerance};
use ncc_tests::translate::{job, translate};

/// Whether it was told that the next run begins otherwise.
fn told(outcome: &Outcome) -> bool {
    outcome.diagnostics.iter().any(|d| told_by(&d.fault))
}

fn told_by(fault: &Fault) -> bool {
    match fault {
        Fault::NextRunShifted { .. } | Fault::NextRunTurned => true,
        Fault::OpenBehaviour { behaviour, .. } => behaviour.concern() == Concern::AtEnd,
        _ => false,
    }
}

/// The second run of a source and of its output make the same moves, or the user was told; `true` if the first runs
/// left anything behind that the second could meet.
pub(crate) fn next_runs_alike(
    source: &Program,
    (to, text): (&str, &[u8]),
    world: &World,
    within: Tolerance,
    outcome: &Outcome,
) -> Result<bool, String> {
    let control = to != "canon" && to != "ir";
    if told(outcome) || !control {
        return Ok(false);
    }
    runs_alike((source.dialect, &source.text), (to, text), world, within)
}

fn runs_alike(
    source: (&str, &[u8]),
    output: (&str, &[u8]),
    world: &World,
    within: Tolerance,
) -> Result<bool, String> {
    let sides = [source, output];
    let mut first = Vec::new();
    for (dialect, text) in sides {
        first.push(plain::second(dialect, text, plain::setup(world, 0))?);
    }
    if !first.iter().any(Machine::leaves) {
        return Ok(false);
    }
    let mut runs: Vec<Vec<Plain>> = Vec::new();
    for ((dialect, text), first) in sides.into_iter().zip(first) {
        let setup = Setup { left: first.left(dialect), ..plain::setup(world, 0) };
        let second = plain::second(dialect, text, setup)?;
        let start = world.start.map(|n| n as f64 / 1e9);
        runs.push(besides::without_way_up(plain::of_machine(&second, start)));
    }
    plain::compare(&runs[0], &runs[1], within).map_err(|fault| format!("second run: {fault}"))?;
    Ok(true)
}

const HEAD: &str = "G21 G17 G90 G94 G54 G40 G49 G80 / T1 M06 / S1000 M03 / G00 X0. Y0. / G43 H1 Z10. / ";
const HEAD_S: &str = "G710 G17 G90 G94 G54 G40 / T1 M6 / D1 / S1000 M3 / G0 X0 Y0 / Z10 / ";

/// From, to, blocks behind the head, what the output holds, and of what the user is told: a code, or nothing.
type Case = (&'static str, &'static str, &'static str, &'static str, Option<u16>);

const RUNS: &[Case] = &[
    // Frames die with a Sinumerik's program; LinuxCNC keeps G52, a Fanuc by a parameter.
    ("siemens", "linuxcnc", "TRANS X10 / G1 X5 F100 / G0 Z100", "G52 X0 / M2", None),
    ("siemens", "linuxcnc", "TRANS X10 Y-3 / G1 X5 F100 / TRANS / G1 X5", "G0 X0 Y0", None),
    ("siemens", "fanuc", "TRANS X10 / G1 X5 F100 / G0 Z100", "G52 X0. / M30", None),
    ("siemens", "fanuc", "ROT RPL=30 / G1 X5 Y0 F100 / G0 Z100", "G69 / M30", None),
    ("fanuc", "linuxcnc", "G52 X5. Y5. / G01 X20. F100. / G00 Z50.", "G52 X0 Y0 / M2", Some(323)),
    ("haas", "linuxcnc", "G52 X5. / G01 X20. F100. / G00 Z50.", "G52 X0 / M2", Some(323)),
    ("haas", "fanuc", "G52 X5. / G01 X20. F100. / G00 Z50.", "G52 X0. Y0. Z0. / M30", Some(323)),
    ("fanuc", "haas", "G68 X0. Y0. R30. / G01 X20. Y0. F100. / G00 Z50.", "G69 / M30", Some(323)),
    // LinuxCNC keeps it, the others' programs begin without it.
    ("linuxcnc", "siemens", "G52 X3 / G1 X5 F100 / G0 Z100", "TRANS X3", Some(327)),
    ("linuxcnc", "haas", "G52 X3 / G1 X5 F100 / G0 Z100", "G52 X3.", Some(327)),
    ("linuxcnc", "siemens", "G92 X3 / G1 X5 F100 / G0 Z100", "TRANS X-3", Some(327)),
    ("fanuc", "siemens", "G92 X5. Y5. / G01 X20. F100.", "TRANS X-5 Y-5", Some(327)),
    ("haas", "siemens", "G92 X5. / G01 X20. F100.", "TRANS X-5", Some(327)),
    // Both keep it, or the program takes it away itself.
    ("fanuc", "haas", "G92 X5. Y5. / G01 X20. F100.", "G92 X5. Y5.", None),
    ("linuxcnc", "siemens", "G52 X3 / G1 X5 F100 / G52 X0", "TRANS X3", None),
    ("fanuc", "siemens", "G52 X3. / G01 X5. F100. / G52 X0.", "TRANS X3", None),
];

/// What a program leaves: the output says what the other control would keep, or the user is told; and the two real
/// runs of the second interpreter differ where the user is told that they do, not elsewhere.
#[test]
fn the_next_run_is_the_same_or_told() {
    let mut failures = Failures::default();
    for (from, to, blocks, says, code) in RUNS {
        let head = if *from == "siemens" { HEAD_S } else { HEAD };
        let end = if *from == "linuxcnc" { " / M5 / M2" } else { " / M30" };
        let wrap = if *from == "siemens" { "" } else { "%" };
        let number = if matches!(*from, "fanuc" | "haas") { "O1 / " } else { "" };
        let source = format!("{wrap} / {number}{head}{blocks}{end} / {wrap}").replace(" / ", "\n");
        let what = format!("{from} to {to}: {blocks}");
        let job = job(from, to, "part.nc");
        let (outcome, text) = translate(&job, source.trim_start().as_bytes());
        let written = String::from_utf8_lossy(&text).into_owned();
        if !written.replace('\n', " / ").contains(says) {
            failures.add(&what, format!("without {says}:\n{written}\n{:?}", outcome.release));
        }
        let codes: Vec<u16> =
            outcome.diagnostics.iter().filter(|d| told_by(&d.fault)).map(|d| d.fault.code()).collect();
        if codes.first() != code.as_ref() {
            failures.add(&what, format!("told {codes:?}"));
        }
        let world = plain::of_dialect(plain::world(1), from);
        let twice =
            runs_alike((from, source.trim_start().as_bytes()), (to, &text), &world, Tolerance::ROUNDED);
        // Of an open fact the second interpreter has one value.
        match (code, twice) {
            (None | Some(323), Err(fault)) => failures.add(&what, format!("{fault}\n{written}")),
            (Some(327), Ok(_)) => failures.add(&what, "the runs are alike".to_owned()),
            _ => {}
        }
    }
    failures.finish();
}

/// From, to, blocks behind the head, the variable that they read first, and its value then.
const COUNTERS: &[(&str, &str, &str, u32, f64)] = &[
    ("fanuc", "haas", "#500=#500+1. / G01 X[#500*2.] F100.", 500, 3.0),
    ("fanuc", "siemens", "#500=#500+1. / G01 X#500 F100.", 500, 3.0),
    ("fanuc", "linuxcnc", "#500=#500+1. / G01 X#500 F100.", 500, 3.0),
    ("fanuc", "linuxcnc", "IF[#110GT5.]GOTO 20 / G01 X#110 F100. / N20 #110=#110+4.", 110, 3.0),
    ("haas", "fanuc", "WHILE[#501LT6.]DO1 / G01 X#501 F100. / #501=#501+1. / END1 / #501=1.", 501, 4.0),
    ("siemens", "fanuc", "R101=R101+1 / G1 X=R101 F100", 101, 3.0),
    ("siemens", "linuxcnc", "IF R101>3 GOTOF DONE / G1 X=R101 F100 / DONE: R101=R101+1", 101, 3.0),
    ("linuxcnc", "haas", "#150=[#150+1] / G1 X#150 F100", 150, 3.0),
];

/// A program that goes on from what its last run has left in a variable: three runs of the second interpreter, one
/// after the other, move alike, and not as the first.
#[test]
fn counters_go_on_alike() {
    let mut failures = Failures::default();
    for (from, to, blocks, number, value) in COUNTERS {
        let head = if *from == "siemens" { HEAD_S } else { HEAD };
        let end = if *from == "linuxcnc" { " / M5 / M2" } else { " / M30" };
        let number_of = if matches!(*from, "fanuc" | "haas") { "O1 / " } else { "" };
        let source = format!("{number_of}{head}{blocks}{end}\n").replace(" / ", "\n");
        let what = format!("{from} to {to}: {blocks}");
        let (outcome, text) = translate(&job(from, to, "part.nc"), source.as_bytes());
        if outcome.release.is_err() {
            failures.add(&what, "not translated".to_owned());
            continue;
        }
        let world = plain::of_dialect(plain::world(1), from);
        let mut runs = Vec::new();
        for (dialect, text) in [(*from, source.as_bytes()), (to, &text)] {
            let mut left = Left::variable(*number, *value);
            for _ in 0..3 {
                let setup = Setup { left, ..plain::setup(&world, 0) };
                match plain::second(dialect, text, setup) {
                    Ok(done) => {
                        left = done.left(dialect);
                        let start = world.start.map(|n| n as f64 / 1e9);
                        runs.push(besides::without_way_up(plain::of_machine(&done, start)));
                    }
                    Err(fault) => {
                        failures.add(&what, format!("{dialect}: {fault}\n{}", String::from_utf8_lossy(text)));
                        break;
                    }
                }
            }
        }
        let [a1, a2, a3, b1, b2, b3] = &runs[..] else { continue };
        for (source, output) in [(a1, b1), (a2, b2), (a3, b3)] {
            if let Err(fault) = plain::compare(source, output, Tolerance::ROUNDED) {
                failures.add(&what, fault);
            }
        }
        if plain::compare(a1, a2, Tolerance::ROUNDED).is_ok()
            && plain::compare(a2, a3, Tolerance::ROUNDED).is_ok()
        {
            failures.add(&what, "all runs are alike".to_owned());
        }
    }
    failures.finish();
}
