//! Laws: the short way and the grammar agree, pieces and the whole agree, no bytes make the reader
//! fail.

use proptest::prelude::*;

use super::*;
use crate::siemens::lower::Lower;

/// Something like a word.
fn word() -> impl Strategy<Value = String> {
    let number = prop_oneof![8 => "-?[0-9]{1,4}\\.[0-9]{0,4}", 4 => "-?[0-9]{1,3}", 1 => "[+-]?[0-9]{0,19}\\.?[0-9]{0,12}"];
    let letter = prop::sample::select("NXYZGMFSTDIJKLPABCHXYZXYZxygE".chars().collect::<Vec<_>>());
    let blank = prop::sample::select(vec!["", "", " ", "\t"]);
    let plain = (letter, blank, number).prop_map(|(l, b, n)| format!("{l}{b}{n} "));
    let codes = "G0 G1 G2 G90 G91 G70 G71 G700 G710 G17 G18 G54 G500 M3 M5 M6 M17 M30 RET SUPA TRANS ROT RPL=30 MCALL \
        CYCLE81(5,0,2,-3) CYCLE85(5,0,2,-3,,,9,8) CYCLE83(5,0,1,-20,,-8,,0,0,0,1,1) HOLES2(0,0,5,0,0,3) \
        CYCLE801(0,0,0,5,5,2,2) MSG(\"a\") L1 L01 NAME P3 CR=5 AR=90 TURN=1 I1=2 J1=3 CIP CT X=AC(5) Y=IC(2) \
        R1=5 AA: REPEAT AA IF GOTOF BRISK G41 D1 T1 F100 O =";
    let codes: Vec<&str> = codes.split_ascii_whitespace().collect();
    prop_oneof![3 => plain, 2 => prop::sample::select(codes).prop_map(|c| format!("{c} "))]
}

/// Something like a line.
fn line() -> impl Strategy<Value = String> {
    let lead = prop::sample::select(vec![
        "",
        "",
        "",
        "",
        "/",
        "/2 ",
        "N10 ",
        " ",
        "%",
        "AA:",
        "%_N_L1_SPF\n",
        "%_N_A_MPF\n",
    ]);
    let tail = prop::sample::select(vec!["", "", "", ";c", "\r", "#", "\u{e9}"]);
    (lead, prop::collection::vec(word(), 0..5), tail).prop_map(|(l, w, t)| format!("{l}{}{t}", w.concat()))
}

