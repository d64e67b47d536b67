//! Open facts of both controls: what a parameter, a machine datum or the builder decides, and nobody has stated.
//!
//! Where a program reaches such a fact, a run forks off in which it has another value. The fork goes on beside the usual
//! run until both are in one state again, or until source and output differ in it: then the fact matters, and is
//! reported. Silence means that the cut is the same under all values.
//!
//! Not here: which facts there are (`ncc_ir::behaviour`), and programs that are kept whole (`whole`).

use ncc_dialects::Settings;
use ncc_exec::{Event, Exec, by_control, touched};
use ncc_frontends::Reader;
use ncc_ir::behaviour::{Behaviour, Behaviours, Concern};
use ncc_ir::canon::Modes;
use ncc_ir::control_fact::ControlFact;
use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::expr::num::Nanos;
use ncc_ir::lack::{CompensationLack, Lack};
use ncc_ir::program::{Op, Stmt};
use ncc_ir::source::Span;

use super::differences::different;
use super::verifier::{Other, Run, Stop, Verifier, unreadable};
use crate::job::Job;

impl Other {
    /// Whether the fact explains the difference to which a run has come. With the switch for optional stops on, only moves
    /// are explained that the source makes with what its control has switched off.
    pub fn explains(self, run: &Run) -> bool {
        let switched = by_control::SPINDLE | by_control::COOLANT;
        let stands = |event: &Event| event.kind.moves().is_some() && event.state.by_control & switched != 0;
        match self {
            Other::Behaviour { .. } => true,
            Other::OptionalStop => run.source_events.first().is_some_and(stands),
        }
    }
}

impl Run {
    /// Where F counts otherwise on an arc under compensation, with another value of what it counts there: a target without
    /// codes for it is not compared in that.
    pub fn fed_otherwise(&self) -> Option<Span> {
        self.fed_otherwise_with([&self.source, &self.target])
    }

    fn fed_otherwise_with(&self, [source, target]: [&Exec; 2]) -> Option<Span> {
        let arcs = matches!(self.other, Some(Other::Behaviour { behaviour: Behaviour::FeedOnArcs, .. }));
        arcs.then(|| source.arc_fed_otherwise(target)).flatten().map(|(at, _)| at)
    }

    /// Whether one side does what the usual run does: the fact is the other side's. A fork of a program that streams takes
    /// the events from there, and leaves that control where it forked off.
    fn shares(&self, side: usize) -> bool {
        matches!(self.other, Some(Other::Behaviour { source, .. }) if source == (side == 1))
    }

    /// Takes the side that is the usual run's as it is there.
    pub fn catch_up(&mut self, usual: &Run) {
        if self.shares(0) {
            self.source.clone_from(&usual.source);
        }
        if self.shares(1) {
            self.target.clone_from(&usual.target);
        }
    }

    /// Takes further events of the sides that are the usual run's.
    fn share(&mut self, usual: &Run) {
        if let (true, Some(new)) = (self.shares(0), usual.source_events.get(self.taken[0]..)) {
            self.source_events.extend_from_slice(new);
        }
        if let (true, Some(new)) = (self.shares(1), usual.target_events.get(self.taken[1]..)) {
            self.target_events.extend_from_slice(new);
        }
    }

    /// The usual run among all.
    fn usual<'r>(&self, runs: &'r [Run]) -> Option<&'r Run> {
        runs.iter().find(|run| (run.seed, run.skip) == (self.seed, self.skip))
    }

    /// One side: its control and its events.
    pub fn side(&mut self, side: usize) -> (&mut Exec, &mut Vec<Event>) {
        match side {
            0 => (&mut self.source, &mut self.source_events),
            _ => (&mut self.target, &mut self.target_events),
        }
    }

    /// The run with one more block-skip switch on; `target` gives the switches of the target's control.
    pub fn skipping(&self, bit: u16, target: impl Fn(u16) -> u16) -> Run {
        let mut run = self.clone();
        run.comparison.keep_pairs(false);
        run.skip |= bit;
        run.source.set_skip(run.skip);
        run.target.set_skip(target(run.skip));
        run
    }

    /// Takes another fact for granted from now on.
    pub fn take(&mut self, other: Other) {
        self.other = Some(other);
        self.level = false;
        match other {
            Other::OptionalStop => {
                self.source.set_optional_stop(true);
                self.target.set_optional_stop(true);
            }
            Other::Behaviour { behaviour, source, value } => {
                let exec = if source { &mut self.source } else { &mut self.target };
                exec.behave(behaviour, value);
            }
        }
    }
}

/// A reader of the output, which reports what the output assumes of the target's control.
pub fn reader_of_output(job: &Job) -> Reader {
    reader_of_text(job.to.clone())
}

