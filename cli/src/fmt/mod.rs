//! `ncc fmt`: the layout of a program within its dialect, and nothing but the layout.
//!
//! `text` takes a program apart line by line and writes it anew (`layout`), and has each line judged
//! (`same`); `number` gives blocks new numbers and whatever names them; `events` executes the text before
//! and after; `calls` is for texts that are lists of calls. Not here: what words mean.
//!
//! ```text
//! ncc fmt part.nc    `g1x10y5` becomes `G1 X10 Y5`
//! ```

pub mod args;

use std::io::{self, Read, Seek, SeekFrom, Write};

use codespan_reporting::term::termcolor::{Buffer, WriteColor};
use ncc_backends::{Layout, Numbering};
use ncc_dialects::{Family, Settings};
use ncc_driver::fmt::events::{self, Compared};
use ncc_driver::fmt::text::{self, Refused};
use ncc_driver::fmt::{number, shown};
use ncc_driver::guess::better;
use ncc_driver::job::Job;
use ncc_driver::problem::{Exit, Problem};
use ncc_driver::questions;
use ncc_driver::render::About;
use ncc_driver::render::{Loudness, human};
use ncc_driver::side::Side;
use ncc_driver::source::spool::Spool;
use ncc_driver::source::{Readable, Source};
use ncc_machines::schema::BlockNumbers;

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
    job.layout.numbering = args.number.unwrap_or_else(|| numbering(&job));
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
    let memory = |e: io::Error| Problem::file("use", "an anonymous file", &e);
    let job = Job { layout, ..Job::new(from.clone(), from, "text") };
    let mut nowhere = Buffer::no_color();
    let mut source = Source::of(Spool::of(text.to_vec()), "text");
    let mut done = laid_out(Loudness::Quiet, &job, &mut source, known, &mut nowhere)?;
    let mut written = Vec::new();
    done.file.rewind().and_then(|()| done.file.read_to_end(&mut written)).map_err(memory)?;
    Ok(written)
}

/// Block numbers, as the machine's profile has them; else they are kept.
fn numbering(job: &Job) -> Numbering {
    match job.machines.layout().numbers {
        None | Some((BlockNumbers::Keep, ..)) => Numbering::Keep,
        Some((BlockNumbers::Off, ..)) => Numbering::Off,
        Some((BlockNumbers::New, first, step)) => Numbering::Every { first, step },
    }
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
    let eol: &[u8] = if job.layout.crlf { b"\r\n" } else { b"\n" };
    let mut file = Spool::default();
    let found = text::text(&job.from, eol, &mut *source.file, &mut file).map_err(read)?;
    match found.refused {
        Some(Refused::NotText(line)) => return Err(not_text(&shown, Some(line))),
        Some(Refused::NotSame(line)) => return Err(not_same(&shown, Some(line))),
        None => {}
    }
    let unread = found.unread;
    let mut done = Done { file, changed: found.changed, unread, shown: String::new(), executed: false };
    if job.layout.numbering != Numbering::Keep {
        numbered(job, &shown, &mut *source.file, &mut done)?;
    }
    if done.changed == 0 {
        // Every byte is the same.
        done.executed = true;
        return Ok(done);
    }
    let mut assumed = Vec::new();
    let compared = events::compare(job, &mut *source.file, &mut done.file, &mut assumed).map_err(read)?;
    if loudness != Loudness::Quiet {
        let sound = !matches!(compared, Compared::NotExecuted(..));
        questions::note(job, source, &assumed, sound, err)?;
    }
    match compared {
        Compared::Same(events) => {
            done.executed = true;
            done.shown = format!("the same words, and {events} events the same");
        }
        Compared::Different => return Err(not_same(&shown, None)),
        Compared::NotExecuted(_, true) => return Err(not_text(&shown, None)),
        Compared::NotExecuted(first, false) => {
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
                // What cannot be told changes nothing about what was done.
                let _ = human::print(err, &mut about, std::slice::from_ref(first), Loudness::Verbose);
            }
            done.shown =
                "the same words; ncc cannot execute the program, so that no more was shown".to_owned();
        }
    }
    Ok(done)
}

/// Gives the blocks of a text that was laid out other numbers.
fn numbered(job: &Job, shown: &str, before: &mut dyn Readable, done: &mut Done) -> Result<(), Problem> {
    let wrong = |e: io::Error| Problem::file("read", shown, &e);
    let all = |file: &mut dyn Readable| -> io::Result<Vec<u8>> {
        let mut text = Vec::new();
        file.seek(SeekFrom::Start(0))?;
        file.read_to_end(&mut text)?;
        Ok(text)
    };
    let laid_out = all(&mut done.file).map_err(wrong)?;
    let text = number::renumber(&job.from, &laid_out, job.layout.numbering).map_err(|refused| {
        if refused.ours {
            return not_same(shown, None);
        }
        let place = if refused.line > 0 { format!(":{}", refused.line) } else { String::new() };
        Problem {
            exit: Exit::Refused,
            message: format!("{shown}{place}: block numbers cannot be changed because of {}", refused.what),
            help: vec!["--number keep leaves them as they are".to_owned()],
        }
    })?;
    let before = all(before).map_err(wrong)?;
    let lines =
        |text: &'_ [u8]| text.split_inclusive(|b| *b == b'\n').map(<[u8]>::to_vec).collect::<Vec<_>>();
    let changed = lines(&before).iter().zip(&lines(&text)).filter(|(a, b)| a != b).count();
    done.changed = u32::try_from(changed).unwrap_or(u32::MAX);
    done.file.clear();
    done.file.write_all(&text).map_err(wrong)
}

fn not_text(shown: &str, line: Option<u32>) -> Problem {
    let place = line.map(|line| format!(":{line}")).unwrap_or_default();
    Problem {
        exit: Exit::Refused,
        message: format!("{shown}{place} is not the text of a program"),
        help: vec!["what is no text is never written over".to_owned()],
    }
}

fn not_same(shown: &str, line: Option<u32>) -> Problem {
    let place = line.map(|line| format!(":{line}")).unwrap_or_default();
    Problem {
        exit: Exit::VerificationFailed,
        message: format!("{shown}{place} would not say the same; nothing is written"),
        help: vec!["this is a fault of ncc; please report it with the program".to_owned()],
    }
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
