//! Verification of a translation as it streams by: source and emitted text are executed in the same
//! worlds and under the same block-skip settings, and their events compared.
//!
//! ```text
//! source: G0 X10 | output: G0 X10    the same event in each world
//! source: G55    | output: G54       an event elsewhere: nothing is released
//! ```
//!
//! Not here: what an event is, and when two are the same (`ncc_exec::verify`).

mod arcs;
pub mod controls;
mod differences;
mod ended;
pub mod facts;
pub mod forks;
mod holes;
mod levels;
mod paced;
pub mod per_tool;
mod table;
pub mod twice;
mod verifier;
pub mod whole;
pub mod with_facts;
pub mod worlds;

use ncc_dialects::Quantity;
use ncc_exec::Exec;
use ncc_exec::verify::{self, Comparison, Pair};
use ncc_frontends::Batch;
use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Fault, Gravity};
use ncc_ir::lack::ModesLack;
use ncc_ir::program::{Op, ProgramName, Stmt};
use ncc_ir::source::Span;
use ncc_passes::values::variables::Fineness;

use self::controls::{fixed, resolution, with_parameters, writes};
use self::differences::different;
use self::facts::looked_at;
use self::verifier::{ALL_SETTINGS, Run, unreadable};
use self::with_facts::MOST_WITH_FACT;
use crate::job::{self, Job, Verified};
use crate::render::messages::message::{Message, Part};

pub use self::facts::stops_differ;
pub use self::levels::levels;
pub use self::verifier::{Stop, Verifier};
pub use self::worlds::worlds_of;

/// Generated worlds in which every program is executed.
pub const WORLDS: u32 = 2;

/// To which digits the target's lengths are rounded, those that are written and those that are computed.
fn fineness(job: &Job) -> Fineness {
    let rules = job.to.dialect.numbers(Quantity::Length);
    let computed = [rules.increment, rules.increment_inch.unwrap_or(rules.increment)];
    Fineness {
        written: [rules.decimals, rules.decimals_inch.unwrap_or(rules.decimals)],
        computed: job.to.dialect.formula.rounds.then_some(computed),
    }
}

/// What the target's control always begins with, as far as the source's has no such fact.
fn own_facts(job: &Job) -> Modes {
    let (from, to) = (fixed(job.from.dialect), fixed(job.to.dialect));
    Modes {
        motion: to.motion.filter(|_| from.motion.is_none()),
        distance: to.distance.filter(|_| from.distance.is_none()),
        units: to.units.filter(|_| from.units.is_none()),
        plane: to.plane.filter(|_| from.plane.is_none()),
        feed_mode: to.feed_mode.filter(|_| from.feed_mode.is_none()),
        return_level: to.return_level.filter(|_| from.return_level.is_none()),
        work_offset: to.work_offset.filter(|_| from.work_offset.is_none()),
        length_offset: to.length_offset.filter(|_| from.length_offset.is_none()),
        no_origin_shift: to.no_origin_shift.filter(|_| from.no_origin_shift.is_none()),
    }
}

impl Verifier {
    /// A verifier of what ncc itself writes. Where the source's operator changes tools, its words move Z to machine zero
    /// before the first tool, too, and later moves may rely on that: the output must do the same. Of two programs that
    /// somebody has written, the first change is passed over, because the target's machine may stand up there anyway.
    pub(crate) fn of_translation(job: &Job) -> Verifier {
        let mut verifier = Verifier::new(job);
        if job.from.dialect.can.change_by_hand {
            verifier.runs.iter_mut().for_each(|run| run.target.counts_z_at_start());
        }
        verifier
    }

