//! Each text runs twice in a row in one world: what the first run leaves, the second begins with. Judged by the second
//! interpreter, which executes both runs.

use ncc::job::Outcome;
use ncc_ir::behaviour::Concern;
use ncc_ir::diag::Fault;
use ncc_ir::world::World;
use ncc_tests::besides;
use ncc_tests::corpus::Program;
use ncc_tests::expect::Failures;
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
