//! Canned cycles and patterns.

use super::*;

const DRILL: &str = "CYCLE drill Xy R2. Z-5. Initial PlaneFirst F50.";

#[test]
fn the_block_of_a_cycle_makes_a_hole_or_not_by_the_dictionary() {
    assert_eq!(
        after_head("fanuc", "G81 X1. Y2. Z-5. R2. F50.\nX3.\nF60. M8\nY4.\nG80\n"),
        [
            DRILL,
            "& HOLE! X1. Y2.",
            "HOLE X3.",
            "FloodOn",
            // The new feed is the cycle's.
            "& CYCLE drill Xy R2. Z-5. Initial PlaneFirst F60.",
            "HOLE Y4.",
            "EndCycle"
        ]
    );
    assert_eq!(after_head("fanuc", "G81 Z-5. R2. F50.\n"), [DRILL, "& HOLE!"]);
    assert_eq!(
        after_head("mach9", "G81Z-6.R3.F191\nX1.Y2.\nG80\n"),
        ["CYCLE drill Xy R3. Z-6. Retract RaiseFirst F191", "HOLE X1. Y2.", "EndCycle"]
    );
}

#[test]
fn the_modal_feed_is_the_cycle_s_if_its_block_says_none() {
    assert_eq!(
        after_head("fanuc", "G81 X1. Z-5. R2.\nX2. F70.\n"),
        ["CYCLE drill Xy R2. Z-5. Initial PlaneFirst", "& HOLE! X1.", "F70.", "& HOLE X2."]
    );
    // Said in a cycle's block that made no hole, and then used by a line.
    assert_eq!(
        after_head("mach9", "G81Z-6.R3.F191\nG80\nG1X1.\n"),
        ["CYCLE drill Xy R3. Z-6. Retract RaiseFirst F191", "EndCycle", "F191", "& FEED! X1."]
    );
}

#[test]
fn words_stay_in_force_from_cycle_to_cycle_where_they_do() {
    assert_eq!(
        after_head(
            "fanuc",
            "G99 G82 X1. Z-5. R2. P500 F50.\nX2. Z-7.\nG81 X3.\nG83 X4. Q3.\nX5. Q-4.\nG89 X6.\n"
        ),
        [
            "SetReturnLevel(Retract)",
            "& CYCLE drill-dwell dwell 0.500s Xy R2. Z-5. Retract PlaneFirst F50.",
            "& HOLE! X1.",
            "CYCLE drill-dwell dwell 0.500s Xy R2. Z-7. Retract PlaneFirst F50.",
            "& HOLE X2.",
            "CYCLE drill Xy R2. Z-7. Retract PlaneFirst",
            "& HOLE! X3.",
            "CYCLE drill-peck peck 3. Xy R2. Z-7. Retract PlaneFirst",
            "& HOLE! X4.",
            "CYCLE drill-peck peck 4. Xy R2. Z-7. Retract PlaneFirst",
            "& HOLE X5.",
            "CYCLE bore dwell 0.500s Xy R2. Z-7. Retract PlaneFirst",
            "& HOLE! X6."
        ]
    );
    assert_eq!(
        faults("mach9", "G81Z-6.R3.F191\nX1.\nG81Z-8.\n"),
        ["WordMissing { code: 'G81', word: 'R' } at 'G81'"]
    );
    assert_eq!(
        faults("fanuc", "G81 X1. Z-5. R2.\nG80\nG81 X2.\n"),
        [
            "WordMissing { code: 'G81', word: 'Z' } at 'G81'",
            "WordMissing { code: 'G81', word: 'R' } at 'G81'"
        ]
    );
}

#[test]
fn a_return_level_in_a_hole_s_block_counts_from_there() {
    assert_eq!(
        after_head("fanuc", "G99 G81 X1. Z-5. R2. F50.\nG98 X2.\n"),
        [
            "SetReturnLevel(Retract)",
            "& CYCLE drill Xy R2. Z-5. Retract PlaneFirst F50.",
            "& HOLE! X1.",
            "SetReturnLevel(Initial)",
            "& CYCLE drill Xy R2. Z-5. Initial PlaneFirst F50.",
            "& HOLE X2."
        ]
    );
}

