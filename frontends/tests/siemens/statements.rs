//! Every kind of statement.

use super::*;
use crate::siemens::text::unit::Line;

#[test]
fn heads_of_blocks() {
    check(&[
        ("", ""),
        ("  ", ""),
        ("N10", "N10"),
        (":120 G0", ":120 | G0"),
        ("/ N10 X5", "/0 | N10 | X5"),
        ("/N10 X5", "/0 | N10 | X5"),
        ("/7 N35", "/7 | N35"),
        ("/0N5X1", "/0 | N5 | X1"),
        ("N10 LBL: X5", "N10 | LBL: | X5"),
        ("N40 LA1: X=R3", "N40 | LA1: | X = R3"),
        ("LOOP_1 :", "LOOP_1:"),
        ("/3 N10 LBL: IF R1 ; why", "/3 | N10 | LBL: | IF R1 | ; why"),
        ("ENDLABEL:", "ENDLABEL:"),
        (" ;$PATH = 5", ";$PATH = 5"),
    ]);
}

#[test]
fn words() {
    check(&[
        ("G1 X12.345 Y-0.5 F100", "G1 | X12.345 | Y-0.5 | F100"),
        ("g1 x+5 y .5", "G1 | X5 | Y0.5"),
        ("X 10 F 100", "X10 | F100"),
        ("G1&X5", "G1 | X5"),
        ("X=R1 Y=-_POS", "X = R1 | Y = (Negate _POS)"),
        ("X = -.1EX-3", "X = -0.0001"),
        ("Z30.4EX-4B0", "Z0.00304 | B0"),
        ("G=R5 G=10", "G = R5 | G = 10"),
        ("S2=500 M2=3 T1=5 H3=1.5", "S2 = 500 | M2 = 3 | T1 = 5 | H3 = 1.5"),
        (
            "CR=5 AR=30 TURN=2 RPL=45 AP=30 RP=20",
            "CR = 5 | AR = 30 | TURN = 2 | RPL = 45 | AP = 30 | RP = 20",
        ),
        ("CIP X1 Y2 I1=3 J1=4 K1=R5", "CIP | X1 | Y2 | I1 = 3 | J1 = 4 | K1 = R5"),
        ("G1 RND=2 CHF=1 CHR=R3", "G1 | RND = 2 | CHF = 1 | CHR = R3"),
        ("FA[X]=100 POS[X1]=10 R[R1]=5", "FA[X] = 100 | POS[X1] = 10 | R[R1] = 5"),
        ("$TC_DP1[1,1]=120", "$TC_DP1[1, 1] = 120"),
        ("S[$A_DBB[1]] = 1000", "S[$A_DBB[1]] = 1000"),
        ("X=AC(5) Y=ic(-2) C=DC(90)", "X = Absolute 5 | Y = Incremental -2 | C = Direct 90"),
        ("A=ACP(R1) B=ACN(1) M=QU(7)", "A = Positive R1 | B = Negative 1 | M = Quick 7"),
        ("POS[X]=CAC(3)", "POS[X] = Coded 3"),
        ("AP=IC(90) RP=AC(5)", "AP = Incremental 90 | RP = Absolute 5"),
        ("PO[X]=(1,,R3)", "PO[X] = list(1, _, R3)"),
        ("X=(R1+1)*2 Y=(R1)", "X = (group (R1 Add 1) Multiply 2) | Y = group R1"),
        ("X=AC(1)Y=R1Z5", "X = Absolute 1 | Y = R1 | Z5"),
        ("POS[_AX]=10 AX[AXNAME(\"X\")]=R[R[1]]", "POS[_AX] = 10 | AX[AXNAME(\"X\")] = R[R[1]]"),
        ("PO[Y]=(,2)", "PO[Y] = list(_, 2)"),
        ("AX1=ABS(10) AX2=20", "AX1 = ABS(10) | AX2 = 20"),
        ("SPOS=ACP(90) SPOS[2]=0", "SPOS = Positive 90 | SPOS[2] = 0"),
        ("SUPA G0 Z=_Z D0", "SUPA | G0 | Z = _Z | D0"),
        ("TRANS X10 Y=R1", "TRANS | X10 | Y = R1"),
        ("ROT RPL=30", "ROT | RPL = 30"),
        ("G75 X1=0 Z1=0 FP=1", "G75 | X1 = 0 | Z1 = 0 | FP = 1"),
        (
            "N10 G3 G505 _VAR=10 X10 Y=ABS($AA_IM[X])",
            "N10 | G3 | G505 | _VAR = 10 | X10 | Y = ABS($AA_IM[X])",
        ),
    ]);
}

