//! `ncc verify`: do two programs make the same cut, and a certificate of it.
//!
//! `comparison` compares the two programs, `cert` checks again a certificate that this verb has written.
//! Not here: how two programs differ in all their parts (`diff`).

use std::io;

use codespan_reporting::term::termcolor::WriteColor;
use ncc_driver::job::Job;
use ncc_driver::machines::pair::Machines;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::review::verify::document::Document;
use ncc_ir::expr::num::Nanos;

use super::args::Verify;
use super::cert;
use super::comparison::{call, cannot_compare, compare, exit, show, write};
use super::side::{Asked, open, operand};
use crate::args::typed::Format;
use crate::files;
use crate::registry::DialectRegistry;
pub use ncc_driver::review::verify::document::SCHEMA;
use ncc_driver::side::Side;
use ncc_driver::source::Source;
use ncc_driver::source::spool::Spool;

/// Runs the verb.
///
/// # Errors
/// Wrong usage, or a file that cannot be read or written. What is wrong with a program is reported on `err`.
pub fn run(args: &Verify, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
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
    known: &DialectRegistry,
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

/// Two texts, in the dialects and for the machines of a job, compared without a process.
///
/// # Errors
/// Anonymous files.
pub fn of_texts(
    job: &Job,
    texts: [&[u8]; 2],
    tolerance: Option<Nanos>,
    known: &DialectRegistry,
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
