//! Mutants of what is written of programs that compute with their structure kept: comparisons, bounds, operators,
//! brackets, divisions, functions, variables, arguments and jumps are changed as a writer that is wrong would write
//! them. Each is caught by the verification, or makes the same moves for the second interpreter, which shares nothing
//! with it.
//!
//! A seeded sample by default; `NCC_ALL_MUTANTS=1` and `NCC_MUTANTS_OF` as for those of straight blocks.

use std::sync::Mutex;

use ncc_driver::translate::judge::Judge;
use ncc_tests::besides;
use ncc_tests::corpus::{self, DIALECTS, Program};
use ncc_tests::expect::Failures;
use ncc_tests::plain::{self, Corners, Tolerance};
use ncc_tests::translate::job;

use crate::asked;

/// Mutants of each text in the sample.
const SAMPLE: usize = 8;

/// What a writer may take for one another: of the word-address controls, then of the Sinumerik.
const WORDS: [(&str, &str); 16] = [
    (" GT ", " GE "),
    (" GE ", " GT "),
    (" LT ", " LE "),
    (" LE ", " LT "),
    (" EQ ", " NE "),
    (" NE ", " EQ "),
    (" AND ", " OR "),
    (" OR ", " AND "),
    ("EQ #0]", "EQ 0]"),
    ("SIN[", "COS["),
    ("COS[", "SIN["),
    ("FIX[", "ROUND["),
    ("ROUND[", "FIX["),
    (" MOD ", " / "),
    ("#1 ", "#2 "),
    ("#100 ", "#101 "),
];

const NAMES: [(&str, &str); 15] = [
    (" > ", " >= "),
    (" >= ", " > "),
    (" < ", " <= "),
    (" <= ", " < "),
    (" == ", " <> "),
    (" <> ", " == "),
    (" AND ", " OR "),
    (" OR ", " AND "),
    ("SIN(", "COS("),
    ("COS(", "SIN("),
    ("TRUNC(", "ROUND("),
    (" / ", " DIV "),
    (" MOD ", " DIV "),
    ("GOTOF ", "GOTOB "),
    ("GOTOB ", "GOTOF "),
];

/// Of both.
const BOTH: [(&str, &str); 4] = [(" + ", " - "), (" - ", " + "), (" * ", " / "), (" / ", " * ")];

/// A changed text and what was changed.
struct Changed {
    text: String,
    what: String,
}

/// All changes of a text.
fn changes(text: &str, names: bool) -> Vec<Changed> {
    let mut all = Vec::new();
    let own: &[(&str, &str)] = if names { &NAMES } else { &WORDS };
    let (open, close, comment) = if names { ('(', ')', ';') } else { ('[', ']', '(') };
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let code =
            &line[..line.find(comment).filter(|_| !names || !line.contains('"')).unwrap_or(line.len())];
        // Calls of a Sinumerik stand in parentheses that are none of an expression.
        let mut put = |at: usize, len: usize, by: &str| {
            let line_at = start + at;
            let changed = format!("{}{by}{}", &text[..line_at], &text[line_at + len..]);
            let now = changed[start..].lines().next().unwrap_or_default().to_owned();
            all.push(Changed { text: changed, what: format!("{} | {now}", line.trim_end()) });
        };
        for (from, to) in own.iter().chain(&BOTH) {
            for (at, _) in code.match_indices(from) {
                put(at, from.len(), to);
            }
        }
        // A bound is off by one.
        let decides = ["IF ", "WHILE ", "while ", "if ", "FOR ", "UNTIL ", "repeat "];
        if decides.iter().any(|word| code.contains(word)) {
            for (at, number) in numbers(code) {
                put(at, number.len(), &(number.parse::<u32>().unwrap_or_default() + 1).to_string());
            }
        }
        // Brackets are lost: those of a sum in a product.
        for (at, _) in code.match_indices(open) {
            let before = code[..at].chars().next_back();
            if before.is_some_and(|c| c.is_ascii_alphabetic()) {
                continue;
            }
            if let Some(end) = closing(&code[at..], open, close).map(|end| at + end)
                && code[end + 1..].trim_start().starts_with(['*', '/'])
            {
                put(at, end + 1 - at, &code[at + 1..end]);
            }
        }
        // An argument goes to another variable.
        if let Some(at) = code.find("G65 ") {
            for (from, to) in [(" A", " B"), (" B", " C"), (" X", " Y"), (" D", " E")] {
                if let Some(found) = code[at..].find(from) {
                    put(at + found, 2, to);
                }
            }
        }
        start += line.len();
    }
    all
}

