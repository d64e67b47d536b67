//! A program that runs twice in a row: both controls begin the next run alike.
//!
//! What a program leaves active at its end, and relies on before it says it itself, makes another program of its next
//! run. The executor knows both (`ncc_exec`, `left`), so that the second run is not executed.

use ncc_exec::Again;
use ncc_ir::behaviour::{Behaviour, Behaviours, Concern, Kept};
use ncc_ir::canon::Axis;
use ncc_ir::computed::free_variables::outliving_variables;
use ncc_ir::diag::{Diagnostic, Fault, ModeName};
use ncc_ir::expr::Var;
use ncc_ir::program::Program;
use ncc_ir::source::Span;
use ncc_passes::values::variables::renamed::Renamed;

use super::verifier::{Other, Outliving, Run, Verifier};

/// How far apart two starts count as one, nanos: what rounding to the digits of a control and turning leave.
const NEAR: u64 = 1_000_000;

/// The variables of a program that outlive its run, with what the output calls them.
pub fn outliving(source: &Program, renamed: &Renamed) -> Vec<Outliving> {
    let of = |(var, at, set): (Var, Span, bool)| {
        let there = renamed.target(&var).clone();
        Outliving { sides: [var, there], at, set }
    };
    outliving_variables(source).into_iter().map(of).collect()
}

impl Outliving {
    /// For how long source and target keep it, if that is not alike. What comes from elsewhere must be kept by the target
    /// as long as by the source; what the program leaves itself, no longer either.
    fn apart(&self, [from, to]: [Behaviours; 2]) -> Option<[Kept; 2]> {
        let [source, target] = [from.keeps(&self.sides[0]), to.keeps(&self.sides[1])];
        let apart = if self.set { source != target } else { source == Kept::Always && target < source };
        apart.then_some([source, target])
    }
}

/// Variables that are not kept alike, those together that each side keeps as long.
fn variables_apart<'o>(
    all: impl Iterator<Item = &'o Outliving>,
    behaviours: [Behaviours; 2],
) -> Vec<(Fault, Span)> {
    let mut groups: Vec<([Kept; 2], Vec<Box<str>>, Span)> = Vec::new();
    for one in all {
        let Some(kept) = one.apart(behaviours) else { continue };
        let name = one.sides[0].name().into();
        match groups.iter_mut().find(|group| group.0 == kept) {
            Some((_, names, _)) => names.push(name),
            None => groups.push((kept, vec![name], one.at)),
        }
    }
    let fault = |([source, target], names, at): ([Kept; 2], Vec<Box<str>>, Span)| {
        (Fault::NextRunVariables { names: names.into(), source, target }, at)
    };
    groups.into_iter().map(fault).collect()
}

impl Verifier {
    /// Tells where the next run of source and output would not begin alike, once both have ended.
    pub fn compare_next_runs(&mut self) {
        let Some(first) = self.runs.first() else { return };
        if let Some((fact, at)) = self.begins_otherwise() {
            self.notes.push(Diagnostic::new(Fault::BeginsOtherwise { fact }, at));
        }
        let behaviours = [*first.source.behaviours(), *first.target.behaviours()];
        let leaves = |run: &&Run| run.source.leaves_slots() || run.target.leaves_slots();
        let runs: Vec<&Run> = self.runs.iter().filter(leaves).collect();
        if runs.is_empty() && self.outliving.is_empty() {
            return;
        }
        let last = self.last;
        // With another setting of the block-skip switches a program may leave something else.
        let slots = |behaviours| {
            let told = |run: &&Run| Some((apart(run, behaviours)?, run.source.filled_at().unwrap_or(last)));
            runs.iter().find_map(told)
        };
        let usual = (slots(behaviours), variables_apart(self.outliving.iter(), behaviours));
        // Of a variable that others set, it is reported anyway that it must be given.
        let variables = |behaviours| variables_apart(self.outliving.iter().filter(|one| one.set), behaviours);
        let mut found = Vec::new();
        for (behaviour, source) in self.open_at_end() {
            for value in self.other_values(behaviour, source) {
                let mut other = behaviours;
                let side = &mut other[usize::from(!source)];
                *side = side.with(behaviour, value);
                let told = if usual.0.is_none() { slots(other) } else { None };
                let told =
                    told.or_else(|| variables(other).into_iter().next().filter(|_| usual.1.is_empty()));
                found.extend(told.map(|(_, at)| (Other::Behaviour { behaviour, source, value }, at)));
            }
        }
        let mut notes =
            usual.0.into_iter().chain(usual.1).map(|(fault, at)| Diagnostic::new(fault, at)).collect();
        self.notes.append(&mut notes);
        self.matters.append(&mut found);
    }

    /// What a program that begins again assumes of its start, which is not active where it begins again.
    fn begins_otherwise(&self) -> Option<(ModeName, Span)> {
        let mut found = self.runs.iter().filter_map(|run| run.source.begins_otherwise(&self.assumed));
        found.next()
    }

    /// Open facts of the end of a program that are looked at, and whether each is the source's.
    fn open_at_end(&self) -> impl Iterator<Item = (Behaviour, bool)> + use<> {
        let open = self.open;
        let at_end = Behaviour::ALL.iter().copied().filter(|one| one.concern() == Concern::AtEnd);
        at_end
            .flat_map(|behaviour| [(behaviour, true), (behaviour, false)])
            .filter(move |(behaviour, source)| open[usize::from(!source)] & behaviour.bit() != 0)
    }
}

/// The first thing that is not alike at the start of the next run.
fn apart(run: &Run, [from, to]: [Behaviours; 2]) -> Option<Fault> {
    let starts: [Again; 2] = [run.source.again(&from), run.target.again(&to)];
    Axis::ALL
        .into_iter()
        .find_map(|axis| {
            let [source, target] = starts.map(|start| start[0][axis as usize]);
            (source.abs_diff(target) > NEAR).then_some(Fault::NextRunShifted { axis, source, target })
        })
        .or_else(|| {
            let turned = starts[0]
                .iter()
                .flatten()
                .zip(starts[1].iter().flatten())
                .any(|(a, b)| a.abs_diff(*b) > NEAR);
            turned.then_some(Fault::NextRunTurned)
        })
}
