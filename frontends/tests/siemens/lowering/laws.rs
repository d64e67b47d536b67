//! Laws: the short way and the grammar agree, pieces and the whole agree, no bytes make the reader
//! fail.

use proptest::prelude::*;

use super::*;

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

/// Nearly a plain move: what the short way takes, and what is only a sign away from it.
fn move_line() -> impl Strategy<Value = String> {
    let number = prop_oneof![
        6 => "-?[0-9]{1,4}\\.[0-9]{0,4}",
        4 => "-?[0-9]{1,4}",
        1 => "-?[0-9]{0,9}\\.?[0-9]{0,9}",
    ];
    let axis = (prop::sample::select(vec!["X", "Y", "Z", "x", "A"]), number.clone());
    let word = prop_oneof![
        8 => axis.prop_map(|(l, n)| format!("{l}{n}")),
        2 => number.prop_map(|n| format!("F{n}")),
        2 => prop::sample::select(vec!["G0", "G1", "G01", "g1", "G1.", "G00", "G-0", "G2", "G90", "G91", "G500"])
            .prop_map(String::from),
        1 => prop::sample::select(vec!["N5", "N-0", "N1.", "M8", "S5", "F0", "G70", "G71", "G700", "G94", "CR=5"])
            .prop_map(String::from),
    ];
    let lead = prop::sample::select(vec!["", "", "", "N10 ", " N20", "n3", "/", "/N4 ", "/2 "]);
    let blank = prop::sample::select(vec!["", " ", "\t"]);
    let tail = prop::sample::select(vec!["", "", "", " ", "\r", "\r ", ";c"]);
    (lead, prop::collection::vec(word, 1..6), blank, tail)
        .prop_map(|(l, w, b, t)| format!("{l}{}{t}", w.join(b)))
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_short_way_and_the_long_way_agree(
        lines in prop::collection::vec(prop_oneof![1 => line(), 3 => move_line()], 1..20),
        assume: bool,
    ) {
        let text = format!("{HEAD}{}\nX1. Y2.\nN5 Z-3\nM30\n", lines.join("\n"));
        let short = read_with(settings(), assume, text.as_bytes());
        // The other one is fed line by line, and every line goes through the grammar.
        let mut reader = Reader::new(settings(), assume);
        reader.grammar_alone();
        let mut long = Batch::default();
        let mut at = 0;
        for line in text.split_inclusive('\n') {
            reader.read(line.as_bytes(), at, &mut long);
            at += line.len() as u32;
        }
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
    // A feed in another unit than the lengths is told of; after a skipped block, what one that is
    // skipped with it finds in force must be looked at.
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
