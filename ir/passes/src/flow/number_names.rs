//! `number-names`: procedures get numbers, where a target calls by number.
//!
//! A name that is a number of few enough digits stays. The others get the lowest numbers from 1001
//! on that nothing in the program has, nor the machine, in the order in which they stand; the name becomes the title,
//! if there is none, so that it is still read.

use std::collections::{BTreeMap, BTreeSet};

use crate::pass::{Pass, ProgramMoment, ProgramStep};
use crate::target::Target;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::lack::FlowLack;
use ncc_ir::program::{Op, Program, Stmt, Text};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;

/// This pass.
pub(crate) const PASS: Pass = Pass {
    name: "number-names",
    about: "gives subprograms numbers where the target calls by number",
    alone: Some(run),
    step: None,
    program: &[ProgramStep {
        moment: ProgramMoment::Names,
        needed: |_, _| true,
        run: |l, p| number_subprograms(p.program, &l.target, p.known.is_some(), p.diags),
    }],
    parametric: None,
};

/// First number that is given.
const FIRST: u32 = 1001;

/// Numbers them.
pub fn run(program: &mut Program, target: &Target, _: &Tracker, diags: &mut Vec<Diagnostic>) {
    number_subprograms(program, target, false, diags);
}

/// The same; `computes` is whether calls have variables of their own.
fn number_subprograms(program: &mut Program, target: &Target, computes: bool, diags: &mut Vec<Diagnostic>) {
    // No digits leave every name.
    let digits = target.caps.flow.call_digits;
    let fits = |name: &str| {
        name.bytes().all(|b| b.is_ascii_digit())
            && name.parse::<u32>().is_ok_and(|n| n > 0 && n < limit(digits))
    };
    // With variables of their own they may have names there; what a code calls has a number.
    let named =
        computes && target.caps.flow.computes.as_ref().is_some_and(|computes| computes.named_programs);
    let called = called_as_own(program, named);
    let fits = |name: &str| fits(name) || called.contains(name);
    let subs = || program.procedures.iter().skip(1);
    if digits == 0 || subs().all(|p| fits(&p.name)) {
        return;
    }
    let mut taken: BTreeSet<u32> = subs().filter_map(|p| p.name.parse().ok()).collect();
    taken.extend(program.name.number);
    taken.extend(&target.program_numbers);
    let mut free = (FIRST..limit(digits)).filter(|n| !taken.contains(n));
    let mut new: BTreeMap<Text, Text> = BTreeMap::new();
    for procedure in program.procedures.iter_mut().skip(1).filter(|p| !fits(&p.name)) {
        let at = procedure.body.first().map_or(Span::default(), |s| s.span);
        let Some(number) = free.next() else {
            let lack = FlowLack::SubprogramName { name: (*procedure.name).into() };
            diags.push(Diagnostic::new(Fault::lacks(lack), at));
            continue;
        };
        let name: Text = number.to_string().into();
        let old = std::mem::replace(&mut procedure.name, name.clone());
        diags.push(Diagnostic::new(Fault::NameChanged { from: old.clone(), to: name.clone() }, at));
        procedure.title.get_or_insert_with(|| old.clone());
        new.insert(old, name);
    }
    for procedure in &mut program.procedures {
        rename(&mut procedure.body, &new);
    }
}

/// Programs that no call shares its variables with, where those have names.
fn called_as_own(program: &Program, named: bool) -> BTreeSet<Text> {
    fn look(body: &[Stmt], shared: &mut BTreeSet<Text>) {
        for stmt in body {
            if let Op::Call(call) = &stmt.op {
                if call.shared {
                    shared.insert(call.name.clone());
                }
            } else if let Op::Control(control) = &stmt.op {
                control.bodies().for_each(|body| look(body, shared));
            }
        }
    }
    let mut shared = BTreeSet::new();
    if !named {
        return shared;
    }
    program.procedures.iter().for_each(|p| look(&p.body, &mut shared));
    let subs = program.procedures.iter().skip(1).map(|p| p.name.clone());
    subs.filter(|name| !shared.contains(name)).collect()
}

fn limit(digits: u32) -> u32 {
    10u32.saturating_pow(digits.min(8))
}

fn rename(body: &mut [Stmt], new: &BTreeMap<Text, Text>) {
    for stmt in body {
        match &mut stmt.op {
            Op::Call(call) => {
                if let Some(name) = new.get(&call.name) {
                    call.name = name.clone();
                }
            }
            Op::Control(control) => {
                for body in control.bodies_mut() {
                    rename(body, new);
                }
            }
            _ => {}
        }
    }
}