/// Nearly a move of the usual kinds: what the short way takes, and what is only a sign away from it.
fn move_line() -> impl Strategy<Value = String> {
    let number = prop_oneof![
        6 => "-?[0-9]{1,4}\\.[0-9]{0,4}",
        4 => "-?[0-9]{1,4}",
        1 => "-?[0-9]{0,9}\\.?[0-9]{0,9}",
    ];
    let sign = prop::sample::select(vec!["", "", "", "=", "= "]);
    let axis = (prop::sample::select("XYZXYZXYZXYZxyABCa".chars().collect::<Vec<_>>()), sign, number.clone());
    let centre = (
        prop::sample::select(vec!["I", "J", "K", "I", "J", "i", "I=", "CR=", "cr=", "AR=", "CR"]),
        number.clone(),
    );
    let word = prop_oneof![
        12 => axis.prop_map(|(l, s, n)| format!("{l}{s}{n}")),
        1 => centre.clone().prop_map(|(l, n)| format!("{l}{n}")),
        2 => number.clone().prop_map(|n| format!("F{n}")),
        3 => prop::sample::select(vec!["G0", "G1", "G01", "g1", "G1.", "G00", "G-0", "G2", "G3", "g02", "CT"])
            .prop_map(String::from),
        1 => prop::sample::select(vec!["N5", "N-0", "N1.", "M8", "S5", "F0", "F=5", "X1=5", "X=1+2", "X=IC(1)", "A=DC(9)"])
            .prop_map(String::from),
    ];
    let plain = prop::collection::vec(word, 1..6);
    let pair = ("[XYZ]", number.clone(), "[XYZ]", number.clone());
    let arc = (prop::sample::select(vec!["G2", "G3", "g03", ""]), pair, prop::collection::vec(centre, 1..3));
    let arc = arc.prop_map(|(code, (a, m, b, n), centre)| {
        let mut words = vec![code.to_owned(), format!("{a}{m}"), format!("{b}{n}")];
        words.extend(centre.into_iter().map(|(l, n)| format!("{l}{n}")));
        words
    });
    let modes = "G17 G18 G19 G70 G71 G700 G710 G90 G91 G93 G94 G95 G41 G40 G54 G500 D1 D0 F10 G2";
    let modes: Vec<&str> = modes.split_ascii_whitespace().collect();
    let mode = prop::sample::select(modes).prop_map(|code| vec![code.to_owned()]);
    let others = [
        "MCALL CYCLE81(5,0,2,-3)",
        "MCALL",
        "TRANS X1",
        "RND=2",
        "RNDM=1",
        "RNDM=0",
        "R1=5",
        "X=R1+2.5 Y-1",
        "G1 Z=-0.5+R1 F10",
        "GOTOF AA",
        "IF R1==5 GOTOB N5",
        "AA:",
        "BB: X1",
        "REPEAT AA",
        "REPEAT BB AA P=2",
        "REPEATB BB",
        "T2 M6",
        "L1",
    ];
    let other = prop::sample::select(others.to_vec()).prop_map(|words| vec![words.to_owned()]);
    let leads = [
        "", "", "", "", "N10 ", " N20", "n3", "/", "/", "/N4 ", "/2 ", "/2", "/0 ", "/1 ", "/9 ", "/12 ",
        "N5 /", "//",
    ];
    let lead = prop::sample::select(leads.to_vec());
    let blank = prop::sample::select(vec!["", " ", "\t", "&"]);
    let tails = [
        "",
        "",
        "",
        "",
        "",
        " ",
        "\r",
        "\r ",
        ";c",
        " ; d e ",
        ";",
        "; \r",
        ";(\u{e9})",
        "; a\rb",
        "(a)",
        ":",
        "#",
    ];
    let tail = prop::sample::select(tails.to_vec());
    (lead, prop_oneof![12 => plain, 6 => arc, 2 => mode, 1 => other], blank, tail)
        .prop_map(|(l, w, b, t)| format!("{l}{}{t}", w.join(b)))
}

