//! How lines look, as data: what goes in, and what comes out.

use ncc_dialects::Settings;
use ncc_frontends::pieces::{LineIs, Lines, MOST_PLAIN, Piece, PlainWord};

use super::layout;
use super::same::{Taken, same};

fn settings(id: &str) -> Settings {
    Settings::new(ncc_dialects::builtin(id).unwrap())
}

fn taken(id: &str, line: &str) -> (LineIs, Vec<Piece>) {
    let mut pieces = Vec::new();
    (Lines::new(settings(id)).line(line.as_bytes(), &mut pieces), pieces)
}

/// A line laid out; what is not taken apart stays.
fn laid_out(id: &str, line: &str) -> String {
    let (is, pieces) = taken(id, line);
    let mut to = Vec::new();
    match is {
        LineIs::Blocks => layout::line(settings(id).dialect, line.as_bytes(), &pieces, &mut to),
        LineIs::Frame | LineIs::Outside | LineIs::Unread => to.extend_from_slice(line.as_bytes()),
    }
    String::from_utf8(to).unwrap()
}

fn says_the_same(id: &str, a: &str, b: &str) -> bool {
    let ((is_a, pieces_a), (is_b, pieces_b)) = (taken(id, a), taken(id, b));
    same(
        Taken { is: is_a, line: a.as_bytes(), pieces: &pieces_a },
        Taken { is: is_b, line: b.as_bytes(), pieces: &pieces_b },
    )
}

const LINES: &[(&str, &str, &str)] = &[
    // Blanks and capitals.
    ("fanuc", "g0x10.y-5.", "G00 X10. Y-5."),
    ("fanuc", "G00  X 10.\t Y - 5. ", "G00 X10. Y-5."),
    ("mach9", "G1 X1. Y2.", "G1X1.Y2."),
    ("mach9", "G X Y2.", "GXY2."),
    ("siemens", "N10G1X10Y20F100", "N10 G1 X10 Y20 F100"),
    ("siemens", "n10 supa x5", "N10 SUPA X5"),
    // Numbers keep their digits and their point.
    ("fanuc", "X+1. Y01.50 Z-0.5 R.5 F0100.", "X1. Y1.50 Z-0.5 R.5 F100."),
    ("fanuc", "X0100 Y000 Z-00.", "X100 Y0 Z-0."),
    ("siemens", "X1ex3 Y=1Ex-2", "X1EX3 Y=1EX-2"),
    // Codes in their dictionary's form; unknown ones as they are.
    ("fanuc", "G1 M3", "G01 M03"),
    ("fanuc", "G054.1 P1 G5.10", "G54.1 P1 G5.10"),
    ("mach9", "G01M06", "G1M6"),
    ("siemens", "G01 M03", "G1 M3"),
    ("fanuc", "M0777", "M777"),
    // Names keep their zeros.
    ("fanuc", "N0010 M98 P0100", "N0010 M98 P0100"),
    ("siemens", "L010 P02", "L010 P02"),
    ("siemens", "X01=5", "X01=5"),
    // Comments.
    ("fanuc", "G0(Rapid  to ø)X1.", "G00 (Rapid  to ø) X1."),
    ("fanuc", "  (an indented one)", "  (an indented one)"),
    ("mach9", "  G0  X1.   ;  slow  ", "G0X1.;  slow"),
    ("siemens", "G0 X1;slow", "G0 X1 ;slow"),
    // Ends of blocks within a line.
    ("fanuc", "G1 X1. ;", "G01 X1.;"),
    ("fanuc", "G1 X1.;;", "G01 X1.;;"),
    ("fanuc", "G1 X1. ;  G0Z5. (up) ;", "G01 X1.; G00 Z5. (up);"),
    ("mach9", "G0 X1. # ; c", "G0X1.#; c"),
    // Skips.
    ("fanuc", "/ 2G1X1.", "/2 G01 X1."),
    ("fanuc", "/ N10 G1", "/N10 G01"),
    ("siemens", "/1N10 G1", "/1 N10 G1"),
    // Variables and expressions: blanks between their parts stay, one at most.
    ("fanuc", "#1=#2+05.  #3 = 1", "#1=#2+05. #3 = 1"),
    ("fanuc", "if [#1 eq  2] goto 10", "IF [#1 EQ 2] GOTO 10"),
    ("fanuc", "IF[#1EQ2]GOTO10", "IF[#1EQ2]GOTO10"),
    ("fanuc", "N10IF[#1EQ2]THEN#3=1", "N10 IF[#1EQ2]THEN#3=1"),
    ("fanuc", "G1X #1Y-[#2+1.]Z - #3", "G01 X#1 Y-[#2+1.] Z-#3"),
    ("fanuc", "dprnt[X#1[53] lower]", "dprnt[X#1[53] lower]"),
    ("siemens", "R1=A+5 X+05", "R1=A+5 X5"),
    ("siemens", "TRANS X+10 Y+ 05.50", "TRANS X10 Y5.50"),
    ("siemens", "if r1==1 gotof ende", "IF R1==1 GOTOF ENDE"),
    ("siemens", "N10MSG(\"lower  case\")G0", "N10 MSG(\"lower  case\") G0"),
    ("siemens", "MCALL CYCLE82( 10, 0,  2, , 15, 0.3 )", "MCALL CYCLE82( 10, 0, 2, , 15, 0.3 )"),
    ("siemens", "ende:g0x+5", "ENDE:G0 X5"),
    ("siemens", "define home as g0 x0", "DEFINE HOME as g0 x0"),
    // What is no block.
    ("fanuc", "this is a text  of words", "this is a text  of words"),
    ("fanuc", "G1 (open", "G1 (open"),
    ("fanuc", "G1  X$", "G1  X$"),
    ("siemens", "G1  X\"open", "G1  X\"open"),
    ("siemens", "%_N_PART_MPF", "%_N_PART_MPF"),
    ("fanuc", "% leader  1", "% leader  1"),
];

