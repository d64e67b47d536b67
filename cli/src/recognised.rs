//! The dialect of a program of which none is named.

use codespan_reporting::term::termcolor::WriteColor;
use ncc_dialects::Dialect;
use ncc_driver::problem::Problem;
use ncc_driver::source::Source;

use crate::known::Known;

/// What to say to who names no target.
pub(crate) const INTO_WHAT: &str = "name a dialect: --to fanuc; or a machine: --machine-to MACHINE";

/// The dialect of a source, recognised; with `say`, tells by what.
///
/// # Errors
/// It cannot be told for certain, or the source cannot be read.
pub(crate) fn recognise(
    source: &mut Source,
    say: bool,
    known: &Known,
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
    known: &Known,
    err: &mut dyn WriteColor,
) -> Result<(&'static Dialect, Vec<&'static Dialect>), Problem> {
    let found = ncc_driver::guess::recognise(source, &known.all())?;
    if say {
        let reasons = found.reasons.join(", ");
        let _ = writeln!(err, "{}: read as {}: {reasons}", source.shown, found.dialect.id);
    }
    Ok((found.dialect, found.rivals))
}
