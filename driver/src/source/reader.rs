//! The reader for a source, told what a first look through its text shows.

use std::io;

use ncc_dialects::Dialect;
use ncc_frontends::{Reader, may_jump, may_repeat_blocks};

use crate::job::Job;
use crate::source::Readable;
use crate::source::chunks::{Chunk, Chunks};

/// A reader for a source, which stands at its beginning then; with `assume` as of [`Reader::new`]. Where the control can
/// execute blocks again by their numbers, or go to them, the text is looked through for one that has it do so. Without a
/// repetition, a numbered program streams as any other; with a jump, the blocks that are jumped to are known from the first
/// line on.
///
/// # Errors
/// Reading failed, or ncc was interrupted.
pub(crate) fn reader_for(job: &Job, assume: bool, source: &mut dyn Readable) -> io::Result<Reader> {
    let dialect = job.from.dialect;
    let mut reader = job.reader(assume);
    source.rewind()?;
    if dialect.repeat.letters().is_some() {
        reader.repeats(has(source, job.piece, dialect, may_repeat_blocks)?);
    }
    if dialect.program.macro_b && has(source, job.piece, dialect, may_jump)? {
        let mut chunks = Chunks::of_bytes(source, job.piece);
        loop {
            match chunks.take()? {
                Chunk::Lines(_, range) => reader.foresee_jumps(chunks.text(range)),
                Chunk::TooLong(..) => {}
                Chunk::End => break,
            }
        }
    }
    source.rewind()?;
    Ok(reader)
}

/// Whether any lines of a source are such; it stands at its beginning then.
fn has(
    source: &mut dyn Readable,
    piece: usize,
    dialect: &Dialect,
    are: fn(&Dialect, &[u8]) -> bool,
) -> io::Result<bool> {
    let mut chunks = Chunks::of_bytes(source, piece);
    let found = loop {
        match chunks.take()? {
            Chunk::Lines(_, range) if are(dialect, chunks.text(range.clone())) => break true,
            Chunk::Lines(..) | Chunk::TooLong(..) => {}
            Chunk::End => break false,
        }
    };
    source.rewind()?;
    Ok(found)
}
