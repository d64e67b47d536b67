//! Where new blocks go: before the block of a code, or within it.

use ncc_ir::program::{Op, Stmt};

/// Where statements before a code go: before its block, where nothing of that happens before it but the selection of a
/// tool; else right before it.
pub(super) fn insertion(made: &[Stmt], stmt: &Stmt) -> usize {
    if !stmt.joined {
        return made.len();
    }
    let first = (0..made.len()).rev().find(|at| !made[*at].joined).unwrap_or(0);
    let selects = |op: &Op| {
        matches!(
            op,
            Op::SelectTool(_)
                | Op::SelectToolByName(_)
                | Op::Comment(_)
                | Op::Blank
                | Op::Message(_)
                | Op::MessageOf(_)
        )
    };
    match made[first..].iter().all(|stmt| selects(&stmt.op)) {
        true => first,
        false => made.len(),
    }
}

/// Puts new blocks in. A block that is cut there goes on in one of its own.
pub(super) fn insert(made: &mut Vec<Stmt>, stmt: &mut Stmt, at: usize, new: Vec<Stmt>) {
    if new.is_empty() {
        return;
    }
    if at == made.len() {
        stmt.joined = false;
    }
    made.splice(at..at, new);
}
