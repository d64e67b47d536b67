//! Laws of `ncc diff`: a program is the same as itself and as its translation, an edit is told as what
//! it is, and what the first has more than the second, the second has less than the first.

use ncc::review::diff;
use ncc::review::diff::args::Ignore;
use ncc_ir::diag::Fault;
use ncc_tests::corpus::{self, DIALECTS, Program};
use ncc_tests::expect::Failures;
use ncc_tests::translate::{job, settings, translate};
use serde_json::Value;

use crate::schema::faults_of;

/// The document of a comparison; `None` if a program cannot be executed.
fn diff(a: (&str, &[u8]), b: (&str, &[u8])) -> Option<Value> {
    let (own, mut other) = (settings(a.0), settings(b.0));
    // Both machines have the first one's parameters: a control's own are no difference of programs.
    for option in ["peck_clearance", "break_lift"] {
        if !own.get(option).is_empty() && !other.get(option).is_empty() {
            other.choose(option, own.get(option)).expect("a distance");
        }
    }
    let sides = [(own, a.1), (other, b.1)];
    let text = diff::document(sides, None).expect("anonymous files")?;
    Some(serde_json::from_str(&text).expect("JSON"))
}

fn itself(program: &Program, text: &[u8]) -> Option<Value> {
    diff((program.dialect, &program.text), (program.dialect, text))
}

fn summary(document: &Value) -> &str {
    document["summary"].as_str().expect("a summary")
}

#[test]
fn a_program_is_the_same_as_itself() {
    let mut failures = Failures::default();
    let mut compared = 0;
    for program in corpus::all() {
        let Some(document) = itself(&program, &program.text) else { continue };
        compared += 1;
        if document["equal"] != true || document["differences"] != Value::Array(Vec::new()) {
            failures.add(format!("{}/{}", program.dialect, program.file), summary(&document));
        }
    }
    assert!(compared > 100, "{compared}");
    failures.finish();
}

/// Programs that go the ways that values of the machine's tables have them go: no two of them are compared (NC0226).
const ASKING: [&str; 2] = ["tool-length-check.nc", "tool-life.nc"];

/// Each side takes for granted what its own dialect does: translations state what they need.
#[test]
fn a_program_is_the_same_as_its_translation() {
    let mut failures = Failures::default();
    let (mut compared, mut differing) = (0, 0);
    for program in corpus::all() {
        for to in DIALECTS.into_iter().filter(|to| *to != program.dialect) {
            let job = job(program.dialect, to, &program.file);
            let (outcome, written) = translate(&job, &program.text);
            if outcome.release.is_err() {
                continue;
            }
            let what = format!("{}/{} to {to}", program.dialect, program.file);
            // A control that has one work offset only: the translation told what it is taken to be.
            let offset = outcome
                .diagnostics
                .iter()
                .any(|d| matches!(d.fault, Fault::AssumedWorkOffset { offset } if offset > 1));
            let lengths = outcome.diagnostics.iter().any(|d| matches!(d.fault, Fault::LengthByHand { .. }));
            // What a code does besides its name shows: one control does it by itself, the other one in words.
            let besides = outcome.diagnostics.iter().any(|d| {
                matches!(
                    d.fault,
                    Fault::SideEffectWritten { .. }
                        | Fault::StartedAgain { .. }
                        | Fault::MovedAtChange
                        | Fault::FeedOnArcs { .. }
                )
            });
            match diff((program.dialect, &program.text), (to, &written)) {
                // Of tools that are changed by hand, the change is always in words.
                Some(document) if besides && document["equal"] != true => {
                    differing += usize::from(
                        !job.from.dialect.can.change_by_hand && !job.to.dialect.can.change_by_hand,
                    );
                }
                // Where tools are put in by hand, the length that was left out is told.
                Some(document) if offset || lengths => {
                    let all = document["differences"].as_array().expect("a list");
                    let expected = |kind: &str| {
                        offset && kind == "work-offset"
                            || lengths && matches!(kind, "length" | "moved" | "frame")
                    };
                    if all.iter().any(|d| !d["kind"].as_str().is_some_and(expected)) {
                        failures.add(what, summary(&document));
                    }
                }
                Some(document) if document["equal"] == true => compared += 1,
                Some(document) => failures.add(what, summary(&document)),
                None if ASKING.contains(&&*program.file) => {}
                None => failures.add(what, "cannot be executed"),
            }
        }
    }
    assert!(compared > 300, "{compared}");
    // Few are compared less closely: of seven dialects 24 of some 700 were.
    assert!(differing * 28 < compared, "{differing} of {compared}");
    failures.finish();
}

