//! Lines, arcs, words and numbers.

use super::*;

#[test]
fn a_block_s_functions_come_in_their_order() {
    assert_eq!(after_head("mach9", "G1Z-1.F505\n"), ["F505", "& FEED! Z-1."]);
    assert_eq!(after_head("mach9", "T1M6\n"), ["T1", "& ChangeTool"]);
    assert_eq!(after_head("mach9", "O1S1263M3\n"), ["S1263", "& StartSpindleClockwise", "& LENGTH 1"]);
    assert_eq!(
        after_head("fanuc", "N10 M9 G1 X1. F50. S900 G91 G20\n"),
        [
            "N10 UseLengthUnits(Inch)",
            "& SetDistanceMode(Incremental)",
            "& F50.in",
            "& S900",
            "& FEED! X+=1.in",
            "& CoolantOff"
        ]
    );
    assert_eq!(after_head("fanuc", "M3 G0 X1.\n"), ["StartSpindleClockwise", "& TRAVERSE! X1."]);
    assert_eq!(after_head("fanuc", "M5 G0 X1.\n"), ["TRAVERSE! X1.", "& StopSpindleTurning"]);
}

#[test]
fn an_omitted_number_is_zero_where_the_dictionary_says_so() {
    assert_eq!(after_head("mach9", "GXY\n"), ["TRAVERSE! X0 Y0"]);
    assert_eq!(after_head("mach9", "GZ0\n"), ["TRAVERSE! Z0"]);
    assert_eq!(faults("fanuc", "G0 X Y1.\n"), ["WordWithoutNumber { letter: 'X' } at 'X'"]);
}

#[test]
fn digits_are_kept_as_written() {
    assert_eq!(
        after_head("fanuc", "X1.500 Y-.5 Z0.\nX+2. Y-0. Z0\n"),
        ["TRAVERSE X1.500 Y-0.5 Z0.", "TRAVERSE X2. Y0. Z0"]
    );
    assert_eq!(after_head("mach9", "X12Y-8.\n"), ["TRAVERSE X12 Y-8."]);
}

#[test]
fn a_number_without_a_point_counts_least_increments() {
    assert_eq!(after_head("fanuc", "X100 A1500\n"), ["TRAVERSE X0.100 A1.500deg"]);
    assert_eq!(
        after_head("fanuc", "G20 X100 F150\n"),
        ["UseLengthUnits(Inch)", "& F1.50in", "& TRAVERSE X0.0100in"]
    );
    assert_eq!(after_head("fanuc", "G1 X1. F150\n"), ["F150", "& FEED! X1."]);
}

#[test]
fn a_number_without_a_point_counts_whole_units_on_a_calculator() {
    let mut settings = settings("fanuc");
    settings.choose("decimal_point", "calculator").unwrap();
    let text = head("fanuc").to_owned() + "X100\n";
    let out = read_with(settings, true, text.as_bytes());
    assert_eq!(stmts(&out).last().unwrap(), "TRAVERSE X100");
    assert!(!diagnostics(&out, &text).iter().any(|d| d.starts_with("AssumedBare")));
}

#[test]
fn bare_numbers_are_reported_once_for_each_kind_and_not_for_zeros() {
    let bare = |id, text: &str| -> Vec<String> {
        assumptions(id, text).into_iter().filter(|d| d.starts_with("AssumedBare")).collect()
    };
    assert_eq!(
        bare("fanuc", "G0 X0 Y0\nX100 Y200\nA5\nX7\nM30\n"),
        [
            "AssumedBareNumber { word: 'X100', value: '0.100 mm' } at 'X100'",
            "AssumedBareNumber { word: 'A5', value: '0.005 degrees' } at 'A5'"
        ]
    );
    assert_eq!(
        bare("mach9", "G71\nGXY\nX-12Y5.\nM2\n"),
        ["AssumedBareNumber { word: 'X-12', value: '-12 mm' } at 'X-12'"]
    );
    assert_eq!(bare("fanuc", "G21 G1 X1. F100\nM30\n"), Vec::<String>::new());
}

#[test]
fn motion_is_modal_and_says_whether_it_is_said() {
    assert_eq!(
        after_head("fanuc", "G1 X1.\nX2.\nG0 Z3.\nZ4.\n"),
        ["FEED! X1.", "FEED X2.", "TRAVERSE! Z3.", "TRAVERSE Z4."]
    );
    // Without axis words a motion code only says what is active.
    assert_eq!(after_head("fanuc", "N5 G1\nX2.\n"), ["N5 Blank", "FEED X2."]);
}

#[test]
fn incremental_words_stay_incremental() {
    assert_eq!(
        after_head("fanuc", "G91 X1.\nZ-1.\nG90 X3.\n"),
        [
            "SetDistanceMode(Incremental)",
            "& TRAVERSE X+=1.",
            "TRAVERSE Z+=-1.",
            "SetDistanceMode(Absolute)",
            "& TRAVERSE X3."
        ]
    );
}

