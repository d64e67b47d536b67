//! What is refused, by what name and where.

use super::*;

fn one(line: &str) -> String {
    faults(&format!("{line}\n")).remove(0)
}

#[test]
fn what_is_computed_and_has_no_meaning() {
    let refused = |line: &str, code: &str, what: &str, at: &str| {
        assert_eq!(one(line), format!("NotSupported {{ code: '{code}', what: {what} }} at '{at}'"));
    };
    for (line, word) in [("IF R1==1", "IF"), ("LOOP", "LOOP"), ("WHILE R1<2", "WHILE"), ("REPEAT", "REPEAT")]
    {
        refused(line, word, "Flow(Unclosed)", line);
    }
    refused("FOR R1=1 TO 5", "FOR", "Flow(Unclosed)", "FOR R1=1 TO 5");
    for line in ["ENDIF", "ENDLOOP", "ENDFOR", "ENDWHILE"] {
        refused(line, line, "Flow(EndOfNothing)", line);
    }
    refused("UNTIL R1>2", "UNTIL", "Flow(EndOfNothing)", "UNTIL R1>2");
    refused("ELSE", "ELSE", "Flow(ElseAlone)", "ELSE");
    refused("DEF REAL A_B=5", "DEF", "Value(DefLate)", "DEF REAL A_B=5");
    refused("/DEF REAL A_B", "DEF", "Value(DefSkipped)", "/DEF REAL A_B");
    refused("DEFINE A_B AS M8", "DEFINE", "Code(Macro)", "DEFINE A_B AS M8");
    refused("REDEF X", "REDEF", "Code(DefinedAnew)", "REDEF X");
    refused("F=_FEED", "_FEED", "Value(Undefined)", "_FEED");
    refused("COUNT=5", "COUNT", "Value(Undefined)", "COUNT");
    refused("R1=\"A\"", "'A'", "Value(Text)", "'A'");
    refused("R1='A'", "'A'", "Value(CharacterValue)", "'A'");
    refused("R1=AXNAME(1)", "AXNAME", "Value(UnknownFunction)", "AXNAME(1)");
    refused("R1=SIN(1,2)", "SIN(1,2)", "Value(FunctionArguments)", "SIN(1,2)");
    refused("R1=X", "X", "Value(Address)", "X");
    refused("R1=$MA_JOG[X]", "$MA_JOG[X]", "Value(Control)", "$MA_JOG[X]");
    refused("R1=5 X=R1", "R1=5 X=R1", "Value(ReadsOwn)", "R1=5 X=R1");
    refused("X=R[2] R[R1]=5", "X=R[2] R[R1]=5", "Value(ReadsOwn)", "X=R[2] R[R1]=5");
    refused("G=R1", "G=R1", "Code(Computed)", "G=R1");
    refused("D=R1", "D=R1", "Code(ComputedWord)", "D=R1");
    refused("A=DC(R1)", "A=DC(R1)", "Code(ComputedTurn)", "A=DC(R1)");
    assert_eq!(one("GOTOF N20"), "LabelUnknown { name: 'N20' } at 'GOTOF N20'");
    refused("GOTOF \"A\"<<R1", "'A'<<R1", "Flow(Computed)", "'A'<<R1");
    refused("$P_UIFR[1]=5", "$P_UIFR", "Value(ControlSet)", "$P_UIFR[1]=5");
    refused("SETAL(R1)", "SETAL", "Code(Named { name: 'alarm' })", "SETAL(R1)");
    refused("SETAL(62000)", "SETAL", "Text(AlarmEnd)", "SETAL(62000)");
    refused("MSG(\"A\"<<(R1==1))", "(R1==1)", "Text(TruthValue)", "(R1==1)");
    let alone = "Call(SubAlone)";
    refused("PROC A_B(VAR REAL C_D)", "PROC", alone, "C_D");
    refused("PROC A_B(REAL C_D=5)", "PROC", alone, "C_D");
    assert_eq!(one("R1000=5"), "OutOfRange { word: Word('R1000') } at 'R1000'");
    assert_eq!(faults("X=(5)\n"), [] as [&str; 0]);
}

