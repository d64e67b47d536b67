//! Forms that are made of a stored payload in place of a program: rows, and canonical functions.
//!
//! ```text
//! ncc time --from payload part.json --as csv    the rows of the program of which it was made
//! ```

use std::io::Read;
use std::path::Path;

use ncc_driver::problem::{Exit, Problem};
use ncc_driver::time::csv;
use ncc_driver::time::drive::Stage;
use ncc_driver::time::payload::{self, listing};

use super::args::{Form, Time};
use super::course::{Spool, destination};
use crate::files;
use crate::registry::DialectRegistry;

/// What `--from` takes for a payload.
pub(super) const PAYLOAD: &str = "payload";

/// Writes one form of a payload.
///
/// # Errors
/// Wrong usage; the file cannot be read, is no payload, or has no such form.
pub(super) fn run(args: &Time, known: &DialectRegistry) -> Result<Exit, Problem> {
    let path = path(args)?;
    let mut source = files::open(path)?;
    let shown = source.shown.clone();
    let cannot = |e: std::io::Error| Problem::file("time", &shown, &e);
    let mut text = Vec::new();
    source.file.read_to_end(&mut text).map_err(|e| Problem::file("read", &shown, &e))?;
    let document = payload::read(&text).map_err(|unread| unread.problem(&shown))?;
    let destination = destination(args, std::slice::from_ref(&source))?;
    destination.check()?;
    let mut spool = Spool::default();
    let done = match args.form {
        Form::Csv => csv::of_document(&document, &mut spool),
        _ => listing::list(&document, known.dialect("canon")?, &mut spool),
    };
    done.map_err(cannot)?.map_err(|unusable| unusable.problem(&document, &shown))?;
    destination.release(&mut spool.output)?;
    Ok(Exit::Done)
}

/// The one payload, where the options make sense for one.
fn path(args: &Time) -> Result<&Path, Problem> {
    let [path] = args.files.as_slice() else {
        return Err(Problem::usage("several payloads", "call ncc once for each of them"));
    };
    if !matches!(args.form, Form::Csv | Form::Canon) {
        return Err(Problem::usage(
            format!("a payload with --as {}", args.form.name()),
            "of a payload, ncc writes --as csv and --as canon",
        ));
    }
    if args.setting.machine.is_some() || Stage::from(args.stage) == Stage::Before {
        return Err(Problem::usage(
            "a payload has its times already",
            "leave --machine and --stage out, or time the program itself",
        ));
    }
    Ok(path)
}
