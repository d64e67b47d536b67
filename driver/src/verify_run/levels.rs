//! Settings of block skip: one execution a setting, begun where a level is first met.

use ncc_ir::program::{Op, Stmt};

use super::differences::different;
use super::facts::{stopped, tries_facts};
use super::verifier::{ALL_SETTINGS, MOST_LEVELS, Run, Stop, Verifier};

/// Runs of which more do not keep their events for each other.
const MANY_RUNS: usize = 8;

impl Verifier {
    /// Adds the settings that a new level of block skip makes.
    pub(super) fn fork(&mut self, levels: u16) {
        let new = levels & !self.levels;
        for level in (1..=u32::from(MOST_LEVELS)).filter(|l| new & 1 << l != 0) {
            let bit = 1u16 << level;
            let first = self.levels == 0;
            let all = self.levels;
            self.levels |= bit;
            if self.one_level && !first {
                let all = self.runs.iter_mut().chain(&mut self.others);
                for run in all.filter(|run| run.skip != 0) {
                    run.skip |= bit;
                    run.source.set_skip(run.skip);
                }
                continue;
            }
            let many = self.levels.count_ones() > ALL_SETTINGS;
            let keeps = |skip: u16| !many || skip.count_ones() <= 1 || skip == all;
            let target = |skip| if self.one_level { 1 << 1 } else { skip };
            let further = |runs: &[Run]| -> Vec<Run> {
                runs.iter().filter(|run| keeps(run.skip)).map(|run| run.skipping(bit, target)).collect()
            };
            let (further, mut others) = (further(&self.runs), further(&self.others));
            others.retain(|run| tries_facts(run.skip, self.levels));
            self.others.extend(others);
            self.runs.extend(further);
        }
    }

    /// Executes what was read back in all runs, and compares. With many settings the events of all runs would need much
    /// memory at once: a run whose events no run with another fact takes is compared as soon as it has them.
    pub(super) fn compare_read(&mut self) -> Result<(), Stop> {
        let many = self.runs.len() > MANY_RUNS;
        let taken =
            |run: &Run| self.others.iter().any(|other| (other.seed, other.skip) == (run.seed, run.skip));
        let waits: Vec<bool> = self.runs.iter().map(|run| !many || taken(run)).collect();
        let mut differs = None;
        for (at, waits) in waits.iter().enumerate() {
            self.step_target(at)?;
            // Where another text cannot be executed at all, that goes before a difference.
            if !waits && differs.is_none() {
                differs = self.compare_run(at).err().map(|stop| (at, stop));
                let run = &mut self.runs[at];
                run.source_events.shrink_to_fit();
                run.target_events.shrink_to_fit();
            }
        }
        self.others_step(false)?;
        for at in (0..waits.len()).filter(|at| waits[*at]) {
            match (&differs, self.compare_run(at)) {
                (Some((first, _)), _) if *first < at => break,
                (_, compared) => compared?,
            }
        }
        differs.map_or(Ok(()), |(_, stop)| Err(stop))
    }

    /// Executes what was read back with the usual facts, in one run.
    fn step_target(&mut self, at: usize) -> Result<(), Stop> {
        let run = &mut self.runs[at];
        for stmt in &self.batch.stmts {
            let stepped = run.target.step(stmt, &mut run.target_events);
            stepped.map_err(|d| stopped(&d, run.source_events.get(run.target_events.len()), self.last))?;
        }
        Ok(())
    }

    fn compare_run(&mut self, at: usize) -> Result<(), Stop> {
        let run = &mut self.runs[at];
        let compared = run.comparison.advance(&mut run.source_events, &mut run.target_events, false);
        compared.map_err(|d| different(&d, run.source.unsaid(&self.own_facts), self.last))
    }

    /// Executes what was read back with the usual facts.
    pub(super) fn usual_target(&mut self) -> Result<(), Stop> {
        (0..self.runs.len()).try_for_each(|at| self.step_target(at))
    }

    /// Adds the settings of levels that the output has and the source has not. (A target with one
    /// level has no further ones.)
    pub(super) fn fork_for_target(&mut self, levels: &[u16]) {
        if !self.one_level {
            self.fork(levels.iter().fold(0, |all, level| all | level));
        }
    }
}

/// Levels of block skip that occur.
pub fn levels(stmts: &[Stmt]) -> u16 {
    let mut found = 0;
    for stmt in stmts {
        found |= stmt.skip.map_or(0, |level| 1u16 << level.min(MOST_LEVELS));
        if let Op::Control(control) = &stmt.op {
            found |= control.bodies().fold(0, |found, body| found | levels(body));
        }
    }
    found
}
