//! The dialect of a program of which none is named.

use std::io::{self, Write};

use codespan_reporting::term::termcolor::WriteColor;
use ncc_dialects::Dialect;
use ncc_driver::guess::better;
use ncc_driver::job::Job;
use ncc_driver::problem::Problem;
use ncc_driver::source::Source;

use crate::registry::DialectRegistry;

/// What to say to who names no target.
pub(crate) const INTO_WHAT: &str = "name a dialect: --to fanuc; or a machine: --machine-to MACHINE";

/// The dialect of a source, recognised; with `say`, tells by what.
///
/// # Errors
/// The dialect is not certain, or the source cannot be read.
pub(crate) fn recognise(
    source: &mut Source,
    say: bool,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<&'static Dialect, Problem> {
    recognise_all(source, say, known, err).map(|(dialect, _)| dialect)
}

/// The same, and the dialects that explain the source as well.
///
/// # Errors
/// As of [`recognise`].
pub(crate) fn recognise_all(
    source: &mut Source,
    say: bool,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<(&'static Dialect, Vec<&'static Dialect>), Problem> {
    let found = ncc_driver::guess::recognise(source, &known.all())?;
    if say {
        let reasons = found.reasons.join(", ");
        let _ = writeln!(err, "{}: read as {}: {reasons}", source.shown, found.dialect.id);
    }
    Ok((found.dialect, found.rivals))
}

/// If a refused text is clearly written in another dialect, in which it has fewer errors, says so.
///
/// # Errors
/// Reading the source, or writing.
pub(crate) fn doubt_dialect(
    source: &mut Source,
    job: &Job,
    known: &DialectRegistry,
    err: &mut dyn Write,
) -> io::Result<()> {
    let Some((other, reasons)) = better(&mut source.file, &job.from, known.all())? else { return Ok(()) };
    let (from, to) = (&other.id, &job.to.dialect.id);
    writeln!(err, "{} reads like {from}: {}", source.shown, reasons.join(", "))?;
    if from != to {
        writeln!(err, "  help: ncc {from} to {to} {}", source.shown)?;
    }
    Ok(())
}