#[test]
fn calls() {
    check(&[
        ("POCKET_A", "POCKET_A"),
        ("POCKET_A P3", "POCKET_A | P3"),
        ("L123 P3", "L123 | P3"),
        ("L0123 P=R1", "L0123 | P = R1"),
        ("CYCLE81(10,0,2,,15)", "CYCLE81(10, 0, 2, _, 15)"),
        ("CYCLE800()", "CYCLE800()"),
        ("CYCLE81(,)", "CYCLE81(_, _)"),
        ("WORKPIECE(,\"\",,\"BOX\",112,Z0,-80)", "WORKPIECE(_, \"\", _, \"BOX\", 112, Z0, -80)"),
        ("MSG(\"X; \"<<R1<<\" mm\") ;done", "MSG(((\"X; \" Join R1) Join \" mm\")) | ;done"),
        ("MSG()", "MSG()"),
        ("MSG(\"A\",1)", "MSG(\"A\", 1)"),
        ("SETAL(65000)", "SETAL(65000)"),
        ("STOPRE", "STOPRE"),
        ("RET", "RET"),
        ("RET(\"LBL\",,2)", "RET(\"LBL\", _, 2)"),
        ("WRITE(ERR,\"F.MPF\",\"X\"<<R1)", "WRITE(ERR, \"F.MPF\", (\"X\" Join R1))"),
        ("SETINT(3) PRIO=1 LIFT_Z", "SETINT(3) | PRIO = 1 | LIFT_Z"),
        ("MCALL", "MCALL"),
        ("MCALL CYCLE82(5,0,2,-10,,0.5)", "MCALL CYCLE82(5, 0, 2, -10, _, 0.5)"),
        ("MCALL L070", "MCALL L070"),
        ("MCALL POCKET_A", "MCALL POCKET_A"),
        ("CALL \"/_N_SPF_DIR/_N_L1_SPF\"", "CALL \"/_N_SPF_DIR/_N_L1_SPF\""),
        ("CALL \"L\"<<ABS(R1)", "CALL (\"L\" Join ABS(R1))"),
        ("CALL _P BLOCK \"N100\" TO \"N\"<<50", "CALL _P BLOCK \"N100\" TO (\"N\" Join 50)"),
        ("CALL BLOCK N20 TO LBL", "CALL BLOCK N20 TO LBL"),
        (
            "CALL $P_A[_B] BLOCK $P_C[1] TO (\"N\"<<R1)",
            "CALL $P_A[_B] BLOCK $P_C[1] TO group (\"N\" Join R1)",
        ),
        ("PCALL /_N_WKS_DIR/_N_A_WPD/HOLE(1,,R2) ;x", "PCALL /_N_WKS_DIR/_N_A_WPD/HOLE(1, _, R2) | ;x"),
        ("PCALL HOLE", "PCALL HOLE()"),
        ("EXTCALL(\"BIG.SPF\")", "EXTCALL group \"BIG.SPF\""),
        ("EXTCALL \"BIG.SPF\"", "EXTCALL \"BIG.SPF\""),
        ("ISOCALL O_1000", "ISOCALL O_1000"),
    ]);
}