/// A cycle, or a position that is one of its holes, or nearly so.
fn hole_line() -> impl Strategy<Value = String> {
    let cycles = [
        "MCALL CYCLE81(5,0,2,-3)",
        "MCALL CYCLE81(5,0,2,-3)\r ",
        "MCALL CYCLE82(5,0,2,-3,,1)",
        "MCALL CYCLE83(5,0,1,-20,,-8,,0,0,0,1,1)",
        "MCALL CYCLE85(5,0,2,-3,,,9,8)",
        "MCALL CYCLE84(5,0,2,-20,,,3,,1,,300,)",
        "MCALL CYCLE840(5,0,2,-20,,,4,3,,1,)",
        "MCALL",
        "MCALL L1",
        "G0",
        "G1 F5",
        "F20",
        "S300",
        "G91",
        "G90 G0",
        "G18",
        "T2 M6",
        "G54 G17 G90 G0 G71 G94 D1",
        "X1 Z2",
        "HOLES2(0,0,5,0,0,3)",
    ];
    let cycle = prop::sample::select(cycles.to_vec()).prop_map(String::from);
    let word =
        ("[XYXYXYXYZA]", "=?", "-?[0-9]{1,3}\\.?[0-9]{0,2}").prop_map(|(l, s, n)| format!("{l}{s}{n}"));
    let lead = prop::sample::select(vec!["", "", "", "", "", "N10 ", "N5", "/", "/2 "]);
    let tail = prop::sample::select(vec!["", "", "", "", "", "; c", " ;", "\r", ";(a)"]);
    let place = (lead, prop::collection::vec(word, 1..3), tail)
        .prop_map(|(l, words, t)| format!("{l}{}{t}", words.join(" ")));
    prop_oneof![1 => cycle, 4 => place]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_short_way_and_the_long_way_agree(
        lines in prop::collection::vec(prop_oneof![1 => line(), 6 => move_line(), 7 => hole_line()], 1..25),
        assume: bool,
        watch: bool,
        tabled: bool,
    ) {
        let text = format!("{HEAD}{}\nX1. Y2.\nN5 Z-3\nM30\n", lines.join("\n"));
        let mut short = Batch::default();
        let mut first = Reader::new(settings(), assume);
        if watch {
            first.watch();
        }
        // What is in a table stands before all other statements of what is read at once.
        let (front, tail) = (HEAD.len(), text.rfind("\nX1. Y2.").expect("the tail") + 1);
        let tabled = tabled && !text.contains("GOTO");
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
        // Structures know their beginnings by their places.
        prop_assume!(!short.whole || before.is_empty());
        short.tabled = false;
        before.append(&mut short.stmts);
        short.stmts = before;
        let said = |lower: &Lower| {
            let spent = (lower.recall, lower.idle_tap, lower.executed);
            (lower.state.clone(), lower.moved, lower.stand.axes, spent)
        };
        let state = said(&first.lower);
        first.finish(&mut short);
        // The other one is fed line by line, and every line goes through the grammar.
        let mut reader = Reader::new(settings(), assume);
        reader.grammar_alone();
        if watch {
            reader.watch();
        }
        let mut long = Batch::default();
        // What a block with a number is depends on the jumps of the text that is looked through before it.
        let pieces: Vec<&str> = match text.contains("GOTO") {
            true => vec![&text],
            false => text.split_inclusive('\n').collect(),
        };
        let mut at = 0;
        for line in pieces {
            reader.read(line.as_bytes(), at, &mut long);
            at += line.len() as u32;
        }
        prop_assert_eq!(state, said(&reader.lower));
        reader.finish(&mut long);
        prop_assert_eq!(&short.stmts, &long.stmts);
        prop_assert_eq!(&short.procedures, &long.procedures);
        prop_assert_eq!(&short.diagnostics, &long.diagnostics);
        prop_assert_eq!(&short.assumed, &long.assumed);
    }

    #[test]
    fn no_bytes_make_the_reader_fail(
        bytes in prop_oneof![
            prop::collection::vec(any::<u8>(), 0..300),
            "[GXYZMNTFOLP\\[\\]()=;/%+*.,0-9A-Za-z_ \"\n\r-]{0,300}".prop_map(String::into_bytes),
            prop::collection::vec(line(), 0..30).prop_map(|l| l.join("\n").into_bytes()),
        ],
        assume: bool,
    ) {
        let out = read_with(settings(), assume, &bytes);
        let stmts = || out.stmts.iter().chain(out.procedures.iter().flat_map(|p| &p.body));
        let spans = stmts().map(|s| s.span).chain(out.diagnostics.iter().map(|d| d.span));
        for span in spans {
            prop_assert!(span.start <= span.end && span.end as usize <= bytes.len());
        }
        // The first statement of a text is in no other's block.
        prop_assert!(out.stmts.first().is_none_or(|s| !s.joined));
        prop_assert!(stmts().all(|s| s.skip.is_none_or(|level| (1..=10).contains(&level))));
    }
}

#[test]
fn the_short_way_takes_what_it_is_for() {
    let taken = |head: &str, line: &str| {
        let mut reader = Reader::new(settings(), true);
        let mut out = Batch::default();
        reader.read(head.as_bytes(), 0, &mut out);
        let before = out.stmts.clone();
        let end = reader.lower.fast_line(line.as_bytes(), 0, 0, 60, &mut out);
        assert_eq!(end.is_none(), out.stmts == before, "{line}");
        end
    };
    let head = format!("{HEAD}G1 X1\n");
    for (line, end) in [
        ("X1 Y-2.5 Z.003\n", 14),
        ("n120X-2345.678\r\nX2", 15),
        ("N9 G1 X1 Y2 F250\n", 16),
        ("F30. Z0 G01", 11),
    ] {
        assert_eq!(taken(&head, line), Some(end), "{line}");
    }
    for line in [
        "G0 X1\n",
        "G1\n",
        "F100\n",
        "X1 X2\n",
        "G1 G1 X1\n",
        "X1 N5\n",
        "X1 M8\n",
        "X1;C\n",
        "\n",
        "",
        "N-0 X1\n",
    ] {
        assert_eq!(taken(&head, line), None, "{line}");
    }
    // A feed in another unit than the lengths is reported; after a skipped block, what one that is
    // skipped with it finds active must be looked at.
    let foreign = "G70 G17 G90 G94 G54\nT1 M6 D1\nF100\nG0 X0 Y0 Z5\nG1 X1\n";
    assert_eq!(taken(foreign, "X2\n"), Some(2));
    assert_eq!(taken(foreign, "X2 F5\n"), None);
    assert_eq!(taken(&format!("{head}/X2\n"), "X2\n"), None);
}

