//! Can the verification fail? Every word of every emitted program of the corpus is changed, and
//! each changed text is either caught or proved equivalent by a named class: 100 %.
//!
//! A seeded sample by default; all of it by
//! `NCC_ALL_MUTANTS=1 cargo test --release -p ncc-tests --test mutants -- --nocapture`. Of some programs alone
//! with their names, or parts of them, in `NCC_MUTANTS_OF`, with commas between.

// What was tried is told with `--nocapture`.
#![allow(clippy::print_stdout)]

mod asked;
mod classes;
mod names;
mod sources;
mod structured;
mod words;

use std::collections::BTreeMap;
use std::sync::Mutex;

use ncc_dialects::{Family, builtin};
use ncc_driver::translate::judge::Judge;
use ncc_ir::diag::Fault;
use ncc_tests::corpus::{self, DIALECTS, Program};
use ncc_tests::expect::Failures;
use ncc_tests::translate::straight_job;
use words::{Change, Form, Mutant};

/// Mutants of each emitted program in the sample.
const SAMPLE: usize = 16;

#[derive(Default)]
struct Tally {
    texts: usize,
    mutants: usize,
    caught: usize,
    classes: BTreeMap<&'static str, usize>,
    failures: Failures,
}

#[test]
fn every_mutant_is_caught_or_equivalent() {
    let programs = corpus::all().into_iter().filter(asked::asked);
    let work: Vec<(Program, &'static str)> = programs
        .flat_map(|p| DIALECTS.map(|to| (p.clone(), to)))
        .filter(|(_, to)| asked::asked_to(to))
        .collect();
    let tally = Mutex::new(Tally::default());
    let all = asked::all();
    asked::side_by_side(&work, |(program, to)| try_all(program, to, all, &tally));
    let tally = tally.into_inner().expect("no thread panicked");
    println!("{} texts, {} mutants, {} caught", tally.texts, tally.mutants, tally.caught);
    for (class, count) in &tally.classes {
        println!("{count:7} equivalent: {class}");
    }
    assert!(tally.caught > 100, "hardly any mutants: {}", tally.mutants);
    tally.failures.finish();
}

fn try_all(program: &Program, to: &str, all: bool, tally: &Mutex<Tally>) {
    let mut job = straight_job(program, to);
    // The head is comment; it would only add mutants of comments.
    job.head = false;
    let mut judge = Judge::new(&job, &program.text).expect("a source in memory");
    if judge.outcome.release.is_err() {
        return;
    }
    let text = judge.outcome.output.to_vec().expect("an output in memory");
    let mut mutants = words::mutants(&text, form(to));
    if !all {
        mutants = sample(mutants, seed(&program.file, to));
    }
    // The one work offset of a control without words for it is the one that is named.
    let only = judge.outcome.diagnostics.iter().find_map(|d| match d.fault {
        Fault::AssumedWorkOffset { offset } if job.to.dialect.caps.frames.work_offsets == 0 => Some(offset),
        _ => None,
    });
    let what = format!("{}/{} to {to}", program.dialect, program.file);
    // What passes the untouched text is what the mutants are measured against.
    let untouched = judge.judge(&text).map_err(|d| format!("{:?}", d.fault));
    let emitted = classes::Emitted::new(program.dialect, to, &text);
    let mut found: Vec<(Mutant, Result<&'static str, String>)> = Vec::new();
    let mut caught = 0;
    for mutant in mutants {
        match judge.judge(&mutant.text) {
            Err(_) => caught += 1,
            Ok(_) => {
                let class = classes::class(&emitted, &mutant)
                    .or_else(|why| classes::rounded(program, &emitted, &mutant, only).ok_or(why));
                found.push((mutant, class));
            }
        }
    }
    let mut tally = tally.lock().expect("no thread panicked");
    tally.texts += 1;
    tally.mutants += caught + found.len();
    tally.caught += caught;
    tally.failures.check(&what, untouched);
    for (mutant, class) in found {
        match class {
            Ok(class) => *tally.classes.entry(class).or_default() += 1,
            Err(why) => {
                tally.failures.add(format!("{what}: {:?}", mutant.change), told(&text, &mutant, &why))
            }
        }
    }
}

/// The blocks that were changed, before and after.
fn told(text: &[u8], mutant: &Mutant, why: &str) -> String {
    let from = text[..mutant.at.start].iter().rposition(|b| *b == b'\n').map_or(0, |n| n + 1);
    let tail = text[mutant.at.end..].iter().position(|b| *b == b'\n').unwrap_or(0);
    let old = &text[from..mutant.at.end + tail];
    let new = &mutant.text[from..mutant.text.len() - (text.len() - mutant.at.end - tail)];
    let show = |t: &[u8]| String::from_utf8_lossy(t).trim_end().replace('\n', "\n      ");
    let end = if mutant.change == Change::Swapped { "\n" } else { "" };
    format!("  was {}\n  now {}{end}\n  not caught, and: {why}", show(old), show(new))
}

fn form(dialect: &str) -> Form {
    let dialect = builtin(dialect).expect("a dialect");
    match dialect.family {
        Family::Word => {
            let open = dialect.comment.open.chars().next().expect("comments");
            Form::Letters(open, dialect.comment.close.chars().next())
        }
        Family::Canon | Family::Ir => Form::Functions,
        Family::Sinumerik => Form::Names,
    }
}

fn seed(file: &str, to: &str) -> u64 {
    file.bytes()
        .chain(to.bytes())
        .fold(0xcbf2_9ce4_8422_2325, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3))
}

/// Some of them, the same ones in each run.
fn sample(mutants: Vec<Mutant>, seed: u64) -> Vec<Mutant> {
    let step = mutants.len().div_ceil(SAMPLE).max(1);
    let first = seed as usize % step;
    mutants.into_iter().skip(first).step_by(step).collect()
}