#[test]
fn incremental_cycles() {
    assert_eq!(
        after_head("fanuc", "G91 G99 G81 X10. Z-7. R-3. F50.\nX10.\n"),
        [
            "SetDistanceMode(Incremental)",
            "& SetReturnLevel(Retract)",
            "& CYCLE drill Xy R+=-3. Z+=-7. Retract PlaneFirst F50.",
            "& HOLE! X+=10.",
            "HOLE X+=10."
        ]
    );
    assert_eq!(
        faults("mach9", "G91\nG81Z-6.R3.F191\n"),
        ["NotSupported { code: 'G81', what: Cycle(Increments) } at 'G81'"]
    );
    assert_eq!(
        faults("mach9", "G81Z-6.R3.F191\nG91\nX1.\n"),
        ["NotSupported { code: 'G81', what: Cycle(Increments) } at 'X1.'"]
    );
}

#[test]
fn repetitions_of_a_cycle() {
    assert_eq!(
        after_head("fanuc", "G81 Z-5. R2. F50. K0\nG91 X10. K3\n"),
        [DRILL, "SetDistanceMode(Incremental)", "& HOLE X+=10.", "HOLE X+=10.", "HOLE X+=10."]
    );
    assert_eq!(
        faults("fanuc", "G81 Z-5. R2. F50. L3\n"),
        ["NotSupported { code: 'L3', what: Code(Named { name: 'repetition by L' }) } at 'L3'"]
    );
    assert_eq!(
        faults("fanuc", "G81 X1. Z-5. R2. K99999\n"),
        ["OutOfRange { word: Word('K99999') } at 'K99999'"]
    );
}

#[test]
fn a_motion_code_ends_a_cycle() {
    assert_eq!(
        after_head("fanuc", "G81 X1. Z-5. R2. F50.\nG0 Z9.\nX4.\n"),
        [DRILL, "& HOLE! X1.", "EndCycle", "& TRAVERSE! Z9.", "TRAVERSE X4."]
    );
    // Before a cycle's code it says what is active afterwards; after it the block is refused.
    assert_eq!(after_head("fanuc", "G0 G81 X1. Z-5. R2. F50.\n"), [DRILL, "& HOLE! X1."]);
    assert_eq!(
        faults("fanuc", "G81 G0 X1. Z-5. R2. F50.\n"),
        ["CodesExclude { first: 'G81', second: 'G0' } at 'G0'"]
    );
}

#[test]
fn words_after_the_end_of_a_cycle_do_what_was_in_force_before_it() {
    let text = head("fanuc").to_owned() + "G81 X1. Z-5. R2. F50.\nG80\nX4.\nX5.\nM30\n";
    let out = read("fanuc", &text);
    assert_eq!(
        stmts(&out).split_off(stmts(&out).len() - 4),
        ["EndCycle", "TRAVERSE X4.", "TRAVERSE X5.", "ProgramEnd"]
    );
    let assumed = diagnostics(&out, &text).split_off(1);
    assert_eq!(assumed, ["AssumedMode { fact: Motion, value: 'rapid' } at 'X4.'"]);
    // A safe start's end of no cycle changes nothing.
    assert_eq!(after_head("fanuc", "G80\nX4.\n"), ["EndCycle", "TRAVERSE X4."]);
    assert!(
        !assumptions("fanuc", &(head("fanuc").to_owned() + "G80\nX4.\nM30\n"))
            .iter()
            .any(|d| d.contains("Motion"))
    );
}

#[test]
fn dwell_in_a_cycle_makes_no_hole() {
    assert_eq!(
        after_head("fanuc", "G81 X1. Z-5. R2. F50.\nG4 X1.\nX2.\n"),
        [DRILL, "& HOLE! X1.", "DWELL 1.s", "HOLE X2."]
    );
    assert_eq!(faults("fanuc", "G81 X1. Z-5. R2.\nQ5.\n"), ["WordUnused { word: 'Q5.' } at 'Q5.'"]);
}

#[test]
fn what_a_cycle_lacks() {
    assert_eq!(faults("fanuc", "G82 X1. Z-5. R2.\n"), ["WordMissing { code: 'G82', word: 'P' } at 'G82'"]);
    assert_eq!(faults("fanuc", "G83 X1. Z-5. R2.\n"), ["WordMissing { code: 'G83', word: 'Q' } at 'G83'"]);
    assert_eq!(faults("fanuc", "G83 X1. Z-5. R2. Q0\n")[0], "OutOfRange { word: Word('Q0') } at 'Q0'");
    assert_eq!(
        faults("fanuc", "G18 G81 X1. Z-5. R2.\n"),
        ["NotSupported { code: 'G81', what: Cycle(OtherAxis) } at 'G81'"]
    );
    assert_eq!(
        faults("fanuc", "G81 X1. Z-5. R2.\nG18 X1.\n"),
        ["NotSupported { code: 'G18', what: Move(PlaneInCycle) } at 'G18'"]
    );
    assert_eq!(faults("mach9", "G81X1.Z-6.R3.\n"), ["WordUnused { word: 'X1.' } at 'X1.'"]);
}

