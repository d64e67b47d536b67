//! The blocks that a repetition executes again.

use std::ops::Range;

use ncc_ir::program::{Op, Stmt};

/// The blocks that a repetition at `at` executes again: from its label to itself, or to the end of
/// another label's block.
pub fn again<'p>(body: &'p [Stmt], at: usize, from: &str, to: Option<&str>) -> Option<&'p [Stmt]> {
    blocks_again(body, at, from, to).map(|blocks| &body[blocks])
}

/// Their places in the body.
pub(super) fn blocks_again(body: &[Stmt], at: usize, from: &str, to: Option<&str>) -> Option<Range<usize>> {
    let label =
        |name: &str| body[..at].iter().rposition(|s| matches!(&s.op, Op::Label(label) if **label == *name));
    let start = label(from)?;
    let end = match to {
        None => {
            // The repetition's own block is not executed again.
            (start..=at).rev().find(|&i| !body[i].joined)?.max(start)
        }
        Some(to) => {
            let last = label(to).filter(|last| *last >= start)?;
            let block = body[last + 1..at].iter().take_while(|s| s.joined).count();
            last + 1 + block
        }
    };
    Some(start..end)
}
