//! Is what a program computes verified? Each word of a Fanuc's macro language in the programs of the corpus is changed:
//! LT for LE, EQ for NE, plus for minus, a variable or a number by one, a bracket lost, another letter of an argument.
//! The output of the unchanged program must not pass for that of a changed one, which is refused otherwise; where it
//! passes, the second interpreter makes the same moves of both programs, and the class says what was changed.
//!
//! A seeded sample by default; all of it with `NCC_ALL_MUTANTS=1`.

use std::collections::BTreeMap;
use std::ops::Range;

use ncc_driver::translate::judge::Judge;
use ncc_tests::corpus::{self, Program};
use ncc_tests::expect::Failures;
use ncc_tests::plain::{self, Tolerance};
use ncc_tests::translate::{computes, straight_job};

use crate::asked;

/// Mutants of each program in the sample.
const SAMPLE: usize = 8;

#[test]
fn every_changed_source_is_told_apart() {
    let all = asked::all();
    let mut failures = Failures::default();
    let (mut caught, mut refused, mut endless, mut classes) = (0, 0, 0, BTreeMap::<&str, usize>::new());
    for program in
        corpus::of("fanuc").into_iter().filter(|program| computes(program) && asked::asked(program))
    {
        let mut job = straight_job(&program, "canon");
        job.head = false;
        let mut judge = Judge::new(&job, &program.text).expect("a source in memory");
        let output = judge.outcome.output.to_vec().expect("an output in memory");
        if judge.outcome.release.is_err() {
            continue;
        }
        let mutants = mutants(&String::from_utf8_lossy(&program.text));
        let step = if all { 1 } else { mutants.len().div_ceil(SAMPLE).max(1) };
        for (at, to, class) in mutants.into_iter().skip(program.file.len() % step).step_by(step) {
            let mut text = program.text.clone();
            text.splice(at.clone(), to.bytes());
            let alone = plain::second("fanuc", &text, plain::setup(&plain::world(0), 0));
            if alone.is_err_and(|why| why.contains("without an end")) {
                // It would be refused too, after a while.
                endless += 1;
                continue;
            }
            let judge = Judge::new(&job, &text).expect("a source in memory");
            if judge.outcome.release.is_err() {
                refused += 1;
            } else if judge.judge(&output).is_err() {
                caught += 1;
            } else if let Err(why) = the_same_moves(&program, &text) {
                let from = text[..at.start].iter().rposition(|b| *b == b'\n').map_or(0, |n| n + 1);
                let line = text[from..].split(|b| *b == b'\n').next().unwrap_or_default();
                let told = format!("{}\n not caught, and: {why}", String::from_utf8_lossy(line));
                failures.add(format!("{}: {class}", program.file), told);
            } else {
                *classes.entry(class).or_default() += 1;
            }
        }
    }
    println!("{caught} changed sources told apart, {refused} refused, {endless} without an end");
    classes.iter().for_each(|(class, count)| println!("{count:7} of the same moves: {class}"));
    assert!(!asked::of().is_empty() || caught > 100, "hardly any: {caught}");
    failures.finish();
}

fn the_same_moves(program: &Program, changed: &[u8]) -> Result<(), String> {
    for seed in [0, 1] {
        let world = plain::world(seed);
        let start = world.start.map(|n| n as f64 / 1e9);
        let moves = |text: &[u8]| {
            Ok::<_, String>(plain::of_machine(&plain::second("fanuc", text, plain::setup(&world, 0))?, start))
        };
        plain::compare(&moves(&program.text)?, &moves(changed)?, Tolerance::SAME)?;
    }
    Ok(())
}

/// Where, what in its place, and what kind of change it is.
type Change = (Range<usize>, String, &'static str);

fn mutants(text: &str) -> Vec<Change> {
    let mut found = Vec::new();
    let mut from = 0;
    for line in text.split_inclusive('\n') {
        let code = line.split('(').next().unwrap_or_default();
        // What is computed, and calls.
        if code.contains('#') || code.contains("G65") {
            of_line(code, from, &mut found);
        }
        from += line.len();
    }
    found
}

fn of_line(code: &str, from: usize, found: &mut Vec<Change>) {
    let bytes = code.as_bytes();
    let mut add = |at: Range<usize>, to: &str, class| {
        found.push((from + at.start..from + at.end, to.to_owned(), class))
    };
    for (word, other) in [("LT", "LE"), ("LE", "LT"), ("GT", "GE"), ("GE", "GT"), ("EQ", "NE"), ("NE", "EQ")]
    {
        for (at, _) in code.match_indices(&format!(" {word} ")) {
            add(at + 1..at + 3, other, "a comparison of values that it does not tell apart");
        }
    }
    for (at, b) in bytes.iter().enumerate() {
        let spaced = at > 0 && bytes[at - 1] == b' ' && bytes.get(at + 1) == Some(&b' ');
        match b {
            b'+' if spaced => add(at..at + 1, "-", "a sign before what is zero, or does not matter"),
            b'-' if spaced => add(at..at + 1, "+", "a sign before what is zero, or does not matter"),
            b'*' if spaced => add(at..at + 1, "/", "a product with what is one or zero, or does not matter"),
            b'#' => {
                let end = number_end(code, at + 1);
                if let Ok(number) = code[at + 1..end].parse::<u32>() {
                    let other = (number + 1).to_string();
                    add(at + 1..end, &other, "a variable of the same value, or that does not matter");
                }
            }
            b'0'..=b'9' if at > 0 && !b"#.0123456789N".contains(&bytes[at - 1]) => {
                let end = number_end(code, at);
                let goes =
                    code[..at].trim_end().ends_with("GOTO") || code[..at].ends_with(['G', 'M', 'O', 'D']);
                if let (Ok(number), false) = (code[at..end].parse::<u32>(), goes) {
                    add(at..end, &(number + 1).to_string(), "a number that does not matter");
                }
            }
            b'[' if at > 0 && bytes[at - 1] == b' ' && !code[..at].trim_end().ends_with(['F', 'E']) => {
                let mut depth = 0;
                let inside = code[at..].char_indices().find(|(_, c)| {
                    depth += i32::from(*c == '[') - i32::from(*c == ']');
                    depth == 0
                });
                if let Some((end, _)) = inside {
                    let bare = code[at + 1..at + end].to_owned();
                    add(at..at + end + 1, &bare, "brackets around what is worked out first anyway");
                }
            }
            b'A'..=b'Z' if code.contains("G65") && at > 0 && bytes[at - 1] == b' ' && !b"GPL".contains(b) => {
                let other = if *b == b'Z' { 'Y' } else { (*b + 1) as char };
                add(at..at + 1, &other.to_string(), "an argument that does not matter");
            }
            _ => {}
        }
    }
}

fn number_end(code: &str, from: usize) -> usize {
    code[from..].find(|c: char| !c.is_ascii_digit()).map_or(code.len(), |at| from + at)
}
