//! Every fault of the text and of single words, at its place.

use super::*;

#[test]
fn signs_that_are_no_words() {
    assert_eq!(faults("fanuc", "X1. $ Y2.\n"), ["UnexpectedCharacter { found: '$' } at '$'"]);
    assert_eq!(faults("mach9", "X1. (NOTE)\n"), ["UnexpectedCharacter { found: '(' } at '('"]);
    assert_eq!(faults("fanuc", "X1. é\n"), ["UnexpectedCharacter { found: 'é' } at 'é'"]);
    assert_eq!(faults("mach9", "X[1]\n"), ["UnexpectedCharacter { found: '[' } at '['"]);
    assert_eq!(faults("fanuc", "X1.\rY2.\n"), ["UnexpectedCharacter { found: '\\r' } at '\\r'"]);
    let text = [head("mach9").as_bytes(), b"X1.\xC7\n"].concat();
    let out = read_with(settings("mach9"), true, &text);
    assert!(format!("{:?}", out.diagnostics).contains("found: 'Ç'"));
}

#[test]
fn numbers_that_are_none() {
    assert_eq!(
        faults("fanuc", "X1234567890123456789.\n"),
        ["BadNumber { text: '1234567890123456789.' } at '1234567890123456789.'"]
    );
    assert_eq!(faults("fanuc", "X.\n"), ["UnexpectedCharacter { found: '.' } at '.'"]);
    assert_eq!(faults("fanuc", "X1.2.3\n"), ["Syntax { found: Text('.3'), expected: Word } at '.3'"]);
    assert_eq!(faults("fanuc", "X1 2\n"), ["Syntax { found: Text('2'), expected: Word } at '2'"]);
    assert_eq!(faults("fanuc", "X--1.\n"), ["Syntax { found: Text('-'), expected: Number } at '-'"]);
    assert_eq!(faults("fanuc", "5 X1.\n"), ["Syntax { found: Text('5'), expected: Word } at '5'"]);
    assert_eq!(
        faults("fanuc", "X99999999999.\n"),
        ["OutOfRange { word: Word('X99999999999.') } at 'X99999999999.'"]
    );
    assert_eq!(
        faults("fanuc", "X1.0000000001\n"),
        ["OutOfRange { word: Word('X1.0000000001') } at 'X1.0000000001'"]
    );
}

#[test]
fn comments_that_do_not_end() {
    assert_eq!(faults("fanuc", "X1. (NOTE\nX2.\n"), ["UnclosedComment at '(NOTE'"]);
}

#[test]
fn long_blocks() {
    let long = "X1.".to_owned() + &" ".repeat(5000) + "\n";
    let found = faults("fanuc", &long);
    assert!(found.len() == 1 && found[0].starts_with("BlockTooLong { limit: 4096 } at 'X1."), "{found:?}");
    let mut reader = Reader::new(settings("fanuc"), true);
    let mut out = Batch::default();
    reader.too_long(ncc_ir::source::Span::new(5, 9000), &mut out);
    reader.finish(&mut out);
    assert_eq!(format!("{:?}", out.diagnostics[0].fault), "BlockTooLong { limit: 4096 }");
    assert_eq!((out.diagnostics.len(), out.diagnostics[0].span.start), (1, 5));
}

#[test]
fn the_letter_o_for_a_zero() {
    for id in ["mach9", "fanuc"] {
        assert_eq!(faults(id, "GOX-15.\n"), ["LetterOForZero at 'O'"], "{id}");
        assert_eq!(faults(id, "GZO\n"), ["LetterOForZero at 'O'"], "{id}");
        assert_eq!(faults(id, "G0X1O\n"), ["LetterOForZero at 'O'"], "{id}");
        assert_eq!(faults(id, "G0X1.Y3O.\n"), ["LetterOForZero at 'O'"], "{id}");
    }
    // A word of a language is no number.
    assert!(!faults("haas", "COVER PLATE\n").iter().any(|fault| fault.starts_with("LetterOForZero")));
    assert_eq!(faults("mach9", "GO1X5.\n"), ["LetterOForZero at 'O'"]);
    assert_eq!(after_head("mach9", "O2M5\n"), ["LENGTH 2", "& StopSpindleTurning"]);
    assert_eq!(after_head("mach9", "G0Z1.O3\n"), ["LENGTH 3", "& TRAVERSE! Z1."]);
}

