//! Specialises macros: one that branches on its arguments, and whose calls give different ones, becomes several,
//! one for each set of arguments. The first keeps the name, the others get names of their own, in the order of the calls.
//!
//! Left alone: a macro that sees its caller's variables, or calls itself; one whose calls do not tell by themselves which
//! arguments have values; and sets of arguments beyond a few.

use std::collections::BTreeSet;

use super::may::{May, calls, may};
use super::ways::{Facts, place};
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::{Call, Op, Program, Stmt, Text};
use ncc_ir::source::Span;

/// Most sets of arguments that one macro is written for.
const MOST_SETS: usize = 6;

/// Most programs that this may make of one program.
const MOST_PROGRAMS: usize = 100;

/// A call as the facts know it: the procedure that it stands in, and which arguments have values.
struct Given {
    from: usize,
    /// Nothing where no way leads to the call.
    set: Option<Vec<May>>,
}

/// A program with macros apart, and which were one.
pub(super) struct Apart {
    pub(super) program: Program,
    pub(super) reported: Vec<Diagnostic>,
}

/// The program with the macros apart that are `unsure` of a variable: nothing if none has calls that differ.
pub(super) fn by_arguments(program: &Program, facts: &Facts, mut unsure: Vec<usize>) -> Option<Apart> {
    let mut apart = program.clone();
    let mut names: BTreeSet<Text> = program.procedures.iter().map(|p| p.name.clone()).collect();
    names.extend(program.name.number.map(|n| n.to_string().into()));
    let mut reported = Vec::new();
    let mut next = 0;
    while let Some(&at) = unsure.get(next) {
        next += 1;
        let Some(given) = (at > 0).then(|| given(program, facts, at)).flatten() else { continue };
        // What a caller does not know of its own arguments.
        let open = |given: &&Given| given.set.iter().flatten().any(|may| *may == May::Either);
        let callers: Vec<usize> = given.iter().filter(open).map(|given| given.from).collect();
        if !callers.is_empty() {
            let new = callers.into_iter().filter(|from| *from != 0 && !unsure.contains(from));
            let new: BTreeSet<usize> = new.collect();
            unsure.extend(new);
            continue;
        }
        let mut sets: Vec<&Vec<May>> = Vec::new();
        for set in given.iter().filter_map(|given| given.set.as_ref()) {
            if !sets.contains(&set) {
                sets.push(set);
            }
        }
        if !(2..=MOST_SETS).contains(&sets.len()) {
            continue;
        }
        let name = program.procedures[at].name.clone();
        let mut own = vec![name.clone()];
        for _ in 1..sets.len() {
            own.push(crate::flow::specialise_procedures::free(&mut names, &name));
        }
        let mut of_calls = given.iter();
        for procedure in &mut apart.procedures {
            calls(&mut procedure.body, &mut |call| {
                if call.name == name
                    && let Some(Given { set: Some(set), .. }) = of_calls.next()
                    && let Some(which) = sets.iter().position(|known| *known == set)
                {
                    call.name.clone_from(&own[which]);
                }
            });
        }
        let head = program.procedures[at].body.first().map_or(Span::default(), |stmt| stmt.span);
        let fault = Fault::MacroCloned { name: (&*name).into(), names: own.join(", ").into() };
        reported.push(Diagnostic::new(fault, head));
        let copy = apart.procedures.iter().find(|p| p.name == name).cloned()?;
        for name in own.into_iter().skip(1) {
            let mut copy = copy.clone();
            copy.name = name;
            apart.procedures.push(copy);
        }
    }
    (!reported.is_empty() && apart.procedures.len() <= MOST_PROGRAMS)
        .then_some(Apart { program: apart, reported })
}

/// The calls of a procedure in the order of the text; nothing if it must stay one.
fn given(program: &Program, facts: &Facts, at: usize) -> Option<Vec<Given>> {
    let name = &program.procedures[at].name;
    let mut all = Vec::new();
    for (from, procedure) in program.procedures.iter().enumerate() {
        let mut alone = true;
        each(&procedure.body, &mut |stmt, call| {
            if call.name == *name {
                alone &= !call.shared && from != at;
                let set = facts.get(&place(stmt));
                let set = set.map(|known| call.arguments.iter().map(|value| may(value, known)).collect());
                all.push(Given { from, set });
            }
        });
        if !alone {
            return None;
        }
    }
    Some(all)
}

/// Shows every call of a body with its statement.
fn each<'p>(body: &'p [Stmt], seen: &mut dyn FnMut(&'p Stmt, &'p Call)) {
    for stmt in body {
        match &stmt.op {
            Op::Call(call) => seen(stmt, call),
            Op::Control(control) => control.bodies().for_each(|body| each(body, seen)),
            _ => {}
        }
    }
}
