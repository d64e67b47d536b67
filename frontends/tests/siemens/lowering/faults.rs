//! What is refused, by what name and where.

use super::*;

fn one(line: &str) -> String {
    faults(&format!("{line}\n")).remove(0)
}

#[test]
fn variables_and_control() {
    for line in [
        "IF R1==1",
        "ELSE",
        "ENDIF",
        "LOOP",
        "ENDLOOP",
        "FOR R1=1 TO 5",
        "ENDFOR",
        "WHILE R1<2",
        "ENDWHILE",
        "REPEAT",
        "UNTIL R1>2",
        "CASE R1 OF 1 GOTOF A_A",
        "DEF REAL A_B=5",
        "DEFINE A_B AS M8",
        "REDEF X",
    ] {
        assert_eq!(one(line), format!("MacroLanguage {{ what: '{line}' }} at '{line}'"));
    }
    let at = |line: &str, what: &str| {
        assert_eq!(one(line), format!("MacroLanguage {{ what: '{what}' }} at '{what}'"))
    };
    at("R1=5", "R1=5");
    at("X=R1", "X=R1");
    at("X=(5)", "X=(5)");
    at("F=_FEED", "F=_FEED");
    at("COUNT=5", "COUNT=5");
    at("$P_UIFR[1]=5", "$P_UIFR[1]=5");
    at("GOTOF N20", "GOTOF N20");
    at("IF R1==1 GOTOB A_A", "IF R1==1 GOTOB A_A");
    at("MSG(\"a\"<<R1)", "MSG(\"a\"<<R1)".replace('"', "'").as_str());
    at("PROC A_B(REAL C_D)", "PROC A_B(REAL C_D)");
}

#[test]
fn words_that_are_known_and_not_translated() {
    let refused = |line: &str, code: &str, name: &str, at: &str| {
        assert_eq!(one(line), format!("NotSupported {{ code: '{code}', name: '{name}' }} at '{at}'"));
    };
    refused("G147 X1", "G147", "soft approach", "G147");
    refused("G1 X1 FRC=2", "FRC", "feed of a chamfer or rounding", "FRC=2");
    refused("G1 RP=IC(5)", "RP=IC(5)", "increment of a polar radius", "RP=IC(5)");
    refused("X1=5", "X1", "axis by its number", "X1=5");
    refused("S2=500", "S2", "spindle by its number", "S2=500");
    refused("T=\"\"", "T=''", "tool of this name", "T=''");
    refused("F=\"FAST\"", "F='FAST'", "name as a value", "F='FAST'");
    refused("SETMS(2)", "SETMS(2)", "another master spindle", "SETMS(2)");
    refused(
        "CYCLE832(0.01,112001)",
        "CYCLE832",
        "tolerance of the path in another coding",
        "CYCLE832(0.01,112001)",
    );
    refused("CYCLE832(0.01,1,0.5)", "CYCLE832", "tolerance of the orientation", "CYCLE832(0.01,1,0.5)");
    refused("M=QU(7)", "M=QU(7)", "auxiliary function that is not waited for", "M=QU(7)");
    refused("H5", "H5", "auxiliary function", "H5");
    refused("FA[X]=100", "FA", "feed of an axis", "FA[X]=100");
    refused("SPOSA=90", "SPOSA", "spindle positioning", "SPOSA=90");
    assert_eq!(faults("SPOS=90\n"), [] as [&str; 0]);
    refused("TRAORI(2)", "TRAORI", "transformation with parameters", "TRAORI(2)");
    refused("TRACYL(40)", "TRACYL", "transformation of axes", "TRACYL(40)");
    refused("ID=1 WHEN $A DO M8", "ID=1 WHEN $A DO M8", "synchronised action", "ID=1 WHEN $A DO M8");
    refused("NAME(1,2)", "NAME", "call with arguments", "NAME(1,2)");
    refused("EXTCALL \"A\"", "EXTCALL", "call by path", "EXTCALL 'A'");
    refused("PCALL /_N_X/NAME", "PCALL", "call by path", "PCALL /_N_X/NAME");
    refused("CALL \"/A/B\"", "CALL", "call by path", "CALL '/A/B'");
    refused("PROC A_B SAVE", "SAVE", "attribute of a subprogram", "SAVE");
    refused("MSG(\"a\",1)", "MSG", "message in continuous-path mode", "MSG('a',1)");
    refused("T=AC(5)", "T=AC(5)", "AC or IC of a word that is no coordinate", "T=AC(5)");
}

#[test]
fn words_that_are_none() {
    assert_eq!(one("G199"), "UnknownCode { code: 'G199' } at 'G199'");
    assert_eq!(one("M16"), "UnknownCode { code: 'M16' } at 'M16'");
    assert_eq!(one("Q5"), "UnknownCode { code: 'Q5' } at 'Q5'");
    assert_eq!(
        one("G0 BANANA X5"),
        "NotSupported { code: 'BANANA', name: 'call beside other words' } at 'BANANA'"
    );
    assert_eq!(one("FOO BAR"), "UnknownCode { code: 'BAR' } at 'BAR'");
    assert_eq!(one("X1 X2"), "WordTwice { letter: 'X' } at 'X2'");
    assert_eq!(one("G0 G1 X1"), "CodesExclude { first: 'G0', second: 'G1' } at 'G1'");
    assert_eq!(one("SUPA G53 X1"), "CodesExclude { first: 'SUPA', second: 'G53' } at 'G53'");
    assert_eq!(one("M3 M8 M9 M1 M0 M5"), "TooManyCodes { letter: 'M', limit: 5 } at 'M5'");
    assert_eq!(one("D10"), "OutOfRange { word: 'D10' } at 'D10'");
    assert_eq!(one("T5.5"), "PointNotAllowed { word: 'T5.5' } at 'T5.5'");
    assert_eq!(one("F-5"), "OutOfRange { word: 'F-5' } at 'F-5'");
    assert_eq!(one("G1."), "PointNotAllowed { word: 'G1.' } at 'G1.'");
    assert_eq!(one("X12345678901"), "OutOfRange { word: 'X12345678901' } at 'X12345678901'");
    assert_eq!(one("CR X5"), "WordMissing { code: 'CR', word: '=' } at 'CR'");
    assert_eq!(one("L1.5"), "OutOfRange { word: 'L1.5' } at 'L1.5'");
    assert_eq!(one("L1 P0"), "OutOfRange { word: 'L1 P0' } at 'L1 P0'");
    assert_eq!(one("L1 X5"), "NotSupported { code: 'L1', name: 'call beside other words' } at 'L1'");
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
