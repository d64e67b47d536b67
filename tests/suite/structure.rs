//! Structure comes back: cycles and patterns of the case study's program, through dialects that
//! cannot say them, folded on the way home.

use ncc_tests::corpus::{self, DIALECTS};
use ncc_tests::translate::{job, rendered, translate};

/// Cycles and patterns of the program: what a folded text must say again. An omitted zero may differ.
const SAID: [&str; 6] = [
    "G81Z-6.R3.F191",
    "G24X0.Y18.B30.L12",
    "G81Z-8.R3.F186",
    "G25X30.Y130.I2J2",
    "G81Z-4.R3.F199",
    "G25X30.Y130.I2J2",
];

/// The program through other dialects and home again; folded on the last leg, and on each before it
/// if `all`.
fn home(way: &[&str], all: bool) -> String {
    let program = corpus::of("mach9").into_iter().find(|p| p.name == "teste").expect("the case study");
    let mut text = program.text;
    for (leg, pair) in way.windows(2).enumerate() {
        let mut job = job(pair[0], pair[1], &program.file);
        job.head = false;
        job.fold = Some(all || leg + 2 == way.len());
        let (outcome, written) = translate(&job, &text);
        assert!(outcome.release.is_ok(), "{}", rendered(&job, &program.file, &text, &outcome.diagnostics));
        text = written;
    }
    String::from_utf8(text).expect("a text")
}

/// A block with every word written out: `G24XY18.` is `G24X0Y18.`, and a zero has no point.
fn plain(block: &str) -> String {
    let mut out = String::new();
    for c in block.trim().chars() {
        if c.is_ascii_alphabetic() && out.ends_with(|c: char| c.is_ascii_alphabetic()) {
            out.push('0');
        }
        out.push(c);
    }
    if out.ends_with(|c: char| c.is_ascii_alphabetic()) {
        out.push('0');
    }
    let mut words: Vec<String> = Vec::new();
    for c in out.chars() {
        match words.last_mut().filter(|_| !c.is_ascii_alphabetic()) {
            Some(word) => word.push(c),
            None => words.push(c.to_string()),
        }
    }
    let number = |word: &String| {
        let (letter, number) = word.split_at(1);
        number.parse::<f64>().map_or(word.clone(), |n| format!("{letter}{n}"))
    };
    words.iter().map(number).collect()
}

fn has_its_cycles(text: &str) {
    let said: Vec<String> = text
        .lines()
        .filter(|l| ["G8", "G24", "G25"].iter().any(|g| l.starts_with(g)) && *l != "G80")
        .map(plain)
        .collect();
    assert_eq!(said, SAID.map(plain), "{text}");
}

/// Through canonical functions, which have no cycles.
#[test]
fn through_canon() {
    has_its_cycles(&home(&["mach9", "canon", "mach9"], false));
}

/// Through a Fanuc, which has cycles and no patterns.
#[test]
fn through_a_fanuc() {
    has_its_cycles(&home(&["mach9", "fanuc", "mach9"], true));
}

/// Through a Fanuc and a Sinumerik.
#[test]
fn through_a_fanuc_and_a_sinumerik() {
    if DIALECTS.contains(&"siemens") {
        has_its_cycles(&home(&["mach9", "fanuc", "siemens", "mach9"], true));
    }
}

#[test]
fn blocks_are_compared_by_their_words() {
    assert_eq!(plain("G24XY18.B30.L12"), plain("G24X0.Y18B30L12"));
    assert_ne!(plain("G24XY18.B30.L12"), plain("G24XY18.B30.L11"));
}
