//! Programs that are kept whole: both are run from where they begin to their ends, against each other.
//!
//! What a program reads and has not set is given values (`values`). A set of values with which the source cannot be
//! executed says nothing. Ways that were not gone are reported.

mod lines;
mod values;

use ncc_exec::verify::Pair;
use ncc_exec::{Event, Exec, Kind, Progress, Runner};
use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Fault, NoValue};
use ncc_ir::expr::value::Wrong;
use ncc_ir::lack::ArcsLack;
use ncc_ir::program::valid::{anything, not_called};
use ncc_ir::program::{Procedure, Program};
use ncc_ir::run_time::RunTimeValue;
use ncc_ir::source::Span;
use ncc_passes::values::assumption_check::{
    TargetNumerics, assumed_places, compares_nearly, computes_numbers, other_reading,
};
use ncc_passes::values::variables::renamed::Renamed;

use self::values::READINGS;
use super::differences::different;
use super::ended::{Ended, PIECE};
use super::facts::{stopped, tries_facts};
use super::forks::{Forks, Shown};
use super::levels::levels;
use super::twice::outliving;
use super::verifier::{Other, Run, Stop, Verifier};
use crate::stretches::{Packer, Words, pack, unpack, unpacked};

pub use self::values::Given;

/// Pieces of a source that are executed by itself, to see whether it can be.
const MOST_PIECES: usize = 4096;

/// Events of a run after which a program is taken for one without an end.
const MOST_EVENTS: u64 = 50_000_000;

/// Sets of values with which a program is run that reads what it has not set, in each world.
const SETS: u32 = 200;

/// Events of a run with such a set, and steps that it may do nothing.
pub const MOST_OF_SET: (u64, u64) = (100_000, 200_000);

/// Sets of which one must reach the program's end; if none does, one of them is run as far as a program without
/// variables of others is.
const FEW_SETS: u32 = 8;

/// Branches that are reported; of more, the first ones.
const MOST_TOLD: usize = 20;

/// Blocks of the output that are reported, where it decides more than the source.
const MOST_BLOCKS: usize = 3;

/// Places of which it is asked whether a difference is made there; after them it is reported at the end.
const MOST_PLACES: usize = 64;

/// One of the sets of values, and how far a program is run with it: events, and steps that nothing comes of.
#[derive(Clone, Copy)]
pub struct Set {
    pub(crate) number: u32,
    pub(crate) most: u64,
    pub(crate) idle: Option<u64>,
}

impl Set {
    /// A set of which the run may be cut short: another one reaches the end.
    fn short(number: u32) -> Set {
        Set { number, most: MOST_OF_SET.0, idle: Some(MOST_OF_SET.1) }
    }

    /// A set with which the program is run as far as any is.
    fn long(number: u32) -> Set {
        Set { number, most: MOST_EVENTS, idle: None }
    }
}

/// Where ways that were gone go, and pairs of events, if they are kept.
pub type To<'t> = (&'t mut Gone, &'t mut dyn FnMut(&[Pair]));

/// Ways that were gone, of both programs.
#[derive(Default)]
pub struct Gone {
    source: Vec<u8>,
    target: Vec<u8>,
}

/// How far a program came with any of the sets.
struct Came {
    /// To its end.
    through: bool,
    /// Which start, and the first set with it, with which it is longer than the run of a set may be.
    goes_on: Option<(usize, u32)>,
    /// Starts and sets that took a path which none before them had taken.
    new_paths: Vec<(usize, u32)>,
    /// Events that were the same on both sides.
    events: u64,
}

/// What the target's control refuses of an arc that the source's has made: no pass knows the size of a computed one.
fn target_arc(fault: &Fault) -> Option<Fault> {
    match fault {
        Fault::ArcEndOffCircle { radii, allowed } => {
            Some(Fault::ArcRadiiDiffer { radii: *radii, allowed: *allowed })
        }
        Fault::ArcRadiusTooSmall => Some(Fault::lacks(ArcsLack::ComputedRadiusShort)),
        _ => None,
    }
}

