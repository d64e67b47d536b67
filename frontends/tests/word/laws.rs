//! Laws: the recogniser and the grammar agree, the short way and the long way agree, pieces and
//! the whole agree, and no bytes make the reader fail.

use proptest::prelude::*;

use super::*;
use crate::common::fast_parse;
use crate::word::text::block;
use crate::word::text::block::Block;
use crate::word::text::token::Signs;

/// Something like a word.
fn word() -> impl Strategy<Value = String> {
    let letter = prop::sample::select("NXYZGMFSTIJKRPQABCDHLOxyzgUE".chars().collect::<Vec<_>>());
    let number = prop_oneof![
        8 => "-?[0-9]{1,4}\\.[0-9]{0,4}",
        4 => "-?[0-9]{1,3}",
        1 => "-?\\.[0-9]{1,3}",
        1 => "[+-]?[0-9]{0,19}\\.?[0-9]{0,19}",
        1 => Just(String::new()),
        1 => Just("#1".to_owned()),
        1 => Just("[1+2]".to_owned()),
    ];
    let blank = prop::sample::select(vec!["", "", " ", "\t", "  "]);
    (letter, blank.clone(), number, blank).prop_map(|(l, a, n, b)| format!("{l}{a}{n}{b}"))
}

/// Something like a line.
fn line() -> impl Strategy<Value = String> {
    let lead = prop::sample::select(vec!["", "", "", "", "/", "/2 ", "N10 ", " ", "%", "O12", "#2=3"]);
    let tail = prop::sample::select(vec!["", "", "", "", "(C)", ";c", "\r", ";", "#", " /M8", "$", "\u{e9}"]);
    (lead, prop::collection::vec(word(), 0..6), tail).prop_map(|(l, w, t)| format!("{l}{}{t}", w.concat()))
}

/// Nearly a move of the usual kinds: what the short way takes, and what is only a sign away from it.
fn move_line() -> impl Strategy<Value = String> {
    let number = prop_oneof![
        8 => "-?[0-9]{1,4}\\.[0-9]{0,4}",
        2 => "-?[0-9]{1,4}",
        1 => Just("0".to_owned()),
        1 => "-?[0-9]{0,9}\\.?[0-9]{0,9}",
    ];
    let axis = (prop::sample::select("XYZXYZXYZXYZxyABCa".chars().collect::<Vec<_>>()), number.clone());
    let centre = (prop::sample::select("IJKIJKijR".chars().collect::<Vec<_>>()), number.clone());
    let word = prop_oneof![
        12 => axis.prop_map(|(l, n)| format!("{l}{n}")),
        1 => centre.clone().prop_map(|(l, n)| format!("{l}{n}")),
        2 => number.clone().prop_map(|n| format!("F{n}")),
        3 => prop::sample::select(vec!["G0", "G1", "G01", "g1", "G1.", "G00", "G-0", "G2", "G3", "g02", "G80"])
            .prop_map(String::from),
        1 => prop::sample::select(vec!["N5", "N-0", "N1.", "M8", "S5", "F0"]).prop_map(String::from),
    ];
    let plain = prop::collection::vec(word, 1..6);
    let pair = ("[XYZ]", number.clone(), "[XYZ]", number.clone());
    let arc = (prop::sample::select(vec!["G2", "G3", "g03", ""]), pair, prop::collection::vec(centre, 1..3));
    let arc = arc.prop_map(|(code, (a, m, b, n), centre)| {
        let mut words = vec![code.to_owned(), format!("{a}{m}"), format!("{b}{n}")];
        words.extend(centre.into_iter().map(|(l, n)| format!("{l}{n}")));
        words
    });
    let modes = "G17 G18 G19 G20 G21 G90 G91 G93 G94 G95 G41 G40 G90.1 G91.1 G16 G15 G98 G99 G54 G70 G71";
    let modes: Vec<&str> = modes.split_ascii_whitespace().collect();
    let mode = prop::sample::select(modes).prop_map(|code| vec![code.to_owned()]);
    let cycle = "G81 X1. Y1. Z-5. R1. F10./G80/M98 P5/G2/F10./G43 H1/G52 X1./G68 X0. Y0. R30./M6/G92 X0./M99\nO5\nG0 X1./M99\nO5\nG1 F10./M30\nO5/M98 P5"
        .split('/')
        .collect::<Vec<_>>();
    let other = prop::sample::select(cycle).prop_map(|words| vec![words.to_owned()]);
    let leads =
        ["", "", "", "", "N10 ", " N20", "n3", "/", "/N4 ", "/2", "/3 ", "/0", "/12 ", "N5 /", "//", "O5 "];
    let lead = prop::sample::select(leads.to_vec());
    let blank = prop::sample::select(vec!["", " ", "\t"]);
    let tails = [
        "",
        "",
        "",
        "",
        "",
        " ",
        "\r",
        "\r ",
        "(C)",
        " (pass 1) ",
        "()",
        "(A)(B)",
        "(A) X5.",
        "(A",
        "( a)\r",
        ";c",
        " ; d e ",
        "(MSG, a)",
        "( m s g,b)",
        "(DEBUG,x)",
        "(LOG,x)",
        "(PY,x)",
        "(ABORT,x)",
        "(\u{e9})",
        "(a\rb)",
        "(a;b)",
        ";(a)",
        "%",
        "#",
    ];
    let tail = prop::sample::select(tails.to_vec());
    (lead, prop_oneof![12 => plain, 6 => arc, 2 => mode, 1 => other], blank, tail)
        .prop_map(|(l, w, b, t)| format!("{l}{}{t}", w.join(b)))
}