#[test]
fn codes_that_are_refused() {
    assert_eq!(faults("fanuc", "G123 X1.\n"), ["UnknownCode { code: 'G123' } at 'G123'"]);
    assert_eq!(faults("fanuc", "G54.12\n"), ["UnknownCode { code: 'G54.12' } at 'G54.12'"]);
    assert_eq!(faults("fanuc", "M77\n"), ["UnknownCode { code: 'M77' } at 'M77'"]);
    assert_eq!(faults("fanuc", "U5.\n"), ["UnknownCode { code: 'U5.' } at 'U5.'"]);
    assert_eq!(
        faults("fanuc", "G12.1\n"),
        ["NotSupported { code: 'G12.1', what: Code(Named { name: 'polar interpolation' }) } at 'G12.1'"]
    );
    assert_eq!(
        faults("fanuc", "G41 D1 X1. G12.1\n"),
        ["NotSupported { code: 'G12.1', what: Code(Named { name: 'polar interpolation' }) } at 'G12.1'"]
    );
    assert_eq!(
        faults("fanuc", "G1 X5. ,A45.\n"),
        ["NotSupported { code: ',A45.', what: Move(CommaAngle) } at ',A45.'"]
    );
    assert_eq!(faults("fanuc", "G0 X5. ,R2.\n"), ["WordUnused { word: ',R2.' } at ',R2.'"]);
    assert_eq!(
        faults("haas", "M98 <PART>\n"),
        ["NotSupported { code: '<PART>', what: Text(ProgramName) } at '<PART>'"]
    );
    assert_eq!(
        faults("fanuc", "M98 P<PART>\n"),
        ["NotSupported { code: 'P<PART>', what: Text(ProgramName) } at 'P<PART>'"]
    );
}

#[test]
fn codes_that_do_not_stand_together() {
    assert_eq!(
        faults("fanuc", "G1 F9. X5. ,C2. ,R1.\n"),
        ["CodesExclude { first: ',C2.', second: ',R1.' } at ',R1.'"]
    );
    assert_eq!(faults("fanuc", "G1 F9. X5. ,C0.\n"), ["OutOfRange { word: Word(',C0.') } at ',C0.'"]);
    assert_eq!(faults("fanuc", "G0 G1 X1.\n"), ["CodesExclude { first: 'G0', second: 'G1' } at 'G1'"]);
    assert_eq!(faults("mach9", "G90G0X1.\n"), ["TooManyCodes { letter: 'G', limit: 1 } at 'G0'"]);
    assert_eq!(faults("fanuc", "M3 M8\n"), ["TooManyCodes { letter: 'M', limit: 1 } at 'M8'"]);
}

#[test]
fn words_that_are_too_many_or_too_few() {
    assert_eq!(faults("fanuc", "G0 X1. X2.\n"), ["WordTwice { letter: 'X' } at 'X2.'"]);
    assert_eq!(faults("fanuc", "N1 N2 X1.\n"), ["WordTwice { letter: 'N' } at 'N2'"]);
    assert_eq!(
        faults("fanuc", "G0 X1. R2. H3\n"),
        ["WordUnused { word: 'H3' } at 'H3'", "WordUnused { word: 'R2.' } at 'R2.'"]
    );
    assert_eq!(
        faults("mach9", "G0X60.Q10.\n"),
        ["NotSupported { code: 'Q10.', what: Code(Named { name: 'corner rounding or chamfer' }) } at 'Q10.'"]
    );
    assert_eq!(faults("mach9", "H90E240\n").len(), 2);
    assert_eq!(faults("mach9", "H90E240L25\n"), ["LabelUnknown { name: 'N90' } at 'H90'"]);
}