fn reader_of_text(to: Settings) -> Reader {
    let mut reader = Reader::new(to, false);
    reader.report_parameters();
    // What streams repeats no blocks.
    reader.repeats(false);
    reader
}

/// The output cannot be executed further. Blocks of a compensated contour that move nowhere in the digits of the target,
/// and cycles that its control refuses, are refused at the block of the source of which the next event is; anything else is a fault of the translation.
pub fn stopped(fault: &Diagnostic, next: Option<&Event>, last: Span) -> Stop {
    let at = next.map_or(last, |event| event.span);
    match &fault.fault {
        Fault::TargetLacks {
            lack: Lack::Compensation(CompensationLack::WithoutMotion | CompensationLack::TwoWithoutMotion),
        } => Stop::Source(Diagnostic::new(fault.fault.clone(), at)),
        Fault::SpindleForCycle { .. } => unreadable(fault, at),
        _ => unreadable(fault, last),
    }
}

/// Feed that the caller of a subprogram has active: 137 mm a minute or a turn, unlike any that a program states.
const CALLERS_FEED: Nanos = 137_000_000_137;

impl Verifier {
    /// The program is called by another, and states nothing of what was assumed: its text is read as the
    /// source was, in the unit of length that its caller has active.
    pub fn read_as_called(&mut self, job: &Job, assumed: &Modes) {
        let mut to = job.to.clone();
        if assumed.units.is_none_or(|units| to.state_units(units)) {
            self.reader = reader_of_text(to);
        }
        self.reader.called();
        self.as_called = true;
        let runs = self.runs.iter_mut().chain(&mut self.others);
        let executors = runs.flat_map(|run| [&mut run.source, &mut run.target]);
        executors.for_each(|exec| exec.begin_at_feed(CALLERS_FEED));
    }

    /// Whether plain moves may pass for both sides by being executed once.
    #[cfg(test)]
    pub fn is_level(&self) -> bool {
        self.runs.iter().any(|run| run.level)
    }

    /// What the reading of the output assumes of the target's control: it counts as much as what the source's
    /// reading does.
    pub fn note_assumed(&mut self) {
        for Diagnostic { fault, .. } in self.batch.diagnostics.drain(..) {
            let is_new = matches!(fault, Fault::AssumedFact { .. })
                && self.notes.iter().all(|note| note.fault != fault);
            if is_new {
                self.notes.push(Diagnostic::new(fault, self.last));
            }
        }
    }

    /// What the verification has to say of its own reach, of facts that would make another cut, and of what the output
    /// assumes, if that is not `reported` yet.
    pub fn take_notes(&mut self, reported: &[Diagnostic]) -> Vec<Diagnostic> {
        let fed = self.runs.first().and_then(|run| run.source.arc_fed_otherwise(&run.target));
        let mut matters = std::mem::take(&mut self.matters);
        // That the usual values differ is reported.
        let arcs = |other: &Other| matches!(other, Other::Behaviour { behaviour: Behaviour::FeedOnArcs, .. });
        matters.retain(|(other, _)| fed.is_none() || !arcs(other));
        let told = matters.into_iter().map(|(other, at)| {
            let fault = match other {
                Other::OptionalStop => Fault::OptionalStopDiffers,
                Other::Behaviour { behaviour, source, value } => {
                    let all = behaviour.values();
                    let (taken, other) =
                        (all[usize::from(self.usual(behaviour, source))], all[usize::from(value)]);
                    Fault::OpenBehaviour { behaviour, source, taken, other }
                }
            };
            Diagnostic::new(fault, at)
        });
        let told: Vec<Diagnostic> = told.collect();
        let mut notes = std::mem::take(&mut self.notes);
        let assumed = |note: &Diagnostic| matches!(note.fault, Fault::AssumedFact { .. });
        notes.retain(|note| !assumed(note) || reported.iter().all(|own| own.fault != note.fault));
        // A value that tells which code a block has is read with the text.
        let with_text = |name: &str| {
            reported.iter().any(|own| match &own.fault {
                Fault::AssumedFact { fact: ControlFact::VariableAtStart { name: own, .. } } => **own == *name,
                _ => false,
            })
        };
        notes.retain(|note| !matches!(&note.fault, Fault::ValueNotRead { name } if with_text(name)));
        notes.extend(told);
        notes.extend(self.take_untried());
        notes.extend(fed.map(|(at, [contour_in_source, inner])| {
            Diagnostic::new(Fault::FeedOnArcs { contour_in_source, inner }, at)
        }));
        let standing = self.runs.first().and_then(|run| run.source.cut_standing());
        notes.extend(standing.map(|at| Diagnostic::new(Fault::CutStanding, at)));
        notes
    }

