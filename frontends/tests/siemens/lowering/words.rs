//! Words, modes, tools, dwells, skips and comments.

use super::*;

#[test]
fn numbers_count_whole_units_and_keep_their_digits() {
    assert_eq!(
        after_head("X10\nX=-10.50 Y=+5\nX.5 Y-0\n"),
        ["TRAVERSE X10", "TRAVERSE X-10.50 Y5", "TRAVERSE X0.5 Y0"]
    );
    assert_eq!(after_head("G1X1EX1Y=AC(3)\n"), ["FEED! X10. Y3"]);
}

#[test]
fn the_first_spindle_and_tools_by_name() {
    assert_eq!(
        after_head("S1=900 M1=3\nT=\"DRILL 8.5\"\nT1=4\n"),
        ["S900", "& StartSpindleClockwise", "SelectToolByName(\"DRILL 8.5\")", "T4"]
    );
    let angle = after_head("SPOS[1]=90\nSPOS[1]=DC(212.5)\n");
    assert_eq!(angle.len(), 2);
    assert_eq!(angle, after_head("SPOS=90\nSPOS=DC(212.5)\n"));
    assert_eq!(after_head("SETMS(1)\nSETMS\n"), ["NoEffect(\"SETMS\")", "NoEffect(\"SETMS\")"]);
}

#[test]
fn a_word_says_by_itself_from_where_it_is_measured() {
    assert_eq!(
        after_head("G91\nX1 Y=AC(2)\nG90 X=IC(-3) Y4\n"),
        [
            "SetDistanceMode(Incremental)",
            "TRAVERSE X+=1 Y2",
            "SetDistanceMode(Absolute)",
            "& TRAVERSE X+=-3 Y4"
        ]
    );
}

#[test]
fn the_functions_of_a_block_in_their_order() {
    assert_eq!(
        after_head("N10 M8 M3 G1 X5 S900 F200 G54 G17 M5\n"),
        [
            "N10 SelectPlane(Xy)",
            "& SetOriginOffsets(1)",
            "& F200",
            "& S900",
            "& StartSpindleClockwise",
            "& FloodOn",
            "& FEED! X5",
            "& StopSpindleTurning"
        ]
    );
    assert_eq!(
        after_head("M1\nM0\nM9 M7\n"),
        ["OptionalProgramStop", "ProgramStop", "MistOn", "& CoolantOff"]
    );
}

#[test]
fn a_tool_change_brings_its_first_edge() {
    assert_eq!(
        after_head("T5\nM6\nD2\nT=7 M6 D3\nD0 G0 Z=9\n"),
        [
            "T5",
            "ChangeTool",
            "& EDGE 1",
            "EDGE! 2",
            "T7",
            "& ChangeTool",
            "& EDGE! 3",
            "EDGE! 0",
            "& TRAVERSE! Z9"
        ]
    );
    let relied = "T1 M6\nG710 G17 G90 G54 G0 Z5\nT2 M6\nZ9\nM30\n";
    let option = "AssumedOption { option: 'edge_after_change', value: '1' } at 'M6'";
    assert_eq!(assumptions(relied), [option]);
    // Named before a move depends on it.
    assert_eq!(assumptions("T1 M6\nG710 G17 G90 G54\nD1\nG0 Z5\nM30\n"), [] as [&str; 0]);
    assert_eq!(assumptions("T1 M6\nG710 G17 G90 G54 G0 X5\nM30\n"), [] as [&str; 0]);
    let mut none = settings();
    none.choose("edge_after_change", "none").expect("a choice");
    assert_eq!(stmts(&read_with(none, true, b"T1 M6\nM30\n"))[2], "& EDGE 0");
}

#[test]
fn work_offsets() {
    assert_eq!(
        after_head("G500\nG57\nG505\nG599\n"),
        ["SetOriginOffsets(0)", "SetOriginOffsets(4)", "SetOriginOffsets(5)", "SetOriginOffsets(99)"]
    );
}

#[test]
fn a_dwell_leaves_the_feed_alone() {
    assert_eq!(after_head("G4 F1.5\nG4F2\nG1 X1\n"), ["DWELL 1.5s", "DWELL 2s", "FEED! X1"]);
    assert_eq!(faults("G4 S3\n"), ["NotSupported { code: 'G4', what: Code(DwellInTurns) } at 'G4'"]);
    assert_eq!(faults("G4\n"), ["WordMissing { code: 'G4', word: 'F' } at 'G4'"]);
    assert_eq!(faults("G4 F1 X5\n"), ["WordUnused { word: 'X5' } at 'X5'"]);
    assert_eq!(faults("G4 F1 M8\n")[0], "NotSupported { code: 'G4', what: Code(DwellBesideOthers) } at 'G4'");
}

