//! Messages to the operator, for a target that cannot show them, or only where the program stops.

use crate::caps::Caps;
use crate::computes::Said;
use crate::diag::{Diagnostic, Fault};
use crate::program::{Op, Piece, Program, Stmt};

/// Messages become comments; those with which the program stops stay where the target has them, in the block of the
/// stop or in the one before it. One without a text, which takes another back, is none where none stays.
pub(super) fn drop_messages(stmts: &mut [Stmt], with_stop: bool, diags: &mut Vec<Diagnostic>) {
    for at in 0..stmts.len() {
        let (before, behind) = stmts.split_at_mut(at + 1);
        let Some(stmt) = before.last_mut() else { continue };
        let Op::Message(text) = &mut stmt.op else { continue };
        let stops = behind.first().is_some_and(|next| next.op == Op::ProgramStop && next.skip == stmt.skip);
        if text.is_empty() {
            stmt.op = Op::Blank;
        } else if !(with_stop && stops) {
            let text = std::mem::take(text);
            diags.push(Diagnostic::new(Fault::MessageDropped, stmt.span));
            stmt.op = Op::Comment(text);
        }
    }
}

/// Messages with values become comments where the target shows no message while the program runs. What they read has no
/// effect on the cut.
pub fn leave_out_values(program: &mut Program, caps: &Caps, diags: &mut Vec<Diagnostic>) {
    let says = caps.computes.as_ref().is_some_and(|there| there.has(Said::Values));
    if !caps.messages && !says {
        program.procedures.iter_mut().for_each(|procedure| values(&mut procedure.body, diags));
    }
}

fn values(stmts: &mut [Stmt], diags: &mut Vec<Diagnostic>) {
    for stmt in stmts {
        match &mut stmt.op {
            Op::MessageOf(pieces) => {
                let text: String = pieces
                    .iter()
                    .map(|piece| match piece {
                        Piece::Text(text) => text,
                        Piece::Value { .. } => "...",
                    })
                    .collect();
                diags.push(Diagnostic::new(Fault::MessageDropped, stmt.span));
                stmt.op = Op::Comment(text.into());
            }
            Op::Control(control) => control.bodies_mut().for_each(|stmts| values(stmts, diags)),
            _ => {}
        }
    }
}
