//! Blocks that are none: what is stated, and where.

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
        ("/12 X5", "OutOfRange { word: Word('/12') } at '/12'"),
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
        ("X", "Syntax { found: EndOfBlock, expected: Number } at ''"),
        ("X1 2", "Syntax { found: Text('2'), expected: Word } at '2'"),
        ("X--1", "Syntax { found: Text('-'), expected: Number } at '-'"),
        ("5 X1", "Syntax { found: Text('5'), expected: Block } at '5'"),
        ("N10 N20 X5", "Syntax { found: Text('N'), expected: Statement } at 'N'"),
        ("N10 /X5", "Syntax { found: Text('/'), expected: Statement } at '/'"),
        ("N1.5 X5", "PointNotAllowed { word: '1.5' } at 'N1.5'"),
        ("N99999999999", "OutOfRange { word: Word('99999999999') } at 'N99999999999'"),
        ("X1.=5", "PointNotAllowed { word: '1.' } at '1.'"),
        ("M1[10]=10", "Syntax { found: Text('['), expected: Word } at '['"),
        ("X=", "Syntax { found: EndOfBlock, expected: Expression } at ''"),
        ("X=AC 5", "Syntax { found: Text('5'), expected: Text('(') } at '5'"),
        ("X=AC(5", "Syntax { found: EndOfBlock, expected: Text(')') } at ''"),
    ]);
}

#[test]
fn expressions() {
    check(&[
        ("R1=(1+", "Syntax { found: EndOfBlock, expected: Expression } at ''"),
        ("R1=(1 ;c", "Syntax { found: EndOfBlock, expected: Text(')') } at ''"),
        ("R1=RR[1", "Syntax { found: EndOfBlock, expected: Text(']') } at ''"),
        ("R1=1 1", "Syntax { found: Text('1'), expected: Word } at '1'"),
    ]);
}

#[test]
fn statements() {
    check(&[
        ("IF", "Syntax { found: EndOfBlock, expected: Expression } at ''"),
        ("IF R1 X5", "Syntax { found: Text('X'), expected: Jump } at 'X'"),
        ("ELSE X5", "Syntax { found: Text('X'), expected: EndOfBlock } at 'X'"),
        ("X5 ELSE", "Syntax { found: Text('ELSE'), expected: Word } at 'ELSE'"),
        ("FOR R1=1", "Syntax { found: EndOfBlock, expected: Text('TO') } at ''"),
        ("FOR R1=1 TO 5 STEP 2", "Syntax { found: Text('STEP'), expected: EndOfBlock } at 'STEP'"),
        ("GOTOF", "Syntax { found: EndOfBlock, expected: Expression } at ''"),
        ("REPEAT P=10 LBL", "Syntax { found: Text('P'), expected: Name } at 'P'"),
        ("REPEAT LBL Q=10", "Syntax { found: Text('Q'), expected: Text('P') } at 'Q'"),
        ("REPEATB L_1 L_2", "Syntax { found: Text('L_2'), expected: Text('P') } at 'L_2'"),
        ("CASE R1 GOTOF AA", "Syntax { found: Text('GOTOF'), expected: Text('OF') } at 'GOTOF'"),
        ("CALL", "Syntax { found: EndOfBlock, expected: Expression } at ''"),
        ("CALL AA(1)", "Syntax { found: Text('('), expected: EndOfBlock } at '(1)'"),
        ("PCALL", "Syntax { found: EndOfBlock, expected: Path } at ''"),
        ("MCALL X5 Y5", "Syntax { found: Text('Y'), expected: Text('(') } at 'Y'"),
        ("DEF AA", "Syntax { found: EndOfBlock, expected: Type } at ''"),
        ("PROC", "Syntax { found: EndOfBlock, expected: Name } at ''"),
        ("DEFINE AA", "Syntax { found: EndOfBlock, expected: Text('AS') } at ''"),
        ("CYCLE81(1,2", "Syntax { found: EndOfBlock, expected: Text(')') } at ''"),
        ("X5 WHEN R1 DO M5", "Syntax { found: Text('WHEN R1 DO M5'), expected: Word } at 'WHEN R1 DO M5'"),
    ]);
}

#[test]
fn deep_brackets_are_no_danger() {
    let deep = |n: usize| read(format!("R1={}1{}", "(".repeat(n), ")".repeat(n)));
    assert!(deep(400).starts_with("R1 = group group"));
    assert!(deep(2000).starts_with("BlockTooLong { limit: 1000 }"));
    assert!(read(format!("R1={}1", "-".repeat(900))).starts_with("R1 = "));
}
