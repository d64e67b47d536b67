//! Blocks that are executed again by their numbers.

use ncc_ir::expr::Expr;
use ncc_ir::program::{Op, RepeatBlocks};

use super::*;

const PASSES: &str =
    "G91\nN10G1Z-1.\nN20X10.\nN30X-10.;back\nX5.\n/H10E30L3\nG90\nN40X0.\nN50H40E40L1\nG80\nM2\n";

/// The repetitions of a text.
fn repeats(out: &Batch) -> Vec<RepeatBlocks> {
    let repeat = |stmt: &ncc_ir::program::Stmt| match &stmt.op {
        Op::RepeatBlocks(repeat) => Some((**repeat).clone()),
        _ => None,
    };
    out.stmts.iter().filter_map(repeat).collect()
}

fn blocks(from: u32, to: u32, times: u32) -> RepeatBlocks {
    let label = |number: u32| format!("BLOCK{number}").into();
    RepeatBlocks { from: label(from), to: Some(label(to)), times: Expr::int(times.into()) }
}

#[test]
fn passes_after_the_first_or_all_of_them() {
    let text = head("mach9").to_owned() + PASSES;
    let again = read("mach9", &text);
    assert!(again.whole);
    assert_eq!(repeats(&again), [blocks(10, 30, 3), blocks(40, 40, 1)]);
    let mut total = settings("mach9");
    total.choose("repeat_count", "total").expect("an option");
    let total = read_with(total, true, text.as_bytes());
    assert_eq!(repeats(&total), [blocks(10, 30, 2), blocks(40, 40, 0)]);
}

#[test]
fn pieces_and_the_whole_agree() {
    let text = head("mach9").to_owned() + PASSES;
    let whole = read("mach9", &text);
    let mut reader = Reader::new(settings("mach9"), true);
    let (mut out, mut at) = (Batch::default(), 0);
    for line in text.split_inclusive('\n') {
        reader.read(line.as_bytes(), at, &mut out);
        at += line.len() as u32;
    }
    reader.finish(&mut out);
    assert_eq!(out.stmts, whole.stmts);
    assert_eq!(out.diagnostics, whole.diagnostics);
}

#[test]
fn what_blocks_put_in_force_for_themselves_is_found_out() {
    let other = |piece: &str| {
        let found = faults("mach9", piece);
        found.iter().any(|fault| fault.contains("Call(RepeatModes)"))
    };
    // The second time the blocks begin under the motion at feed.
    assert!(other("N10X5.\nN20G1X10.\nH10E20L1\nM2\n"));
    assert!(!other("N10G0X5.\nN20G1X10.\nH10E20L9\nM2\n"));
    // The mode between the blocks and the repetition counts too.
    assert!(other("N10G0X5.\nN20G1X10.\nG91\nH10E20L1\nM2\n"));
}