    pub(crate) fn new(job: &Job) -> Verifier {
        let renaming = job.renaming();
        let mut finest = resolution(&job.to);
        if job.works_compensation_out() {
            // Both sides compute, in coordinates of their own: a millionth is what they have in common.
            (finest.mm, finest.inch) = (finest.mm.min(6), finest.inch.min(7));
        }
        let computes = job.to.caps().flow.computes;
        let computes = computes.as_deref();
        let runs = (1..=WORLDS)
            .map(|seed| {
                let [source, target] = worlds_of(job, seed);
                let mut comparison = Comparison::new(finest, source.start);
                comparison.rename_tools(renaming.tools.clone(), &renaming.tool_names);
                comparison.see(ncc_exec::Seen::by(&job.to.dialect.caps));
                comparison.say_alarms(computes.and_then(|there| there.alarms.clone()));
                if stops_differ(job) {
                    comparison.optional_stops();
                }
                Run {
                    seed,
                    skip: 0,
                    comparison,
                    source: Exec::new(&source, 0),
                    target: Exec::new(&target, 0),
                    source_events: Vec::new(),
                    target_events: Vec::new(),
                    level: false,
                    other: None,
                    taken: [0; 2],
                }
            })
            .collect();
        let mut runs: Vec<Run> = runs;
        if job.from.dialect.can.flat || job.to.dialect.can.flat {
            runs.iter_mut().flat_map(|run| [&mut run.source, &mut run.target]).for_each(Exec::without_blocks);
        }
        if job.works_compensation_out() {
            let rules = job.compensating().rules;
            runs.iter_mut().for_each(|run| run.source.compute_compensation(rules));
        }
        if job.between_controls() {
            runs.iter_mut()
                .flat_map(|run| [&mut run.source, &mut run.target])
                .for_each(Exec::between_controls);
        }
        if !job.to.dialect.caps.modes.messages {
            // Their loss is a verdict of its own, that stops unless it is allowed.
            let stops = job.to.dialect.caps.modes.stop_messages;
            runs.iter_mut().for_each(|run| run.source.mute(stops));
        }
        if !writes(&job.to) {
            runs.iter_mut().for_each(|run| run.source.without_output());
        }
        // Nobody has put other values in the messages of a program that is executed.
        let in_full = computes.and_then(|there| there.values_in_full);
        if let Some(digits) = in_full.filter(|_| job.passes.is_empty()) {
            runs.iter_mut().for_each(|run| run.source.values_in_full(digits));
        }
        Verifier {
            reader: facts::reader_of_output(job),
            as_called: false,
            answered: Vec::new(),
            batch: Batch::default(),
            runs,
            others: Vec::new(),
            holes_ahead: None,
            holes_differ: false,
            strokes_differ: false,
            arcs_ahead: None,
            paced_ahead: None,
            open: looked_at(job),
            optional_stop: stops_differ(job),
            matters: Vec::new(),
            untried: Vec::new(),
            reach: MOST_WITH_FACT,
            events_of_sets: 0,
            levels: 0,
            renamed: !renaming.is_empty(),
            watched: false,
            one_level: job.to.dialect.caps.flow.skip_levels <= 1,
            start: job::start::Start::of(job),
            stood: false,
            own_facts: own_facts(job),
            given: job.given_to_runs(),
            fineness: fineness(job),
            near: computes.is_some_and(|there| there.near),
            functions: computes.map(|there| there.functions.clone()).unwrap_or_default(),
            equal_within: computes.and_then(|there| there.equal_within),
            last: Span::default(),
            outliving: Vec::new(),
            assumed: Modes::default(),
            shortest_stretch: job.shortest_stretch,
            piece: job.piece,
            notes: Vec::new(),
        }
    }

    /// Keeps the pairs of events of the first world, with every block-skip switch off.
    pub fn watch(&mut self) {
        self.watched = true;
        if let Some(run) = self.runs.first_mut() {
            run.comparison.keep_pairs(true);
        }
    }

    /// The pairs found since this was last asked, and the place in the text before which no further
    /// ones are found; `None` is its end.
    pub fn take_pairs(&mut self) -> (Vec<Pair>, Option<u32>) {
        let Some(run) = self.runs.first_mut() else { return (Vec::new(), None) };
        (run.comparison.take_pairs(), run.target_events.first().map(|event| event.span.start))
    }

    /// Reads the head of the output, which opens its frame; it makes no events.
    pub fn head(&mut self, text: &[u8]) -> Result<(), Stop> {
        self.reader.read(text, 0, &mut self.batch);
        self.batch.name = ProgramName::default();
        let silent = |s: &Stmt| matches!(s.op, Op::Comment(_) | Op::Blank);
        if !self.batch.stmts.iter().all(silent) {
            let difference = Message::part(Part::Difference, "head").headline().into();
            let fault = Fault::NotTheSame { difference };
            return Err(Stop::Target(Diagnostic::new(fault, self.last)));
        }
        self.batch.stmts.clear();
        self.read_back(&Modes::default())
    }