#[test]
fn definitions() {
    check(&[
        ("DEF REAL AA", "DEF Real AA"),
        ("DEF INT AA=1, BB , CC=-R3", "DEF Int AA = 1, BB, CC = (Negate R3)"),
        ("DEF REAL AA[10,3]=SET(0,,,9)", "DEF Real AA[10, 3] = SET(0, _, _, 9)"),
        ("DEF REAL AA[3]=(1,2,3)", "DEF Real AA[3] = list(1, 2, 3)"),
        ("DEF INT FELD[2,3,4] = REP(1,24)", "DEF Int FELD[2, 3, 4] = REP(1, 24)"),
        ("DEF STRING[28] AA = \"x;y\", BB", "DEF String[28] AA = \"x;y\", BB"),
        ("DEF BOOL AA=TRUE", "DEF Bool AA = TRUE"),
        ("DEF CHAR AA='X'", "DEF Char AA = 'X'"),
        ("DEF AXIS AA=X1", "DEF Axis AA = X1"),
        ("DEF FRAME AA=CTRANS(X,1):CROT(Z,2)", "DEF Frame AA = (CTRANS(X, 1) Chain CROT(Z, 2))"),
        ("DEF REAL R0=0", "DEF Real R0 = 0"),
        ("DEF NCK SYNR REAL PHU 14 LLI -5 GUD1=3.", "DEF NCK SYNR Real PHU=14 LLI=-5 GUD1 = 3."),
        ("REDEF $MN_X APR 3 ;c", "redefine <REDEF $MN_X APR 3> | ;c"),
        ("DEFINE DRILL AS G1 Z-5; deep", "DEFINE DRILL AS <G1 Z-5> | ; deep"),
        ("DEFINE M6 AS L6", "DEFINE M6 AS <L6>"),
        ("DEFINE NOTHING AS", "DEFINE NOTHING AS <>"),
        ("EXTERN SUB_A", "EXTERN SUB_A()"),
        (
            "EXTERN SUB_A(REAL, INT , VAR REAL[3],STRING[20])",
            "EXTERN SUB_A(Real, Int, VAR Real[3], String[20])",
        ),
        ("EXTERN L20()", "EXTERN L20()"),
        ("PROC SUB_A", "PROC SUB_A()"),
        ("PROC SUB_A SAVE DISPLOF", "PROC SUB_A() SAVE DISPLOF"),
        (
            "N1 PROC SUB_A(REAL A, INT BB=3, VAR REAL CC[,2]) SBLOF",
            "N1 | PROC SUB_A(Real A, Int BB = 3, VAR Real CC[_, 2]) SBLOF",
        ),
    ]);
}

#[test]
fn control() {
    check(&[
        ("IF (R1==1) AND NOT BB", "IF (group (R1 Equal 1) And (Not BB))"),
        ("ELSE", "ELSE"),
        ("ENDIF", "ENDIF"),
        ("LOOP", "LOOP"),
        ("ENDLOOP", "ENDLOOP"),
        ("FOR R10=1 TO 5*R2", "FOR R10 = 1 TO (5 Multiply R2)"),
        ("FOR m=0 TO 2", "FOR M = 0 TO 2"),
        ("FOR AA[1] = -1 TO BB", "FOR AA[1] = -1 TO BB"),
        ("ENDFOR", "ENDFOR"),
        ("WHILE R1<>5", "WHILE (R1 NotEqual 5)"),
        ("ENDWHILE", "ENDWHILE"),
        ("REPEAT", "REPEAT"),
        ("UNTIL $AA_IW[Z] > (H1-0.05)", "UNTIL ($AA_IW[Z] Greater group (H1 Subtract 0.05))"),
        ("REPEAT LBL", "REPEAT from LBL"),
        ("REPEAT LBL P=3", "REPEAT from LBL P=3"),
        ("REPEAT LBL P3", "REPEAT from LBL P=3"),
        ("REPEAT L_1 L_2 P = R1+1", "REPEAT from L_1 to L_2 P=(R1 Add 1)"),
        ("REPEATB LBL", "REPEATB LBL"),
        ("REPEATB LBL P=10", "REPEATB LBL P=10"),
        ("GOTO LBL", "Both LBL"),
        ("GOTOC LBL", "BothQuietly LBL"),
        ("GOTOF N120", "Forward N120"),
        ("GOTOB :120", "Backward :120"),
        ("GOTOS", "ToStart"),
        ("GOTOF \"LAB\"<<R1", "Forward (\"LAB\" Join R1)"),
        ("GOTOF _NAME", "Forward _NAME"),
        ("IF R1 GOTOS", "IF R1 ToStart"),
        ("IF R4>0 GOTOB LA1 ;again", "IF (R4 Greater 0) Backward LA1 | ;again"),
        ("R1=R1-1 IF R1==0 GOTOF N5", "R1 = (R1 Subtract 1) | IF (R1 Equal 0) Forward N5"),
        (
            "CASE(4+3) OF 7 GOTOF SEVEN -9 GOTOB N9 DEFAULT GOTO OTHER",
            "CASE group (4 Add 3) 7: Forward SEVEN, -9: Backward N9, else: Both OTHER",
        ),
        ("CASE R1 OF 1 GOTOF AA AB GOTOF BB", "CASE R1 1: Forward AA, AB: Forward BB"),
        ("CASE R1 OF \"A\" GOTOF \"B\"", "CASE R1 \"A\": Forward \"B\""),
    ]);
}

