//! What must hold of a whole program before it is rewritten or written.
//!
//! Not here: what only execution can find, such as calls without an end.

use crate::diag::{Diagnostic, Fault};
use crate::program::{Control, Op, Program, Stmt};

/// Calls of procedures that the program does not have, in the order of its text.
pub fn unknown_calls(program: &Program) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    for procedure in &program.procedures {
        within(program, &procedure.body, &mut found);
    }
    found
}

fn within(program: &Program, body: &[Stmt], found: &mut Vec<Diagnostic>) {
    for stmt in body {
        if let Op::Call(call) = &stmt.op
            && !program.procedures.iter().skip(1).any(|p| p.name == call.name)
        {
            found.push(Diagnostic::new(Fault::CallUnknown { name: call.name.clone() }, stmt.span));
        }
        if let Op::Control(control) = &stmt.op {
            match &**control {
                Control::Repeat { body, .. }
                | Control::Loop { body }
                | Control::While { body, .. }
                | Control::For { body, .. } => within(program, body, found),
                Control::If { then, otherwise, .. } => {
                    within(program, then, found);
                    within(program, otherwise, found);
                }
            }
        }
    }
}