#[test]
fn a_block_between_ends_a_stretch_of_skipped_ones() {
    // How the last X is measured is only known when the program runs.
    let lines = after_head("G1 X1\n/G91\nX5\n/X7\n");
    assert_eq!(lines, ["FEED! X1", "/1 SetDistanceMode(Incremental)", "FEED X?5", "/1 FEED X?7"]);
}

#[test]
fn other_usual_blocks_go_the_short_way_too() {
    let taken = |before: &str, line: &str| {
        let mut reader = Reader::new(settings(), true);
        let mut out = Batch::default();
        reader.read(format!("{HEAD}G1 X1 F10\n{before}").as_bytes(), 0, &mut out);
        let before = out.stmts.clone();
        let end = reader.lower.short_way(line.as_bytes(), 0, 0, 60, &mut out);
        assert_eq!(end.is_none(), out.stmts == before, "{line}");
        end.is_some()
    };
    for line in [
        "G0 X1 Y-2\n",
        "G2 X1 Y2 I3 J0\n",
        "N5 G3 Y2 Z-1 CR=-5.5 F20\n",
        "g2 x1 cr=5\r\n",
        "X=1 Y=-2.5 Z3\n",
        "G2 X=1 I=3\n",
        "X1 Y2 ; pass 1 \n",
        "G0 Z5;",
        "/X1\n",
        "/3 N5 G1 X1 F10 ;a\n",
        "X1 A90 B=-5 C0\n",
    ] {
        assert!(taken("", line), "{line}");
    }
    assert!(taken("G93\nG1 X1 F5\n", "X1 F10\n"));
    assert!(taken("/G0 X1\n/X2\n", "/X1 F10\n"));
    assert!(taken("/G0 X1\n/X2\n", "X1\n"));
    for (before, line) in [
        ("", "G2 X1 Y2 K3\n"),
        ("", "G2 I3 J0\n"),
        ("", "G2 X1 I3 CR=3\n"),
        ("", "G2 X1 CR=0\n"),
        ("", "G2 X1 AR=5\n"),
        ("", "X=1+2\n"),
        ("", "X= 1\n"),
        ("", "X1=5\n"),
        ("", "X=AC(5)\n"),
        ("", "F=5 X1\n"),
        ("", "/12 X1\n"),
        ("", "N5 /X1\n"),
        ("G93\nG1 X1 F5\n", "X1\n"),
        ("RNDM=1\n", "G0 X1\n"),
        ("MCALL CYCLE81(5,0,2,-3)\n", "G0 X1\n"),
    ] {
        assert!(!taken(before, line), "{before}{line}");
    }
}

#[test]
fn a_time_counts_for_the_move_of_its_block() {
    let text = format!("{HEAD}G93\nG1 X1 F5\nX2 F6\nX3 F7\nM30\n");
    let out = read_with(settings(), true, text.as_bytes());
    let times = out.stmts.iter().filter_map(|stmt| match &stmt.op {
        ncc_ir::program::Op::SetFeedRate(feed) => feed.literal().map(|num| num.unit),
        _ => None,
    });
    let times: Vec<_> = times.collect();
    assert!(times.ends_with(&[ncc_ir::expr::num::Unit::One; 3]), "{times:?}");
    let text = format!("{HEAD}G93\nG1 X1 F5\nX2\nM30\n");
    let out = read_with(settings(), true, text.as_bytes());
    assert!(out.diagnostics.iter().any(|d| matches!(d.fault, ncc_ir::diag::Fault::NoFeed)));
}