#[test]
fn lines_look_as_written_here_and_say_the_same() {
    for (id, line, expected) in LINES {
        assert_eq!(laid_out(id, line), *expected, "{id}: {line}");
        assert_eq!(laid_out(id, expected), *expected, "{id}: {expected}, once more");
        assert!(says_the_same(id, line.trim_end(), expected), "{id}: {line}");
    }
}

/// The judge is no friend of the layout: what it must not let through.
#[test]
fn what_is_changed_is_found() {
    for (id, a, b) in [
        ("fanuc", "X100", "X100."),
        ("fanuc", "X1.50", "X1.5"),
        ("fanuc", "X1. Y2.", "Y2. X1."),
        ("fanuc", "X-1.", "X1."),
        ("fanuc", "X1.", "X10."),
        ("fanuc", "G1 (a)", "G1 (A)"),
        ("fanuc", "G1 (a) X1.", "G1 X1. (a)"),
        ("fanuc", "G1; X1.", "G1 X1."),
        ("fanuc", "#1=#2+5.", "#1=#25."),
        ("fanuc", "#1=[1.+5.]", "#1=[1.5.]"),
        ("fanuc", "N010", "N10"),
        ("fanuc", "M98 P0100", "M98 P100"),
        ("fanuc", "X1. X", "X1."),
        ("siemens", "L010", "L10"),
        ("siemens", "R1=A+5", "R1=A5"),
        ("siemens", "X=AC(5)", "X=AC(+5)"),
        ("siemens", "MSG(\"a\")", "MSG(\"A\")"),
        ("siemens", "A_B", "A _B"),
        ("mach9", "GXY", "GX"),
        ("mach9", "G0;a", "G0; a"),
    ] {
        assert!(!says_the_same(id, a, b), "{id}: {a} | {b}");
        assert!(says_the_same(id, a, a) && says_the_same(id, b, b), "{id}: {a} | {b}");
    }
}

/// What the short way takes for laid out is what the long way leaves as it is, in every dialect.
#[test]
fn lines_that_stay_are_laid_out() {
    let (mut stay, mut change) = (0, 0);
    for dialect in ncc_dialects::builtins() {
        let id = dialect.id.as_str();
        for letter in b'A'..=b'Z' {
            for value in ["1", "01", "-1", "-01", "0.5", "00.5", "-0.25", "54.1", "10.", "0", "00", "6", "06"]
            {
                let letter = letter as char;
                for line in [
                    format!("{letter}{value}"),
                    format!("N10 {letter}{value} Y5"),
                    format!("X1.5 {letter}{value} G1 F100"),
                    format!("{letter}{value} {letter}{value}"),
                ] {
                    let mut words = [PlainWord::default(); MOST_PLAIN];
                    let mut lines = Lines::new(settings(id));
                    let Some(words) = lines.plain(line.as_bytes(), &mut words) else { continue };
                    if !layout::is_laid_out(dialect, line.as_bytes(), words) {
                        change += 1;
                        continue;
                    }
                    stay += 1;
                    assert_eq!(laid_out(id, &line), line, "{id}");
                    assert!(says_the_same(id, &line, &line), "{id}: {line}");
                    let mut long = Lines::new(settings(id));
                    assert_eq!(long.line(line.as_bytes(), &mut Vec::new()), LineIs::Blocks, "{id}: {line}");
                    assert!(long.stands_as(&lines), "{id}: {line}");
                }
            }
        }
    }
    assert!(stay > 1000 && change > 1000, "{stay} {change}");
}