/// A cycle, or a position that is one of its holes, or nearly so.
fn hole_line() -> impl Strategy<Value = String> {
    let cycles = [
        "G81 X1. Y1. Z-5. R1. F10.",
        "G81 Z-5. R1.",
        "G99 G82 X1. Y1. Z-5. R1. P500 F10.",
        "G98 G83 X1. Y1. Z-5. R1. Q1.",
        "G84 X1. Y1. Z-5. R1. F10.",
        "G73 Z-5. R1. Q1. F5. K0",
        "G91 G81 X1. Y1. Z-5. R1. F10.",
        "G18 G81 X1. Z1. Y-5. R1. F10.",
        "G80",
        "G98",
        "G90",
        "G91",
        "F20.",
        "R2.",
        "Z-6.",
        "X1. Y1. K3",
        "X1. Y2. F30.",
        "G21 G17 G90 G54 G94 G98 G43 H1 Z5.",
    ];
    let cycle = prop::sample::select(cycles.to_vec()).prop_map(String::from);
    let word = ("[XYXYXYXYZA]", "-?[0-9]{1,3}\\.?[0-9]{0,2}").prop_map(|(l, n)| format!("{l}{n}"));
    let lead = prop::sample::select(vec!["", "", "", "", "", "N10 ", "N5", "/", "/2 "]);
    let tail = prop::sample::select(vec!["", "", "", "", "", "(C)", " ; c", "\r", "(MSG, a)", " ()"]);
    let place = (lead, prop::collection::vec(word, 1..3), tail)
        .prop_map(|(l, words, t)| format!("{l}{}{t}", words.join(" ")));
    prop_oneof![1 => cycle, 4 => place]
}

