//! Judging a given text against a source: does it make the same cut?
//!
//! For tests that change an emitted program and want to see the change caught. The text may rely on
//! what the translation itself assumes, and on nothing else.

use std::io;

use ncc_frontends::Batch;
use ncc_ir::canon::Modes;
use ncc_ir::diag::Diagnostic;
use ncc_ir::program::Program;

use crate::job::{Job, Outcome, Verified};
use crate::translate::translate_keeping;
use crate::verify_run::{Stop, Verifier};

/// A source, ready to judge texts against.
pub struct Judge<'j> {
    job: &'j Job,
    source: Program,
    inherited: Modes,
    /// The translation of the source itself.
    pub outcome: Outcome,
}

impl<'j> Judge<'j> {
    /// Translates and keeps the source.
    ///
    /// # Errors
    /// As of [`crate::translate::translate`].
    pub fn new(job: &'j Job, source: &[u8]) -> io::Result<Judge<'j>> {
        let (outcome, inherited) = translate_keeping(job, &mut io::Cursor::new(source))?;
        let mut reader = job.reader(true);
        let mut batch = Batch::default();
        reader.read(source, 0, &mut batch);
        reader.finish(&mut batch);
        let body = std::mem::take(&mut batch.stmts);
        let mut procedures = vec![batch.main(body)];
        procedures.append(&mut batch.procedures);
        let source = Program { name: batch.name, assumed: batch.assumed, procedures };
        Ok(Judge { job, source, inherited, outcome })
    }

    /// Compares a text that ncc has emitted, or one made of it, with the source: as strictly as a translation.
    ///
    /// # Errors
    /// What differs, or why the text cannot be read or executed.
    pub fn judge(&self, text: &[u8]) -> Result<Verified, Diagnostic> {
        self.judge_by(Verifier::of_translation(self.job), text)
    }

    /// Compares a text that somebody else has written with the source, as two programs are compared.
    ///
    /// # Errors
    /// As of [`Judge::judge`].
    pub fn judge_another(&self, text: &[u8]) -> Result<Verified, Diagnostic> {
        self.judge_by(Verifier::new(self.job), text)
    }

    fn judge_by(&self, mut verifier: Verifier, text: &[u8]) -> Result<Verified, Diagnostic> {
        verifier.take(&self.outcome.diagnostics, self.job);
        match verifier.verify_rest(&self.source, text, 0, &self.inherited) {
            Ok(()) => Ok(verifier.covered()),
            Err(Stop::Source(diagnostic) | Stop::Target(diagnostic)) => Err(diagnostic),
        }
    }
}
