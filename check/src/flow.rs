//! NC0811 to NC0814, as far as statements show them: calls and subprograms.

use std::collections::BTreeSet;

use ncc_ir::program::{Control, Op, Program, Stmt};
use ncc_ir::source::Span;

use crate::finding::{Finding, What};

/// Subprograms that nothing calls, from the main program on. `within` is false where blocks that were not
/// read may call them; then nothing is said.
pub fn never_called(program: &Program) -> Vec<Finding> {
    let mut called = BTreeSet::new();
    let mut open: Vec<&[Stmt]> = program.procedures.first().map(|p| p.body.as_slice()).into_iter().collect();
    while let Some(body) = open.pop() {
        calls(body, &mut |name| {
            let target = program.procedures.iter().skip(1).position(|p| *p.name == *name);
            if let Some(index) = target.map(|at| at + 1)
                && called.insert(index)
            {
                open.push(&program.procedures[index].body);
            }
        });
    }
    let left = program.procedures.iter().enumerate().skip(1).filter(|(index, _)| !called.contains(index));
    left.filter_map(|(_, procedure)| {
        let span = procedure.body.iter().map(|stmt| stmt.span).find(|span| *span != Span::default())?;
        Some(Finding::new(What::NeverCalled { name: procedure.name.clone() }, span))
    })
    .collect()
}

fn calls(body: &[Stmt], found: &mut dyn FnMut(&str)) {
    for stmt in body {
        match &stmt.op {
            Op::Call(call) => found(&call.name),
            Op::Control(control) => match &**control {
                Control::Repeat { body, .. }
                | Control::Loop { body }
                | Control::While { body, .. }
                | Control::For { body, .. } => calls(body, found),
                Control::If { then, otherwise, .. } => {
                    calls(then, found);
                    calls(otherwise, found);
                }
            },
            _ => {}
        }
    }
}
