//! `ncc check`: what is wrong with a program, before it meets a machine.
//!
//! `drive` goes from the text to findings, `told` brings them into words, and `text`, `json` and
//! `sarif` write them. Not here: the rules (ncc-check), profiles (ncc-machines).
//!
//! ```text
//! ncc check --from fanuc part.nc    warning[NC…] at the place, exit code 1
//! ```

pub mod args;

use std::io::{self, IsTerminal};
use std::path::Path;

use codespan_reporting::term::termcolor::{Ansi, NoColor, WriteColor};
use ncc_dialects::Settings;
use ncc_driver::check::{drive, json, limits, sarif, text, told};
use ncc_ir::diag::Gravity;
use ncc_machines::Profile;

pub use ncc_driver::check::json::SCHEMA;

use self::args::{Check, Form};
use crate::args::typed::Color;
use crate::files::{self, Destination};
use crate::registry::DialectRegistry;
use crate::review::side::{Asked, open_one};
use crate::time::running::Running;
use ncc_driver::check::told::Graded;
use ncc_driver::check::told::Program;
use ncc_driver::guess::better;
use ncc_driver::job::Output;
use ncc_driver::machines::pair::Machines;
use ncc_driver::problem::Exit;
use ncc_driver::problem::Problem;
use ncc_driver::questions;
use ncc_driver::render::terminal::Shown;
use ncc_driver::side::Side;
use ncc_driver::source::Source;
use ncc_driver::source::halted;
use ncc_driver::source::spool::Spool;

/// Runs the verb.
///
/// # Errors
/// Wrong usage, or a file that cannot be read or written.
pub fn run(
    args: &Check,
    known: &DialectRegistry,
    color: Color,
    err: &mut dyn WriteColor,
) -> Result<Exit, Problem> {
    if args.schema {
        files::to_stdout(&mut |out| out.write_all(SCHEMA.as_bytes()))?;
        return Ok(Exit::Done);
    }
    if args.files.iter().filter(|file| *file == "-" || file.ends_with(":-")).count() > 1 {
        return Err(Problem::usage("stdin can be read only once", "name a file"));
    }
    if let Some(id) = args.reading.from.as_deref().filter(|id| *id != "auto") {
        known.dialect(id)?;
    }
    let profile = match &args.machine {
        Some(name) => Some(crate::machines::find(name, known, err)?),
        None => None,
    };
    let mut exit = Exit::Done;
    let mut programs = Vec::new();
    for file in &args.files {
        match one(args, file, profile.as_ref(), known, err) {
            Ok(program) => programs.push(program),
            Err(problem) if args.files.len() < 2 => return Err(problem),
            Err(problem) => {
                // The exit code says so too.
                let _ = problem.print(err, false);
                exit = exit.and(problem.exit);
            }
        }
    }
    if programs.iter().any(Program::has_findings) {
        exit = exit.and(Exit::Refused);
    }
    write(args, programs, color)?;
    Ok(exit)
}

/// Checks one program.
fn one(
    args: &Check,
    file: &str,
    profile: Option<&Profile>,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Program, Problem> {
    let asked = Asked {
        operand: file,
        from: args.reading.from.as_deref(),
        machine: args.machine.as_deref().filter(|_| args.reading.from.is_none()),
        options: &args.reading.from_option,
        start: None,
        given: args.holding.read()?,
        beside: args.machine.as_deref(),
        ..Asked::default()
    };
    let say = !args.telling.quiet && args.format == Form::Text;
    let Side { mut source, job } = open_one(&asked, say, known, err)?;
    if let Some(output) = destination(args) {
        source.guard(Some(output))?;
    }
    let shown = source.shown.clone();
    let wrong = |e: io::Error| Problem::file("read", &shown, &e);
    let limits = limits(profile.or(job.machines.from.as_deref()), args.rapid_plane);
    let running = Running::shown(&source.name, say);
    let course = drive::drive(&job, limits, args.switches.on(), &mut source).map_err(wrong)?;
    drop(running);
    if let Some(problem) = halted::problem(&course.diagnostics, &mut source).map_err(wrong)? {
        return Err(problem);
    }
    if say {
        let sound = course.diagnostics.iter().all(|d| d.fault.gravity() != Gravity::Error);
        questions::note(&job, &mut source, &course.diagnostics, sound, err)?;
    }
    let doubtful = course.diagnostics.len() > 2;
    let program = told::tell(&graded(args), &job, &mut source, course).map_err(wrong)?;
    if say
        && doubtful
        && program.counts[0] > 0
        && let Ok(Some((other, reasons))) = better(&mut source.file, &job.from, known.all())
    {
        let _ = writeln!(err, "{shown} reads like {}: {}", other.id, reasons.join(", "));
    }
    Ok(program)
}

fn graded(args: &Check) -> Graded {
    Graded { allow: args.allow.clone(), deny: args.deny.clone(), verbose: args.telling.verbose }
}

fn destination(args: &Check) -> Option<&Path> {
    args.output.as_deref().filter(|name| *name != Path::new("-"))
}

fn write(args: &Check, programs: Vec<Program>, color: Color) -> Result<(), Problem> {
    let destination =
        destination(args).map_or(Destination::Stdout, |name| Destination::File(name.to_owned()));
    let mut output = Output::new();
    let color = matches!(destination, Destination::Stdout) && is_colored(color);
    let written = formed(args, programs, color).and_then(|text| output.push(&text));
    written.map_err(|e| Problem::file("write", "the findings", &e))?;
    match args.format {
        Form::Text => destination.release_shown(&mut output),
        Form::Json | Form::Sarif => destination.release(&mut output),
    }
}

/// The findings in the form that is asked for.
fn formed(args: &Check, programs: Vec<Program>, color: bool) -> io::Result<Vec<u8>> {
    let mut text = Vec::new();
    match args.format {
        Form::Json => json::write(&mut text, programs)?,
        Form::Sarif => sarif::write(&mut text, &programs)?,
        Form::Text => {
            let loudness = args.telling.loudness();
            let mut plain = Shown::new(NoColor::new(Vec::new()));
            let mut colored = Shown::new(Ansi::new(Vec::new()));
            let out: &mut dyn WriteColor = if color { &mut colored } else { &mut plain };
            programs.iter().try_for_each(|program| text::write(out, program, loudness))?;
            text = if color { colored.finish()?.into_inner() } else { plain.finish()?.into_inner() };
        }
    }
    Ok(text)
}

/// What is found in a text, without a process, for tests, in the form that is asked for.
///
/// # Errors
/// Anonymous files.
pub fn of_text(args: &Check, from: Settings, profile: Option<&Profile>, text: &[u8]) -> io::Result<Vec<u8>> {
    let Side { mut source, job } =
        Side::of(Source::of(Spool::of(text.to_vec()), "text"), from, Machines::default(), None);
    let course = drive::drive(&job, limits(profile, args.rapid_plane), args.switches.on(), &mut source)?;
    formed(args, vec![told::tell(&graded(args), &job, &mut source, course)?], false)
}

/// Whether findings on stdout are coloured.
fn is_colored(color: Color) -> bool {
    match color {
        Color::Always => true,
        Color::Never => false,
        Color::Auto => {
            io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty())
        }
    }
}
