//! What is stated, assumed, and lost.

use super::*;
use ncc_ir::canon::{Distance, Modes, Units};

#[test]
fn facts_never_said_are_reported_once_and_recorded() {
    let text = "G0 X1. Z2.\nX2. Z3.\nG81 Z-1. R1. F10.\nM30\n";
    let out = read("fanuc", text);
    assert_eq!(
        diagnostics(&out, text),
        [
            "AssumedMode { fact: Distance, value: 'absolute' } at 'X1.'",
            "AssumedMode { fact: Units, value: 'mm' } at 'X1.'",
            "AssumedMode { fact: WorkOffset, value: '1' } at 'G0 X1. Z2.'",
            "AssumedMode { fact: OriginShift, value: 'none' } at 'G0 X1. Z2.'",
            "AssumedMode { fact: LengthOffset, value: '0' } at 'G0 X1. Z2.'",
            "AssumedMode { fact: FeedMode, value: 'per minute' } at 'F10.'",
            "AssumedMode { fact: Plane, value: 'XY' } at 'G81'",
            "AssumedMode { fact: ReturnLevel, value: 'initial level' } at 'G81 Z-1. R1. F10.'"
        ]
    );
    let assumed = out.assumed;
    assert_eq!((assumed.distance, assumed.units), (Some(Distance::Absolute), Some(Units::Mm)));
    assert_eq!((assumed.work_offset, assumed.length_offset), (Some(1), Some(0)));
    assert_eq!(stmts(&out)[0], "TRAVERSE! X1. Z2.");
}

#[test]
fn facts_of_every_such_control_are_recorded_and_not_reported() {
    let text = "G71\nG90\nG99\nG0X1.\nG1X2.F10\nM2\n";
    let out = read("mach9", text);
    assert_eq!(diagnostics(&out, text), ["AssumedWorkOffset { offset: 1 } at 'G0X1.'"]);
    assert!(out.assumed.feed_mode.is_some());
}

#[test]
fn nothing_is_taken_for_granted_of_text_that_ncc_wrote() {
    let out = read_with(settings("fanuc"), false, b"X1.\nG1 X1. F100.\nM30\n");
    assert!(out.diagnostics.is_empty());
    assert_eq!(out.assumed, Modes::default());
    assert_eq!(stmts(&out), ["POSITION X?1.u", "F100.u", "& FEED! X?1.u", "ProgramEnd"]);
}

#[test]
fn a_move_needs_a_motion_and_a_feed() {
    assert!(faults_of("fanuc", "G90 G21\nX1.\nM30\n").contains(&"NoMotionMode at 'X1.'".to_owned()));
    assert!(faults_of("fanuc", "G90 G21\nG1 X1.\nM30\n").contains(&"NoFeed at 'G1 X1.'".to_owned()));
    // For text that ncc wrote as well.
    let out = read_with(settings("fanuc"), false, b"G1 X1.\nM30\n");
    assert_eq!(out.diagnostics.len(), 1);
    assert!(faults_of("mach9", "M6\nM2\n").contains(&"NoToolSelected at 'M6'".to_owned()));
}

fn faults_of(id: &str, text: &str) -> Vec<String> {
    diagnostics(&read(id, text), text).into_iter().filter(|d| !d.starts_with("Assumed")).collect()
}

#[test]
fn after_a_block_that_may_be_skipped_a_fact_is_lost() {
    assert_eq!(
        after_head("fanuc", "/G91\nX1.\nG90\n/G90\nX2.\n"),
        [
            "/1 SetDistanceMode(Incremental)",
            "TRAVERSE X?1.",
            "SetDistanceMode(Absolute)",
            "/1 SetDistanceMode(Absolute)",
            "TRAVERSE X2."
        ]
    );
    assert_eq!(
        after_head("fanuc", "/G1 X1.\nX2.\nG0 X3.\nX4.\n"),
        ["/1 FEED! X1.", "POSITION X2.", "TRAVERSE! X3.", "TRAVERSE X4."]
    );
    assert_eq!(
        after_head("fanuc", "/G81 X1. Z-5. R2. F50.\nX2.\nG0 X3.\nX4.\n")[2..],
        ["POSITION X2.", "TRAVERSE! X3.", "TRAVERSE X4."]
    );
    assert_eq!(after_head("fanuc", "/G20\nX1.\n"), ["/1 UseLengthUnits(Inch)", "TRAVERSE X1.u"]);
}

#[test]
fn what_a_skipped_block_takes_for_granted_holds_without_it() {
    let out = read("fanuc", "/G0 X1.\nG0 X2.\nM30\n");
    assert_eq!(stmts(&out)[..2], ["/1 TRAVERSE! X1.", "TRAVERSE! X2."]);
}

#[test]
fn after_a_call_every_fact_is_lost() {
    let out = read(
        "fanuc",
        &(head("fanuc").to_owned() + "M98 P7\nX1.\nG1 X2.\nM30\nO7\nX1. Y2.\nG90 G0 X3.\nM99\n"),
    );
    let all = stmts(&out);
    assert_eq!(all[all.len() - 4..], ["CALL 7 x1", "POSITION X?1.u", "FEED! X?2.u", "ProgramEnd"]);
    let sub: Vec<_> = out.procedures[0].body.iter().map(show::stmt).collect();
    assert_eq!(sub, ["POSITION X?1.u Y?2.u", "SetDistanceMode(Absolute)", "& TRAVERSE! X3.u", "Return"]);
    assert!(out.whole);
}

#[test]
fn a_number_that_counts_increments_needs_units() {
    let sub = |main: &str, sub: &str| {
        let text = format!("O1\n{main}\nM98 P2\nM30\nO2\n{sub}\nM99\n");
        let out = read("fanuc", &text);
        let body: Vec<String> = out.procedures[0].body.iter().map(show::stmt).collect();
        (body, diagnostics(&out, &text).into_iter().filter(|d| d.starts_with("Entry")).collect::<Vec<_>>())
    };
    // The whole text says one kind of units.
    assert_eq!(sub("G20", "X100"), (vec!["POSITION X?0.0100u".into(), "Return".into()], vec![]));
    let open = vec!["EntryFactNeeded { fact: Units } at 'X100'".to_owned()];
    assert_eq!(sub("G20\nG21", "X100").1, open);
    assert_eq!(sub("G20", "X100\nG21").1, open);
    assert_eq!(sub("M8", "X100").1, open);
}
