//! One translation on its way: what is between source and output, piece by piece.

use super::beside::Beside;
use super::parametric::{self, target};
use super::per_tool::origins::PerTool;
use crate::job::parameters::{bore_shift, orientation, parameter};

use std::collections::BTreeSet;

use ncc_backends::{Head, Writer};
use ncc_dialects::{BREAK_LIFT, PECK_CLEARANCE};
use ncc_frontends::{Batch, Reader};
use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Gravity};
use ncc_ir::program::{Op, ProgramName};
use ncc_ir::track::Tracker;
use ncc_machines::reading::{Told, rests_on};
use ncc_passes::Legaliser;
use ncc_passes::modes::side_effects::SideEffects;
use ncc_passes::tools::machine_numbers::Renumbering;

use crate::job::{Counted, Job, Output, Rest, file_per_tool};
use crate::machines::pair::Answer;
use crate::provenance::annotate::Annotator;
use crate::provenance::trace::{Asked, Trace};
use crate::questions::Question;
use crate::stretches::{Packer, Words};
use crate::translate::rewrite::Folder;
use crate::verify_run::{Stop, Verifier};

/// From so many pieces on a second thread verifies: it costs more than a short program takes.
const PIECES_HERE: usize = 4;

/// Highest number of a program.
const MOST_NUMBER: u32 = 99_999_999;

