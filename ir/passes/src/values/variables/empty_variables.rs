//! Which local variables have a value, on every path to where they are read; and what the program decides by that.
//!
//! A control that knows empty variables leaves their words out, and tells them from zero. For one that does
//! not, what is the same on every path is decided here: a comparison with nothing holds or does not, a word without a
//! value is no word. What is one thing on one way and another on the next is refused at its place.
//!
//! The ways are those of the text: through branches, loops and jumps, into what is called, with the arguments of all
//! calls together, and with its caller's variables once for each call. A block that may be skipped gives nothing for
//! sure. Not followed: what common variables have; whether they have a value is the same question in both programs.

use std::collections::{BTreeMap, HashMap};

use crate::values::variables::defaults;
use ncc_ir::computed::free_variables::free_variables;
use ncc_ir::diag::Diagnostic;
use ncc_ir::expr::{Expr, Var};
use ncc_ir::program::valid::not_called;
use ncc_ir::program::{Procedure, Program, Text};

mod apart;
mod elsewhere;
pub(super) mod may;
mod settle;
mod ways;

use apart::Apart;
use may::{Known, May, calls, is_nothing};
use settle::Settle;
use ways::Ways;

pub use elsewhere::{Question, questions};

/// Which controls know empty variables.
#[derive(Clone, Copy, Debug)]
pub(super) struct Vacant {
    /// The target's does: only what must have a value is looked at.
    pub(super) target: bool,
    /// The source's does: the main program's own variables that it reads unset may have been given values, and may
    /// not, as a macro is called with arguments.
    pub(super) source: bool,
}

/// Decides what a program decides by whether variables have a value.
///
/// # Errors
/// A variable that may or may not have a value where it is read.
pub(super) fn resolve(
    program: &mut Program,
    vacant: Vacant,
    diags: &mut Vec<Diagnostic>,
) -> Result<(), Diagnostic> {
    if vacant.target {
        return settled(program, vacant).map_err(|unsure| unsure.refused);
    }
    defaults::hand_over(program);
    let mut first = None;
    let mut reported = Vec::new();
    loop {
        let Err(unsure) = settled(program, vacant) else {
            diags.append(&mut reported);
            return Ok(());
        };
        let refused = first.get_or_insert(unsure.refused);
        let Some(apart) = unsure.apart else { return Err(refused.clone()) };
        reported.extend(apart.reported);
        *program = apart.program;
    }
}

/// A variable that may or may not have a value where it is read.
struct Unsure {
    refused: Diagnostic,
    /// The program as it was with its macros apart, if one is called in several ways.
    apart: Option<Apart>,
}

/// Puts into a program what is known on all ways.
///
/// # Errors
/// A variable that may or may not have a value where it is read.
fn settled(program: &mut Program, vacant: Vacant) -> Result<(), Box<Unsure>> {
    let before = program.clone();
    let open = if vacant.source { free_variables(program) } else { Vec::new() };
    let own = open.iter().filter(|(var, _)| matches!(var, Var::Local(_)));
    let vars = own.map(|(var, _)| (Text::from(&*var.name()), May::Either)).collect();
    let mut entries = BTreeMap::from([(0, Known { vars, lost: false })]);
    if vacant.source {
        // What no call of this program leads to, other programs call, with values or without.
        let theirs = not_called(program).into_iter();
        entries.extend(theirs.map(|at| (at, elsewhere::begins(&program.procedures[at]))));
        elsewhere::parameters(&before, &entries)
            .map_err(|refused| Box::new(Unsure { refused, apart: None }))?;
    }
    if let (Some(known), Some(main)) = (entries.get_mut(&0), before.procedures.first()) {
        let parameters = main.parameters.iter().map(|own| (Text::from(&*own.name()), May::Number));
        known.vars.extend(parameters);
    }
    let mut ways = Ways::follow_paths(&before.procedures, entries);
    let facts = std::mem::take(&mut ways.facts);
    let entries = std::mem::take(&mut ways.entries);
    let mut refused = BTreeMap::new();
    for (at, procedure) in program.procedures.iter_mut().enumerate() {
        let was = &before.procedures[at].body;
        let mut settle = Settle { facts: &facts, vacant: vacant.target, decided: false };
        match settle.body(was, std::mem::take(&mut procedure.body)) {
            Ok(body) => procedure.body = body,
            Err(fault) => drop(refused.insert(at, fault)),
        }
    }
    let unsure: Vec<usize> = refused.keys().copied().collect();
    if let Some((_, refused)) = refused.pop_first() {
        return Err(Box::new(Unsure { refused, apart: apart::by_arguments(&before, &facts, unsure) }));
    }
    if !vacant.target {
        let handed = |procedure: &Procedure, at: usize| -> Vec<bool> {
            let entry = entries.get(&at);
            let has = |var: &Var| entry.is_none_or(|entry| entry.value_of(&var.name()) != May::Nothing);
            procedure.parameters.iter().map(has).collect()
        };
        let all = program.procedures.iter().enumerate().skip(1);
        let kept: HashMap<Text, Vec<bool>> = all.map(|(at, p)| (p.name.clone(), handed(p, at))).collect();
        for procedure in &mut program.procedures {
            if let Some(kept) = kept.get(&procedure.name) {
                let mut keep = kept.iter();
                procedure.parameters.retain(|_| keep.next().copied().unwrap_or(true));
                let mut keep = kept.iter();
                procedure.kinds.retain(|_| keep.next().copied().unwrap_or(true));
            }
            calls(&mut procedure.body, &mut |call| {
                let kept = kept.get(&call.name).map(Vec::as_slice).unwrap_or_default();
                let mut keep = kept.iter();
                call.arguments.retain(|_| keep.next().copied().unwrap_or(true));
                for argument in &mut call.arguments {
                    // Nothing reads it there.
                    if is_nothing(argument) {
                        *argument = Expr::int(0);
                    }
                }
            });
        }
    }
    Ok(())
}
