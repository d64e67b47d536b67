//! A program that runs twice in a row: both controls begin the next run alike.
//!
//! What a program leaves in force at its end, and relies on before it says it itself, makes another program of its next
//! run. The executor knows both (`ncc_ir::exec`, `left`), so that the second run is not executed.

use ncc_ir::behaviour::{Behaviour, Behaviours, Concern};
use ncc_ir::canon::Axis;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::exec::Again;

use super::facts::Other;
use super::{Run, Verifier};

/// How far apart two starts count as one, nanos: what rounding to the digits of a control and turning leave.
const NEAR: u64 = 1_000_000;

impl Verifier {
    /// Tells where the next run of source and output would not begin alike, once both have ended.
    pub(super) fn compare_next_runs(&mut self) {
        let leaves = |run: &&Run| run.source.leaves_slots() || run.target.leaves_slots();
        let runs: Vec<&Run> = self.runs.iter().filter(leaves).collect();
        let Some(first) = runs.first() else { return };
        let behaviours = [*first.source.behaviours(), *first.target.behaviours()];
        let last = self.last;
        // With another setting of the block-skip switches a program may leave something else.
        let first_apart = |behaviours| {
            let told = |run: &&Run| Some((apart(run, behaviours)?, run.source.filled_at().unwrap_or(last)));
            runs.iter().find_map(told)
        };
        let mut notes = Vec::new();
        let mut found = Vec::new();
        if let Some((fault, at)) = first_apart(behaviours) {
            notes.push(Diagnostic::new(fault, at));
        } else {
            for (behaviour, source) in self.open_at_end() {
                for value in self.other_values(behaviour, source) {
                    let mut other = behaviours;
                    let side = &mut other[usize::from(!source)];
                    *side = side.with(behaviour, value);
                    let told = first_apart(other);
                    found.extend(told.map(|(_, at)| (Other::Behaviour { behaviour, source, value }, at)));
                }
            }
        }
        self.notes.append(&mut notes);
        self.matters.append(&mut found);
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
