//! Listings with a slip in them: each must be found out.

use ncc_backends::canon::rs274;
use ncc_dialects::{Settings, builtin};
use ncc_frontends::{Batch, Reader};
use ncc_ir::program::Procedure;

use super::*;

/// One with all that a listing can have: arcs of several turns, holes, a tap, dwells, coolant, offsets, a tool change with the
/// spindle turning, and an end that stops it.
const PART: &str = "G21 G17 G90 G94 G40 G49 G80 G54\nT2 M6\nS1500 M3\nM7\nM8\nG0 X10 Y-5 Z20\nZ2\nG1 Z-1.5 F120\nX30 F300\nG2 X40 Y5 I0 J10 F250\nG3 X40 Y5 Z-3 I-5 J0 P3\nG18 G3 X50 Z-3 I5 K0\nG17 G1 X12.3456\nG4 P0.5\nM9\nG0 Z20\nG98 G82 X5 Y5 Z-4 R2 P0.25 F90\nX15\nG83 X25 Z-9 Q3 R2\nG80\nG84 X1 Y2 Z-8 R3 F1500\nG80\nG10 L2 P2 X5 Y-3 Z1 R30\nG55\nG0 X1 Y1\nG1 X2 F100\nG2 X4 Y1 Z0 I1 J0\nG92 X0 Y2\nG1 X3\nG53 G0 Z5\nX7\nG92.2\nG1 Y4\nG92.1\nG54\nG0 X2 Y2\nG95 F0.2\nG1 X4\nG93 G1 X12 F4\nG2 X20 Y2 I4 J0 F5\nG94\nF140\nG33 Z-3 K1.5\nG0 Z4\nG33.1 Z-6 K1\nG38.2 Z-1.5 F30\nG91 G0 Z1.5\nG90 G0 @9 ^30\nG28.1\nG0 X1\nG28 Z5\nM19 R90 Q2\nM49\nS700 M3\nG1 X2.5 F60\nG96 D900 S80\nG1 X3 F60\nG97 S600\nT3 M6\nG0 X3.5\nM3\nG1 X4 F60\nM0\n(MSG,LOOK)\nG20\nG0 X1 Y1 Z1\nG1 X2.5 F10\nM8\nG1 X3 F10\nM2\n";

fn listed(job: &Job) -> (Program, String) {
    let mut batch = Batch::default();
    let mut reader = Reader::new(job.from.clone(), true);
    reader.read(PART.as_bytes(), 0, &mut batch);
    reader.finish(&mut batch);
    let main = Procedure { body: std::mem::take(&mut batch.stmts), ..Procedure::default() };
    let program = Program { name: batch.name.clone(), assumed: batch.assumed, procedures: vec![main] };
    let text =
        rs274::print(&program, PART.as_bytes(), &Default::default(), job.from.arc_rule()).expect("a listing");
    (program, text)
}

fn job() -> Job {
    let of = |dialect| Settings::new(builtin(dialect).expect("a built-in dialect"));
    Job::new(of("linuxcnc"), of("canon"), "part.ngc")
}

#[test]
fn a_listing_does_what_its_program_does() {
    let job = job();
    let (program, text) = listed(&job);
    verify(&job, &program, PART.as_bytes(), &text).expect("the same");
}

#[test]
fn every_other_number_is_found_out() {
    let job = job();
    let (program, text) = listed(&job);
    let lines: Vec<&str> = text.lines().collect();
    let end = lines.iter().rposition(|line| *line == "PROGRAM_STOP()").expect("a stop");
    let mut tried = 0;
    for (at, line) in lines.iter().enumerate().skip(6) {
        let Some((name, rest)) = line.split_once('(') else { continue };
        let moves = name.starts_with("STRAIGHT") || name == "ARC_FEED";
        // Feeds and speeds that nothing uses are stated at the end alone.
        let used = moves
            || matches!(name, "DWELL" | "CHANGE_TOOL" | "RIGID_TAP" | "ORIENT_SPINDLE") && at < end
            || name == "START_SPEED_FEED_SYNC";
        // How the spindle turns to its angle, and what a thread holds to, is no number of the program's.
        let (rest, tail) = match rest.strip_suffix(",0)").or(rest.strip_suffix(", 0)")) {
            Some(numbers) => (numbers, &rest[numbers.len()..]),
            None => (rest.trim_end_matches(')'), ")"),
        };
        let words: Vec<&str> = rest.split(", ").collect();
        let tap = name == "DWELL" && words[0] == "0.0000";
        for word in (0..words.len()).filter(|word| used && !tap && words[*word] != "0") {
            let mut other: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
            other[word] = match words[word].split_once('.') {
                Some((whole, part)) => {
                    let (four, rest) = part.split_at(4);
                    format!("{whole}.{:04}{rest}", (four.parse::<u32>().expect("digits") + 3) % 10_000)
                }
                None => (words[word].parse::<i64>().expect("a number") * 2).to_string(),
            };
            let mut text: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
            text[at] = format!("{name}({}{tail}", other.join(", "));
            tried += 1;
            let found = verify(&job, &program, PART.as_bytes(), &text.join("\n"));
            assert!(found.is_err(), "{line}: {} is not found out", text[at]);
        }
    }
    assert!(tried > 150, "{tried}");
}

#[test]
fn every_missing_call_is_found_out() {
    let job = job();
    let (program, text) = listed(&job);
    let lines: Vec<&str> = text.lines().collect();
    let counts = [
        "STRAIGHT_",
        "ARC_",
        "DWELL(0.5",
        "MIST_ON",
        "FLOOD_O",
        "CHANGE_TOOL",
        "START_SPINDLE",
        "MESSAGE",
        "PROGRAM_",
        "SET_FEED_RATE(120",
        "SELECT_PLANE(CANON_PLANE_XZ",
        "USE_LENGTH_UNITS(CANON_UNITS_INCHES",
        "SET_SPINDLE_SPEED",
        "DISABLE_FEED_OVERRIDE",
        "SET_G5X_OFFSET(2",
        "SET_XY_ROTATION(30",
        "SET_G92_OFFSET(-",
        "SET_FEED_MODE(0, 1",
        "SET_FEED_RATE(0.2",
        "SET_FEED_RATE(32.0",
        "SET_SPINDLE_MODE(0 900",
        "START_SPEED_FEED_SYNC",
        "RIGID_TAP",
        "TURN_PROBE_ON",
        "ORIENT_SPINDLE(0, 90",
    ];
    let mut tried = 0;
    for at in (6..lines.len()).filter(|at| counts.iter().any(|name| lines[*at].starts_with(name))) {
        // One that goes where the tool is is none, and the operator's switches alone are not compared.
        let switch = lines[at] == "DISABLE_FEED_OVERRIDE()" && !lines[at + 2].starts_with("STRAIGHT_FEED");
        if lines[at - 1] == lines[at] || switch {
            continue;
        }
        let kept = lines.iter().enumerate().filter(|(line, _)| *line != at).map(|(_, line)| *line);
        let text = kept.collect::<Vec<_>>().join("\n");
        tried += 1;
        assert!(verify(&job, &program, PART.as_bytes(), &text).is_err(), "{} is not missed", lines[at]);
    }
    assert!(tried > 40, "{tried}");
}
