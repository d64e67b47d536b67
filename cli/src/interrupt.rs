//! Ctrl-C, and what else asks a process to end: the run says where the program was, nothing is written, and the exit
//! code is 130.
//!
//! A run of a program stops by itself ([`ncc_exec::halt`]), and so does the reading of a source (`chunks`). What takes
//! long besides is ended after `GRACE`, but never while a file is being put in its place.

use std::fmt;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::sync::{RwLock, RwLockReadGuard};
use std::time::Duration;

use ncc_exec::halt;
use ncc_ir::diag::{Diagnostic, Fault};

use crate::files::Source;
use crate::problem::{Exit, Problem};

/// How long work that does not look at the request may go on.
const GRACE: Duration = Duration::from_millis(1500);

/// Held by what puts files in their places, and by the end of the process.
static PLACING: RwLock<()> = RwLock::new(());

/// Has the signals of this process answered from now on. Where that cannot be, they end it as they always do.
pub fn listen() {
    let _ = ctrlc::set_handler(|| {
        halt::ask();
        std::thread::sleep(GRACE);
        // One that died while it held the lock is over as well.
        let _placing = PLACING.write();
        let _ = writeln!(io::stderr(), "error: interrupted; no file is half written");
        std::process::exit(i32::from(Exit::Interrupted as u8));
    });
}

/// The work on a source was interrupted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Interrupted {
    /// The line that was next, from 1; `None` where no source is read.
    pub line: Option<u64>,
}

impl fmt::Display for Interrupted {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(out, "interrupted at line {line}"),
            None => write!(out, "interrupted"),
        }
    }
}

impl std::error::Error for Interrupted {}

/// The problem that names the line of its source at which a run was interrupted.
///
/// # Errors
/// Reading the source.
pub(crate) fn problem(found: &[Diagnostic], source: &mut Source) -> io::Result<Option<Problem>> {
    let Some(fault) = found.iter().find(|d| matches!(d.fault, Fault::Interrupted { .. })) else {
        return Ok(None);
    };
    source.file.seek(SeekFrom::Start(0))?;
    let mut before = Vec::new();
    (&mut source.file).take(u64::from(fault.span.start)).read_to_end(&mut before)?;
    let line = memchr::memchr_iter(b'\n', &before).count() as u64 + 1;
    let error = io::Error::other(Interrupted { line: Some(line) });
    Ok(Some(Problem::file("read", &source.shown, &error)))
}

/// Fails if the process is to stop.
///
/// # Errors
/// [`Interrupted`], in a line of a source.
pub(crate) fn heed(line: Option<u64>) -> io::Result<()> {
    if halt::is_asked() { Err(io::Error::other(Interrupted { line })) } else { Ok(()) }
}

/// Lets a file be put in its place: the process does not end before the guard is gone.
///
/// # Errors
/// The process is to stop: nothing may be written any more.
pub(crate) fn placing() -> io::Result<RwLockReadGuard<'static, ()>> {
    let guard = PLACING.read().unwrap_or_else(|broken| broken.into_inner());
    heed(None)?;
    Ok(guard)
}
