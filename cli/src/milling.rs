//! Programs are for mills: opening one, and telling of one that is not.
//!
//! `--assume milling` goes on; verbs that make no program print a line. Not here: what a program looks like
//! (`not_milling`).

use std::io;
use std::path::Path;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::source::Source;
use ncc_driver::source::not_milling::{self, Refusal, note};

use crate::files;
use crate::registry::DialectRegistry;

/// The form in which a refusal is reported.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Voice {
    /// For people.
    Human,
    /// As a line of JSON.
    Json,
    /// For people, and nothing but refusals.
    Quiet,
}

/// Opens a program, and reports on `err` that it refuses a program that is not for a mill.
///
/// # Errors
/// It cannot be read. Or it is not for a mill: such a problem has been reported, and has no words of its own.
pub(crate) fn open(
    path: &Path,
    voice: Voice,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Source, Problem> {
    let mut source = files::open(path)?;
    let Some(refusal) = admit(&mut source, voice, known, err)? else { return Ok(source) };
    if voice == Voice::Json {
        refusal.line(err)?;
    }
    Err(Problem { exit: Exit::Refused, message: String::new(), help: Vec::new() })
}

/// The same with a program that is open. A refusal comes back; for people it has been printed.
pub(crate) fn admit(
    source: &mut Source,
    voice: Voice,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Option<Refusal>, Problem> {
    let Some(refusal) = not_milling::refusal(source, known.all_for_mills())? else {
        if let Some(note) = note(source).filter(|_| voice == Voice::Human) {
            // A note that cannot be written changes nothing about what is done.
            let _ = writeln!(err, "{note}");
        }
        return Ok(None);
    };
    if voice != Voice::Json {
        refusal.print(err).map_err(|e| unwritten(&e))?;
    }
    Ok(Some(refusal))
}

fn unwritten(error: &io::Error) -> Problem {
    Problem::file("write", "messages", error)
}
