//! Expressions: the manual's table of priorities, constants, variables, functions.

use super::*;
use crate::siemens::text::tree::{Item, Statement, Value};

/// The text after `R1=`.
fn value(text: &str) -> String {
    let said = read(format!("R1={text}"));
    said.strip_prefix("R1 = ").map_or(said.clone(), str::to_owned)
}

fn values(table: &[(&str, &str)]) {
    for (text, said) in table {
        assert_eq!(value(text), *said, "{text}");
    }
}

/// Every operator of the table, strongest first.
const TABLE: &[&[(&str, &str)]] = &[
    &[("*", "Multiply"), ("/", "Divide"), ("DIV", "IntegerDivide"), ("MOD", "Modulo")],
    &[("+", "Add"), ("-", "Subtract")],
    &[("B_AND", "BitAnd")],
    &[("B_XOR", "BitXor")],
    &[("B_OR", "BitOr")],
    &[("AND", "And")],
    &[("XOR", "Xor")],
    &[("OR", "Or")],
    &[("<<", "Join")],
    &[
        ("==", "Equal"),
        ("<>", "NotEqual"),
        (">", "Greater"),
        ("<", "Less"),
        (">=", "GreaterOrEqual"),
        ("<=", "LessOrEqual"),
    ],
];

#[test]
fn priorities_are_the_manuals() {
    for (i, stronger) in TABLE.iter().enumerate() {
        for (a, said_a) in *stronger {
            for (b, said_b) in TABLE[i + 1..].iter().copied().flatten() {
                let right = value(&format!("AA {b} BB {a} CC"));
                assert_eq!(right, format!("(AA {said_b} (BB {said_a} CC))"), "{a} before {b}");
                let left = value(&format!("AA {a} BB {b} CC"));
                assert_eq!(left, format!("((AA {said_a} BB) {said_b} CC)"), "{a} before {b}");
            }
            for (b, said_b) in *stronger {
                let equal = value(&format!("AA {a} BB {b} CC"));
                assert_eq!(equal, format!("((AA {said_a} BB) {said_b} CC)"), "{a} and {b}");
            }
            for (sign, said) in [("NOT", "Not"), ("B_NOT", "BitNot"), ("-", "Negate")] {
                let first = value(&format!("{sign} AA {a} BB"));
                assert_eq!(first, format!("(({said} AA) {said_a} BB)"), "{sign} before {a}");
                let second = value(&format!("AA {a} {sign} BB"));
                assert_eq!(second, format!("(AA {said_a} ({said} BB))"), "{sign} before {a}");
            }
        }
    }
}

#[test]
fn comparisons_bind_weakest() {
    values(&[
        ("A1==1 AND B1==1", "((A1 Equal (1 And B1)) Equal 1)"),
        ("(A1==1) AND (B1==1)", "(group (A1 Equal 1) And group (B1 Equal 1))"),
        ("NOT A1==B1", "((Not A1) Equal B1)"),
        ("R_SPEED >= 100", "(R_SPEED GreaterOrEqual 100)"),
    ]);
}

#[test]
fn a_comparison_beside_a_logical_operation_is_doubtful() {
    let doubtful = |text: &str| {
        let line = format!("R1={text}");
        let block = parse(line.as_bytes(), 0).expect("a block");
        let Statement::Words { items, .. } = block.statement else { panic!("{text}") };
        let [Item::Set { value: Value::Expr(e), .. }] = &items[..] else { panic!("{text}") };
        e.doubtful_comparison().map(|s| line[s.start as usize..s.end as usize].to_owned())
    };
    assert_eq!(doubtful("AA==1 AND BB==1").as_deref(), Some("AA==1 AND BB==1"));
    assert_eq!(doubtful("SIN(AA[1 OR R2>3])").as_deref(), Some("1 OR R2>3"));
    assert_eq!(doubtful("2*(NOT AA<>BB)").as_deref(), Some("NOT AA<>BB"));
    assert_eq!(doubtful("(AA==1) AND (BB==1)"), None);
    assert_eq!(doubtful("AA==1+BB"), None);
    assert_eq!(doubtful("AA==(1 AND BB)"), None);
}

#[test]
fn constants() {
    values(&[
        ("10", "10"),
        ("10.", "10."),
        (".5", "0.5"),
        ("-.5", "-0.5"),
        ("+5", "5"),
        ("1EX5", "100000."),
        ("-.1EX-3", "-0.0001"),
        ("2.5ex+2", "250."),
        ("1200EX-2", "12."),
        ("0EX400", "0."),
        ("'H1F'", "bits 31"),
        ("'h0a'", "bits 10"),
        ("'B1011'", "bits 11"),
        ("'A'", "'A'"),
        ("'H'", "'H'"),
        ("\"A \"\"quoted\"\" text\"", "\"A \"\"quoted\"\" text\""),
        ("\"\"", "\"\""),
        ("1+1-1+-1", "(((1 Add 1) Subtract 1) Add -1)"),
        ("-2/3", "(-2 Divide 3)"),
        ("--2", "2"),
    ]);
}

#[test]
fn numbers_that_are_none() {
    values(&[
        ("1234567890123456789", "BadNumber { text: '1234567890123456789' } at '1234567890123456789'"),
        ("1EX18", "BadNumber { text: '1EX18' } at '1EX18'"),
        ("1EX-19", "BadNumber { text: '1EX-19' } at '1EX-19'"),
        ("1EX99999999999", "BadNumber { text: '1EX99999999999' } at '1EX99999999999'"),
        ("'HXY'", "BadNumber { text: ''HXY'' } at ''HXY''"),
        ("'B12'", "BadNumber { text: ''B12'' } at ''B12''"),
        ("'H+1'", "BadNumber { text: ''H+1'' } at ''H+1''"),
        ("'HFFFFFFFFFFFFFFFFF'", "BadNumber { text: ''HFFFFFFFFFFFFFFFFF'' } at ''HFFFFFFFFFFFFFFFFF''"),
        ("''", "BadNumber { text: '''' } at ''''"),
        ("1.2.3", "Syntax { found: Text('.3'), expected: Word } at '.3'"),
    ]);
}

#[test]
fn variables_and_functions() {
    values(&[
        ("R2", "R2"),
        ("R[R2+1]", "R[(R2 Add 1)]"),
        ("_FELD[nn,m,o]", "_FELD[nn, M, O]"),
        ("$P_UIFR[1,X,TR]", "$P_UIFR[1, X, TR]"),
        ("$AA_IM[X1]", "$AA_IM[X1]"),
        ("$TC_DP1[1,1]", "$TC_DP1[1, 1]"),
        ("ATAN2(3,-R4)", "ATAN2(3, (Negate R4))"),
        ("SIN(30)*(R2-1)", "(SIN(30) Multiply group (R2 Subtract 1))"),
        ("CTRANS(X,10,Y,20):CROT(Z,30)", "(CTRANS(X, 10, Y, 20) Chain CROT(Z, 30))"),
        ("$P_UIFR:$P_PFRAME:CFINE(X,1)", "(($P_UIFR Chain $P_PFRAME) Chain CFINE(X, 1))"),
        ("SET(0,,,9)", "SET(0, _, _, 9)"),
        ("REP(1,24)", "REP(1, 24)"),
        ("TRUE", "TRUE"),
        ("\"N\"<<R1<<\"X\"", "((\"N\" Join R1) Join \"X\")"),
        ("1+CTRANS(X,1):CROT(Z,2)", "Syntax { found: Text(':'), expected: Word } at ':'"),
    ]);
}
