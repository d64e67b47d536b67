//! `ncc fmt`: the layout of a program within its dialect, and nothing but the layout.
//!
//! Not here: the work itself (`ncc_driver::fmt`).
//!
//! ```text
//! ncc fmt part.nc    `g1x10y5` becomes `G1 X10 Y5`
//! ```

pub mod args;

use std::io::{self, Read, Seek, SeekFrom, Write};

use codespan_reporting::term::termcolor::{Buffer, WriteColor};
use ncc_backends::{Layout, Numbering};
use ncc_dialects::{Family, Settings};
use ncc_driver::fmt::events::Compared;
use ncc_driver::fmt::shown;
use ncc_driver::fmt::whole::{self, Whole};
use ncc_driver::guess::better;
use ncc_driver::job::Job;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::questions;
use ncc_driver::render::About;
use ncc_driver::render::{Loudness, human};
use ncc_driver::side::Side;
use ncc_driver::source::Source;
use ncc_driver::source::spool::Spool;

use self::args::Fmt;
use crate::args::typed::Eol;
use crate::files;
use crate::registry::DialectRegistry;
use crate::review::side::{Asked, open_one, operand};

/// Runs the verb.
///
/// # Errors
/// Wrong usage, or, of a single file, what keeps it from being laid out.
pub fn run(args: &Fmt, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    if args.files.iter().filter(|file| is_stdin(file)).count() > 1 {
        return Err(Problem::usage("stdin can be read only once", "name a file"));
    }
    if args.stdout && args.files.len() > 1 {
        return Err(Problem::usage(
            "several files would run into each other on stdout",
            "call ncc once for each of them",
        ));
    }
    let mut exit = Exit::Done;
    for file in &args.files {
        match one(args, file, known, err) {
            Ok(done) => exit = exit.and(done),
            Err(problem) if args.files.len() < 2 => return Err(problem),
            Err(problem) => {
                // The exit code says so too.
                let _ = problem.print(err, false);
                exit = exit.and(problem.exit);
            }
        }
    }
    Ok(exit)
}

fn is_stdin(file: &str) -> bool {
    file == "-" || file.ends_with(":-")
}

/// A text that was laid out.
struct Done {
    /// The result.
    file: Spool,
    /// Lines that look otherwise.
    changed: u32,
    /// Lines that were not taken apart.
    unread: (Vec<u32>, u32),
    /// What was shown of it.
    shown: String,
    /// Whether it was executed before and after, or nothing changes.
    executed: bool,
}

fn one(args: &Fmt, file: &str, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    let asked = Asked {
        operand: file,
        from: args.reading.from.as_deref(),
        machine: args.machine.as_deref(),
        options: &args.reading.from_option,
        start: args.standing.start,
        ..Asked::default()
    };
    let loudness = args.telling.loudness();
    let say = loudness != Loudness::Quiet;
    let Side { mut source, mut job } = open_one(&asked, say, known, err)?;
    let eol = match args.lines.eol.unwrap_or(crate::machines::eol(&job.machines)) {
        Eol::Lf => false,
        Eol::Crlf => true,
        Eol::Keep => source.is_crlf()?,
    };
    job.layout.crlf = eol;
    job.layout.numbering = args.number.unwrap_or_else(|| whole::numbering(&job));
    let of_words = matches!(job.from.dialect.family, Family::Word | Family::Sinumerik);
    if !of_words && job.layout.numbering != Numbering::Keep {
        return Err(Problem::usage(
            format!("block numbers of {} are not changed", job.from.dialect.id),
            "leave --number out",
        ));
    }
    let done = laid_out(loudness, &job, &mut source, known, err)?;
    tell(&done, &source, say, err);
    if args.executed && !done.executed {
        return Err(Problem {
            exit: Exit::Refused,
            message: format!("{} cannot be executed, and is left as it is", source.shown),
            help: vec!["without --executed, what has the same words is written".to_owned()],
        });
    }
    write(args, file, known, &mut source, done)
}

