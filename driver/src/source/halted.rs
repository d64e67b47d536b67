//! Stops work on request: the reader of a source checks for the request between two pieces.
//!
//! The host decides who makes the request, and how long the work may take. Runs of a program check for it too
//! ([`ncc_exec::halt`]).

use std::io::{self, Read, Seek, SeekFrom};

use ncc_exec::halt;
use ncc_ir::diag::{Diagnostic, Fault};

use crate::problem::Problem;
use crate::source::Source;
use crate::source::interrupted::Interrupted;

/// The diagnostic for the block at which a run was interrupted.
///
/// # Errors
/// Reading the source.
pub fn problem(found: &[Diagnostic], source: &mut Source) -> io::Result<Option<Problem>> {
    let Some(fault) = found.iter().find(|d| matches!(d.fault, Fault::Interrupted { .. })) else {
        return Ok(None);
    };
    source.file.seek(SeekFrom::Start(0))?;
    let mut before = Vec::new();
    source.file.as_mut().take(u64::from(fault.span.start)).read_to_end(&mut before)?;
    let line = memchr::memchr_iter(b'\n', &before).count() as u64 + 1;
    let error = io::Error::other(Interrupted { line: Some(line) });
    Ok(Some(Problem::file("read", &source.shown, &error)))
}

/// Fails if the host asked the work to stop.
///
/// # Errors
/// [`Interrupted`], in a line of a source.
pub fn heed(line: Option<u64>) -> io::Result<()> {
    if halt::is_asked() { Err(io::Error::other(Interrupted { line })) } else { Ok(()) }
}