/// What differs between two programs of the corpus is told from both sides, and as the schema says.
#[test]
fn both_ways_tell_the_same() {
    let mut failures = Failures::default();
    for dialect in DIALECTS {
        let programs = corpus::of(dialect);
        for pair in programs.windows(2) {
            let [a, b] = pair else { continue };
            let what = format!("{dialect}/{} and {}", a.file, b.file);
            let there = diff((dialect, &a.text), (dialect, &b.text));
            let back = diff((dialect, &b.text), (dialect, &a.text));
            let (Some(there), Some(back)) = (there, back) else { continue };
            let wrong = faults_of(diff::SCHEMA, &there);
            if !wrong.is_empty() {
                failures.add(&what, wrong.join("\n"));
            }
            let counts = |d: &Value, keys: [&str; 3]| keys.map(|key| d["compared"][key].clone());
            if there["equal"] != back["equal"]
                || counts(&there, ["same", "only_a", "only_b"]) != counts(&back, ["same", "only_b", "only_a"])
            {
                failures.add(&what, format!("{}\n{}", there["compared"], back["compared"]));
            }
        }
    }
    failures.finish();
}

const PART: &str = "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nT3 M06\nS1000 M03\nG00 X0. Y0. M08\nG43 Z25. H3\n\
    G01 Z-1. F300.\nX10.\nY10.\nX0.\nY0.\nG00 Z25.\nG99 G81 X50. Y10. Z-12. R2. F191.\nX60.\nX70.\nX80.\n\
    G80\nG00 Z50. M09\nX0. Y0.\nG01 Z-2. F300.\nG02 X20. Y0. I10. J0.\nG00 Z50.\nM05\nM30\n%\n";

/// Edits of a part, and what is told of them.
#[test]
fn an_edit_is_told_as_what_it_is() {
    let cases: [(&str, &str, &str); 15] = [
        ("F300.\nX10.", "F250.\nX10.", "same path; feed 300 → 250 on 5 moves of T3"),
        ("\nX60.\n", "\nX60.02\n", "one hole of T3 0.02 mm off (X+0.02) at line 16"),
        ("\nX60.\n", "\n", "one hole of T3 only in the first at line 16"),
        ("\nX70.\n", "\nX70.\nX75.\n", "one hole of T3 only in the second at line 18"),
        ("\nX10.\n", "\nX10.5\n", "2 moves of T3 0.5 mm off (X+0.5) first at line 10"),
        ("S1000", "S1200", "same path; spindle speed 1000 → 1200 on"),
        ("M03", "M04", "same path; spindle clockwise → counter-clockwise on"),
        ("Y0. M08", "Y0.", "same path; coolant flood → off on 22 moves of T3"),
        ("G54", "G55", "work offset 1 → 2 on"),
        ("H3", "H4", "tool length offset entry 3 → entry 4 on"),
        ("T3", "T4", "same path; tool T3 → T4 on"),
        ("Z-12.", "Z-12.5", "4 holes of T3 0.5 mm off (Z-0.5) first at line 15"),
        (
            "G02 X20. Y0. I10. J0.",
            "G03 X20. Y0. I10. J0.",
            "an arc of T3 with another centre, direction or sweep at line 23",
        ),
        ("G02 X20. Y0. I10. J0.", "G01 X20. Y0.", "other kind of move: arc → feed move at line 23"),
        ("M05\nM30\n", "M05\n", "same path;"),
    ];
    let mut failures = Failures::default();
    for (from, to, told) in cases {
        let edited = PART.replacen(from, to, 1);
        assert_ne!(edited, PART, "{from}");
        let document = diff(("fanuc", PART.as_bytes()), ("fanuc", edited.as_bytes())).expect("executed");
        if !summary(&document).contains(told) {
            failures.add(format!("{from:?} → {to:?}"), format!("{}\ninstead of {told}", summary(&document)));
        }
    }
    failures.finish();
}

/// What a speed counts, and its limit, are told by their names.
#[test]
fn a_speed_is_told_with_what_it_counts() {
    let surface = PART.replacen("S1000 M03", "G92 S2500\nG96 S180 M03", 1);
    let cases = [
        (
            PART,
            "S1000 M03",
            "G96 S180 M03",
            "spindle speed 1000 rev/min → 180 m/min constant surface speed on",
        ),
        // The number is the same one.
        (
            PART,
            "S1000 M03",
            "G96 S1000 M03",
            "spindle speed 1000 rev/min → 1000 m/min constant surface speed on",
        ),
        (&surface, "S180", "S150", "same path; constant surface speed 180 → 150 m/min on"),
        (&surface, "G96 S180", "S180", "spindle speed 180 m/min constant surface speed → 180 rev/min on"),
        (&surface, "S2500", "S2000", "same path; highest spindle speed 2500 rev/min → 2000 rev/min on"),
        (&surface, "G92 S2500\n", "", "same path; highest spindle speed 2500 rev/min → none on"),
    ];
    let mut failures = Failures::default();
    for (text, from, to, told) in cases {
        let edited = text.replacen(from, to, 1);
        let document = diff(("fanuc", text.as_bytes()), ("fanuc", edited.as_bytes())).expect("executed");
        if !summary(&document).contains(told) || !faults_of(diff::SCHEMA, &document).is_empty() {
            failures.add(format!("{from:?} → {to:?}"), format!("{}\ninstead of {told}", summary(&document)));
        }
    }
    failures.finish();
}

