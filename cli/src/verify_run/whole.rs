//! Programs that are kept whole: both are run from where they begin to their ends, against each other.
//!
//! What a program reads and has not set is given values, the same in both by the variables' names: made of the
//! numbers of the program itself, so that its decisions go both ways, and nothing at all for local variables. With
//! which values the source cannot be executed, it says nothing. Ways that were not gone are told.

use ncc_ir::behaviour::Behaviour;
use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::exec::{Event, Exec, Kind, Progress, Runner};
use ncc_ir::expr::Var;
use ncc_ir::open::{literals, open_variables};
use ncc_ir::passes::otherwise::{Taken, There, compares_nearly, otherwise, places};
use ncc_ir::passes::variables::Renamed;
use ncc_ir::program::{Op, Procedure, Program, Stmt, Type};
use ncc_ir::source::Span;
use ncc_ir::valid::{anything, not_called};
use ncc_ir::value::Value;
use ncc_ir::verify::Pair;

use crate::given::Given as Stated;

use super::{Other, Run, Stop, Verifier, different, levels, unreadable};

/// Events that are made on each side before they are compared.
const PIECE: usize = 4096;

/// Pieces of a source that are executed by itself, to see whether it can be.
const MOST_PIECES: usize = 4096;

/// Events of a run after which a program is taken for one without an end.
const MOST_EVENTS: u64 = 50_000_000;

/// Sets of values with which a program is run that reads what it has not set, in each world.
const SETS: u32 = 200;

/// Events of a run with such a set, and steps that it may do nothing.
pub(super) const MOST_OF_SET: (u64, u64) = (100_000, 200_000);

/// Sets of which one must come to the program's end; if none does, one of them is run as far as a program without
/// variables of others is.
const FEW_SETS: u32 = 8;

/// Events of a run with another fact than usual.
pub(super) const MOST_WITH_FACT: u64 = 1_000_000;

/// Decisions that are told; of more, the first ones.
const MOST_TOLD: usize = 20;

/// Blocks of the output that are told, where it decides more than the source.
const MOST_BLOCKS: usize = 3;

/// What another program has left in a variable.
const LEFT_THERE: f64 = -791.3;

/// Places of which it is asked whether a difference is made there; behind them it is told at the end.
const MOST_PLACES: usize = 64;

/// Values that any variable may have.
const FIRST: [f64; 8] = [1.0, 2.5, 10.0, -4.0, 30.0, 0.0, 100.0, -12.5];

/// What may be taken for granted of a source's numbers, alone and together.
const READINGS: [&[Taken]; 7] = [
    &[Taken::Apart],
    &[Taken::NotNegative],
    &[Taken::Together],
    &[Taken::Apart, Taken::NotNegative],
    &[Taken::Apart, Taken::Together],
    &[Taken::NotNegative, Taken::Together],
    &[Taken::Apart, Taken::NotNegative, Taken::Together],
];

/// Values for what a program reads and has not set.
pub(super) struct Given<'g> {
    open: Vec<(Var, Span)>,
    /// Parameters of the main procedure, and what they hold: each has a value, which a call has converted.
    parameters: Vec<(Var, Type)>,
    /// What is stated of them.
    stated: &'g Stated,
    /// What is tried first: the numbers of the program, and those beside them.
    pool: Vec<f64>,
    /// What the output calls the source's variables.
    renamed: Renamed,
    /// The source of an output that computes, in the other [`READINGS`].
    other_readings: [Option<Program>; READINGS.len()],
    /// Whether the output's comparisons find equal what is nearly so, and the source's do not.
    near: bool,
}

