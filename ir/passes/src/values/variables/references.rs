//! Parameters that are the caller's variables themselves, for a target without such: what a call gives them stands
//! before it, and restored after it.

use std::collections::HashMap;

use ncc_ir::expr::{Target, Var};
use ncc_ir::program::{Op, Program, Stmt, Text};

/// Takes them out of the heads and the calls. Their variables stay, as such that all procedures see.
pub(super) fn copied(program: &mut Program) {
    let mut references: HashMap<Text, Vec<Option<Var>>> = HashMap::new();
    for procedure in &mut program.procedures {
        if procedure.parameters.iter().all(|parameter| matches!(parameter, Var::Local(_))) {
            continue;
        }
        let own = |var: &Var| (!matches!(var, Var::Local(_))).then(|| var.clone());
        let places: Vec<Option<Var>> = procedure.parameters.iter().map(own).collect();
        let mut at = 0;
        procedure.kinds.retain(|_| {
            at += 1;
            places.get(at - 1).is_none_or(Option::is_none)
        });
        procedure.parameters.retain(|parameter| matches!(parameter, Var::Local(_)));
        references.insert(procedure.name.clone(), places);
    }
    if !references.is_empty() {
        program.procedures.iter_mut().for_each(|procedure| body(&mut procedure.body, &references));
    }
}

fn body(all: &mut Vec<Stmt>, references: &HashMap<Text, Vec<Option<Var>>>) {
    let mut at = 0;
    while at < all.len() {
        let stmt = &mut all[at];
        at += 1;
        if let Op::Control(control) = &mut stmt.op {
            control.bodies_mut().for_each(|inner| body(inner, references));
            continue;
        }
        let Op::Call(call) = &mut stmt.op else { continue };
        let Some(places) = references.get(&call.name) else { continue };
        let mut given = Vec::new();
        let mut kept = Vec::new();
        for (place, value) in std::mem::take(&mut call.arguments).into_iter().enumerate() {
            match places.get(place).and_then(Option::as_ref) {
                Some(var) => given.push((var.clone(), value)),
                None => kept.push(value),
            }
        }
        call.arguments = kept;
        let (span, skip) = (stmt.span, stmt.skip);
        let mut number = if given.is_empty() { None } else { stmt.number.take() };
        let mut joined = if given.is_empty() { stmt.joined } else { std::mem::take(&mut stmt.joined) };
        for (var, value) in given {
            let mut before = Stmt::new(span, Op::Assign(Target::Var(var), value));
            (before.number, before.skip) = (number.take(), skip);
            before.joined = std::mem::take(&mut joined);
            all.insert(at - 1, before);
            at += 1;
        }
        while let Some(behind) = all.get_mut(at) {
            if !(behind.joined && matches!(behind.op, Op::Assign(..))) {
                break;
            }
            behind.joined = false;
            at += 1;
        }
    }
}
