//! Tools beside a change and lengths without Z, of a Fanuc of either kind: the compiler's execution, and the second
//! interpreter, which has it from the reference notes.

use ncc_driver::job::Job;
use ncc_exec::Exec;
use ncc_ir::behaviour::Behaviour;
use ncc_ir::expr::system::System;
use ncc_tests::expect::Failures;
use ncc_tests::interpreter::{PowerOn, Setup};
use ncc_tests::plain::{self, Plain, Tolerance};
use ncc_tests::translate;

const HEAD: &str = "%\nO1\nG21 G17 G90 G94 G54 G40 G49 G80\n";

/// Blocks after the head, separated by ` / `.
const TOOLS: [&str; 4] = [
    "T1 / M06 T2 / G00 X0. Y0. / G43 H1 Z10. / G00 X5. / M06 T1 / G43 H2 Z20. / X7.",
    "T1 M06 / G00 G43 H1 Z10. / T2 / G00 X5. / T3 M06 / G43 H2 Z10. / X6. / M06 / G43 H3 Z10. / X7.",
    "T1 / T2 / T4 M06 / G00 X1. / M06 T5 / X2. / T5 M06 / X3. / M06 / X4.",
    // None waits: the same on both.
    "T1 M06 / G00 X1. / T2 M06 / X2. / T2 / T2 M06 / X3.",
];

/// The same.
const LENGTHS: [&str; 5] = [
    "T1 M06 / G00 X0. Y0. / G43 H1 Z10. / G01 Z5. F100. / G49 / X10. / G00 Z50.",
    "G00 X0. Y0. Z10. / G43 H1 / X5. / G43 H2 X6. Z11. / G43 H3 / G49 / G00 X1. Z1.",
    "G00 X0. Y0. / G43 H1 Z10. / G91 G28 Z0. / G49 / G90 X5. / G00 Z10. / G43 H2 / G00 X1. Z1.",
    "G00 X0. Y0. / G43 H1 Z10. / G53 Z0. / G43 H2 / G00 X5. Z12. / G49 / M30",
    // With a Z in its block: the same on both.
    "G00 X0. Y0. / G43 H1 Z10. / G49 Z50. / G43 H2 X5. Z20.",
];

/// Executes programs by both, with both values of a fact. Each but the last is another program with each value.
fn by_both(behaviour: Behaviour, programs: &[&str]) {
    let mut failures = Failures::default();
    for (at, blocks) in programs.iter().enumerate() {
        let text = format!("{HEAD}{blocks}\nM30\n%\n").replace(" / ", "\n");
        let Some(read) = failures.check(*blocks, translate::read("fanuc", text.as_bytes())) else { continue };
        let mut made = Vec::new();
        for value in [0, 1] {
            let mut world = plain::of_dialect(plain::world(1), "fanuc");
            world.behaviours.set(behaviour, value, false);
            let start = world.start.map(|n| n as f64 / 1e9);
            let result =
                plain::second("fanuc", text.as_bytes(), plain::setup(&world, 0)).and_then(|machine| {
                    let events = translate::execute(&read, &world, 0)?;
                    let (a, b) = (plain::of_machine(&machine, start), plain::of_events(&events, start));
                    plain::compare(&a, &b, Tolerance::SAME)?;
                    Ok(b)
                });
            made.extend(
                failures.check(format!("{blocks}, {}", behaviour.values()[usize::from(value)]), result),
            );
        }
        if let [usual, other] = &made[..] {
            let same = plain::compare(usual, other, Tolerance::SAME).is_ok();
            if same != (at + 1 == programs.len()) {
                failures.add(*blocks, format!("the two kinds make the same: {same}"));
            }
        }
    }
    failures.finish();
}

#[test]
fn a_tool_that_waits() {
    by_both(Behaviour::ToolWithChange, &TOOLS);
}

#[test]
fn a_length_that_moves() {
    by_both(Behaviour::LengthWithoutAxis, &LENGTHS);
}