impl Verifier {
    /// Ends a program of which the rest was kept whole: runs both rests against each other.
    pub fn verify_rest(
        &mut self,
        source: &Program,
        text: &[u8],
        base: u32,
        inherited: &Modes,
    ) -> Result<(), Stop> {
        self.verify_rest_reporting((source, &Renamed::default()), text, base, inherited, &mut |_| {})
    }

    /// As [`Verifier::verify_rest`]; pairs of events go to `pairs` as they are found, if they are kept.
    /// Variables of the source may have other names in the text.
    pub fn verify_rest_reporting(
        &mut self,
        (source, renamed): (&Program, &Renamed),
        text: &[u8],
        base: u32,
        inherited: &Modes,
        pairs: &mut dyn FnMut(&[Pair]),
    ) -> Result<(), Stop> {
        self.make_holes()?;
        for procedure in &source.procedures {
            self.fork(levels(&procedure.body));
            self.begin(&source.assumed);
        }
        let before: Vec<(u32, Exec)> = self.runs.iter().map(|run| (run.seed, run.source.clone())).collect();
        let stated = std::mem::take(&mut self.given);
        let mut given = Given::new(source, &stated);
        for name in stated.names() {
            if !given.open.iter().any(|(var, _)| stated.is_name(name, &var.name())) {
                self.notes.push(Diagnostic::new(Fault::ValueNotRead { name: name.into() }, Span::default()));
            }
        }
        given.renamed = renamed.clone();
        let verdict = self.whole_compared(source, &mut given, text, base, inherited, pairs);
        match verdict {
            // A program that cannot be executed is reported as that, whatever was made of it.
            Err(Stop::Target(told)) => Err(alone(source, &given, before).unwrap_or(Stop::Target(told))),
            Ok(()) | Err(Stop::Source(_)) => verdict,
        }
    }

    fn whole_compared(
        &mut self,
        source: &Program,
        given: &mut Given,
        text: &[u8],
        base: u32,
        inherited: &Modes,
        pairs: &mut dyn FnMut(&[Pair]),
    ) -> Result<(), Stop> {
        let target = self.read_target(text, base, inherited)?;
        let found: Vec<u16> = target.procedures.iter().map(|p| levels(&p.body)).collect();
        self.fork_for_target(&found);
        let computes = anything(&target).is_some();
        if !computes {
            // It is what the source comes to with nothing given.
            given.open.retain(|(var, _)| given.stated.only(&var.name()).is_some());
        }
        if computes {
            self.outliving = outliving(source, &given.renamed);
            given.near = self.near && !compares_nearly(source);
            given.read_otherwise = true;
        }
        let given = &*given;
        let mut gone = Gone::default();
        let mut starts = Vec::new();
        let mut failed = None;
        let mut runs = std::mem::take(&mut self.runs);
        // What was streamed has been looked at.
        runs.iter_mut().flat_map(|run| [&mut run.source, &mut run.target]).for_each(Exec::ask_anew);
        let mut carried = std::mem::take(&mut self.others);
        for other in &mut carried {
            let usual = runs.iter().find(|run| (run.seed, run.skip) == (other.seed, other.skip));
            usual.into_iter().for_each(|usual| other.catch_up(usual));
        }
        let first = runs.first().map(|run| run.seed);
        let wanted = runs.first().map(|run| self.facts_of(run, source)).unwrap_or_default();
        let (mut met, mut shown, mut left, mut apart) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        for run in &mut runs {
            let mut forks = (Some(run.seed) == first).then(|| {
                let tries = |other: &Other| tries_facts(run.skip, self.levels) || !met.contains(other);
                let known = |other: &Other| shown.iter().any(|shown: &Shown| shown.other == *other);
                let wanted = wanted.iter().copied().filter(|other| tries(other) && !known(other));
                let mut forks = Forks::new(wanted.collect(), self.reach);
                let own = |other: &&Run| (other.seed, other.skip) == (run.seed, run.skip);
                for other in carried.iter().filter(own) {
                    forks.carry(other.clone());
                }
                forks
            });
            let start = (!given.open.is_empty() && run.skip == 0 || forks.is_some()).then(|| run.clone());
            let sides = [source, &target];
            let ended = self.run_against(run, sides, given, Set::long(0), (&mut gone, pairs), forks.as_mut());
            match ended {
                Ok(()) => {}
                // With other values it may be executed.
                Err(Ended::Source(fault)) if !given.open.is_empty() => failed = failed.or(Some(fault)),
                Err(Ended::Source(fault) | Ended::NotSo(fault)) => return Err(Stop::Source(fault)),
                Err(Ended::Target(fault)) => return Err(Stop::Target(fault)),
                Err(Ended::Enough(at)) => {
                    let fault = Fault::NoEnd { steps: MOST_EVENTS };
                    return Err(Stop::Source(Diagnostic::new(fault, at)));
                }
            }
            if let (Some(mut forks), Some(start)) = (forks, &start) {
                let unseen = forks.unseen(run);
                if !unseen.is_empty() {
                    apart.push((start.clone(), unseen));
                }
                met.append(&mut forks.met);
                shown.append(&mut forks.shown);
                left.append(&mut forks.left);
            }
            starts.extend(start.filter(|start| !given.open.is_empty() && start.skip == 0));
        }
        self.runs = runs;
        self.compare_next_runs();
        let sides = [source, &target];
        let came = self.with_sets(&starts, sides, given, failed.is_none(), &mut gone)?;
        if failed.is_some() {
            self.events_of_sets += came.events;
        }
        for Shown { other, ended, run } in shown {
            self.judge(ended, other, &run)?;
        }
        self.untried.append(&mut left);
        for (start, facts) in apart {
            self.run_apart(&start, 0, sides, given, facts)?;
        }
        for (start, set) in came.new_paths {
            self.whole_with_facts(&starts[start], set, sides, given)?;
        }
        if let (false, Some((start, set))) = (came.through, came.goes_on) {
            self.run_to_the_end(&starts[start], sides, given, set, &mut gone)?;
            failed = None;
        }
        if let Some(fault) = failed.filter(|_| !came.through) {
            return Err(Stop::Source(fault));
        }
        self.note_not_called(source);
        if computes {
            self.tell(source, (&target, text, base), given, &gone);
        }
        Ok(())
    }