#[test]
fn numbers_of_the_wrong_kind() {
    // It can mean nothing else.
    assert_eq!(faults("fanuc", "S1000.\n"), Vec::<String>::new());
    assert_eq!(faults("fanuc", "S1000.5\n"), ["PointNotAllowed { word: 'S1000.5' } at 'S1000.5'"]);
    assert_eq!(faults("fanuc", "M3.\n"), ["PointNotAllowed { word: 'M3.' } at 'M3.'"]);
    assert_eq!(faults("fanuc", "T1.\n"), ["PointNotAllowed { word: 'T1.' } at 'T1.'"]);
    assert_eq!(faults("fanuc", "N1. X1.\n"), ["PointNotAllowed { word: 'N1.' } at 'N1.'"]);
    assert_eq!(faults("fanuc", "F-5.\n"), ["OutOfRange { word: Word('F-5.') } at 'F-5.'"]);
    assert_eq!(faults("mach9", "T-1M6\n"), ["OutOfRange { word: Word('T-1') } at 'T-1'"]);
}

#[test]
fn the_macro_language_is_refused_by_name() {
    let refused = |piece: &str, what: &str| {
        assert_eq!(
            faults("fanuc", piece),
            [format!("MacroLanguage {{ what: '{what}' }} at '{what}'")],
            "{piece}"
        );
    };
    refused("G0 X##1\n", "##1");
    refused("X[#1.]\n", "#1.");
    let told = "NotSupported { code: 'G#1', what: Code(AnyNumber) } at 'G#1'";
    assert_eq!(faults("fanuc", "G#1\n"), [told]);
    refused("M[#1+3]\n", "M[#1+3]");
    refused("G51 X0 Y0 Z0 P#1\n", "P#1");
    refused("X[#1 EQ 2]\n", "X[#1 EQ 2]");
    refused("F[ROUND[#1]]\n", "F[ROUND[#1]]");
    refused("BPRNT[X#100[3]]\n", "BPRNT[X#100[3]]");
    // A line for a device does not matter to the cut.
    for piece in ["DPRNT[X#100*Y]", "DPRNT[X#100[00]]", "DPRNT[X#[#1][53]]", "DPRNT[X.]"] {
        assert_eq!(faults("fanuc", &format!("{piece}\n")), [format!("OutputDropped at '{piece}'")]);
    }
    refused("#0=5\n", "#0=5");
    refused("#1=#[_DATE]\n", "_DATE");
    refused("#1=BCD[2]\n", "BCD[2]");
    refused("#1=2*ATAN[3]\n", "ATAN[3]");
    refused("#1=BIN[#2]+1\n", "BIN[#2]");
    refused("#1=#[#2 EQ 1]\n", "#[#2 EQ 1]");
    refused("#[#1 EQ 2]=3\n", "#[#1 EQ 2]=3");
    refused("#1=[#2 EQ 7]\n", "#1=[#2 EQ 7]");
    refused("#1=[#2 EQ 7]+1\n", "[#2 EQ 7]+1");
    refused("IF[#1]GOTO5\n", "IF[#1]");
    refused("IF[[#1 EQ 1] AND #2]GOTO5\n", "[#1 EQ 1] AND #2");
    refused("IF[#1 EQ 1]#2=3\n", "IF[#1 EQ 1]#2=3");
    refused("IF[#1 EQ 1]THEN X5.\n", "IF[#1 EQ 1]THEN");
    refused("WHILE[#1 EQ 1]\n", "WHILE[#1 EQ 1]");
    refused("X5. #1=5\n", "#1=5");
    refused("N1 #29=1 GOTO10\n", "#29=1 GOTO10");
    refused("#1=2 #2=3\n", "#1=2 #2=3");
    refused("G65 P9000 A[ROUND[#1]]\n", "A[ROUND[#1]]");
    // Where the language is that of O words, a value is no sum without brackets, and nothing of this one.
    assert_eq!(faults("linuxcnc", "G0 X[#1+2]\n"), [""; 0]);
    for piece in ["#1=#2 AND 7\n", "#1=#2+1\n", "IF [#1 EQ 1] GOTO 5\n", "WHILE [#1 LT 5] DO1\n", "G0 X#0\n"]
    {
        assert_eq!(faults("linuxcnc", piece).len(), 1, "{piece}");
    }
    assert_eq!(
        faults("fanuc", "G66 P9000 A1.\nG66 P9001\n")[0],
        "NotSupported { code: 'G66', what: Call(ModalInModal) } at 'G66'"
    );
}

