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
        let Some(run) = self.runs.iter().find(leaves) else { return };
        let behaviours = [*run.source.behaviours(), *run.target.behaviours()];
        let at = run.source.filled_at().unwrap_or(self.last);
        if let Some(fault) = apart(run, behaviours) {
            self.notes.push(Diagnostic::new(fault, at));
            return;
        }
        let mut found = Vec::new();
        for behaviour in Behaviour::ALL.iter().copied().filter(|one| one.concern() == Concern::AtEnd) {
            for source in [true, false] {
                if self.open[usize::from(!source)] & behaviour.bit() == 0 {
                    continue;
                }
                for value in self.other_values(behaviour, source) {
                    let mut other = behaviours;
                    let side = &mut other[usize::from(!source)];
                    *side = side.with(behaviour, value);
                    if apart(run, other).is_some() {
                        found.push((Other::Behaviour { behaviour, source, value }, at));
                    }
                }
            }
        }
        self.matters.append(&mut found);
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
