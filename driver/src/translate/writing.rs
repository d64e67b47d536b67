//! The text of a translation: writing it, with the shop's own lines and the facts that the source's control always has,
//! and passing it on once it is verified.

use std::io;

use ncc_backends::Origin;
use ncc_ir::canon::Modes;
use ncc_ir::diag::{Diagnostic, Gravity};
use ncc_ir::program::line_table::LineTable;
use ncc_ir::program::{Op, Program, Stmt};
use ncc_ir::source::Span;
use ncc_machines::reading::Told;
use ncc_passes::values::variables::renamed::Renamed;

use super::beside::{Saying, Spare, Step};
use super::translation::Translation;
use crate::verify_run::Verifier;
use crate::verify_run::controls::fixed;

/// What a text is to say.
pub(super) enum Said<'s> {
    /// These lines of the source, one by one.
    Lines(&'s mut Vec<Stmt>),
    /// These arcs and lines of the source, one by one; and whether the verification has executed them.
    Arcs(&'s mut Vec<Stmt>, bool),
    /// These lines of the source, one by one.
    Table(&'s mut LineTable),
    /// Something else than the source, which is executed.
    Otherwise,
}

impl Translation<'_> {
    /// Makes statements of facts that always hold for the source's control, and not for the
    /// target's, as soon as the program relies on them. (A target with a safe start states them there.)
    pub(super) fn state_given(&mut self, stmts: &mut Vec<Stmt>) {
        let at =
            stmts.iter().position(|s| !matches!(s.op, Op::Comment(_) | Op::Blank)).unwrap_or(stmts.len());
        let Some(span) = stmts.get(at).map(|s| s.span) else { return };
        let given = self.still_to_give();
        self.given = self.given.or(given);
        let distance = given.distance.map(Op::SetDistanceMode);
        let units = given.units.map(Op::UseLengthUnits);
        let plane = given.plane.map(Op::SelectPlane);
        let new = [distance, units, plane].into_iter().flatten().map(|op| Stmt::new(span, op));
        stmts.splice(at..at, new);
    }

    /// The facts among them that the program relies on and that have not been stated yet.
    pub(super) fn still_to_give(&self) -> Modes {
        if !self.job.to.dialect.safe_start.is_empty() || self.job.to.dialect.can.everything {
            return Modes::default();
        }
        let always = fixed(self.job.from.dialect).without(&fixed(self.job.to.dialect));
        let (relied, given) = (self.batch.assumed, self.given);
        Modes {
            distance: always.distance.filter(|_| relied.distance.is_some() && given.distance.is_none()),
            units: always.units.filter(|_| relied.units.is_some() && given.units.is_none()),
            plane: always.plane.filter(|_| relied.plane.is_some() && given.plane.is_none()),
            ..Modes::default()
        }
    }

    /// The modes that were assumed of the source, in the numbers of the target machine. A number that it lacks is refused
    /// at the first statement.
    pub(super) fn modes_in_target(
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

    /// What was held back to the end of a program that streams.
    pub(super) fn end_stream(&mut self) -> io::Result<()> {
        let mut stmts = Vec::new();
        let assumed = self.batch.assumed;
        let target_modes = self.renumbering.modes(&assumed);
        let mut found = Vec::new();
        self.legaliser.finish(&mut stmts, &mut found);
        self.write_main(&stmts, &target_modes, &mut found);
        self.foot(&target_modes, &mut found);
        self.writer.finish(&mut self.text, &mut found);
        self.take(found, Told::Writer);
        self.release_text(&assumed, Said::Otherwise)?;
        self.check(Verifier::finish);
        self.trace_events()
    }

    /// Verifies the text written so far and passes it on.
    pub(super) fn release_text(&mut self, assumed: &Modes, said: Said) -> io::Result<()> {
        let text = self.finished_text()?;
        let inherited = self.inherited(assumed);
        // Places in the output are reported by a map alone, which refuses a base that does not fit.
        let base = u32::try_from(self.written).unwrap_or(u32::MAX);
        self.output.push(&text)?;
        self.written += text.len() as u64;
        if let Some(beside) = self.beside.as_mut().filter(|_| self.errors == 0) {
            let Spare { stmts, table, text: next } = beside.spare();
            let said = match said {
                Said::Lines(said) => Saying::Lines(std::mem::replace(said, stmts.unwrap_or_default())),
                Said::Arcs(said, _) => Saying::Arcs(std::mem::replace(said, stmts.unwrap_or_default())),
                Said::Table(said) => Saying::Table(std::mem::replace(said, table.unwrap_or_default())),
                Said::Otherwise => Saying::Otherwise,
            };
            self.text = next.unwrap_or_default();
            let step = Step::Text { said, assumed: *assumed, text, base, inherited };
            if !beside.go_on(step) {
                self.verify_here();
            }
            return Ok(());
        }
        if self.beside.is_some() && matches!(said, Said::Arcs(_, false)) {
            // On one thread the source would have been executed before the writer refused anything.
            self.verify_here();
            self.discarded = true;
        }
        self.check(|v| match said {
            Said::Lines(stmts) => v.piece(stmts, assumed, &text, base, &inherited),
            Said::Arcs(stmts, executed) => {
                if !executed {
                    v.source_said(stmts, assumed)?;
                }
                v.target_saying(stmts, &text, base, &inherited)
            }
            Said::Table(table) => v.table(table, assumed, &text, base, &inherited),
            Said::Otherwise => v.target(&text, base, &inherited),
        });
        self.text = text;
        self.text.clear();
        self.trace_events()
    }

    /// Executes what the passes have changed, as it was read.
    pub(super) fn execute_source(&mut self, stmts: &mut Vec<Stmt>) {
        let assumed = self.batch.assumed;
        match self.beside.as_mut().filter(|_| self.errors == 0) {
            Some(beside) => {
                let step = Step::Source { stmts: std::mem::take(stmts), assumed };
                if !beside.go_on(step) {
                    self.verify_here();
                }
            }
            None => self.check(|v| v.source(stmts, &assumed)),
        }
    }

    /// Executes arcs and lines that the passes have left as they are; `false` where the second thread does that with their
    /// text.
    pub(super) fn execute_arcs(&mut self, stmts: &[Stmt]) -> bool {
        let here = self.beside.is_none();
        if here {
            let assumed = self.batch.assumed;
            self.check(|v| v.source_said(stmts, &assumed));
        }
        here
    }

    /// Verifies the text of a program that was kept whole, and passes it on.
    pub(super) fn release_kept(&mut self, source: &Program, renamed: &Renamed) -> io::Result<()> {
        let text = self.finished_text()?;
        let inherited = self.inherited(&self.batch.assumed);
        let base = u32::try_from(self.written).unwrap_or(u32::MAX);
        let mut trace = self.trace.take();
        self.check(|v| {
            v.verify_rest_reporting((source, renamed), &text, base, &inherited, &mut |pairs| {
                if let Some(trace) = &mut trace {
                    trace.pairs(pairs);
                }
            })
        });
        self.trace = trace;
        self.output.push(&text)
    }

    /// The text written so far, with what was asked beside it; notes where it comes from.
    pub(super) fn finished_text(&mut self) -> io::Result<Vec<u8>> {
        let mut text = std::mem::take(&mut self.text);
        if self.annotator.is_none() && self.trace.is_none() && self.per_tool.is_none() {
            return Ok(text);
        }
        let origins: Vec<Origin> = self.writer.take_origins();
        if let Some(per_tool) = &mut self.per_tool {
            per_tool.take(&origins);
        }
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
        trace.close_rows_before(over.map_or(trace.bytes(), u64::from))
    }
}
