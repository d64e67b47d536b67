//! `ncc verify`: do two programs make the same cut, and a certificate of it.
//!
//! `pair` executes and compares as strictly as a translation compares what it has written, `document` is
//! what is written down of it, `text` tells it, `hashes` name what it rests on; certificates are checked
//! again by `cert`. Not here: how two programs differ in all their parts (`diff`).

use std::io::{self, Write};
use std::path::Path;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::guess::better;
use ncc_driver::job::Job;
use ncc_driver::machines::pair::Machines;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::questions;
use ncc_driver::render::{About, human};
use ncc_driver::review::verify::document::{Call, Document};
use ncc_driver::review::verify::hashes;
use ncc_driver::review::verify::text;
use ncc_ir::expr::num::Nanos;

use super::args::Verify;
use super::cert;
use super::side::{Asked, open, operand};
use crate::args::typed::Format;
use crate::files;
use crate::known::Known;
use crate::time::running::Running;
pub use ncc_driver::review::verify::document::SCHEMA;
use ncc_driver::review::verify::document::Word;
use ncc_driver::side::Side;
use ncc_driver::source::Source;
use ncc_driver::source::spool::Spool;

/// Runs the verb.
///
/// # Errors
/// Wrong usage, or a file that cannot be read or written. What is wrong with a program is told on `err`.
pub fn run(args: &Verify, known: &Known, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    if args.schema {
        files::to_stdout(&mut |out| out.write_all(SCHEMA.as_bytes()))?;
        return Ok(Exit::Done);
    }
    let both = <&[String; 2]>::try_from(args.files.as_slice()).ok();
    match (&args.cert, both) {
        (Some(certificate), None) if args.files.is_empty() => {
            cert::check_again(args, certificate, None, known, err)
        }
        (Some(certificate), Some(files)) if args.recheck => {
            cert::check_again(args, certificate, Some(files), known, err)
        }
        (_, Some(files)) => verify(args, files, known, err),
        (_, None) => {
            Err(Problem::usage("two programs are compared, the source and the output", "ncc verify SRC OUT"))
        }
    }
}

fn verify(
    args: &Verify,
    files: &[String; 2],
    known: &Known,
    err: &mut dyn WriteColor,
) -> Result<Exit, Problem> {
    let given = args.holding.read()?;
    let asked = [
        Asked {
            operand: &files[0],
            from: args.from.as_deref(),
            machine: args.machine_from.as_deref(),
            options: &args.from_option,
            start: args.standing.start,
            given: given.clone(),
            ..Asked::default()
        },
        Asked {
            operand: &files[1],
            from: args.to.as_deref(),
            machine: args.machine_to.as_deref(),
            options: &args.to_option,
            given,
            is_output: true,
            ..Asked::default()
        },
    ];
    let say = !args.telling.quiet && args.format == Format::Human;
    let mut sides = open([&asked[0], &asked[1]], say, known, err)?;
    let certificate = args.cert.as_deref();
    if certificate.is_some() && args.holding.args.is_some() {
        return Err(Problem::usage(
            "a certificate is of programs that need no values from elsewhere",
            "leave out --args, or set the variables in the programs",
        ));
    }
    if let Some(name) = certificate {
        sides[0].source.guard(Some(name))?;
        sides[1].source.guard(Some(name))?;
        if name.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) {
            return Err(Problem::usage(
                format!("{} would be a certificate by the name of a dictionary or profile", name.display()),
                "a certificate is JSON: name it so",
            ));
        }
    }
    let named = |text: &str| operand(text, known).map(|(_, path)| path.display().to_string());
    let files = [named(&files[0])?, named(&files[1])?];
    let machines = [args.machine_from.as_deref(), args.machine_to.as_deref()];
    let call = call(files, machines, args.nearness.tolerance, &sides, known).map_err(cannot_compare)?;
    let document = compare(args, &mut sides, &call, known, err)?;
    if let Some(name) = certificate {
        files::to_file(name, &mut |out| write(out, &document))?;
    }
    show(args, &document)?;
    Ok(exit(&document))
}

/// What a comparison is called with, and the hashes of what it rests on.
///
/// # Errors
/// Reading the file of a profile.
pub(crate) fn call(
    files: [String; 2],
    machines: [Option<&str>; 2],
    tolerance: Option<Nanos>,
    sides: &[Side; 2],
    known: &Known,
) -> io::Result<Call> {
    Ok(Call {
        files,
        machines: machines.map(|name| name.map(str::to_owned)),
        tolerance,
        dictionaries: hashes::dictionaries(sides, &|id| known.texts(id)),
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
    known: &Known,
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
    Document::of(&found, sides, call).map_err(cannot_compare)
}

/// Tells what was found in a program.
fn say(
    args: &Verify,
    side: &mut Side,
    course: &ncc_driver::review::stream::Course,
    known: &Known,
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

/// Two texts, in the dialects and for the machines of a job, compared without a process.
///
/// # Errors
/// Anonymous files.
pub fn of_texts(
    job: &Job,
    texts: [&[u8]; 2],
    tolerance: Option<Nanos>,
    known: &Known,
) -> io::Result<Document> {
    let anonymous =
        |text: &[u8], name: &str| -> io::Result<Source> { Ok(Source::of(Spool::of(text.to_vec()), name)) };
    let own = |machine: &Option<std::sync::Arc<ncc_machines::Profile>>| Machines {
        from: machine.clone(),
        to: machine.clone(),
    };
    let mut sides = [
        Side::of(anonymous(texts[0], "source")?, job.from.clone(), own(&job.machines.from), Some(job.start)),
        Side::of(anonymous(texts[1], "output")?, job.to.clone(), own(&job.machines.to), None),
    ];
    let machines = [&job.machines.from, &job.machines.to];
    let machines = machines.map(|machine| machine.as_ref().map(|machine| machine.id()));
    let call = call(["source".to_owned(), "output".to_owned()], machines, tolerance, &sides, known)?;
    let found = ncc_driver::review::verify::pair::compare(&mut sides, tolerance.unwrap_or_default())?;
    Document::of(&found, &mut sides, &call)
}

/// Whether a path is stdin.
pub(crate) fn is_stdin(path: &str) -> bool {
    Path::new(path) == Path::new("-")
}
