//! The pipeline: read, bring within the target's capabilities, write, read back, compare.
//!
//! A program streams through in pieces of whole lines until its first call, label or loop, and is
//! kept whole from there. Nothing is released that has an error, a loss that is not allowed, or a
//! difference; the caller decides where a released output goes.
//!
//! ```text
//! `translation`   what is between source and output
//! `pipeline`      the steps, from what was read to what is released
//! `writing`       the text, and passing it on
//! `tabled`        lines of a piece as a table
//! `beside`        the verification on a second thread
//! `per_tool`      a file for each use of a tool
//! `outcome`       what comes of it at the end
//! ```
//!
//! Not here: how a difference or a refusal is reported (`render`).

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

/// After so many errors, reading more of the program would help nobody.
const ENOUGH_ERRORS: usize = 200;

/// Translates a program.
///
/// # Errors
/// Reading the source or writing the temporary file of the output failed. What is wrong with the
/// program itself is in the outcome.
pub fn translate(job: &Job, source: &mut dyn Readable) -> io::Result<Outcome> {
    Ok(translate_keeping(job, source)?.0)
}

/// Translates a program, and keeps what is asked of where the output comes from; the record only where a
/// map is asked for and the output was verified.
///
/// # Errors
/// As of [`translate`]; an output of which the map is asked and that is longer than 4 GiB.
pub fn translate_recording(
    job: &Job,
    asked: Asked,
    source: &mut dyn Readable,
) -> io::Result<(Outcome, Option<Recorded>)> {
    let (outcome, _, record) = run(job, asked, source)?;
    Ok((outcome, record))
}

/// Translates a program; tells also which assumed facts the output does not state itself.
pub fn translate_keeping(job: &Job, source: &mut dyn Readable) -> io::Result<(Outcome, Modes)> {
    let (outcome, inherited, _) = run(job, Asked::default(), source)?;
    Ok((outcome, inherited))
}

/// An outcome, with the assumed facts that the output does not state itself, and the record that was asked for.
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

/// Which faster ways may be taken.
#[derive(Clone, Copy)]
struct Ways {
    /// A long program is verified on a second thread.
    threads: bool,
    /// Lines are read as tables.
    tables: bool,
}

/// Translates a program; `None` if a faster way met something that it cannot report, so that it is to be done
/// without any.
fn attempt(job: &Job, asked: Asked, source: &mut dyn Readable, ways: Ways) -> io::Result<Option<Run>> {
    // A subprogram without its main program states no modes at its beginning, so that its end is to be known there.
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
        // The source is what calls the others.
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
