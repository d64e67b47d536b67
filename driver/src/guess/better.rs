//! Another dialect for a text that was refused: one that it reads like, and in which it has fewer errors.
//!
//! A Haas program with one wrong block looks like a Fanuc program too. Read as one it has as many errors or more,
//! and no one is helped by its name.

use std::io::{self, Read, Seek, SeekFrom};

use ncc_dialects::{Dialect, Settings};
use ncc_frontends::{Batch, Reader};
use ncc_ir::diag::Gravity;
use ncc_ir::source::Span;

use super::{Guess, guess};
use crate::source::chunks::{Chunk, Chunks};

/// The dialect that a refused text is likely written in, and the reasons.
///
/// # Errors
/// Reading the text.
pub fn better(
    source: &mut (impl Read + Seek),
    refused_as: &Settings,
    dialects: impl IntoIterator<Item = &'static Dialect>,
) -> io::Result<Option<(&'static Dialect, Vec<String>)>> {
    let Guess::Sure(other, reasons, _) = guess(source, dialects)? else { return Ok(None) };
    if other.id == refused_as.dialect.id {
        return Ok(None);
    }
    let fewer = errors(source, Settings::new(other))? < errors(source, refused_as.clone())?;
    Ok(fewer.then_some((other, reasons)))
}

/// How many errors a text has in a dialect.
fn errors(source: &mut (impl Read + Seek), settings: Settings) -> io::Result<usize> {
    source.seek(SeekFrom::Start(0))?;
    let mut reader = Reader::new(settings, true);
    let mut batch = Batch::default();
    let mut chunks = Chunks::new(source);
    let mut count = 0;
    loop {
        let over = match chunks.take()? {
            Chunk::Lines(base, range) => {
                reader.read(chunks.text(range), base, &mut batch);
                false
            }
            Chunk::TooLong(start, end) => {
                reader.too_long(Span::new(start, end), &mut batch);
                false
            }
            Chunk::End => {
                reader.finish(&mut batch);
                true
            }
        };
        count += batch.diagnostics.drain(..).filter(|d| d.fault.gravity() == Gravity::Error).count();
        batch.stmts.clear();
        batch.procedures.clear();
        if over {
            return Ok(count);
        }
    }
}
