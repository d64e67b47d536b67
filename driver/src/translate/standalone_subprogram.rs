//! A standalone subprogram: it returns to a program that is not there. What it assumes is what that
//! one has active, so that the output states none of it, and is read with the same.

use ncc_dialects::Dialect;
use ncc_ir::canon::Units;
use ncc_ir::caps::Caps;
use ncc_ir::computed::computes::{Handed, LETTERS};
use ncc_ir::computed::free_variables::free_variables;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{ArgumentCheck, Diagnostic, Fault};
use ncc_ir::expr::{Expr, Node, Var};
use ncc_ir::lack::{FlowLack, HolesLack};
use ncc_ir::program::valid::{begins_by_a_move, leaves_a_cycle, moves, returns_alone};
use ncc_ir::program::{Op, Program, Stmt, Text, Type};
use ncc_ir::run_time::RunTimeFlow;
use ncc_ir::source::Span;
use ncc_machines::reading::Told;
use ncc_passes::values::variables::questions;

use super::rewrite::FLATTEN;
use super::translation::Translation;
use crate::source::include_path;

impl Translation<'_> {
    /// Prepares for such a program; `true` where the target cannot say it (reported).
    pub(crate) fn is_refused_alone(&mut self, source: &Program) -> bool {
        let Some(at) = returns_alone(source) else { return false };
        let to = self.job.to.dialect;
        // One text of one subprogram, which a caller finds by the name of its file.
        let named = match self.handed() {
            Some(Handed::Names) => has_parameters(source) || source.procedures.len() == 1,
            Some(Handed::Places) => source.procedures.len() == 1,
            _ => false,
        };
        // What is a file of its own for a control that finds subprograms by their files stays one for another such.
        let files = |dialect: &Dialect| dialect.program.sub_extension.is_some();
        let ends = to.program.macro_b || files(to) && files(self.job.from.dialect);
        // What has been written already has stated modes, which would be the caller's from there on.
        if !ends && !named && !to.can.everything || self.written > 0 {
            self.take(vec![Diagnostic::new(Fault::lacks(FlowLack::ReturnWithoutMain), at)], Told::Writer);
            return true;
        }
        self.verify_here();
        if let Some(verifier) = &mut self.verifier {
            verifier.read_as_called(self.job, &source.assumed);
        }
        let stated = self.job.from.dialect.power_on.units.as_ref().is_some_and(|fact| fact.always);
        if let (Some(units), true) = (source.assumed.units, stated) {
            // The user has said it of the program, whose caller has it.
            let unit = if units == Units::Inch { "inch" } else { "mm" };
            let fault = Fault::AssumedFact { fact: ControlFact::CallersUnit { unit } };
            self.take(vec![Diagnostic::new(fault, at)], Told::Writer);
        }
        let main = source.procedures.first().map(|main| main.body.as_slice()).unwrap_or_default();
        if let (Some(Handed::Places), Some(at)) = (self.handed(), leaves_a_cycle(main)) {
            self.take(vec![Diagnostic::new(Fault::lacks(HolesLack::LeftForUnknownCaller), at)], Told::Writer);
            return true;
        }
        let moves_end_cycles = self.handed() == Some(Handed::Names)
            && named
            && self.job.from.dialect.program.macro_b
            && moves(main);
        if moves_end_cycles && !begins_by_a_move(main) {
            // A way without a move would leave it active.
            let fault = Fault::AssumedFact { fact: ControlFact::NoCycleOfCaller };
            self.take(vec![Diagnostic::new(fault, at)], Told::Writer);
        }
        self.legaliser.stands_alone();
        let name = self.called_by(source);
        self.output.set_called(name.clone());
        if let (Ok(number), Some(_)) = (name.parse(), self.job.to.dialect.program.main_number()) {
            self.batch.name.number.get_or_insert(number);
        }
        self.writer.stands_alone(&self.renumbering.modes(&source.assumed), moves_end_cycles, &name);
        false
    }

    /// How the target's subprograms have their parameters, where they have any.
    fn handed(&self) -> Option<Handed> {
        let target = self.job.to.caps().flow.computes.filter(|_| self.job.to.dialect.program.macros);
        target.map(|target| target.handed)
    }

    /// The name by which others call it: its own, its number, or that of its file.
    fn called_by(&self, source: &Program) -> Text {
        let own = source.procedures.first().map(|main| main.name.clone()).filter(|name| !name.is_empty());
        let number = || source.name.number.map(|number| number.to_string().into());
        let file = self.job.source_name.trim_start_matches('-');
        let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
        own.or_else(number).unwrap_or_else(|| include_path::program_in(self.job.from.dialect, stem))
    }

    /// A macro's arguments, which are variables of its calls by their letters, become parameters for a target that has
    /// them by name, and knows none without a value: each call must give them, which is reported.
    pub(crate) fn with_parameters(&mut self, mut source: Program) -> Program {
        self.by_letters(&mut source);
        let from = self.job.from.dialect.program.macro_b;
        let takes = matches!(self.handed(), Some(Handed::Names | Handed::Places));
        if !from || !takes || self.executes_computed() || source.procedures.len() != 1 {
            return source;
        }
        if returns_alone(&source).is_none() || has_parameters(&source) {
            return source;
        }
        let place = |var: &Var| match var {
            Var::Local(name) => name.parse().ok().filter(|n| LETTERS.iter().any(|(_, number)| number == n)),
            Var::Common(_) | Var::Retentive(_) | Var::System(_) => None,
        };
        let open = free_variables(&source).into_iter();
        let mut own: Vec<(u32, _, _)> = open.filter_map(|(var, at)| Some((place(&var)?, var, at))).collect();
        own.sort_by_key(|(number, ..)| *number);
        let number = source.name.number;
        if let Some(main) = source.procedures.first_mut() {
            main.parameters = own.iter().map(|(_, var, _)| var.clone()).collect();
            if let (true, Some(number)) = (main.name.is_empty(), number) {
                main.name = number.to_string().into();
            }
        }
        let asked = questions(&source);
        let mut told = Vec::new();
        for (place, (_, var, at)) in (1..).zip(own) {
            if self.job.given.may_be_vacant(&var.name()) {
                let what = RunTimeFlow::ArgumentEmpty { name: var.name().into() };
                told.push(Diagnostic::new(Fault::computes(what), at));
                continue;
            }
            let needed = |check| {
                let place = if self.handed() == Some(Handed::Places) { place } else { 0 };
                Fault::ArgumentNeeded { name: format!("#{}", var.name()).into(), place, check }
            };
            let checks = asked.iter().filter(|asked| *asked.name == *var.name());
            let checks: Vec<Diagnostic> = checks
                .map(|asked| {
                    let check = asked.default.map_or(ArgumentCheck::LeftOut, ArgumentCheck::Default);
                    Diagnostic::new(needed(check), asked.at)
                })
                .collect();
            if checks.is_empty() {
                told.push(Diagnostic::new(needed(ArgumentCheck::NotAsked), at));
            }
            told.extend(checks);
        }
        self.take(told, Told::Writer);
        self.verify_here();
        if let Some(verifier) = &mut self.verifier {
            verifier.answered(asked.into_iter().map(|asked| asked.at).collect());
        }
        source
    }

    /// Arguments by letters have no value where a call leaves them out, where those of the source are zero: each call must
    /// give them, which is reported; a number that no letter gives is refused.
    fn by_letters(&mut self, source: &mut Program) {
        let vacant = |caps: Caps| caps.flow.computes.is_some_and(|own| own.vacant);
        let alone = returns_alone(source).is_some();
        let Some(main) = source.procedures.first_mut().filter(|_| alone) else { return };
        if self.handed() != Some(Handed::Letters) || vacant(self.job.from.caps()) || self.executes_computed()
        {
            return;
        }
        let at = main.body.first().map_or(Span::default(), |stmt| stmt.span);
        let rounds = |caps: Caps| caps.flow.computes.is_some_and(|own| own.rounds);
        let rounded = rounds(self.job.to.caps()) && !rounds(self.job.from.caps());
        let whole: Vec<bool> =
            main.parameters.iter().map(|own| rounded && is_speed(&main.body, own)).collect();
        // It is given such numbers: what others come to is the call's.
        main.kinds.resize(main.parameters.len(), Type::Real);
        main.kinds
            .iter_mut()
            .zip(&whole)
            .filter(|(_, whole)| **whole)
            .for_each(|(kind, _)| *kind = Type::Int);
        let told = main.parameters.iter().zip(whole).map(|(own, whole)| {
            let number = own.name().parse::<u32>();
            let fault = match number {
                Ok(number) if LETTERS.iter().all(|(_, own)| *own != number) => {
                    Fault::computes(RunTimeFlow::ArgumentLetter { number })
                }
                _ => {
                    let name = if number.is_ok() { format!("#{}", own.name()) } else { own.name().into() };
                    let check = if whole { ArgumentCheck::Whole } else { ArgumentCheck::Nothing };
                    Fault::ArgumentNeeded { name: name.into(), place: 0, check }
                }
            };
            Diagnostic::new(fault, at)
        });
        let told = told.collect();
        self.take(told, Told::Writer);
    }

    /// One that is executed to be written as straight blocks has values for its parameters, and is a program by itself.
    pub(crate) fn by_itself(&self, mut source: Program) -> Program {
        let flat = self.job.passes.first().is_some_and(|pass| pass.name == FLATTEN);
        if flat && has_parameters(&source) {
            source.procedures.first_mut().into_iter().for_each(|main| end(&mut main.body));
        }
        source
    }
}

/// Whether a variable is stated as the spindle's speed.
fn is_speed(body: &[Stmt], var: &Var) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::SetSpindleSpeed(Expr::Node(speed)) => matches!(&**speed, Node::Var(own) if own == var),
        Op::Control(control) => control.bodies().any(|body| is_speed(body, var)),
        _ => false,
    })
}

fn has_parameters(source: &Program) -> bool {
    source.procedures.first().is_some_and(|main| !main.parameters.is_empty())
}

/// Ends a program where it returns.
fn end(body: &mut [Stmt]) {
    for stmt in body {
        match &mut stmt.op {
            Op::Return => stmt.op = Op::ProgramEnd,
            Op::Control(control) => control.bodies_mut().for_each(|body| end(body)),
            _ => {}
        }
    }
}
