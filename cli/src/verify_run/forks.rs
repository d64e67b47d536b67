//! Runs of whole programs with another fact, from where the program comes to it until both are in one state again.
//!
//! A run from the beginning to the end for each open fact costs as much as the verification itself. Here one run goes
//! ahead as usual; where a statement comes to a fact, a run with its other value forks off and goes on beside it, by the
//! same steps of the program, until nothing is left of the difference.

use ncc_ir::exec::{Exec, Runner, touched};
use ncc_ir::program::{Program, Stmt};
use ncc_ir::source::Span;

use super::facts::Other;
use super::whole::{Ended, Given, MOST_OF_SET, MOST_WITH_FACT};
use super::{Run, Stop, Verifier, unreadable};

/// Steps of a program between two looks at forks.
const STEPS: u64 = 4096;

/// Steps of each program after which its forks are left alone: it is long enough.
const MOST_STEPS: u64 = 20_000_000;

/// Source and output on their ways.
#[derive(Clone)]
struct Lane<'p> {
    run: Run,
    runners: [Runner<'p>; 2],
    over: [bool; 2],
}

impl<'p> Lane<'p> {
    /// Whether nothing is left of what made it another one.
    fn is_as(&self, usual: &Lane<'p>) -> bool {
        let alike = |at: usize| self.runners[at].is_at(&usual.runners[at]);
        alike(0)
            && alike(1)
            && self.run.source.agrees(&usual.run.source)
            && self.run.target.agrees(&usual.run.target)
            && self.run.source_events == usual.run.source_events
            && self.run.target_events == usual.run.target_events
    }

    /// The next statement of one side, before so many steps; `at` is where the source stands.
    fn next(&mut self, side: usize, to: u64, at: Span) -> Result<Option<Stmt>, Ended> {
        let exec = if side == 0 { &self.run.source } else { &self.run.target };
        if self.over[side] || self.runners[side].steps() >= to {
            return Ok(None);
        }
        match self.runners[side].next(exec) {
            Ok(Some(stmt)) => Ok(Some(stmt.clone())),
            Ok(None) => {
                self.over[side] = true;
                Ok(None)
            }
            Err(fault) if side == 0 => Err(Ended::Source(fault)),
            Err(fault) => Err(Ended::target(unreadable(&fault, at))),
        }
    }

    /// Executes a statement of one side.
    fn step(&mut self, side: usize, stmt: &Stmt, at: Span) -> Result<(), Ended> {
        if side == 0 {
            return self.run.source.step(stmt, &mut self.run.source_events).map_err(Ended::Source);
        }
        let stepped = self.run.target.step(stmt, &mut self.run.target_events);
        stepped.map_err(|fault| Ended::target(unreadable(&fault, at)))
    }
}

impl Verifier {
    /// Forks runs off where one of these facts is come to. Those that are left in `facts` were not come to in a way that is
    /// seen before the statement: they are to be run as a whole.
    pub(super) fn fork_where_asked(
        &mut self,
        start: &Run,
        number: u32,
        sides: [&Program; 2],
        given: &Given,
        facts: &mut Vec<Run>,
    ) -> Result<(), Stop> {
        let wanted: Vec<Other> = facts.iter().filter_map(|run| run.other).collect();
        if wanted.is_empty() {
            return Ok(());
        }
        let mut usual = Lane { run: start.clone(), runners: sides.map(Runner::new), over: [false; 2] };
        usual.run.comparison.keep_pairs(false);
        usual.runners[0].give(&mut |var| given.value(var, start.seed, number));
        usual.runners[1].give(&mut |var| given.value_there(var, start.seed, number));
        if number > 0 {
            usual.runners.iter_mut().for_each(|runner| runner.limit_idle(MOST_OF_SET.1));
        }
        let (mut lanes, mut seen): (Vec<(Other, Lane)>, Vec<Other>) = (Vec::new(), Vec::new());
        let mut to = 0;
        while to < MOST_STEPS && usual.run.comparison.events < MOST_WITH_FACT {
            to += STEPS;
            for side in [0, 1] {
                loop {
                    let stmt = match usual.next(side, to, self.last) {
                        Ok(Some(stmt)) => stmt,
                        Ok(None) => break,
                        Err(_) => {
                            usual.over = [true; 2];
                            break;
                        }
                    };
                    let exec = if side == 0 { &usual.run.source } else { &usual.run.target };
                    let comes = comes_to(exec, &stmt);
                    for other in wanted.iter().filter(|other| comes & bit(**other, side) != 0) {
                        seen.push(*other);
                        let known = self.matters.iter().any(|(known, _)| known == other)
                            || lanes.iter().any(|(live, _)| live == other);
                        if !known {
                            let mut lane = usual.clone();
                            lane.run.take(*other);
                            match lane.step(side, &stmt, self.last) {
                                Ok(()) => lanes.push((*other, lane)),
                                Err(ended) => self.judge(Err(ended), *other, &lane.run)?,
                            }
                        }
                    }
                    if usual.step(side, &stmt, self.last).is_err() {
                        // What the program does alone was told of before.
                        usual.over = [true; 2];
                    }
                }
            }
            let over = usual.over == [true; 2];
            let compared = self.advance_run(&mut usual.run, over);
            for (other, mut lane) in std::mem::take(&mut lanes) {
                match self.go_on(&mut lane, to) {
                    Ok(false) if !lane.is_as(&usual) => lanes.push((other, lane)),
                    ended => self.judge(ended.map(|_| ()), other, &lane.run)?,
                }
            }
            if over || compared.is_err() {
                break;
            }
        }
        // What the usual run has come to the end of, its forks have not.
        for (other, mut lane) in lanes {
            let mut ended = Ok(false);
            while matches!(ended, Ok(false)) && to < MOST_STEPS {
                to += STEPS;
                ended = self.go_on(&mut lane, to);
            }
            self.judge(ended.map(|_| ()), other, &lane.run)?;
        }
        facts.retain(|run| run.other.is_none_or(|other| !seen.contains(&other)));
        Ok(())
    }

    /// Goes on to so many steps of each program; `true` is the end of both.
    fn go_on(&self, lane: &mut Lane, to: u64) -> Result<bool, Ended> {
        for side in [0, 1] {
            while let Some(stmt) = lane.next(side, to, self.last)? {
                lane.step(side, &stmt, self.last)?;
            }
        }
        let over = lane.over == [true; 2];
        if over {
            lane.run.source.end_of_text(&mut lane.run.source_events);
            lane.run.target.end_of_text(&mut lane.run.target_events);
        }
        self.advance_run(&mut lane.run, over).map_err(Ended::target)?;
        Ok(over)
    }
}

/// Facts that a statement comes to, a bit each.
fn comes_to(exec: &Exec, stmt: &Stmt) -> u64 {
    touched(&stmt.op) | exec.comes_to(std::slice::from_ref(stmt))
}

/// The bit of a fact of one side.
fn bit(other: Other, side: usize) -> u64 {
    match other {
        Other::Behaviour { behaviour, source, .. } if source == (side == 0) => behaviour.bit(),
        Other::Behaviour { .. } | Other::OptionalStop => 0,
    }
}
