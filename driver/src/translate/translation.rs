//! One translation on its way: what is between source and output, piece by piece.

use super::heading;
use super::parametric::{self, target};
use super::parametric::{bore_shift, orientation, parameter};

use std::collections::{BTreeSet, HashMap};
use std::io;

use ncc_backends::{Head, Origin, Writer};
use ncc_dialects::{BREAK_LIFT, PECK_CLEARANCE};
use ncc_frontends::{Batch, Reader};
use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Fault, Gravity, Verdict};
use ncc_ir::program::valid::{anything, computing, leads_nowhere, returns_alone};
use ncc_ir::program::{Lines, Op, Program, ProgramName, Stmt};
use ncc_ir::source::Span;
use ncc_ir::track::Tracker;
use ncc_machines::reading::{Told, rests_on};
use ncc_passes::flow::given_back::left_out;
use ncc_passes::flow::passed_labels;
use ncc_passes::frames::machine_cuts;
use ncc_passes::modes::own_distance;
use ncc_passes::modes::side_effects::SideEffects;
use ncc_passes::support::known_facts::Known;
use ncc_passes::tools::machine_numbers::Renumbering;
use ncc_passes::values::variables::Renamed;
use ncc_passes::watch::{ran, ran_whole};
use ncc_passes::{Legaliser, leave_out_values};

use crate::job::{Failure, Job, Outcome, Output, Rest};
use crate::machines::pair::Answer;
use crate::provenance::annotate::Annotator;
use crate::provenance::trace::{Asked, Trace};
use crate::questions::{Policy, Question};
use crate::translate::rewrite::{self, Folder};
use crate::verify_run::{Stop, Verifier};

/// Pass that executes what is computed.
pub(super) const FLATTEN: &str = "flatten";

/// Highest number of a program.
const MOST_NUMBER: u32 = 99_999_999;

/// What is between source and output.
pub(super) struct Translation<'j> {
    pub(super) job: &'j Job,
    pub(super) reader: Reader,
    pub(super) batch: Batch,
    pub(super) folder: Option<Folder>,
    /// Puts the target machine's numbers in.
    pub(super) renumbering: Renumbering,
    /// Writes what codes of the source's control do besides their names.
    pub(super) side_effects: SideEffects,
    pub(super) legaliser: Legaliser,
    pub(super) writer: Writer,
    pub(super) text: Vec<u8>,
    pub(super) verifier: Option<Verifier>,
    /// Puts the source beside the text.
    pub(super) annotator: Option<Annotator>,
    /// Where the text comes from.
    pub(super) trace: Option<Trace>,
    /// Facts that always hold for the source's control and were stated for the target's.
    pub(super) given: Modes,
    pub(super) output: Output,
    pub(super) written: u64,
    pub(super) diagnostics: Vec<Diagnostic>,
    pub(super) rests: Vec<Rest>,
    pub(super) questions: Vec<Question>,
    /// Numbers of the output's subprograms.
    pub(super) numbers: BTreeSet<u32>,
    /// Whether the shop's lines before the end of the program are written.
    pub(super) footed: bool,
    pub(super) errors: usize,
    pub(super) refused: bool,
    pub(super) failed: bool,
    pub(super) statements: u64,
    pub(super) blocks: u64,
    /// Whether the program says how corners are taken.
    pub(super) sets_path: bool,
    /// Whether it computes, and keeps that.
    pub(super) computes: bool,
}

