//! What stands above an output: its name, and the lines for the operator, with what was not answered.

use ncc_ir::diag::{Diagnostic, Fault};
use ncc_ir::program::ProgramName;
use ncc_machines::reading::Told;

use super::translation::Translation;
use crate::questions::Question;
use crate::render::head;

impl Translation<'_> {
    /// Takes the questions. Those about the control are assumptions that no reader knows of.
    pub(crate) fn answer(&mut self, questions: Vec<Question>) {
        for question in &questions {
            if let Some((taken, other)) = question.controls() {
                let fault = Fault::AssumedControl { taken: taken.into(), other: other.into() };
                self.take(vec![Diagnostic::new(fault, question.span)], Told::Reader);
            }
        }
        self.questions = questions;
    }

    /// The output's program name: the source's own; where the target needs one and the source has
    /// none, one made from the file's name.
    pub(crate) fn name(&mut self) -> ProgramName {
        let mut name = self.renumbering.name(&self.batch.name);
        if self.job.to.dialect.program.main_number().is_some() {
            // The lowest number that no subprogram has.
            let free = (1..).find(|n| !self.numbers.contains(n));
            name.number = self.job.program_number.or(name.number).or(free);
            if name.title.is_none() {
                let stem = self.job.source_name.rsplit_once('.').map_or(&*self.job.source_name, |n| n.0);
                name.title = (stem != "-" && !stem.is_empty()).then(|| stem.to_uppercase().into());
            }
        }
        name
    }

    pub(crate) fn head_lines(&self, hash: &[u8; 32]) -> Vec<String> {
        self.head_lines_of(hash, None)
    }

    /// The same of a file per tool, in which no other tool is put in than `only`.
    pub(crate) fn head_lines_of(&self, hash: &[u8; 32], only: Option<Option<i64>>) -> Vec<String> {
        let counts = |found: &&Diagnostic| match found.fault {
            Fault::LengthByHand { tool } => only.is_none_or(|only| only == Some(i64::from(tool))),
            _ => true,
        };
        let told: Vec<Diagnostic> = self.diagnostics.iter().filter(counts).cloned().collect();
        let mut lines = match self.job.head {
            true => head::lines(self.job, hash, &self.questions, &told, self.renumbering.used()),
            false => Vec::new(),
        };
        lines.extend(self.job.machines.layout().header);
        lines
    }
}
