//! Runs of whole programs with another fact, from where the program reaches it until both are in one state again.
//!
//! A run from the beginning to the end for each open fact costs as much as the verification itself. Here forks go beside
//! the usual run, which is made anyway: where a statement reaches a fact, a run with its other value forks off and goes
//! on by the same steps of the program, until nothing is left of the difference. What forks have shown is judged when
//! the usual runs are known to be the same.
//!
//! ```text
//! usual run   ...  M00  M03  G01 ...         the spindle turns at M00
//! fork             M00  M03 =                the spindle stops at M00; after M03 both are in one state
//! ```
//!
//! Not here: programs that stream (`facts`), and what a difference means ([`Verifier::judge`]).

use ncc_exec::{Exec, Halt, Progress, Runner};
use ncc_ir::diag::Diagnostic;
use ncc_ir::program::Stmt;
use ncc_ir::source::Span;

use super::ended::{Ended, PIECE, tells};
use super::facts::{OPTIONAL_STOP, come_to};
use super::verifier::{Other, Run, Verifier, unreadable};

/// Events of each side after which a new fork is looked at; twice as many from look to look.
const SOON: usize = 64;

/// Steps of a program between two looks at forks whose usual run is over.
const STEPS: u64 = 4096;

/// Source and output on their ways.
struct Lane<'p> {
    run: Run,
    runners: [Runner<'p>; 2],
    over: [bool; 2],
}

/// A run with another fact.
struct Fork<'p> {
    other: Other,
    /// The statement that reached the fact.
    at: Span,
    lane: Box<Lane<'p>>,
    /// Events and steps of the run where it forked off.
    from: [u64; 2],
}

/// What a fork has shown.
pub struct Shown {
    pub(crate) other: Other,
    pub(crate) ended: Result<(), Ended>,
    pub(crate) run: Run,
}

/// Forks of one usual run.
pub struct Forks<'p> {
    /// Facts that are tried, each another one than usual.
    wanted: Vec<Other>,
    /// Bits of facts of which a fork is to be made, of the source's statements and the target's.
    watched: [u64; 2],
    /// Runs with another fact from what was streamed before.
    carried: Vec<Run>,
    under_way: Vec<Fork<'p>>,
    /// Facts that statements reached.
    pub met: Vec<Other>,
    pub(crate) shown: Vec<Shown>,
    /// Facts that were not tried to the end, for that takes too long: where the program reached them.
    pub left: Vec<(Other, Span)>,
    /// Events and steps of forks that are over.
    spent: Vec<(Other, [u64; 2])>,
    /// Events and steps for which a fact is tried.
    reach: [u64; 2],
    /// Events of each side until the next look.
    soon: usize,
}

impl<'p> Lane<'p> {
    /// Whether nothing is left of what made it another one.
    fn is_as(&self, usual: &Run, runners: &[Runner<'p>; 2]) -> bool {
        self.runners.iter().zip(runners).all(|(own, usual)| own.is_at(usual))
            && self.run.source.agrees(&usual.source)
            && self.run.target.agrees(&usual.target)
            && self.run.source_events == usual.source_events
            && self.run.target_events == usual.target_events
    }

    fn steps(&self) -> [u64; 2] {
        [self.runners[0].steps(), self.runners[1].steps()]
    }

    /// Executes the statement before which one side has halted.
    fn execute(&mut self, side: usize, stmt: &Stmt, last: Span) -> Result<(), Ended> {
        let (exec, events) = self.run.side(side);
        self.runners[side].execute(exec, stmt, events).map_err(|fault| ended(side, fault, last))
    }

    /// Goes on to so many steps of each program; `true` is the end of both.
    fn go_on(&mut self, to: [u64; 2], verifier: &Verifier) -> Result<bool, Ended> {
        for side in [0, 1] {
            let (exec, events) = self.run.side(side);
            if !self.over[side] {
                let came = self.runners[side].run_to(exec, to[side], events);
                self.over[side] = came.map_err(|fault| ended(side, fault, verifier.last))? == Progress::Done;
            }
        }
        let over = self.over == [true; 2];
        if over {
            self.run.source.end_of_text(&mut self.run.source_events);
            self.run.target.end_of_text(&mut self.run.target_events);
        }
        verifier.advance_run(&mut self.run, over).map_err(Ended::target)?;
        Ok(over)
    }
}

impl<'p> Forks<'p> {
    /// Forks for these facts.
    pub fn new(wanted: Vec<Other>, reach: [u64; 2]) -> Forks<'p> {
        Forks {
            wanted,
            watched: [0; 2],
            carried: Vec::new(),
            under_way: Vec::new(),
            met: Vec::new(),
            shown: Vec::new(),
            left: Vec::new(),
            spent: Vec::new(),
            reach,
            soon: PIECE,
        }
    }

    /// A run with another fact that is under way when the programs begin.
    pub fn carry(&mut self, run: Run) {
        let Some(other) = run.other else { return };
        if !self.wanted.contains(&other) {
            self.wanted.push(other);
        }
        self.met.push(other);
        self.carried.push(run);
    }