/// What makes a text one that is kept whole.
fn computing_line() -> impl Strategy<Value = String> {
    let lines = [
        "GOTO5",
        "IF[#1EQ1]GOTO10",
        "GOTO#1",
        "N10 G1 X1. F100.",
        "N5 X2.",
        "N7 Y1.",
        "#1=2.",
        "G1 X[#1+5.] F10.",
        "X[-0.5+#1] Y2.",
        "N10 Z[#2-3]",
        "X[#1+.5]",
        "Y[5]",
        "WHILE[#1LT3]DO1",
        "END1",
        "G80",
        "G1 X1. F5.",
    ];
    prop::sample::select(lines.to_vec()).prop_map(String::from)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn recogniser_and_grammar_agree(lines in prop::collection::vec(line(), 1..4)) {
        let text = lines.join("\n");
        for id in ["mach9", "fanuc"] {
            let signs = Signs::new(settings(id).dialect);
            let mut words = Vec::new();
            let Some(end) = fast_parse::read(text.as_bytes(), 0, 7, &mut words) else {
                continue;
            };
            let line = text.split('\n').next().unwrap().trim_end_matches('\r');
            prop_assert_eq!(text.as_bytes().get(end).copied().unwrap_or(b'\n'), b'\n');
            prop_assert_eq!(text.find('\n').unwrap_or(text.len()), end);
            let mut block = Block::default();
            let next = block::parse(line.as_bytes(), 0, 7, signs, &mut block);
            prop_assert_eq!(next, None);
            prop_assert_eq!(&block.words, &words);
            prop_assert!(block.faults.is_empty() && block.comments.is_empty() && block.skip == 0);
        }
    }

    #[test]
    fn the_short_way_and_the_long_way_agree(
        lines in prop::collection::vec(prop_oneof![1 => line(), 6 => move_line(), 7 => hole_line()], 1..25),
        assume: bool,
        watch: bool,
        tabled: bool,
    ) {
        for id in ["mach9", "fanuc", "haas", "linuxcnc", "grbl", "mach3"] {
            let text = format!("{}{}\nX1. Y2.\nN5 Z-3.\nM30\n", head(id), lines.join("\n"));
            let (mut short, mut long) = (Batch::default(), Batch::default());
            let mut first = Reader::new(settings(id), assume);
            if watch {
                first.watch();
            }
            // What is in a table stands before all other statements of what is read at once.
            let (front, tail) = (head(id).len(), text.rfind("\nX1. Y2.").expect("the tail") + 1);
            let ends = if tabled { vec![front, tail, text.len()] } else { vec![text.len()] };
            let mut before = Vec::new();
            for (at, end) in ends.iter().enumerate() {
                let start = if at == 0 { 0 } else { ends[at - 1] };
                short.tabled = tabled && !short.whole;
                first.read(&text.as_bytes()[start..*end], start as u32, &mut short);
                short.unpack_table();
                if !short.whole {
                    before.append(&mut short.stmts);
                }
            }
            if short.whole && !before.is_empty() {
                // Structures know their beginnings by their places.
                continue;
            }
            short.tabled = false;
            before.append(&mut short.stmts);
            short.stmts = before;
            first.finish(&mut short);
            // The other one is fed line by line, and looks at every block. What O words report where a text calls
            // subprograms depends on how far it is looked ahead.
            let pieces: Vec<&str> = match id {
                "linuxcnc" => vec![&text],
                _ => text.split_inclusive('\n').collect(),
            };
            let mut second = Reader::new(settings(id), assume);
            if watch {
                second.watch();
            }
            second.lower.usual.off = true;
            let mut at = 0;
            for line in pieces {
                second.read(line.as_bytes(), at, &mut long);
                at += line.len() as u32;
            }
            second.finish(&mut long);
            prop_assert_eq!(&short.stmts, &long.stmts);
            prop_assert_eq!(&short.procedures, &long.procedures);
            prop_assert_eq!(&short.diagnostics, &long.diagnostics);
            prop_assert_eq!(&short.assumed, &long.assumed);
            prop_assert_eq!((&short.bare, short.pointed, short.whole), (&long.bare, long.pointed, long.whole));
            prop_assert_eq!(&first.lower.state, &second.lower.state);
            prop_assert_eq!(first.lower.rotary_named, second.lower.rotary_named);
        }
    }

    /// The same of a text that jumps and computes.
    #[test]
    fn the_short_way_and_the_long_way_agree_where_a_text_jumps(
        lines in prop::collection::vec(prop_oneof![1 => line(), 2 => computing_line(), 6 => move_line(), 4 => hole_line()], 1..25),
        assume: bool,
    ) {
        for id in ["fanuc", "haas"] {
            let text = format!("{}{}\nX1. Y2.\nN5 Z-3.\nM30\n", head(id), lines.join("\n"));
            let read = |off: bool| {
                let (mut reader, mut out) = (Reader::new(settings(id), assume), Batch::default());
                reader.lower.usual.off = off;
                reader.read(text.as_bytes(), 0, &mut out);
                reader.finish(&mut out);
                (reader, out)
            };
            let ((first, short), (second, long)) = (read(false), read(true));
            prop_assert_eq!(&short.stmts, &long.stmts);
            prop_assert_eq!(&short.procedures, &long.procedures);
            prop_assert_eq!(&short.diagnostics, &long.diagnostics);
            prop_assert_eq!((&short.assumed, short.whole), (&long.assumed, long.whole));
            prop_assert_eq!(&first.lower.state, &second.lower.state);
            prop_assert_eq!(&first.lower.computes.passed, &second.lower.computes.passed);
        }
    }

    #[test]
    fn no_bytes_make_the_reader_fail(
        bytes in prop_oneof![
            prop::collection::vec(any::<u8>(), 0..300),
            "[GXYZMNTFO#\\[\\]()=;/%+*.0-9A-Za-z \n\r-]{0,300}".prop_map(String::into_bytes),
            prop::collection::vec(line(), 0..30).prop_map(|l| l.join("\n").into_bytes()),
        ],
        assume: bool,
    ) {
        for id in ["mach9", "fanuc"] {
            let out = read_with(settings(id), assume, &bytes);
            let spans = out.stmts.iter().map(|s| s.span).chain(out.diagnostics.iter().map(|d| d.span));
            for span in spans {
                prop_assert!(span.start <= span.end && span.end as usize <= bytes.len());
            }
            // The first statement of a text is in no other's block.
            prop_assert!(out.stmts.first().is_none_or(|s| !s.joined));
        }
    }
}