/// Whole numbers that stand alone in a line: no block number, no variable, no part of another number.
fn numbers(code: &str) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let bytes = code.as_bytes();
    let mut at = 0;
    while at < bytes.len() {
        if !bytes[at].is_ascii_digit() {
            at += 1;
            continue;
        }
        let end = (at..bytes.len()).find(|k| !bytes[*k].is_ascii_digit()).unwrap_or(bytes.len());
        let before = if at > 0 { bytes[at - 1] } else { b' ' };
        let behind = bytes.get(end).copied().unwrap_or(b' ');
        if matches!(before, b' ' | b'[' | b'(' | b'-') && matches!(behind, b' ' | b']' | b')' | b'\n' | b'.')
        {
            let jumps = code[..at].trim_end().ends_with("GOTO");
            if !jumps {
                found.push((at, code[at..end].to_owned()));
            }
        }
        at = end;
    }
    found
}

fn closing(text: &str, open: char, close: char) -> Option<usize> {
    let mut depth = 0;
    for (at, c) in text.char_indices() {
        depth += i32::from(c == open) - i32::from(c == close);
        if depth == 0 {
            return Some(at);
        }
    }
    None
}

#[derive(Default)]
struct Tally {
    texts: usize,
    mutants: usize,
    caught: usize,
    same: usize,
    failures: Failures,
}

#[test]
fn every_mutant_of_a_kept_structure_is_caught_or_makes_the_same_moves() {
    let programs: Vec<_> = DIALECTS.into_iter().flat_map(corpus::computing).filter(asked::asked).collect();
    let to = ["fanuc", "haas", "siemens", "linuxcnc"];
    let work: Vec<_> = programs.iter().flat_map(|p| to.map(|to| (p, to))).collect();
    let tally = Mutex::new(Tally::default());
    let all = asked::all();
    asked::side_by_side(&work, |(program, to)| try_all(program, to, all, &tally));
    let tally = tally.into_inner().expect("no thread panicked");
    println!(
        "{} texts, {} mutants, {} caught, {} make the same moves",
        tally.texts, tally.mutants, tally.caught, tally.same
    );
    assert!(!asked::of().is_empty() || tally.caught > 100, "hardly any mutants: {}", tally.mutants);
    tally.failures.finish();
}

fn try_all(program: &Program, to: &str, all: bool, tally: &Mutex<Tally>) {
    let job = ncc_driver::job::Job { head: false, ..job(program.dialect, to, &program.file) };
    let mut judge = Judge::new(&job, &program.text).expect("a source in memory");
    if judge.outcome.release.is_err() {
        return;
    }
    let text = judge.outcome.output.to_vec().expect("an output in memory");
    let text = String::from_utf8(text).expect("text");
    let what = format!("{}/{} to {to}", program.dialect, program.file);
    if judge.judge(text.as_bytes()).is_err() {
        // Programs that rely on what only the whole translation takes for granted are none to be changed.
        println!("{what}: not judged by itself");
        return;
    }
    let mut mutants = changes(&text, to == "siemens");
    if !all {
        let step = mutants.len().div_ceil(SAMPLE).max(1);
        mutants = mutants.into_iter().skip(step / 2).step_by(step).collect();
    }
    let (mut caught, mut same, mut tried) = (0, 0, 0);
    let mut failures = Vec::new();
    for mutant in mutants {
        tried += 1;
        if judge.judge(mutant.text.as_bytes()).is_err() {
            caught += 1;
        } else if let Err(why) = makes_the_same(program.dialect, &program.text, to, mutant.text.as_bytes()) {
            failures.push(format!("{}\n  not caught, and: {why}", mutant.what));
        } else {
            same += 1;
        }
    }
    let mut tally = tally.lock().expect("no thread panicked");
    tally.texts += 1;
    tally.mutants += tried;
    tally.caught += caught;
    tally.same += same;
    for failure in failures {
        tally.failures.add(&what, failure);
    }
}

/// The second interpreter finds the same moves in both, in three worlds, with all skip switches off and on.
fn makes_the_same(from: &str, source: &[u8], to: &str, text: &[u8]) -> Result<(), String> {
    let within =
        Tolerance { corners: Corners::between(from, to), arcs: plain::says_arcs(to), ..Tolerance::ROUNDED };
    for world in [0, 1, 2].map(plain::world) {
        let world = besides::zeroed(plain::of_dialect(world, from), [from, to]);
        let start = world.start.map(|n| n as f64 / 1e9);
        for skip in [0, 0x7fe] {
            let run = |dialect: &str, text: &[u8]| {
                let machine = plain::second(dialect, text, plain::setup(&world, skip))?;
                Ok::<_, String>(plain::of_machine(&machine, start))
            };
            plain::compare(&besides::as_shown(run(from, source)?, to), &run(to, text)?, within)?;
        }
    }
    Ok(())
}