impl<'g> Given<'g> {
    fn new(source: &Program, stated: &'g Stated) -> Given<'g> {
        let open = open_variables(source);
        let mut pool = FIRST.to_vec();
        if !open.is_empty() {
            let own = literals(source);
            pool.extend(own.iter().flat_map(|n| [*n, n - 1.0, n + 1.0, n / 2.0]).take(4096));
        }
        let main = source.procedures.first().into_iter();
        let parameters = main.flat_map(|main| {
            let kinds = main.kinds.iter().copied().chain(std::iter::repeat(Type::Real));
            main.parameters.iter().cloned().zip(kinds)
        });
        let parameters = parameters.collect();
        Given {
            open,
            parameters,
            stated,
            pool,
            renamed: Renamed::default(),
            other_readings: [const { None }; READINGS.len()],
            near: false,
        }
    }

    /// The value of a variable in a set: in the first one, a local variable has none.
    pub(super) fn value(&self, var: &Var, seed: u32, set: u32) -> Option<Value> {
        if !self.open.iter().any(|(open, _)| open == var) {
            return None;
        }
        let parameter = self.parameters.iter().find(|(own, _)| own == var).map(|(_, kind)| *kind);
        let local = matches!(var, Var::Local(_)) && parameter.is_none();
        let name = var.name();
        let hash = name.bytes().chain(seed.to_le_bytes()).chain(set.to_le_bytes());
        let hash =
            hash.fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x100_0000_01b3));
        let hash = mixed(hash);
        let converted = |value: f64| {
            Value::Number(match parameter {
                Some(Type::Int) => value.round(),
                Some(Type::Bool) => f64::from(u8::from(value != 0.0)),
                Some(Type::Real) | None => value,
            })
        };
        if let Some(value) = self.stated.value(&name, set, hash) {
            return Some(value.map_or(Value::Vacant, converted));
        }
        // In every second set all of them are given, else some are not.
        if local && (set == 0 || set.is_multiple_of(2) && hash.is_multiple_of(4)) {
            return Some(Value::Vacant);
        }
        let among = if set % 3 == 1 { FIRST.len() } else { self.pool.len() };
        Some(converted(self.pool[(mixed(hash) >> 20) as usize % among]))
    }
}

impl Given<'_> {
    /// The value of one of the output's variables: that of the source's. What the source does not have, or leaves to
    /// be set first, holds something there, where a control has no variables without a value.
    pub(super) fn value_there(&self, var: &Var, seed: u32, set: u32) -> Option<Value> {
        let source = self.renamed.source(var).unwrap_or(var);
        let own = self.value(source, seed, set);
        match var {
            Var::Common(_) if own.is_none() && self.renamed.filled() => Some(Value::Number(LEFT_THERE)),
            _ => own,
        }
    }
}

/// One of the sets of values, and how far a program is run with it: events, and steps that nothing comes of.
#[derive(Clone, Copy)]
struct Set {
    number: u32,
    most: u64,
    idle: Option<u64>,
}

impl Set {
    /// A set of which the run may be cut short: another one comes to the end.
    fn short(number: u32) -> Set {
        Set { number, most: MOST_OF_SET.0, idle: Some(MOST_OF_SET.1) }
    }

    /// A set with which the program is run as far as any is.
    fn long(number: u32) -> Set {
        Set { number, most: MOST_EVENTS, idle: None }
    }
}

/// Ways that were gone, of both programs.
#[derive(Default)]
struct Gone {
    source: Vec<u8>,
    target: Vec<u8>,
}

/// How far a program came with any of the sets.
struct Came {
    /// To its end.
    through: bool,
    /// Which start, and the first set with it, with which it is longer than the run of a set may be.
    goes_on: Option<(usize, u32)>,
    /// Open facts that were come to, a bit each: of the source's control, of the target's.
    asked: [u64; 2],
    /// Starts and sets that took a path which none before them had taken.
    new_paths: Vec<(usize, u32)>,
    /// Events that were the same on both sides.
    events: u64,
}

/// Open facts that either of two runs has come to.
fn either(asked: [u64; 2], run: &Run) -> [u64; 2] {
    [asked[0] | run.source.asked(), asked[1] | run.target.asked()]
}