    /// The source control's parameters of cycles are assumed of both controls.
    fn take_parameters(&mut self, job: &Job) {
        let all = self.runs.iter_mut().chain(&mut self.others);
        all.flat_map(|run| [&mut run.source, &mut run.target]).for_each(|exec| with_parameters(exec, job));
    }

    /// Whether [`Verifier::take`] has anything to do with it.
    pub fn takes(found: &[Diagnostic]) -> bool {
        found.iter().any(|diagnostic| {
            matches!(
                diagnostic.fault,
                Fault::AssumedFact { .. } | Fault::PatternFolded { .. } | Fault::MachineCutFolded { .. }
            )
        })
    }

    /// What the passes have assumed of both controls, and patterns that they have folded:
    /// their holes are where the source writes them to half its own least increment.
    pub fn take(&mut self, found: &[Diagnostic], job: &Job) {
        debug_assert!(self.holes_ahead.is_none(), "the source is executed after this");
        let mut parameters = false;
        for diagnostic in found {
            match diagnostic.fault {
                Fault::AssumedFact { .. } => parameters = true,
                Fault::PatternFolded { digits, inch, .. } | Fault::MachineCutFolded { digits, inch } => {
                    let all = self.runs.iter_mut().chain(&mut self.others);
                    all.for_each(|run| run.comparison.rounded(digits, inch));
                }
                _ => {}
            }
        }
        if parameters {
            self.take_parameters(job);
        }
    }

    /// Executes further statements of the source's main procedure.
    pub fn source(&mut self, stmts: &[Stmt], assumed: &Modes) -> Result<(), Stop> {
        self.make_holes()?;
        self.prepare(stmts, assumed);
        if self.hold_holes(stmts)? || self.hold_paced(stmts) {
            return Ok(());
        }
        self.run_source_to_holes(stmts)
    }

    fn run_source(&mut self, stmts: &[Stmt]) -> Result<(), Stop> {
        for run in &mut self.runs {
            for stmt in stmts {
                run.source.step(stmt, &mut run.source_events).map_err(Stop::Source)?;
            }
        }
        self.others_source(stmts);
        if let Some(stmt) = stmts.last() {
            self.last = stmt.span;
        }
        Ok(())
    }

    /// A piece of which the text is to say the source's statements one by one: executes and compares
    /// both. Plain moves that are read back as they were stated are executed once by controls in one
    /// state, because both do the same.
    pub fn piece(
        &mut self,
        stmts: &[Stmt],
        assumed: &Modes,
        text: &[u8],
        base: u32,
        inherited: &Modes,
    ) -> Result<(), Stop> {
        self.make_holes()?;
        self.reader.read(text, base, &mut self.batch);
        self.piece_read(stmts, assumed, inherited)
    }

    /// The same of a text that has been read.
    fn piece_read(&mut self, stmts: &[Stmt], assumed: &Modes, inherited: &Modes) -> Result<(), Stop> {
        if !self.same_plain(stmts) {
            self.source(stmts, assumed)?;
            return self.target_read(inherited);
        }
        let absolute = |run: &Run| run.source.counts_absolute() && run.target.counts_absolute();
        let absolute =
            self.stood && self.runs.iter().all(absolute) && !stmts.iter().any(verify::counts_from_there);
        // A level of block skip that is met for the first time has settings of its own.
        match absolute && levels(stmts) & !self.levels == 0 {
            true => self.assume(assumed),
            false => self.prepare(stmts, assumed),
        }
        self.read_back(inherited)?;
        let alike = |run: &Run| absolute || run.source.counts_alike(&run.target, stmts);
        let levels = levels(stmts);
        let switches = |run: &Run| run.source.skips_as(&run.target, levels);
        let agree = |run: &Run| run.source.agrees_on_lines(&run.target) && alike(run) && switches(run);
        if !self.others.is_empty() || !self.runs.iter().all(agree) {
            // This piece is the first to rely on something that only one of them has.
            return self.run_source(stmts).and_then(|()| self.target_step());
        }
        let mut valued = self.runs.first().and_then(|run| run.source.value_lines(stmts));
        for run in &mut self.runs {
            let events = match &mut valued {
                _ if run.comparison.keeps_pairs() => run.pass_in_pairs(stmts, &self.batch.stmts),
                Some(valued) => run.source.pass_valued(valued).map_or_else(|| run.source.pass(stmts), Ok),
                None => run.source.pass(stmts),
            };
            let events = events.map_err(Stop::Source)?;
            run.target.follow(&run.source);
            run.target.has_moved(stmts);
            run.comparison.pass(events, run.source.machine());
        }
        self.batch.stmts.clear();
        if let Some(stmt) = stmts.last() {
            self.last = stmt.span;
        }
        Ok(())
    }

