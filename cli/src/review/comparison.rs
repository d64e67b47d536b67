//! One comparison of two programs for `ncc verify`: made, reported, shown, and turned into an exit code.
//!
//! ```text
//! two sides, the call of the verb    compare    a document: "equal", 412 moves    exit code 0
//! ```
//!
//! Not here: which two programs are compared (`verify` takes the user's, `cert` those of a certificate).

use std::io::{self, Write};
use std::path::Path;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::guess::better;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::questions;
use ncc_driver::render::{About, human};
use ncc_driver::review::verify::document::{Call, Document};
use ncc_driver::review::verify::hashes;
use ncc_driver::review::verify::text;
use ncc_ir::expr::num::Nanos;

use super::args::Verify;
use crate::args::typed::Format;
use crate::files;
use crate::registry::DialectRegistry;
use crate::time::running::Running;
use ncc_driver::review::verify::document::Word;
use ncc_driver::side::Side;

/// What a comparison is called with, and the hashes of what it rests on.
///
/// # Errors
/// Reading the file of a profile.
pub(crate) fn call(
    files: [String; 2],
    machines: [Option<&str>; 2],
    tolerance: Option<Nanos>,
    sides: &[Side; 2],
    known: &DialectRegistry,
) -> io::Result<Call> {
    Ok(Call {
        files,
        machines: machines.map(|name| name.map(str::to_owned)),
        tolerance,
        dictionaries: hashes::dictionaries(sides, &|id| known.hashes(id)),
        profiles: hashes::profiles(machines, sides, &|name| std::fs::read(name))?,
    })
}

/// The problem of programs that cannot be read for a comparison.
pub(crate) fn cannot_compare(error: io::Error) -> Problem {
    Problem::file("compare", "the programs", &error)
}

/// Compares both sides, and tells what keeps them from being compared.
///
/// # Errors
/// Reading the programs.
pub(crate) fn compare(
    args: &Verify,
    sides: &mut [Side; 2],
    call: &Call,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Document, Problem> {
    let running = Running::shown(&sides[0].source.name, args.format == Format::Human && !args.telling.quiet);
    let found = ncc_driver::review::verify::pair::compare(sides, call.tolerance.unwrap_or_default())
        .map_err(cannot_compare)?;
    drop(running);
    if args.format == Format::Human {
        for (side, course) in sides.iter_mut().zip(&found.courses) {
            if !args.telling.quiet {
                questions::note(&side.job, &mut side.source, &course.diagnostics, !course.refused, err)?;
            }
            if course.refused || args.telling.verbose {
                // Messages that cannot be written change nothing about what was found.
                let _ = say(args, side, course, known, err);
            }
        }
    }
    let mut document = Document::of(&found, sides, call).map_err(cannot_compare)?;
    // They are known only now.
    document.dictionaries.extend(hashes::answers(sides));
    Ok(document)
}

/// Tells what was found in a program.
fn say(
    args: &Verify,
    side: &mut Side,
    course: &ncc_driver::review::stream::Course,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> io::Result<()> {
    let shown = side.source.shown.clone();
    let dialect = side.dialect();
    let mut about = About { job: &side.job, name: &shown, source: &mut side.source.file };
    human::print(err, &mut about, &course.diagnostics, args.telling.loudness())?;
    if course.refused {
        writeln!(err, "{shown}: not compared, because it cannot be executed as {}", dialect.id)?;
        if let Some((other, reasons)) = better(&mut side.source.file, &side.job.from, known.all())? {
            writeln!(err, "{shown} reads like {}: {}", other.id, reasons.join(", "))?;
            writeln!(err, "  help: {}:{shown}", other.id)?;
        }
    }
    err.flush()
}

/// Shows a document on stdout.
///
/// # Errors
/// stdout cannot be written.
pub(crate) fn show(args: &Verify, document: &Document) -> Result<(), Problem> {
    let to_stdout = match args.format {
        Format::Json => files::data_to_stdout,
        Format::Human => files::to_stdout,
    };
    to_stdout(&mut |out| match (args.format, args.telling.quiet) {
        (Format::Json, _) => write(out, document),
        (Format::Human, true) => Ok(()),
        (Format::Human, false) => text::write(out, document),
    })
}

/// The exit code of a verdict.
pub(crate) fn exit(document: &Document) -> Exit {
    match document.verdict {
        Word::Equal | Word::EqualWithinTolerance => Exit::Done,
        Word::Different => Exit::Refused,
        Word::NotCompared => Exit::NotCompared,
    }
}

/// Writes a document.
///
/// # Errors
/// Writing.
pub(crate) fn write(out: &mut dyn Write, document: &Document) -> io::Result<()> {
    serde_json::to_writer_pretty(&mut *out, document)?;
    writeln!(out)
}

/// Whether a path is stdin.
pub(crate) fn is_stdin(path: &str) -> bool {
    Path::new(path) == Path::new("-")
}