    /// Reads the output's rest back.
    fn read_target(&mut self, text: &[u8], base: u32, inherited: &Modes) -> Result<Program, Stop> {
        self.reader.repeats(true);
        let mut packer = Packer::new(self.shortest_stretch, Words::All);
        let mut shown = |stmts: &mut _, settled| packer.pack(stmts, settled);
        self.reader.read_showing(text, base, &mut self.batch, (self.piece, &mut shown));
        let settled = self.reader.settled(&self.batch);
        packer.finish(&mut self.batch.stmts, settled);
        self.reader.finish(&mut self.batch);
        self.batch.procedures.iter_mut().for_each(|procedure| unpack(&mut procedure.body));
        self.read_back(inherited)?;
        let mut body = std::mem::take(&mut self.batch.stmts);
        pack(&mut body, self.shortest_stretch, Words::All);
        let mut procedures = vec![Procedure { body, ..Procedure::default() }];
        procedures.append(&mut self.batch.procedures);
        Ok(Program { procedures, ..Program::default() })
    }

    /// Notes the subprograms that nothing calls.
    fn note_not_called(&mut self, source: &Program) {
        for procedure in not_called(source).into_iter().filter_map(|at| source.procedures.get(at)) {
            let at = procedure.body.first().map_or(self.last, |stmt| stmt.span);
            let name = procedure.name.as_ref().into();
            self.notes.push(Diagnostic::new(Fault::NotCalled { name }, at));
        }
    }

