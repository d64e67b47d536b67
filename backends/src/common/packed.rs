//! Packed moves, written as whole blocks, some at a time.

use ncc_ir::program::packed::PackedLines;
use ncc_ir::program::{Op, Stmt};

/// Moves that are unpacked at once.
const AT_ONCE: usize = 512;

/// The packed moves of a statement.
pub(crate) fn packed(stmt: &Stmt) -> Option<&PackedLines> {
    let Op::Lines(lines) = &stmt.op else { return None };
    Some(lines)
}

/// Passes the blocks of packed moves to a writer, some at a time.
pub(crate) fn each_blocks(lines: &PackedLines, mut write: impl FnMut(&[Stmt])) {
    let mut rest = lines.unpack().peekable();
    let mut some = Vec::with_capacity(AT_ONCE);
    while rest.peek().is_some() {
        some.clear();
        some.extend(rest.by_ref().take(AT_ONCE));
        some.extend(std::iter::from_fn(|| rest.next_if(|stmt| stmt.joined)));
        write(&some);
    }
}
