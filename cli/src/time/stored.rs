//! Rows that are made of a stored payload in place of a program.
//!
//! A payload has no work offsets, cutter compensation or path modes. A list of canonical functions made of it would be
//! another program, so ncc refuses that form.
//!
//! ```text
//! ncc time --from payload part.json --as csv    the rows of the program of which it was made
//! ```

use std::io::Read;
use std::path::Path;

use ncc_driver::problem::{Exit, Problem};
use ncc_driver::time::csv;
use ncc_driver::time::drive::Stage;
use ncc_driver::time::payload;

use super::args::{Form, Time};
use super::course::{Spool, destination};
use crate::files;

/// What `--from` takes for a payload.
pub(super) const PAYLOAD: &str = "payload";

/// Writes the rows of a payload.
///
/// # Errors
/// Wrong usage; the file cannot be read, is no payload, or has no times.
pub(super) fn run(args: &Time) -> Result<Exit, Problem> {
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
    let done = csv::of_document(&document, &mut spool).map_err(cannot)?;
    done.map_err(|not| not.problem(&document, &shown))?;
    destination.release(&mut spool.output)?;
    Ok(Exit::Done)
}

/// The one payload, where the options make sense for one.
fn path(args: &Time) -> Result<&Path, Problem> {
    let [path] = args.files.as_slice() else {
        return Err(Problem::usage("several payloads", "call ncc once for each of them"));
    };
    if args.form != Form::Csv {
        return Err(Problem::usage(
            format!("a payload with --as {}", args.form.name()),
            "of a payload, ncc writes --as csv; for other forms, name the program",
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