    /// Runs both programs with a set of values as far as any is: only a run that reaches its end shows that the
    /// program has one.
    fn run_to_the_end(
        &self,
        start: &Run,
        sides: [&Program; 2],
        given: &Given,
        set: u32,
        gone: &mut Gone,
    ) -> Result<(), Stop> {
        let mut run = start.clone();
        run.comparison.keep_pairs(false);
        match self.run_against(&mut run, sides, given, Set::long(set), (gone, &mut |_| {}), None) {
            Ok(()) => Ok(()),
            Err(Ended::Enough(at)) => {
                let fault = Fault::NoEnd { steps: MOST_EVENTS };
                Err(Stop::Source(Diagnostic::new(fault, at)))
            }
            Err(Ended::Source(fault) | Ended::NotSo(fault)) => Err(Stop::Source(fault)),
            Err(Ended::Target(fault)) => Err(Stop::Target(fault)),
        }
    }

    /// Runs both programs with sets of values, until every path of both was gone.
    fn with_sets(
        &self,
        starts: &[Run],
        sides: [&Program; 2],
        given: &Given,
        through: bool,
        gone: &mut Gone,
    ) -> Result<Came, Stop> {
        let mut came = Came { through, goes_on: None, new_paths: Vec::new(), events: 0 };
        if starts.is_empty() {
            return Ok(came);
        }
        let [a, b] = sides.map(Runner::new);
        for set in 1..=SETS {
            let all = || {
                a.uncovered_branches(&gone.source).is_empty() && b.uncovered_branches(&gone.target).is_empty()
            };
            let endless = set > FEW_SETS && !came.through && came.goes_on.is_some();
            if endless || set > 2 && came.through && all() {
                break;
            }
            for (at, start) in starts.iter().enumerate() {
                let mut run = start.clone();
                run.comparison.keep_pairs(false);
                let (before, first) = ((gone.source.clone(), gone.target.clone()), !came.through);
                let events = run.comparison.events;
                let ended =
                    self.run_against(&mut run, sides, given, Set::short(set), (gone, &mut |_| {}), None);
                if matches!(ended, Ok(()) | Err(Ended::Enough(_))) {
                    came.events += run.comparison.events - events;
                    if first || before != (gone.source.clone(), gone.target.clone()) {
                        came.new_paths.push((at, set));
                    }
                }
                match ended {
                    Ok(()) => came.through = true,
                    Err(Ended::Enough(_)) => came.goes_on = came.goes_on.or(Some((at, set))),
                    Err(Ended::Source(_)) => {}
                    Err(Ended::NotSo(fault)) => return Err(Stop::Source(fault)),
                    Err(Ended::Target(fault)) => return Err(Stop::Target(fault)),
                }
            }
        }
        Ok(came)
    }

    /// Runs both programs from where they begin, with one set of values. A difference that is none where what was
    /// assumed of the source's numbers is read the other way tells that they are not so; another one is the
    /// output's.
    fn run_against<'p>(
        &self,
        run: &mut Run,
        [source, target]: [&'p Program; 2],
        given: &Given,
        set: Set,
        to: To,
        forks: Option<&mut Forks<'p>>,
    ) -> Result<(), Ended> {
        let start = given.read_otherwise.then(|| run.clone());
        let ended = self.run_both(run, [source, target], given, set, to, forks);
        let (Err(Ended::Target(_)), Some(start)) = (&ended, start) else { return ended };
        // What a reading changes of one move it changes of all.
        let source = &unpacked(source);
        let compared = run.comparison.events;
        let same = |other: &Program| {
            let mut run = start.clone();
            run.comparison.keep_pairs(false);
            let to: To = (&mut Gone::default(), &mut |_| {});
            let told = self.run_both(&mut run, [other, target], given, set, to, None);
            // Both may end in what a control stops at.
            match (&told, &ended) {
                // One that goes on for long is the same as far as it was looked at.
                (Ok(()) | Err(Ended::Enough(_)), _) => true,
                (Err(Ended::Source(one)), Err(Ended::Target(two))) => {
                    // In that reading the source may end in an alarm where the output has not differed yet.
                    matches!(two.fault, Fault::NotReadBack { code } if code == one.fault.code())
                        || run.comparison.events >= compared
                }
                _ => false,
            }
        };
        let numerics = self.numerics(given);
        let read =
            |taken: &&[_]| other_reading(source, taken, numerics, u32::MAX).is_some_and(|other| same(&other));
        let Some(taken) = READINGS.into_iter().find(read) else { return ended };
        // The first place with which the output is the source in that reading.
        let at = assumed_places(source, taken, numerics)
            .into_iter()
            .take(MOST_PLACES)
            .find(|at| other_reading(source, taken, numerics, at.start).is_some_and(|other| same(&other)));
        let what = taken[0].violation();
        Err(Ended::NotSo(Diagnostic::new(Fault::computes(what), at.unwrap_or(self.last))))
    }

