//! Whose variables a called program has, in a text that is read in pieces.

use ncc_ir::program::Op;

use super::*;

/// The programs that the main one calls, and whether each has its caller's variables.
fn calls(text: &str) -> Vec<(String, bool)> {
    let mut reader = Reader::new(settings("fanuc"), true);
    let (mut out, mut at) = (Batch::default(), 0);
    for line in text.split_inclusive('\n') {
        reader.read(line.as_bytes(), at, &mut out);
        at += line.len() as u32;
    }
    reader.finish(&mut out);
    let call = |stmt: &ncc_ir::program::Stmt| match &stmt.op {
        Op::Call(call) => Some((call.name.to_string(), call.shared)),
        _ => None,
    };
    out.stmts.iter().filter_map(call).collect()
}

#[test]
fn a_macro_call_has_variables_of_its_own_wherever_the_first_one_is_named() {
    let text = "M98 P2\nG65 P3\nM98 P2\nM30\nO0002\n#1=2\nM99\nO0003\nM99\n";
    let one = |name: &str, shared| (name.to_owned(), shared);
    assert_eq!(calls(text), [one("2", true), one("3", false), one("2", true)]);
}

#[test]
fn calls_beside_jumps_have_their_callers_variables_though_none_is_named() {
    let text = "M98 P2\nGOTO 5\nN5 M98 P2\nM30\nO0002\nM99\n";
    assert_eq!(calls(text), [("2".to_owned(), true), ("2".to_owned(), true)]);
    let plain = "M98 P2\nM98 P2\nM30\nO0002\nM99\n";
    assert_eq!(calls(plain), [("2".to_owned(), false), ("2".to_owned(), false)]);
}