#[test]
fn synchronised_actions_are_one_piece() {
    check(&[
        ("WHENEVER $A_IN[1] DO OVR=0", "synchronous <WHENEVER $A_IN[1] DO OVR=0>"),
        (
            "N5 ID=1 EVERY $AA_IW[X]>5 DO M=5 \"a;b\" ;c",
            "N5 | synchronous <ID=1 EVERY $AA_IW[X]>5 DO M=5 \"a;b\"> | ;c",
        ),
        ("IDS = 2 G710 DO $R1=5", "synchronous <IDS = 2 G710 DO $R1=5>"),
        ("when ($a_in[1]) do @", "synchronous <when ($a_in[1]) do @>"),
        ("DO M5", "synchronous <DO M5>"),
    ]);
}

#[test]
fn frames_of_units() {
    let base = 50;
    let read = |text: &str| match unit::line(text.as_bytes(), base) {
        Ok(Line::Header(unit::Header { name, kind })) => {
            format!("{kind:?} {}", &text[(name.start - base) as usize..(name.end - base) as usize])
        }
        Ok(Line::Path(path)) => {
            format!("path {}", &text[(path.start - base) as usize..(path.end - base) as usize])
        }
        Ok(other) => format!("{other:?}"),
        Err((fault, _)) => format!("{fault:?}"),
    };
    assert_eq!(read("%_N_TEST_1_MPF"), "Main TEST_1");
    assert_eq!(read("%_N_L10_SPF "), "Sub L10");
    assert_eq!(read("%_n_sub_spf"), "Sub sub");
    assert_eq!(read("%_N_INITIAL_INI"), "Other INITIAL");
    assert_eq!(read(";$PATH=/_N_WKS_DIR/_N_A_WPD "), "path /_N_WKS_DIR/_N_A_WPD");
    assert_eq!(read("%"), "Mark");
    assert_eq!(read(";%_N_X_MPF"), "Block");
    assert_eq!(read(" ;$PATH=/A"), "Block");
    assert_eq!(read("N10 G0"), "Block");
    for wrong in ["%_N_CYCLE()_SPF", "%_N__MPF", "%_N_MPF", "%123", "%_N_A_M-F"] {
        assert!(read(wrong).starts_with("Syntax"), "{wrong}: {}", read(wrong));
    }
}

#[test]
fn the_form_of_a_text() {
    let text = b"%\n%_N_A_MPF\r\n;$PATH=/_N_MPF_DIR\r\nX1 2\r\nX1\n%_N_B_INI\nany text\n%_N_C_SPF\n)";
    let faults: Vec<_> = crate::siemens::form(text).iter().map(|d| (d.span.start, d.span.end)).collect();
    assert_eq!(faults, [(36, 37), (71, 72)]);
}
