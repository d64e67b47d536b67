//! What comes of a translation at its end: the head of the output, the counts, and whether it is released.

use std::io;

use ncc_backends::Head;
use ncc_ir::diag::{Diagnostic, Fault, Gravity, Verdict};
use ncc_ir::source::Span;
use ncc_machines::reading::Told;

use super::parametric;
use super::translation::Translation;
use crate::job::{Failure, Outcome};
use crate::questions::Policy;
use crate::verify_run::Verifier;

impl Translation<'_> {
    /// What came of it.
    ///
    /// # Errors
    /// The anonymous files of a file per tool cannot be written.
    pub(super) fn outcome(mut self, hash: [u8; 32], bytes: u64) -> io::Result<Outcome> {
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
        let files = self.files_per_tool(&head, &hash)?;
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
        let kept = self.diagnostics.iter().map(|diagnostic| (&diagnostic.fault, 1));
        for (fault, many) in kept.chain(self.counted.iter().map(|counted| (&counted.fault, counted.more))) {
            if let Gravity::Verdict(verdict) = fault.gravity() {
                counts[verdict as usize] += many;
            }
        }
        let told: u64 = counts.iter().sum();
        counts[Verdict::Exact as usize] = self.statements.saturating_sub(told);
        Ok(Outcome {
            files,
            diagnostics: self.diagnostics,
            counted: self.counted,
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
        })
    }
}
