//! Which open facts are tried with a program that is kept whole, and what runs with them show.
//!
//! Not here: forks beside the usual run (`forks`), and the usual run (`whole`).

use ncc_ir::behaviour::Behaviour;
use ncc_ir::program::{Op, Program, Stmt};

use super::ended::{Ended, by_target};
use super::forks::{Forks, Shown};
use super::verifier::{Other, Run, Stop, Verifier};
use super::whole::{Given, Gone, MOST_OF_SET, Set, To};

/// Events, and steps, of all runs with another fact than usual after which the fact is not tried further.
pub const MOST_WITH_FACT: [u64; 2] = [1_000_000, 20_000_000];

impl Verifier {
    /// Facts that are tried with a run, each another one than usual; one that is known to matter is not tried again.
    pub fn facts_of(&self, run: &Run, source: &Program) -> Vec<Other> {
        let sides = [(&run.source, self.open[0], true), (&run.target, self.open[1], false)];
        let facts = sides.into_iter().flat_map(|(exec, open, source)| {
            let open = Behaviour::ALL.iter().copied().filter(move |behaviour| open & behaviour.bit() != 0);
            open.flat_map(move |behaviour| {
                let values = exec.behaviours().others(behaviour);
                values.map(move |value| Other::Behaviour { behaviour, source, value })
            })
        });
        let optional = self.optional_stop && source.procedures.iter().any(|p| has_optional_stop(&p.body));
        let known = |other: &Other| self.matters.iter().any(|(known, _)| known == other);
        facts.chain(optional.then_some(Other::OptionalStop)).filter(|other| !known(other)).collect()
    }

    /// Runs both programs with a set of values, and forks beside that for open facts.
    pub fn whole_with_facts(
        &mut self,
        start: &Run,
        number: u32,
        sides: [&Program; 2],
        given: &Given,
    ) -> Result<(), Stop> {
        let mut forks = Forks::new(self.facts_of(start, sides[0]), self.reach);
        let mut run = start.clone();
        run.comparison.keep_pairs(false);
        let set = Set { number, most: self.reach[0], idle: Some(MOST_OF_SET.1) };
        // What the run comes to without another fact is known.
        let to: To = (&mut Gone::default(), &mut |_| {});
        let _ = self.run_both(&mut run, sides, given, set, to, Some(&mut forks));
        let unseen = forks.unseen(&run);
        for Shown { other, ended, run } in forks.shown {
            self.judge(ended, other, &run)?;
        }
        self.untried.append(&mut forks.left);
        self.run_apart(start, number, sides, given, unseen)
    }

    /// Runs both programs from the beginning with each of these facts, one at a time.
    pub fn run_apart(
        &mut self,
        start: &Run,
        number: u32,
        sides: [&Program; 2],
        given: &Given,
        facts: Vec<Other>,
    ) -> Result<(), Stop> {
        for other in facts {
            if self.matters.iter().any(|(known, _)| *known == other) {
                continue;
            }
            let mut run = start.clone();
            run.comparison.keep_pairs(false);
            run.take(other);
            let idle = (number > 0).then_some(MOST_OF_SET.1);
            let set = Set { number, most: self.reach[0], idle };
            let to: To = (&mut Gone::default(), &mut |_| {});
            let ended = self.run_both(&mut run, sides, given, set, to, None);
            if matches!(ended, Err(Ended::Enough(_))) {
                let at = run.source_events.first().map_or(self.last, |event| event.span);
                self.untried.push((other, at));
            }
            self.judge(ended, other, &run)?;
        }
        Ok(())
    }

    /// What a run with another fact has shown.
    pub fn judge(&mut self, ended: Result<(), Ended>, other: Other, run: &Run) -> Result<(), Stop> {
        match ended {
            Err(Ended::Target(difference)) if !other.explains(run) => return Err(Stop::Target(difference)),
            Err(Ended::Target(difference)) => self.matters.push((other, difference.span)),
            // So a difference is reported where the source leaves open what the target's control does.
            Err(Ended::Source(fault)) if by_target(&fault.fault) => {
                if !other.explains(run) {
                    return Err(Stop::Source(fault));
                }
                self.matters.push((other, fault.span));
            }
            Ok(()) if run.fed_otherwise().is_some() => {
                self.matters.extend(run.fed_otherwise().map(|at| (other, at)));
            }
            // The target's control stops at an arc that the source has made.
            Err(Ended::NotSo(fault)) if other.explains(run) => self.matters.push((other, fault.span)),
            Err(Ended::NotSo(fault)) => return Err(Stop::Source(fault)),
            // It cannot be executed so, or is long enough.
            Ok(()) | Err(Ended::Source(_) | Ended::Enough(_)) => {}
        }
        Ok(())
    }
}

/// Whether an optional stop stands anywhere in a body.
fn has_optional_stop(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::OptionalProgramStop => true,
        Op::Control(control) => control.bodies().any(|body| has_optional_stop(body)),
        _ => false,
    })
}
