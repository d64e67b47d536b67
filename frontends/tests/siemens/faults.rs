//! Blocks that are none: what is said, and where.

use ncc_ir::diag::Fault;

use super::*;

#[test]
fn signs() {
    check(&[
        ("X1 # Y2", "UnexpectedCharacter { found: '#' } at '#'"),
        ("X1 é", "UnexpectedCharacter { found: 'é' } at 'é'"),
        ("X1 ~", "UnexpectedCharacter { found: '~' } at '~'"),
        ("X1\rY2", "UnexpectedCharacter { found: '\\r' } at '\\r'"),
        ("N10 G3 G505_VAR=10", "UnexpectedCharacter { found: '_' } at '_'"),
        ("GOTOF _1", "UnexpectedCharacter { found: '_' } at '_'"),
        ("/12 X5", "OutOfRange { word: '/12' } at '/12'"),
    ]);
    assert_eq!(read(b"X1 \xC7"), "UnexpectedCharacter { found: 'Ç' } at '\u{fffd}'");
    let open = parse(b"MSG(\"A)  ", 0).expect_err("a text without its end");
    assert_eq!(open.0, Fault::Syntax { found: "\"A)".into(), expected: "\"".into() });
    assert_eq!((open.1.start, open.1.end), (4, 7));
    let open = parse(b"R1='A", 0).expect_err("a character without its end");
    assert_eq!(open.0, Fault::Syntax { found: "'A".into(), expected: "'".into() });
}

#[test]
fn words() {
    check(&[
        ("X", "Syntax { found: 'end of block', expected: 'a number' } at ''"),
        ("X1 2", "Syntax { found: '2', expected: 'a word' } at '2'"),
        ("X--1", "Syntax { found: '-', expected: 'a number' } at '-'"),
        ("5 X1", "Syntax { found: '5', expected: 'a block' } at '5'"),
        ("N10 N20 X5", "Syntax { found: 'N', expected: 'a statement' } at 'N'"),
        ("N10 /X5", "Syntax { found: '/', expected: 'a statement' } at '/'"),
        ("N1.5 X5", "PointNotAllowed { word: '1.5' } at 'N1.5'"),
        ("N99999999999", "OutOfRange { word: '99999999999' } at 'N99999999999'"),
        ("X1.=5", "PointNotAllowed { word: '1.' } at '1.'"),
        ("M1[10]=10", "Syntax { found: '[', expected: 'a word' } at '['"),
        ("X=", "Syntax { found: 'end of block', expected: 'an expression' } at ''"),
        ("X=AC 5", "Syntax { found: '5', expected: '(' } at '5'"),
        ("X=AC(5", "Syntax { found: 'end of block', expected: ')' } at ''"),
    ]);
}

#[test]
fn expressions() {
    check(&[
        ("R1=(1+", "Syntax { found: 'end of block', expected: 'an expression' } at ''"),
        ("R1=(1 ;c", "Syntax { found: 'end of block', expected: ')' } at ''"),
        ("R1=RR[1", "Syntax { found: 'end of block', expected: ']' } at ''"),
        ("R1=1 1", "Syntax { found: '1', expected: 'a word' } at '1'"),
    ]);
}

#[test]
fn statements() {
    check(&[
        ("IF", "Syntax { found: 'end of block', expected: 'an expression' } at ''"),
        ("IF R1 X5", "Syntax { found: 'X', expected: 'a jump' } at 'X'"),
        ("ELSE X5", "Syntax { found: 'X', expected: 'the end of the block' } at 'X'"),
        ("X5 ELSE", "Syntax { found: 'ELSE', expected: 'a word' } at 'ELSE'"),
        ("FOR R1=1", "Syntax { found: 'end of block', expected: 'TO' } at ''"),
        ("FOR R1=1 TO 5 STEP 2", "Syntax { found: 'STEP', expected: 'the end of the block' } at 'STEP'"),
        ("GOTOF", "Syntax { found: 'end of block', expected: 'an expression' } at ''"),
        ("REPEAT P=10 LBL", "Syntax { found: 'P', expected: 'a name' } at 'P'"),
        ("REPEAT LBL Q=10", "Syntax { found: 'Q', expected: 'P' } at 'Q'"),
        ("REPEATB L_1 L_2", "Syntax { found: 'L_2', expected: 'P' } at 'L_2'"),
        ("CASE R1 GOTOF AA", "Syntax { found: 'GOTOF', expected: 'OF' } at 'GOTOF'"),
        ("CALL", "Syntax { found: 'end of block', expected: 'an expression' } at ''"),
        ("CALL AA(1)", "Syntax { found: '(', expected: 'the end of the block' } at '(1)'"),
        ("PCALL", "Syntax { found: 'end of block', expected: 'a path' } at ''"),
        ("MCALL X5 Y5", "Syntax { found: 'Y', expected: '(' } at 'Y'"),
        ("DEF AA", "Syntax { found: 'end of block', expected: 'a type' } at ''"),
        ("PROC", "Syntax { found: 'end of block', expected: 'a name' } at ''"),
        ("DEFINE AA", "Syntax { found: 'end of block', expected: 'AS' } at ''"),
        ("CYCLE81(1,2", "Syntax { found: 'end of block', expected: ')' } at ''"),
        ("X5 WHEN R1 DO M5", "Syntax { found: 'WHEN R1 DO M5', expected: 'a word' } at 'WHEN R1 DO M5'"),
    ]);
}

#[test]
fn deep_brackets_are_no_danger() {
    let deep = |n: usize| read(format!("R1={}1{}", "(".repeat(n), ")".repeat(n)));
    assert!(deep(400).starts_with("R1 = group group"));
    assert!(deep(2000).starts_with("BlockTooLong { limit: 1000 }"));
    assert!(read(format!("R1={}1", "-".repeat(900))).starts_with("R1 = "));
}
