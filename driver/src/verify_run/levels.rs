//! Settings of block skip: one execution a setting, begun where a level is first met.

use ncc_ir::program::{Op, Stmt};

use super::facts::tries_facts;
use super::verifier::{ALL_SETTINGS, MOST_LEVELS, Run, Verifier};

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