/// `G43` without H, and the same program with it.
const LAST_H: [[&str; 2]; 5] = [
    [
        "T1 M06 / G00 X0. Y0. / G43 H1 Z10. / G49 Z50. / G43 Z20. / X5.",
        "T1 M06 / G00 X0. Y0. / G43 H1 Z10. / G49 Z50. / G43 H1 Z20. / X5.",
    ],
    [
        "G00 X0. Y0. / G43 H2 Z10. / G43 H3 Z11. / G91 G28 Z0. / G90 G43 Z20.",
        "G00 X0. Y0. / G43 H2 Z10. / G43 H3 Z11. / G91 G28 Z0. / G90 G43 H3 Z20.",
    ],
    // No length is a length too.
    [
        "G00 X0. Y0. / G43 H2 Z10. / G43 H0 Z11. / G43 Z20.",
        "G00 X0. Y0. / G43 H2 Z10. / G43 H0 Z11. / G43 H0 Z20.",
    ],
    [
        "T1 M06 / G00 X0. Y0. / G43 H1 Z10. / G49 Z50. / T3 M06 / G43 Z20. / X5.",
        "T1 M06 / G00 X0. Y0. / G43 H1 Z10. / G49 Z50. / T3 M06 / G43 H1 Z20. / X5.",
    ],
    // A length that is cancelled does not change with its table, though Z has not moved since.
    [
        "G00 X0. Y0. / G43 H2 Z10. / G49 / G10 L11 P2 R-1. / X5. / G00 Z20. / G43 Z30.",
        "G00 X0. Y0. / G43 H2 Z10. / G49 / G10 L11 P2 R-1. / X5. / G00 Z20. / G43 H2 Z30.",
    ],
];

/// What is stated of the start: T and H code.
fn stated(job: &Job) -> [Option<u32>; 2] {
    [System::SelectedTool, System::LengthEntry]
        .map(|of| job.from.stated_of(&of).map(|(_, number)| number as u32))
}

/// Its events by the compiler and by the second interpreter, which are the same.
fn both(job: &Job, text: &str) -> Result<Vec<Plain>, String> {
    let world = plain::of_dialect(plain::world(1), "fanuc");
    let start = world.start.map(|n| n as f64 / 1e9);
    let setup = Setup { codes_at_start: stated(job), ..plain::setup(&world, 0) };
    let machine = plain::second("fanuc", text.as_bytes(), setup)?;
    let read = translate::read_as(job.from.clone(), text.as_bytes())?;
    let mut exec = Exec::new(&world, 0);
    job.tool_at_start().into_iter().for_each(|tool| exec.hold_tool(tool));
    let events = translate::execute_by(exec, &read)?;
    let (a, b) = (plain::of_machine(&machine, start), plain::of_events(&events, start));
    plain::compare(&a, &b, Tolerance::SAME)?;
    Ok(b)
}

#[test]
fn a_length_by_the_h_before() {
    let mut failures = Failures::default();
    for texts in LAST_H {
        let job = translate::job("fanuc", "haas", "a.nc");
        let made = texts.map(|blocks| both(&job, &format!("{HEAD}{blocks}\nM30\n%\n").replace(" / ", "\n")));
        let [without, with] = made.map(|made| failures.check(texts[0], made));
        if let (Some(without), Some(with)) = (without, with) {
            failures.check(texts[0], plain::compare(&without, &with, Tolerance::SAME));
        }
    }
    failures.finish();
}

/// A program that begins with a tool in the spindle.
const IN_SPINDLE: &str =
    "G10 L11 P#4120 R-1. / G00 X0. Y0. / G43 Z50. / G01 Z40. F100. / G00 G49 Z60. / G10 L11 P#4120 R0.";

#[test]
fn codes_that_are_stated_of_the_start() {
    let mut failures = Failures::default();
    let text = format!("{HEAD}{IN_SPINDLE}\nM30\n%\n").replace(" / ", "\n");
    for to in ["fanuc", "haas", "siemens"] {
        let mut job = translate::job("fanuc", to, "a.nc");
        let (outcome, _) = translate::translate(&job, text.as_bytes());
        if outcome.release.is_ok() {
            failures.add(to, "the codes in force were not asked for");
        }
        // Another H than T, where both are numbers of one table.
        let entry = if to == "siemens" { 2 } else { 3 };
        job.from.state_value("4120", 2);
        job.from.state_value("4111", entry);
        let Some(own) = failures.check(to, both(&job, &text)) else { continue };
        let (outcome, written) = translate::translate(&job, text.as_bytes());
        if outcome.release.is_err() {
            failures.add(to, translate::rendered(&job, "a.nc", text.as_bytes(), &outcome.diagnostics));
            continue;
        }
        let there = plain::of_dialect(plain::world(1), to);
        let (tool, start) = (Some(2), there.start.map(|n| n as f64 / 1e9));
        let power_on = PowerOn { tool, ..plain::setup(&there, 0).power_on };
        let setup = Setup { codes_at_start: [tool, None], power_on, ..plain::setup(&there, 0) };
        let judged = plain::second(to, &written, setup)
            .and_then(|machine| plain::compare(&own, &plain::of_machine(&machine, start), Tolerance::SAME));
        failures.check(format!("{to}: {}", String::from_utf8_lossy(&written)), judged);
    }
    failures.finish();
}