#[test]
fn loops_and_macro_calls_that_are_none() {
    let one = |piece: &str, wanted: &str| assert_eq!(faults("fanuc", piece), [wanted], "{piece}");
    one("END1\n", "NotSupported { code: 'END1', what: Flow(EndOfNoLoop) } at 'END1'");
    one("DO 2\nX1.\n", "NotSupported { code: 'DO2', what: Flow(LoopUnclosed) } at 'DO 2'");
    one("DO4\nEND4\n", "NotSupported { code: 'DO4', what: Flow(LoopNumber) } at 'DO4'");
    one("DO1\nDO1\nEND1\nEND1\n", "NotSupported { code: 'DO1', what: Flow(LoopTwice) } at 'DO1'");
    let crossing = "WHILE[#1 LT 5]DO1\nDO2\nEND1\nEND2\n";
    let wanted = "NotSupported { code: 'END1', what: Flow(EndOfOther { own: 2 }) } at 'END1'";
    assert_eq!(faults("fanuc", crossing)[0], wanted);
    one(
        "/WHILE[#1 LT 5]DO1\nX1.\nEND1\n",
        "NotSupported { code: 'END1', what: Flow(LoopSkipped) } at 'END1'",
    );
    // A head that is refused is one slip.
    one("WHILE[BIN[#1] LT 5]DO1\nX1.\nEND1\n", "MacroLanguage { what: 'BIN[#1]' } at 'BIN[#1]'");
    one("G65 A1.\n", "WordMissing { code: 'G65', word: 'P' } at 'G65'");
    one("G65 P9000 E5\n", "NotSupported { code: 'E5', what: Code(IncrementUnit) } at 'E5'");
    one("G65 P9000 X1. X2.\n", "WordTwice { letter: 'X' } at 'X2.'");
    one("G65 P9000 G1 X1.\n", "WordUnused { word: 'G1' } at 'G1'");
    one("G65 P9000 A\n", "WordWithoutNumber { letter: 'A' } at 'A'");
}

#[test]
fn expressions_that_are_none() {
    assert_eq!(faults("fanuc", "X[1+\n"), ["Syntax { found: EndOfBlock, expected: Number } at ''"]);
    assert_eq!(faults("fanuc", "X[1\n"), ["Syntax { found: EndOfBlock, expected: Text(']') } at ''"]);
    assert_eq!(faults("fanuc", "#1\n"), ["Syntax { found: EndOfBlock, expected: Text('=') } at ''"]);
}

#[test]
fn reading_goes_on_at_the_next_block() {
    let text = head("fanuc").to_owned() + "G1 X1. G41\nX$\nY2.\nM30\n";
    let out = read("fanuc", &text);
    assert_eq!(diagnostics(&out, &text).iter().filter(|d| !d.starts_with("Assumed")).count(), 2);
    // The refused block gives no statement; its motion counts.
    assert_eq!(stmts(&out).split_off(stmts(&out).len() - 2), ["FEED Y2.", "ProgramEnd"]);
}

#[test]
fn one_slip_is_reported_once() {
    let text = "G21 G90 G54\nG43 H1 G1 X0. Z1. F1O0\nX2.\nG88 X1. Z-5. R2.\nX3.\nM6\nM30\n";
    let found = diagnostics(&read("fanuc", text), text);
    let errors: Vec<_> = found.iter().filter(|d| !d.starts_with("Assumed")).collect();
    assert_eq!(errors.len(), 2, "{errors:?}");
}