    /// Reads a further piece of emitted text back, executes it and compares. `inherited` are the
    /// assumed facts that the text does not state itself.
    pub fn target(&mut self, text: &[u8], base: u32, inherited: &Modes) -> Result<(), Stop> {
        match self.reads_strokes() {
            true => self.reader.read_to_table(text, base, &mut self.batch),
            false => self.reader.read(text, base, &mut self.batch),
        }
        self.target_read(inherited)
    }

    fn target_read(&mut self, inherited: &Modes) -> Result<(), Stop> {
        self.read_back(inherited)?;
        self.target_step()
    }

    /// Executes what was read back, and compares.
    fn target_step(&mut self) -> Result<(), Stop> {
        if let Some(holes) = self.take_holes_read() {
            self.step_read()?;
            self.batch.stmts = holes;
        }
        if self.pass_holes()? || self.pass_paced() { Ok(()) } else { self.step_read() }
    }

    fn step_read(&mut self) -> Result<(), Stop> {
        let found = levels(&self.batch.stmts);
        self.fork_for_target(&[found]);
        self.fork_for_facts();
        self.compare_read()?;
        for run in &mut self.runs {
            let nothing_left = run.source_events.is_empty() && run.target_events.is_empty();
            // Holes that pass leave no pairs of events, and paced lines none either.
            let alike = run.source.agrees_on_lines(&run.target)
                || !self.watched
                    && (run.source.makes_holes_of(&run.target)
                        || run.source.makes_strokes_of(&run.target)
                        || run.source.paces_as(&run.target));
            run.level = nothing_left && !self.renamed && alike;
        }
        self.drop_same();
        self.batch.stmts.clear();
        Ok(())
    }

    /// Whether the text just read says plain moves as they were stated, and all controls are level.
    fn same_plain(&self, said: &[Stmt]) -> bool {
        self.others.is_empty()
            && self.runs.iter().all(|run| run.level)
            && verify::same_lines(said, &self.batch.stmts)
    }

    /// Ends a program that was streamed to its end.
    pub fn finish(&mut self) -> Result<(), Stop> {
        self.make_holes()?;
        let mut rest = Batch::default();
        self.reader.finish(&mut rest);
        self.batch.stmts.append(&mut rest.stmts);
        self.batch.diagnostics.append(&mut rest.diagnostics);
        self.read_back(&Modes::default())?;
        self.fork_for_facts();
        self.usual_target()?;
        for run in &mut self.runs {
            run.source.no_open_corner().map_err(Stop::Source)?;
            run.source.end_of_text(&mut run.source_events);
            run.target.end_of_text(&mut run.target_events);
        }
        self.others_step(true)?;
        for run in &mut self.runs {
            run.comparison
                .advance(&mut run.source_events, &mut run.target_events, true)
                .map_err(|d| different(&d, run.source.unsaid(&self.own_facts), self.last))?;
        }
        self.compare_next_runs();
        Ok(())
    }

    /// What was covered.
    pub fn covered(&self) -> Verified {
        Verified {
            worlds: WORLDS,
            skip_settings: self.runs.len() as u32 / WORLDS,
            events: self.runs.iter().map(|r| r.comparison.events).sum::<u64>() + self.events_of_sets,
        }
    }

    /// Levels of block skip that occur, if not every setting of them was tried.
    pub fn sampled(&self) -> Option<u8> {
        let levels = self.levels.count_ones();
        let all = !self.one_level && levels <= ALL_SETTINGS || levels <= 1;
        (!all).then_some(levels as u8)
    }

    fn assume(&mut self, assumed: &Modes) {
        self.assumed = *assumed;
        self.runs.iter_mut().for_each(|run| run.source.assume(assumed));
    }

    fn prepare(&mut self, stmts: &[Stmt], assumed: &Modes) {
        self.fork(levels(stmts));
        self.fork_for_source(stmts);
        self.begin(assumed);
    }