/// What the target's control refuses of an arc that the source's has made: no pass knows the size of a computed one.
fn target_arc(fault: &Fault) -> Option<Fault> {
    match fault {
        Fault::ArcEndOffCircle { radii, allowed } => {
            Some(Fault::ArcRadiiDiffer { radii: *radii, allowed: *allowed })
        }
        Fault::ArcRadiusTooSmall => {
            let what = "a computed radius below half the distance from start to end".into();
            Some(Fault::CannotSay { what })
        }
        _ => None,
    }
}

/// Bits well mixed (splitmix64).
fn mixed(n: u64) -> u64 {
    let n = n.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let n = (n ^ n >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let n = (n ^ n >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    n ^ n >> 31
}

/// Why a run ends before its end.
pub(super) enum Ended {
    /// The source cannot be executed.
    Source(Diagnostic),
    /// The output does something else.
    Target(Diagnostic),
    /// It does, for what it takes for granted of the source's numbers is not so.
    NotSo(Diagnostic),
    /// It is long enough.
    Enough,
}

impl Verifier {
    /// Ends a program of which the rest was kept whole: runs both rests against each other.
    pub(crate) fn whole(
        &mut self,
        source: &Program,
        text: &[u8],
        base: u32,
        inherited: &Modes,
    ) -> Result<(), Stop> {
        self.whole_telling((source, &Renamed::default()), text, base, inherited, &mut |_| {})
    }

    /// As [`Verifier::whole`]; pairs of events go to `pairs` as they are found, if they are kept.
    /// Variables of the source may have other names in the text.
    pub(crate) fn whole_telling(
        &mut self,
        (source, renamed): (&Program, &Renamed),
        text: &[u8],
        base: u32,
        inherited: &Modes,
        pairs: &mut dyn FnMut(&[Pair]),
    ) -> Result<(), Stop> {
        for procedure in &source.procedures {
            self.prepare(&procedure.body, &source.assumed);
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
            // A program that cannot be executed is told as that, whatever was made of it.
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
        self.reader.read(text, base, &mut self.batch);
        self.reader.finish(&mut self.batch);
        self.read_back(inherited)?;
        let body = std::mem::take(&mut self.batch.stmts);
        let mut procedures = vec![Procedure { body, ..Procedure::default() }];
        procedures.append(&mut self.batch.procedures);
        let target = Program { procedures, ..Program::default() };
        let found: Vec<u16> = target.procedures.iter().map(|p| levels(&p.body)).collect();
        self.fork_for_target(&found);
        let computes = anything(&target).is_some();
        if !computes {
            // It is what the source comes to with nothing given.
            given.open.retain(|(var, _)| given.stated.only(&var.name()).is_some());
        }
        if computes {
            given.near = self.near && !compares_nearly(source);
            let there = self.there(given);
            given.other_readings = READINGS.map(|taken| otherwise(source, taken, there, u32::MAX));
        }
        let given = &*given;
        let mut gone = Gone::default();
        let mut starts = Vec::new();
        let mut failed = None;
        let mut runs = std::mem::take(&mut self.runs);
        // What was streamed has been looked at.
        runs.iter_mut().flat_map(|run| [&mut run.source, &mut run.target]).for_each(Exec::ask_anew);
        let plain: Vec<Run> = Verifier::of_first_world(&runs).map(|at| runs[at].clone()).collect();
        let mut asked = [0; 2];
        let mut sets = Vec::new();
        for run in &mut runs {
            let start = (!given.open.is_empty() && run.skip == 0).then(|| run.clone());
            let ended = self.run_against(run, [source, &target], given, Set::long(0), &mut gone, pairs);
            asked = either(asked, run);
            match ended {
                Ok(()) => {}
                // With other values it may be executed.
                Err(Ended::Source(fault)) if !given.open.is_empty() => failed = failed.or(Some(fault)),
                Err(Ended::Source(fault) | Ended::NotSo(fault)) => return Err(Stop::Source(fault)),
                Err(Ended::Target(fault)) => return Err(Stop::Target(fault)),
                Err(Ended::Enough) => {
                    let fault = Fault::NoEnd { steps: MOST_EVENTS };
                    return Err(Stop::Source(Diagnostic::new(fault, self.last)));
                }
            }
            starts.extend(start);
        }
        self.runs = runs;
        self.compare_next_runs();
        let sides = [source, &target];
        sets.extend(plain.into_iter().map(|plain| (plain, 0)));
        let came = self.with_sets(&starts, sides, given, failed.is_none(), &mut gone)?;
        asked = [asked[0] | came.asked[0], asked[1] | came.asked[1]];
        sets.extend(came.new_paths.iter().map(|(start, set)| (starts[*start].clone(), *set)));
        if failed.is_some() {
            self.events_of_sets += came.events;
        }
        for (start, set) in &sets {
            self.whole_with_facts(start, *set, sides, given, asked)?;
        }
        if let (false, Some((start, set))) = (came.through, came.goes_on) {
            // Only a run that comes to its end shows that the program has one.
            let mut run = starts[start].clone();
            run.comparison.keep_pairs(false);
            match self.run_against(&mut run, sides, given, Set::long(set), &mut gone, &mut |_| {}) {
                Ok(()) => failed = None,
                Err(Ended::Enough) => {
                    let fault = Fault::NoEnd { steps: MOST_EVENTS };
                    return Err(Stop::Source(Diagnostic::new(fault, self.last)));
                }
                Err(Ended::Source(fault) | Ended::NotSo(fault)) => return Err(Stop::Source(fault)),
                Err(Ended::Target(fault)) => return Err(Stop::Target(fault)),
            }
        }
        if let Some(fault) = failed.filter(|_| !came.through) {
            return Err(Stop::Source(fault));
        }
        for procedure in not_called(source).into_iter().filter_map(|at| source.procedures.get(at)) {
            let at = procedure.body.first().map_or(self.last, |stmt| stmt.span);
            let name = procedure.name.as_ref().into();
            self.notes.push(Diagnostic::new(Fault::NotCalled { name }, at));
        }
        if computes {
            self.tell(source, (&target, text, base), given, &gone);
        }
        Ok(())
    }

    /// Runs both programs with a set of values and with each open fact that was come to, another one than usual, one at
    /// a time. A fact that is known to matter is not tried again.
    fn whole_with_facts(
        &mut self,
        start: &Run,
        number: u32,
        sides: [&Program; 2],
        given: &Given,
        asked: [u64; 2],
    ) -> Result<(), Stop> {
        for (bits, source) in [(asked[0] & self.open[0], true), (asked[1] & self.open[1], false)] {
            self.fork_whole(start, bits, source);
        }
        let optional = |program: &Program| program.procedures.iter().any(|p| has_optional_stop(&p.body));
        if self.optional_stop && optional(sides[0]) {
            let mut run = start.clone();
            run.take(Other::OptionalStop);
            self.others.push(run);
        }
        let runs: Vec<Run> = std::mem::take(&mut self.others);
        let (optional, mut facts) = runs.into_iter().partition(|run| run.other == Some(Other::OptionalStop));
        self.fork_where_asked(start, number, sides, given, &mut facts)?;
        let rest: Vec<Run> = optional;
        for mut run in rest.into_iter().chain(facts) {
            run.comparison.keep_pairs(false);
            let Some(other) = run.other else { continue };
            if self.matters.iter().any(|(known, _)| *known == other) {
                continue;
            }
            let idle = (number > 0).then_some(MOST_OF_SET.1);
            let set = Set { number, most: MOST_WITH_FACT, idle };
            let ended = self.run_both(&mut run, sides, given, set, &mut Gone::default(), &mut |_| {});
            self.judge(ended, other, &run)?;
        }
        Ok(())
    }

    /// What a run with another fact has shown.
    pub(super) fn judge(&mut self, ended: Result<(), Ended>, other: Other, run: &Run) -> Result<(), Stop> {
        match ended {
            Err(Ended::Target(difference)) if !other.explains(run) => return Err(Stop::Target(difference)),
            Err(Ended::Target(difference)) => self.matters.push((other, difference.span)),
            // So a difference is told where the source leaves open what the target's control does.
            Err(Ended::Source(fault))
                if matches!(fault.fault, Fault::DoneByTarget { .. } | Fault::FactUnsaid { .. }) =>
            {
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
            Ok(()) | Err(Ended::Source(_) | Ended::Enough) => {}
        }
        Ok(())
    }

    fn fork_whole(&mut self, start: &Run, bits: u64, source: bool) {
        for behaviour in Behaviour::ALL.iter().copied().filter(|behaviour| bits & behaviour.bit() != 0) {
            for value in self.other_values(behaviour, source) {
                let other = Other::Behaviour { behaviour, source, value };
                if self.others.iter().all(|run| run.other != Some(other)) {
                    let mut run = start.clone();
                    run.take(other);
                    self.others.push(run);
                }
            }
        }
    }

    /// Runs both programs with sets of values, until every way of both was gone.
    fn with_sets(
        &self,
        starts: &[Run],
        sides: [&Program; 2],
        given: &Given,
        through: bool,
        gone: &mut Gone,
    ) -> Result<Came, Stop> {
        let mut came = Came { through, goes_on: None, asked: [0; 2], new_paths: Vec::new(), events: 0 };
        let [a, b] = sides.map(Runner::new);
        for set in 1..=SETS {
            let all = || a.untaken(&gone.source).is_empty() && b.untaken(&gone.target).is_empty();
            let endless = set > FEW_SETS && !came.through && came.goes_on.is_some();
            if starts.is_empty() || endless || set > 2 && came.through && all() {
                break;
            }
            for (at, start) in starts.iter().enumerate() {
                let mut run = start.clone();
                run.comparison.keep_pairs(false);
                let (before, first) = ((gone.source.clone(), gone.target.clone()), !came.through);
                let events = run.comparison.events;
                let ended = self.run_against(&mut run, sides, given, Set::short(set), gone, &mut |_| {});
                came.asked = either(came.asked, &run);
                if matches!(ended, Ok(()) | Err(Ended::Enough)) {
                    came.events += run.comparison.events - events;
                    if first || before != (gone.source.clone(), gone.target.clone()) {
                        came.new_paths.push((at, set));
                    }
                }
                match ended {
                    Ok(()) => came.through = true,
                    Err(Ended::Enough) => came.goes_on = came.goes_on.or(Some((at, set))),
                    Err(Ended::Source(_)) => {}
                    Err(Ended::NotSo(fault)) => return Err(Stop::Source(fault)),
                    Err(Ended::Target(fault)) => return Err(Stop::Target(fault)),
                }
            }
        }
        Ok(came)
    }

    /// Runs both programs from where they begin, with one set of values. A difference that is none where what was
    /// taken for granted of the source's numbers is read the other way tells that they are not so; another one is the
    /// output's.
    fn run_against(
        &self,
        run: &mut Run,
        [source, target]: [&Program; 2],
        given: &Given,
        set: Set,
        gone: &mut Gone,
        pairs: &mut dyn FnMut(&[Pair]),
    ) -> Result<(), Ended> {
        let start = given.other_readings.iter().any(Option::is_some).then(|| run.clone());
        let ended = self.run_both(run, [source, target], given, set, gone, pairs);
        let (Err(Ended::Target(_)), Some(start)) = (&ended, start) else { return ended };
        let same = |other: &Program| {
            let mut run = start.clone();
            run.comparison.keep_pairs(false);
            let told =
                self.run_both(&mut run, [other, target], given, set, &mut Gone::default(), &mut |_| {});
            // Both may end in what a control stops at.
            match (&told, &ended) {
                (Ok(()), _) => true,
                (Err(Ended::Source(one)), Err(Ended::Target(two))) => {
                    matches!(two.fault, Fault::NotReadBack { code } if code == one.fault.code())
                }
                _ => false,
            }
        };
        let mut read = given.other_readings.iter().zip(READINGS);
        let Some((_, taken)) = read.find(|(other, _)| other.as_ref().is_some_and(same)) else {
            return ended;
        };
        // The first place with which the output is the source in that reading.
        let there = self.there(given);
        let at = places(source, taken, there)
            .into_iter()
            .take(MOST_PLACES)
            .find(|at| otherwise(source, taken, there, at.start).is_some_and(|other| same(&other)));
        let what = taken[0].otherwise().into();
        Err(Ended::NotSo(Diagnostic::new(Fault::Computes { what }, at.unwrap_or(self.last))))
    }

    fn there(&self, given: &Given) -> There<'_> {
        There { functions: &self.functions, fineness: self.fineness, near: given.near }
    }

    fn run_both(
        &self,
        run: &mut Run,
        [source, target]: [&Program; 2],
        given: &Given,
        set: Set,
        gone: &mut Gone,
        pairs: &mut dyn FnMut(&[Pair]),
    ) -> Result<(), Ended> {
        let (mut a, mut b) = (Runner::new(source), Runner::new(target));
        a.give(&mut |var| given.value(var, run.seed, set.number));
        b.give(&mut |var| given.value_there(var, run.seed, set.number));
        for runner in [&mut a, &mut b] {
            if let Some(most) = set.idle {
                runner.limit_idle(most);
            }
        }
        let first = run.comparison.events;
        let ended = loop {
            let more_a = match a.run(&mut run.source, PIECE, &mut run.source_events) {
                Ok(more) => more,
                Err(fault) => break Err(Ended::Source(fault)),
            };
            let more_b = match b.run(&mut run.target, PIECE, &mut run.target_events) {
                Ok(more) => more,
                Err(fault) => {
                    let place = run.source_events.get(run.target_events.len());
                    break Err(match (target_arc(&fault.fault), place) {
                        (Some(refused), Some(Event { kind: Kind::Arc { .. }, span, .. })) => {
                            Ended::NotSo(Diagnostic::new(refused, *span))
                        }
                        _ => Ended::target(unreadable(&fault, self.last)),
                    });
                }
            };
            let over = more_a == Progress::Done && more_b == Progress::Done;
            if run.comparison.events - first > set.most {
                break Err(Ended::Enough);
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
        };
        a.add_taken(&mut gone.source);
        b.add_taken(&mut gone.target);
        ended
    }

    pub(super) fn advance_run(&self, run: &mut Run, over: bool) -> Result<(), Stop> {
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
        let ways = |taken: u8| Fault::NotTaken { holds: taken & 1 == 0, fails: taken & 2 == 0 };
        let mut untaken = Runner::new(source).untaken(&gone.source);
        let open = untaken.len();
        untaken.retain(|(span, taken)| *taken == 0 || !self.answered.contains(span));
        // The output has none of these.
        let answered = open - untaken.len();
        let of_target = Runner::new(target).untaken(&gone.target);
        let told = untaken.iter().take(MOST_TOLD);
        self.notes.extend(told.map(|(span, taken)| Diagnostic::new(ways(*taken), *span)));
        if of_target.len() > Runner::new(source).open_ways(&gone.source).saturating_sub(answered) {
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

/// Whether an optional stop stands anywhere in a body.
fn has_optional_stop(body: &[Stmt]) -> bool {
    body.iter().any(|stmt| match &stmt.op {
        Op::OptionalProgramStop => true,
        Op::Control(control) => control.bodies().any(|body| has_optional_stop(body)),
        _ => false,
    })
}

/// The block that something stands in.
fn block_at(text: &[u8], at: u32) -> String {
    let (before, behind) = text.split_at((at as usize).min(text.len()));
    let begins = before.iter().rposition(|b| *b == b'\n').map_or(0, |at| at + 1);
    let ends = behind.iter().position(|b| *b == b'\n').map_or(text.len(), |at| before.len() + at);
    String::from_utf8_lossy(&text[begins..ends]).trim().to_owned()
}

impl Ended {
    pub(super) fn target(stop: Stop) -> Ended {
        match stop {
            Stop::Source(fault) => Ended::Source(fault),
            Stop::Target(fault) => Ended::Target(fault),
        }
    }
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