    fn numerics(&self, given: &Given) -> TargetNumerics<'_> {
        TargetNumerics {
            functions: &self.functions,
            fineness: self.fineness,
            near: given.near,
            equal_within: self.equal_within,
        }
    }

    /// Runs both programs from where they begin.
    pub fn run_both<'p>(
        &self,
        run: &mut Run,
        sides: [&'p Program; 2],
        given: &Given,
        set: Set,
        (gone, pairs): To,
        mut forks: Option<&mut Forks<'p>>,
    ) -> Result<(), Ended> {
        let mut runners = sides.map(Runner::new);
        runners[0].give(&mut |var| given.value(var, run.seed, set.number));
        runners[1].give(&mut |var| given.value_there(var, run.seed, set.number));
        if let Some(most) = set.idle {
            runners.iter_mut().for_each(|runner| runner.limit_idle(most));
        }
        if let Some(forks) = &mut forks {
            forks.begin(&runners, self.last);
        }
        let first = run.comparison.events;
        let mut done = [false; 2];
        let ended = loop {
            match self.pass_lines(run, &mut runners, forks.as_deref()) {
                Ok(false) => {}
                Ok(true) if run.comparison.events - first > set.most => {
                    break Err(Ended::Enough(runners[0].here()));
                }
                Ok(true) => continue,
                Err(fault) => break Err(Ended::Source(fault)),
            }
            match self.run_side(0, run, &mut runners, &mut done, forks.as_deref_mut()) {
                Ok(()) => {}
                Err(fault) => break Err(Ended::Source(fault)),
            }
            match self.run_side(1, run, &mut runners, &mut done, forks.as_deref_mut()) {
                Ok(()) => {}
                // What is read back has not failed: the user has stopped ncc.
                Err(Diagnostic { fault: fault @ Fault::Interrupted { .. }, .. }) => {
                    break Err(Ended::Source(Diagnostic::new(fault, runners[0].here())));
                }
                // The source's control reads nothing there.
                Err(Diagnostic {
                    fault: Fault::NoValue { why: NoValue::Wrong(Wrong::NothingGiven) },
                    ..
                }) if computes_numbers(sides[0]) => {
                    let what = RunTimeValue::ComputedNumberMaybeEmpty;
                    let at = runners[0].here();
                    break Err(Ended::NotSo(Diagnostic::new(Fault::computes(what), at)));
                }
                Err(fault) => {
                    let place = run.source_events.get(run.target_events.len());
                    break Err(match (target_arc(&fault.fault), place) {
                        (Some(refused), Some(Event { kind: Kind::Arc { .. }, span, .. })) => {
                            Ended::NotSo(Diagnostic::new(refused, *span))
                        }
                        _ => Ended::target(stopped(&fault, place, self.last)),
                    });
                }
            }
            let over = done == [true; 2];
            if run.comparison.events - first > set.most {
                break Err(Ended::Enough(runners[0].here()));
            }
            if over {
                if let Err(fault) = run.source.no_open_corner() {
                    break Err(Ended::Source(fault));
                }
                run.source.end_of_text(&mut run.source_events);
                run.target.end_of_text(&mut run.target_events);
            }
            // Where one side is done and the other goes on, that must be going nowhere.
            let advanced = self.advance_run(run, over);
            if self.watched && set.number == 0 {
                pairs(&run.comparison.take_pairs());
            }
            let ahead = run.source_events.len().max(run.target_events.len()) >= PIECE;
            let advanced = match advanced {
                Ok(()) if !over && ahead => self.advance_run(run, true),
                advanced => advanced,
            };
            match advanced {
                Err(stop) => break Err(Ended::target(stop)),
                Ok(()) if over => break Ok(()),
                Ok(()) => {}
            }
            if let Some(forks) = &mut forks {
                forks.look(run, &runners, self);
            }
        };
        if let (Some(forks), Ok(()) | Err(Ended::Source(_) | Ended::Enough(_))) = (forks, &ended) {
            forks.finish(self);
        }
        runners[0].add_taken(&mut gone.source);
        runners[1].add_taken(&mut gone.target);
        ended
    }

    /// Runs one side until there is something to compare.
    fn run_side<'p>(
        &self,
        side: usize,
        run: &mut Run,
        runners: &mut [Runner<'p>; 2],
        done: &mut [bool; 2],
        forks: Option<&mut Forks<'p>>,
    ) -> Result<(), Diagnostic> {
        if done[side] {
            return Ok(());
        }
        let came = match forks {
            Some(forks) => forks.run_side(side, run, runners, *done, self.last)?,
            None => {
                let (exec, events) = run.side(side);
                runners[side].run(exec, PIECE, events)?
            }
        };
        done[side] = came == Progress::Done;
        Ok(())
    }

    pub(crate) fn advance_run(&self, run: &mut Run, over: bool) -> Result<(), Stop> {
        let advanced = run.comparison.advance(&mut run.source_events, &mut run.target_events, over);
        advanced.map_err(|d| different(&d, run.source.unsaid(&self.own_facts), self.last))
    }

    /// Tells what was given values, and which ways were not gone.
    fn tell(
        &mut self,
        source: &Program,
        (target, text, base): (&Program, &[u8], u32),
        given: &Given,
        gone: &Gone,
    ) {
        for (var, span) in given.open.iter().filter(|(var, _)| !given.stated.says(&var.name())) {
            let fault = Fault::VariableGiven { name: var.name().into() };
            self.notes.push(Diagnostic::new(fault, *span));
        }
        let ways = |taken: u8| Fault::BranchUncovered { holds: taken & 1 == 0, fails: taken & 2 == 0 };
        let own = Runner::new(source);
        let mut uncovered_branches = own.uncovered_branches(&gone.source);
        let open = uncovered_branches.len();
        uncovered_branches.retain(|(span, taken)| *taken == 0 || !self.answered.contains(span));
        // The output has none of these.
        let answered = open - uncovered_branches.len();
        let of_target = Runner::new(target).uncovered_branches(&gone.target);
        let told = uncovered_branches.iter().take(MOST_TOLD);
        self.notes.extend(told.map(|(span, taken)| Diagnostic::new(ways(*taken), *span)));
        if of_target.len() > own.open_ways(&gone.source).saturating_sub(answered) {
            // The output decides what the source does not, or in several places what the source does in one.
            let blocks = of_target
                .iter()
                .take(MOST_BLOCKS)
                .map(|(span, _)| block_at(text, span.start.saturating_sub(base)));
            let blocks = blocks.collect::<Vec<_>>().join(", ").into();
            self.notes.push(Diagnostic::new(Fault::OutputNotTaken { blocks }, self.last));
        }
    }
}

/// The block that something stands in.
fn block_at(text: &[u8], at: u32) -> String {
    let (before, behind) = text.split_at((at as usize).min(text.len()));
    let begins = before.iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1);
    let ends = behind.iter().position(|b| *b == b'\n').map_or(text.len(), |at| before.len() + at);
    String::from_utf8_lossy(&text[begins..ends]).trim().to_owned()
}

/// Why the source cannot be executed by itself, if it cannot be.
fn alone(source: &Program, given: &Given, starts: Vec<(u32, Exec)>) -> Option<Stop> {
    let mut events = Vec::new();
    for (seed, mut exec) in starts {
        let mut runner = Runner::new(source);
        runner.give(&mut |var| given.value(var, seed, 0));
        for _ in 0..MOST_PIECES {
            match runner.run(&mut exec, PIECE, &mut events) {
                Err(fault) => return Some(Stop::Source(fault)),
                Ok(Progress::Done) => break,
                Ok(Progress::More) => events.clear(),
            }
        }
    }
    None
}
