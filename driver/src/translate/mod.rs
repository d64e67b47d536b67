//! The pipeline: read, legalise for the target, write, read back, compare.
//!
//! A program streams in pieces of whole lines until its first call, label or loop. From there ncc keeps it whole.
//! ncc releases no output with an error, a loss that is not allowed, or a difference. The caller decides
//! where a released output goes.
//!
//! ```text
//! `translation`   state of one translation
//! `pipeline`      steps from the parsed piece to the released text
//! `writing`       writes the text and passes it on after verification
//! `tabled`        fast path: lines of a piece as a table
//! `beside`        verification on a second thread
//! `per_tool`      one file for each use of a tool, cut at the tool changes
//! `outcome`       head of the output, counts, and the release
//! ```
//!
//! Not here: the report of a difference or a refusal (`render`).

mod beside;
pub mod heading;
pub mod judge;
mod outcome;
pub mod parametric;
mod per_tool;
mod pipeline;
pub mod rewrite;
mod snapshot;
pub mod split;
pub mod standalone_subprogram;
mod straight;
mod tabled;
pub mod tools_by_name;
mod translation;
mod writing;

use std::io;

use ncc_ir::canon::Modes;
use ncc_ir::source::Span;

use self::translation::Translation;
use crate::job::{Job, Outcome};
use crate::provenance::trace::{Asked, Recorded, Trace};
use crate::questions::{self, Policy};
use crate::source::Readable;
use crate::source::chunks::{Chunk, Chunks, ends_by_return};
use crate::source::reader::reader_for;

/// ncc stops reading after this number of errors.
const ENOUGH_ERRORS: usize = 200;

/// Translates a program.
///
/// # Errors
/// Reading the source or writing the temporary file of the output failed. Errors in the program itself are in
/// the outcome.
pub fn translate(job: &Job, source: &mut dyn Readable) -> io::Result<Outcome> {
    Ok(translate_keeping(job, source)?.0)
}

/// Translates a program and records where the output comes from, as `asked`. The record is `Some` only if the caller
/// asked for a map and ncc released the output.
///
/// # Errors
/// The errors of [`translate`], and a mapped output longer than 4 GiB.
pub fn translate_recording(
    job: &Job,
    asked: Asked,
    source: &mut dyn Readable,
) -> io::Result<(Outcome, Option<Recorded>)> {
    let (outcome, _, record) = run(job, asked, source)?;
    Ok((outcome, record))
}

/// Translates a program. Also returns the assumed modes that the output does not state itself.
pub fn translate_keeping(job: &Job, source: &mut dyn Readable) -> io::Result<(Outcome, Modes)> {
    let (outcome, inherited, _) = run(job, Asked::default(), source)?;
    Ok((outcome, inherited))
}

/// Outcome, assumed modes that the output does not state itself, and the record if asked for.
type Run = (Outcome, Modes, Option<Recorded>);

fn run(job: &Job, asked: Asked, source: &mut dyn Readable) -> io::Result<Run> {
    match attempt(job, asked, source, Ways { threads: !job.one_thread, tables: job.tables })? {
        Some(run) => Ok(run),
        None => {
            source.rewind()?;
            let run = attempt(job, asked, source, Ways { threads: false, tables: false })?;
            Ok(run.expect("the usual way throws nothing away"))
        }
    }
}

/// Fast paths that an attempt may use.
#[derive(Clone, Copy)]
struct Ways {
    /// Verify a long program on a second thread.
    threads: bool,
    /// Read lines as tables (`tabled`).
    tables: bool,
}

/// Translates a program. `None` if a fast path met a problem that it cannot report: the caller then repeats the
/// translation without fast paths.
fn attempt(job: &Job, asked: Asked, source: &mut dyn Readable, ways: Ways) -> io::Result<Option<Run>> {
    // A standalone subprogram states no modes at its start. So ncc must know before reading that it ends by return.
    let returns = job.from.dialect.program.macro_b && ends_by_return(source)?;
    let reader = reader_for(job, true, source)?;
    let mut chunks = Chunks::hashed(source, job.piece);
    let mut translation = Translation::new(job);
    translation.reader = reader;
    translation.batch.whole |= returns;
    translation.goes_beside = ways.threads && !asked.anything();
    translation.tables = ways.tables && !asked.anything();
    translation.record(asked);
    loop {
        match chunks.take()? {
            Chunk::Lines(base, range) => {
                if let Some(annotator) = &mut translation.annotator {
                    annotator.source(chunks.text(range.clone()), base)?;
                }
                translation.piece(chunks.text(range), base)?;
            }
            Chunk::TooLong(start, end) => {
                translation.reader.too_long(Span::new(start, end), &mut translation.batch)
            }
            Chunk::End => break,
        }
        if translation.errors >= ENOUGH_ERRORS || translation.discarded {
            break;
        }
    }
    translation.end()?;
    if !translation.is_verified_here() {
        return Ok(None);
    }
    let (hash, bytes) = match (chunks.finish(), &job.called) {
        // With called files, hash and size are those of the calling file.
        (_, Some(called)) => (called.sha256, called.bytes),
        (own, None) => own,
    };
    let questions = match job.questions {
        Policy::Skip => Vec::new(),
        Policy::Ask | Policy::Assume => {
            questions::find(job, source, &translation.diagnostics, translation.errors == 0)?
        }
    };
    translation.answer(questions);
    translation.cut_by_tool(source)?;
    let straight = match straight::is_open(&translation) {
        true => straight::options(job, source)?,
        false => None,
    };
    let inherited = translation.inherited(&translation.batch.assumed);
    let record = translation.trace.take();
    let outcome = Outcome { straight, ..translation.outcome(hash, bytes)? };
    let record = record.filter(|_| outcome.release.is_ok()).map(Trace::finish).transpose()?;
    Ok(Some((outcome, inherited, record)))
}