#[test]
fn centres_are_from_the_start_or_from_zero() {
    assert_eq!(
        after_head("fanuc", "G2 X10. I5.\n"),
        ["ARC! Known(Xy) Clockwise X10. I5.".replace("Known(Xy)", "Xy")]
    );
    assert_eq!(after_head("mach9", "G3X10.Y0.I5.J0\n"), ["ARC! Xy Counterclockwise X10. Y0. I=5. J=0"]);
    assert_eq!(
        after_head("fanuc", "G18 G3 X0. Z0. I-50.\nG19 G2 Y1. Z1. J1. K0.\n"),
        [
            "SelectPlane(Zx)",
            "& ARC! Zx Counterclockwise X0. Z0. I-50.",
            "SelectPlane(Yz)",
            "& ARC! Yz Clockwise Y1. Z1. J1. K0."
        ]
    );
}

#[test]
fn full_circles_radii_and_helices() {
    assert_eq!(
        after_head("fanuc", "G2 I-10.\nI5.\nX3. Y3. Z-1. R-4.\n"),
        ["ARC! Xy Clockwise I-10.", "ARC Xy Clockwise I5.", "ARC Xy Clockwise X3. Y3. Z-1. R-4."]
    );
}

#[test]
fn arcs_that_are_none() {
    assert_eq!(faults("fanuc", "G2 X1. Y1.\n"), ["ArcWithoutCentre at 'G2 X1. Y1.'"]);
    assert_eq!(faults("fanuc", "G2 X1. Y1. I1. R1.\n"), ["ArcCentreAndRadius at 'R1.'"]);
    assert_eq!(faults("fanuc", "G2 R1.\n"), ["ArcRadiusNoWay at 'G2 R1.'"]);
    assert_eq!(faults("fanuc", "G2 X1. I1. K1.\n"), ["WordUnused { word: 'K1.' } at 'K1.'"]);
    assert_eq!(
        faults("mach9", "G2X1.Y1.Z1.I1.J0\n"),
        ["NotSupported { code: 'Z', what: Move(HelixAxis) } at 'G2X1.Y1.Z1.I1.J0'"]
    );
    assert_eq!(faults("mach9", "G2X1.R5.\n"), ["ArcWithoutCentre at 'G2X1.R5.'"]);
}

/// LinuxCNC stops at such a block; elsewhere the code is active for the next one.
#[test]
fn a_code_of_motion_that_no_block_can_have_alone() {
    let lacks = |code: &str| [format!("WordMissing {{ code: '{code}', word: 'I, J, K or R' }} at '{code}'")];
    assert_eq!(faults("linuxcnc", "G3\nX1 I1\n"), lacks("G3"));
    assert_eq!(faults("linuxcnc", "G2 F5\n"), lacks("G2"));
    assert_eq!(faults("linuxcnc", "G33.1\n"), ["WordMissing { code: 'G33.1', word: 'Z' } at 'G33.1'"]);
    assert_eq!(faults("linuxcnc", "G1\nG0\nF5 G2 I1\n"), [""; 0]);
    assert_eq!(faults("fanuc", "F5. G3\nX2. I1.\n"), [""; 0]);
}

#[test]
fn dwell_in_seconds_or_milliseconds() {
    assert_eq!(after_head("mach9", "G4D5.\n"), ["DWELL 5.s"]);
    assert_eq!(
        after_head("fanuc", "G4 X1.5\nG04 P1500\nG4 X500\n"),
        ["DWELL 1.5s", "DWELL 1.500s", "DWELL 0.500s"]
    );
    assert_eq!(faults("fanuc", "G4\n"), ["WordMissing { code: 'G04', word: 'X' } at 'G4'"]);
    assert_eq!(faults("fanuc", "G4 P1.5\n"), ["PointNotAllowed { word: 'P1.5' } at 'P1.5'"]);
    assert_eq!(faults("fanuc", "G4 P100 Y1.\n"), ["WordUnused { word: 'Y1.' } at 'Y1.'"]);
}