/// Moves of which each is shorter than what counts as the same go somewhere together.
#[test]
fn a_way_in_very_short_moves_is_no_rounding() {
    let depths = (1..=1000).chain((0..1000).rev());
    let plunge: String = depths.map(|n| format!("Z-1.{:04}\n", 4 * n)).collect();
    let other = PART.replacen("F300.\nX10.", &format!("F300.\n{plunge}X10."), 1);
    let document = diff(("fanuc", PART.as_bytes()), ("fanuc", other.as_bytes())).expect("executed");
    assert_eq!(document["equal"], false, "{}", summary(&document));
    let still = PART.replacen("F300.\nX10.", "F300.\nZ-1.0004\nZ-1.\nX10.", 1);
    let document = diff(("fanuc", PART.as_bytes()), ("fanuc", still.as_bytes())).expect("executed");
    assert_eq!(document["equal"], true, "{}", summary(&document));
}

/// Units that are others are told as that.
#[test]
fn lost_units_are_noted() {
    let inches = PART.replacen("G21", "G20", 1);
    let document = diff(("fanuc", PART.as_bytes()), ("fanuc", inches.as_bytes())).expect("executed");
    assert_eq!(document["notes"][0], "one program is in inches, the other in millimetres");
}

/// An insertion into a program that measures from where the tool stands shifts all that follows.
#[test]
fn a_shifted_tail_is_told_as_a_shift() {
    let mut text =
        "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nS1000 M03\nG00 X0. Y0. Z5.\nG91 G01 Z-1. F100.\n"
            .to_owned();
    for i in 0..60 {
        text += &format!("X{}. Y0.{}\n", i % 7 + 1, i % 9 + 1);
    }
    text += "G90 G00 Z50.\nM30\n%\n";
    let edited = text.replacen("X4. Y0.4\n", "X4. Y0.4\nX0.5\n", 1);
    let document = diff(("fanuc", text.as_bytes()), ("fanuc", edited.as_bytes())).expect("executed");
    assert!(
        summary(&document).contains("all that follows is shifted by X+0.5, over"),
        "{}",
        summary(&document)
    );
    assert!(document["differences"].as_array().is_some_and(|d| d.len() <= 4), "{document:#}");
}

/// Blocks that are skipped count in the setting in which they are not.
#[test]
fn block_skip_is_tried_both_ways() {
    let skipped = PART.replacen("\nX10.\n", "\nX10.\n/X11.\n", 1);
    let document = diff(("fanuc", PART.as_bytes()), ("fanuc", skipped.as_bytes())).expect("executed");
    assert_eq!(document["compared"]["skip_settings"], 2);
    let other = PART.replacen("\nX10.\n", "\n/X10.\n", 1);
    let document = diff(("fanuc", PART.as_bytes()), ("fanuc", other.as_bytes())).expect("executed");
    assert_eq!(document["differences"][0]["block_skip"], serde_json::json!([1]), "{document:#}");
}

/// Spelling that counts for nothing.
#[test]
fn texts_are_compared_by_their_dialects_rules() {
    let other = PART.replace("X10.\n", "N10 x+10.000 (WIDE)\n").replace("G01 Z-1.", "G1Z-1.0");
    let texts = || [(settings("fanuc"), PART.as_bytes()), (settings("fanuc"), other.as_bytes())];
    let equal = |ignore: &[Ignore]| {
        let text = diff::document(texts(), Some(ignore)).expect("anonymous files").expect("a document");
        let document: Value = serde_json::from_str(&text).expect("JSON");
        assert_eq!(faults_of(diff::SCHEMA, &document), [""; 0]);
        document["equal"] == true
    };
    assert!(equal(&[Ignore::All]) && !equal(&[]) && !equal(&[Ignore::Numbers, Ignore::Blanks]));
    use Ignore::{Blanks, Case, Comments, NumberFormat, Numbers};
    assert!(equal(&[Numbers, Blanks, Comments, Case, NumberFormat]));
    assert!(!equal(&[Numbers, Blanks, Comments, Case]));
}