#[test]
fn feeds_count_in_the_basic_system_unless_they_are_scaled() {
    assert_eq!(
        after_head("G70 G1 X1 F100\nG700 F4\nX2\nG71 F100\n"),
        [
            "UseLengthUnits(Inch)",
            "& F100",
            "& FEED! X1in",
            "UseLengthUnits(Inch)",
            "& F4in",
            "FEED X2in",
            "UseLengthUnits(Mm)",
            "& F100"
        ]
    );
    let text = HEAD.to_owned() + "G70\nF5\nM30\n";
    assert_eq!(assumptions(&text), ["AssumedOption { option: 'feed_unit', value: 'mm' } at 'F5'"]);
    // A feed in another unit is no longer valid.
    assert_eq!(faults("G700\nG1 X1\n"), ["NoFeed at 'G1 X1'"]);
    assert_eq!(faults("G70\nG1 X1\n"), [] as [&str; 0]);
    let mut inch = settings();
    inch.choose("feed_unit", "inch").expect("a choice");
    let out = read_with(inch, true, b"G71\nF5\nM30\n");
    assert_eq!(stmts(&out)[1], "F5in");
}

#[test]
fn skip_levels() {
    assert_eq!(
        after_head("/ X1\n/0 X2\n/1 X3\n/9N5 X4\n/2\n"),
        ["/1 TRAVERSE X1", "/1 TRAVERSE X2", "/10 TRAVERSE X3", "/9 N5 TRAVERSE X4", "/2 Blank"]
    );
    // Modes set in blocks of one switch hold among them, and are unknown after them.
    assert_eq!(
        after_head("/ G91\n/ X1\nX2\n"),
        ["/1 SetDistanceMode(Incremental)", "/1 TRAVERSE X+=1", "TRAVERSE X?2"]
    );
    assert_eq!(after_head("/ G91\n/2 X1\n"), ["/1 SetDistanceMode(Incremental)", "/2 TRAVERSE X?1"]);
    assert_eq!(after_head("/ G91\n/ X1\n/ G90\nX2\n")[3], "TRAVERSE X2");
}

#[test]
fn comments_messages_and_empty_blocks() {
    assert_eq!(
        after_head("; a\nX1 ; b;c \n\nN7\nN8 ;d\n;\n"),
        ["(a)", "TRAVERSE X1 (b;c)", "Blank", "N7 Blank", "N8 (d)", "()"]
    );
    assert_eq!(
        after_head("MSG(\"a;\"\"b\") ;c\nMSG()\nMSG(\"\")\nMSG\n"),
        ["MSG 'a;\\'b' (c)", "MSG ''", "MSG ''", "MSG ''"]
    );
    let out = read_with(settings(), true, b"; \xD8 6\nMSG(\"\xFC\")\nM30\n");
    assert_eq!(stmts(&out), ["(\u{d8} 6)", "MSG '\u{fc}'", "ProgramEnd"]);
}

#[test]
fn words_without_effect_are_kept_and_told() {
    let text = HEAD.to_owned() + "DIAMOF\nSPATH G1 X1\nDIAMOF\nM30\n";
    let out = read(&text);
    assert_eq!(
        stmts(&out)[stmts(&out).len() - 5..],
        ["NoEffect('DIAMOF')", "NoEffect('SPATH')", "& FEED! X1", "NoEffect('DIAMOF')", "ProgramEnd"]
            .map(|s| s.replace('\'', "\""))
    );
    assert_eq!(
        assumptions(&text),
        ["AssumedNoEffect { code: 'DIAMOF' } at 'DIAMOF'", "AssumedNoEffect { code: 'SPATH' } at 'SPATH'"]
    );
}

#[test]
fn machine_coordinates() {
    assert_eq!(
        after_head("SUPA G0 Z0 D0\nG153 X1 Y2\nX3\nG53\n"),
        [
            "EDGE! 0",
            "& UseMachineCoordinates { length: true }",
            "& TRAVERSE! Z0",
            "UseMachineCoordinates { length: true }",
            "& TRAVERSE X1 Y2",
            "TRAVERSE X3",
            "NoEffect('G53')"
        ]
        .map(|s| s.replace('\'', "\""))
    );
    assert_eq!(
        faults("SUPA X=IC(5)\n"),
        ["NotSupported { code: 'X=IC(5)', what: Move(MachineIncrementWord) } at 'X=IC(5)'"]
    );
    assert_eq!(
        faults("SUPA G2 X5 I2\n"),
        ["NotSupported { code: 'SUPA', what: Move(MachineArc) } at 'SUPA'"]
    );
}

#[test]
fn functions_whose_time_machine_data_decide() {
    let text = HEAD.to_owned() + "G0 X1 M5\nX2 M9\nX3 M9\nM5\nM30\n";
    assert_eq!(
        assumptions(&text),
        [
            "AssumedFact { fact: AfterMove { code: 'M5' } } at 'M5'",
            "AssumedFact { fact: AfterMove { code: 'M9' } } at 'M9'"
        ]
    );
}