#[test]
fn unconfirmed_cycles_are_reported_once() {
    let text = head("mach9").to_owned() + "G82Z-6.R3.D1.F10\nX1.\nG82Z-7.R3.D1.\nX1.\nG85Z-1.R3.\nX2.\nM2\n";
    let rows: Vec<_> =
        assumptions("mach9", &text).into_iter().filter(|d| d.starts_with("AssumedRow")).collect();
    assert_eq!(
        rows,
        [
            "AssumedRow { code: 'G82', meaning: 'START_CYCLE' } at 'G82'",
            "AssumedRow { code: 'G85', meaning: 'START_CYCLE' } at 'G85'"
        ]
    );
}

#[test]
fn bolt_circles() {
    let cycle = "G81Z-6.R3.F191\n";
    let pattern = |words: &str| after_head("mach9", &format!("{cycle}{words}\n")).split_off(1);
    assert_eq!(pattern("G24XY18.B30.L12"), ["CIRCLE 12 from 0 18. step 30.deg about here"]);
    assert_eq!(pattern("G24X9.Y0.I0J0B-30.L3"), ["CIRCLE 3 from 9. 0. step -30.deg about 0 0"]);
    let lacks = |words: &str| faults("mach9", &format!("{cycle}{words}\n"));
    assert_eq!(lacks("G24X1.B30.L12"), ["WordMissing { code: 'G24', word: 'Y' } at 'G24'"]);
    assert_eq!(lacks("G24X1.Y1.B30.L0"), ["OutOfRange { word: Word('L0') } at 'L0'"]);
    assert_eq!(faults("mach9", "G24XY18.B30.L12\n"), ["NoCycle at 'G24'"]);
}

#[test]
fn grids() {
    let cycle = "G81Z-6.R3.F191\n";
    let pattern = |words: &str| after_head("mach9", &format!("{cycle}{words}\n")).split_off(1);
    assert_eq!(pattern("G25X30.Y130.I2J2"), ["GRID 2xX30. 2xY130. serpentine"]);
    assert_eq!(pattern("G25X30.Y-10.I4J1"), ["GRID 4xX30. 1xY-10. serpentine"]);
}

#[test]
fn options_that_decide_are_reported_unless_chosen() {
    let source = |grid: &str| head("mach9").to_owned() + "G81Z-6.R3.F191\nG24X9.YB30.L12\n" + grid + "\nM2\n";
    let options = |text: &str| -> Vec<String> {
        assumptions("mach9", text).into_iter().filter(|d| d.starts_with("AssumedOption")).collect()
    };
    let circle = [
        "AssumedOption { option: 'o_word', value: 'offset' } at 'O1'",
        "AssumedOption { option: 'g24_centre', value: 'current' } at 'G24'",
        "AssumedOption { option: 'cycle_approach', value: 'plane' } at 'G24'",
        "AssumedOption { option: 'g24_direction', value: 'ccw' } at 'G24'",
    ];
    assert_eq!(options(&source("G25X1.Y1.I2J2")), circle);
    let mut with_grid = circle.to_vec();
    with_grid.push("AssumedOption { option: 'g25_xy', value: 'pitch' } at 'G25'");
    assert_eq!(options(&source("G25X1.Y1.I3J2")), with_grid);

    let mut settings = settings("mach9");
    for (option, value) in [
        ("o_word", "offset"),
        ("g24_centre", "zero"),
        ("g24_direction", "cw"),
        ("g25_xy", "extent"),
        ("cycle_approach", "retract"),
    ] {
        settings.choose(option, value).unwrap();
    }
    let text = source("G25X30.Y10.I4J2");
    let out = read_with(settings, true, text.as_bytes());
    assert!(!diagnostics(&out, &text).iter().any(|d| d.contains("Option")));
    let all = stmts(&out);
    assert_eq!(
        all[all.len() - 3..all.len() - 1],
        ["CIRCLE 12 from 9. 0 step -30.deg about 0 0", "GRID 4xX10. 2xY10. serpentine"]
    );
}

#[test]
fn the_position_that_a_feed_needs() {
    let text = "G21 G90 G17 G54\nG43 H1 G0 X0. Y0. Z5.\nG81 X1. Z-5. R2.\nM30\n";
    let out = read("fanuc", text);
    assert!(diagnostics(&out, text).iter().any(|d| d == "NoFeed at 'G81 X1. Z-5. R2.'"));
}