#[test]
fn deep_brackets_are_no_danger() {
    let text = format!("X{}\n", "[".repeat(4000));
    assert!(faults("fanuc", &text)[0].starts_with("Syntax"));
    let text = format!("X{}1{}\n", "[1+".repeat(900), "]".repeat(900));
    assert!(faults("fanuc", &text)[0].starts_with("MacroLanguage"));
}

#[test]
fn the_recogniser_takes_what_it_is_for() {
    let mut words = Vec::new();
    for plain in ["N120 X12.345 Y-0.5 Z3.21\n", "G1X1.F500", "x1 y2\t\r\n"] {
        assert!(fast_parse::read(plain.as_bytes(), 0, 0, &mut words).is_some(), "{plain}");
    }
    for other in
        ["X1.(A)\n", "/X1.\n", "GXY\n", "\n", "X+1.\n", "X1.2.3\n", "X1.\rY2.\n", "X1234567890123456789\n"]
    {
        assert!(fast_parse::read(other.as_bytes(), 0, 0, &mut words).is_none(), "{other}");
    }
}

#[test]
fn the_short_way_takes_what_it_is_for() {
    let head = "G21 G17 G90 G94 G98 G54\nT1 M6\nG43 H1 Z5. G0 X0. Y0. F100.\nG1 X1.\n";
    let taken = |line: &str| {
        let mut reader = Reader::new(settings("fanuc"), true);
        let mut out = Batch::default();
        reader.read(head.as_bytes(), 0, &mut out);
        let before = out.stmts.clone();
        let end = reader.lower.fast_line(line.as_bytes(), 0, 0, 60, &mut out);
        assert_eq!(end.is_none(), out.stmts == before, "{line}");
        assert_eq!(reader.lower.fast_lower, reader.lower.settled(), "{line}");
        end
    };
    for (line, end) in [
        ("G0 X1.\n", 6),
        ("N9 Z-2. G00\n", 11),
        ("X1. Y-2.5 Z.003\n", 15),
        ("n120X-2345.678\r\nX2.", 15),
        ("N9 G1 X1. Y2. F250.\n", 19),
        ("N9 G01X1.F250\n", 13),
        ("F30. Z0 G1", 10),
    ] {
        assert_eq!(taken(line), Some(end), "{line}");
    }
    for line in [
        "G0\n",
        "G2 X1.\n",
        "G257 X1.\n",
        "G0 G1 X1.\n",
        "G1\n",
        "F100.\n",
        "X1\n",
        "X1. X2.\n",
        "G1 G1 X1.\n",
        "X1. N5\n",
        "X1. F-5.\n",
        "X1. F1. F2.\n",
        "X1. M8\n",
        "X1.(C)\n",
        "\n",
        "",
        "X1.\rY2.\n",
        "X99999999.\n",
        "G1. X1.\n",
        "N-0 X1.\n",
        "N1. X1.\n",
        "X1. Y2. Z3. X1. Y2. Z3. X1. Y2. Z3. X1. Y2. Z3. X1. Y2. Z3. X1.\n",
        "X1.                                                          \n",
    ] {
        assert_eq!(taken(line), None, "{line}");
    }
}