#[test]
fn length_offsets() {
    assert_eq!(after_head("fanuc", "G43 H2 Z5.\nG49\n"), ["LENGTH 2", "& TRAVERSE Z5.", "LENGTH 0"]);
    // H stays active, also after G49; where it was never said, or may be another one, it is asked for.
    assert_eq!(after_head("fanuc", "G43 H2 Z5.\nG49\nG43 Z6.\n")[3..], ["LENGTH 2", "& TRAVERSE Z6."]);
    let text = "G21 G90\nG43 Z5.\nM30\n";
    let missing = "WordMissing { code: 'G43', word: 'H' } at 'G43'";
    assert!(diagnostics(&read("fanuc", text), text).contains(&missing.to_owned()));
    let unknown = "NotSupported { code: 'G43', what: Move(EntryOfBefore { letter: 'H' }) } at 'G43'";
    assert_eq!(faults("fanuc", "/G43 H2 Z5.\nG43 Z6.\n"), [unknown]);
    assert_eq!(faults("fanuc", "G43 H#1 Z5.\nG43 Z6.\n"), [unknown]);
    let once = |id, text: &str| {
        assumptions(id, text).into_iter().filter(|d| d.starts_with("AssumedOffsetWithZ")).collect::<Vec<_>>()
    };
    assert_eq!(once("fanuc", "G43 H1\nG43 H2\nM30\n"), ["AssumedOffsetWithZ at 'G43 H1'"]);
    assert_eq!(once("fanuc", "G0 G43 H1 Z1.\nM30\n"), Vec::<String>::new());
    assert_eq!(once("mach9", "O1\nO2\nM2\n"), ["AssumedOffsetWithZ at 'O1'"]);
}

#[test]
fn the_corrector_word_may_mean_nothing() {
    let mut settings = settings("mach9");
    settings.choose("o_word", "ignore").unwrap();
    let out = read_with(settings, true, b"O1S1263M3\nM2\n");
    assert_eq!(stmts(&out), ["S1263", "& StartSpindleClockwise", "ProgramEnd"]);
    assert!(out.diagnostics.is_empty(), "{:?}", out.diagnostics);
}

#[test]
fn work_offsets_and_other_settings() {
    assert_eq!(
        after_head("fanuc", "G55 G40 G0 X1.\n"),
        ["SetOriginOffsets(2)", "& StopCutterRadiusCompensation", "& TRAVERSE! X1."]
    );
    assert_eq!(after_head("mach9", "G99\n"), ["ClearFrame(Shift)"]);
    assert_eq!(after_head("mach9", "G66\n"), ["NoEffect(\"G66\")"]);
}

#[test]
fn block_skip() {
    assert_eq!(
        after_head("fanuc", "/G0 X1.\n/2 N5 M8\nN6/3 M9\n"),
        ["/1 TRAVERSE! X1.", "/2 N5 FloodOn", "/3 N6 CoolantOff"]
    );
    // Amid the words the mark counts for what follows it.
    assert_eq!(after_head("fanuc", "N7 Z2./M8\n"), ["/1 N7 FloodOn", "TRAVERSE Z2."]);
    assert_eq!(after_head("fanuc", "Z2./2 M9\n"), ["TRAVERSE Z2.", "/2 CoolantOff"]);
    assert_eq!(
        faults("fanuc", "X1./Y2.\n"),
        ["NotSupported { code: '/', what: Code(SkipAmidWords) } at 'X1./Y2.'"]
    );
    assert_eq!(
        faults("fanuc", "/1/3 X1.\n"),
        ["NotSupported { code: '/3', what: Code(SecondSkipLevel) } at '/3'"]
    );
    assert_eq!(faults("fanuc", "/0 X1.\n"), ["OutOfRange { word: Word('/0') } at '/0'"]);
    assert_eq!(faults("mach9", "/2X1.\n"), ["NotSupported { code: '/2', what: Code(SkipLevel) } at '/2X1.'"]);
    assert_eq!(
        assumptions("mach9", "/M5\n/M5\nM2\n"),
        ["AssumedRow { code: '/', meaning: 'block skip' } at '/M5'"]
    );
}

#[test]
fn comments() {
    assert_eq!(
        after_head("mach9", ";FURAÇÃO 3mm :\nG0X1.;rápido \n"),
        ["(FURAÇÃO 3mm :)", "TRAVERSE! X1. (rápido)"]
    );
    assert_eq!(
        after_head("fanuc", "(A) G0 X1. (B) M9\nN3 ( C )\nF50. (D)\n"),
        ["TRAVERSE! X1.", "& CoolantOff (A B)", "N3 ( C)", "F50. (D)"]
    );
    let latin = read_with(settings("mach9"), true, b";FURA\xC7\xC3O\nM2\n");
    assert_eq!(stmts(&latin), ["(FURAÇÃO)", "ProgramEnd"]);
}

#[test]
fn ends_of_blocks() {
    assert_eq!(
        after_head("fanuc", "X1.; Y2.;\r\nX3.;;\n\n"),
        ["TRAVERSE X1.", "TRAVERSE Y2.", "TRAVERSE X3.", "Blank"]
    );
    assert_eq!(
        after_head("mach9", "N00002 G00 X0. Y0. Z5.01#;text\nX1.#\n"),
        ["N2 TRAVERSE! X0. Y0. Z5.01 (text)", "TRAVERSE X1."]
    );
}

#[test]
fn blanks_and_small_letters() {
    assert_eq!(after_head("fanuc", "g 1 x\t1. y - 2. f 50.\n"), ["F50.", "& FEED! X1. Y-2."]);
    assert_eq!(after_head("mach9", "g1x1.f50\n"), ["F50", "& FEED! X1."]);
}
