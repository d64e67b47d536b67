//! A file that leaves something to the operator's machine is found.

use super::*;
use ncc_dialects::{Settings, builtin};

const WHOLE: &str = "G21 G17 G40 G49 G90 G94\nG55\nM5 M9 G53 G0 Z0 T1 M0\nS1000 M3\nG0 X0 Y7\nZ5\nG1 Z-1 F100\nG0 Z5\nG18\n\
                     M5 M9 G53 G0 Z0 T2 M0\nM3\nM8\nX5\nZ5\nG1 Z-1\nG2 X9 I2 K0\nG0 Z20\nM5\nM9\nM2\n";
const BEGINS: &str = "G21 G18 G40 G49 G90 G94\nG55\nM5 M9\nG53 G0 Z0\nG0 Y7\nF100\nS1000\n";
const WORKS: &str = "M3\nM8\nX5\nZ5\nG1 Z-1\nG2 X9 I2 K0\nG0 Z20\nM5\nM9\nM2\n";
const ENDS: &str = "M5 M9\nG90 G53 G0 Z0\nM2\n";

fn part(tool: i64, begins: &str, works: &str, ends: &str) -> Part {
    let body = begins.len() as u32..(begins.len() + works.len()) as u32;
    let text = [begins, works, ends].concat().into_bytes();
    Part { tool: Some(tool), changes: 1, own_beginning: 0, bodies: vec![body], text }
}

/// The files of the whole, the first one with this before its tool change.
fn verified_behind(before: &str, begins: &str, works: &str, ends: &str) -> Result<(), Option<String>> {
    let settings = Settings::new(builtin("grbl").expect("a built-in dialect"));
    let job = Job::new(settings.clone(), settings, "part.gcode");
    let whole = WHOLE.replacen("G55\n", before, 1);
    let (before, rest) = whole.split_once("M5 M9 G53 G0 Z0 T1 M0\n").expect("the first change");
    let (first, _) = rest.split_once("M5 M9 G53 G0 Z0 T2 M0\n").expect("the second change");
    let mut parts =
        [part(1, &format!("{before}M5 M9\nG90 G53 G0 Z0\n"), first, ends), part(2, begins, works, "")];
    parts[0].own_beginning = before.len() as u32;
    let used = [true, true, true, false, false, false];
    verify(&job, whole.as_bytes(), &parts, &used, &Modes { no_origin_shift: Some(true), ..Modes::default() })
        .map_err(|found| found.difference)
}

fn verified(begins: &str, works: &str, ends: &str) -> Result<(), String> {
    verified_behind("G55\n", begins, works, ends).map_err(Option::unwrap_or_default)
}

#[test]
fn a_file_that_states_all_does_its_part() {
    assert_eq!(verified(BEGINS, WORKS, ENDS), Ok(()));
}

#[test]
fn each_fact_that_a_file_leaves_out_is_found() {
    let leave_out = ["G21 ", "G18 ", "G90 ", "G94", "G55\n", "G53 G0 Z0\n", "G0 Y7\n", "F100\n", "S1000\n"];
    for words in leave_out {
        assert!(BEGINS.contains(words), "{words}");
        assert!(verified(&BEGINS.replacen(words, "", 1), WORKS, ENDS).is_err(), "{words} left out");
    }
    for (own, other) in [("G18", "G17"), ("G55", "G54"), ("Y7", "Y8"), ("F100", "F99"), ("S1000", "S999")] {
        assert!(verified(&BEGINS.replacen(own, other, 1), WORKS, ENDS).is_err(), "{other} for {own}");
    }
}

#[test]
fn a_file_that_does_more_than_its_part_is_found() {
    for more in ["G1 Z-1 F100\n", "G0 Z-5\n", "M3 S100\n G0 X1\n", "M8\n", "G4 P1\n", "M0\n"] {
        assert!(verified(&format!("{BEGINS}{more}"), WORKS, ENDS).is_err(), "{more} at its beginning");
        assert!(verified(BEGINS, WORKS, &format!("{more}{ENDS}")).is_err(), "{more} before its end");
    }
    // Over the work before Z is up.
    let early = BEGINS.replacen("G53 G0 Z0\nG0 Y7\n", "G0 Y7\nG53 G0 Z0\n", 1);
    assert!(verified(&early, WORKS, ENDS).is_err());
    assert!(verified(BEGINS, WORKS, "M5 M9\nG90 G53 G0 Z0\n").is_err(), "no end");
    assert!(verified(BEGINS, WORKS, "M9\nG90 G53 G0 Z0\nM2\n").is_err(), "the spindle goes on");
}

#[test]
fn moves_that_are_not_those_of_the_part_are_found() {
    for (own, other) in
        [("X5", "X6"), ("M8\n", ""), ("G1 Z-1\n", ""), ("M3", "M4"), ("G2 X9 I2", "G3 X9 I2"), ("M2", "M2")]
    {
        let works = WORKS.replacen(own, other, 1);
        assert_eq!(verified(BEGINS, &works, ENDS).is_ok(), own == other, "{other} for {own}");
    }
}

/// Before the first tool change a file may only go up along Z, and about there; its tool is in the spindle already.
#[test]
fn more_than_rest_before_the_first_change_is_refused() {
    let of = |before: &str| verified_behind(before, BEGINS, WORKS, ENDS);
    assert_eq!(of("G55\nG53 G0 Z0\nG53 G0 X0 Y0\n"), Ok(()));
    for before in ["G55\nG0 X200 Y100\n", "G55\nM8\n", "G55\nG53 G0 X0 Y0\n", "G55\nG0 Z5\n"] {
        assert_eq!(of(before), Err(None), "{before}");
    }
}