    /// Facts that were not tried to the end, each control's once. That they matter is reported before.
    fn take_untried(&mut self) -> Vec<Diagnostic> {
        let mut told: Vec<Diagnostic> = Vec::new();
        for (other, at) in std::mem::take(&mut self.untried) {
            let fault = match other {
                Other::Behaviour { behaviour, source, .. } => {
                    Fault::FactNotTried { behaviour: Some(behaviour), source }
                }
                Other::OptionalStop => Fault::FactNotTried { behaviour: None, source: true },
            };
            if told.iter().all(|told| told.fault != fault) {
                told.push(Diagnostic::new(fault, at));
            }
        }
        told
    }

    /// Adds runs for the open facts of the source's control that statements reach.
    pub fn fork_for_source(&mut self, stmts: &[Stmt]) {
        if self.open[0] == 0 && !self.optional_stop {
            return;
        }
        let optional = if self.optional_stop { OPTIONAL_STOP } else { 0 };
        let looked_at = self.open[0] | optional;
        for (at, bits) in self.met_by(|run| looked_at & come_to(&run.source, stmts)) {
            if bits & OPTIONAL_STOP != 0 {
                self.fork_with(at, Other::OptionalStop);
            }
            self.fork_with_each(at, bits & self.open[0], true);
        }
    }

    /// Runs of the first world in which facts are to be tried that they reach, with these facts: a fact that is met
    /// under the settings in which facts are tried is tried under no other.
    pub(super) fn met_by(&self, comes: impl Fn(&Run) -> u64) -> Vec<(usize, u64)> {
        let met = Verifier::of_first_world(&self.runs).map(|at| (at, comes(&self.runs[at])));
        let mut met: Vec<(usize, u64)> = met.filter(|(_, bits)| *bits != 0).collect();
        let tries = |at: usize| tries_facts(self.runs[at].skip, self.levels);
        let mut tried = met.iter().filter(|(at, _)| tries(*at)).fold(0, |tried, (_, bits)| tried | bits);
        for (_, bits) in met.iter_mut().filter(|(at, _)| !tries(*at)) {
            let new = *bits & !tried;
            (*bits, tried) = (new, tried | new);
        }
        met
    }

    /// The runs of the first world: one for each setting of the block-skip switches.
    fn of_first_world(runs: &[Run]) -> impl Iterator<Item = usize> + use<> {
        let first = runs.first().map(|run| run.seed);
        let own: Vec<usize> = (0..runs.len()).filter(|at| Some(runs[*at].seed) == first).collect();
        own.into_iter()
    }

    /// Adds runs for those of the target's control that the text read back reaches.
    pub fn fork_for_facts(&mut self) {
        if self.open[1] != 0 {
            let stmts = &self.batch.stmts;
            for (at, bits) in self.met_by(|run| self.open[1] & come_to(&run.target, stmts)) {
                self.fork_with_each(at, bits, false);
            }
        }
    }

    fn fork_with_each(&mut self, at: usize, bits: u64, source: bool) {
        if bits == 0 {
            return;
        }
        for behaviour in Behaviour::ALL.iter().copied().filter(|behaviour| bits & behaviour.bit() != 0) {
            for value in self.other_values(behaviour, source) {
                self.fork_with(at, Other::Behaviour { behaviour, source, value });
            }
        }
    }

    /// The value of a behaviour that the runs have.
    fn usual(&self, behaviour: Behaviour, source: bool) -> u8 {
        let run = self.runs.first();
        run.map_or(0, |run| if source { &run.source } else { &run.target }.behaviours().get(behaviour))
    }

    /// Values of a behaviour that the control can have, but the one that the runs have.
    pub fn other_values(&self, behaviour: Behaviour, source: bool) -> Vec<u8> {
        let Some(run) = self.runs.first() else { return Vec::new() };
        let exec = if source { &run.source } else { &run.target };
        exec.behaviours().others(behaviour).collect()
    }

    /// Adds a run with another fact to one of the runs, unless it has one, or the fact is known to make another cut.
    fn fork_with(&mut self, at: usize, other: Other) {
        let skip = self.runs[at].skip;
        let known = self.matters.iter().any(|(found, _)| *found == other);
        if known || self.others.iter().any(|run| run.other == Some(other) && run.skip == skip) {
            return;
        }
        let usual = &mut self.runs[at];
        let events = std::mem::take(&mut usual.source_events);
        let mut run = usual.clone();
        usual.source_events = events;
        run.comparison.keep_pairs(false);
        run.take(other);
        if !run.shares(0) {
            run.source_events.extend_from_slice(&usual.source_events);
        }
        run.taken = [run.source_events.len(), run.target_events.len()];
        self.others.push(run);
    }

    /// Executes statements of the source in the runs with another fact. A program that cannot be executed with a fact is not
    /// compared under it.
    pub fn others_source(&mut self, stmts: &[Stmt]) {
        self.others.retain_mut(|run| {
            run.shares(0) || stmts.iter().all(|stmt| run.source.step(stmt, &mut run.source_events).is_ok())
        });
    }