/// A text laid out without a process, for tests.
///
/// # Errors
/// What keeps it from being laid out.
pub fn of_text(
    from: Settings,
    layout: Layout,
    text: &[u8],
    known: &DialectRegistry,
) -> Result<Vec<u8>, Problem> {
    let memory = |e: io::Error| Problem::file("use", "a temporary file", &e);
    let job = Job { layout, ..Job::new(from.clone(), from, "text") };
    let mut nowhere = Buffer::no_color();
    let mut source = Source::of(Spool::of(text.to_vec()), "text");
    let mut done = laid_out(Loudness::Quiet, &job, &mut source, known, &mut nowhere)?;
    let mut written = Vec::new();
    done.file.rewind().and_then(|()| done.file.read_to_end(&mut written)).map_err(memory)?;
    Ok(written)
}

/// Lays a text out.
fn laid_out(
    loudness: Loudness,
    job: &Job,
    source: &mut Source,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Done, Problem> {
    let shown = source.shown.clone();
    let read = |e: io::Error| Problem::file("read", &shown, &e);
    let whole = whole::lay_out(job, source)?;
    let Whole { file, changed, unread, compared, assumed } = whole;
    let mut done = Done { file, changed, unread, shown: String::new(), executed: compared.is_none() };
    if loudness != Loudness::Quiet && compared.is_some() {
        let sound = !matches!(compared, Some(Compared::NotExecuted(..)));
        questions::note(job, source, &assumed, sound, err)?;
    }
    match compared {
        Some(Compared::Same(events)) => {
            done.executed = true;
            done.shown = format!("the same words, and {events} events the same");
        }
        Some(Compared::NotExecuted(first, _)) => {
            let other = better(&mut source.file, &job.from, known.all()).map_err(read)?;
            if let Some((other, reasons)) = other {
                let id = &job.from.dialect.id;
                return Err(Problem {
                    exit: Exit::Refused,
                    message: format!("{shown} has errors as {id}, and reads like {}", other.id),
                    help: vec![reasons.join(", "), format!("ncc fmt {}:{shown}", other.id)],
                });
            }
            if let Some(first) = first.as_ref()
                && loudness == Loudness::Verbose
            {
                let mut about = About { job, name: &shown, source: &mut source.file };
                // What cannot be reported changes nothing about what was done.
                let _ = human::print(err, &mut about, std::slice::from_ref(first), Loudness::Verbose);
            }
            done.shown =
                "the same words; ncc cannot execute the program, so that no more was shown".to_owned();
        }
        // Nothing changes.
        Some(Compared::Different) | None => {}
    }
    Ok(done)
}

fn tell(done: &Done, source: &Source, say: bool, err: &mut dyn WriteColor) {
    if !say {
        return;
    }
    let shown = &source.shown;
    let (named, count) = &done.unread;
    if *count > 0 {
        let named: Vec<String> = named.iter().map(u32::to_string).collect();
        let more = if *count as usize > named.len() { " …" } else { "" };
        let _ = writeln!(
            err,
            "{shown}: {count} line{} kept as {}, because ncc cannot take {} apart: {}{more}",
            if *count == 1 { "" } else { "s" },
            if *count == 1 { "it is" } else { "they are" },
            if *count == 1 { "it" } else { "them" },
            named.join(", ")
        );
    }
    let _ = match done.changed {
        0 => writeln!(err, "{shown}: nothing to change"),
        1 => writeln!(err, "{shown}: 1 line changes; {}", done.shown),
        n => writeln!(err, "{shown}: {n} lines change; {}", done.shown),
    };
}

/// Writes the result, or tells what it would be.
fn write(
    args: &Fmt,
    file: &str,
    known: &DialectRegistry,
    source: &mut Source,
    mut done: Done,
) -> Result<Exit, Problem> {
    let shown = source.shown.clone();
    let exit = if args.check && done.changed > 0 { Exit::Refused } else { Exit::Done };
    if args.check || args.diff {
        return files::to_stdout(&mut |out| {
            if args.check && done.changed > 0 {
                writeln!(out, "{shown}")?;
            }
            if args.diff && done.changed > 0 {
                shown::difference(&shown, &mut *source.file, &mut done.file, out)?;
            }
            Ok(())
        })
        .map(|()| exit);
    }
    let mut copy = |out: &mut dyn Write| -> io::Result<()> {
        done.file.seek(SeekFrom::Start(0))?;
        io::copy(&mut done.file, out).map(|_| ())
    };
    if args.stdout || is_stdin(file) {
        source.guard(None)?;
        files::data_to_stdout(&mut copy)?;
    } else if done.changed > 0 {
        let (_, path) = operand(file, known)?;
        files::to_file(path, &mut copy)?;
    }
    Ok(exit)
}
