//! Machine profiles on the command line: finding one, and telling what is wrong with it.
//!
//! ```text
//! --machine-to mikron.toml    the profile, checked as a whole
//! ```
//!
//! Not here: the form of a profile (`ncc_machines`).

pub mod args;

pub use args::Machines;
use std::path::Path;
use std::sync::Arc;

use codespan_reporting::diagnostic::{Diagnostic as Boxed, Label, Severity};
use codespan_reporting::files::SimpleFile;
use codespan_reporting::term::termcolor::WriteColor;
use codespan_reporting::term::{self, Config};
use ncc_dialects::Dialect;
use ncc_driver::machines::words::words;
use ncc_driver::machines::{pair, show, test};
use ncc_driver::problem::{Exit, Problem};
use ncc_machines::schema::LineEnds;
use ncc_machines::{Profile, ProfileError, shipped};

use self::args::What;
use crate::args::typed::Eol;
use crate::registry::DialectRegistry;
use crate::{files, machines};

/// The schema of profiles, as it is documented.
pub const SCHEMA: &str = include_str!("../../../docs/book/src/reference/machine-profile.md");

/// `ncc machines`.
///
/// # Errors
/// A profile is not there or has faults; stdout cannot be written.
pub fn run(args: &Machines, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Exit, Problem> {
    let print = |text: &str| files::to_stdout(&mut |out| out.write_all(text.as_bytes()));
    match &args.what {
        None => print(&show::list(shipped()))?,
        Some(What::Show { machine }) => print(&show::show(&machines::find(machine, known, err)?))?,
        Some(What::Schema) => print(SCHEMA)?,
        Some(What::Test { machines }) => {
            let mut exit = Exit::Done;
            for name in machines {
                match machines::find(name, known, err) {
                    Ok(profile) => {
                        let (text, passed) = test::test(&profile);
                        print(&text)?;
                        exit = if passed { exit } else { Exit::Refused };
                    }
                    // The others are tested all the same.
                    Err(problem) => {
                        let _ = problem.print(err, false);
                        exit = Exit::Refused;
                    }
                }
            }
            return Ok(exit);
        }
    }
    Ok(Exit::Done)
}

/// A profile by the name of a shipped one, or by its file. What is wrong with it is reported on `err`.
///
/// # Errors
/// There is none of that name, the file cannot be read, the profile has faults, or it names no control.
pub fn find(name: &str, known: &DialectRegistry, err: &mut dyn WriteColor) -> Result<Profile, Problem> {
    match find_for_times(name, known, err)? {
        profile if profile.any_control => Err(Problem::usage(
            format!("{name} names no control: it serves to time programs"),
            "use it with `ncc time`, `ncc plot` or `ncc simulate`; here, name a profile",
        )),
        profile => Ok(profile),
    }
}

/// The same for the times of a program: `.json` is the case study's machine file.
///
/// # Errors
/// As of [`find`], but that a machine file may name no control.
pub(crate) fn find_for_times(
    name: &str,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<Profile, Problem> {
    if let Some(profile) = ncc_machines::find(name) {
        return Ok(profile.clone());
    }
    let path = Path::new(name);
    let is_path = name.contains(['/', '\\', '.']) || path.exists();
    if !is_path {
        let ids: Vec<&str> = shipped().iter().map(Profile::id).collect();
        return Err(Problem::usage(
            format!("there is no machine `{name}`"),
            format!("there are: {}; or name the file of a profile", ids.join(", ")),
        ));
    }
    let bytes = std::fs::read(path).map_err(|e| Problem::file("read", name, &e))?;
    let text = String::from_utf8(bytes).map_err(|_| Problem {
        exit: Exit::File,
        message: format!("{name} is not UTF-8 text"),
        help: vec!["a profile is a TOML file".to_owned()],
    })?;
    let profile = match path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("json")) {
        true => Profile::parse_machine_json(&text),
        false => Profile::parse(&text, &|id| known.get(id)),
    };
    profile.map_err(|wrong| {
        // If stderr cannot be written, the exit code has to say it all.
        let _ = print(name, &text, &wrong, err);
        let first = wrong.first().map(|error| place(&text, error.span.start)).unwrap_or_default();
        Problem {
            exit: Exit::Usage,
            message: format!("the profile {name} cannot be used: {}{first}", count(wrong.len(), "error")),
            help: Vec::new(),
        }
    })
}

/// Prints what is wrong with a profile.
///
/// # Errors
/// Writing.
pub fn print(
    name: &str,
    text: &str,
    wrong: &[ProfileError],
    err: &mut dyn WriteColor,
) -> Result<(), codespan_reporting::files::Error> {
    let schemas = "`ncc machines schema` lists every key and what it takes";
    print_as(Severity::Error, schemas, name, text, wrong, err)
}

/// Prints what is wrong, or suspicious. `schemas` says where every key is listed.
///
/// # Errors
/// Writing.
pub(crate) fn print_as(
    severity: Severity,
    schemas: &str,
    name: &str,
    text: &str,
    wrong: &[ProfileError],
    err: &mut dyn WriteColor,
) -> Result<(), codespan_reporting::files::Error> {
    let file = SimpleFile::new(name, text);
    for error in wrong {
        let said = words(&error.wrong, schemas);
        let mut labels = vec![Label::primary((), error.span.clone()).with_message(said.label)];
        if let Some(related) = &error.related {
            labels.push(
                Label::secondary((), related.clone())
                    .with_message(said.related.unwrap_or_else(|| "the first one".to_owned())),
            );
        }
        let boxed = Boxed::new(severity)
            .with_code(format!("NC{:04}", error.wrong.code()))
            .with_message(said.message)
            .with_labels(labels)
            .with_notes(said.help.into_iter().map(|help| format!("help: {help}")).collect());
        term::emit_to_write_style(err, &Config::default(), &file, &boxed)?;
    }
    Ok(())
}

/// Where the first error is.
pub(crate) fn place(text: &str, at: usize) -> String {
    let before = text.get(..at).unwrap_or_default();
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
    format!(", first in line {line}, column {column}")
}

/// `1 error`, `2 errors`.
pub(crate) fn count(n: usize, noun: &str) -> String {
    format!("{n} {noun}{}", if n == 1 { "" } else { "s" })
}

/// The profiles of both sides, by name or file.
///
/// # Errors
/// There is none, or it has faults; those are reported on `err`.
pub(crate) fn find_both(
    from: Option<&str>,
    to: Option<&str>,
    known: &DialectRegistry,
    err: &mut dyn WriteColor,
) -> Result<pair::Machines, Problem> {
    let mut one = |name: Option<&str>| {
        name.map(|name| find(name, known, err)).transpose().map(|found| found.map(Arc::new))
    };
    Ok(pair::Machines { from: one(from)?, to: one(to)? })
}

/// Line ends, as the shop wants them.
pub(crate) fn eol(machines: &pair::Machines) -> Eol {
    match machines.layout().line_ends {
        None | Some(LineEnds::Keep) => Eol::Keep,
        Some(LineEnds::Lf) => Eol::Lf,
        Some(LineEnds::Crlf) => Eol::Crlf,
    }
}

/// The dialect of a side, by its name or by its profile.
///
/// # Errors
/// Both name one, and not the same.
pub(crate) fn agreed(
    named: Option<&'static Dialect>,
    profile: Option<&Profile>,
    side: &str,
) -> Result<Option<&'static Dialect>, Problem> {
    match (named, profile) {
        (Some(dialect), Some(profile)) if dialect.id != profile.dialect.id => Err(Problem::usage(
            format!("--{side} {}, but the machine {} is a {}", dialect.id, profile.id(), profile.dialect.id),
            format!("leave --{side} out: the profile names the dialect"),
        )),
        (Some(dialect), _) => Ok(Some(dialect)),
        (None, profile) => Ok(profile.map(|profile| profile.dialect)),
    }
}
