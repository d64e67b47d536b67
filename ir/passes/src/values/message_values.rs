//! `message_values`: values in messages with the digits that the target has, and reported: `-1.25` on a control that leaves
//! out the zeros at their end is `-1.250000` on one that does not. Whole numbers stand as they are on both.
//!
//! Not here: values that are no variables, which are given to one before (`control_forms`).

use crate::pass::Pass;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::{Op, Piece, Program, Stmt};
use ncc_ir::source::Span;

/// This pass.
pub(crate) const PASS: Pass = Pass::parametric(
    "message-values",
    "shows values in messages with all their digits",
    |own, _| own.target.values_in_full.is_some(),
    |program, own, found| {
        if let Some(digits) = own.target.values_in_full {
            run(program, digits, found);
        }
    },
);

/// Says the values of a program's messages with so many digits after the point.
pub fn run(program: &mut Program, digits: u8, diags: &mut Vec<Diagnostic>) {
    let mut first = None;
    for procedure in &mut program.procedures {
        body(&mut procedure.body, digits, &mut first);
    }
    diags.extend(first.map(|at| Diagnostic::new(Fault::ValuesInFull { digits }, at)));
}

fn body(stmts: &mut [Stmt], in_full: u8, first: &mut Option<Span>) {
    for stmt in stmts {
        match &mut stmt.op {
            Op::MessageOf(pieces) => {
                for piece in pieces {
                    let Piece::Value { digits, short, .. } = piece else { continue };
                    if std::mem::take(short) && *digits > 0 {
                        *digits = in_full;
                        first.get_or_insert(stmt.span);
                    }
                }
            }
            Op::Control(control) => control.bodies_mut().for_each(|stmts| body(stmts, in_full, first)),
            _ => {}
        }
    }
}
