//! A whole program laid out, its blocks numbered again where that is asked for, and executed before and after.
//!
//! Not here: what is said of it, and where it is written.

use std::io::{self, SeekFrom, Write};

use ncc_backends::Numbering;
use ncc_ir::diag::Diagnostic;
use ncc_machines::schema::BlockNumbers;

use super::events::{self, Compared};
use super::number;
use super::text::{self, Refused};
use crate::job::Job;
use crate::problem::{Exit, Problem, problem};
use crate::source::spool::Spool;
use crate::source::{Readable, Source};

/// A text that was laid out.
#[derive(Debug)]
pub struct Whole {
    /// The result.
    pub file: Spool,
    /// Lines that look otherwise.
    pub changed: u32,
    /// Lines that were not taken apart: the first ones, and how many there are.
    pub unread: (Vec<u32>, u32),
    /// What its execution showed; nothing where no line changes.
    pub compared: Option<Compared>,
    /// What the execution assumes.
    pub assumed: Vec<Diagnostic>,
}

/// Block numbers, as the machine's profile has them; else they are kept.
pub fn numbering(job: &Job) -> Numbering {
    match job.machines.layout().numbers {
        None | Some((BlockNumbers::Keep, ..)) => Numbering::Keep,
        Some((BlockNumbers::Off, ..)) => Numbering::Off,
        Some((BlockNumbers::New, first, step)) => Numbering::Every { first, step },
    }
}

/// Lays a text out, as the job's layout says.
///
/// # Errors
/// It is no text, or it is not shown that the result says the same: nothing is to be written then.
pub fn lay_out(job: &Job, source: &mut Source) -> Result<Whole, Problem> {
    let shown = source.shown.clone();
    let read = |e: io::Error| Problem::file("read", &shown, &e);
    let eol: &[u8] = if job.layout.crlf { b"\r\n" } else { b"\n" };
    let mut file = Spool::default();
    let found = text::text(&job.from, eol, &mut *source.file, &mut file).map_err(read)?;
    match found.refused {
        Some(Refused::NotText(line)) => return Err(not_text(&shown, Some(line))),
        Some(Refused::NotSame(line)) => return Err(not_same(&shown, Some(line))),
        None => {}
    }
    let (changed, unread) = (found.changed, found.unread);
    let mut whole = Whole { file, changed, unread, compared: None, assumed: Vec::new() };
    if job.layout.numbering != Numbering::Keep {
        number(job, &shown, &mut *source.file, &mut whole)?;
    }
    if whole.changed == 0 {
        // Every byte is the same.
        return Ok(whole);
    }
    let compared =
        events::compare(job, &mut *source.file, &mut whole.file, &mut whole.assumed).map_err(read)?;
    match compared {
        Compared::Different => Err(not_same(&shown, None)),
        Compared::NotExecuted(_, true) => Err(not_text(&shown, None)),
        compared @ (Compared::Same(_) | Compared::NotExecuted(_, false)) => {
            whole.compared = Some(compared);
            Ok(whole)
        }
    }
}

/// Gives the blocks of a text that was laid out other numbers.
fn number(job: &Job, shown: &str, before: &mut dyn Readable, whole: &mut Whole) -> Result<(), Problem> {
    let wrong = |e: io::Error| Problem::file("read", shown, &e);
    let all = |file: &mut dyn Readable| -> io::Result<Vec<u8>> {
        let mut text = Vec::new();
        file.seek(SeekFrom::Start(0))?;
        file.read_to_end(&mut text)?;
        Ok(text)
    };
    let laid_out = all(&mut whole.file).map_err(wrong)?;
    let text = number::renumber(&job.from, &laid_out, job.layout.numbering).map_err(|refused| {
        if refused.ours {
            return not_same(shown, None);
        }
        let place = placed(shown, Some(refused.line).filter(|line| *line > 0));
        let message = problem("not-numbered").text("place", place).text("reason", refused.what);
        Problem::of(Exit::Refused, &message, None)
    })?;
    let before = all(before).map_err(wrong)?;
    let lines = |text: &[u8]| text.split_inclusive(|b| *b == b'\n').map(<[u8]>::to_vec).collect::<Vec<_>>();
    let changed = lines(&before).iter().zip(&lines(&text)).filter(|(a, b)| a != b).count();
    whole.changed = u32::try_from(changed).unwrap_or(u32::MAX);
    whole.file.clear();
    whole.file.write_all(&text).map_err(wrong)
}

fn placed(shown: &str, line: Option<u32>) -> String {
    line.map_or_else(|| shown.to_owned(), |line| format!("{shown}:{line}"))
}

fn not_text(shown: &str, line: Option<u32>) -> Problem {
    Problem::of(Exit::Refused, &problem("not-text").text("place", placed(shown, line)), None)
}

fn not_same(shown: &str, line: Option<u32>) -> Problem {
    Problem::of(Exit::VerificationFailed, &problem("not-same").text("place", placed(shown, line)), None)
}
