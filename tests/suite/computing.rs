//! Programs that compute, `tests/computing/<dialect>/`: executed, written as straight blocks, and verified.
//!
//! Beside each program stands what it comes to in its own dialect, `<name>.flat`, and in `kept` how targets that compute say it.
//! Programs of `tests/computing/refused` cannot be executed;
//! beside them stands why.

use std::fmt::Write;

use ncc_driver::job::{Failure, Job};
use ncc_driver::render::Loudness;
use ncc_driver::translate::rewrite::pass;
use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::expect::{self, Failures};
use ncc_tests::plain::{self, Tolerance};
use ncc_tests::translate::{self, job, rendered, stopping, told, translate};

/// Targets that write programs which compute.
const KEEPING: [&str; 4] = ["fanuc", "haas", "siemens", "linuxcnc"];

/// Those of them whose words do not round what is computed: as straight blocks, other digits come about, within what is
/// the same.
const UNROUNDED: [&str; 2] = ["siemens", "linuxcnc"];

/// Dialects whose programs are kept.
const KEPT: [&str; 4] = ["fanuc", "siemens", "linuxcnc", "haas"];

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
    for from in ["fanuc", "haas", "linuxcnc", "siemens"] {
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

/// Targets with variables of the same language keep a program as it is; in `kept` stands their text,
/// or why they do not take it. No other target but the text form takes any.
#[test]
fn what_is_kept() {
    let mut failures = Failures::default();
    for from in KEPT {
        for (name, text) in programs(from) {
            for to in DIALECTS {
                let what = format!("{from}/{name} to {to}");
                let job = Job { head: false, ..job(from, to, &name) };
                let (outcome, written) = translate(&job, &text);
                let codes = stopping(&job, &outcome);
                let verified = outcome.release.is_ok() && outcome.verified.is_some_and(|v| v.events > 0);
                if KEEPING.contains(&to) {
                    let stem = name.rsplit_once('.').map_or(&*name, |(stem, _)| stem);
                    let file =
                        corpus::root().join("tests/computing/kept").join(format!("{from}-{stem}.{to}"));
                    let told = rendered(&job, &name, &text, &outcome.diagnostics);
                    let said = if verified { &written[..] } else { told.as_bytes() };
                    failures.check(&what, expect::file(&file, said));
                    if matches!(outcome.release, Err(Failure::VerificationFailed)) {
                        failures.add(&what, told);
                        continue;
                    }
                    if !verified && [from, to].iter().any(|d| UNROUNDED.contains(d)) && !codes.is_empty() {
                        continue;
                    }
                    if !verified && codes.iter().any(|code| *code != 233) {
                        failures.add(&what, told);
                        continue;
                    }
                }
                if to == "ir" && !verified {
                    failures.add(&what, rendered(&job, &name, &text, &outcome.diagnostics));
                } else if verified {
                    if let Err(other) = comes_to_the_same(from, &text, to, &written) {
                        failures.add(&what, other);
                    }
                } else if codes.iter().copied().ne([233]) {
                    failures.add(&what, format!("refused by {codes:?}"));
                }
            }
        }
    }
    failures.finish();
}

/// What is written is written as the same text again, and comes to the same straight blocks, comments apart.
fn comes_to_the_same(from: &str, text: &[u8], to: &str, written: &[u8]) -> Result<(), String> {
    let unrounded = [from, to].iter().any(|dialect| UNROUNDED.contains(dialect));
    if to == "siemens" || unrounded && from != to {
        return Ok(());
    }
    let again = Job { head: false, ..job(to, to, "p") };
    if translate(&again, written).1 != written {
        return Err("written again, it is another text".into());
    }
    let straight = |from: &str, text: &[u8]| {
        let written = translate(&flat(from, "canon", "p"), text).1;
        let calls = written.split(|byte| *byte == b'\n').filter(|line| !line.starts_with(b"COMMENT"));
        // What a control switches off by itself at the end, a list says in words.
        let off = |line: &&[u8]| matches!(*line, b"STOP_SPINDLE_TURNING()" | b"COOLANT_OFF()");
        let calls = calls.filter(|line| !off(line));
        let mut calls = calls.map(<[u8]>::to_vec).collect::<Vec<_>>();
        // A safe start says what is in force in an order of its own.
        let moves = |call: &Vec<u8>| call.starts_with(b"SELECT_TOOL") || call.starts_with(b"STRAIGHT");
        let first = calls.iter().position(moves).unwrap_or_default();
        calls[..first].sort();
        calls
    };
    let (there, here) = (straight(to, written), straight(from, text));
    if there != here {
        let other = there.iter().zip(&here).position(|(a, b)| a != b);
        let shown = |calls: &[Vec<u8>]| {
            let call = other.map_or(calls.last(), |at| calls.get(at));
            String::from_utf8_lossy(call.map_or(b"", |call| call)).into_owned()
        };
        return Err(format!("it comes to something else: {} for {}", shown(&there), shown(&here)));
    }
    Ok(())
}

/// What a program reads and has not set is given the same values under its other name: verified, and told.
#[test]
fn what_is_not_set_is_the_same_under_another_name() {
    let mut failures = Failures::default();
    let folder = corpus::root().join("tests/computing/open");
    for (name, text) in programs("open") {
        let from = if name.ends_with(".nc") { "fanuc" } else { "siemens" };
        for to in ["fanuc", "siemens", "linuxcnc"] {
            let job = Job { head: false, ..job(from, to, &name) };
            let (outcome, written) = translate(&job, &text);
            let given = outcome.diagnostics.iter().filter(|d| d.fault.code() == 604).count();
            if outcome.release.is_err() || given != 2 {
                failures.add(format!("{name} to {to}"), rendered(&job, &name, &text, &outcome.diagnostics));
            }
            let stem = name.rsplit_once('.').map_or(&*name, |(stem, _)| stem);
            failures.check(&name, expect::file(&folder.join(format!("{stem}.{to}")), &written));
        }
    }
    failures.finish();
}

/// Subprograms and macros that are texts of their own, each as every target has it: verified, with what its calls must
/// give; or why there is none.
#[test]
fn subprograms_by_themselves() {
    let mut failures = Failures::default();
    let folder = corpus::root().join("tests/computing/alone");
    for (name, text) in programs("alone") {
        let extension = name.rsplit_once('.').map(|(_, extension)| extension);
        let from = match extension {
            Some("nc") => "fanuc",
            Some("ngc") => "linuxcnc",
            _ => "siemens",
        };
        for to in KEEPING {
            let job = Job { head: false, ..job(from, to, &name) };
            let (outcome, mut written) = translate(&job, &text);
            match outcome.release {
                Ok(()) => assert!(outcome.verified.is_some_and(|v| v.events > 0), "{name} to {to}"),
                Err(_) => written.clear(),
            }
            let asked = |code: u16| code == 608 || outcome.release.is_err();
            let told: Vec<_> =
                outcome.diagnostics.iter().filter(|d| asked(d.fault.code())).cloned().collect();
            written.extend_from_slice(rendered(&job, &name, &text, &told).as_bytes());
            let stem = name.rsplit_once('.').map_or(&*name, |(stem, _)| stem);
            failures.check(&name, expect::file(&folder.join(format!("{stem}.{to}")), &written));
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
    for from in ["fanuc", "haas", "linuxcnc", "siemens"] {
        for program in corpus::computing(from) {
            let what = format!("{from}/{}", program.file);
            let Some(read) = failures.check(&what, translate::read(from, &program.text)) else { continue };
            for world in [0, 1, 2].map(plain::world) {
                for skip in [0, 0x7fe] {
                    let start = world.start.map(|n| n as f64 / 1e9);
                    let second = plain::second(from, &program.text, plain::setup(&world, skip));
                    let result = second.and_then(|machine| {
                        let events = translate::execute(&read, &plain::behaving(&world, from), skip)?;
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