#[test]
fn other_usual_blocks_go_the_short_way_too() {
    let head = "G21 G17 G90 G94 G98 G54\nT1 M6\nG43 H1 Z5. G0 X0. Y0. F100.\nG1 X1.\n";
    let taken = |before: &str, line: &str| {
        let mut reader = Reader::new(settings("fanuc"), true);
        let mut out = Batch::default();
        reader.read(format!("{head}{before}").as_bytes(), 0, &mut out);
        let before = out.stmts.clone();
        let end = reader.lower.short_way(line.as_bytes(), 0, 0, 60, &mut out);
        assert_eq!(end.is_none(), out.stmts == before, "{line}");
        end == Some(line.trim_end_matches('\n').len())
    };
    for line in [
        "G0 X1. Y-2.\n",
        "n4g00X1.F30.\r\n",
        "G2 X1. Y2. I3. J0.\n",
        "G03 Y2. Z-1. J-0.5 F200",
        "G3 X1. R-5.\n",
        "X1. Y2. (PASS 1)\n",
        "G0 Z5. ()\r\n",
        "/X1.\n",
        "/3 N5 G1 X1. F100. (A)\n",
        "/ G2 X1. Y2. I3. J0.\n",
        "X1. A90. B-5. C0\n",
    ] {
        assert!(taken("", line), "{line}");
    }
    assert!(taken("G2 X0. Y5. I1. J0.\n", "X1. Y2. I3. J4.\n"));
    assert!(taken("G93\nG1 X1. F5.\n", "X1. F10.\n"));
    assert!(taken("/G0 X1.\nX2.\n", "X1. F10.\n"));
    for (before, line) in [
        ("", "G2 X1. Y2. K3.\n"),
        ("", "G2 I3. J0.\n"),
        ("", "G2 X1. I3. R3.\n"),
        ("", "X1. I3.\n"),
        ("", "X1 A90\n"),
        ("", "X1. (A\n"),
        ("", "X1. (A) Y2.\n"),
        ("", "(A) X1.\n"),
        ("", "/12 X1.\n"),
        ("", "N5 /X1.\n"),
        ("", "G4 X1.\n"),
        ("", "G0 G1 X1.\n"),
        ("G93\nG1 X1. F5.\n", "X1.\n"),
        ("G93\nG1 X1. F5.\n", "X1. F5\n"),
        ("G81 X1. Z-5. R1. F10.\n", "G0 X1.\n"),
        ("G68 X0. Y0. R30.\n", "/X1.\n"),
        ("G2\n", "G0 X1.\n"),
    ] {
        assert!(!taken(before, line), "{before}{line}");
    }
}

#[test]
fn what_is_known_decides_whether_the_short_way_is_taken() {
    let taken = |id: &str, head: &str, line: &str| {
        let mut reader = Reader::new(settings(id), true);
        let mut out = Batch::default();
        reader.read(head.as_bytes(), 0, &mut out);
        reader.lower.short_way(line.as_bytes(), 0, 0, 60, &mut out).is_some()
    };
    // Nothing has said from where the tool's length counts, and a subprogram's first move along Z is noted.
    assert!(!taken("fanuc", "", "G0 X1.\n"));
    let sub = "G21 G17 G90 G94 G54\nG43 H1 Z5. G0 X0. Y0. F100.\nM98 P5\nM30\nO5\nG1 X1. F10.\nG1 X1.\n";
    assert!(!taken("fanuc", sub, "Z1.\n"));
    assert!(taken("fanuc", sub, "X2.\n"));
    // Words within a comment that the control acts on.
    let head = "G21 G17 G90 G94 G54\nT1 M6\nG43 H1\nG0 X0 Y0 Z5 F100\nG1 X1\n";
    assert!(taken("linuxcnc", head, "X1 (pass)\n"));
    for line in ["X1 (MSG, a)\n", "X1 ( d e bug,a)\n", "X1 (PY,a)\n", "X1 (LOG,a)\n"] {
        assert!(!taken("linuxcnc", head, line), "{line}");
    }
}

/// What is read as a table, and what makes statements of it.
#[test]
fn lines_are_read_as_a_table() {
    let lines = "N10 X1. Y2.\nG1 X3. F250.\nG0 Z5.\nX7.5\nG1 Z-1. F80.\n";
    for id in ["fanuc", "mach9", "haas", "linuxcnc", "mach3"] {
        let read = |rest: &str| {
            let (mut reader, mut out) = (Reader::new(settings(id), true), Batch::default());
            reader.repeats(false);
            let head = format!("{}G21 G90 G1 X0. Y0. Z0. F100.\n", head(id));
            reader.read(head.as_bytes(), 0, &mut out);
            out.stmts.clear();
            out.tabled = true;
            reader.read(rest.as_bytes(), head.len() as u32, &mut out);
            (out.table.rows().len(), out.stmts.len())
        };
        assert_eq!(read(lines), (5, 0), "{id}");
        if id == "fanuc" {
            assert_eq!(read(&format!("{lines}/X2.\n")), (5, 1), "{id}: a usual block stands behind it");
        }
        assert_eq!(read(&format!("{lines}M5\nX2.\n")).0, 0, "{id}: another one finds statements alone");
        assert_eq!(read(&format!("M5\n{lines}")).0, 0, "{id}");
    }
}