    /// Executes the text read back in the runs with another fact, and compares; the usual runs have executed it.
    ///
    /// # Errors
    /// A difference that the fact does not explain.
    pub fn others_step(&mut self, over: bool) -> Result<(), Stop> {
        let (mut found, mut wrong) = (Vec::new(), None);
        let (stmts, last, runs) = (&self.batch.stmts, self.last, &self.runs);
        self.others.retain_mut(|run| {
            let Some(usual) = run.usual(runs) else { return false };
            let own = !run.shares(1);
            if own && !stmts.iter().all(|stmt| run.target.step(stmt, &mut run.target_events).is_ok()) {
                // With this fact the target's control stops at what is executed otherwise.
                found.extend(run.other.map(|other| (other, last)));
                return false;
            }
            if over && !run.shares(0) {
                run.source.end_of_text(&mut run.source_events);
            }
            if over && own {
                run.target.end_of_text(&mut run.target_events);
            }
            run.share(usual);
            let sides = [
                if run.shares(0) { &usual.source } else { &run.source },
                if run.shares(1) { &usual.target } else { &run.target },
            ];
            let fed = run.fed_otherwise_with(sides);
            let (a, b) = (&mut run.source_events, &mut run.target_events);
            let advanced = run.comparison.advance(a, b, over);
            // There are many forks, and much room in each for few events.
            a.shrink_to_fit();
            b.shrink_to_fit();
            match (advanced, run.other) {
                (Err(difference), Some(other)) if !other.explains(run) => {
                    wrong = wrong.take().or(Some(different(&difference, None, last)));
                    false
                }
                (Err(difference), Some(other)) => {
                    let at = difference.source.as_ref().map_or(last, |event| event.span);
                    found.push((other, at));
                    false
                }
                (Ok(()) | Err(_), other) => match fed {
                    Some(at) => {
                        found.extend(other.map(|other| (other, at)));
                        false
                    }
                    None => true,
                },
            }
        });
        self.matters.append(&mut found);
        wrong.map_or(Ok(()), Err)
    }

    /// Leaves out runs that have reached the state of the usual one: what follows is the same.
    pub fn drop_same(&mut self) {
        let runs = &self.runs;
        self.others.retain_mut(|run| {
            let Some(usual) = run.usual(runs) else { return false };
            run.taken = [usual.source_events.len(), usual.target_events.len()];
            // A control agrees with itself only between blocks, and where nothing is under way.
            let side = |side: usize, own: &Exec, usual: &Exec| {
                if run.shares(side) { usual.agrees(usual) } else { own.agrees(usual) }
            };
            !(side(0, &run.source, &usual.source)
                && side(1, &run.target, &usual.target)
                && run.source_events == usual.source_events
                && run.target_events == usual.target_events)
        });
    }
}

/// Whether facts are tried wherever they are met under a setting of the block-skip switches, `all` of them being
/// those that occur: all off, all on, or one alone on. Under others a fact is tried where it is met under none of these.
pub fn tries_facts(skip: u16, all: u16) -> bool {
    skip.count_ones() <= 1 || skip == all
}

/// Open facts of both controls that are looked at: those that matter at the machine, between two controls.
pub fn looked_at(job: &Job) -> [u64; 2] {
    let matter = Behaviour::ALL.iter().filter(|behaviour| behaviour.concern() != Concern::Nothing);
    let matter = matter.fold(0, |bits, behaviour| bits | behaviour.bit());
    [&job.from, &job.to]
        .map(|side| if job.between_controls() { side.behaviours().open() & matter } else { 0 })
}

/// Whether the switch for optional stops makes a difference: spindle and coolant stop there on one of the controls.
pub fn stops_differ(job: &Job) -> bool {
    let stops = |behaviours: Behaviours| {
        behaviours.does(Behaviour::SpindleAtStop) || behaviours.does(Behaviour::CoolantAtStop)
    };
    let [from, to] = [job.from.behaviours(), job.target_behaviours()].map(stops);
    from != to || job.between_controls() && from
}

/// The switch for optional stops, among the bits of behaviours.
pub const OPTIONAL_STOP: u64 = 1 << 63;

const _: () = assert!(Behaviour::ALL.len() < 63);

/// Facts that statements reach from the state that a control is in, a bit each.
#[inline]
pub fn come_to(exec: &Exec, stmts: &[Stmt]) -> u64 {
    let stop = |stmt: &Stmt| matches!(stmt.op, Op::OptionalProgramStop);
    let of = |stmt: &Stmt| touched(&stmt.op) | if stop(stmt) { OPTIONAL_STOP } else { 0 };
    let executed = stmts.iter().filter(|stmt| !exec.skips(stmt));
    executed.fold(exec.comes_to(stmts), |bits, stmt| bits | of(stmt))
}
