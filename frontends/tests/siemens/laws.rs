//! Laws: no bytes make the parser fail, places stay within the line, and the recogniser of plain
//! blocks sees the words that the grammar sees.

use proptest::prelude::*;

use super::*;
use crate::common::fast_parse;
use crate::siemens::text::tree::{Item, Statement};

/// Pieces of lines.
fn piece() -> impl Strategy<Value = String> {
    let words = "IF ELSE FOR TO REPEAT REPEATB UNTIL CASE OF DEFAULT GOTOF GOTOS CALL BLOCK PCALL MCALL \
        DEF REAL STRING PROC EXTERN VAR DEFINE AS WHEN DO ID NOT AND XOR B_OR DIV AC IC SET TRANS SUPA \
        CYCLE81 LBL LBL: R1 X Y1 N10 N :120 $P_EP \"A;b\" \" 'H1F' 'x ' = + - * / ( ) [ ] , : ; << < >= == & \
        1 2.5 .5 1EX5 1EX99 12345678901234567890 /2 % _ # ~";
    let pieces: Vec<&str> = words.split_ascii_whitespace().collect();
    (prop::sample::select(pieces), prop::sample::select(vec!["", " ", " "]))
        .prop_map(|(p, b)| format!("{p}{b}"))
}

/// Something like a plain block.
fn plain_line() -> impl Strategy<Value = String> {
    let letter = prop::sample::select("XYZGMFSTIJKRPABCDHLxyzgUE".chars().collect::<Vec<_>>());
    let number = prop_oneof!["-?[0-9]{1,4}\\.[0-9]{0,4}", "-?[0-9]{1,3}", "-?\\.[0-9]{1,3}", "[0-9]{17,20}"];
    let blank = prop::sample::select(vec!["", " ", "\t"]);
    let word = (letter, number, blank).prop_map(|(l, n, b)| format!("{l}{n}{b}"));
    let tail = prop::sample::select(vec!["", "", "", ";", "=5", "X", "\r\n", "\n"]);
    (prop::collection::vec(word, 1..6), tail).prop_map(|(w, t)| w.concat() + t)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn no_bytes_make_the_parser_fail(
        line in prop_oneof![
            prop::collection::vec(any::<u8>(), 0..200),
            prop::collection::vec(piece(), 0..20).prop_map(|p| p.concat().into_bytes()),
        ],
        base in prop::sample::select(vec![0u32, 77]),
    ) {
        let end = base + line.len() as u32;
        let inside = |span: ncc_ir::source::Span| base <= span.start && span.start <= span.end && span.end <= end;
        match parse(&line, base) {
            Ok(block) => {
                prop_assert!(inside(block.span));
                prop_assert!(block.comment.is_none_or(|c| inside(c) && block.span.end < c.start));
                // Every place is within the line, or this would fail.
                show::Show { line: &line, base }.block(&block);
            }
            Err((_, span)) => prop_assert!(inside(span), "{span:?}"),
        }
        if let Err((_, span)) = unit::line(&line, base) {
            prop_assert!(inside(span));
        }
    }

    #[test]
    fn recogniser_and_grammar_agree(line in plain_line()) {
        let mut words = Vec::new();
        let Some(end) = fast_parse::read(line.as_bytes(), 0, 7, &mut words) else {
            return Ok(());
        };
        let block = parse(line.trim_end_matches(['\r', '\n']).as_bytes(), 7).expect("a block");
        prop_assert!(end <= line.len());
        let Statement::Words { items, jumps } = block.statement else {
            return Err(TestCaseError::fail("no words"));
        };
        prop_assert!(jumps.is_empty() && block.comment.is_none() && block.number.is_none());
        let seen: Vec<Item> = words.into_iter().map(Item::Word).collect();
        prop_assert_eq!(items, seen);
    }
}