#[test]
fn words_that_are_known_and_not_translated() {
    let refused = |line: &str, code: &str, what: &str, at: &str| {
        assert_eq!(one(line), format!("NotSupported {{ code: '{code}', what: {what} }} at '{at}'"));
    };
    refused("G147 X1", "G147", "Code(Named { name: 'soft approach' })", "G147");
    refused("G1 X1 FRC=2", "FRC", "Code(Named { name: 'feed of a chamfer or rounding' })", "FRC=2");
    refused("G1 RP=IC(5)", "RP=IC(5)", "Polar(RadiusIncrement)", "RP=IC(5)");
    refused("X1=5", "X1", "Code(AxisByNumber)", "X1=5");
    refused("S2=500", "S2", "Code(SpindleByNumber)", "S2=500");
    refused("T=\"\"", "T=''", "Table(ToolName)", "T=''");
    refused("F=\"FAST\"", "F='FAST'", "Value(Name)", "F='FAST'");
    refused("SETMS(2)", "SETMS(2)", "Spindle(MasterSpindle)", "SETMS(2)");
    refused("CYCLE832(0.01,112001)", "CYCLE832", "Code(ToleranceCoding)", "CYCLE832(0.01,112001)");
    refused("CYCLE832(0.01,1,0.5)", "CYCLE832", "Code(Tolerance)", "CYCLE832(0.01,1,0.5)");
    refused("S=QU(7)", "S=QU(7)", "Code(QuickFunction)", "S=QU(7)");
    refused("H5", "H5", "Code(Named { name: 'auxiliary function' })", "H5");
    refused("FA[X]=100", "FA", "Code(Named { name: 'feed of an axis' })", "FA[X]=100");
    refused("SPOSA=90", "SPOSA", "Code(Named { name: 'spindle positioning' })", "SPOSA=90");
    assert_eq!(faults("SPOS=90\n"), [] as [&str; 0]);
    refused("TRAORI(2)", "TRAORI", "Frame(TransformationParameters)", "TRAORI(2)");
    refused("TRACYL(40)", "TRACYL", "Code(Named { name: 'transformation of axes' })", "TRACYL(40)");
    refused("ID=1 WHEN $A DO M8", "ID=1 WHEN $A DO M8", "Code(SynchronisedAction)", "ID=1 WHEN $A DO M8");
    refused(
        "EXTCALL R1",
        "EXTCALL",
        "Code(Named { name: 'call of a program from another memory, not by a text' })",
        "EXTCALL R1",
    );
    refused("PCALL /_N_X/NAME", "PCALL", "Code(Named { name: 'call by path' })", "PCALL /_N_X/NAME");
    refused("CALL \"/A/B\"", "CALL", "Call(ByPath)", "CALL '/A/B'");
    refused("PROC A_B SAVE", "SAVE", "Call(Attribute)", "SAVE");
    refused("MSG(\"a\",1)", "MSG", "Text(BlendedMessage)", "MSG('a',1)");
    refused("T=AC(5)", "T=AC(5)", "Code(DistanceOfOtherWord)", "T=AC(5)");
}

#[test]
fn words_that_are_none() {
    assert_eq!(one("G199"), "UnknownCode { code: 'G199' } at 'G199'");
    assert_eq!(one("M16"), "UnknownCode { code: 'M16' } at 'M16'");
    assert_eq!(one("Q5"), "UnknownCode { code: 'Q5' } at 'Q5'");
    assert_eq!(one("G0 BANANA X5"), "NotSupported { code: 'BANANA', what: Call(BesideWords) } at 'BANANA'");
    assert_eq!(one("FOO BAR"), "UnknownCode { code: 'BAR' } at 'BAR'");
    assert_eq!(one("X1 X2"), "WordTwice { letter: 'X' } at 'X2'");
    assert_eq!(one("G0 G1 X1"), "CodesExclude { first: 'G0', second: 'G1' } at 'G1'");
    assert_eq!(one("SUPA G53 X1"), "CodesExclude { first: 'SUPA', second: 'G53' } at 'G53'");
    assert_eq!(one("M3 M8 M9 M1 M0 M5"), "TooManyCodes { letter: 'M', limit: 5 } at 'M5'");
    assert_eq!(one("D10"), "OutOfRange { word: Word('D10') } at 'D10'");
    assert_eq!(one("T5.5"), "PointNotAllowed { word: 'T5.5' } at 'T5.5'");
    assert_eq!(one("F-5"), "OutOfRange { word: Word('F-5') } at 'F-5'");
    assert_eq!(one("G1."), "PointNotAllowed { word: 'G1.' } at 'G1.'");
    assert_eq!(one("X12345678901"), "OutOfRange { word: Word('X12345678901') } at 'X12345678901'");
    assert_eq!(one("CR X5"), "WordMissing { code: 'CR', word: '=' } at 'CR'");
    assert_eq!(one("L1.5"), "OutOfRange { word: Word('L1.5') } at 'L1.5'");
    assert_eq!(one("L1 P0"), "OutOfRange { word: Word('L1 P0') } at 'L1 P0'");
    assert_eq!(one("L1 X5"), "NotSupported { code: 'L1', what: Call(BesideWords) } at 'L1'");
    assert_eq!(diagnostics(&read("M6\nM30\n"), b"M6\nM30\n"), ["NoToolSelected at 'M6'"]);
}

#[test]
fn the_letter_o_for_a_zero() {
    let letter = |line: &str| assert_eq!(one(line), "LetterOForZero at 'O'", "{line}");
    letter("GO X5");
    letter("GOX-15.Y0.");
    letter("X1O");
    letter("N10 G1 X1O.5 Y2");
    assert_eq!(after_head("TOOL\nFOO\nDROP1\n"), ["CALL TOOL x1", "CALL FOO x1", "CALL DROP1 x1"]);
}

#[test]
fn a_fault_of_form_costs_one_block() {
    assert_eq!(faults("X5 (A)\nX1 ]\nX2\n").len(), 2);
    let text = HEAD.to_owned() + "X1 ]\nX2\nM30\n";
    assert!(stmts(&read(&text)).contains(&"TRAVERSE X2".to_owned()));
}

#[test]
fn texts_that_are_none() {
    let bare = |text: &[u8]| diagnostics(&read_with(settings(), true, text), text);
    assert_eq!(bare(b"G0\nX\x001\nY5 ]\n"), ["NotText at '\\0'"]);
    assert_eq!(bare(b"\xEF\xBB\xBFG90\r\nM30\r\n"), [] as [&str; 0]);
    assert_eq!(bare(b""), ["EmptyProgram at ''"]);
    let long = format!("G90 ;{}\nM30\n", "x".repeat(600));
    assert!(bare(long.as_bytes())[0].starts_with("BlockTooLong { limit: 512 }"));
    let noise = "\u{1}\n".repeat(40);
    let all = bare(noise.as_bytes());
    assert_eq!(all.len(), 17);
    assert!(all[16].starts_with("NotText"));
}
