//! Programs that compute, `tests/computing/<dialect>/`: executed, written as straight blocks, and verified.
//!
//! Beside each program stands what it comes to in its own dialect, `<name>.flat`. Without the pass no target
//! takes it but the text form, which says it as it is. Programs of `tests/computing/refused` cannot be executed;
//! beside them stands why.

use std::fmt::Write;

use ncc::job::Job;
use ncc::render::human::Loudness;
use ncc::rewrite::pass;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::{self, Failures};
use ncc_tests::plain::{self, Tolerance};
use ncc_tests::translate::{self, job, rendered, stopping, told, translate};

/// The programs of a dialect, by name.
fn programs(dialect: &'static str) -> Vec<(String, Vec<u8>)> {
    corpus::computing(dialect).into_iter().map(|program| (program.file, program.text)).collect()
}

/// With the head left out: what was taken for granted is read elsewhere.
fn flat(from: &str, to: &str, name: &str) -> Job {
    let flatten = pass("flatten").expect("a pass of that name");
    Job { passes: vec![flatten], head: false, ..job(from, to, name) }
}

#[test]
fn what_they_come_to() {
    let mut failures = Failures::default();
    let mut refusals = String::new();
    let mut done = 0;
    for from in ["fanuc"] {
        for (name, text) in programs(from) {
            for to in DIALECTS {
                let what = format!("{from}/{name} to {to}");
                let job = flat(from, to, &name);
                let (outcome, written) = translate(&job, &text);
                if outcome.release.is_ok() {
                    assert!(outcome.verified.is_some_and(|v| v.worlds >= 2 && v.events > 0), "{what}");
                    done += 1;
                } else {
                    let codes: Vec<String> =
                        stopping(&job, &outcome).iter().map(|c| format!("NC{c:04}")).collect();
                    let _ = writeln!(refusals, "{from}/{name} {to} {}", codes.join(","));
                    if codes.is_empty() || to == from {
                        failures.add(&what, rendered(&job, &name, &text, &outcome.diagnostics));
                    }
                }
                if to == from {
                    let folder = corpus::root().join("tests/computing").join(from);
                    let stem = name.rsplit_once('.').map_or(&*name, |(stem, _)| stem);
                    failures.check(&what, expect::file(&folder.join(format!("{stem}.flat")), &written));
                }
            }
        }
    }
    let list = corpus::root().join("tests/computing/refusals.txt");
    failures.check("refusals", expect::file(&list, refusals.as_bytes()));
    println!("{done} verified");
    failures.finish();
}

#[test]
fn without_the_pass_the_text_form_alone_takes_them() {
    let mut failures = Failures::default();
    for from in ["fanuc"] {
        for (name, text) in programs(from) {
            for to in DIALECTS {
                let what = format!("{from}/{name} to {to}");
                let job = job(from, to, &name);
                let (outcome, written) = translate(&job, &text);
                let codes = stopping(&job, &outcome);
                if to == "ir" {
                    if outcome.release.is_err() || outcome.verified.is_none() {
                        failures.add(&what, rendered(&job, &name, &text, &outcome.diagnostics));
                        continue;
                    }
                    // And from there it comes to the same.
                    let straight = |from: &str, text: &[u8]| translate(&flat(from, "canon", "p"), text).1;
                    if straight("ir", &written) != straight(from, &text) {
                        failures.add(&what, "the text form comes to something else");
                    }
                } else if codes.iter().copied().ne([233]) {
                    failures.add(&what, format!("refused by {codes:?}"));
                }
            }
        }
    }
    failures.finish();
}

#[test]
fn what_cannot_be_executed_is_refused_at_its_place() {
    let mut failures = Failures::default();
    let folder = corpus::root().join("tests/computing/refused");
    for (name, text) in programs("refused") {
        let job = flat("fanuc", "linuxcnc", &name);
        let (outcome, _) = translate(&job, &text);
        let said = told(&job, &name, &text, &outcome.diagnostics, Loudness::Usual);
        let stem = name.rsplit_once('.').map_or(&*name, |(stem, _)| stem);
        failures.check(&name, expect::file(&folder.join(format!("{stem}.stderr")), said.as_bytes()));
        if outcome.release.is_ok() || stopping(&job, &outcome).is_empty() {
            failures.add(&name, "released");
        }
    }
    failures.finish();
}

/// The second interpreter runs them too, and finds the compiler's moves, in three worlds; and so it does in what
/// was written of them.
#[test]
fn the_second_interpreter_agrees() {
    let mut failures = Failures::default();
    for from in ["fanuc"] {
        for program in corpus::computing(from) {
            let what = format!("{from}/{}", program.file);
            let Some(read) = failures.check(&what, translate::read(from, &program.text)) else { continue };
            for world in [0, 1, 2].map(plain::world) {
                for skip in [0, 0x7fe] {
                    let start = world.start.map(|n| n as f64 / 1e9);
                    let second = plain::second(from, &program.text, plain::setup(&world, skip));
                    let result = second.and_then(|machine| {
                        let events = translate::execute(&read, &world, skip)?;
                        let (a, b) = (plain::of_machine(&machine, start), plain::of_events(&events, start));
                        plain::compare(&a, &b, Tolerance::SAME)
                    });
                    failures.check(format!("{what} world {} skip {skip:b}", world.seed), result);
                }
            }
        }
    }
    failures.finish();
}
