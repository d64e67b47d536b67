//! Messages to the operator, for a target that cannot show them, or only where the program stops.

use crate::diag::{Diagnostic, Fault};
use crate::program::{Op, Stmt};

/// Messages become comments; those with which the program stops stay where the target has them.
pub(super) fn drop_messages(stmts: &mut [Stmt], with_stop: bool, diags: &mut Vec<Diagnostic>) {
    for at in 0..stmts.len() {
        let next = stmts.get(at + 1);
        let stays = next.is_some_and(|next| next.joined && matches!(next.op, Op::ProgramStop));
        let stmt = &mut stmts[at];
        if let Op::Message(text) = &mut stmt.op
            && !(with_stop && stays)
        {
            let text = std::mem::take(text);
            diags.push(Diagnostic::new(Fault::MessageDropped, stmt.span));
            stmt.op = Op::Comment(text);
        }
    }
}