/// What is between source and output.
pub(super) struct Translation<'j> {
    pub(super) job: &'j Job,
    pub(super) reader: Reader,
    pub(super) batch: Batch,
    /// Packs what is read of a program that is kept whole.
    pub(super) packer: Packer,
    pub(super) folder: Option<Folder>,
    /// Puts the target machine's numbers in.
    pub(super) renumbering: Renumbering,
    /// Writes what codes of the source's control do besides their names.
    pub(super) side_effects: SideEffects,
    pub(super) legaliser: Legaliser,
    pub(super) writer: Writer,
    pub(super) text: Vec<u8>,
    /// Absent where nothing is verified, and while a second thread has it.
    pub(super) verifier: Option<Verifier>,
    /// The verification on a second thread.
    pub(super) beside: Option<Beside>,
    /// Whether it may go there.
    pub(super) goes_beside: bool,
    /// Pieces since it began, or came back.
    pub(super) pieces_here: usize,
    /// Whether lines are read as tables.
    pub(super) tables: bool,
    /// Whether this attempt is thrown away: the verification has stopped there, or a pass has changed what stands for a
    /// table.
    pub(super) discarded: bool,
    /// Puts the source beside the text.
    pub(super) annotator: Option<Annotator>,
    /// Where the text comes from.
    pub(super) trace: Option<Trace>,
    /// What a file per tool needs, where that is asked for.
    pub(super) per_tool: Option<PerTool>,
    /// Facts that always hold for the source's control and were stated for the target's.
    pub(super) given: Modes,
    pub(super) output: Output,
    pub(super) written: u64,
    pub(super) diagnostics: Vec<Diagnostic>,
    pub(super) counted: Vec<Counted>,
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
        legaliser.set_source_refuses(job.from.dialect.caps.compensation.refused);
        legaliser.set_source_looks_over(job.looks_over_blocks());
        if job.between_controls() {
            legaliser.between_controls(!job.from.dialect.can.rounds_freely);
        }
        legaliser.set_source_behaviours(job.source_behaviours(), job.from.dialect.can.change_by_hand);
        let maps = job.maps();
        legaliser.set_edge_entries(maps.edge_entries.clone(), maps.further_edges.clone());
        legaliser.set_program_numbers(maps.program_numbers.clone());
        let start = Tracker { position: job.start, ..Tracker::default() };
        let folder = job.folds().then(|| Folder::new(target(job), start, job.from.dialect.caps.flat));
        let mut writer = Writer::new(job.to.clone(), job.layout.clone());
        job.stand(&mut legaliser, &mut writer);
        writer.set_form(job.machines.form());
        if job.between_controls() {
            writer.changes_apart();
        }
        if file_per_tool(&job.to) {
            writer.trace();
        }
        let mut translation = Translation {
            job,
            reader: job.reader(true),
            batch: Batch::default(),
            packer: Packer::new(job.shortest_stretch, Words::All),
            folder,
            renumbering: Renumbering::new(maps),
            side_effects: job.side_effects(),
            legaliser,
            writer,
            text: Vec::new(),
            verifier: job.verify.then(|| Verifier::of_translation(job)),
            beside: None,
            goes_beside: false,
            pieces_here: 0,
            tables: false,
            discarded: false,
            annotator: None,
            trace: None,
            per_tool: file_per_tool(&job.to).then(PerTool::default),
            given: Modes::default(),
            output: Output::new(),
            written: 0,
            diagnostics: Vec::new(),
            counted: Vec::new(),
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

    /// Lets the verification know what the passes assumed, and what they folded.
    pub(super) fn take_parameters(&mut self, found: &[Diagnostic]) {
        if !Verifier::takes(found) {
            return;
        }
        self.verify_here();
        if let Some(verifier) = &mut self.verifier {
            verifier.take(found, self.job);
        }
    }

    /// Assumed facts that the output does not state itself, in the target machine's numbers, and what
    /// was assumed of the target.
    pub(super) fn inherited(&self, assumed: &Modes) -> Modes {
        let target_modes = self.renumbering.modes(assumed);
        let facts = target_modes.without(&self.writer.stated()).without(&self.given);
        let taken = self.legaliser.taken();
        Modes {
            work_offset: taken.work_offset.or(facts.work_offset),
            no_origin_shift: taken.no_origin_shift.or(facts.no_origin_shift),
            ..facts
        }
    }

    /// A step of the verification, as long as there is something to verify.
    pub(super) fn check(&mut self, step: impl FnOnce(&mut Verifier) -> Result<(), Stop>) {
        self.verify_here();
        if self.errors > 0 || self.failed || self.discarded {
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

    /// Lets the verification of a long program go on on a second thread.
    pub(super) fn verify_beside(&mut self) {
        self.pieces_here += 1;
        if !self.goes_beside || self.pieces_here < PIECES_HERE || self.per_tool.is_some() {
            return;
        }
        if let Some(verifier) = self.verifier.take() {
            match Beside::start(verifier) {
                Ok(beside) => self.beside = Some(beside),
                Err(verifier) => (self.verifier, self.goes_beside) = (Some(*verifier), false),
            }
        }
    }

    /// Takes the verification back from the second thread, when it has done its steps.
    pub(super) fn verify_here(&mut self) {
        let Some(beside) = self.beside.take() else { return };
        let (verifier, result) = beside.end();
        self.verifier = Some(verifier);
        self.pieces_here = 0;
        self.discarded |= result.is_err();
    }

    /// Whether the verification has come as far as the text, and the attempt is one to keep.
    pub(super) fn is_verified_here(&mut self) -> bool {
        self.verify_here();
        !self.discarded
    }

    pub(super) fn count(&mut self) {
        let procedures = &self.batch.procedures;
        self.sets_path |= parametric::sets_path(&self.batch.stmts)
            || procedures.iter().any(|p| parametric::sets_path(&p.body));
        for stmt in &self.batch.stmts {
            let (statements, blocks) = match &stmt.op {
                Op::Lines(lines) => lines.counts(),
                Op::Blank | Op::Comment(_) => (0, usize::from(!stmt.joined)),
                _ => (1, usize::from(!stmt.joined)),
            };
            self.statements += statements as u64;
            self.blocks += blocks as u64;
        }
        let (statements, blocks) = self.batch.table.counts();
        self.statements += statements as u64;
        self.blocks += blocks as u64;
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
            if Counted::keeps(&mut self.counted, &diagnostic.fault) {
                self.diagnostics.push(diagnostic);
            }
        }
    }
}

#[cfg(test)]
mod tests;
