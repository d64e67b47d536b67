//! Where readers of this language go wrong, each as one line: as far as form decides it. What
//! depends on the meaning is for the tests of the lowering.

use super::*;

#[test]
fn words_that_look_alike() {
    check(&[
        // An axis with a number, and an axis at a position.
        ("X1=5", "X1 = 5"),
        ("X1", "X1"),
        ("X1 = 5 Y1", "X1 = 5 | Y1"),
        // Three different subprograms.
        ("L10", "L10"),
        ("L010", "L010"),
        ("L0010", "L0010"),
        ("Z-.4", "Z-0.4"),
        ("G4F1", "G4 | F1"),
        ("G01Z-5F100M8", "G1 | Z-5 | F100 | M8"),
        ("N10G1X10Y20F100", "N10 | G1 | X10 | Y20 | F100"),
        ("N10G0G54X-10Y.20B0T100S400.0M3", "N10 | G0 | G54 | X-10 | Y0.20 | B0 | T100 | S400.0 | M3"),
        ("N10REPEAT LBL", "N10 | REPEAT from LBL"),
        ("M1=3", "M1 = 3"),
        ("M1=DIR S1=VELO", "M1 = DIR | S1 = VELO"),
        ("G4 S5", "G4 | S5"),
        ("G4 S2=10", "G4 | S2 = 10"),
        ("CR= 5", "CR = 5"),
        ("CR =-5", "CR = -5"),
        ("G2 X1 Y1 CR=-3.5", "G2 | X1 | Y1 | CR = -3.5"),
        ("F=_V S=R5", "F = _V | S = R5"),
        ("G58 X5", "G58 | X5"),
        ("G2 X0 Y0 I5 J0 TURN=3", "G2 | X0 | Y0 | I5 | J0 | TURN = 3"),
        ("G3 I=AC(0) J=AC(92.07)", "G3 | I = Absolute 0 | J = Absolute 92.07"),
        ("G3 AP=90", "G3 | AP = 90"),
        ("SUPA Z=_Z_HOME D0", "SUPA | Z = _Z_HOME | D0"),
        ("X1E5", "X1 | E5"),
        ("E_MULTI=2", "E_MULTI = 2"),
    ]);
}

#[test]
fn labels() {
    check(&[
        ("N_A:", "N_A:"),
        ("NEXT: G1 X5", "NEXT: | G1 | X5"),
        ("N10 NEXT:X5", "N10 | NEXT: | X5"),
        ("AA:", "AA:"),
        ("A:", "Syntax { found: Text(':'), expected: Number } at ':'"),
        ("A1: X5", "Syntax { found: Text(':'), expected: Word } at ':'"),
        ("GOTOF \"LAB\"<<R1", "Forward (\"LAB\" Join R1)"),
    ]);
}

#[test]
fn texts_and_comments() {
    check(&[
        ("MSG(\"A; B\") ; C", "MSG(\"A; B\") | ; C"),
        ("MSG(\"X=\"<<R1<<\" Y\")", "MSG(((\"X=\" Join R1) Join \" Y\"))"),
        ("T=\"DRILL 8.5\" M6", "T = \"DRILL 8.5\" | M6"),
        ("T=\"em10\" D1", "T = \"em10\" | D1"),
        ("IF R1==1 ; (no) \"text", "IF (R1 Equal 1) | ; (no) \"text"),
        ("G1 X5 ;", "G1 | X5 | ;"),
        ("(NOTE)", "Syntax { found: Text('('), expected: Block } at '('"),
    ]);
    // Comments and texts in whatever coding.
    assert_eq!(read(b"X5 ;\xB4\xFA\xC2\xEB \xE9"), read("X5 ;\u{fffd}\u{fffd}\u{fffd}\u{fffd} \u{fffd}"));
    assert_eq!(read("MSG(\"Größe\") ;Ø"), "MSG(\"Größe\") | ;Ø");
    assert!(read(b"MSG(\"\xB4\xFA;\xC2\") X5").ends_with("\") | X5"));
}

#[test]
fn repetitions() {
    check(&[
        ("REPEAT AA P=3", "REPEAT from AA P=3"),
        ("REPEAT", "REPEAT"),
        ("REPEAT ;body", "REPEAT | ;body"),
        ("UNTIL R1>3", "UNTIL (R1 Greater 3)"),
        ("L12 P3", "L12 | P3"),
    ]);
}

#[test]
fn several_in_a_block() {
    check(&[
        ("IF R1==1 GOTOF AA IF R1==2 GOTOB BB", "IF (R1 Equal 1) Forward AA | IF (R1 Equal 2) Backward BB"),
        ("R1=R1+1 R2=5", "R1 = (R1 Add 1) | R2 = 5"),
        ("N40 R0=0 R1=0+R102 R2=111.2+R104", "N40 | R0 = 0 | R1 = (0 Add R102) | R2 = (111.2 Add R104)"),
        ("_X=0 _Y=-1", "_X = 0 | _Y = -1"),
        ("_XX=0 _YY=-1", "_XX = 0 | _YY = -1"),
        ("M3 S=_RPM", "M3 | S = _RPM"),
    ]);
}

#[test]
fn cycles() {
    check(&[
        ("CYCLE81(10,0,2,,15)", "CYCLE81(10, 0, 2, _, 15)"),
        ("CYCLE81(10, 0, 2, -5, ) ", "CYCLE81(10, 0, 2, -5, _)"),
        ("HOLES2(0,0,18,90,0,12)", "HOLES2(0, 0, 18, 90, 0, 12)"),
        ("N10 MCALL CYCLE81(AA+20,AA,2,,BB+3.2)", "N10 | MCALL CYCLE81((AA Add 20), AA, 2, _, (BB Add 3.2))"),
        ("TC(5,\"M1\",0)", "TC(5, \"M1\", 0)"),
        ("L6", "L6"),
        ("/N1030 M90", "/0 | N1030 | M90"),
        ("/ M90", "/0 | M90"),
        ("/2 X5", "/2 | X5"),
    ]);
}