    /// The programs begin.
    pub fn begin(&mut self, runners: &[Runner<'p>; 2], last: Span) {
        for run in std::mem::take(&mut self.carried) {
            let Some(other) = run.other else { continue };
            let from = [run.comparison.events, 0];
            let lane = Box::new(Lane { run, runners: runners.clone(), over: [false; 2] });
            self.under_way.push(Fork { other, at: last, lane, from });
            self.soon = SOON;
        }
        self.watch();
    }

    fn watch(&mut self) {
        let due = |other: &&Other| self.under_way.iter().all(|fork| fork.other != **other);
        let bits = |side| self.wanted.iter().filter(due).fold(0, |bits, other| bits | bit(*other, side));
        self.watched = [bits(0), bits(1)];
    }

    /// Whether nobody looks at plain moves that both controls reach: no run with another fact is under way, and none
    /// would begin there.
    pub fn let_pass(&self, controls: [&Exec; 2], lines: &[Stmt]) -> bool {
        let comes = |(exec, watched): (&Exec, u64)| watched != 0 && watched & come_to(exec, lines) != 0;
        self.under_way.is_empty() && !controls.into_iter().zip(self.watched).any(comes)
    }

    /// Runs one side of the usual run until there are so many events; `true` is its end.
    pub fn run_side(
        &mut self,
        side: usize,
        run: &mut Run,
        runners: &mut [Runner<'p>; 2],
        over: [bool; 2],
        last: Span,
    ) -> Result<Progress, Diagnostic> {
        let mut enough = self.soon;
        loop {
            let watched = self.watched[side];
            let halts = |exec: &Exec, stmt: &Stmt| watched & come_to(exec, std::slice::from_ref(stmt)) != 0;
            let (exec, events) = run.side(side);
            match runners[side].run_until(exec, enough, events, halts)? {
                Halt::Enough => return Ok(Progress::More),
                Halt::Done => return Ok(Progress::Done),
                Halt::Before(stmt) => {
                    self.fork(side, &stmt, run, runners, over, last);
                    let (exec, events) = run.side(side);
                    enough = enough.min(events.len() + self.soon);
                    runners[side].execute(exec, &stmt, events)?;
                }
            }
        }
    }

    /// Forks runs off before a statement, with each fact that it reaches.
    fn fork(
        &mut self,
        side: usize,
        stmt: &Stmt,
        run: &Run,
        runners: &[Runner<'p>; 2],
        over: [bool; 2],
        last: Span,
    ) {
        let exec = if side == 0 { &run.source } else { &run.target };
        let comes = come_to(exec, std::slice::from_ref(stmt)) & self.watched[side];
        let due = self.wanted.iter().filter(|other| comes & bit(**other, side) != 0);
        let due: Vec<Other> =
            due.filter(|other| self.under_way.iter().all(|fork| fork.other != **other)).copied().collect();
        for other in due {
            if !self.met.contains(&other) {
                self.met.push(other);
            }
            let mut lane = Box::new(Lane { run: run.clone(), runners: runners.clone(), over });
            lane.run.comparison.keep_pairs(false);
            lane.run.take(other);
            let steps = lane.steps();
            let from = [run.comparison.events, steps[0].max(steps[1])];
            let at = if side == 0 { stmt.span } else { run.source_events.first().map_or(last, |e| e.span) };
            let mut fork = Fork { other, at, lane, from };
            match fork.lane.execute(side, stmt, last) {
                Ok(()) => self.under_way.push(fork),
                Err(ended) => self.end(fork, Err(ended)),
            }
        }
        self.soon = SOON;
        self.watch();
    }

    /// Has forks go as far as the usual run has come; those that are as it is are over.
    pub fn look(&mut self, usual: &Run, runners: &[Runner<'p>; 2], verifier: &Verifier) {
        self.soon = (self.soon * 2).min(PIECE);
        if self.under_way.is_empty() {
            return;
        }
        let to = [runners[0].steps(), runners[1].steps()];
        for mut fork in std::mem::take(&mut self.under_way) {
            match fork.lane.go_on(to, verifier) {
                Ok(false) if !fork.lane.is_as(usual, runners) => self.keep(fork),
                ended => self.end(fork, ended.map(|_| ())),
            }
        }
        self.watch();
    }

    /// The usual run is over, or ends in a fault: forks go on to their own ends.
    pub fn finish(&mut self, verifier: &Verifier) {
        while !self.under_way.is_empty() {
            for mut fork in std::mem::take(&mut self.under_way) {
                let to = fork.lane.steps().map(|steps| steps + STEPS);
                match fork.lane.go_on(to, verifier) {
                    Ok(false) => self.keep(fork),
                    ended => self.end(fork, ended.map(|_| ())),
                }
            }
        }
        self.watch();
    }

    /// A fork goes on, unless those with its fact have gone far enough.
    fn keep(&mut self, fork: Fork<'p>) {
        let [events, steps] = self.spent_with(&fork);
        if events > self.reach[0] || steps > self.reach[1] {
            self.left.push((fork.other, fork.at));
            self.wanted.retain(|other| *other != fork.other);
        } else {
            self.under_way.push(fork);
        }
    }

    fn end(&mut self, fork: Fork<'p>, ended: Result<(), Ended>) {
        let spent = self.spent_with(&fork);
        self.spent.retain(|(other, _)| *other != fork.other);
        self.spent.push((fork.other, spent));
        let run = fork.lane.run;
        if tells(&ended, &run) {
            self.wanted.retain(|other| *other != fork.other);
            self.shown.push(Shown { other: fork.other, ended, run });
        }
    }

    /// Events and steps of all forks with the fact of one.
    fn spent_with(&self, fork: &Fork) -> [u64; 2] {
        let before =
            self.spent.iter().find(|(other, _)| *other == fork.other).map_or([0; 2], |(_, all)| *all);
        let steps = fork.lane.steps();
        let now = [fork.lane.run.comparison.events, steps[0].max(steps[1])];
        std::array::from_fn(|at| before[at] + now[at].saturating_sub(fork.from[at]))
    }

    /// Facts that a usual run reached, but not visibly before the statement.
    pub fn unseen(&self, usual: &Run) -> Vec<Other> {
        let asked = [usual.source.asked(), usual.target.asked()];
        let unseen = |other: &&Other| {
            asked.iter().enumerate().any(|(side, asked)| asked & bit(**other, side) != 0)
                && !self.met.contains(other)
        };
        self.wanted.iter().filter(unseen).copied().collect()
    }
}

fn ended(side: usize, fault: Diagnostic, last: Span) -> Ended {
    if side == 0 { Ended::Source(fault) } else { Ended::target(unreadable(&fault, last)) }
}

/// The bit of a fact of one side.
fn bit(other: Other, side: usize) -> u64 {
    match other {
        Other::Behaviour { behaviour, source, .. } if source == (side == 0) => behaviour.bit(),
        Other::Behaviour { .. } => 0,
        Other::OptionalStop => OPTIONAL_STOP,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::job::Job;
    use ncc_dialects::{Settings, builtin};
    use ncc_frontends::{Batch, Reader};
    use ncc_ir::behaviour::Behaviour;
    use ncc_ir::diag::Fault;
    use ncc_ir::program::Program;

    const SOURCE: &str = "%\nO1\nG21 G17 G90 G94 G54 G40 G49 G80\nT1 M06\nS500 M03\nG00 X0. Y0.\nG43 H1 Z10.\nM00\n\
        #1=0\nWHILE [#1 LT 300] DO1\nG00 X[#1*0.01]\n#1=#1+1\nEND1\nG01 Z-1. F100.\nM30\n%\n";
    const OUTPUT: &str = "G710 G17 G90 G40 G94 D0\nG54\nT1 M6\nD1\nS500 M3\nG0 X0 Y0\nZ10\nM0\n\
        R1=0\nWHILE R1 < 300\nG0 X=R1 * 0.01\nR1=R1 + 1\nENDWHILE\nG1 Z-1 F100\nM30\n";

    /// What is reported of the spindle at a stop of the target's control.
    fn told(reach: [u64; 2]) -> [bool; 2] {
        let settings = |dialect| Settings::new(builtin(dialect).expect("a built-in dialect"));
        let job = Job::new(settings("fanuc"), settings("siemens"), "fork.nc");
        let (mut reader, mut batch) = (Reader::new(job.from.clone(), true), Batch::default());
        reader.read(SOURCE.as_bytes(), 0, &mut batch);
        reader.finish(&mut batch);
        let body = std::mem::take(&mut batch.stmts);
        let mut procedures = vec![batch.main(body)];
        procedures.append(&mut batch.procedures);
        let source = Program { name: batch.name.clone(), assumed: batch.assumed, procedures };
        let mut verifier = Verifier::new(&job);
        verifier.reach = reach;
        verifier.verify_rest(&source, OUTPUT.as_bytes(), 0, &batch.assumed).expect("the same program");
        let notes = verifier.take_notes(&[]);
        let spindle = Behaviour::SpindleAtStop;
        let has = |fault: fn(&Fault) -> Option<Behaviour>| {
            notes.iter().any(|note| fault(&note.fault) == Some(spindle))
        };
        let differs = has(|fault| match fault {
            Fault::OpenBehaviour { behaviour, source: false, .. } => Some(*behaviour),
            _ => None,
        });
        let left = has(|fault| match fault {
            Fault::FactNotTried { behaviour, source: false } => *behaviour,
            _ => None,
        });
        [differs, left]
    }

    /// With the spindle stopped all rapids are the same; the cut after the loop is not.
    #[test]
    fn a_fork_that_is_left_is_told() {
        assert_eq!(told([1_000, 20_000]), [true, false], "tried to the end");
        assert_eq!(told([100, 20_000]), [false, true], "left after events");
        assert_eq!(told([1_000, 100]), [false, true], "left after steps");
    }
}