impl<'j> Translation<'j> {
    pub(super) fn new(job: &'j Job) -> Translation<'j> {
        let mut legaliser =
            Legaliser::new(&job.to.caps(), parametric::decimals(job), parameter(job, PECK_CLEARANCE));
        legaliser.set_break_lift(parameter(job, BREAK_LIFT));
        legaliser.set_fine_boring(bore_shift(job), orientation(job));
        // The text form can hold what any dialect can say.
        let own = job.from.dialect.block.qualifiers || job.from.dialect.can.everything;
        legaliser.set_measures(own);
        legaliser.set_source_arcs(job.from.arc_rule());
        legaliser.set_source_refuses(job.from.dialect.caps.refused_compensated);
        legaliser.set_source_looks_over(job.looks_over_blocks());
        if job.between_controls() {
            legaliser.between_controls(!job.from.dialect.can.rounds_freely);
        }
        legaliser.set_source_behaviours(job.source_behaviours(), job.from.dialect.can.change_by_hand);
        legaliser.stand_at(&job.start);
        let maps = job.maps();
        legaliser.set_edge_entries(maps.edge_entries.clone());
        legaliser.set_program_numbers(maps.program_numbers.clone());
        let start = Tracker { position: job.start, ..Tracker::default() };
        let folder = job.folds().then(|| Folder::new(target(job), start, job.from.dialect.caps.flat));
        let mut writer = Writer::new(job.to.clone(), job.layout.clone());
        writer.stand_at(&job.start);
        writer.set_form(job.machines.form());
        if job.between_controls() {
            writer.changes_apart();
        }
        let mut translation = Translation {
            job,
            reader: job.reader(true),
            batch: Batch::default(),
            folder,
            renumbering: Renumbering::new(maps),
            side_effects: job.side_effects(),
            legaliser,
            writer,
            text: Vec::new(),
            verifier: job.verify.then(|| Verifier::new(job)),
            annotator: None,
            trace: None,
            given: Modes::default(),
            output: Output::new(),
            written: 0,
            diagnostics: Vec::new(),
            rests: Vec::new(),
            questions: Vec::new(),
            footed: false,
            numbers: BTreeSet::new(),
            errors: 0,
            refused: false,
            failed: false,
            statements: 0,
            blocks: 0,
            sets_path: false,
            computes: false,
        };
        translation.open_frame();
        translation.take(job.assumed.clone(), Told::Reader);
        translation
    }

    /// Begins to record where the text comes from, as asked.
    pub(super) fn record(&mut self, asked: Asked) {
        if asked.anything() {
            self.writer.trace();
        }
        self.annotator = asked.annotate.then(|| Annotator::new(self.job.to.dialect));
        if let (Some(verifier), true) = (&mut self.verifier, asked.map) {
            verifier.watch();
            self.trace = Some(Trace::new());
        }
    }

    /// Lets the verification read a head, which opens the frame of the text. The final one can be
    /// written only at the end, and is read then.
    pub(super) fn open_frame(&mut self) {
        let mut text = Vec::new();
        // A number that no subprogram is likely to have; it is not the one that is written.
        let name = ProgramName { number: Some(MOST_NUMBER), title: None };
        self.writer.head(&Head { name, lines: Vec::new() }, &mut text, &mut Vec::new());
        self.check(|v| v.head(&text));
    }

    /// A piece of the source.
    pub(super) fn piece(&mut self, text: &[u8], base: u32) -> io::Result<()> {
        self.reader.read(text, base, &mut self.batch);
        self.take_diagnostics();
        // What the target computes is looked at by execution.
        self.batch.whole |= machine_cuts::computes(&self.batch.stmts, self.legaliser.caps());
        if self.batch.whole || !self.job.passes.is_empty() {
            return Ok(());
        }
        self.count();
        let mut stmts = std::mem::take(&mut self.batch.stmts);
        self.streamed(&mut stmts, false)?;
        stmts.clear();
        self.batch.stmts = stmts;
        Ok(())
    }

    /// Statements of a program that streams.
    pub(super) fn streamed(&mut self, stmts: &mut Vec<Stmt>, over: bool) -> io::Result<()> {
        if self.errors > 0 {
            return Ok(());
        }
        let assumed = self.batch.assumed;
        let mut found = Vec::new();
        let unfolded = self.folder.as_mut().map(|folder| folder.piece(stmts, &assumed, over, &mut found));
        self.state_given(stmts);
        let renumbers = self.renumbering.touches(stmts);
        let there = self.taken_there(stmts, &assumed, &mut found);
        let lines = Lines::of(stmts);
        let passes = lines.is_some_and(|lines| self.side_effects.passes(lines));
        let switches = !passes && self.side_effects.touches(stmts);
        let touched = unfolded.is_some() || renumbers || switches || self.legaliser.touches(stmts, lines);
        // What the passes take for granted holds for the source as well.
        let original = touched.then(|| unfolded.unwrap_or_else(|| stmts.clone()));
        if !passes {
            self.side_effects.over(stmts, &mut found);
            ran("side-effects", stmts);
        }
        if touched {
            self.renumbering.over(stmts, &mut found);
            ran("machine-numbers", stmts);
        }
        self.legaliser.run(stmts, &there, lines, &mut found);
        if let Some(original) = original {
            self.take_parameters(&found);
            self.check(|v| v.source(&original, &assumed));
        }
        self.write_main(stmts, &there, &mut found);
        self.take(found, Told::Writer);
        self.release_text(&assumed, (!touched).then_some(&stmts[..]))
    }

    /// The end of the source.
    pub(super) fn end(&mut self) -> io::Result<()> {
        self.reader.finish(&mut self.batch);
        self.take_diagnostics();
        if self.errors > 0 {
            return Ok(());
        }
        self.count();
        if self.batch.whole || !self.job.passes.is_empty() {
            return self.end_whole();
        }
        let mut stmts = std::mem::take(&mut self.batch.stmts);
        self.streamed(&mut stmts, true)?;
        stmts.clear();
        let assumed = self.batch.assumed;
        let there = self.renumbering.modes(&assumed);
        let mut found = Vec::new();
        self.legaliser.finish(&mut stmts, &mut found);
        self.write_main(&stmts, &there, &mut found);
        self.foot(&there, &mut found);
        self.writer.finish(&mut self.text, &mut found);
        self.take(found, Told::Writer);
        self.release_text(&assumed, None)?;
        self.check(Verifier::finish);
        self.trace_events()
    }

    /// The end of a program of which the rest was kept whole.
    pub(super) fn end_whole(&mut self) -> io::Result<()> {
        let assumed = self.batch.assumed;
        let mut body = self.folder.as_mut().map(Folder::held).unwrap_or_default();
        body.append(&mut self.batch.stmts);
        let mut procedures = vec![self.batch.main(body)];
        procedures.append(&mut self.batch.procedures);
        let name = self.batch.name.clone();
        let source = self.by_itself(Program { name, assumed, procedures });
        let source = self.with_parameters(source);
        let unknown = leads_nowhere(&source);
        if !unknown.is_empty() {
            self.take(unknown, Told::Reader);
            return Ok(());
        }
        let mut program = source.clone();
        if self.job.from.dialect.program.macro_b {
            passed_labels::run(&mut program);
            ran_whole("unused-labels", &program);
        }
        let mut found = parametric::begin_with(self.job, &mut program);
        self.side_effects.run(&mut program.procedures, &mut found);
        ran_whole("side-effects", &program);
        if returns_alone(&source).is_some() {
            self.legaliser.nothing_before();
        }
        self.legaliser.frame_increments(&mut program, !self.job.passes.is_empty(), &mut found);
        ran_whole("frame-increments", &program);
        self.take(found, Told::Writer);
        if !self.job.to.dialect.can.everything {
            let mut told = left_out(&program, &self.job.to.caps());
            parametric::alarms(self.job, &mut program, &mut told);
            self.take(told, Told::Writer);
        }
        let (mut known, mut renamed, mut stands) = (Known::default(), Renamed::default(), HashMap::new());
        let mut own_distance = BTreeSet::new();
        self.computes = anything(&source).is_some() && !self.executes_computed();
        if self.computes {
            self.renumbering.tool_names(&mut program);
            ran_whole("tool-names", &program);
            let caps = self.job.to.caps();
            // What is folded or rewritten by name must be known when it is.
            let plainly = self.job.passes.is_empty() && self.folder.is_none();
            let there = caps.computes.as_deref().filter(|_| plainly);
            let mut found = Vec::new();
            if let Some(there) = there {
                leave_out_values(&mut program, &caps, &mut found);
                ran_whole("leave-out-values", &program);
                let stands = self.legaliser.stands();
                (known, renamed) =
                    parametric::legalise_parametric(self.job, &mut program, there, stands, &mut found);
            }
            if there.is_some() && own_distance::others(&program, &known).is_empty() {
                stands = known.modes();
            }
            if there.is_some() && self.job.from.caps().word_distance {
                own_distance = own_distance::places(&program, &known);
                if !caps.word_distance
                    && let Err(refusal) = own_distance::refused(&own_distance, &program)
                {
                    found.push(refusal);
                }
            }
            let refused = |found: &[Diagnostic]| found.iter().any(|d| d.fault.gravity() == Gravity::Error);
            found.extend(computing(&program, there).filter(|_| !refused(&found)));
            if refused(&found) {
                self.take(found, Told::Reader);
                return Ok(());
            }
            self.take_parameters(&found);
            self.take(found, Told::Writer);
        }
        if self.is_refused_alone(&source) {
            return Ok(());
        }
        program.procedures.first_mut().into_iter().for_each(|main| self.state_given(&mut main.body));
        let mut found = Vec::new();
        let start = Tracker { position: self.job.start, modes: assumed, ..Tracker::default() };
        let entry = self.folder.as_ref().map_or(&start, |folder| &folder.entry);
        let mut passes = self.job.passes.clone();
        if self.folder.is_some() {
            passes.extend(rewrite::folds(self.job.from.dialect.caps.flat));
        }
        rewrite::run(&passes, &mut program, &target(self.job), entry, &mut found);
        self.legaliser.frame_increments(&mut program, false, &mut found);
        ran_whole("frame-increments", &program);
        if found.iter().any(|d| d.fault.gravity() == Gravity::Error) {
            self.take(found, Told::Writer);
            return Ok(());
        }
        let main = program.procedures.first().map(|main| main.body.as_slice()).unwrap_or_default();
        let there = self.taken_there(main, &assumed, &mut found);
        self.renumbering.run(&mut program, &mut found);
        ran_whole("machine-numbers", &program);
        if self.computes {
            self.legaliser.run_computing(&mut program, &known, &mut found);
            self.writer.know(&program, &own_distance, stands);
            if found.iter().any(|d| d.fault.gravity() == Gravity::Error) {
                self.take(found, Told::Writer);
                return Ok(());
            }
        } else {
            self.writer.know_modes(&program, parametric::stands(&program, self.legaliser.stands()));
            self.legaliser.run_program(&mut program, &mut found);
        }
        parametric::calls_and_jumps(self.job, [&source, &program], &mut found);
        self.numbers = program.procedures.iter().skip(1).filter_map(|p| p.name.parse().ok()).collect();
        self.take_parameters(&found);
        for (at, procedure) in program.procedures.iter().enumerate() {
            match at {
                0 => {
                    self.write_main(&procedure.body, &there, &mut found);
                    self.foot(&there, &mut found);
                }
                _ => self.writer.procedure(procedure, &mut self.text, &mut found),
            }
        }
        self.writer.finish(&mut self.text, &mut found);
        self.take(found, Told::Writer);
        let text = self.finished_text()?;
        let inherited = self.inherited(&assumed);
        let base = u32::try_from(self.written).unwrap_or(u32::MAX);
        let mut trace = self.trace.take();
        self.check(|v| {
            v.whole_telling((&source, &renamed), &text, base, &inherited, &mut |pairs| {
                if let Some(trace) = &mut trace {
                    trace.pairs(pairs);
                }
            })
        });
        self.trace = trace;
        self.output.push(&text)
    }

    /// Whether what comes behind reading takes everything that is computed: a target that can say everything, as
    /// it is; or the pass that executes it.
    pub(super) fn executes_computed(&self) -> bool {
        match self.job.passes.first() {
            Some(pass) => pass.name == FLATTEN,
            None => self.job.to.dialect.can.everything && self.folder.is_none(),
        }
    }

    /// The text written so far, with what was asked beside it; notes where it comes from.
    pub(super) fn finished_text(&mut self) -> io::Result<Vec<u8>> {
        let mut text = std::mem::take(&mut self.text);
        if self.annotator.is_none() && self.trace.is_none() {
            return Ok(text);
        }
        let origins: Vec<Origin> = self.writer.take_origins();
        if let Some(annotator) = &mut self.annotator {
            text = annotator.apply(&text, &origins, &mut self.writer)?;
        }
        if let Some(trace) = &mut self.trace {
            trace.text(&text, origins)?;
        }
        Ok(text)
    }

    /// Notes the events that the verification has found.
    pub(super) fn trace_events(&mut self) -> io::Result<()> {
        let (Some(trace), Some(verifier)) = (&mut self.trace, &mut self.verifier) else { return Ok(()) };
        let (pairs, over) = verifier.take_pairs();
        trace.pairs(&pairs);
        trace.over(over.map_or(trace.bytes(), u64::from))
    }

    /// What was taken for granted of the source, in the target machine's numbers. Those that it has not
    /// are refused at the first of the statements that rely on them.
    pub(super) fn taken_there(
        &mut self,
        stmts: &[Stmt],
        assumed: &Modes,
        found: &mut Vec<Diagnostic>,
    ) -> Modes {
        let at = stmts.iter().find(|s| !matches!(s.op, Op::Comment(_) | Op::Blank)).or(stmts.first());
        self.renumbering.check_modes(assumed, at.map_or(Span::default(), |s| s.span), found);
        self.renumbering.modes(assumed)
    }

    /// Writes statements of the main procedure; the shop's last lines go before the end of the program.
    pub(super) fn write_main(&mut self, stmts: &[Stmt], assumed: &Modes, found: &mut Vec<Diagnostic>) {
        let taken = assumed.without(&self.given);
        let lines = self.job.machines.layout().footer;
        let end = stmts.iter().position(|s| matches!(s.op, Op::ProgramEnd | Op::BeginAgain));
        let Some(end) = end.filter(|_| !self.footed && !lines.is_empty()) else {
            return self.writer.write(stmts, &taken, &mut self.text, found);
        };
        let block = (0..=end).rev().find(|at| !stmts[*at].joined).unwrap_or(end);
        self.writer.write(&stmts[..block], &taken, &mut self.text, found);
        self.foot(assumed, found);
        self.writer.write(&stmts[block..], &taken, &mut self.text, found);
    }

    /// Writes the shop's last lines, once.
    pub(super) fn foot(&mut self, assumed: &Modes, found: &mut Vec<Diagnostic>) {
        if std::mem::replace(&mut self.footed, true) {
            return;
        }
        let lines = self.job.machines.layout().footer;
        let comments: Vec<Stmt> =
            lines.iter().map(|line| Stmt::new(Span::default(), Op::Comment(line.as_str().into()))).collect();
        // What becomes of the shop's own words is no account of the source.
        let mut silent = Vec::new();
        let taken = assumed.without(&self.given);
        self.writer.write(&comments, &taken, &mut self.text, &mut silent);
        silent.retain(|d| d.fault.gravity() == Gravity::Error);
        found.append(&mut silent);
    }

    /// Lets the verification know what the passes took for granted, and what they folded.
    pub(super) fn take_parameters(&mut self, found: &[Diagnostic]) {
        if let Some(verifier) = &mut self.verifier {
            verifier.take(found, self.job);
        }
    }

    /// Verifies the text written so far and passes it on; `said` are the statements that it says, if
    /// they are the source's own.
    pub(super) fn release_text(&mut self, assumed: &Modes, said: Option<&[Stmt]>) -> io::Result<()> {
        let text = self.finished_text()?;
        let inherited = self.inherited(assumed);
        // Places in the output are told by a map alone, which refuses a base that does not fit.
        let base = u32::try_from(self.written).unwrap_or(u32::MAX);
        self.check(|v| match said {
            Some(stmts) => v.piece(stmts, assumed, &text, base, &inherited),
            None => v.target(&text, base, &inherited),
        });
        self.trace_events()?;
        self.output.push(&text)?;
        self.written += text.len() as u64;
        self.text = text;
        self.text.clear();
        Ok(())
    }

    /// A step of the verification, as long as there is something to verify.
    pub(super) fn check(&mut self, step: impl FnOnce(&mut Verifier) -> Result<(), Stop>) {
        if self.errors > 0 || self.failed {
            return;
        }
        let Some(verifier) = &mut self.verifier else { return };
        match step(verifier) {
            Ok(()) => {}
            Err(Stop::Source(diagnostic)) => self.take(vec![diagnostic], Told::Writer),
            Err(Stop::Target(diagnostic)) => {
                self.failed = true;
                self.diagnostics.push(diagnostic);
            }
        }
    }

    pub(super) fn count(&mut self) {
        let procedures = &self.batch.procedures;
        self.sets_path |=
            heading::sets_path(&self.batch.stmts) || procedures.iter().any(|p| heading::sets_path(&p.body));
        let blocks = self.batch.stmts.iter().filter(|s| !s.joined).count();
        self.blocks += blocks as u64;
        let told = |s: &&Stmt| !matches!(s.op, Op::Blank | Op::Comment(_));
        self.statements += self.batch.stmts.iter().filter(told).count() as u64;
    }

    pub(super) fn take_diagnostics(&mut self) {
        let found = std::mem::take(&mut self.batch.diagnostics);
        self.take(found, Told::Reader);
    }

    /// Takes what was found. An assumption that a machine's profile settles is none.
    pub(super) fn take(&mut self, found: Vec<Diagnostic>, told: Told) {
        for mut diagnostic in found {
            match self.job.machines.answer(&diagnostic.fault, told, &self.job.from, &self.job.to) {
                Answer::Open => {}
                Answer::Settled => continue,
                Answer::Denied(denied) => diagnostic.fault = denied,
            }
            let rests = rests_on(&diagnostic.fault, told, self.job.from.dialect, self.job.to.dialect);
            if let Some((side, place)) = rests {
                self.rests.push(Rest { diagnostic: self.diagnostics.len(), side, place });
            }
            self.refused |= self.job.refuses(&diagnostic);
            self.errors += usize::from(diagnostic.fault.gravity() == Gravity::Error);
            self.diagnostics.push(diagnostic);
        }
    }

    pub(super) fn outcome(mut self, hash: [u8; 32], bytes: u64) -> Outcome {
        let verified = match &mut self.verifier {
            Some(verifier) if self.errors == 0 && !self.failed => {
                let notes = verifier.take_notes(&self.diagnostics);
                if let Some(levels) = verifier.sampled() {
                    let warning = Fault::SkipSettingsSampled { levels };
                    self.diagnostics.push(Diagnostic::new(warning, Span::default()));
                }
                let covered = verifier.covered();
                self.take(notes, Told::Writer);
                Some(covered)
            }
            _ => None,
        };
        let path = parametric::path_at_start(self.job)
            .filter(|_| !self.sets_path && verified.is_none_or(|verified| verified.events > 0));
        self.take(path.into_iter().collect(), Told::Writer);
        let own = self.name();
        let renamed = own.number.filter(|_| own.number != self.batch.name.number);
        if let Some(number) = renamed.filter(|n| self.numbers.contains(n)) {
            let name = number.to_string().into();
            self.take(vec![Diagnostic::new(Fault::ProgramTwice { name }, Span::default())], Told::Writer);
        }
        let mut text = Vec::new();
        let mut found = Vec::new();
        let head = Head { name: own, lines: self.head_lines(&hash) };
        let program_number = head.name.number.filter(|_| self.job.to.dialect.program.main_number().is_some());
        self.writer.head(&head, &mut text, &mut found);
        self.take(found, Told::Writer);
        if self.verifier.is_some() {
            let job = self.job;
            self.check(|_| Verifier::new(job).head(&text));
        }
        self.output.set_head(text);
        let release = if self.refused {
            Err(Failure::Refused)
        } else if self.failed {
            Err(Failure::VerificationFailed)
        } else if self.job.questions == Policy::Ask && !self.questions.is_empty() {
            Err(Failure::Refused)
        } else {
            Ok(())
        };
        let mut counts = [0; Verdict::ALL.len()];
        for diagnostic in &self.diagnostics {
            if let Gravity::Verdict(verdict) = diagnostic.fault.gravity() {
                counts[verdict as usize] += 1;
            }
        }
        let told: u64 = counts.iter().sum();
        counts[Verdict::Exact as usize] = self.statements.saturating_sub(told);
        Outcome {
            diagnostics: self.diagnostics,
            program_number,
            renumbered: self.renumbering.used().clone(),
            rests: self.rests,
            questions: self.questions,
            straight: None,
            verified,
            release,
            output: self.output,
            counts,
            source_sha256: hash,
            source_bytes: bytes,
            blocks: self.blocks,
        }
    }
}

mod given;
#[cfg(test)]
mod tests;
