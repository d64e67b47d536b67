//! `--style rs274`: the calls of a program as LinuxCNC's stand-alone interpreter prints them.
//!
//! A listing to be held beside that interpreter's, no program: no control reads it. It is read back all the
//! same (`read_back`), and leaves the house only if it does what the program does, or unverified if that is
//! asked for, which is reported: there is no place for a mark in the interpreter's form. Another judge is the
//! interpreter itself, whose own test programs are printed as it prints them. Compensated contours are listed
//! by the tool centre path.
//!
//! ```text
//! ncc linuxcnc to canon --style rs274 part.ngc    `N..... STRAIGHT_FEED(10.0000, 5.0000, 0.0000, …)`
//! ```
//!
//! Not here: how a listing is written (`ncc_backends::canon::rs274`).

use std::io::{Read, Seek, SeekFrom};

use codespan_reporting::term::termcolor::WriteColor;
use ncc_backends::canon::rs274;
use ncc_driver::job::Job;
use ncc_driver::listing::read_back;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::render::{About, human, json};
use ncc_driver::source::Source;
use ncc_frontends::Batch;
use ncc_ir::diag::{Fault, Gravity};
use ncc_ir::program::Program;

use crate::args::Translate;
use crate::args::typed::{Format, Style};
use crate::files::{self, Destination};

/// What the command line asks for beside a listing that has no meaning there.
///
/// # Errors
/// It does.
pub(crate) fn check(args: &Translate, job: &Job) -> Result<(), Problem> {
    let wrong = |message: &str, help: &str| Err(Problem::usage(message, help));
    if args.style != Style::Rs274 {
        return Ok(());
    }
    if !job.to.dialect.can.flat {
        return wrong("`--style rs274` is a style of canon", "ncc linuxcnc to canon FILE --style rs274");
    }
    if !job.from.dialect.can.contour_left_at_once {
        let message =
            format!("a program of {} makes no calls of LinuxCNC's interpreter", job.from.dialect.id);
        return wrong(&message, "translate it into linuxcnc first, and list the result");
    }
    if !args.pass.is_empty() || args.optimise.is_some() {
        return wrong("the calls of a program are those of its own words", "leave --pass and -O out");
    }
    if args.report.is_some() || args.map.is_some() || args.annotate {
        return wrong(
            "a listing of calls has no report and no map",
            "leave --report, --map and --annotate out",
        );
    }
    Ok(())
}

/// Lists the calls of a program.
///
/// # Errors
/// The source cannot be read, the listing cannot be written.
pub(crate) fn run(
    args: &Translate,
    job: &Job,
    source: &mut Source,
    destination: &Destination,
    err: &mut dyn WriteColor,
) -> Result<Exit, Problem> {
    let cannot_read = |e: &std::io::Error, shown: &str| Problem::file("read", shown, e);
    let mut text = Vec::new();
    let read = source.file.seek(SeekFrom::Start(0)).and_then(|_| source.file.read_to_end(&mut text));
    read.map_err(|e| cannot_read(&e, &source.shown))?;
    let mut batch = Batch::default();
    let mut reader = job.reader(true);
    reader.read(&text, 0, &mut batch);
    reader.finish(&mut batch);
    let mut found = std::mem::take(&mut batch.diagnostics);
    let refused = |found: &[ncc_ir::diag::Diagnostic]| found.iter().any(|d| job.refuses(d));
    let mut listing = None;
    if !refused(&found) {
        let body = std::mem::take(&mut batch.stmts);
        let main = batch.main(body);
        let procedures = [main].into_iter().chain(std::mem::take(&mut batch.procedures)).collect();
        let program = Program { name: batch.name.clone(), assumed: batch.assumed, procedures };
        match rs274::print(&program, &text, &read_back::tables(job), job.from.arc_rule()) {
            Ok(printed) => {
                let same = job.verify.then(|| read_back::verify(job, &program, &text, &printed));
                match same.unwrap_or(Ok(())) {
                    Ok(()) => listing = Some(printed),
                    Err(why) => found.push(why),
                }
            }
            Err(why) => found.push(why),
        }
    }
    let failed = found.iter().any(|d| matches!(d.fault, Fault::NotTheSame { .. }));
    // What the interpreter starts with is known: nothing is assumed of it.
    found.retain(|d| d.fault.gravity() == Gravity::Error || job.refuses(d));
    let mut about = About { job, name: &source.shown, source: &mut source.file };
    let loudness = args.telling.loudness();
    // Messages that cannot be written change nothing about what was done.
    let _ = match args.format {
        Format::Json => {
            json::print(&mut ncc_driver::problem::as_write(err), &mut about, (&found, &[]), loudness)
        }
        Format::Human => human::print(err, &mut about, &found, loudness),
    };
    let Some(listing) = listing else {
        return Ok(if failed { Exit::VerificationFailed } else { Exit::Refused });
    };
    if !job.verify && args.format == Format::Human {
        let _ = writeln!(err, "{}: listed, NOT VERIFIED", source.shown);
    }
    match destination {
        Destination::Stdout => files::data_to_stdout(&mut |out| out.write_all(listing.as_bytes()))?,
        Destination::File(path) => files::to_file(path, &mut |out| out.write_all(listing.as_bytes()))?,
    }
    Ok(Exit::Done)
}