    /// Takes for granted what the source does; at the beginning all controls stand where it begins.
    fn begin(&mut self, assumed: &Modes) {
        self.assumed = *assumed;
        for run in self.runs.iter_mut().chain(&mut self.others) {
            run.source.assume(assumed);
            if !self.stood {
                self.start.put([&mut run.source, &mut run.target]);
                run.target.be_at(run.source.machine());
                run.comparison.start_at(run.source.machine());
            }
        }
        self.stood = true;
    }

    /// Branches with one covered side, which has been reported where they stand.
    pub fn answered(&mut self, decisions: Vec<Span>) {
        self.answered = decisions;
    }

    /// Takes the facts that the output inherits, and refuses what could not be read back.
    fn read_back(&mut self, inherited: &Modes) -> Result<(), Stop> {
        let own = self.batch.assumed;
        if self.as_called && own.or(*inherited) != *inherited {
            let lack = match (own.units, inherited.units) {
                (Some(_), None) => ModesLack::UnitsAfterLabel,
                _ => ModesLack::CallersModes,
            };
            return Err(Stop::Source(Diagnostic::new(Fault::lacks(lack), self.last)));
        }
        for run in self.runs.iter_mut().chain(&mut self.others) {
            // What the text itself assumes goes before what it inherits.
            run.target.assume(&own);
            run.target.assume(inherited);
        }
        // A text that says nothing is read: whether nothing is what the source does, the events tell.
        let fault =
            |d: &&Diagnostic| d.fault.gravity() == Gravity::Error && !matches!(d.fault, Fault::EmptyProgram);
        let error = self.batch.diagnostics.iter().find(fault);
        if let Some(d) = error {
            return Err(unreadable(d, self.last));
        }
        self.note_assumed();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ncc_dialects::{Settings, builtin};
    use ncc_frontends::Reader;

    pub(super) const FIRST: &str = "%\nO1\nG21 G17 G90 G40 G49 G80 G94\nG54\nT1 M06\nS500 M03\nG00 X0. Y0.\nG43 H1 Z5.\nG01 Z-1. F100.\n";
    pub(super) const SECOND: &str = "X10.\nY10. Z-1.5\nX0. F200.\nG00 Z5.\n";

    pub(super) fn job() -> Job {
        let settings = Settings::new(builtin("fanuc").expect("a built-in dialect"));
        Job::new(settings.clone(), settings, "piece.nc")
    }

    /// Verifies a first piece as it is, and a second one of which the output says something else.
    fn second_piece(said: &str, written: &str) -> Result<Verifier, Stop> {
        let job = job();
        let mut reader = Reader::new(job.from.clone(), true);
        let mut verifier = Verifier::new(&job);
        let mut batch = Batch::default();
        for (said, written) in [(FIRST, FIRST), (said, written)] {
            reader.read(said.as_bytes(), 0, &mut batch);
            let stmts = std::mem::take(&mut batch.stmts);
            verifier.piece(&stmts, &batch.assumed, written.as_bytes(), 0, &batch.assumed)?;
        }
        Ok(verifier)
    }

    #[test]
    fn level_controls_make_the_same_events_once() {
        let verifier = second_piece(SECOND, SECOND).expect("the same program");
        assert!(verifier.runs.iter().all(|run| run.level && run.source.agrees(&run.target)));
        // A tool change and three moves, then four moves, in each world.
        assert_eq!(verifier.covered().events, u64::from(WORLDS) * 8);
        let remarks = SECOND.replace("\n", " (A REMARK)\n");
        let verifier = second_piece(&remarks, &format!("(ANOTHER)\n{SECOND}")).expect("the same program");
        let once = |run: &Run| run.level && run.target_events.capacity() < 8;
        assert!(verifier.covered().events == u64::from(WORLDS) * 8 && verifier.runs.iter().all(once));
    }

    #[test]
    fn a_late_piece_that_says_something_else_is_seen() {
        for (from, to) in [("Y10.", "Y10.001"), ("F200.", "F201."), ("G00 Z5.", "Z5."), ("X10.\n", "")] {
            let written = SECOND.replacen(from, to, 1);
            assert!(matches!(second_piece(SECOND, &written), Err(Stop::Target(_))), "{from} → {to}");
        }
        // What is more or less at the end, a next piece may have.
        for written in [format!("{SECOND}Z6.\n"), SECOND.replacen("G00 Z5.\n", "(A REMARK)\n", 1)] {
            let verifier = second_piece(SECOND, &written).expect("no difference yet");
            assert!(verifier.runs.iter().all(|run| !run.level), "{written}");
        }
    }

    /// Blocks under a skip switch too; a level that is met for the first time has settings of its own.
    #[test]
    fn skipped_lines_are_executed_once_under_each_setting() {
        const SKIPPED: &str = "/X10.\nY10. Z-1.5\n/2X0. F200.\n/G00 Z5.\n";
        let verifier = second_piece(SKIPPED, SKIPPED).expect("the same program");
        assert!(verifier.runs.len() == 4 * WORLDS as usize && verifier.runs.iter().all(|run| run.level));
        for (from, to) in [
            ("/X10.", "X10."),
            ("/X10.", "/2X10."),
            ("/2X0.", "/2X0.001"),
            ("/2X0. F200.", "/2X0. F201."),
            ("/G00 Z5.", "/Z5."),
            ("/X10.\n", ""),
        ] {
            let written = SKIPPED.replacen(from, to, 1);
            assert!(matches!(second_piece(SKIPPED, &written), Err(Stop::Target(_))), "{from} → {to}");
        }
    }

    /// What lies in which slot is another thing on each control; what counts for a line is where it puts the tool.
    #[test]
    fn lines_behind_a_turned_frame_are_executed_once() {
        let settings = |id| Settings::new(builtin(id).expect("a built-in dialect"));
        let job = Job::new(settings("fanuc"), settings("siemens"), "piece.nc");
        let verified = |turned: &str, written: &str| {
            let pieces = [
                (
                    FIRST.to_owned(),
                    "G71 G17 G90 G40 G94\nG54\nT1 M6\nS500 M3\nG0 X0 Y0\nD1 Z5\nG1 Z-1 F100\n",
                ),
                ("G68 X0. Y0. R30.\n".to_owned(), turned),
                ("G01 X10. Y0.\nY10. Z-1.5\nX0. F200.\nG00 Z5.\n".to_owned(), written),
            ];
            let mut reader = Reader::new(job.from.clone(), true);
            let mut verifier = Verifier::new(&job);
            let mut batch = Batch::default();
            for (said, written) in &pieces {
                reader.read(said.as_bytes(), 0, &mut batch);
                let stmts = std::mem::take(&mut batch.stmts);
                verifier.piece(&stmts, &batch.assumed, written.as_bytes(), 0, &batch.assumed)?;
            }
            Ok::<_, Stop>(verifier)
        };
        let written = "G1 X10 Y0\nY10 Z-1.5\nX0 F200\nG0 Z5\n";
        let verifier = verified("ROT RPL=30\n", written).expect("the same program");
        let once = |run: &Run| run.level && !run.source.agrees(&run.target);
        assert!(verifier.runs.iter().all(once), "one frame, in other slots");
        assert!(matches!(verified("ROT RPL=30.01\n", written), Err(Stop::Target(_))));
        for (from, to) in [("Y10 ", "Y10.001 "), ("F200", "F201"), ("G0 Z5", "Z5"), ("X0 F200\n", "F200\n")] {
            let written = written.replacen(from, to, 1);
            let found = verified("ROT RPL=30\n", &written);
            assert!(matches!(found, Err(Stop::Target(_))), "{from} → {to}");
        }
    }

    /// Controls that are level may still have a fact from their world; the source alone takes it for granted.
    #[test]
    fn what_only_the_source_takes_for_granted_ends_the_level() {
        let job = job();
        let mut reader = Reader::new(job.from.clone(), true);
        let mut verifier = Verifier::new(&job);
        let mut batch = Batch::default();
        let mut piece = |text: &str, verifier: &mut Verifier| {
            reader.read(text.as_bytes(), 0, &mut batch);
            let stmts = std::mem::take(&mut batch.stmts);
            verifier.piece(&stmts, &batch.assumed, text.as_bytes(), 0, &Modes::default())
        };
        piece("%\nO1\nG21 G17 G90 G40 G49 G80 G94\nM08\n", &mut verifier).expect("no move, no work offset");
        assert!(verifier.runs.iter().any(|run| run.level));
        assert!(matches!(piece("G01 X10. F100.\n", &mut verifier), Err(Stop::Target(_))));
    }
}
